"""Torque converters of a gear: speed ratio, torque ratio, and the equation of the pump."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.model.transmission import Gear
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.carried import pump_factor, torque_of_pump
from vstatics.core.statics.matrix import torque_ratio_of
from vstatics.core.statics.state import GearState
from vstatics.core.tables.answer import Known, Sometimes
from vstatics.core.texts import tr


class ConverterPoint(NamedTuple):
    """Operating point of a converter that carries torque."""

    converter: str
    speed_ratio: Known
    """Speed ratio i: speed of the second link divided by speed of the first link. [-]"""
    torque_ratio: Known
    """Torque ratio K at the speed ratio. [-]"""
    factor: Sometimes[float] = None
    """Pump factor lambda, if load or slip determines the speed ratio. [N*m*s^2]"""
    speed: Sometimes[float] = None
    """Speed of the pump, if load or slip determines the speed ratio. [rad/s]"""
    torque: Sometimes[float] = None
    """Torque on the pump with losses, if load or slip determines the speed ratio. [N*m]"""
    by_slip: Sometimes[bool] = None
    """True if the slip of a shift element determines the speed ratio."""


CONVERTERS = "Converters: the torques M and -K M on the links, with and without losses"
"""Heading above the operating points of converters."""


def converter_points(state: GearState, given: Gear) -> list[ConverterPoint]:
    """Return the operating points of the converters that carry torque.

    Parameters
    ----------
    state : GearState
        State of the gear with the solved speed ratios.
    given : Gear
        Gear of the case, without speed ratios that the load determines.

    Examples
    --------
    >>> from vstatics import Load, Mechanism, Transmission, solve
    >>> converter = Mechanism(1, 2, 0, 0.5, name="TC", kind="converter", points=((0, 2), (1, 1)))
    >>> case = Transmission(2, [], [converter], [Gear()])
    >>> converter_points(solve(case).gear_at(0), case.gears[0])[0][:3]
    ('TC', 0.5, 1.5)
    """
    case, load = state.case, state.case.gear_load(state.gear)
    points = []
    for place in loaded_converters(state):
        converter, ratio = case.mechanisms[place], plain(state.ideal.variant.ratios[place])
        point = ConverterPoint(converter.name, ratio, plain(torque_ratio_of(converter, ratio)))
        if place in case.sought_converters(given):
            speed = plain(state.speeds[converter.first - 1]) * (load.speed or 0.0) * RAD_PER_RPM
            torque = plain(state.lossy_torques.on_first_link[case.among_devices.start + place])
            by_slip = bool(state.gear.pump_torques)
            point = point._replace(
                factor=float(pump_factor(converter.points, ratio)),
                speed=speed,
                torque=torque_of_pump(converter.points, ratio, speed)
                if by_slip
                else torque * case.torque_unit(state.gear),
                by_slip=by_slip or None,
            )
        points.append(point)
    return points


def loaded_converters(state: GearState) -> list[int]:
    """Return the indices of the converters that are neither bypassed nor open."""
    unloaded = state.case.unloaded_converters(state.gear)
    return [
        place
        for place, mechanism in enumerate(state.case.mechanisms)
        if mechanism.kind == "converter" and place not in unloaded
    ]


def sought_ratio(point: ConverterPoint) -> Iterator[str]:
    """Yield the equation of the pump, which determines the speed ratio, in words and in numbers."""
    if point.factor is None:
        return
    if point.by_slip:
        text = (
            "The slip determines the speed ratio i of {name}. The pump takes the torque M = "
            "lambda(i) w |w| at its speed w. lambda is interpolated linearly between its points."
        )
    else:
        text = (
            "The speed ratio i of {name} follows from the load: M = lambda(i) w |w|, with the "
            "torque M on its pump with losses and the speed w of its pump. lambda is interpolated "
            "linearly between its points. Of several solutions, i is the largest."
        )
    yield tr(text, name=point.converter)
    yield tr(
        "{name}: i = {ratio}, lambda = {factor} N*m*s^2, w = {speed} rad/s, M = {torque} N*m.",
        name=point.converter,
        ratio=f"{point.speed_ratio:.5g}",
        factor=f"{point.factor:.5g}",
        speed=f"{point.speed:.5g}",
        torque=f"{point.torque:.5g}",
    )
