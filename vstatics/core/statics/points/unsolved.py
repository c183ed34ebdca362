"""Messages about gears whose losses or battery balance have no single solution."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from vstatics.core.errors import spoken
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.statics.points.balance import NO_BALANCE, TWO_BALANCES, sought_link
from vstatics.core.statics.points.laws import NO_EFFICIENCY, NONE, SEVERAL, Followed
from vstatics.core.statics.result_arrays import Message


def unsolved_messages(
    case: Transmission, settled: Sequence[Gear], answer: Followed
) -> Iterator[Message]:
    """Yield messages about gears without torques with losses.

    Parameters
    ----------
    settled : sequence of Gear
        Gears with the torques found.
    answer : Followed
        Solution at a single point.
    """
    states = zip(case.gears, settled, answer.open[0].tolist(), strict=True)
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
