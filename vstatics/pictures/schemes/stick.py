"""The stick diagram: the half of the transmission above its axis, wheels as lines of teeth.

Elements stand side by side in the order of the case. Shafts run below them, near the
axis, drums above them; brakes reach to the housing at the top. Where only mechanisms are given
these are taken for planetary sets.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

from matplotlib.figure import Figure

from vstatics.elements.drawing import drawing_of
from vstatics.elements.element import CentralWheel, Element
from vstatics.elements.group import PlanetGroup, group_of
from vstatics.elements.kinds import Planetary
from vstatics.errors import CaseError
from vstatics.model.parts import Mechanism
from vstatics.model.transmission import Transmission
from vstatics.pictures.schemes.axes.picture import figures as axes_figures
from vstatics.pictures.schemes.axes.recognition import parallel_axes
from vstatics.pictures.schemes.board import Board
from vstatics.pictures.schemes.channels import ABOVE, BELOW, Item, Tap
from vstatics.pictures.schemes.coaxial.drawing import laid_out
from vstatics.pictures.schemes.coaxial.picture import painted
from vstatics.pictures.schemes.coaxial.section import CoaxialScheme, coaxial_scheme
from vstatics.pictures.schemes.glyphs import HATCH_WIDTH, Glyph, ground, hatching, lines_of
from vstatics.pictures.schemes.pairs import pair_glyphs
from vstatics.pictures.schemes.placing import Placement, placed
from vstatics.pictures.schemes.scheme import Device, Scheme, SchemeState, scheme_of
from vstatics.pictures.schemes.search import arranged
from vstatics.pictures.schemes.sets import HalfSection, section_of, set_glyphs
from vstatics.pictures.schemes.sheet import HEIGHT, Painted, Sheet, figures, wired
from vstatics.pictures.schemes.structure import draw_box, named_on_tracks, row_item
from vstatics.pictures.schemes.titles import Titles, teeth_of
from vstatics.pictures.sheet.labels import Point, width
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.pen import LINE_WIDTH, Pen
from vstatics.pictures.sheet.style import SMALL, Style
from vstatics.pictures.sheet.words import word
from vstatics.statics.results import Results

LEAST_HALF = 36.0
"""Half the height of the row, at least. [pt]"""
BRIDGE = 6.0
"""Width of a wall that joins a shaft to a drum. [pt]"""
ELEMENT_NAME_GAP = 7.0
"""From the name of an element to its drawing. [pt]"""


class StickLayout(NamedTuple):
    """The elements with the ways in which they can be drawn, and where all stands."""

    placement: Placement
    glyphs: Mapping[int, list[Glyph]]

    def glyph(self, index: int) -> Glyph:
        """How an element is drawn."""
        return self.glyphs[index][self.placement.arrangement.variants[index]]


def each(results: Results, style: Style, shown: Iterable[Sequence[int]]) -> Iterator[list[Figure]]:
    """The stick diagram of a case that is made of elements, or of what may be planetary sets.

    In the picture of a gear what is engaged is marked, and what turns as one piece; what
    carries no torque is pale. Everything is in the same places in each.

    Raises
    ------
    CaseError
        If the case has mechanisms only, and none that may be a set.
    """
    axes = parallel_axes(scheme := scheme_of(results.case), results.case)
    if axes is not None:
        yield from axes_figures(results, scheme, axes, style, shown)
        return
    scheme, glyphs = stick_scheme(results.case)
    subject = style.text("stick diagram", "кинематическая схема")
    note = style.text(
        "mechanisms as planetary sets: simple ones where u < 0, with meshed planets where u > 0",
        "механизмы как план. ряды: простые при u < 0, с парными сателлитами при u > 0",
    )
    note = "" if glyphs is None else note
    own = coaxial_scheme(scheme, sections_of(scheme, results.case, style))
    paint = _coaxial(own, style, note) if own else _row(scheme, glyphs, style, note)
    yield from figures(results, scheme, style, paint, shown=shown, subject=subject)


def _coaxial(own: CoaxialScheme, style: Style, note: str) -> Painted:
    """The half-section of what turns about one axis."""
    layout = laid_out(own, style.width, is_ordered=style.ordered)

    def paint(state: SchemeState, titles: Titles, name: str) -> Pen:
        return painted(layout, style, state, titles, name, note)

    return paint


def _row(
    scheme: Scheme, glyphs: Mapping[int, list[Glyph]] | None, style: Style, note: str
) -> Painted:
    """Elements side by side, where there are several axes."""
    layout = place(scheme, style, glyphs)
    draw = partial(draw_mechanism, layout)

    def paint(state: SchemeState, titles: Titles, name: str) -> Pen:
        drawn = scheme, layout.placement, style, draw, state
        is_coaxial = all(map(_is_coaxial, scheme.devices))
        return wired(*drawn, titles=titles, name=name, note=note, is_coaxial=is_coaxial).pen

    return paint


def sections_of(scheme: Scheme, case: Transmission, style: Style) -> dict[int, HalfSection]:
    """The planetary sets of a scheme by their places, also mechanisms that may be some."""
    found = {}
    for index, device in enumerate(scheme.devices):
        element = device.element
        names: dict[str, str] = {}
        if element is not None and isinstance(element.shape, Planetary):
            group = group_of(element)
            if style.wheels:
                teeth = teeth_of(element).items()
                names = {one: f"{word(one, style)}: {count:g}" for one, count in teeth}
        elif element is None and ("carrier" in device.members or can_be_set(device)):
            group = bare_group(case.mechanisms[device.numbers[0]])
        else:
            continue
        found[index] = replace(section_of(group), names=names)
    return found


def stick_scheme(case: Transmission) -> tuple[Scheme, Mapping[int, list[Glyph]] | None]:
    """The scheme as its stick diagram has it; ways to draw mechanisms that are taken for sets."""
    drawing, scheme = drawing_of(case), scheme_of(case)
    if drawing is not None and drawing.elements:
        return scheme, None
    if not any(map(can_be_set, scheme.devices)):
        message = (
            "a stick diagram needs elements with their kinds (docs/elements.md); "
            "this case has mechanisms only, none with three links that turn, no pair of wheels: "
            "take the picture `structure`, or find teeth for it "
            "(vstatics synth teeth CASE --write FILE)"
        )
        raise CaseError("E411", message)
    devices, glyphs = as_sets(scheme.devices, case.mechanisms)
    return replace(scheme, devices=devices), glyphs


def place(
    scheme: Scheme,
    style: Style,
    glyphs: Mapping[int, list[Glyph]] | None = None,
) -> StickLayout:
    """Where everything stands in the picture; the same for all gears of a case.

    Parameters
    ----------
    glyphs : mapping of int to list of Glyph, optional
        All ways to draw what is no box, by its index; those of the elements if not given.
    """
    if glyphs is None:
        glyphs = {
            index: _glyphs_of(device.element, style)
            for index, device in enumerate(scheme.devices)
            if device.element is not None and not device.is_on_housing
        }
    items = [
        _element_item(index, device, glyphs[index], style, index)
        if index in glyphs
        else replace(
            row_item(index, device, (ABOVE, BELOW), style),
            rank=None if device.is_coupling else index,
        )
        for index, device in enumerate(scheme.devices)
    ]
    wires = range(1, len(scheme.links) + 1)
    for wire in wires:
        wall = [Tap(wire, ABOVE, BRIDGE / 2), Tap(wire, BELOW, BRIDGE / 2)]
        items.append(Item(len(items), [BRIDGE], [wall], bridge=wire))
    board = Board(items, wires, *scheme.ends)
    arrangement = arranged(board, is_free=False)
    half = max([LEAST_HALF, *(glyph.half + 8 for ways in glyphs.values() for glyph in ways)])
    return StickLayout(placed(board, arrangement, half, named_on_tracks(scheme)), glyphs)


def _glyphs_of(element: Element, style: Style) -> list[Glyph]:
    """All ways in which an element can be drawn."""
    teeth = {one: f"{count:g}" for one, count in teeth_of(element).items()} if style.wheels else {}
    if isinstance(element.shape, Planetary):
        named = {one: f"{word(one, style)}: {count}" for one, count in teeth.items()}
        return set_glyphs(group_of(element), named)
    return pair_glyphs(element, teeth)


_WITHOUT_AXES = "mechanism", "variator", "converter", "spring"


def _is_coaxial(device: Device) -> bool:
    """Whether all its links turn about one axis, as far as is told."""
    element = device.element
    if element is None:
        return device.kind not in _WITHOUT_AXES or "carrier" in device.members
    return isinstance(element.shape, Planetary) or device.kind == "held"


def _names(device: Device, style: Style) -> tuple[str, str]:
    """The name of an element, and its kind if that cannot be seen from its planets."""
    element = device.element
    is_set = element is None or isinstance(element.shape, Planetary)
    return lines_of(device.name), "" if is_set else word(device.kind, style)


def _element_item(
    index: int, device: Device, glyphs: list[Glyph], style: Style, rank: int | None
) -> Item:
    name, kind = _names(device, style)
    label = max(width(name, bold=True), width(kind, SMALL)) + ELEMENT_NAME_GAP
    variants = [[tap._replace(x=tap.x + label) for tap in glyph.taps] for glyph in glyphs]
    return Item(index, [glyph.width + label for glyph in glyphs], variants, rank=rank)


def draw_mechanism(layout: StickLayout, sheet: Sheet, index: int) -> None:
    """An element with its name; a box, where its wheels are not known."""
    if index not in layout.glyphs:
        draw_box(sheet, index)
        return
    pen, color, placement = sheet.pen, sheet.color(index), sheet.placement
    device, glyph = sheet.scheme.devices[index], layout.glyph(index)
    ink, said = sheet.text_color(index), sheet.titles.devices.get(index, "")
    left = placement.row.lefts[index]
    start = left + placement.row.widths[index] - glyph.width
    if index in sheet.state.pieces:
        low, high = ((start + x, y) for x, y in glyph.wheels)
        pen.lines(hatching(low, high), color=pen.style.soft, width=HATCH_WIDTH, zorder=1)
    looks: dict[tuple[float, bool], list[Sequence[Point]]] = {}
    for stroke in glyph.strokes:
        points = [(start + x, y) for x, y in stroke.points]
        looks.setdefault((stroke.width, stroke.dashed), []).append(points)
    for tap in sheet.taps(index):
        if tap.reach == "none":
            end = tap.x, tap.side * (placement.half + 4)
            own = looks.setdefault((LINE_WIDTH, False), [])
            own += [((tap.x, tap.y), end), *ground(end, tap.side)]
    for (thick, dashed), lines in looks.items():
        dashes = (0, (2.5, 1.5)) if dashed else "-"
        look: Look = {"linestyle": dashes, "title": said if thick == LINE_WIDTH else ""}
        pen.lines(lines, color=color, width=thick, zorder=4, solid_capstyle="projecting", **look)
    for (x, y), up, text in glyph.texts:
        sheet.text((start + x, y), text, color=ink, size=SMALL, ha="left", va=up, over=True)
    name, kind = _names(device, pen.style)
    x, y = start - ELEMENT_NAME_GAP, placement.half - 2
    look = {"color": ink, "ha": "right", "va": "top"}
    sheet.text((x, y), name, bold=True, **look)
    sheet.text((x, y - HEIGHT * (name.count("\n") + 1)), kind, size=SMALL, **look)


def can_be_set(device: Device) -> bool:
    """Whether it may be a planetary set: a mechanism with a carrier that is not the housing."""
    return device.kind == "mechanism" and "third" in device.members


def as_sets(
    devices: Sequence[Device], mechanisms: Sequence[Mechanism]
) -> tuple[list[Device], Mapping[int, list[Glyph]]]:
    """Devices with their mechanisms as sets of sun, ring and carrier; how those can be drawn.

    Below 0 a ratio is that of a simple set, above 0 one of meshed planets; where its size is
    below 1 the first link has the ring.

    >>> devices = [Device("D1", "mechanism", {"first": 1, "second": 2, "third": 3}, (0,))]
    >>> as_sets(devices, [Mechanism(1, 2, 3, -2.5)])[0][0].members
    {'sun': 1, 'ring': 2, 'carrier': 3}
    """
    sets, glyphs = [*devices], {}
    for index, device in enumerate(devices):
        if can_be_set(device):
            group = bare_group(mechanisms[device.numbers[0]])
            glyphs[index] = set_glyphs(group)
            members = {wheel.member: wheel.link for wheel in group.wheels}
            sets[index] = device._replace(members={**members, "carrier": group.carrier})
    return sets, glyphs


def bare_group(mechanism: Mechanism) -> PlanetGroup:
    """Wheels and planets of a set, with teeth that stand for any.

    >>> [wheel.link for wheel in bare_group(Mechanism(1, 2, 3, -0.4)).wheels]
    [2, 1]
    """
    first, second, carrier = mechanism.links
    sun, ring = (first, second) if abs(mechanism.ratio) >= 1 else (second, first)
    is_simple = mechanism.ratio < 0
    rims = ("planet",) if is_simple else ("inner", "outer")
    wheels = [
        CentralWheel("sun", sun, 1, internal=False, rim=rims[0]),
        CentralWheel("ring", ring, 1, internal=True, rim=rims[-1]),
    ]
    meshes = [] if is_simple else [("inner", "outer")]
    return PlanetGroup(carrier, wheels, {rim: {rim: None} for rim in rims}, meshes)
