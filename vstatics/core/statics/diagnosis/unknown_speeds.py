"""Messages about gears in which constraints on the speeds are missing."""

from __future__ import annotations

import math
from collections.abc import Iterator

from vstatics.core.errors import Problem, plural, spoken
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.statics import freewheels
from vstatics.core.statics.diagnosis.contradictions import (
    excess_messages,
    speed_ratios,
    with_open_converters,
)
from vstatics.core.statics.diagnosis.freedom import (
    is_adrift,
    is_for_motion,
    is_neutral,
    matrix_rows,
    without_value,
)
from vstatics.core.statics.diagnosis.overrunning import missed_freewheels, overrunning
from vstatics.core.statics.result_arrays import Message
from vstatics.core.statics.results import Results
from vstatics.core.statics.speeds import solve_speeds
from vstatics.core.statics.status import CONFLICT, NEUTRAL, TIED_UP
from vstatics.core.statics.torques import unknown_drag

NOTHING_HOLDS = "nothing supports the input torque"


def speed_messages(results: Results, number: int, gear: Gear) -> Iterator[Message]:
    """Report missing, redundant and contradictory constraints, and an output at rest."""
    case = results.case
    if results.conflict[number]:
        yield from _conflict_messages(case, gear)
        return
    missing, excess = int(results.missing[number]), int(results.excess[number])
    if results.tied_up[number] or excess:
        opened = with_open_converters(case, gear, speed_ratios(results, number, gear))
        conflicts = _conflict_messages(case, opened) if gear.slip else ()
        yield from list(conflicts) or excess_messages(results, number, gear)
    if missing and (unloaded := results.gear_at(number).unloaded):
        what = "turns freely and carries" if len(unloaded) == 1 else "turn freely and carry"
        yield Message(
            "N420", f"{plural('link', len(unloaded))} {spoken(unloaded)} {what} no torque"
        )
    elif missing and is_for_motion(case, gear):
        free = without_value(case.link_names, results.gear_at(number).speeds)
        what = "turns" if len(free) == 1 else "turn"
        named = f"{plural('link', len(free))} {spoken(free)} {what} freely"
        yield Message(
            "N420", f"{named}, because the case has no gears; a run calculates its speeds"
        )
    elif missing and not (gear.kind == "neutral" and is_neutral(results, number)):
        yield _too_free(results, number, gear, missing)
    output = case.gear_output(gear)
    if results.speeds[number, output - 1] == 0:
        name = case.link_name(output)
        yield Message("W415", f"the output, link {name}, is at rest, so the gear has no ratio")


def _too_free(results: Results, number: int, gear: Gear, missing: int) -> Message:
    """Return a warning that constraints are missing, so that the gear or a link is free."""
    case = results.case
    free = without_value(case.link_names, results.gear_at(number).speeds)
    named = f" ({plural('link', len(free))} {spoken(free)} can still turn freely)" if free else ""
    links = "" if results.tied_up[number] else named
    neutral = is_neutral(results, number)
    unheld = f"; {NOTHING_HOLDS}" if is_adrift(results, number) else ""
    over = missed_freewheels(results, number, gear) if neutral else []
    why, exchange = overrunning(case, results.gear_at(number), over)
    if neutral and (loose := _loose_ends(case, gear)):
        return Message("W414", f"{NEUTRAL.english}: {loose}")
    count = "one" if missing == 1 else str(missing)
    instead = " instead" * bool(results.tied_up[number])
    return Message(
        "W414",
        f"{f'{NEUTRAL.english}{why}: ' * bool(neutral)}"
        f"{count} more shift {plural('element', missing)} must be engaged{instead}"
        f"{', or a speed given' * bool(neutral)}{links}{unheld}{exchange}",
    )


def _loose_ends(case: Transmission, gear: Gear) -> str:
    """Return a clause about an input or output to which nothing is connected; empty otherwise."""
    ends = (("input", case.gear_input(gear)), ("output", case.gear_output(gear)))
    connected = case.connections
    loose = [
        f"the {end} (link {case.link_name(link)})" for end, link in ends if not connected[link]
    ]
    return f"no component is connected to {spoken(loose, 'or')}" if loose else ""


def undriven_gears(results: Results) -> Iterator[Problem]:
    """Yield an error for each gear that is neutral, but not marked `kind: neutral`.

    `run` only warns of such gears (W414), whereas `check` fails.

    Examples
    --------
    >>> from vstatics import Mechanism, solve
    >>> from vstatics.core.model.converters import Converter
    >>> fluid = Converter("TC", 1, 2, ((0.0, 2.0, 0.003), (1.0, 1.0, 0.0)))
    >>> case = Transmission(3, [], [Mechanism(2, 3, 0, 2.0)], [Gear()], converters=[fluid])
    >>> [problem] = undriven_gears(solve(case))
    >>> problem.message
    'cannot drive: ...; `converters` act only in vibration and scenarios: write TC under `mecha...'

    A converter whose links have known speeds is not the cause.

    >>> sets = [Mechanism(1, 2, 0, 1.0), Mechanism(3, 4, 0, 2.0)]
    >>> case = Transmission(4, [], sets, [Gear()], converters=[fluid])
    >>> [problem.message for problem in undriven_gears(solve(case))]
    ['cannot drive: expected another engaged shift element, or `kind: neutral`']
    """
    case = results.case
    for number, gear in enumerate(case.gears):
        if "W414" in case.untold or gear.kind == "neutral" or is_for_motion(case, gear):
            continue
        if is_neutral(results, number):
            over = missed_freewheels(results, number, gear)
            _, exchange = overrunning(case, results.gear_at(number), over)
            cure = exchange or ": expected another engaged shift element, or `kind: neutral`"
            speeds = [0.0, *results.speeds[number]]
            if separating := [
                converter.name
                for converter in case.converters
                if math.isnan(speeds[converter.pump]) != math.isnan(speeds[converter.turbine])
            ]:
                cure += "; `converters` act only in vibration and scenarios: "
                cure += f"write {spoken(separating)} under `mechanisms`"
            if loose := _loose_ends(case, gear):
                cure = f": {loose}"
            yield Problem("E453", f"cannot drive{cure}", ("gears", number + 1))


def _conflict_messages(case: Transmission, gear: Gear) -> Iterator[Message]:
    speeds = solve_speeds(case, gear, matrix_rows(case, gear))
    for number in freewheels.driven_backward(case, gear, speeds):
        name, slip = case.shift_elements[number - 1].name, speeds.slips[number - 1]
        side = "below 0" if slip < 0 else "above 0, with an input that turns backward"
        yield Message(
            "E451",
            f"{CONFLICT.name}: freewheel {name} can neither overrun (its slip would be "
            f"{slip:.4g}, {side}) nor hold (the gear would be {TIED_UP.english}); release one of "
            "the engaged shift elements, or exchange the links of the freewheel if its direction "
            "is wrong",
        )


def drag_messages(results: Results, number: int, gear: Gear) -> Iterator[Message]:
    """Warn of drag at links or shift elements whose speed is unknown.

    A single drag on otherwise unloaded links brings them to rest, so it needs no warning.
    """
    speeds, slips = results.speeds[number].tolist(), results.slip_speeds[number].tolist()
    unknown = unknown_drag(results.case, gear, speeds, slips)
    is_at_rest = len(unknown) == 1 and results.gear_at(number).unloaded
    if unknown and results.calculable[number] and not is_at_rest:
        yield Message(
            "W412",
            f"the drag of {spoken(unknown)} is ignored, because the speed there is indeterminate; "
            "give this speed in the gear",
        )
