"""At which speeds and torques the converters of a gear work, about which it vibrates.

The speed of the pump follows from the load, by the speeds of the gear. Where the speed ratio is
given, the torque that the pump takes there determines the torque of the input. Else the speed ratio
is that at which the converter takes the torque that the load brings to its pump. Where other
devices join pump and turbine, as a lock-up clutch does, the speed ratio is theirs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Path, listed, plural, spoken
from vstatics.core.model.converters import Converter
from vstatics.core.model.open_converters import with_mechanisms, with_open_converters
from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.statics.carried import disagree, disagreement, torque_of_pump
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
"""Speed ratios of converters, by their names [-]."""


class WorkingGear(NamedTuple):
    """A gear, its case with the converters as mechanisms of their speed ratios, and these."""

    case: Transmission
    gear: Gear
    converters: tuple[WorkingConverter, ...] = ()
    doubts: tuple[str, ...] = ()
    """Converters whose pumps do not take the torque of the load."""


FAR = (1.0, 8.0, 64.0, 512.0, 4096.0)
"""Torques of the input from which its torque is sought, as parts of the torque that the pump takes:
less than drag takes may not come through. [-]"""


def mean_gear(case: Transmission, gear: Gear) -> WorkingGear:
    """Return a gear at its working point, or as it is where no working point is known."""
    try:
        return working_gear(case, gear, {})
    except CaseError:
        return WorkingGear(case, gear)


def working_gear(case: Transmission, gear: Gear, given: Ratios) -> WorkingGear:
    """The converters of a gear where they work.

    Parameters
    ----------
    given : mapping of str to float
        Speed ratios, in place of those of the gear. [-]

    Raises
    ------
    CaseError
        If a speed or a speed ratio is not known, or a converter has no lambda.
    ValueError
        If there is no converter of a name that is given.
    """
    opened = with_open_converters(case)
    names = [one.name for one in opened.converters]
    for name in given:
        if name not in names:
            hint = nearest(name, names) or f"; converters are {listed(names) or 'none'}"
            raise ValueError(f"no converter {name!r}{hint}")
    if not names:
        return WorkingGear(case, gear)
    return _WorkingPoints(case, opened, case.gear_number(gear.name) - 1).found(given)


class _OnPump(NamedTuple):
    """Torques at the pump of a converter."""

    brought: float
    """Torque that the load brings. [N*m]"""
    able: float
    """Torque that the pump takes. [N*m]"""
    at: tuple[float, float]
    """Speed ratio [-] and speed of the pump [rad/s]."""

    @property
    def excess(self) -> float:
        """What the pump takes less what comes to it [N*m]."""
        return self.able - self.brought


class _WorkingPoints:
    """The converters of a gear."""

    def __init__(self, case: Transmission, opened: Transmission, gear: int) -> None:
        self.case = case
        self.opened = opened
        self.gear = opened.gears[gear]
        self.path: Path = ("gears", gear + 1)
        self.load = opened.gear_load(self.gear)
        self.joined = dict(self._joined())
        self.closed = [one for one in opened.converters if one.name not in self.joined]
        self.driving: list[Converter] = []
        """Converters at given speed ratios; the first determines the torque of the input."""

    def found(self, given: Ratios) -> WorkingGear:
        """Where they work."""
        ratios = self._given() | dict(given)
        self.driving = [pump for pump in self.closed if pump.name in ratios]
        unknown = [one for one in self.closed if one.name not in ratios]
        if len(unknown) == 1:
            ratios[unknown[0].name] = self._ratio(unknown[0], ratios)
        elif unknown:
            raise self._unknown(unknown, "of one converter alone it follows from the load")
        case, doubts = self._loaded(self._with(ratios))
        results = solve(case)
        working = []
        for one in self.opened.converters:
            ratio = self.joined.get(one.name, ratios.get(one.name, 0.0))
            if self.load.speed is None and one.name in self.joined:
                at_once = working_converter("", (0, 0), one.points, ratio, 1.0)
                if not any(at_once[-4:]):  # at any speed it takes no part
                    continue
            speed = self._pump_speed(one, results)
            links = one.pump - 1, one.turbine - 1
            working.append(working_converter(one.name, links, one.points, ratio, speed))
        return WorkingGear(case, case.gears[0], tuple(working), doubts)

    def _joined(self) -> Iterator[tuple[str, float]]:
        """Speed ratios of converters whose links other devices join; 0 where the pump stands."""
        system = torsional_system(self.opened, self.gear)
        motions = system.free(*system.elastic_twists)
        for one in self.opened.converters:
            pump, turbine = motions[one.pump - 1], motions[one.turbine - 1]
            sizes = np.abs(pump)
            if not sizes.any():
                yield one.name, 0.0
                continue
            ratio = float(turbine[sizes.argmax()] / pump[sizes.argmax()])
            apart = np.abs(turbine - ratio * pump).max()
            if apart <= REAL_EIGENVALUE * max(sizes.max(), np.abs(turbine).max()):
                yield one.name, ratio

    def _given(self) -> dict[str, float]:
        """Speed ratios that the mechanisms or the gear give."""
        own = [one for one in self.case.mechanisms if one.kind == "converter"]
        found = {one.name: one.ratio for one in own if not math.isnan(one.ratio)}
        first = len(self.opened.mechanisms[self.opened.own_mechanisms])
        names = [one.name for one in self.opened.converters]
        for number, ratio in self.gear.speed_ratios.items():
            if number > first:
                found[names[number - first - 1]] = ratio
        return found

    def _with(self, ratios: Ratios) -> Transmission:
        """The case of this gear with converters as mechanisms."""
        own = self.opened.mechanisms[self.opened.own_mechanisms]
        kept = {n: ratio for n, ratio in self.gear.speed_ratios.items() if n <= len(own)}
        mechanisms = [*own, *(one.at_ratio(ratios[one.name]) for one in self.closed)]
        gears = [self.gear._replace(speed_ratios=kept)]
        return with_mechanisms(self.opened, mechanisms, converters=(), gears=gears)

    def _pump_speed(self, converter: Converter, results: Results) -> float:
        """The speed of a pump [rad/s]."""
        relative = float(results.speeds[0, converter.pump - 1])
        if self.load.speed is None:
            message = f"the speed of the pump of {converter.name} is not known: give `speed` in "
            raise CaseError("E523", f"{message}the `load`", self.path)
        speed = relative * self.load.speed * RAD_PER_RPM
        if math.isnan(speed):
            message = f"the pump of {converter.name} has no speed in gear {self.gear.name}, as "
            raise CaseError("E524", f"{message}`vstatics run` tells of it", self.path)
        return speed

    def _ratio(self, converter: Converter, ratios: Ratios) -> float:
        """The largest speed ratio up to 1 at which a converter takes what comes to its pump."""
        if (self.load.torque is None and not self.driving) or self.load.speed is None:
            raise self._unknown([converter], "speed and torque of the `load` would tell it")
        corners = {point[0] for point in converter.points if point[0] < 1} | {1.0}
        excess = {ratio: self._excess(converter, ratios, ratio) for ratio in corners}
        for above, below in pairwise(sorted(corners, reverse=True)):
            if excess[above] == 0:
                return above
            if excess[above] * excess[below] <= 0:
                from scipy.optimize import brentq  # most gears do without

                def of(ratio: float) -> float:
                    return self._excess(converter, ratios, ratio)

                return float(brentq(of, below, above, xtol=SPEED_RATIO_STEP))
        why = "at no speed ratio up to 1 it takes the torque of the load at the speed of the load"
        raise self._unknown([converter], why)

    def _excess(self, converter: Converter, ratios: Ratios, ratio: float) -> float:
        """What a converter takes at a speed ratio less what comes to its pump [N*m]."""
        case, _ = self._loaded(self._with({**ratios, converter.name: ratio}))
        return self._on_pump(converter, case).excess

    def _on_pump(self, converter: Converter, case: Transmission) -> _OnPump:
        results, place = solve(case), case.devices.index(converter.name)
        ratio = case.mechanisms[place - len(case.shift_elements)].ratio
        speed = self._pump_speed(converter, results)
        brought = float(results.lossy_torques_Nm[0, place - len(case.devices) - 1])
        return _OnPump(brought, torque_of_pump(converter.points, ratio, speed), (ratio, speed))

    def _loaded(self, case: Transmission) -> tuple[Transmission, tuple[str, ...]]:
        """The case under the torque that the pumps ask for, and doubts about the given one."""
        if not self.driving:
            return case, ()
        doubts = []
        if self.load.torque is not None:
            given = [(pump.name, self._on_pump(pump, case)) for pump in self.driving]
            if abs(given[0][1].excess) <= SAME_INPUT_TORQUE * abs(given[0][1].able):
                return case, ()
            doubts = [disagreement(name, *pump) for name, pump in given if disagree(*pump[:2])]
        torque = self._input_torque(self.driving[0], case)
        if torque is None:
            return case, tuple(doubts)
        about = f"; this vibration is about {torque:.5g} N*m at the input"
        return case.with_torque(torque), tuple(doubt + about for doubt in doubts)

    def _input_torque(self, converter: Converter, case: Transmission) -> float | None:
        """The torque of the input at which a pump carries what it takes; None if none does so."""

        def excess(torque: float) -> float:
            return self._on_pump(converter, case.with_torque(torque)).excess

        idle = self._on_pump(converter, case.with_torque(0.0))
        if not idle.excess:
            return 0.0
        size = max(1.0, abs(idle.able))
        for first in (sign * size * more for more in FAR for sign in (1, -1)):
            near, far = excess(first), excess(2 * first)
            start = first - first * near / (far - near) if far != near else math.nan
            if start / first > 0:
                if abs(excess(start)) <= SAME_INPUT_TORQUE * abs(idle.able) / 1000:
                    return start
                from scipy.optimize import root_scalar  # most gears do without

                solution = root_scalar(
                    excess, method="secant", x0=start, x1=start * (1 + SECANT_STEP)
                )
                return float(solution.root) if solution.converged else None
        return None

    def _unknown(self, converters: list[Converter], why: str) -> CaseError:
        names = spoken([one.name for one in converters])
        message = (
            f"the {plural('speed ratio', len(converters))} of {names} in gear {self.gear.name} "
            f"{'is' if len(converters) == 1 else 'are'} not known: give `speed_ratios` in the "
            f"gear, or --speed-ratio; {why}"
        )
        return CaseError("E525", message, self.path)
