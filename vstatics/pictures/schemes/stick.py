"""The stick diagram: the half of the transmission above its axis, wheels as lines of teeth.

What turns about one axis is a half-section; several axes are rows. Where only mechanisms are given
these are taken for planetary sets.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from matplotlib.figure import Figure

from vstatics.elements.drawing import drawing_of
from vstatics.elements.element import CentralWheel
from vstatics.elements.group import PlanetGroup, group_of
from vstatics.elements.kinds import Planetary
from vstatics.errors import CaseError
from vstatics.model.parts import Mechanism
from vstatics.model.transmission import Transmission
from vstatics.pictures.schemes.axes.picture import figures as axes_figures
from vstatics.pictures.schemes.axes.recognition import ParallelAxes, parallel_axes
from vstatics.pictures.schemes.coaxial.chains import unchained
from vstatics.pictures.schemes.coaxial.fitting import fits, laid_out
from vstatics.pictures.schemes.coaxial.picture import CoaxialSheet, painted
from vstatics.pictures.schemes.coaxial.section import coaxial_scheme
from vstatics.pictures.schemes.scheme import Device, Scheme, scheme_of
from vstatics.pictures.schemes.sets import HalfSection, section_of
from vstatics.pictures.schemes.titles import teeth_of
from vstatics.pictures.schemes.told import told_of
from vstatics.pictures.sheet.style import Style
from vstatics.pictures.sheet.words import word
from vstatics.statics.results import Results


def each(results: Results, style: Style, shown: Iterable[Sequence[int]]) -> Iterator[list[Figure]]:
    """The stick diagram of a case that is made of elements, or of what may be planetary sets.

    In the picture of a gear what is engaged is marked, and what turns as one piece; what
    carries no torque is pale. Everything is in the same places in each.

    Raises
    ------
    CaseError
        If the case has mechanisms only, and none that may be a set.
    """
    case = results.case
    axes, sheet = parallel_axes(scheme := scheme_of(case), case), None
    if axes is None:
        sheet = coaxial_sheet(drawn := stick_scheme(case), sections_of(drawn, case, style), style)
        axes = ParallelAxes([frozenset(range(1, len(scheme.links) + 1))], [])
    if sheet is None:
        yield from axes_figures(results, scheme, axes, style, shown)
        return
    subject = style.text("stick diagram", "кинематическая схема")
    note = style.text(
        "mechanisms as planetary sets: simple ones where u < 0, with meshed planets where u > 0",
        "механизмы как план. ряды: простые при u < 0, с парными сателлитами при u > 0",
    )
    is_bare = any(one.element is None and "carrier" in one.members for one in drawn.devices)
    for gears in shown:
        told = told_of(results, drawn, style, gears, subject=subject)
        state = told.state, told.titles, told.name
        yield [painted(sheet, style, *state, note * is_bare).figure]


def coaxial_sheet(
    scheme: Scheme, sections: Mapping[int, HalfSection], style: Style
) -> CoaxialSheet | None:
    """The half-section of what turns about one axis; None if something joins three of its links.

    Where a page is too narrow, what stands before the box and behind it has rows of its own.
    """
    own = coaxial_scheme(scheme, sections)
    if own is None:
        return None
    layout = laid_out(own, style.width, is_ordered=style.ordered)
    parts = unchained(scheme, sections)
    if fits(layout, style.width) or not parts.chains:
        return CoaxialSheet(layout)
    box = coaxial_scheme(parts.scheme, sections, parts.left_out)
    if box is None:
        return CoaxialSheet(layout)
    return CoaxialSheet(laid_out(box, style.width, is_ordered=style.ordered), parts.chains)


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


def stick_scheme(case: Transmission) -> Scheme:
    """The scheme as its stick diagram has it: mechanisms that may be sets are some.

    Raises
    ------
    CaseError
        If the case has mechanisms only, and none that may be a set.
    """
    drawing, scheme = drawing_of(case), scheme_of(case)
    if drawing is not None and drawing.elements:
        return scheme
    if not any(map(can_be_set, scheme.devices)):
        message = (
            "a stick diagram needs elements with their kinds (docs/elements.md); "
            "this case has mechanisms only, none with three links that turn, no pair of wheels: "
            "take the picture `structure`, or find teeth for it "
            "(vstatics synth teeth CASE --write FILE)"
        )
        raise CaseError("E411", message)
    return replace(scheme, devices=as_sets(scheme.devices, case.mechanisms))


def can_be_set(device: Device) -> bool:
    """Whether it may be a planetary set: a mechanism with a carrier that is not the housing."""
    return device.kind == "mechanism" and "third" in device.members


def as_sets(devices: Sequence[Device], mechanisms: Sequence[Mechanism]) -> list[Device]:
    """Devices with their mechanisms as sets of sun, ring and carrier.

    Below 0 a ratio is that of a simple set, above 0 one of meshed planets; where its size is
    below 1 the first link has the ring.

    >>> devices = [Device("D1", "mechanism", {"first": 1, "second": 2, "third": 3}, (0,))]
    >>> as_sets(devices, [Mechanism(1, 2, 3, -2.5)])[0].members
    {'sun': 1, 'ring': 2, 'carrier': 3}
    """
    sets = [*devices]
    for index, device in enumerate(devices):
        if can_be_set(device):
            group = bare_group(mechanisms[device.numbers[0]])
            members = {wheel.member: wheel.link for wheel in group.wheels}
            sets[index] = device._replace(members={**members, "carrier": group.carrier})
    return sets


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
