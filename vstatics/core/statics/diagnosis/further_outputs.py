"""Messages about outputs after the first that lack a value, or through which power enters."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from vstatics.core.errors import plural, spoken
from vstatics.core.model.transmission import Gear, SpeedOf, Transmission
from vstatics.core.statics.result_arrays import Message
from vstatics.core.statics.results import Results


def further_output_messages(results: Results, number: int, gear: Gear) -> Iterator[Message]:
    """Report further outputs without speed or torque, or through which power enters."""
    case = results.case
    given = {*gear.speeds, *gear.torques}
    driving = [
        case.link_name(link)
        for link in case.further_outputs(gear)
        if gear.torques.get(link, 0.0) * results.speeds[number, link - 1] > 0
    ]
    if driving and not case.coasts(gear):
        yield Message(
            "N416",
            f"power enters at {plural('output', len(driving))} {spoken(driving)}; if the output "
            "should take power, its torque and its speed need opposite signs",
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
    yield Message(
        "W413",
        f"{plural('output', len(idle))} {spoken(names)} {verb} no torque: expected {expected}",
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
