"""Messages about gears whose losses, battery balance or converter have no unique solution."""

from __future__ import annotations

from collections.abc import Iterator

from vstatics.core.errors import plural, spoken
from vstatics.core.model.parts import RAD_PER_RPM, OfLoad
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.statics.carried import torque_of_pump
from vstatics.core.statics.points.balance import NO_BALANCE, TWO_BALANCES, sought_link
from vstatics.core.statics.points.converters import NO_RATIO
from vstatics.core.statics.points.laws import NO_EFFICIENCY, NONE, SEVERAL, Followed
from vstatics.core.statics.result_arrays import Message, OperatingPoints


def unsolved_messages(
    case: Transmission, points: OperatingPoints, answer: Followed
) -> Iterator[Message]:
    """Yield warnings about gears without a unique solution, and notes on further speed ratios.

    Parameters
    ----------
    points : OperatingPoints
        Operating point with the solved numbers.
    answer : Followed
        Solution with the states of gears.
    """
    states = zip(case.gears, points.gears, answer.open[0].tolist(), strict=True)
    for number, (gear, with_torques, state) in enumerate(states):
        if state == NO_EFFICIENCY:
            names = spoken(name for name, where in answer.wrong.items() if where[0, number])
            text = f"the formula for the efficiency of {names} is not above 0 and at most 1 here, "
            yield Message("W433", f"{text}so torques with losses are unknown", gear.name)
        if state in (NONE, SEVERAL):
            words = "no torque is" if state == NONE else "more than one torque is"
            text = f"{words} consistent with the losses that depend on speed or torque, so torques "
            text += "with losses are unknown"
            yield Message("W426", text, gear.name)
        if state in (NO_BALANCE, TWO_BALANCES):
            link = sought_link(gear, with_torques)
            none, two = "no torque on {} satisfies", "two torques on {} satisfy"
            words = (none if state == NO_BALANCE else two).format(case.link_name(link))
            text = f"balance: {words} the battery balance, so the torques are unknown"
            yield Message("W427", text, gear.name)
        if state == NO_RATIO:
            yield Message("W431", _no_ratio(case, gear, with_torques), gear.name)
        if smaller := [f"{ratio:.4g}" for ratio in points.other_ratios.get(number, ())]:
            name = case.mechanisms[case.sought_converters(gear)[0]].name
            ratios = f"the speed {plural('ratio', len(smaller))} {spoken(smaller)}"
            text = f"{name} also takes the torque of the load at {ratios}; "
            text += "the largest speed ratio is used"
            yield Message("N421", text, gear.name)


def _no_ratio(case: Transmission, gear: Gear, solved: Gear) -> str:
    converter = case.mechanisms[case.sought_converters(gear)[0]]
    points = converter.points
    first, last = points[0], points[-1]
    if solved.pump_torques:
        text = (
            f"the slip gives {converter.name} a speed ratio outside its points, {first[0]:g} to "
            f"{last[0]:g}, so the torques are unknown; give another slip, or more points"
        )
        without_unit = [slip for slip in gear.slip.values() if not isinstance(slip, OfLoad)]
        if large := [slip for slip in without_unit if abs(slip) > 1]:
            text += (
                f"; without a unit, a slip of {large[0]:g} is {large[0]:g} times the input speed"
            )
        return text
    text = (
        f"at no speed ratio from {first[0]:g} to {last[0]:g} does the pump of {converter.name} "
        "take the torque of the load, so the torques are unknown"
    )
    bodies, load = case.bodies(gear), case.gear_load(gear)
    if load.speed and bodies[converter.first] == bodies[case.gear_input(gear)]:
        taken = [torque_of_pump(converter.points, x, load.speed * RAD_PER_RPM) for x, *_ in points]
        text += f"; at the input speed it takes {min(taken):.4g} to {max(taken):.4g} N*m"
        if case.coasts(gear) and min(taken) < (load.torque or 0.0) < max(taken):
            text += ", but would gain power where its torque ratio is below 1/i"
    if case.coasts(gear) and last[2] >= 0:
        text += "; to coast, the converter needs points beyond i = 1 with lambda below 0"
    return text
