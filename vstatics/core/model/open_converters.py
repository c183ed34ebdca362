"""Conversion of converters among the mechanisms to converters that slip freely."""

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
    """Return a case with all torque converters moved from `mechanisms` to `converters`.

    Raises
    ------
    CaseError
        If a converter has no lambda.
    """
    if faults := list(without_lambda(case)):
        raise CaseError(faults)
    mechanisms = case.mechanisms[case.own_mechanisms]
    remaining = [part for part in mechanisms if part.kind != "converter"]
    if len(remaining) == len(mechanisms):
        return case
    moved = [
        Converter(part.name, part.first, part.second, part.points)
        for part in mechanisms
        if part.kind == "converter"
    ]
    others = [part.name for part in case.converters]
    before = [*(part.name for part in mechanisms), *others]
    after = [*(part.name for part in remaining), *others, *(part.name for part in moved)]
    numbers = {number: after.index(name) + 1 for number, name in enumerate(before, 1)}
    gears = [gear.renumbered(numbers) for gear in case.gears]
    return with_mechanisms(case, remaining, gears=gears, converters=[*case.converters, *moved])


def with_needed_ratios(case: Transmission) -> Transmission:
    """Return the case, with all converters moved to `converters` if any lacks a speed ratio.

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


def with_mechanisms(
    case: Transmission, mechanisms: Sequence[Mechanism], **changes: Any
) -> Transmission:
    """Return a case with other mechanisms in addition to gear sets, and with further changes."""
    if case.drawing is None:
        return case.replace(mechanisms=mechanisms, **changes)
    drawing: Any = case.drawing
    return case.replace(drawing=replace(drawing, mechanisms=tuple(mechanisms)), **changes)


def without_lambda(case: Transmission) -> Iterator[Problem]:
    """Yield errors for converters whose torque is unknown because lambda is missing."""
    for number, mechanism in enumerate(case.mechanisms, 1):
        if mechanism.kind == "converter" and not mechanism.can_be_open:
            message = (
                f"{mechanism.name} has no lambda, so its torque is not known: expected points "
            )
            yield Problem("E698", f"{message}[i, K, lambda]", ("mechanisms", number, "points"))
