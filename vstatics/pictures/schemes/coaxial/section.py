"""Conversion of a scheme with one axis to a train, the graph of its components."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import count
from typing import NamedTuple

from vstatics.core.model.empty import EMPTY
from vstatics.core.model.transmission import HOUSING
from vstatics.pictures.schemes.boxes import BoxSection, BoxText
from vstatics.pictures.schemes.coaxial.planarity import has_half_section
from vstatics.pictures.schemes.coaxial.train import CoaxialTrain, Planes
from vstatics.pictures.schemes.scheme import Device, Scheme, SchemePort
from vstatics.pictures.schemes.sets import HalfSection

NO_TEXTS: Mapping[int, BoxText] = EMPTY


class TopMeaning(NamedTuple):
    """Component of the scheme or port of the case that a `top` of the train represents."""

    device: int = -1
    """Index of the component in the scheme; -1 for a port."""
    port: SchemePort | None = None


@dataclass(frozen=True)
class CoaxialScheme:
    """Scheme and train of a gearbox. Further links in the train are fixed members of gear sets."""

    scheme: Scheme
    train: CoaxialTrain
    sections: Mapping[int, HalfSection]
    """Half-sections of gear sets and boxes, by index in the scheme."""
    texts: Mapping[int, BoxText]
    """Texts of the boxes on lines, by index in the scheme."""
    sets: Sequence[int]
    """Indices of the gear sets in the scheme, in the order of the train."""
    pairs: Sequence[int]
    tops: Sequence[TopMeaning]

    @property
    def devices(self) -> list[int]:
        """Indices of the drawn components in the scheme."""
        return [*self.sets, *self.pairs, *(top.device for top in self.tops if top.device >= 0)]

    @property
    def has_boxes(self) -> bool:
        """True if any component is drawn as a box; then no axis is drawn."""
        return bool(self.texts) or any(isinstance(s, BoxSection) for s in self.sections.values())

    def is_housing(self, link: int) -> bool:
        """Return whether a link of the train is a fixed member of a gear set."""
        return link > len(self.scheme.links)


def coaxial_scheme(
    scheme: Scheme,
    sections: Mapping[int, HalfSection],
    left_out: Container[int] = (),
    texts: Mapping[int, BoxText] = NO_TEXTS,
) -> CoaxialScheme | None:
    """Return a scheme with the train, unless a component at three links has no symbol.

    Parameters
    ----------
    sections : mapping of int to HalfSection
        Half-sections of gear sets, by index in the scheme.
    left_out : container of int
        Indices of components that are drawn elsewhere.
    texts : mapping of int to BoxText, optional
        Texts of the boxes on lines.
    """
    pairs: list[int] = []
    tops: list[int] = []
    others: list[int] = []
    for place, device in enumerate(scheme.devices):
        if place in sections or place in left_out:
            continue
        joined = len(device.links)
        (tops if device.is_on_housing else pairs if joined == 2 else others).append(place)
    if others or not scheme.ports:
        return None
    supports = count(len(scheme.links) + 1)

    def with_support(link: int) -> int:
        """Return the number of a link, a new one for each fixed member with its own support."""
        return next(supports) if link == HOUSING else link

    planes = [
        planes_of(section, int if isinstance(section, BoxSection) else with_support)
        for section in sections.values()
    ]
    connections: list[tuple[TopMeaning, int]] = [
        (TopMeaning(place), next(iter(scheme.devices[place].links))) for place in tops
    ]
    connections += [(TopMeaning(), link) for link in range(len(scheme.links) + 1, next(supports))]
    start, end, further = _ports(scheme)
    connections += [(TopMeaning(port=port), port.link) for port in further]
    coupled = [_ends(scheme.devices[place]) for place in pairs]
    train = CoaxialTrain(planes, coupled, [link for _, link in connections], start, end)
    if end and all(len(part.wheels) == 1 for part in planes) and not has_half_section(train):
        port = next(p for p in scheme.ports if p.link == end and not p.is_left)
        through = replace(train, tops=[*train.tops, end], end=0)
        if has_half_section(through):
            train, connections = through, [*connections, (TopMeaning(port=port), end)]
    meanings = [meaning for meaning, _ in connections]
    return CoaxialScheme(scheme, train, sections, texts, [*sections], pairs, meanings)


def _ends(device: Device) -> tuple[int, int]:
    first, second = (link for link in dict.fromkeys(device.members.values()) if link)
    return first, second


def _ports(scheme: Scheme) -> tuple[int, int, list[SchemePort]]:
    """Return the links that enter and leave along the axis (or 0), and all other ports."""
    start = next((port for port in scheme.ports if port.is_left), scheme.ports[0])
    outputs = (port for port in scheme.ports if not port.is_left and port.link != start.link)
    end = next(outputs, None)
    along = {start.link, end.link if end else start.link}
    further = {port.link: port for port in scheme.ports if port.link not in along}
    return start.link, end.link if end else start.link, [*further.values()]


def planes_of(section: HalfSection, numbered: Callable[[int], int]) -> Planes:
    """Return the links of carrier, suns and rings of a gear set or box, renumbered."""
    carrier = numbered(section.group.carrier)
    wheels = [
        (
            numbered(column.sun.link) if column.sun else 0,
            numbered(column.ring.link) if column.ring else 0,
        )
        for column in section.columns
    ]
    return Planes(carrier, wheels)
