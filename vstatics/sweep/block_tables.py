"""What is calculated of a block of variants: the tables that a plan asks for, and no others."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats
from vstatics.statics.results import Results
from vstatics.statics.solve import solve
from vstatics.sweep.frequencies import OMEGA, Frequencies, frequencies
from vstatics.sweep.variants.targets import (
    OF_MECHANISM,
    OfMechanism,
    Target,
    impossible,
    own_number,
)

if TYPE_CHECKING:
    from vstatics.model.transmission import Transmission
    from vstatics.sweep.plan import SweepPlan


class BlockTables(NamedTuple):
    """The tables of a block of variants: of statics, and natural frequencies."""

    results: Results | None
    modes: Frequencies | None

    def existing(self, name: str) -> Floats:
        """A table by its name, one of those that the plan asks for."""
        if name == OMEGA and self.modes is not None:
            return self.modes.omegas
        assert self.results is not None  # noqa: S101 - the plan has looked
        return self.results.existing(name)


def possible_numbers(
    case: Transmission, targets: Sequence[Target], values: Floats
) -> tuple[Floats, Booleans]:
    """The varied numbers, with the case's own in place of impossible ones, and who has these."""
    invalid = np.zeros(len(values), dtype=np.bool_)
    possible = values
    for column, target in enumerate(targets):
        wrong = impossible(target.quantity, values[:, column])
        if wrong.any():
            possible = values.copy(order="F") if possible is values else possible
            possible[wrong, column] = own_number(case, target.owner, target.quantity)
            invalid |= wrong
    return possible, invalid


def block_tables(plan: SweepPlan, values: Floats) -> BlockTables:
    """What the plan asks for, of varied numbers that are possible."""
    case, targets, asked = plan.case, plan.targets, plan.modes
    results = modes = None
    if plan.asks_for_results:
        numbers = _of_mechanisms(case, targets, values)
        results = solve(case, ratios=numbers.get("ratio"), efficiencies=numbers.get("efficiency"))
    if asked:
        first, _ = possible_numbers(case, targets, plan.variants.block(0, 1))
        modes = frequencies(case, targets, values, asked, first)
    return BlockTables(results, modes)


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
