"""Operating points of the converters of a gear: speeds and torques about which the gear vibrates.

The speed of the pump follows from the load and the speeds of the gear. If a speed ratio is given,
the torque that the pump then takes determines the input torque. Otherwise the speed ratio is the
ratio at which the pump takes the torque of the load. If other components connect pump and turbine,
such as a lock-up clutch, they determine the speed ratio. In neutral, a converter carries nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, listed, plural, spoken
from vstatics.core.model.converters import Converter
from vstatics.core.model.open_converters import with_mechanisms, with_open_converters
from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.statics.carried import disagree, disagreement, torque_of_pump
from vstatics.core.statics.points.converters import known_speed_ratios
from vstatics.core.statics.result_arrays import first_rows
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.core.suggestions import nearest
from vstatics.torsion.system.converters import WorkingConverter, working_converter
from vstatics.torsion.system.gear_system import torsional_system
from vstatics.torsion.tolerances import (
    REAL_EIGENVALUE,
    SAME_INPUT_TORQUE,
    SECANT_STEP,
    SPEED_RATIO_STEP,
)

Ratios = Mapping[str, float]
"""Speed ratios by name of the converter [-]."""


class WorkingGear(NamedTuple):
    """Gear at an operating point; its case has mechanisms instead of converters."""

    case: Transmission
    gear: Gear
    converters: tuple[WorkingConverter, ...] = ()
    doubts: tuple[str, ...] = ()
    """Warnings about converters whose pumps do not take the torque of the load."""


FAR = (1.0, 8.0, 64.0, 512.0, 4096.0)
"""Trial input torques, divided by the torque of the pump. [-]

