"""Mechanisms that are idle by coincidence, whose direction of power is assumed."""

from __future__ import annotations

from vstatics.numerics.tolerances import TIE
from vstatics.numerics.traced import Number, absolute
from vstatics.statics.bodies import held_as_one
from vstatics.statics.efficiency import lossy_ratios
from vstatics.statics.power import power
from vstatics.statics.speeds import solve_speeds
from vstatics.statics.state import GearState
from vstatics.statics.torques import solve_torques


def coincidences(state: GearState) -> dict[str, bool]:
    """Names of the idle mechanisms whose direction of power, which is assumed, matters.

    And whether it matters for the efficiency too.

    Where engaged elements hold a mechanism as one piece only the split of torque depends
    on it. Otherwise a torque at the ports does, and so the efficiency.
    """
    if not state.consistent:
        return {}
    case, gear, ideal = state.case, state.gear, state.ideal
    elements = len(case.shift_elements)
    idle = [
        place
        for place, is_idle in enumerate(state.search.idle)
        if is_idle
        and state.lossy_torques.on_first_link[elements + place] != 0
        and ideal.efficiencies[place].lossy
    ]
    held = held_as_one(case, gear) if idle else set()
    idle = [place for place in idle if place not in held]
    if not idle:
        return {}

    def at_ports(place: int, sign: float) -> tuple[list[Number], Number]:
        """Torques that the ports have, and the power that enters by these."""
        turned = [*state.signs[:place], sign, *state.signs[place + 1 :]]
        ratios = lossy_ratios(ideal.ratios, ideal.efficiencies, turned)
        torques = solve_torques(case, gear, ratios, state.drag)
        output = torques.on_first_link[-1]
        entering = -power(output, state.output_speed)
        for link, torque in torques.holding.items():
            entering = entering + power(torque, state.speeds[link - 1])
        return [output, *torques.holding.values()], entering

    if not gear.speeds and not gear.torques:
        # by virtual work the output torque depends on a ratio only where its mechanism
        # moves in the train that has the ratios with losses
        relative_speeds = solve_speeds(case, gear, state.lossy_ratios).relative_speeds
        idle = [place for place in idle if relative_speeds[place] != 0]
    found = {}
    for place in idle:
        one, lost = at_ports(place, 1.0)
        other, otherwise = at_ports(place, -1.0 if ideal.efficiencies[place].back else 0.0)
        if _differ(one, other):
            found[case.mechanisms[place].name] = not absolute(lost - otherwise) <= TIE
    return found


def _differ(one: list[Number], other: list[Number]) -> bool:
    """Whether torques are other ones; those that do not exist count for nothing."""
    pairs = [(a, b) for a, b in zip(one, other, strict=True) if a == a and b == b]  # noqa: PLR0124
    largest = max((absolute(a) for a, _ in pairs), default=0.0)
    return any(absolute(a - b) > TIE * largest for a, b in pairs)
