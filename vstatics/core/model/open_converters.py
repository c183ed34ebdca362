"""Converters that are mechanisms, at a speed ratio that is given, and by themselves, open."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from vstatics.core.errors import CaseError, Problem
from vstatics.core.model.converters import Converter
from vstatics.core.model.part_checks import of_missing_ratios
from vstatics.core.model.parts import Mechanism
from vstatics.core.model.transmission import Transmission


def with_open_converters(case: Transmission) -> Transmission:
    """A case whose mechanisms that are converters are `converters` instead.

    Raises
    ------
    CaseError
        If one has no lambda.
    """
    if faults := list(without_lambda(case)):
        raise CaseError(faults)
    own = case.mechanisms[case.own_mechanisms]
    kept = [one for one in own if one.kind != "converter"]
    if len(kept) == len(own):
        return case
    moved = [
        Converter(one.name, one.first, one.second, one.points)
        for one in own
        if one.kind == "converter"
    ]
    others = [one.name for one in case.converters]
    before = [*(one.name for one in own), *others]
    after = [*(one.name for one in kept), *others, *(one.name for one in moved)]
    gears = []
    for gear in case.gears:
        ratios = {before[n - 1]: ratio for n, ratio in gear.speed_ratios.items()}
        numbers = {after.index(name) + 1: ratio for name, ratio in ratios.items()}
        gears.append(gear._replace(speed_ratios=numbers))
    return with_mechanisms(case, kept, gears=gears, converters=[*case.converters, *moved])


def with_needed_ratios(case: Transmission) -> Transmission:
    """The case, with all converters open if one of them lacks a speed ratio.

    Examples
    --------
    >>> from vstatics.core.model.parts import Gear
    >>> points = ((0, 2, 0.001), (1, 1, 0.0))
    >>> converter = Mechanism(1, 2, 0, float("nan"), name="TC", kind="converter", points=points)
    >>> case = with_needed_ratios(Transmission(2, [], [converter], [Gear()]))
    >>> len(case.mechanisms), len(case.converters)
    (0, 1)
    """
    lacks = any(of_missing_ratios(case, open_too=True))
    return with_open_converters(case) if lacks else case


def with_mechanisms(case: Transmission, own: Sequence[Mechanism], **changes: Any) -> Transmission:
    """A case with others in place of the mechanisms that it gives itself, and further changes."""
    if case.drawing is None:
        return case.replace(mechanisms=own, **changes)
    drawing: Any = case.drawing
    return case.replace(drawing=replace(drawing, mechanisms=tuple(own)), **changes)


def without_lambda(case: Transmission) -> Iterator[Problem]:
    """Mechanisms that are converters of which no torque is known."""
    for number, one in enumerate(case.mechanisms, 1):
        if one.kind == "converter" and not one.can_be_open:
            message = f"{one.name} has no lambda, so its torque is not known: expected points "
            yield Problem("E698", f"{message}[i, K, lambda]", ("mechanisms", number, "points"))
