"""What a found box is called: the gearbox that is built."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache
from typing import Any, NamedTuple

from vstatics.core.examples import example, example_files
from vstatics.synthesis.boxes.box import FoundBox
from vstatics.synthesis.boxes.chosen_gears import Engaged, equal_sets
from vstatics.synthesis.boxes.figures.built import built_box
from vstatics.synthesis.boxes.least_form import identity, least_forms

FAR_DECIMALS = 6
"""Ratios of sets that agree in so many are the same: they may be fitted."""


def known_name(box: FoundBox) -> str | None:
    """The name of the shipped case that a box is; of several that of the nearest ratios.

    It has the same scheme, the same elements, and engages in each of its gears what the case does
    in some gear; where several sets of elements give the ratio of a gear, one of these.

    Parameters
    ----------
    box : FoundBox
        In the form of `least_box`.

    Examples
    --------
    >>> from vstatics.synthesis.boxes.least_form import least_box
    >>> known_name(least_box(built_box(example("gm-6t70"))))
    'gm-6t70'
    """
    cases = _known().get(identity(box))
    if not cases:
        return None
    choices = equal_sets(box)
    same = [one for one in cases if all(not one.gears.isdisjoint(sets) for sets in choices)]
    return min((one.rank(box.ratios) for one in same), default=(0.0, 0, None))[-1]


class _KnownBox(NamedTuple):
    """A shipped case as a box, in one of its forms."""

    name: str
    gears: frozenset[Engaged]
    ratios: tuple[float, ...]
    left_out: int
    """One-way clutches that the box has not."""

    def rank(self, ratios: tuple[float, ...]) -> tuple[float, int, str]:
        """The less the more it is a box of such ratios: how far its own are from them first."""
        pairs = zip(ratios, self.ratios, strict=True)
        far = math.fsum(abs(math.log(one / other)) for one, other in pairs)
        return round(far, FAR_DECIMALS), self.left_out, self.name


@cache
def _known() -> Mapping[tuple[Any, ...], list[_KnownBox]]:
    """The shipped cases that are boxes, by their identity."""
    found: dict[tuple[Any, ...], list[_KnownBox]] = {}
    for name in example_files():
        if "/" in name:  # a scenario
            continue
        case = example(name)
        box = built_box(case)
        for form in least_forms(box) if box else ():
            left_out = len(case.shift_elements) - len(form.elements)
            own = _KnownBox(name, frozenset(form.gears), form.ratios, left_out)
            found.setdefault(identity(form), []).append(own)
    return found
