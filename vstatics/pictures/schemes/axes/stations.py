"""Stations: components that have a position along the axes, from gear pairs to springs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from vstatics.core.groups import grouped
from vstatics.core.tables.numbers import typeset
from vstatics.pictures.drawing.labels import width
from vstatics.pictures.drawing.style import SMALL, Style
from vstatics.pictures.drawing.words import word
from vstatics.pictures.schemes.axes.recognition import AxisJoint, ParallelAxes, is_bare_differential
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.rooms import ends_of, extent
from vstatics.pictures.schemes.gear_glyphs import Glyph, lines_of
from vstatics.pictures.schemes.scheme import Device, Scheme, ratio_text
from vstatics.pictures.schemes.sets import HalfSection, set_glyphs

SIGN = 16.0
"""Length of the symbol of a sleeve or a plate pack, with the connecting lines. [pt]"""
SPRING = 24.0
"""Length of the symbol of a spring, with the connecting lines. [pt]"""
WHEEL = 5.0
"""Half the width of a gear. [pt]"""
PIN = 7.0
"""Half the width of a box, per link of the component. [pt]"""
CAGE = 15.0
"""Half the width of a differential. [pt]"""
BEARING = 9.0
"""Distance from a crown gear to the bearing of the casing. [pt]"""


class Station(NamedTuple):
    """Component, or group of components, drawn at a common position along the axes."""

    kind: str
    """Kind of station: ``pair`` (gears), ``coupling``, ``brake``, ``set``, ``differential``,
    ``box``, or ``section`` (several gear sets).
    """
    devices: Sequence[int]
    """Indices of the components in `Scheme.devices`."""
    axes: Sequence[int]
    """Indices of the axes of the station, two for a gear pair."""
    links: Sequence[int]
    """Connected links: of a `pair` in the order of the gears, of a `section` the left link first.
    """
    half: float
    """Half the width of the station. [pt]"""
    names: Sequence[str] = ()
    """Names of the components, wrapped into lines."""
    joint: AxisJoint | None = None
    glyphs: Sequence[Glyph] = ()
    """Ways to draw a gear set, from which the search chooses; empty for other kinds."""
    is_shifted: bool = False
    """True if a clutch connects the links, False for a spring."""
    teeth: Sequence[str] = ()
    """Tooth numbers of a gear pair, empty if not shown."""
    layout: CoaxialLayout | None = None
    """Layout of the half-section, if the station is a half-section."""

    @property
    def reach(self) -> tuple[float, float]:
        """Distances from the axis down and up to the ends of a half-section, else 0 [pt]."""
        if self.layout is None:
            return 0.0, 0.0
        (_, low), (_, high) = extent(self.layout)
        return low - self.layout.places.axis, high - self.layout.places.axis

    @property
    def has_two_sides(self) -> bool:
        """True for a station with a link on the left and a link on the right."""
        return self.kind in ("coupling", "box") and len(self.links) == 2


def stations_of(  # noqa: PLR0913, PLR0917 - parts of the gearbox and their style
    scheme: Scheme,
    axes: ParallelAxes,
    style: Style,
    letters: int,
    sections: Mapping[int, HalfSection],
    layouts: Sequence[CoaxialLayout],
) -> list[Station]:
    """Return the stations of a gearbox in the order of the components.

    Parameters
    ----------
    letters : int
        Number of letters above which a name is broken into lines.
    sections : mapping of int to HalfSection
        Half-sections of single gear sets, by index in the scheme.
    layouts : sequence of CoaxialLayout
        Half-sections of several gear sets.
    """
    joints = {joint.device: joint for joint in axes.joints}
    stations = [_section(layout, axes) for layout in layouts]
    inside = {index for section in stations for index in section.devices}
    for index, device in enumerate(scheme.devices):
        if index in inside:
            continue
        names = [lines_of(device.name, letters)]
        if index in joints:
            joint = joints[index]
            rows = axes.of(joint.first), axes.of(joint.second)
            half = WHEEL + BEARING * bool(joint.frame)
            pair = Station("pair", (index,), rows, joint.links, half, names, joint)
            stations.append(pair._replace(teeth=_pair_teeth(device, style)))
        else:
            row = axes.of(next(iter(device.links)))
            station = _alone(index, device, row, names, style)
            if station.kind == "box" and index in sections:
                glyphs = set_glyphs(sections[index].with_teeth_alone())
                half = glyphs[0].width / 2
                station = station._replace(kind="set", half=half, glyphs=glyphs)
            stations.append(station)
    return list(_stacked(stations))


def _section(layout: CoaxialLayout, axes: ParallelAxes) -> Station:
    coaxial, (left, right) = layout.coaxial, ends_of(layout)
    links, row = (coaxial.train.start, coaxial.train.end), axes.of(coaxial.train.start)
    return Station("section", coaxial.devices, (row,), links, (right - left) / 2, layout=layout)


def _stacked(stations: Sequence[Station]) -> Iterator[Station]:
    """Yield the stations; couplings between the same two links become a single station."""
    keyed: Iterator[tuple[object, Station]] = (
        (frozenset(station.links) if station.kind == "coupling" else number, station)
        for number, station in enumerate(stations)
    )
    for alike in grouped(keyed).values():
        devices = [index for station in alike for index in station.devices]
        names = [name for station in alike for name in station.names]
        half = max(station.half for station in alike)
        yield alike[0]._replace(devices=devices, names=names, half=half)


def _alone(index: int, device: Device, row: int, names: Sequence[str], style: Style) -> Station:
    links = [link for link in device.members.values() if link]
    if device.is_on_housing:
        names = [] if device.kind == "held" else names
        return Station("brake", (index,), (row,), links, 11.0, names)
    if device.is_coupling:
        half = (SPRING if device.sign in ("spring", "play") else SIGN) / 2
        shifted = device.is_shift_element
        return Station("coupling", (index,), (row,), links, half, names, is_shifted=shifted)
    is_differential = device.kind == "bevel" or is_bare_differential(device)
    if is_differential and len(set(links)) == len(device.members):
        return Station("differential", (index,), (row,), links, CAGE, names)
    half = max(note_half(box_note(device, style)), 13.0, PIN * len(links))
    return Station("box", (index,), (row,), links, half, names)


def _pair_teeth(device: Device, style: Style) -> list[str]:
    if not style.wheels or device.element is None:
        return []
    first, *_, last = device.element.shape.toothed
    return [typeset(f"{device.element.teeth[gear]:g}") for gear in (first, last)]


def note_half(note: str) -> float:
    """Return half the width of a box around a text [pt]."""
    return width(note, SMALL) / 2 + 3


def box_note(device: Device, style: Style) -> str:
    """Return the text in the box of a component whose gears are not known."""
    return ratio_text(device.ratio) if device.kind == "mechanism" else word(device.kind, style)
