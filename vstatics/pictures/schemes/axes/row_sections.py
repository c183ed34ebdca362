"""Planetary sets on one of several axes: what of its row is a half-section by itself."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import replace
from math import inf
from typing import NamedTuple

from vstatics.pictures.schemes.axes.recognition import ParallelAxes, is_bare_differential
from vstatics.pictures.schemes.axes.stations import drum_of
from vstatics.pictures.schemes.coaxial.fitting import placed_by_letters
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.layout import SectionFrame, framed
from vstatics.pictures.schemes.coaxial.places import SectionPlaces
from vstatics.pictures.schemes.coaxial.search.sweep import swept
from vstatics.pictures.schemes.coaxial.section import CoaxialScheme, coaxial_scheme
from vstatics.pictures.schemes.scheme import Scheme, SchemePort
from vstatics.pictures.schemes.sets import HalfSection

FEWEST_SETS = 2
"""A single one is drawn where it stands, with all that leads to it from its row."""


class RowSection(NamedTuple):
    """Sets and couplings between two links of a row, from left to right."""

    own: CoaxialScheme
    frame: SectionFrame
    is_ordered: bool
    named_beside: frozenset[int]
    """Links that have arrows in their rows."""

    def laid_out(
        self, letters: float = 1.0, line_letters: int = 12, *, is_small: bool = False
    ) -> CoaxialLayout:
        """With places, for letters of a size over lengths; longer names are broken.

        A small one has no names of links.
        """
        bare = CoaxialLayout(
            self.own,
            SectionPlaces(self.frame, 0.0),
            self.is_ordered,
            is_small=is_small,
            letters=letters,
            line_letters=line_letters,
            named_beside=self.named_beside,
        )
        return placed_by_letters(bare)


def row_sections(
    scheme: Scheme,
    axes: ParallelAxes,
    sections: Mapping[int, HalfSection],
    *,
    is_ordered: bool = False,
) -> Iterator[RowSection]:
    """Of each axis what stands between two of its links and has sets of which links can cross.

    Parameters
    ----------
    sections : mapping of int to HalfSection
        The devices that may be sets, by their places in the scheme.
    """
    drum = {*drum_of(scheme)}
    for number in range(len(axes.axes)):
        inside, ends = _between_ends(scheme, axes, number, sections)
        sets = [one for one in sorted(inside) if one in sections]
        divides = any(is_bare_differential(scheme.devices[one]) for one in inside)
        if len(ends) != 2 or len(sets) < FEWEST_SETS or drum & inside or divides:
            continue
        ports = [
            SchemePort(link, role) for link, role in zip(ends, ("before", "behind"), strict=True)
        ]
        left_out = {*range(len(scheme.devices))} - inside
        part = replace(scheme, ports=ports)
        own = coaxial_scheme(part, {one: sections[one] for one in sets}, left_out)
        if own is not None and own.train.end:
            found = swept(own.train, is_ordered=is_ordered)
            frame = framed(own.train, found.steps)
            yield RowSection(own, frame, found.is_ordered, frozenset(p.link for p in scheme.ports))


def _between_ends(
    scheme: Scheme, axes: ParallelAxes, number: int, others: Mapping[int, HalfSection]
) -> tuple[AbstractSet[int], Sequence[int]]:
    """Devices of an axis without chains at its ends, and the links by which these go on.

    Links by which power comes from the input are first.
    """
    joints = {one.device for one in axes.joints}
    inside = {
        index
        for index, one in enumerate(scheme.devices)
        if index not in joints and one.links and one.links <= axes.axes[number]
    }
    ends: dict[int, float] = {}
    for one in axes.joints:
        for link, other in zip(one.links, one.links[::-1], strict=True):
            for own in {link, one.frame} if axes.of(link) == number else ():
                ends[own] = min(ends.get(own, inf), axes.of(other))
    for port in scheme.ports:
        ends.setdefault(port.link, -1.0 if port.role == "input" else inf)
    ends = {link: order for link, order in ends.items() if link in axes.axes[number]}
    while True:
        step = next(_outermost(scheme, inside, ends, others), None)
        if step is None:
            return inside, sorted(ends, key=lambda link: ends[link])
        link, index = step
        inside -= {index}
        (further,) = scheme.devices[index].links - {link}
        ends[further] = min(ends.pop(link), ends.get(further, inf))


def _outermost(
    scheme: Scheme,
    inside: AbstractSet[int],
    ends: Mapping[int, float],
    others: Mapping[int, HalfSection],
) -> Iterator[tuple[int, int]]:
    """Links at ends that one coupling of two links joins to the rest, and this coupling."""
    for link in ends:
        own = [index for index in inside if link in scheme.devices[index].links]
        if len(own) == 1 and own[0] not in others and len(scheme.devices[own[0]].links) == 2:
            yield link, own[0]
