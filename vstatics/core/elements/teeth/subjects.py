"""Teeth of a gear set for the checks: meshes, ratios, and the space of nearby teeth.

`OfPlanets` covers gear sets with planets, `OfWheels` gear sets of a few gears.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import islice, pairwise
from typing import ClassVar

from vstatics.core.elements.element import Element
from vstatics.core.elements.group import group_of
from vstatics.core.elements.kinds import Simple
from vstatics.core.elements.teeth.layout import AxisLayout, Key, Teeth, ratio_pairs, with_teeth
from vstatics.core.elements.teeth.meshing import Mesh, Toothed
from vstatics.core.elements.teeth.nearby import FEW_WHEELS, Space, space_of


@dataclass(frozen=True)
class Subject(ABC):
    """Teeth of a gear set for checks. An argument `teeth` replaces the present teeth."""

    element: Element

    against: ClassVar = ""
    """Part relative to which messages count revolutions; empty for the housing."""

    @property
    @abstractmethod
    def space(self) -> Space:
        """Search space for similar teeth."""

    @property
    @abstractmethod
    def pairs(self) -> Sequence[tuple[Key, Key]]:
        """Pairs of keys of gears in mesh. In an internal mesh the ring comes first."""

    @abstractmethod
    def known(self) -> Teeth:
        """Return the known numbers of teeth, by key."""

    @abstractmethod
    def ratios(self, teeth: Teeth) -> list[Fraction]:
        """Return the ratios of the gear set with the teeth `teeth` [-]."""

    @abstractmethod
    def is_internal(self, key: Key) -> bool:
        """Return whether a gear is a ring gear."""

    def label(self, key: Key) -> str:
        """Return the name of a gear or rim for messages."""
        return str(key)

    def wheels(self, teeth: Teeth | None = None) -> dict[Key, Toothed]:
        """Return the gears with known teeth, by key."""
        return {
            key: Toothed(self.label(key), count, key, self.is_internal(key))
            for key, count in (teeth or self.known()).items()
        }

    def meshes(self, teeth: Teeth | None = None) -> list[Mesh]:
        """Return the meshes of gears with known teeth."""
        wheels = self.wheels(teeth)
        return [Mesh(wheels[a], wheels[b]) for a, b in self.pairs if a in wheels and b in wheels]

    def is_hunting(self, teeth: Teeth) -> bool:
        """Return whether in each mesh every tooth meets every tooth of the mating gear."""
        return all(
            math.gcd(teeth[a], teeth[b]) == 1 for a, b in self.pairs if a in teeth and b in teeth
        )


class OfPlanets(Subject):
    """Teeth of a gear set with planets."""

    against = " against the carrier"

    @cached_property
    def given(self) -> AxisLayout:
        """Layout of the planets with the present teeth."""
        return AxisLayout(self.element, group_of(self.element))

    @cached_property
    def space(self) -> Space:
        """Search space of teeth for which all central gears remain coaxial."""
        group, element = self.given.group, self.element
        return space_of(group, [r for r in group.planet_of if element.rims or r in element.teeth])

    @cached_property
    def pairs(self) -> Sequence[tuple[Key, Key]]:
        """Pairs of keys in mesh: central gears with rims, then rims of two planets."""
        group = self.given.group
        return [*((place, wheel.rim) for place, wheel in enumerate(group.wheels)), *group.meshes]

    def layout(self, teeth: Teeth | None = None) -> AxisLayout:
        """Return the layout of the planets, by default with the present teeth."""
        if teeth is None:
            return self.given
        return AxisLayout(self.element, with_teeth(self.given.group, teeth))

    def known(self) -> Teeth:
        """Return the teeth of central gears, and the known teeth of rims."""
        group = self.given.group
        known: dict[Key, int] = {place: wheel.teeth for place, wheel in enumerate(group.wheels)}
        for rim in group.planet_of:
            count = self.given.teeth(rim)
            if count is not None and count.denominator == 1 and count > 0:
                known[rim] = int(count)
        return known

    def is_internal(self, key: Key) -> bool:
        """Return whether the key belongs to a ring."""
        return isinstance(key, int) and self.given.group.wheels[key].internal

    def label(self, key: Key) -> str:
        """Return the name of a central gear, or the type and name of a planet rim."""
        return self.given.label(key if isinstance(key, str) else self.given.group.wheels[key])

    def ratios(self, teeth: Teeth) -> list[Fraction]:
        """Return the ratios between central gears with the carrier held."""
        group = self.layout(teeth).group
        return [group.ratio(*pair) for pair in ratio_pairs(group)]


class OfWheels(Subject):
    """Teeth of a gear pair, an idler or a bevel differential."""

    @cached_property
    def shape(self) -> Simple:
        """Declaration of the kind."""
        shape = self.element.shape
        if not isinstance(shape, Simple):
            raise TypeError(self.element.kind)
        return shape

    @cached_property
    def names(self) -> list[str]:
        """Names of gears with known teeth, in the order of the meshes."""
        return [name for name in self.shape.toothed if name in self.element.teeth]

    @cached_property
    def space(self) -> Space:
        """Search space in which each tooth number changes independently."""
        given: Teeth = {name: int(self.element.teeth[name]) for name in self.names}
        ratio: Teeth = {self.names[0]: -1, self.names[-1]: 1}
        return Space(given, given, [{name: 1} for name in given], [ratio])

    @cached_property
    def pairs(self) -> Sequence[tuple[Key, Key]]:
        """Pairs of consecutive gears; empty if the teeth of an idler are missing.

        Bevel differentials are omitted, because their gears hardly turn relative to each other.
        """
        if self.element.kind == "bevel":
            return []
        names = sorted(self.names, key=self.is_internal, reverse=True)
        return [*pairwise(names)] if len(names) == len(self.shape.toothed) else []

    def known(self) -> Teeth:
        """Return the present teeth."""
        return self.space.given

    def is_internal(self, key: Key) -> bool:
        """Return whether a gear is the ring of an internal pair."""
        given = self.space.given
        return self.element.kind == "internal_pair" and given[key] == max(given.values())

    def ratios(self, teeth: Teeth) -> list[Fraction]:
        """Return the ratio of the first gear to the last gear."""
        return [self.shape.sign * Fraction(teeth[self.names[-1]], teeth[self.names[0]])]


def suggested(subject: Subject, suggestions: Iterator[Teeth], what: str) -> str:
    """Return a clause with the first two suggestions, ``; nearest that fit: ...``, or ""."""
    texts = []
    for teeth in islice(suggestions, 2):
        given = subject.space.given
        keys = [key for key in given if len(given) <= FEW_WHEELS or teeth[key] != given[key]]
        names = ", ".join(f"{subject.label(key)} {teeth[key]}" for key in keys)
        ratios = [f"{float(ratio):.5g}" for ratio in subject.ratios(teeth)]
        word = "ratios" if len(ratios) > 1 else "ratio"
        texts.append(f"{names} ({word} {', '.join(ratios)})")
    return f"; nearest {what}: {' or '.join(texts)}" if texts else ""
