"""Messages about directions of power: none, several, or reversed by losses."""

from __future__ import annotations

from collections.abc import Iterator

from vstatics.core.errors import spoken
from vstatics.core.model.parts import OfLoad
from vstatics.core.numerics.traced import Number
from vstatics.core.statics import ideal, matrix, torques
from vstatics.core.statics.result_arrays import Message
from vstatics.core.statics.results import Results
from vstatics.core.statics.status import DRAGGED, LOCKED


def loss_messages(results: Results, number: int) -> Iterator[Message]:
    """Report losses that stop, reverse or do not determine the flow of power."""
    case = results.case
    if results.locked[number]:
        if driving := list(driving_messages(results, number)):
            yield from driving
            return
        way = " when coasting" if case.coasts(case.gears[number]) else ""
        yield Message(
            "W421",
            f"{LOCKED.english}{way}: no direction of power flow is consistent with the losses",
        )
    elif results.dragged[number]:
        yield Message("W422", f"{DRAGGED.english}: {DRAGGED.meaning}")
    elif results.undecided[number]:
        yield Message(
            "W423",
            "the search for directions of power that are consistent with the losses ended early, "
            "so torques with losses and efficiency are unknown",
        )
    elif not results.consistent[number] and results.calculable[number]:
        yield Message(
            "W424",
            "statics does not determine all directions of power flow; with losses, only the values "
            "that do not depend on them are shown",
        )
    turns = zip(case.mechanisms, results.turned[number], strict=True)
    turned = [mechanism.name for mechanism, mark in turns if mark]
    if turned:
        yield Message("N411", f"losses reverse the power flow through {spoken(turned)}")
    if results.choices[number] > 1:
        yield Message(
            "N412",
            f"{results.choices[number]} sets of power directions are consistent with the losses; "
            "the set with the largest efficiency is shown",
        )


def driving_messages(results: Results, number: int) -> Iterator[Message]:
    """Report slipping shift elements that would produce power, so that no torques exist."""
    case, state = results.case, results.gear_at(number)
    if not state.gear.slipping:
        return
    slips: list[Number] = [
        state.gear.slip.get(n, 0.0) for n in range(1, len(case.shift_elements) + 1)
    ]
    ideal_gear = state.ideal._replace(speeds=state.ideal.speeds._replace(slips=slips))
    columns, drag = matrix.columns(case, state.trial_ratios), torques.NO_DRAG
    if results.locked[number]:
        columns, drag = matrix.columns(case, state.lossy_ratios), state.drag
    solved = torques.solve_torques(case, state.gear, columns, drag)
    pumps = dict.fromkeys(state.gear.pump_torques, 0.0)
    unloaded = torques.solve_torques(case, state.gear._replace(pump_torques=pumps), columns, drag)
    without_pumps = ideal.driving(ideal_gear, columns, unloaded)
    for element in ideal.driving(ideal_gear, columns, solved):
        slip = state.gear.slip[element]
        # In a driving cycle the solver's input is the wheels, so slip is relative to their speed.
        given = slip.given if isinstance(slip, OfLoad) else slip
        size = f"{given:g} times the speed of {case.link_name(case.gear_input(state.gear))}"
        if isinstance(slip, OfLoad):
            size = f"{given:g} rpm"
        where = "below 0" if given > 0 else "above 0"
        if element not in without_pumps:
            where = "nearer to 0"
        yield Message(
            "W438",
            f"with a slip of {size}, {case.shift_elements[element - 1].name} would give power "
            f"instead of taking it, so there are no torques; only a slip {where} is possible",
        )
