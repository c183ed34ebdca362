"""Calculation of a range of variants of a case, block by block.

The size of a block is chosen so that its results take tens of megabytes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple, Protocol, TypeAlias, TypeVar

import numpy as np

from vstatics.core.elements.part_numbers import PartNumber, is_assembled, with_part_numbers
from vstatics.core.errors import CaseError, Problem
from vstatics.core.extras import higher
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.statics.matrix import expected_ratio
from vstatics.core.statics.points.parts import alike_rows
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.sweep import runs
from vstatics.sweep.chunk import (
    CONFLICT,
    DRAGGED,
    INVALID,
    LOCKED,
    NOT_ASSEMBLED,
    OPEN,
    TIED_UP,
    UNDECIDED,
    Chunk,
    Codes,
    joined,
    rows_of,
)
from vstatics.sweep.gear_steps import spread, steps
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.results.meanings import OMEGA, PART_NUMBERS, SPREAD, STEP
from vstatics.sweep.variants.path_numbers import CasePath
from vstatics.sweep.variants.targets import OF_MECHANISM, Target, Varied, impossible, own_number

Chosen: TypeAlias = Integers | slice
"""Indices of variants in a block."""
Made: TypeAlias = tuple[Chosen, Transmission | None]
"""Indices of variants in a block, and the case for calculating the variants.

