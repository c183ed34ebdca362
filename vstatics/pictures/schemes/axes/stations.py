"""What stands on the axes: pairs of wheels, sets, differentials, clutches, brakes, springs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.core.elements.group import group_of
from vstatics.core.elements.kinds import Planetary
from vstatics.core.model.parts import Mechanism
from vstatics.core.tables.numbers import typeset
from vstatics.pictures.drawing.labels import width
from vstatics.pictures.drawing.style import SMALL, Style
from vstatics.pictures.drawing.words import word
from vstatics.pictures.schemes.axes.recognition import AxisJoint, ParallelAxes, is_bare_differential
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.rooms import ends_of, extent
from vstatics.pictures.schemes.glyphs import ABOVE, BELOW, Glyph, Tap, lines_of
from vstatics.pictures.schemes.planetary import bare_group
from vstatics.pictures.schemes.scheme import Device, Scheme, ratio_text
from vstatics.pictures.schemes.sets import set_glyphs
from vstatics.pictures.schemes.titles import teeth_of

SIGN = 16.0
"""Length of a sleeve or a pack of plates with what leads to it. [pt]"""
SPRING = 24.0
PACK_PITCH = 24.0
"""From pack to pack in one drum. [pt]"""
WHEEL = 5.0
"""Half the width of a wheel. [pt]"""
PIN = 7.0
"""Half of what a link takes of the width of a box. [pt]"""
CAGE = 15.0
"""Half the width of a differential. [pt]"""
BEARING = 9.0
"""From a crown wheel to the bearing of its casing. [pt]"""


class Station(NamedTuple):
    """Something at one place along the axes."""

    kind: str
    """``pair``, ``coupling``, ``brake``, ``drum``, ``set``, ``differential``, ``box``, or
    ``section`` of several sets."""
    devices: Sequence[int]
    """By their places in `Scheme.devices`; of a drum those of its clutches."""
    axes: Sequence[int]
    """On which it stands: both of a pair."""
    links: Sequence[int]
    """That it joins; of a pair by its wheels, of a drum that of the drum first, of a half-section
    those that go on to its left and to its right."""
    half: float
    """Half its width. [pt]"""
    names: Sequence[str] = ()
    """Of its devices, in lines of text."""
    joint: AxisJoint | None = None
    glyphs: Sequence[Glyph] = ()
    """All ways to draw a set."""
    is_shifted: bool = False
    """Whether a clutch joins its links, not a spring."""
    teeth: Sequence[str] = ()
    """Of the two wheels of a pair, if they are shown."""
    layout: CoaxialLayout | None = None
    """Of a half-section."""

    @property
    def reach(self) -> tuple[float, float]:
        """From its axis down and up to the ends of a half-section; 0 of anything else [pt]."""
        if self.layout is None:
            return 0.0, 0.0
        (_, low), (_, high) = extent(self.layout)
        return low - self.layout.places.axis, high - self.layout.places.axis

    @property
    def has_two_sides(self) -> bool:
        """Whether it stands between two links."""
        return self.kind in ("coupling", "box") and len(self.links) == 2


def stations_of(
    scheme: Scheme,
    axes: ParallelAxes,
    style: Style,
    letters: int = 12,
    sections: Sequence[CoaxialLayout] = (),
) -> list[Station]:
    """All stations of a box, in the order of its devices; longer names are broken."""
    joints = {joint.device: joint for joint in axes.joints}
    drum = drum_of(scheme)
    found = [_section(layout, axes) for layout in sections]
    inside = {index for one in found for index in one.devices}
    for index, device in enumerate(scheme.devices):
        if index in inside:
            continue
        names = [lines_of(device.name, letters)]
        if index in joints:
            joint = joints[index]
            rows = axes.of(joint.first), axes.of(joint.second)
            half = WHEEL + BEARING * bool(joint.frame)
            one = Station("pair", (index,), rows, joint.links, half, names, joint)
            found.append(one._replace(teeth=_pair_teeth(device, style)))
        elif index in drum[:1]:
            found.append(_drum(scheme, drum, axes))
        elif index not in drum:
            row = axes.of(next(iter(device.links)))
            found.append(_alone(index, device, row, names, style))
    return list(_stacked(found))


def _section(layout: CoaxialLayout, axes: ParallelAxes) -> Station:
    own, (left, right) = layout.own, ends_of(layout)
    links, row = (own.train.start, own.train.end), axes.of(own.train.start)
    return Station("section", own.devices, (row,), links, (right - left) / 2, layout=layout)


def _stacked(stations: Sequence[Station]) -> Iterator[Station]:
    """What joins the same two links stands at one place, one above the other."""
    taken: set[int] = set()
    for place, one in enumerate(stations):
        if place in taken:
            continue
        if one.kind == "coupling":
            alike = [
                number
                for number, other in enumerate(stations)
                if other.kind == one.kind and {*other.links} == {*one.links}
            ]
            taken |= {*alike}
            own = [stations[number] for number in alike]
            devices = [index for other in own for index in other.devices]
            names = [name for other in own for name in other.names]
            half = max(other.half for other in own)
            yield one._replace(devices=devices, names=names, half=half)
        else:
            yield one


def _alone(index: int, device: Device, row: int, names: Sequence[str], style: Style) -> Station:
    """What stands on one axis."""
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
    glyphs = set_ways(device, style)
    if glyphs:
        return Station("set", (index,), (row,), links, glyphs[0].width / 2, names, glyphs=glyphs)
    half = max(width(box_note(device, style), SMALL) / 2 + 3, 13.0, PIN * len(links))
    return Station("box", (index,), (row,), links, half, names)


def _pair_teeth(device: Device, style: Style) -> list[str]:
    """Of its first wheel and of its last one."""
    if not style.wheels or device.element is None:
        return []
    first, *_, last = device.element.shape.toothed
    return [typeset(f"{device.element.teeth[one]:g}") for one in (first, last)]


def box_note(device: Device, style: Style) -> str:
    """What stands in a box whose wheels are not known."""
    return ratio_text(device.ratio) if device.kind == "mechanism" else word(device.kind, style)


def set_ways(device: Device, style: Style) -> list[Glyph]:
    """All ways to draw a planetary set with its carrier; none of what is no set."""
    if device.element is not None:
        if not isinstance(device.element.shape, Planetary):
            return []
        counts = teeth_of(device.element) if style.wheels else {}
        named = {one: f"{count:g}" for one, count in counts.items()}
        return set_glyphs(group_of(device.element), named)
    if device.kind != "mechanism" or "third" not in device.members:
        return []
    first, second, carrier = device.members.values()
    return set_glyphs(bare_group(Mechanism(first, second, carrier, device.ratio)))


def drum_of(scheme: Scheme) -> list[int]:
    """Clutches whose packs are in one drum on the side of the input: those of a dual clutch.

    >>> from vstatics.pictures.schemes.scheme import SchemePort
    >>> clutches = [Device("K", "clutch", {"first": 1, "second": n}, (n,)) for n in (2, 3)]
    >>> drum_of(Scheme(["engine", "odd", "even"], clutches, [SchemePort(1, "input")]))
    [0, 1]
    """
    at = next(port.link for port in scheme.ports if port.role == "input")
    seen = {at}
    while True:
        if any(at in one.links for one in scheme.devices if not one.is_coupling):
            return []
        ahead = [
            index
            for index, one in enumerate(scheme.devices)
            if at in one.links and not one.is_on_housing and not one.links <= seen
        ]
        if len(ahead) != 1:
            break
        (at,) = scheme.devices[ahead[0]].links - {at}
        seen.add(at)
    driven = {link for index in ahead for link in scheme.devices[index].links} - {at}
    are_clutches = all(scheme.devices[index].kind == "clutch" for index in ahead)
    return ahead if are_clutches and len(driven) == len(ahead) > 1 else []


def _drum(scheme: Scheme, drum: Sequence[int], axes: ParallelAxes) -> Station:
    links = [scheme.devices[index].links for index in drum]
    (common,) = set.intersection(*links)
    others = [next(iter(own - {common})) for own in links]
    half = PACK_PITCH * len(drum) / 2 + 2
    names = [lines_of(scheme.devices[index].name, 4) for index in drum]
    return Station("drum", drum, (axes.of(common),), (common, *others), half, names)


def taps_of(glyph: Glyph) -> Iterator[Tap]:
    """Where wires meet a set."""
    return (tap for tap in glyph.taps if tap.reach != "none" and tap.side in (ABOVE, BELOW))
