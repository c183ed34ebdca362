"""Checks of a vehicle, and warnings about the vehicle together with the transmission."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence

from vstatics.core.errors import Path, Problem, percent, spoken
from vstatics.core.model.fields import TransmissionFields
from vstatics.core.model.laws import of_law
from vstatics.core.model.part_checks import no_unit
from vstatics.core.model.parts import RAD_PER_RPM, Law
from vstatics.core.model.springs import ends
from vstatics.core.statics.points.gear_loss import power_loss
from vstatics.vehicle.case.vehicle import Vehicle, beside_engine
from vstatics.vehicle.tolerances import LARGEST_NUMBER, SMALLEST_NUMBER

_NUMBERS = ("mass", "radius", "rolling", "drag_area", "final_drive")
ABOVE_NOTHING = ("mass", "radius", "final_drive")


def of_vehicle(case: TransmissionFields) -> Iterator[Problem]:
    """Yield errors in the vehicle of a case."""
    vehicle = Vehicle.of(case)
    if vehicle is None:
        return
    for name in _NUMBERS:
        value = getattr(vehicle, name)
        if isinstance(value, Sequence):
            path = "vehicle", name, "points"
            yield from _of_points(value, path, units=("m/s", ""), what="coefficient")
            if not value:
                yield Problem("E268", "read no points, expected at least one", path)
            continue
        smallest = SMALLEST_NUMBER if name in ABOVE_NOTHING else 0.0
        if not smallest <= value <= LARGEST_NUMBER:
            least = "above 0" if smallest else "of 0 or more"
            range_ = f"from {smallest:g} to {LARGEST_NUMBER:g}" if value > 0 else least
            message = f"read {value:g}, expected a number {range_}"
            yield Problem("E268", message, ("vehicle", name))
    yield from _of_machine(vehicle)
    machine = vehicle.machine
    for keys, points, sign in (
        (("engine",), vehicle.engine, 1),
        (("overrun",), vehicle.overrun, -1),
        (("machine", "torque"), machine.torque if machine else (), 1),
        (("machine", "generating"), machine.generating if machine else (), -1),
    ):
        yield from _of_points(points, ("vehicle", *keys), sign)


def _of_points(
    points: Sequence[tuple[float, float]],
    path: Path,
    sign: int = 1,
    units: tuple[str, str] = ("rad/s", " N*m"),
    what: str = "torque",
) -> Iterator[Problem]:
    before, (of_speed, unit) = -math.inf, units
    for number, (speed, value) in enumerate(points, 1):
        if not 0 <= speed <= LARGEST_NUMBER or speed <= before:
            most = f"up to {LARGEST_NUMBER:g} {of_speed}"
            least = most if speed > LARGEST_NUMBER else "of 0 or more"
            after = hint = ""
            if speed <= before:
                after = f" after {before:g} {of_speed}"
                hint = f"; a number without a unit is in {of_speed}"
            expected = f"speeds {least} in ascending order{hint}"
            message = f"read {speed:g} {of_speed}{after}, expected {expected}"
            yield Problem("E268", message, (*path, number))
        if not 0 <= sign * value <= LARGEST_NUMBER:
            side = "0 or more" if sign > 0 else "0 or less"
            if abs(value) > LARGEST_NUMBER:
                side = f"up to {LARGEST_NUMBER:g}{unit} in magnitude"
            message = f"read {value:g}{unit}, expected a {what} of {side}"
            yield Problem("E268", message, (*path, number))
        before = speed


def _of_machine(vehicle: Vehicle) -> Iterator[Problem]:
    machine = vehicle.machine
    if not 0 <= vehicle.recuperation <= 1:
        part = vehicle.recuperation
        message = f"read {part:g}, expected a part from 0 to 1{percent(part)}"
        yield Problem("E268", message, ("vehicle", "recuperation"))
    if machine is None:
        return
    if not machine.torque:
        message = "read no points, expected at least one"
        yield Problem("E268", message, ("vehicle", "machine", "torque"))
    path, what = ("vehicle", "machine", "efficiency"), "an efficiency above 0 and up to 1"
    if isinstance(machine.efficiency, Law):
        yield from of_law(
            machine.efficiency, path, low=math.ulp(0.0), high=1, what=what, signed=True
        )
    elif not 0 < machine.efficiency <= 1:
        message = f"read {machine.efficiency:g}, expected {what}{percent(machine.efficiency)}"
        yield Problem("E268", message, path)
    if not 0 < machine.battery_efficiency <= 1:
        value = machine.battery_efficiency
        message = f"read {value:g}, expected {what}{percent(value)}"
        yield Problem("E268", message, ("vehicle", "machine", "battery", "efficiency"))
    if not 0 <= machine.auxiliary <= LARGEST_NUMBER:
        message = f"read {machine.auxiliary:g} kW, expected a power from 0 to {LARGEST_NUMBER:g} kW"
        yield Problem("E268", message, ("vehicle", "machine", "battery", "auxiliary"))


def doubts_of_vehicle(case: TransmissionFields) -> Iterator[Problem]:
    """Yield warnings about probable mistakes in the vehicle of a case."""
    vehicle = Vehicle.of(case)
    if vehicle is None:
        return
    yield from _mass_twice(case, vehicle)
    yield from _units_forgotten(vehicle)
    yield from _machines_beside(case)
    yield from _losses_at_rest(case, vehicle)
    free = [{*case.unloaded_converters(g), *case.sought_converters(g)} for g in case.gears]
    converters = [
        mechanism.name
        for place, mechanism in enumerate(case.mechanisms)
        if mechanism.kind == "converter" and not all(place in places for places in free)
    ]
    if converters:
        message = (
            f"{spoken(converters)} keeps its given speed ratio at every speed, also at rest, so "
            "forces and engine speeds hold only near this ratio"
        )
        yield Problem("W891", message, ("vehicle",))


MASS_AGAIN = 0.5
"""Least inertia at the outputs that probably includes the vehicle, relative to the vehicle. [-]"""


def _mass_twice(case: TransmissionFields, vehicle: Vehicle) -> Iterator[Problem]:
    """Yield a warning if inertias at the outputs probably include the vehicle mass."""
    mass, inertias = _at_output(case, vehicle)
    total = sum(inertias.values())
    if total >= MASS_AGAIN * mass:
        given = sorted(inertias, key=lambda link: -inertias[link])
        names = spoken([case.link_name(link) for link in given])
        has_others = not {*given} <= {*(case.outputs or (case.output,))}
        reduced = " by the speed of the output" if has_others else ""
        message = (
            f"{names} {'has' if len(given) == 1 else 'have'} {total:.4g} kg*m^2{reduced}, and the "
            f"mass of the vehicle is {mass:.4g} kg*m^2 there, mass*(radius/final_drive)^2, which "
            "`vehicle` adds itself, so it counts twice; leave it out of `inertias`, or write a "
            "second case without `vehicle` for simulation and vibration"
        )
        yield Problem("W202", message, ("inertias", next(iter(given))))


LARGEST_TYRE = 2.5
"""Largest plausible wheel radius; wheels of dump trucks are smaller. [m]"""
FASTEST_ENGINE, FASTEST_MACHINE = 1600.0, 3000.0
"""Largest plausible speeds of an engine and an electric machine, 15,300 and 28,600 rpm. [rad/s]"""


def _units_forgotten(vehicle: Vehicle) -> Iterator[Problem]:
    """Yield notes about numbers that were probably given without their unit mm, rpm or %."""
    if vehicle.radius > LARGEST_TYRE:
        yield no_unit(vehicle.radius, "m", "a wheel", ("vehicle", "radius"))
    rolling = vehicle.rolling
    most = max((c for _, c in rolling), default=0.0) if isinstance(rolling, Sequence) else rolling
    if most > 1:
        message = (
            f"read {most:g}, more than a tyre can have: write a coefficient in % as `{most:g}%`, "
            f"and in N/kN as `{most:g}/1000`"
        )
        yield Problem("N205", message, ("vehicle", "rolling"))
    fastest = max((speed for speed, _ in vehicle.full_load), default=0.0)
    if fastest > (FASTEST_MACHINE if vehicle.machine else FASTEST_ENGINE):
        place = ("machine", "torque") if vehicle.machine else ("engine",)
        what = "a machine" if vehicle.machine else "an engine"
        yield no_unit(fastest, "rad/s", what, ("vehicle", *place))


def _machines_beside(case: TransmissionFields) -> Iterator[Problem]:
    for number, gear in enumerate(case.gears, 1):
        if why := beside_engine(case, gear):
            message = (
                f"the gear has {why}, so its ratio or its torques are not fixed, and results of "
                "`vehicle` omit this gear; give its points to `summary --duty`"
            )
            yield Problem("W890", message, ("gears", number))


def _losses_at_rest(case: TransmissionFields, vehicle: Vehicle) -> Iterator[Problem]:
    """Yield a warning for each gear whose loss takes all power at the first full-load point."""
    for number, gear in enumerate(case.gears, 1):
        if gear.loss is None or not vehicle.full_load:
            continue
        speed, torque = vehicle.full_load[0]
        lost = power_loss(gear.loss, speed, torque)
        if lost > 0 and lost >= speed * torque:
            message = (
                f"the loss of the gear is {lost:g} W at {speed / RAD_PER_RPM:g} rpm, where full "
                f"load has {speed * torque:g} W; its torque loss/|w| exceeds full load near rest, "
                "so the vehicle cannot start in this gear, and unless another gear starts it, the "
                "time to 100 km/h is null; give the loss in N*m, or 0 W at rest"
            )
            yield Problem("W892", message, ("gears", number, "loss"))


def without_vehicle(case: TransmissionFields) -> Iterator[Problem]:
    """Yield a note if no inertia contains the vehicle mass for simulation and vibration."""
    vehicle = Vehicle.of(case)
    if vehicle is None:
        return
    mass, inertias = _at_output(case, vehicle)
    if sum(inertias.values()) < MASS_AGAIN * mass:
        message = (
            "simulations and vibration omit the vehicle and use `inertias` only; its mass is an "
            f"inertia of {mass:.4g} kg*m^2 on the output, mass*(radius/final_drive)^2; give it in "
            "a second case without `vehicle`"
        )
        yield Problem("N607", message, ("vehicle",))


def _at_output(case: TransmissionFields, vehicle: Vehicle) -> tuple[float, Mapping[int, float]]:
    """Return the inertias of the vehicle mass and of geared links, at output speed [kg*m^2]."""
    outputs = case.outputs or (case.output,)
    mass = vehicle.mass * (vehicle.radius / vehicle.final_drive) ** 2
    return mass, {
        link: case.inertias[link] * speed**2
        for link, speed in _speeds_behind(case, outputs).items()
        if case.inertias.get(link)
    }


def _speeds_behind(case: TransmissionFields, outputs: Sequence[int]) -> dict[int, float]:
    """Return the speeds of links geared to the outputs, divided by output speed [-], by link.

    Links geared to an input belong to the engine instead. An example is the flywheel of a gearbox
    with a single gear, which can have half the inertia of the vehicle.
    """
    limits = {*outputs, 0}
    inputs = [link for gear in case.gears if (link := case.gear_input(gear)) not in limits]
    before = _geared(case, inputs, limits)
    speeds = _geared(case, outputs, {0})
    return {link: speed for link, speed in speeds.items() if link in outputs or link not in before}


def _geared(
    case: TransmissionFields, starts: Sequence[int], limits: Collection[int]
) -> dict[int, float]:
    """Return the speeds of links geared to a start, divided by its speed [-], by link."""
    speeds, new, pairs = dict.fromkeys(starts, 1.0), [*starts], list(_pairs(case))
    while new:
        link = new.pop()
        for first, other, ratio in pairs:
            if first == link and other not in speeds and other not in limits:
                speeds[other] = speeds[link] * ratio
                new.append(other)
    return speeds


def _pairs(case: TransmissionFields) -> Iterator[tuple[int, int, float]]:
    """Yield each pair of links with a fixed speed ratio, and the speed of the second per first.

    Such links are joined by a gear pair, by a gear set with a link on the housing, or by a spring
    that represents a shaft or a tyre.
    """
    for mechanism in case.mechanisms:
        parts = {
            mechanism.first: 1.0,
            mechanism.second: -mechanism.ratio,
            mechanism.third: mechanism.ratio - 1,
        }
        turning = [(link, part) for link, part in parts.items() if link and part]
        if not mechanism.kind and len(turning) == 2:
            (first, of_first), (second, of_second) = turning
            yield first, second, -of_first / of_second
            yield second, first, -of_second / of_first
    for spring in case.springs:
        joined = ends(spring.twist)
        if joined and all(joined):
            first, second = joined
            yield first, second, 1.0
            yield second, first, 1.0
