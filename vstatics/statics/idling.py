"""Mechanisms that are idle by coincidence, whose direction of power is assumed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from vstatics.model.transmission import Gear, Transmission
from vstatics.statics import drag
from vstatics.statics.losses import both_ways, with_loss
from vstatics.statics.results import Results
from vstatics.statics.speeds import TIE, solve_speeds
from vstatics.statics.torques import solve_torques

UNCERTAIN = 1e-6


def coincidences(results: Results, number: int, gear: Gear) -> dict[str, bool]:
    """Names of the idle mechanisms whose direction of power, which is assumed, matters.

    And whether it matters for the efficiency too.

    Where engaged elements hold a mechanism as one piece only the split of torque depends
    on it. Otherwise a torque at the ports does, and so the efficiency.
    """
    case = results.case
    if not results.idle[number].any() or not results.consistent[number]:
        return {}
    torques = results.lossy_torques[number].tolist()[len(case.shift_elements) : -1]
    efficiencies = both_ways(case, [mechanism.efficiency for mechanism in case.mechanisms])
    internal = [mechanism.ratio for mechanism in case.mechanisms]
    marks = zip(results.idle[number].tolist(), torques, efficiencies, strict=True)
    idle = [
        place for place, (is_idle, t, eta) in enumerate(marks) if is_idle and t != 0 and eta.lossy
    ]
    held = _held_as_one(case, gear) if idle else ()
    idle = [place for place in idle if place not in held]
    if not idle:
        return {}
    signs = results.power_sign[number].tolist()
    speeds, slips = results.speeds[number].tolist(), results.slip_speeds[number].tolist()
    dragging = drag.acting(case, gear, speeds, slips)

    def at_ports(place: int, sign: float) -> tuple[list[float], float]:
        """Torques that the ports have, and the power that enters by these."""
        turned = [*signs[:place], sign, *signs[place + 1 :]]
        ratios = list(map(with_loss, internal, efficiencies, turned))
        torques = solve_torques(case, gear, ratios, dragging)
        given = {**torques.holding, case.gear_output(gear): -torques.first[-1]}
        entering = sum(torque * speeds[link - 1] for link, torque in given.items())
        return [torques.first[-1], *torques.holding.values()], entering

    if not gear.speeds and not gear.torques:
        # by virtual work the output torque depends on a ratio only where its mechanism
        # moves in the train that has the ratios with losses
        ratios = list(map(with_loss, internal, efficiencies, signs))
        motion = solve_speeds(case, gear, ratios).motion
        idle = [place for place in idle if motion[place] != 0]
    found = {}
    for place in idle:
        one, lost = at_ports(place, 1.0)
        other, otherwise = at_ports(place, -1.0 if efficiencies[place].back else 0.0)
        if _differ(one, other):
            found[case.mechanisms[place].name] = not abs(lost - otherwise) <= TIE
    return found


def _differ(one: list[float], other: list[float]) -> bool:
    """Whether torques are other ones; those that do not exist count for nothing."""
    pairs = [(a, b) for a, b in zip(one, other, strict=True) if a == a and b == b]  # noqa: PLR0124
    largest = max((abs(a) for a, _ in pairs), default=0.0)
    return any(abs(a - b) > TIE * largest for a, b in pairs)


def _held_as_one(case: Transmission, gear: Gear) -> set[int]:
    """Indices of mechanisms that turn as one piece whatever their losses, as far as plain to see.

    An engaged element makes two links one body. Where two links of a mechanism are one,
    so is the third; and two mechanisms of different ratios that join the same three
    bodies leave them one.
    """
    bodies = list(range(case.links + 1))

    def join(*links: int) -> None:
        one = {bodies[link] for link in links}
        bodies[:] = [min(one) if body in one else body for body in bodies]

    for number in gear.engaged:
        join(case.shift_elements[number - 1].first, case.shift_elements[number - 1].second)
    held: set[int] = set()
    while True:
        free = [number for number in range(len(case.mechanisms)) if number not in held]
        joined = _joined(case, free, bodies)
        if not joined:
            return held
        for number in joined:
            join(*case.mechanisms[number].links)
        held.update(joined)


def _joined(case: Transmission, mechanisms: Iterable[int], bodies: Sequence[int]) -> set[int]:
    """Those of some mechanisms whose links are one body."""
    found: set[int] = set()
    known: dict[tuple[int, ...], tuple[int, float, float]] = {}
    for number in mechanisms:
        one = case.mechanisms[number]
        own = [bodies[link] for link in one.links]
        if len(set(own)) < 3:
            if own[0] != own[1] or one.ratio != 1:  # with ratio 1 the third link is loose
                found.add(number)
            continue
        factors = zip(own, (1, -one.ratio, one.ratio - 1), strict=True)
        (first, factor), (second, other), (third, _) = sorted(factors)
        entry = number, factor, other
        before, old_factor, old_other = known.setdefault((first, second, third), entry)
        left, right = factor * old_other, other * old_factor
        if abs(left - right) > UNCERTAIN * (abs(left) + abs(right)):
            found |= {before, number}
    return found
