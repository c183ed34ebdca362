"""Messages about gears whose losses or battery balance have no single solution."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from vstatics.core.errors import spoken
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.points.balance import NO_BALANCE, TWO_BALANCES, sought_link
from vstatics.core.statics.points.laws import NO_EFFICIENCY, NONE, SEVERAL
from vstatics.core.statics.result_arrays import Message, Outside


def unsolved(case: Transmission, points: Any, wrong: Outside) -> Iterator[Message]:
    """Yield messages about gears without torques with losses, at a single point.

    Parameters
    ----------
    points : OperatingPoints
        The point, without the axis of points.
    wrong : mapping
        Formulas that give no efficiency, by the name of the part.
    """
    states = zip(case.gears, points.gears, points.open.tolist(), strict=True)
    for number, (gear, settled, state) in enumerate(states):
        if state == NO_EFFICIENCY:
            names = spoken(name for name, where in wrong.items() if where[0, number])
            text = f"the formula for the efficiency of {names} is not above 0 and at most 1 here, "
            yield Message("W433", f"{text}so torques with losses are unknown", gear.name)
        if state in (NONE, SEVERAL):
            words = "no torque is" if state == NONE else "more than one torque is"
            text = f"{words} consistent with the losses that depend on speed or torque, so torques "
            text += "with losses are unknown"
            yield Message("W426", text, gear.name)
        if state in (NO_BALANCE, TWO_BALANCES):
            link = sought_link(gear, settled)
            none, two = "no torque on {} satisfies", "two torques on {} satisfy"
            words = (none if state == NO_BALANCE else two).format(case.link_name(link))
            text = f"balance: {words} the battery balance, so the torques are unknown"
            yield Message("W427", text, gear.name)
