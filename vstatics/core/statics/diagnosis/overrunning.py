"""Freewheels that overrun in a gear that they could drive, with remedies."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from vstatics.core.errors import plural, spoken
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.traced import is_nan
from vstatics.core.statics import freewheels, matrix
from vstatics.core.statics.result_arrays import Message
from vstatics.core.statics.results import Results
from vstatics.core.statics.speeds import solve_speeds
from vstatics.core.statics.state import GearState


def missed_freewheels(results: Results, number: int, gear: Gear) -> list[int]:
    """Return the numbers of freewheels that would drive the output if engaged."""
    case = results.case
    output = case.gear_output(gear) - 1
    free = [n for n in case.freewheels if n not in gear.engaged]
    rows = matrix.rows(case, results.gear_at(number).trial_ratios)

    def drives(*held: int) -> bool:
        speeds = solve_speeds(case, freewheels.with_engaged(gear, held), rows)
        return speeds.consistent and not is_nan(speeds.links[output])

    chosen = [n for n in free if math.isnan(results.slip_speeds[number, n - 1]) and drives(n)]
    return chosen or [*free] * drives(*free)


def overrunning(case: Transmission, state: GearState, numbers: Sequence[int]) -> tuple[str, str]:
    """Return a clause about overrunning freewheels, and advice to swap links if that helps."""
    if not numbers:
        return "", ""
    names = [element.name for element in case.elements_at(numbers)]
    verb = "overruns" if len(names) == 1 else "overrun"
    exchanged: list[tuple[str, str]] = []
    for number in freewheels.in_wrong_order(state, numbers):
        element = case.shift_elements[number - 1]
        links = ", ".join(map(case.link_name, (element.second, element.first)))
        exchanged.append((element.name, f"[{links}]"))
    why = f", because {plural('freewheel', len(names))} {spoken(names)} {verb}"
    if not exchanged:
        return why, ""
    wrong, right = map(spoken, zip(*exchanged, strict=True))
    return why, (
        f"; if the links of {wrong} are in the wrong order, write {right}: then the gear can drive"
    )


def sharing_freewheels(case: Transmission, gear: Gear, held: Sequence[int]) -> Iterator[Message]:
    """Warn of freewheels that could hold instead of others, which leaves torques unknown."""
    others = freewheels.alternatives(case, gear, held)
    if others:
        holding, able_to_hold = (
            [case.shift_elements[number - 1].name for number in numbers]
            for numbers in (held, others)
        )
        yield Message(
            "W411",
            f"{plural('freewheel', len(able_to_hold))} {spoken(able_to_hold)} could hold instead "
            f"of {spoken(holding)}, so their torques are indeterminate; the torques with "
            f"{spoken(holding)} are shown",
        )
