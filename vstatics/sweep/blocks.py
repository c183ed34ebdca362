"""A part of a sweep of a case: from a plan and two numbers of variants to the rows between.

Everything is calculated in blocks, so that the results of a block stay in tens of megabytes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from vstatics.model.transmission import Transmission
from vstatics.numerics.arrays import Booleans, Floats
from vstatics.statics.gear_steps import spread, steps
from vstatics.statics.results import Results
from vstatics.statics.solve import solve
from vstatics.sweep.chunk import (
    CONFLICT,
    DRAGGED,
    INVALID,
    LOCKED,
    OPEN,
    TIED_UP,
    UNDECIDED,
    Chunk,
    Codes,
    joined,
    rows_of,
)
from vstatics.sweep.frequencies import OMEGA, Frequencies, frequencies
from vstatics.sweep.kept.meanings import SPREAD, STEP
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.variants.path_numbers import CasePath
from vstatics.sweep.variants.targets import (
    OF_MECHANISM,
    OfMechanism,
    Target,
    Varied,
    impossible,
    own_number,
)


class BlockTables(NamedTuple):
    """The tables of a block of variants: of statics, and natural frequencies."""

    results: Results | None
    modes: Frequencies | None

    def existing(self, name: str) -> Floats:
        """A table by its name, one of those that the plan asks for."""
        if name == OMEGA and self.modes is not None:
            return self.modes.omegas
        assert self.results is not None  # noqa: S101 - the plan has looked
        if name == STEP:
            return steps(self.results.case, self.results.ratio)
        if name == SPREAD:
            return spread(self.results.case, self.results.ratio)[..., np.newaxis]
        return self.results.existing(name)


def possible_numbers(
    case: Transmission, targets: Sequence[Varied], values: Floats
) -> tuple[Floats, Booleans]:
    """The varied numbers, with the case's own in place of impossible ones, and who has these."""
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
    """Which values can't be, and what stands in for them."""
    if isinstance(target, Target):
        own = own_number(case, target.owner, target.quantity)
        return impossible(target.quantity, given), own
    assert isinstance(target, CasePath)  # noqa: S101 - a case has no other
    return target.impossible(given), 1.0


def block_tables(plan: SweepPlan, values: Floats) -> BlockTables:
    """What the plan asks for, of varied numbers that are possible."""
    case, targets, asked = plan.case, plan.targets, plan.modes
    results = modes = None
    own = values if len(targets) == values.shape[1] else values[:, plan.places]
    if plan.asks_for_results and len(targets) < values.shape[1]:
        results = solve(case, vary=_by_path(plan, values))
    elif plan.asks_for_results:
        numbers = _of_mechanisms(case, targets, values)
        results = solve(case, ratios=numbers.get("ratio"), efficiencies=numbers.get("efficiency"))
    if asked:
        first, _ = possible_numbers(case, plan.variants.targets, plan.variants.block(0, 1))
        modes = frequencies(case, targets, own, asked, first[:, plan.places])
    return BlockTables(results, modes)


def _by_path(plan: SweepPlan, values: Floats) -> dict[str, Floats]:
    """What `vstatics.solve` varies, by paths in SI."""
    found: dict[str, Floats] = {}
    for target, column in zip(plan.variants.targets, values.T, strict=True):
        if isinstance(target, CasePath):
            found[target.path] = target.in_si(column)
        elif isinstance(target, Target) and target.quantity in OF_MECHANISM:
            name = plan.case.mechanisms[target.owner].name
            found[f"{name}.{target.quantity}"] = column
    return found


def _of_mechanisms(
    case: Transmission, targets: Sequence[Target], values: Floats
) -> dict[OfMechanism, Floats]:
    """What `vstatics.solve` takes of a block, (variants, mechanisms): each one's lie together."""
    varied = {target.quantity for target in targets}
    numbers: dict[OfMechanism, Floats] = {}
    for quantity in OF_MECHANISM:
        if quantity in varied or (quantity == "ratio" and not varied & set(OF_MECHANISM)):
            table = np.empty((len(case.mechanisms), len(values)))
            table.T[:] = [getattr(mechanism, quantity) for mechanism in case.mechanisms]
            numbers[quantity] = table.T
    for column, target in enumerate(targets):
        if target.quantity in OF_MECHANISM:
            numbers[target.quantity][:, target.owner] = values[:, column]
    return numbers


MEASURED_RUNS = 8
"""So many runs tell how long all of them take."""
BLOCK_BYTES = 32 * 2**20
LEAST_BLOCK, MOST_BLOCK = 256, 16384


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
        With a row for each variant that passed the plan's condition.
    """
    if not isinstance(plan.subject, Transmission):
        from vstatics.sweep.runs import calculate as of_runs  # others need no simulation

        return of_runs(plan, plan.subject, start, stop)
    own = solve(plan.case) if plan.asks_for_results else None
    return joined([_block(plan, own, *ends) for ends in blocks(plan.case, start, stop)])


def middle(plan: SweepPlan) -> tuple[int, int]:
    """The ends of a block in the middle of a sweep, by which the whole is estimated."""
    start, stop = plan.span(plan.pieces // 2)
    if not isinstance(plan.subject, Transmission):
        return start, min(stop, start + MEASURED_RUNS)
    ends = list(blocks(plan.subject, start, stop))
    return ends[len(ends) // 2]


def blocks(case: Transmission, start: int, stop: int) -> Iterator[tuple[int, int]]:
    """The ends of the blocks of a part, of nearly equal size."""
    most = min(max(BLOCK_BYTES // variant_bytes(case), LEAST_BLOCK), MOST_BLOCK)
    number = -(-(stop - start) // most)
    ends = [start + (stop - start) * block // number for block in range(number + 1)]
    return pairwise(ends)


def variant_bytes(case: Transmission) -> int:
    """About how much memory the results of a variant take."""
    elements, mechanisms = len(case.shift_elements), len(case.mechanisms)
    numbers = 3 * case.links + 3 * elements + 5 * mechanisms + 2 * len(case.springs) + 11
    return len(case.gears) * (8 * numbers + elements + 2 * mechanisms + 6)


def _block(plan: SweepPlan, own: Results | None, start: int, stop: int) -> Chunk:
    """The rows of a block."""
    values = plan.variants.block(start, stop)
    possible, invalid = possible_numbers(plan.case, plan.variants.targets, values)
    tables = block_tables(plan, possible)
    status = _status(tables, own, plan, len(values))
    status[invalid] = INVALID
    return rows_of(plan, start, values, status, tables, invalid)


def _status(tables: BlockTables, own: Results | None, plan: SweepPlan, variants: int) -> Codes:
    """The worst that can be said of the gears of each variant, or of each gear.

    Whole arrays are asked first: most often nothing is to be said of any variant. Where modes
    alone are asked for it is said of the gears that are asked for, together.
    """
    by_gear = plan.by_gear
    status = np.zeros((variants, len(plan.gears)) if by_gear else variants, dtype=np.uint8)
    results, modes = tables
    if results is None or own is None:
        if modes is not None:
            status[modes.tied_up] = TIED_UP
            status[modes.conflict] = CONFLICT
        return status
    unlike = ((results.missing > 0) & (own.missing == 0), ~results.balanced & own.balanced)
    for code, said in (
        (DRAGGED, results.dragged),
        *((OPEN, wrong) for wrong in unlike),
        (UNDECIDED, results.undecided),
        (LOCKED, results.locked),
        (TIED_UP, results.tied_up),
        (CONFLICT, results.conflict),
    ):
        if said.any():
            status[said if by_gear else said.any(axis=1)] = code
    return status
