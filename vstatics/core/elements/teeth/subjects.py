"""The teeth of an element: which of them mesh, what ratios they make, where others are near.

Of an element with planets, or of one with a few wheels.
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
    """The teeth of an element, as they are or with others in their place."""

    element: Element

    against: ClassVar = ""
    """What turns are counted against; the housing when empty."""

    @property
    @abstractmethod
    def space(self) -> Space:
        """Where nearby teeth are."""

    @property
    @abstractmethod
    def pairs(self) -> Sequence[tuple[Key, Key]]:
        """What meshes, a ring before the wheel in it."""

    @abstractmethod
    def known(self) -> Teeth:
        """The teeth that are known and whole."""

    @abstractmethod
    def ratios(self, teeth: Teeth) -> list[Fraction]:
        """The ratios with other teeth."""

    @abstractmethod
    def is_internal(self, key: Key) -> bool:
        """Whether teeth point inward."""

    def label(self, key: Key) -> str:
        """How messages call a wheel or a rim."""
        return str(key)

    def wheels(self, teeth: Teeth | None = None) -> dict[Key, Toothed]:
        """What has teeth, as far as these are known."""
        return {
            key: Toothed(self.label(key), count, key, self.is_internal(key))
            for key, count in (teeth or self.known()).items()
        }

    def meshes(self, teeth: Teeth | None = None) -> list[Mesh]:
        """What meshes, as far as the teeth are known."""
        wheels = self.wheels(teeth)
        return [Mesh(wheels[a], wheels[b]) for a, b in self.pairs if a in wheels and b in wheels]

    def is_hunting(self, teeth: Teeth) -> bool:
        """Whether every tooth meets every tooth."""
        return all(
            math.gcd(teeth[a], teeth[b]) == 1 for a, b in self.pairs if a in teeth and b in teeth
        )


class OfPlanets(Subject):
    """The teeth of an element with planets."""

    against = " against the carrier"

    @cached_property
    def given(self) -> AxisLayout:
        """The element as it stands."""
        return AxisLayout(self.element, group_of(self.element))

    @cached_property
    def space(self) -> Space:
        """Coaxial teeth."""
        group, element = self.given.group, self.element
        return space_of(group, [r for r in group.planet_of if element.rims or r in element.teeth])

    @cached_property
    def pairs(self) -> Sequence[tuple[Key, Key]]:
        """Wheels and rims, then rims of meshed planets."""
        group = self.given.group
        return [*((place, wheel.rim) for place, wheel in enumerate(group.wheels)), *group.meshes]

    def layout(self, teeth: Teeth | None = None) -> AxisLayout:
        """The element as it stands, or with other teeth."""
        if teeth is None:
            return self.given
        return AxisLayout(self.element, with_teeth(self.given.group, teeth))

    def known(self) -> Teeth:
        """Teeth of the central wheels, and of the rims where they are told."""
        group = self.given.group
        known: dict[Key, int] = {place: wheel.teeth for place, wheel in enumerate(group.wheels)}
        for rim in group.planet_of:
            count = self.given.teeth(rim)
            if count is not None and count.denominator == 1 and count > 0:
                known[rim] = int(count)
        return known

    def is_internal(self, key: Key) -> bool:
        """Whether it is a ring."""
        return isinstance(key, int) and self.given.group.wheels[key].internal

    def label(self, key: Key) -> str:
        """Its member, or what it is and its name."""
        return self.given.label(key if isinstance(key, str) else self.given.group.wheels[key])

    def ratios(self, teeth: Teeth) -> list[Fraction]:
        """The ratios between central wheels, the carrier held."""
        group = self.layout(teeth).group
        return [group.ratio(*pair) for pair in ratio_pairs(group)]


class OfWheels(Subject):
    """The teeth of a pair of wheels, of an idler, of a bevel differential."""

    @cached_property
    def shape(self) -> Simple:
        """The kind of the element."""
        shape = self.element.shape
        if not isinstance(shape, Simple):
            raise TypeError(self.element.kind)
        return shape

    @cached_property
    def names(self) -> list[str]:
        """What has teeth, in the order of the meshes."""
        return [name for name in self.shape.toothed if name in self.element.teeth]

    @cached_property
    def space(self) -> Space:
        """Any teeth."""
        given: Teeth = {name: int(self.element.teeth[name]) for name in self.names}
        ratio: Teeth = {self.names[0]: -1, self.names[-1]: 1}
        return Space(given, given, [{name: 1} for name in given], [ratio])

    @cached_property
    def pairs(self) -> Sequence[tuple[Key, Key]]:
        """Each with the next one, unless an idler's teeth are not told.

        Not those of a bevel differential, which hardly turn.
        """
        if self.element.kind == "bevel":
            return []
        names = sorted(self.names, key=self.is_internal, reverse=True)
        return [*pairwise(names)] if len(names) == len(self.shape.toothed) else []

    def known(self) -> Teeth:
        """All that are given."""
        return self.space.given

    def is_internal(self, key: Key) -> bool:
        """Whether it is the larger wheel of an internal pair."""
        given = self.space.given
        return self.element.kind == "internal_pair" and given[key] == max(given.values())

    def ratios(self, teeth: Teeth) -> list[Fraction]:
        """The ratio of its first to its last wheel."""
        return [self.shape.sign * Fraction(teeth[self.names[-1]], teeth[self.names[0]])]


def suggested(subject: Subject, found: Iterator[Teeth], what: str) -> str:
    """The first two of some teeth in words: ``; nearest that fit: ...``; or nothing."""
    texts = []
    for teeth in islice(found, 2):
        given = subject.space.given
        keys = [key for key in given if len(given) <= FEW_WHEELS or teeth[key] != given[key]]
        names = ", ".join(f"{subject.label(key)} {teeth[key]}" for key in keys)
        ratios = [f"{float(ratio):.5g}" for ratio in subject.ratios(teeth)]
        word = "ratios" if len(ratios) > 1 else "ratio"
        texts.append(f"{names} ({word} {', '.join(ratios)})")
    return f"; nearest {what}: {' or '.join(texts)}" if texts else ""
