"""Messages about irregular gears: why a speed or torque does not exist, and what to do.

`messages` derives the messages from the `Results` of a single case, and `regular_gears` recognises
gears whose speeds and torques exist and are unique. Most cases need no other module of the package.
`freedom` counts the degrees of freedom of the train and the constraints on its speeds. Messages
about speeds are in `unknown_speeds` (with `overrunning` freewheels) and `contradictions`, and
messages about torques in `unknown_torques` and `power_directions`. `further_outputs` reports
outputs after the first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from vstatics.core.errors import not_allowed, path_text, spoken
from vstatics.core.model.checks import doubts
from vstatics.core.model.transmission import Gear, Mechanism, Transmission
from vstatics.core.statics import carried, freewheels, ideal
from vstatics.core.statics.idle_by_coincidence import idle_messages, idle_with_torque
from vstatics.core.statics.result_arrays import Message
from vstatics.core.statics.results import Results
from vstatics.core.statics.torques import without_load


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
        lost = _lost_digit_messages(results, number) if results.exact[number] else []
        remarks = (
            *(_further_output_messages(results, number, gear) if case.outputs else ()),
            *(lost if is_usual else _irregular_gear_messages(results, number, gear, lost)),
            *(idle_messages(results, number, gear, idle) if idle else ()),
            *(_sharing_freewheels(case, given, held) if held else ()),
            *(() if is_usual else _drag_messages(results, number, gear)),
            *(_outside_messages(results, number, gear) if may_be_outside else ()),
            *(Message("W430", text) for index, text in overloaded if index == number),
            *(Message("W431", text) for index, text in unbalanced if index == number),
            *(_open_converters(case, given) if given.speed_ratios else ()),
            *(_driving_neutral(results, number) if given.kind == "neutral" else ()),
        )
        # Several contradictions in a gear can produce the same text, which is reported once.
        for message in dict.fromkeys(remarks):
            yield message._replace(gear=gear.name)


# Most cases need none of the following imports, which cost start-up time.


def _lost_digit_messages(results: Results, number: int) -> list[Message]:
    from vstatics.core.statics.diagnosis.unknown_torques import lost_digit_messages

    return list(lost_digit_messages(results, number))


def _further_output_messages(results: Results, number: int, gear: Gear) -> Iterator[Message]:
    from vstatics.core.statics.diagnosis.further_outputs import further_output_messages

    return further_output_messages(results, number, gear)


def _sharing_freewheels(case: Transmission, gear: Gear, held: Sequence[int]) -> Iterator[Message]:
    from vstatics.core.statics.diagnosis.overrunning import sharing_freewheels

    return sharing_freewheels(case, gear, held)


def _drag_messages(results: Results, number: int, gear: Gear) -> Iterator[Message]:
    from vstatics.core.statics.diagnosis.unknown_speeds import drag_messages

    return drag_messages(results, number, gear)


def _irregular_gear_messages(
    results: Results, number: int, gear: Gear, lost: Sequence[Message]
) -> Iterator[Message]:
    from vstatics.core.statics.diagnosis.power_directions import loss_messages
    from vstatics.core.statics.diagnosis.unknown_speeds import speed_messages
    from vstatics.core.statics.diagnosis.unknown_torques import torque_messages

    yield from speed_messages(results, number, gear)
    yield from lost
    yield from torque_messages(results, number, gear, is_reported=bool(lost))
    yield from loss_messages(results, number)


def _converters(case: Transmission, gear: Gear) -> Iterator[tuple[Mechanism, float]]:
    """Yield the converters that carry torque in a gear, with their speed ratios [-]."""
    unloaded = case.unloaded_converters(gear)
    for place, pair in enumerate(zip(case.mechanisms, case.gear_ratios(gear), strict=True)):
        if pair[0].kind == "converter" and place not in unloaded:
            yield pair


def _open_converters(case: Transmission, gear: Gear) -> Iterator[Message]:
    """Report speed ratios of entries under `converters`, which are disengaged in statics."""
    last = len(case.mechanisms[case.own_mechanisms])
    bodies = case.bodies(gear)
    for number, ratio in gear.speed_ratios.items():
        converter = case.converters[number - last - 1] if number > last else None
        if converter and bodies[converter.pump] != bodies[converter.turbine]:
            yield Message(
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


def _outside_messages(results: Results, number: int, gear: Gear) -> Iterator[Message]:
    case = results.case
    names = [
        mechanism.name
        for mechanism, ratio in _converters(case, gear)
        if mechanism.is_outside(ratio)
    ]
    if all(map(math.isnan, results.lossy_torques[number].tolist())):
        return  # no value is used
    laws = results.points.outside if results.points else {}
    names += [name for name, at in laws.items() if at[number]]
    if names:
        yield outside_message(names)


def _named(case: Transmission, path: str, text: str) -> str:
    for number, mechanism in enumerate(case.mechanisms, 1):
        path = path.replace(f"mechanisms[{number}]", f"mechanism {mechanism.name}")
    return f"{path}: {text}"


def _driving_neutral(results: Results, number: int) -> Iterator[Message]:
    ratio = float(results.ratio[number])
    if not math.isnan(ratio):
        yield Message("W432", f"marked `kind: neutral`, but drives with the ratio {ratio:.4g}")


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
            and (results.case.has_converter or not ideal.is_uncertain(gear, speed, torque))
        )
