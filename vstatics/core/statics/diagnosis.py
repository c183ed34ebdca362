"""Messages about irregular gears: why a speed or torque does not exist, and what to do.

`messages` derives the messages from the `Results`. `freedom` and `given_constraints` count the
degrees of freedom of the train and the constraints on its speeds. All functions apply to a single
case, not to arrays of variants.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from vstatics.core.errors import Problem, not_allowed, path_text, spoken
from vstatics.core.model.checks import doubts
from vstatics.core.model.parts import OfLoad, ShiftElement
from vstatics.core.model.transmission import Gear, Mechanism, SpeedOf, Transmission
from vstatics.core.numerics import elimination
from vstatics.core.numerics.tolerances import TIE, UNCERTAIN
from vstatics.core.numerics.traced import Number, is_nan, plain
from vstatics.core.start import NamedTuple
from vstatics.core.statics import carried, digits, freewheels, ideal, matrix, torques
from vstatics.core.statics.idle_by_coincidence import coincidences, idle_with_torque
from vstatics.core.statics.result_arrays import Message
from vstatics.core.statics.results import Results
from vstatics.core.statics.speeds import solve_speeds
from vstatics.core.statics.state import GearState
from vstatics.core.statics.status import CONFLICT, DRAGGED, LOCKED, NEUTRAL, TIED_UP
from vstatics.core.statics.torques import unknown_drag, without_load

NOTHING_HOLDS = "nothing supports the input torque"


class Said(NamedTuple):
    """Identifier and text of a message about a gear."""

    id: str
    text: str


def freedom(case: Transmission) -> int:
    """Return the degrees of freedom of the train without shift elements.

    >>> from vstatics.core.model.transmission import Mechanism, ShiftElement
    >>> freedom(Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])]))
    2
    """
    rows = matrix.speed_rows(case, Gear(), _rows(case, case.gears[0]))[:-1]
    return elimination.solve(rows, case.links).missing


def given_constraints(gear: Gear) -> int:
    """Return the number of shift elements that carry torque and of prescribed speeds."""
    return len(gear.carrying) + 1 + len(gear.speeds)


def messages(results: Results, given: Transmission) -> list[Message]:
    """Return the messages about the results of a case, without suppressed ids.

    `given` is the case before laws, balances and speed ratios were replaced by numbers.
    """
    return not_allowed(_messages(results, given), results.case.untold)


def _messages(results: Results, source: Transmission) -> Iterator[Message]:
    case = results.case
    for problem in doubts(source):
        yield Message(problem.id, _named(case, path_text(problem.path), problem.message))
    if case.heavy and (without_unit := without_load(case)):
        text = (
            f"the drag of {spoken(without_unit)} has a unit, but the case has no operating point, "
            "so this drag is ignored; give a `load` with a torque"
        )
        yield Message("W401", text)
    wheels = case.freewheels
    rated = any(element.capacity for element in case.shift_elements)
    overloaded = list(carried.overloads(results)) if rated else []
    unbalanced = list(carried.out_of_balance(results)) if case.has_converter else []
    may_be_outside = case.has_converter or results.points
    gears = zip(case.gears, regular_gears(results), idle_with_torque(results), strict=True)
    for number, (given, is_usual, idle) in enumerate(gears):
        held = [element for element in wheels if results.holds[number, element - 1]]
        gear = freewheels.with_engaged(given, held)
        lost = tuple(_lost_digit_messages(results, number)) if results.exact[number] else ()
        remarks = (
            *(_conflict_messages(case, gear) if results.conflict[number] else ()),
            *(_further_outputs(results, number, gear) if case.outputs else ()),
            *(lost if is_usual else _of_irregular_gear(results, number, gear, lost)),
            *(_idle_messages(results, number, gear, idle) if idle else ()),
            *(_sharing_freewheels(case, given, held) if held else ()),
            *(() if is_usual else _drag_messages(results, number, gear)),
            *(_outside_messages(results, number, gear) if may_be_outside else ()),
            *(Said("W430", text) for index, text in overloaded if index == number),
            *(Said("W431", text) for index, text in unbalanced if index == number),
            *(_open_converters(case, given) if given.speed_ratios else ()),
            *(_driving_neutral(results, number) if given.kind == "neutral" else ()),
        )
        # Several contradictions in a gear can produce the same text, which is reported once.
        for identity, text in dict.fromkeys(remarks):
            yield Message(identity, text, gear.name)


def _converters(case: Transmission, gear: Gear) -> Iterator[tuple[Mechanism, float]]:
    """Yield the converters that carry torque in a gear, with their speed ratios [-]."""
    unloaded = case.unloaded_converters(gear)
    for place, pair in enumerate(zip(case.mechanisms, case.gear_ratios(gear), strict=True)):
        if pair[0].kind == "converter" and place not in unloaded:
            yield pair


def _open_converters(case: Transmission, gear: Gear) -> Iterator[Said]:
    """Report speed ratios of entries under `converters`, which are disengaged in statics."""
    last = len(case.mechanisms[case.own_mechanisms])
    bodies = case.bodies(gear)
    for number, ratio in gear.speed_ratios.items():
        converter = case.converters[number - last - 1] if number > last else None
        if converter and bodies[converter.pump] != bodies[converter.turbine]:
            yield Said(
                "N415",
                f"converter {converter.name} is disengaged in statics, so its speed ratio "
                f"{ratio:g} has an effect only in `torsion`; for statics write it under "
                "`mechanisms` as `kind: converter` with `first` and `second`",
            )


def outside_message(names: Sequence[str]) -> Message:
    """Return the note that the laws of some parts are evaluated outside their points."""
    return Message(
        "N414", f"outside the points of {spoken(names)}, the value of the nearest end point applies"
    )


def _outside_messages(results: Results, number: int, gear: Gear) -> Iterator[Said]:
    case = results.case
    names = [
        mechanism.name
        for mechanism, ratio in _converters(case, gear)
        if mechanism.is_outside(ratio)
    ]
    laws = results.points.outside if results.points else {}
    names += [name for name, at in laws.items() if at[number]]
    if names:
        yield Said(*outside_message(names)[:2])


def _of_irregular_gear(
    results: Results, number: int, gear: Gear, lost: Sequence[Said]
) -> Iterator[Said]:
    yield from _speed_messages(results, number, gear)
    yield from lost
    yield from _torque_messages(results, number, gear, is_told=bool(lost))
    yield from _loss_messages(results, number)


def _sharing_freewheels(case: Transmission, gear: Gear, held: Sequence[int]) -> Iterator[Said]:
    others = freewheels.alternatives(case, gear, held)
    if others:
        holding, able_to_hold = (
            [case.shift_elements[number - 1].name for number in numbers]
            for numbers in (held, others)
        )
        yield Said(
            "W411",
            f"freewheel{_s(len(able_to_hold))} {spoken(able_to_hold)} could hold instead of "
            f"{spoken(holding)}, so their torques are indeterminate; the torques with "
            f"{spoken(holding)} are shown",
        )


def _drag_messages(results: Results, number: int, gear: Gear) -> Iterator[Said]:
    """Warn of drag at links or shift elements whose speed is unknown.

    A single drag on otherwise unloaded links brings them to rest, so it needs no warning.
    """
    speeds, slips = results.speeds[number].tolist(), results.slip_speeds[number].tolist()
    unknown = unknown_drag(results.case, gear, speeds, slips)
    is_at_rest = len(unknown) == 1 and results.gear_at(number).unloaded
    if unknown and results.calculable[number] and not is_at_rest:
        yield Said(
            "W412",
            f"the drag of {spoken(unknown)} is ignored, because the speed there is indeterminate; "
            "give this speed in the gear",
        )


def _named(case: Transmission, path: str, text: str) -> str:
    for number, mechanism in enumerate(case.mechanisms, 1):
        path = path.replace(f"mechanisms[{number}]", f"mechanism {mechanism.name}")
    return f"{path}: {text}"


def _rows(case: Transmission, gear: Gear) -> list[matrix.Column]:
    return matrix.rows(case, case.gear_ratios(gear))


def _s(count: int) -> str:
    return "" if count == 1 else "s"


def _without_value(names: Sequence[str], values: Sequence[Number]) -> list[str]:
    return [name for name, value in zip(names, values, strict=True) if math.isnan(plain(value))]


def _conflict_messages(case: Transmission, gear: Gear) -> Iterator[Said]:
    speeds = solve_speeds(case, gear, _rows(case, gear))
    for number in freewheels.driven_backward(case, gear, speeds):
        name, slip = case.shift_elements[number - 1].name, speeds.slips[number - 1]
        side = "below 0" if slip < 0 else "above 0, with an input that turns backward"
        yield Said(
            "E451",
            f"{CONFLICT.name}: freewheel {name} can neither overrun (its slip would be "
            f"{slip:.4g}, {side}) nor hold (the gear would be {TIED_UP.english}); release one of "
            "the engaged shift elements, or exchange the links of the freewheel if its direction "
            "is wrong",
        )


def _missed_freewheels(results: Results, number: int, gear: Gear) -> list[int]:
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


def _further_outputs(results: Results, number: int, gear: Gear) -> Iterator[Said]:
    """Report further outputs without speed or torque, or through which power enters."""
    case = results.case
    given = {*gear.speeds, *gear.torques}
    driving = [
        case.link_name(link)
        for link in case.further_outputs(gear)
        if gear.torques.get(link, 0.0) * results.speeds[number, link - 1] > 0
    ]
    if driving and not case.coasts(gear):
        yield Said(
            "N416",
            f"power enters at output{_s(len(driving))} {spoken(driving)}; if the output should "
            "take power, its torque and its speed need opposite signs",
        )
    unloaded = results.gear_at(number).unloaded
    idle = [
        link
        for link in case.further_outputs(gear)
        if link not in given and case.link_name(link) not in unloaded
    ]
    if not idle:
        return
    names = [case.link_name(link) for link in idle]
    first, same = names[0], case.speed_text(SpeedOf(case.gear_output(gear)))
    expected = f"a speed or a torque, such as `speeds: {{{first}: {same}}}`"
    # The speed of the output is known already, so a given speed would be a redundant constraint.
    if not np.isnan(results.speeds[number, idle[0] - 1]):
        side, torque = _taking(case, gear, float(results.speeds[number, idle[0] - 1]))
        example = f"`torques: {{{first}: {torque}}}`"
        expected = f"a torque, {side} 0 if the output takes power, such as {example}"
    verb = "take" if names[1:] else "takes"
    yield Said(
        "W413", f"output{_s(len(idle))} {spoken(names)} {verb} no torque: expected {expected}"
    )


def _taking(case: Transmission, gear: Gear, speed: float) -> tuple[str, str]:
    """Return the sign (above or below 0) and an example of a torque that takes power from a link.

    The example is relative to the input torque, or in N*m without an input torque. When coasting,
    the input torque acts against the input speed, so the sign is reversed.
    """
    if case.input_torque(gear):
        way, size = -1.0 if case.coasts(gear) else 1.0, "0.2"
    else:
        way, size = case.gear_load(gear).speed or 1.0, "20 N*m"
    return ("above", size) if way * speed < 0 else ("below", f"-{size}")


def _speed_messages(results: Results, number: int, gear: Gear) -> Iterator[Said]:
    """Report missing, redundant and contradictory constraints, and an output at rest."""
    case = results.case
    if results.conflict[number]:
        return  # reported as an error already
    missing, excess = int(results.missing[number]), int(results.excess[number])
    if results.tied_up[number] or excess:
        opened = _opened(case, gear, _speed_ratios(results, number, gear))
        conflicts = _conflict_messages(case, opened) if gear.slip else ()
        yield from list(conflicts) or _excess(results, number, gear)
    if missing and (unloaded := results.gear_at(number).unloaded):
        what = "turns freely and carries" if len(unloaded) == 1 else "turn freely and carry"
        yield Said("N420", f"link{_s(len(unloaded))} {spoken(unloaded)} {what} no torque")
    elif missing and _is_for_motion(case, gear):
        free = _without_value(case.link_names, results.gear_at(number).speeds)
        what = "turns" if len(free) == 1 else "turn"
        named = f"link{_s(len(free))} {spoken(free)} {what} freely"
        yield Said("N420", f"{named}, because the case has no gears; a run calculates its speeds")
    elif missing and not (gear.kind == "neutral" and _is_neutral(results, number)):
        yield _too_free(results, number, gear, missing)
    output = case.gear_output(gear)
    if results.speeds[number, output - 1] == 0:
        name = case.link_name(output)
        yield Said("W415", f"the output, link {name}, is at rest, so the gear has no ratio")


def _is_for_motion(case: Transmission, gear: Gear) -> bool:
    """Return whether a case only describes motion: inertias or masses, but no `gears` or load."""
    alone = len(case.gears) == 1 and gear == Gear(name="1")
    return alone and case.load is None and bool(case.inertias or case.masses)


def _too_free(results: Results, number: int, gear: Gear, missing: int) -> Said:
    """Return a warning that constraints are missing, so that the gear or a link is free."""
    case = results.case
    free = _without_value(case.link_names, results.gear_at(number).speeds)
    named = f" (link{_s(len(free))} {spoken(free)} can still turn freely)" if free else ""
    links = "" if results.tied_up[number] else named
    neutral = _is_neutral(results, number)
    unheld = f"; {NOTHING_HOLDS}" if _is_adrift(results, number) else ""
    over = _missed_freewheels(results, number, gear) if neutral else []
    why, exchange = _overrunning(case, results.gear_at(number), over)
    if neutral and (loose := _loose_ends(case, gear)):
        return Said("W414", f"{NEUTRAL.english}: {loose}")
    count = "one" if missing == 1 else str(missing)
    instead = " instead" * bool(results.tied_up[number])
    return Said(
        "W414",
        f"{f'{NEUTRAL.english}{why}: ' * bool(neutral)}"
        f"{count} more shift element{_s(missing)} must be engaged{instead}"
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


def _overrunning(case: Transmission, state: GearState, numbers: Sequence[int]) -> tuple[str, str]:
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
    why = f", because freewheel{_s(len(names))} {spoken(names)} {verb}"
    if not exchanged:
        return why, ""
    wrong, right = map(spoken, zip(*exchanged, strict=True))
    return why, (
        f"; if the links of {wrong} are in the wrong order, write {right}: then the gear can drive"
    )


def _is_adrift(results: Results, number: int) -> bool:
    return _is_neutral(results, number) and not results.balanced[number]


def _is_neutral(results: Results, number: int) -> bool:
    is_undetermined = bool(results.missing[number]) and bool(np.isnan(results.ratio[number]))
    return is_undetermined and not results.tied_up[number] and not results.conflict[number]


def _driving_neutral(results: Results, number: int) -> Iterator[Said]:
    ratio = float(results.ratio[number])
    if not math.isnan(ratio):
        yield Said("W432", f"marked `kind: neutral`, but drives with the ratio {ratio:.4g}")


def undriven_gears(results: Results) -> Iterator[Problem]:
    """Yield an error for each gear that is neutral, but not marked `kind: neutral`.

    `run` only warns of such gears (W414), whereas `check` fails.
    """
    case = results.case
    for number, gear in enumerate(case.gears):
        if "W414" in case.untold or gear.kind == "neutral" or _is_for_motion(case, gear):
            continue
        if _is_neutral(results, number):
            over = _missed_freewheels(results, number, gear)
            _, exchange = _overrunning(case, results.gear_at(number), over)
            cure = exchange or ": expected another engaged shift element, or `kind: neutral`"
            if loose := _loose_ends(case, gear):
                cure = f": {loose}"
            yield Problem("E453", f"cannot drive{cure}", ("gears", number + 1))


def _speed_ratios(results: Results, number: int, gear: Gear) -> dict[str, float]:
    """Return the speed ratios of variators and converters [-]; NaN if the load determines them."""
    case = results.case
    calculated = results.points.gears[number] if results.points else gear
    ratios = zip(case.mechanisms, case.gear_ratios(calculated), strict=True)
    return {mechanism.name: ratio for mechanism, ratio in ratios if mechanism.kind}


def _cure(
    engaged: Sequence[str],
    others: Sequence[str],
    fixed: Sequence[str],
    sought: Sequence[str],
    elements: Sequence[ShiftElement],
) -> str:
    """Return words for the remedies for contradictory constraints on the speeds.

    `fixed` are converters and variators with a prescribed speed ratio; for `sought`, the load
    determines it. `elements` are the slipping shift elements.
    """
    slipping = [element.name for element in elements if element.name in engaged]
    sticking = [name for name in engaged if name not in slipping]
    released = "one of the engaged shift elements" if len(engaged) > 1 else spoken(sticking)
    names = spoken(fixed)
    by_slip = f"remove the speed ratio of {names}, which the slip then determines"
    cures = [
        f"release {released}" * bool(sticking),
        f"remove the slip of {spoken(slipping)}" * bool(slipping),
        "remove a given speed" * any(name != matrix.INPUT_SPEED for name in others),
        (by_slip if slipping else f"give {names} another speed ratio") * bool(fixed),
        f"list {spoken(sought)} under `open`" * bool(sought),
    ]
    return " or ".join(filter(None, cures))


def _excess(results: Results, number: int, gear: Gear) -> Iterator[Said]:
    """Report constraints on the speeds that are redundant or contradictory."""
    case, repeated, same = results.case, list[str](), list[str]()
    at_ratios = _speed_ratios(results, number, gear)
    if gear.slip:
        gear = _without_converters(case, gear, at_ratios)
    rows = matrix.speed_rows(case, gear, _rows(case, gear))
    names = matrix.speed_row_names(case, gear)
    always = len(matrix.always_coupled(case, gear))
    for involved, agrees in elimination.dependencies(rows):
        given_speeds = always + len(gear.carrying)
        engaged = [names[i] for i in involved if always <= i < given_speeds]
        others = [names[i] for i in involved if i >= given_speeds]
        loaded = always - sum(not spring.is_damper for spring in case.springs)
        springs = [names[i] for i in involved if loaded <= i < always]
        free = [names[i] for i in involved if i < always and names[i] in at_ratios]
        every = [names[i] for i in involved]
        conditions = spoken(engaged + springs + others if engaged or others else every)
        if not agrees:
            fixed = [name for name in free if not math.isnan(at_ratios[name])]
            sought = [name for name in free if name not in fixed]
            cure = _cure(engaged, others, fixed, sought, case.elements_at(gear.slipping))
            if free:
                conditions = spoken(
                    f"{name} at the speed ratio {at_ratios[name]:g}" if name in fixed else name
                    for name in (*engaged, *springs, *free, *others)
                )
            if not cure:
                conditions, cure = spoken(every), "check the links and ratios of these mechanisms"
            if springs:
                cure += f"; {spoken(springs)} can twist in `vstatics torsion`, but not in statics"
            yield Said(
                "E452",
                f"{TIED_UP.english}: {conditions} contradict each other, so the input cannot "
                f"turn as given; {cure}",
            )
        elif engaged:
            repeated.append(spoken(engaged) if len(engaged) > 1 else conditions)
        else:
            same.append(f"{conditions} impose the same constraint on the speeds")
    if repeated:
        count = len(repeated)
        what = "one is redundant" if count == 1 else f"{count} are redundant"
        groups = "; ".join(repeated)
        same.insert(0, f"{groups} impose the same constraint on the speeds, so {what}")
    unknown = _unknown_torques(results, number)
    advice = ", release one" * bool(repeated)
    shared = f"; the torque of {spoken(unknown)} is indeterminate{advice}" if unknown else ""
    for text in same:
        yield Said("W416", text + shared)
        shared = ""  # the torques are named only in the first message


def _without_converters(case: Transmission, gear: Gear, ratios: Mapping[str, float]) -> Gear:
    """Return a gear, without free converters if its other constraints contradict each other."""
    opened = _opened(case, gear, ratios)
    rows = matrix.speed_rows(case, opened, _rows(case, opened))
    return gear if all(agrees for _, agrees in elimination.dependencies(rows)) else opened


def _opened(case: Transmission, gear: Gear, ratios: Mapping[str, float]) -> Gear:
    """Return a gear with open converters where the load determines the speed ratio."""
    first = case.own_mechanisms.start - 1
    names = [mechanism.name for mechanism in case.mechanisms]
    free = [names.index(name) - first for name, ratio in ratios.items() if math.isnan(ratio)]
    return gear._replace(open=(*gear.open, *free))


def _lost_digit_messages(results: Results, number: int) -> Iterator[Said]:
    lost = None if results.conflict[number] else digits.lost_digits(results.gear_at(number))
    if lost is None:
        return
    of = [f"the speed of {spoken(lost.links)}"] * bool(lost.links)
    of += [f"the torque of {spoken(lost.devices)}"] * bool(lost.devices)
    certain = f"only {lost.digits} digit{_s(lost.digits)}" if lost.digits else "no digit"
    verb = "are" if lost.digits > 1 else "is"
    yield Said(
        "W417",
        "with slightly different ratios there would be no unique solution, so rounding errors "
        f"show: {certain} of {spoken(of)} {verb} certain; give exact ratios, for example by teeth",
    )


def _torque_messages(results: Results, number: int, gear: Gear, *, is_told: bool) -> Iterator[Said]:
    """Report torques that do not exist, are indeterminate or are uncertain.

    Uncertain torques are not reported if a message about lost digits already did so (`is_told`).
    """
    case = results.case
    if results.tied_up[number] or results.conflict[number]:
        return  # reported as an error already
    output = case.gear_output(gear)
    if not results.balanced[number]:
        if _is_adrift(results, number) and output not in gear.speeds:
            return  # already reported with the speeds
        if driving := list(_driving_messages(results, number)):
            yield from driving
            return
        advice = _loaded_pumps(results, number) or _gaining_converters(results, number)
        advice = advice or _unheld_torques(results, number)
        if output in gear.speeds:
            advice = (
                f"a speed is given on the output, link {case.link_name(output)}; give the "
                "speed of the reacting link instead"
            )
        yield Said("W418", f"no torques are in equilibrium: {advice}")
    elif not (is_told or case.has_converter) and is_uncertain(
        gear, float(results.speeds[number, output - 1]), float(results.torques[number, -1])
    ):
        yield Said(
            "W419",
            "with slightly different ratios there would be no unique solution, so rounding errors "
            "show: output torque times output speed is not 1, and only a few digits are certain; "
            "give exact ratios, for example by teeth",
        )
    elif not results.excess[number] and (  # messages about the speeds mention redundant constraints
        np.isnan(results.torques[number]).any() or np.isnan(results.mesh_torques[number]).any()
    ):
        unknown = _unknown_torques(results, number)
        if unknown:
            yield Said(
                "W420",
                f"the torque of {spoken(unknown)} is indeterminate in statics",
            )


def _driving_messages(results: Results, number: int) -> Iterator[Said]:
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
        yield Said(
            "W438",
            f"with a slip of {size}, {case.shift_elements[element - 1].name} would give power "
            f"instead of taking it, so there are no torques; only a slip {where} is possible",
        )


def _loaded_pumps(results: Results, number: int) -> str:
    """Return words for converters whose pump torque a slip determines."""
    case, gear = results.case, results.gear_at(number).gear
    first = case.own_mechanisms.start - 1
    return spoken(
        f"with this slip, the pump of {case.mechanisms[first + owner].name} takes "
        f"{torque.given:.4g} N*m, and no clutch carries the difference from the torque of "
        "the load; give another slip, or remove it"
        for owner, torque in gear.pump_torques.items()
        if isinstance(torque, OfLoad)
    )


def _gaining_converters(results: Results, number: int) -> str:
    if not results.case.has_converter:
        return ""
    state = results.gear_at(number)
    variant = state.ideal.variant
    torques_ = torques.solve_torques(results.case, state.gear, variant.columns)
    names = ideal.gaining(variant, state.ideal.direction, state.ideal.speeds, torques_)
    return f"converter{_s(len(names))} {spoken(names)} would gain power" if names else ""


def _unheld_torques(results: Results, number: int) -> str:
    """Return words for external torques that nothing reacts, and freewheels that could."""
    case, state = results.case, results.gear_at(number)
    gear, variant = state.gear, state.ideal.variant
    input_link = case.gear_input(gear)

    def is_held(link: int, columns: Sequence[matrix.Column], more: Sequence[int] = ()) -> bool:
        alone = gear._replace(input=link, torques={}, engaged=(*gear.engaged, *more))
        return torques.solve_torques(case, alone, columns).consistent

    unheld = [link for link in (input_link, *gear.torques) if not is_held(link, variant.columns)]
    # In a geared neutral (output at rest), torques balance only with losses, whatever their size.
    factors = [0.98 - 0.01 / place for place, _ in enumerate(variant.ratios, 1)]
    lossy = [ratio * factor for ratio, factor in zip(variant.ratios, factors, strict=True)]
    if (
        results.speeds[number, case.gear_output(gear) - 1] == 0
        and not case.has_converter
        and all(is_held(link, matrix.columns(case, lossy)) for link in unheld)
    ):
        return (
            "the output is at rest and takes no power, so torques without losses have no bound; "
            "calculate ratios slightly above and below this one to see torques with losses"
        )
    links = ["the input" if link == input_link else case.link_name(link) for link in unheld]
    what = "torque of " if len(links) == 1 else "torques of "
    over = [n for n in case.freewheels if n not in gear.engaged]
    helps = any(is_held(link, variant.columns, over) for link in unheld)
    why, exchange = _overrunning(case, state, over if helps else ())
    return f"nothing supports the {what}{' and of '.join(links)}{why}{exchange}"


def _unknown_torques(results: Results, number: int) -> list[str]:
    """Return the devices without a determinate torque, in a gear whose torques balance."""
    if not results.calculable[number]:
        return []
    torques = results.gear_at(number).torques
    return _without_value([*results.case.devices, "the output"], torques.on_first_link)


def _loss_messages(results: Results, number: int) -> Iterator[Said]:
    case = results.case
    if results.locked[number]:
        if driving := list(_driving_messages(results, number)):
            yield from driving
            return
        way = " when coasting" if case.coasts(case.gears[number]) else ""
        yield Said(
            "W421",
            f"{LOCKED.english}{way}: no direction of power flow is consistent with the losses",
        )
    elif results.dragged[number]:
        yield Said("W422", f"{DRAGGED.english}: {DRAGGED.meaning}")
    elif results.undecided[number]:
        yield Said(
            "W423",
            "the search for directions of power that are consistent with the losses ended early, "
            "so torques with losses and efficiency are unknown",
        )
    elif not results.consistent[number] and results.calculable[number]:
        yield Said(
            "W424",
            "statics does not determine all directions of power flow; with losses, only the values "
            "that do not depend on them are shown",
        )
    turns = zip(case.mechanisms, results.turned[number], strict=True)
    turned = [mechanism.name for mechanism, mark in turns if mark]
    if turned:
        yield Said("N411", f"losses reverse the power flow through {spoken(turned)}")
    if results.choices[number] > 1:
        yield Said(
            "N412",
            f"{results.choices[number]} sets of power directions are consistent with the losses; "
            "the set with the largest efficiency is shown",
        )


def _idle_messages(results: Results, number: int, gear: Gear, idle: set[int]) -> Iterator[Said]:
    """Report mechanisms without power whose assumed direction of power affects the torques."""
    matters = coincidences(results, number, gear, idle)
    if matters:
        what = "torques with losses and efficiency depend"
        if not any(matters.values()):
            what = "torques with losses, but not the efficiency, depend"
        verb = "happens" if len(matters) == 1 else "happen"
        yield Said(
            "N413" if _is_straight_ahead(results, number, [*matters]) else "W425",
            f"{spoken([*matters])} {verb} to transmit no power; {what} on the direction of power "
            "that is assumed there",
        )


def _is_straight_ahead(results: Results, number: int, idle: Sequence[str]) -> bool:
    """Return whether all mechanisms `idle` rotate with a locked-up differential (no turn)."""
    speeds = [0.0, *map(plain, results.gear_at(number).speeds)]
    parts = [part for part in results.case.mechanisms if part.name in idle]
    of_differentials = [speeds[part.third] for part in parts if part.ratio == -1]
    return all(
        any(math.isclose(speeds[link], speed, rel_tol=TIE) for speed in of_differentials)
        for part in parts
        for link in (part.first, part.third)
    )


REGULAR = {
    "tied_up": False,
    "conflict": False,
    "missing": 0,
    "excess": 0,
    "balanced": True,
    "consistent": True,
    "dragged": False,
    "locked": False,
    "undecided": False,
    "choices": 1,
}
"""Values of arrays of `Results` for a gear whose speeds and torques exist and are unique."""


def regular_gears(results: Results) -> Iterator[bool]:
    """Yield for each gear whether its speeds and torques exist and are unique.

    >>> from vstatics import Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)],
    ...                     [Gear([1]), Gear([], name="N")])
    >>> list(regular_gears(solve(case)))
    [True, False]
    """
    case, usual = results.case, tuple(REGULAR.values())
    marks = zip(*(getattr(results, name).tolist() for name in REGULAR), strict=True)
    turned, speeds = results.turned.tolist(), results.speeds.tolist()
    torques, of_meshes = results.torques.tolist(), results.mesh_torques.tolist()
    for number, (gear, marks_of_gear) in enumerate(zip(case.gears, marks, strict=True)):
        speed, torque = speeds[number][case.gear_output(gear) - 1], torques[number][-1]
        yield (
            marks_of_gear == usual
            and True not in turned[number]
            and not math.isnan(sum(torques[number]) + sum(of_meshes[number]))
            and speed != 0
            and (results.case.has_converter or not is_uncertain(gear, speed, torque))
        )


def is_uncertain(gear: Gear, output_speed: float, output_torque: float) -> bool:
    """Return whether output torque times output speed differs from 1 because of rounding.

    By equation (1) of docs/method.md, ``Mx * w_output = 1`` in a gear without losses and without
    further given speeds or torques.
    """
    if gear.speeds or gear.torques or gear.slipping:
        return False
    return abs(output_torque * output_speed - 1) > UNCERTAIN