None represents an impossible case.
"""
Array = TypeVar("Array", Floats, Codes)

MEASURED_RUNS = 8
"""Number of runs whose time is measured to estimate the time of all runs."""
BLOCK_BYTES = 32 * 2**20
LEAST_BLOCK, MOST_BLOCK = 256, 16384


class Frequencies(Protocol):
    """Natural frequencies of variants, which the annex of torsional vibration calculates."""

    @property
    def omegas(self) -> Floats:
        """Natural frequencies of each variant, gear and mode [rad/s]."""

    @property
    def tied_up(self) -> Booleans:
        """Mask of the variants with a gear that cannot rotate, shape (variants,)."""

    @property
    def conflict(self) -> Booleans:
        """Mask of the variants with contradictory freewheels, shape (variants,)."""


class BlockTables(NamedTuple):
    """Tables of a block of variants: results of statics, and natural frequencies."""

    results: Results | None
    modes: Frequencies | None
    numbers: Mapping[str, Floats]
    """Numbers of mechanisms for each name in `PART_NUMBERS`, shape (variants, 1, mechanisms). [-]
    """

    def existing(self, name: str) -> Floats:
        """Return a calculated table by name."""
        if name == OMEGA and self.modes is not None:
            return self.modes.omegas
        if name in self.numbers:
            return self.numbers[name]
        assert self.results is not None  # noqa: S101 - calculated if the plan uses any such table
        if name == STEP:
            return steps(self.results.case, self.results.ratio)
        if name == SPREAD:
            return spread(self.results.case, self.results.ratio)[..., np.newaxis]
        return self.results.existing(name)


class OfCases(NamedTuple):
    """Tables of a block, calculated separately for groups of variants."""

    places: list[Chosen]
    """For each group, the indices of its variants within the block."""
    parts: list[BlockTables]

    def existing(self, name: str) -> Floats:
        """Return the table called `name` for the whole block, in the order of the variants."""
        return _in_order(self.places, [part.existing(name) for part in self.parts])

    @property
    def outside(self) -> tuple[str, ...]:
        """Names of characteristic curves that were evaluated outside the given points."""
        names = (
            name
            for part in self.parts
            if part.results and part.results.points
            for name in part.results.points.outside
        )
        return tuple(dict.fromkeys(names))


def calculate(plan: SweepPlan, start: int, stop: int) -> Chunk:
    """Calculate the variants from `start` up to `stop`, of a case or of a scenario.

    Parameters
    ----------
    plan : SweepPlan
    start, stop : int
        Numbers of variants, from 0; `stop` is not included.

    Returns
    -------
    Chunk
        Chunk with a row for each variant that passed the condition of the plan.
    """
    if not isinstance(plan.subject, Transmission):
        return runs.calculate(plan, plan.subject, start, stop)
    unvaried = solve(plan.case) if plan.asks_for_results else None
    return joined([_block(plan, unvaried, *ends) for ends in blocks(plan.case, start, stop)])


def blocks(case: Transmission, start: int, stop: int) -> Iterator[tuple[int, int]]:
    """Return the first variant and the end of each block of a range. Blocks are nearly equal."""
    most = min(max(BLOCK_BYTES // variant_bytes(case), LEAST_BLOCK), MOST_BLOCK)
    number = -(-(stop - start) // most)
    ends = [start + (stop - start) * block // number for block in range(number + 1)]
    return pairwise(ends)


def variant_bytes(case: Transmission) -> int:
    """Return the approximate size of the results of a variant [bytes]."""
    elements, mechanisms = len(case.shift_elements), len(case.mechanisms)
    numbers = 3 * case.links + 3 * elements + 5 * mechanisms + 2 * len(case.springs) + 11
    return len(case.gears) * (8 * numbers + elements + 2 * mechanisms + 6)


def _block(plan: SweepPlan, unvaried: Results | None, start: int, stop: int) -> Chunk:
    values = plan.variants.block(start, stop)
    possible, invalid = possible_numbers(plan.case, plan.variants.targets, values)
    cases = [*_cases(plan, possible)]
    tables, statuses = OfCases([], []), []
    for chosen, case, others in _groups(plan, cases):
        of_group = block_tables(plan, case, possible[chosen], others)
        tables.places.append(chosen)
        tables.parts.append(of_group)
        statuses.append(_status(of_group, unvaried, plan, len(possible[chosen])))
    status = _in_order(tables.places, statuses)
    parts = [path.part for path in plan.parts.values() if path.part]
    for chosen, other_case in cases:
        if other_case is None:
            invalid[chosen] = True
        elif not is_assembled(other_case, parts):
            status[chosen] = np.maximum(status[chosen], NOT_ASSEMBLED)
    status[invalid] = INVALID
    return rows_of(plan, start, values, status, tables, invalid)._replace(outside=tables.outside)


def possible_numbers(
    case: Transmission, targets: Sequence[Varied], values: Floats
) -> tuple[Floats, Booleans]:
    """Return the varied numbers with impossible values replaced, and a mask of these variants."""
    invalid = np.zeros(len(values), dtype=np.bool_)
    possible = values
    for column, target in enumerate(targets):
        given = values[:, column]
        wrong, stands_in = _wrong(case, target, given)
        if wrong.any():
            possible = values.copy(order="F") if possible is values else possible
            possible[wrong, column] = stands_in
            invalid |= wrong
    return possible, invalid


def _wrong(case: Transmission, target: Varied, given: Floats) -> tuple[Booleans, float]:
    """Return a mask of impossible values, and a possible value as a replacement."""
    if isinstance(target, Target):
        value = own_number(case, target.owner, target.quantity)
        between = [case.ratio_range(target.owner)] if target.quantity == "ratio" else []
        return impossible(target.quantity, given, *between), value
    assert isinstance(target, CasePath)  # noqa: S101 - a case has only these two kinds of targets
    return target.impossible(given), 1.0


def _cases(plan: SweepPlan, values: Floats) -> Iterator[Made]:
    """Yield groups of variants that share a case, each with the shared case.

    None represents an impossible case.
    """
    paths = plan.parts
    if not paths:
        yield slice(None), plan.case
        return
    in_si = np.column_stack([path.in_si(values[:, n]) for n, path in paths.items()])
    parts = [path.part for path in paths.values() if path.part]
    for places, row in alike_rows(in_si):
        chosen = slice(None) if len(places) == len(values) else places
        try:
            yield chosen, with_part_numbers(plan.case, parts, row)
        except CaseError:
            yield chosen, None


def _groups(
    plan: SweepPlan, cases: Sequence[Made]
) -> Iterator[tuple[Chosen, Transmission, Sequence[Made]]]:
    """Yield groups of variants that are solved together, each with the case.

    Variants whose cases differ only in ratios and efficiencies form one group, unless the plan uses
    planet speeds or natural frequencies, which need further numbers of each case.
    """
    efficiencies = [mechanism.back_efficiency for mechanism in plan.case.mechanisms]
    of_each_case = plan.tables & {OMEGA, "planet_speeds", "planet_speeds_rpm"}
    if (
        len(cases) == 1
        or of_each_case
        or any(path.of for path in plan.paths)
        or any(
            [m.back_efficiency for m in other_case.mechanisms] != efficiencies
            for _, other_case in cases
            if other_case
        )
    ):
        yield from ((chosen, other_case or plan.case, ()) for chosen, other_case in cases)
    else:
        yield slice(None), plan.case, cases


def block_tables(
    plan: SweepPlan, case: Transmission, values: Floats, cases: Sequence[Made]
) -> BlockTables:
    """Return the tables that a plan uses, for variants of a case whose values are possible.

    For variants in `cases`, the ratios and efficiencies of their own case replace those of `case`.
    """
    results = modes = None
    paths = _by_path(plan, values)
    if plan.asks_for_results and paths:
        results = solve(case, vary=paths)
    elif plan.asks_for_results:
        numbers = _of_mechanisms(case, plan, values, cases)
        results = solve(case, ratios=numbers.get("ratio"), efficiencies=numbers.get("efficiency"))
    if asked := plan.modes:
        first, _ = possible_numbers(case, plan.variants.targets, plan.variants.block(0, 1))
        of_targets, first_of_targets = values[:, plan.places], first[:, plan.places]
        modes = higher("frequencies", OMEGA)(
            case, plan.targets, of_targets, asked, first_of_targets
        )
    numbers_by_table = {
        table: _numbers_of(case, plan, values, cases, quantity)[:, np.newaxis]
        for quantity, table in PART_NUMBERS.items()
        if table in plan.tables
    }
    return BlockTables(results, modes, numbers_by_table)


def _by_path(plan: SweepPlan, values: Floats) -> dict[str, Floats]:
    """Return the varied numbers that `vstatics.solve` accepts by path, in SI units."""
    numbers: dict[str, Floats] = {}
    of_solve = [path for path in plan.paths if path.of]
    for target, column in zip(plan.variants.targets, values.T, strict=True):
        if target in of_solve:
            numbers[target.solved] = target.in_si(column)
        elif of_solve and isinstance(target, Target) and target.quantity in OF_MECHANISM:
            name = plan.case.mechanisms[target.owner].name
            numbers[f"{name}.{target.quantity}"] = column
    return numbers


def _of_mechanisms(
    case: Transmission, plan: SweepPlan, values: Floats, cases: Sequence[Made]
) -> dict[str, Floats]:
    """Return the varied ratios or efficiencies of mechanisms by quantity, or else the ratios."""
    varied = {target.quantity for target in plan.targets} & {*OF_MECHANISM}
    asked = OF_MECHANISM if cases else varied or {"ratio"}
    return {quantity: _numbers_of(case, plan, values, cases, quantity) for quantity in asked}


def _numbers_of(
    case: Transmission, plan: SweepPlan, values: Floats, cases: Sequence[Made], quantity: str
) -> Floats:
    table = np.empty((len(case.mechanisms), len(values)))
    table.T[:] = [getattr(mechanism, quantity) for mechanism in case.mechanisms]
    for chosen, other_case in cases:
        if other_case:
            table.T[chosen] = [getattr(mechanism, quantity) for mechanism in other_case.mechanisms]
    for column, target in enumerate(plan.variants.targets):
        if isinstance(target, Target) and target.quantity == quantity:
            table[target.owner] = values[:, column]
        elif isinstance(target, CasePath) and target.quantity == quantity:
            table[[number.owner for number in target.of]] = values[:, column]
    return table.T


def _status(tables: BlockTables, unvaried: Results | None, plan: SweepPlan, variants: int) -> Codes:
    """Return the worst status over the gears that the plan uses, or the status of each gear.

    Whole arrays are tested first, because most variants are ok. If the plan only uses natural
    frequencies, their calculation gives the status.
    """
    by_gear = plan.by_gear
    status = np.zeros((variants, len(plan.gears)) if by_gear else variants, dtype=np.uint8)
    results, modes = tables.results, tables.modes
    if results is None or unvaried is None:
        if modes is not None:
            status[modes.tied_up] = TIED_UP
            status[modes.conflict] = CONFLICT
        return status
    asked = plan.asked_gears
    for code, affected in (
        (DRAGGED, results.dragged),
        (OPEN, (results.missing > 0) & (unvaried.missing == 0)),
        (OPEN, ~results.balanced & unvaried.balanced),
        (UNDECIDED, results.undecided),
        (LOCKED, results.locked),
        (TIED_UP, results.tied_up),
        (CONFLICT, results.conflict),
    ):
        if affected.any():
            status[affected if by_gear else affected[:, asked].any(axis=1)] = code
    return status


def _in_order(places: Sequence[Chosen], arrays: Sequence[Array]) -> Array:
    if len(arrays) == 1:
        return arrays[0]
    order = np.argsort(np.concatenate([np.asarray(indices) for indices in places]))
    whole: Array = np.concatenate(arrays)[order]
    return whole


def middle(plan: SweepPlan) -> tuple[int, int]:
    """Return the range of variants of a block in the middle of a sweep, for estimates."""
    start, stop = plan.span(plan.pieces // 2)
    if not isinstance(plan.subject, Transmission):
        return start, min(stop, start + MEASURED_RUNS)
    ends = list(blocks(plan.subject, start, stop))
    return ends[len(ends) // 2]


def reason(plan: SweepPlan) -> list[Problem]:
    """Return the reasons why the case of the first variant is impossible, if any."""
    values = plan.variants.block(0, 1)
    for n, varied in enumerate(plan.variants.targets):
        if isinstance(varied, Target) and varied.quantity == "ratio":
            between = plan.case.ratio_range(varied.owner)
            if impossible("ratio", values[:, n], between).any():
                message = f"read {values[0, n]:g} in variant 0, expected {expected_ratio(between)}"
                return [Problem("E415", message, (varied.name,))]
    numbers: dict[PartNumber, float] = {}
    for n, path in plan.parts.items():
        given = path.in_si(values[:, n])
        if path.part and path.part.impossible(given).any():
            message = f"read {given[0]:g} in variant 0, expected {path.part.expected}"
            return [Problem("E415", message, (path.path,))]
        if path.part:
            numbers[path.part] = float(given[0])
    try:
        with_part_numbers(plan.case, [*numbers], [*numbers.values()])
    except CaseError as error:
        return error.problems
    return []