Large values are needed because drag can absorb a small torque.
"""


def mean_gear(case: Transmission, gear: Gear) -> WorkingGear:
    """Return a gear at its operating point, or unchanged if the point is unknown."""
    try:
        return working_gear(case, gear, {})
    except CaseError:
        return WorkingGear(case, gear)


def working_gear(case: Transmission, gear: Gear, given: Ratios) -> WorkingGear:
    """Find the operating points of the converters of a gear.

    Parameters
    ----------
    given : mapping of str to float
        Speed ratios by name of the converter, instead of the ratios in the gear. [-]

    Raises
    ------
    CaseError
        If a speed or a speed ratio is unknown, or a converter has no lambda.
    ValueError
        If a name in `given` is not the name of a converter.
    """
    opened = with_open_converters(case)
    names = [converter.name for converter in opened.converters]
    for name in given:
        if name not in names:
            hint = nearest(name, names) or f"; converters are {listed(names) or 'none'}"
            raise ValueError(f"no converter {name!r}{hint}")
    if not names:
        return WorkingGear(case, gear)
    return _WorkingPoints(case, opened, case.gear_number(gear.name) - 1).working_gear(given)


class _OnPump(NamedTuple):
    """Torques at the pump of a converter for an assumed speed ratio."""

    brought: float
    """Torque of the load on the pump. [N*m]"""
    able: float
    """Torque that the pump takes at its speed and speed ratio. [N*m]"""
    at: tuple[float, float]
    """Speed ratio [-] and speed of the pump [rad/s]."""

    @property
    def excess(self) -> float:
        """Torque that the pump takes minus torque of the load [N*m]."""
        return self.able - self.brought


class _WorkingPoints:
    """Solver for the operating points of the converters of a gear."""

    def __init__(self, case: Transmission, opened: Transmission, gear: int) -> None:
        self.case = case
        self.opened = opened
        self.gear = opened.gears[gear]
        self.path = ("gears", gear + 1)
        self.load = opened.gear_load(self.gear)
        self.joined = dict(self._joined())
        self.names = [part.name for part in opened.mechanisms[opened.own_mechanisms]]
        self.names += [converter.name for converter in opened.converters]
        empty = {self.names[number - 1] for number in self.gear.open}
        self.filled = [c for c in opened.converters if c.name not in empty]
        self.driving: list[Converter] = []
        """Converters with a given speed ratio; the first determines the input torque."""
        self.at_slip: Results | None = None
        """Results of a gear whose slip determines a speed ratio."""

    @property
    def closed(self) -> list[Converter]:
        """Converters with fluid that no other component bridges."""
        return [pump for pump in self.filled if pump.name not in self.joined]

    def working_gear(self, given: Ratios) -> WorkingGear:
        ratios = self._given() | dict(given)
        self.driving = [pump for pump in self.closed if pump.name in ratios]
        if self.gear.slipping and None not in self.load[:2]:
            alone = solve(self.case.replace(gears=[self.case.gears[self.path[1] - 1]]))
            if alone.gear_at(0).gear.pump_torques:
                ratios = known_speed_ratios(alone, 0) | ratios
                # The clutch carries the torque that the pump does not take, without vibration.
                self.gear, self.at_slip, self.driving = self.gear._replace(slip={}), alone, []
        unknown = [converter for converter in self.closed if converter.name not in ratios]
        trial = dict.fromkeys((converter.name for converter in unknown), 1.0)
        if trial and np.isnan(solve(self._case_at(ratios | trial)).ratio[0]):  # neutral
            self.filled = [pump for pump in self.filled if pump not in unknown]
        elif len(unknown) == 1 and self.at_slip is None:
            ratios[unknown[0].name] = self._ratio(unknown[0], ratios)
        elif unknown:
            raise self._unknown(
                unknown,
                "a load determines only one ratio, and a slip only ratios within the points",
            )
        case, doubts = self._loaded(self._case_at(ratios))
        results = self.at_slip or solve(case)
        working = []
        for converter in self.filled:
            name = converter.name
            ratio = self.joined.get(name, ratios.get(name, 0.0))
            if self.load.speed is None and name in self.joined:
                at_unit_speed = working_converter("", (0, 0), converter.points, ratio, 1.0)
                if not any(at_unit_speed[-4:]):  # all derivatives are 0
                    continue
            links = converter.pump - 1, converter.turbine - 1
            speed = self._pump_speed(converter, results)
            working.append(working_converter(name, links, converter.points, ratio, speed))
        return WorkingGear(case, case.gears[0], tuple(working), doubts)

    def _joined(self) -> Iterator[tuple[str, float]]:
        """Yield the names and speed ratios of converters bridged by other components.

        The speed ratio is 0 if the pump is at rest.
        """
        system = torsional_system(self.opened, self.gear)
        motions = system.free(*system.elastic_twists)
        for converter in self.opened.converters:
            pump, turbine = motions[converter.pump - 1], motions[converter.turbine - 1]
            sizes = np.abs(pump)
            if not sizes.any():
                yield converter.name, 0.0
                continue
            ratio = float(turbine[sizes.argmax()] / pump[sizes.argmax()])
            apart = np.abs(turbine - ratio * pump).max()
            if apart <= REAL_EIGENVALUE * max(sizes.max(), np.abs(turbine).max()):
                yield converter.name, ratio

    def _given(self) -> dict[str, float]:
        """Return the ratios of mechanisms, also of converters, that the case or gear specifies."""
        known = {
            mesh.name: mesh.ratio for mesh in self.case.mechanisms if not math.isnan(mesh.ratio)
        }
        return known | {self.names[n - 1]: i for n, i in self.gear.speed_ratios.items()}

    def _case_at(self, ratios: Ratios) -> Transmission:
        of_case = self.opened.mechanisms[self.opened.own_mechanisms]
        speed_ratios = {n: i for n, i in self.gear.speed_ratios.items() if n <= len(of_case)}
        mechanisms = [*of_case, *(c.at_ratio(ratios[c.name]) for c in self.closed)]
        gears = [self.gear._replace(speed_ratios=speed_ratios, open=())]
        return with_mechanisms(self.opened, mechanisms, converters=(), gears=gears)

    def _pump_speed(self, converter: Converter, results: Results) -> float:
        relative = float(results.speeds[0, converter.pump - 1])
        if self.load.speed is None:
            raise CaseError(
                "E523",
                f"the speed of the pump of {converter.name} is unknown: give `speed` in the `load`",
                self.path,
            )
        speed = relative * self.load.speed * RAD_PER_RPM
        if math.isnan(speed):
            raise CaseError(
                "E524",
                f"the pump of {converter.name} has no speed in gear {self.gear.name}; "
                "`vstatics run` gives the reason",
                self.path,
            )
        return speed

    def _ratio(self, converter: Converter, ratios: Ratios) -> float:
        """Return the largest speed ratio at which the pump takes the torque of the load."""
        if (self.load.torque is None and not self.driving) or self.load.speed is None:
            raise self._unknown([converter], "a `load` with speed and torque would determine it")
        corners = {point[0] for point in converter.points}
        corners.add(max(1.0, *corners))
        excess = {ratio: self._excess(converter, ratios, ratio) for ratio in corners}
        for above, below in pairwise(sorted(corners, reverse=True)):
            if excess[above] == 0:
                return above
            if excess[above] * excess[below] <= 0:
                from scipy.optimize import brentq  # slow import, seldom needed

                excess_at = partial(self._excess, converter, ratios)
                return float(brentq(excess_at, below, above, xtol=SPEED_RATIO_STEP))
        why = (
            f"at no speed ratio up to {max(corners):g} it takes the torque of the load at its speed"
        )
        raise self._unknown([converter], why)

    def _excess(self, converter: Converter, ratios: Ratios, ratio: float) -> float:
        case, _ = self._loaded(self._case_at({**ratios, converter.name: ratio}))
        return self._on_pump(converter, case).excess

    def _on_pump(self, converter: Converter, case: Transmission) -> _OnPump:
        results, names = solve(case), [part.name for part in case.mechanisms]
        place = names.index(converter.name)
        ratio = case.mechanisms[place].ratio
        speed = self._pump_speed(converter, results)
        brought = float(results.lossy_torques_Nm[0, first_rows(case)[place]])
        return _OnPump(brought, torque_of_pump(converter.points, ratio, speed), (ratio, speed))

    def _loaded(self, case: Transmission) -> tuple[Transmission, tuple[str, ...]]:
        """Return the case with the input torque that its pumps take, and warnings about loads."""
        if not self.driving:
            return case, ()
        doubts = []
        if self.load.torque is not None:
            on_pumps = [(pump.name, self._on_pump(pump, case)) for pump in self.driving]
            if abs(on_pumps[0][1].excess) <= SAME_INPUT_TORQUE * abs(on_pumps[0][1].able):
                return case, ()
            doubts = [disagreement(name, *pump) for name, pump in on_pumps if disagree(*pump[:2])]
        torque = self._input_torque(self.driving[0], case)
        if torque is None:
            return case, tuple(doubts)
        addition = f"; this vibration is about {torque:.5g} N*m at the input"
        return case.with_torque(torque), tuple(doubt + addition for doubt in doubts)

    def _input_torque(self, converter: Converter, case: Transmission) -> float | None:
        """Return the input torque that gives a pump exactly the torque it takes, or None."""

        def excess(torque: float) -> float:
            return self._on_pump(converter, case.with_torque(torque)).excess

        idle = self._on_pump(converter, case.with_torque(0.0))
        if not idle.excess:
            return 0.0
        size = max(1.0, abs(idle.able))
        for first in (sign * size * more for more in FAR for sign in (1, -1)):
            at_first, at_second = excess(first), excess(2 * first)
            start = (
                first - first * at_first / (at_second - at_first)
                if at_second != at_first
                else math.nan
            )
            if start / first > 0:
                if abs(excess(start)) <= SAME_INPUT_TORQUE * abs(idle.able) / 1000:
                    return start
                from scipy.optimize import root_scalar  # slow import, seldom needed

                solution = root_scalar(
                    excess, method="secant", x0=start, x1=start * (1 + SECANT_STEP)
                )
                return float(solution.root) if solution.converged else None
        return None

    def _unknown(self, converters: list[Converter], why: str) -> CaseError:
        names = spoken([converter.name for converter in converters])
        return CaseError(
            "E525",
            f"the {plural('speed ratio', len(converters))} of {names} in gear {self.gear.name} "
            f"{'is' if len(converters) == 1 else 'are'} unknown: give `speed_ratios` in the "
            f"gear, or --speed-ratio; {why}",
            self.path,
        )
