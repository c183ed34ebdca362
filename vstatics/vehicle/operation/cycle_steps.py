"""Time steps of a driving cycle: gears, speeds, forces and losses."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Problem
from vstatics.core.model.parts import Law, OfLoad
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.statics.points.gear_loss import brake_torque, braked_torques
from vstatics.core.statics.points.relative import RPM
from vstatics.core.statics.power import loss_name
from vstatics.core.statics.solve import solve
from vstatics.core.summary.design_table import is_guess
from vstatics.core.tables.written_results import GEAR_NUMBER
from vstatics.vehicle.case.vehicle import Vehicle, beside_engine
from vstatics.vehicle.operation.converter import (
    ConverterGear,
    bare,
    converters_of,
    illinois_root,
    relative_slips,
    solved_slips,
)
from vstatics.vehicle.operation.converter_steps import ConverterSteps
from vstatics.vehicle.operation.cycle_case import ends_of, relative_drag, turned, with_clutches
from vstatics.vehicle.operation.gear_choice import GearChoice, chosen_gears
from vstatics.vehicle.operation.point_loads import (
    DutyPoints,
    PointLoads,
    at_rows,
)
from vstatics.vehicle.operation.shifting import (
    EngineSpeeds,
    directions,
)
from vstatics.vehicle.operation.trace import Trace, blocks
from vstatics.vehicle.tolerances import (
    LEAST_FORCE_EXCESS,
    LEAST_OPENING,
    SAME_DRAG_TORQUE,
    SAME_ENGINE_TORQUE,
    SAME_GEAR_POWER,
    SAME_SPEED,
)

ENLARGEMENT = 16
"""Factor by which a trial wheel force is enlarged, to bracket `least_forces`. [-]"""
MOST_ENLARGEMENTS = 8
"""Largest number of enlargements of a trial wheel force."""

MOST_DRAG_ROUNDS = 200
"""Largest number of calculations of drag that is relative to the input torque."""

_ALL_IS_DRAG = "drag without unit takes all of the input torque; give drag in N*m"


class CycleLosses(NamedTuple):
    """Losses over the steps of a cycle, and torques of engaged shift elements."""

    energies: defaultdict[str, float]
    """Lost energy by gear set, or by ``drag.NAME``, ``slip.NAME`` or ``gear.NAME``. [J]"""
    outside: dict[str, None]
    """Names of laws that were evaluated outside their points, as keys."""

    held_torques: Floats
    """Torque magnitudes of engaged shift elements, shape (steps, shift elements). [N*m]"""

    def add(self, loads: PointLoads, rows: Integers, duration: Floats) -> None:
        """Add the losses of the steps `rows`, each of a duration [s]."""
        self.held_torques[rows] = loads.held_torques
        self.outside.update(dict.fromkeys(loads.outside))
        for name, powers in (loads.losses() | loads.other_losses()).items():
            self.energies[name] += float(powers @ duration)


class CycleSteps(NamedTuple):
    """Time steps of a trace, each in a gear."""

    case: Transmission
    vehicle: Vehicle
    trace: Trace
    gears: Integers
    ratios: Floats
    """Link speeds divided by output speed, shape (gears, links). [-]

    The engine speed is positive. In a gear with a free converter, ratios are the changes of link
    speeds per change of output speed at constant engine speed.
    """
    converters: Mapping[int, ConverterGear]
    """Gears with a free converter, whose speed ratio follows from torques, by index."""
    engine: EngineSpeeds
    """Engine speeds in each gear, with free converters at their free ratio.

    The free ratio is the largest speed ratio without braking torque.
    """
    at_rest: Floats
    """Link speeds from slips in rpm while the output is at rest, shape (gears, links). [rad/s]"""
    engine_speeds: Floats
    """Magnitudes of engine speeds, shape (steps,). [rad/s]"""
    guessed: Sequence[str]
    """Names of gears that count as forward only because they are written first."""
    least_forces: Floats
    """Smallest wheel forces that slipping clutches or freewheels transmit; -inf if unlimited. [N]

    At this force a clutch or freewheel carries no torque. The shape is (steps,).
    """
    entering: Floats
    """Magnitudes of input torques, to which drag without unit is relative, shape (steps,). [N*m]"""
    opening: Mapping[int, Sequence[int]]
    """Numbers of freewheels that hold in a gear only if it drives, by index of the gear.

    In `case`, engaged clutches replace these freewheels.
    """

    @classmethod
    def of(
        cls, case: Transmission, vehicle: Vehicle, trace: Trace, choice: GearChoice
    ) -> CycleSteps:
        """Return the steps of a trace, with the gears of the trace or with chosen gears.

        Raises
        ------
        CaseError
            If a gear is not in the case.
        """
        if choice.least_loss and choice.least_speed is None:
            choice = choice._replace(least_speed=vehicle.first_speed)
        converters, beside = converters_of(case), [beside_engine(case, gear) for gear in case.gears]
        case = bare(case)
        results, added = solved_slips(case)
        case, opening = with_clutches(case, results)
        of_input, of_output = ((np.arange(len(case.gears)), links - 1) for links in ends_of(case))
        with np.errstate(all="ignore"):
            ratios = results.speeds / results.speeds[of_output][:, None]
            at_rest = added - ratios * added[of_output][:, None]
            ratios *= np.sign(ratios[of_input])[:, None]  # makes the engine speed positive
        wheels = trace.speed / vehicle.radius * vehicle.final_drive
        engine_ratios = np.abs(ratios[of_input])
        for index, converter in converters.items():
            ratios[index] = converter.per_output[2:]
        engine = EngineSpeeds(
            *(wheels, engine_ratios, at_rest[of_input], vehicle.may_turn, converters)
        )
        driving = np.where([not why for why in beside], results.ratio, math.nan)
        gears = chosen_gears(case, trace, choice, engine, driving)
        speeds = engine.of(gears)
        with np.errstate(invalid="ignore"):
            lacking = np.flatnonzero(~(np.isfinite(driving[gears]) & (speeds > 0)) & (wheels > 0))
        if lacking.size:
            row = int(lacking[0])
            why, name = beside[gears[row]], case.gears[gears[row]].name
            if math.isfinite(driving[gears[row]]):
                why = f"a slip with which the engine would turn at {speeds[row] * RPM:.6g} rpm"
            message = (
                f"gear {name} has {why or 'no ratio'}, expected a gear in which the engine alone "
                "drives the wheels" + "; give its points to `summary --duty`" * bool(why)
            )
            raise CaseError("E428", message, (row,))
        names = [gear.name for gear in case.gears]
        ways = directions(driving, names) if choice.least_speed is not None else []
        guessed = [names[index] for index in ways[0]] if is_guess(ways, names) else []
        steps = cls(
            *(case, vehicle, trace, gears, ratios, converters, engine, at_rest, speeds, guessed),
            np.full(len(gears), -math.inf),
            np.zeros(len(gears)),
            opening,
        )
        if not choice.least_loss or choice.least_speed is None:
            return steps
        return steps._in_gears(steps._of_least_loss(next(iter(ways), []), choice.least_speed))

    def _in_gears(self, gears: Integers) -> CycleSteps:
        return self._replace(gears=gears, engine_speeds=self.engine.of(gears))

    def _of_least_loss(self, ahead: Sequence[int], least: float) -> Integers:
        """Return the forward gear of each step that needs the least power of engine or battery.

        Gears that exceed full load or the last engine speed, or in which the engine turns slower
        than `least` [rad/s], are left out. A step without a remaining gear keeps its present gear.
        Among gears with equal powers, the gear with the smallest ratio is chosen.
        """
        best, gears = np.full(len(self.gears), math.inf), self.gears.copy()
        moving = np.flatnonzero(self.trace.speed > 0)
        at_wheels = np.abs(self.forces * self.trace.speed)
        for gear in sorted(ahead, key=lambda gear: float(self.engine.ratios[gear])):
            steps = self._in_gears(np.full(len(self.gears), gear))
            rows, powers = steps.powers_of(moving, least)
            better = powers < best[rows] - SAME_GEAR_POWER * (np.abs(powers) + at_wheels[rows])
            best[rows[better]], gears[rows[better]] = powers[better], gear
        return gears

    def powers_of(self, rows: Integers, least: float) -> tuple[Integers, Floats]:
        """Return the steps among `rows` within full load, and the powers of engine or battery [W].

        Steps without torques, beyond the last engine speed, or with an engine speed below `least`
        [rad/s] are left out, too.
        """
        speeds = self.engine_speeds[rows]
        rows = rows[self.vehicle.may_turn(speeds) & (speeds > 0)]
        torques = turning = np.zeros(0)
        while rows.size:
            try:
                driven = self.driven(rows)
                torques, turning = driven.torques[rows], driven.steps.engine_speeds[rows]
                break
            except CaseError as error:
                firsts = [problem.path[0] for problem in error.problems if problem.path]
                others = np.setdiff1d(rows, [row for row in firsts if isinstance(row, int)])
                if others.size == rows.size:
                    raise
                rows = others
        full = self.vehicle.full_torque(turning) if self.vehicle.full_load else np.inf
        within = (torques <= full + SAME_ENGINE_TORQUE) & self.vehicle.may_turn(turning)
        within &= turning >= least * (1 - SAME_SPEED)
        rows, torques, turning = rows[within], torques[within], turning[within]
        powers = torques * turning
        if self.vehicle.machine is not None:
            machine = self.vehicle.machine
            powers = machine.battery_power(machine.electric_power(powers, turning, torques))
            known = np.isfinite(powers)
            rows, powers = rows[known], powers[known]
        return rows, powers

    def at(self, rows: Integers) -> CycleSteps:
        """Return the steps `rows`; `trace.table` still contains all rows."""
        complete = self.trace
        trace = complete._replace(
            duration=complete.duration[rows],
            speed=complete.speed[rows],
            acceleration=complete.acceleration[rows],
            slope=complete.slope[rows],
        )
        return self._replace(
            trace=trace,
            gears=self.gears[rows],
            engine_speeds=self.engine_speeds[rows],
            least_forces=self.least_forces[rows],
            entering=self.entering[rows],
        )

    @property
    def forces(self) -> Floats:
        """Wheel forces for road resistance and vehicle acceleration; 0 at standstill [N]."""
        trace, vehicle = self.trace, self.vehicle
        force = vehicle.resistance(trace.speed, trace.slope) + vehicle.mass * trace.acceleration
        return np.where(trace.speed > 0, force, 0.0)

    @property
    def asked_forces(self) -> Floats:
        """Wheel forces that the engine or machine must supply, without the share of brakes [N].

        When braking, only the share `recuperation` counts. No force is less than `least_forces`.
        """
        forces = self.forces
        asked = np.where(forces < 0, self.vehicle.recuperation * forces, forces)
        return np.maximum(asked, self.least_forces)

    @property
    def output_speeds(self) -> Floats:
        """Output speeds with sign, for travel in the direction of the gear [rad/s]."""
        _, links = ends_of(self.case)
        output = self.trace.speed / self.vehicle.radius * self.vehicle.final_drive  # magnitude
        speeds: Floats = output * self.ratios[self.gears, links[self.gears] - 1]
        return speeds

    def course(self, engine: Floats) -> dict[str, Floats]:
        """Return columns of values at the middle of the steps, by heading."""
        drive = "machine" if self.vehicle.machine else "engine"
        starts = np.array(self.trace.table.numbers["time"][:-1])
        return {
            "time [s]": starts + self.trace.duration / 2,
            "speed [km/h]": 3.6 * self.trace.speed,
            GEAR_NUMBER: np.add(self.gears, 1, dtype=np.float64),
            f"{drive} speed [rpm]": self.engine_speeds * 30 / math.pi,
            f"{drive} torque [N*m]": engine,
            "wheel force [N]": self.forces,
        }

    def input_course(self, engine: Floats) -> dict[str, Floats]:
        """Return columns of the input by heading, as operating points of a duty cycle.

        The torque is the engine torque minus the torque that accelerates the input link.
        """
        moving = self.trace.speed > 0
        entering = engine + self._input_inertia(np.arange(len(engine)))
        return {
            "duration [s]": self.trace.duration,
            "speed [rpm]": np.where(moving, self.engine_speeds, 0.0) * 30 / math.pi,
            "torque [N*m]": np.where(moving, entering, 0.0),
        }

    def _input_inertia(self, rows: Integers) -> Floats:
        """Return the inertia torques ``-J dw/dt`` of the input link in the steps `rows` [N*m]."""
        inputs, _ = ends_of(self.case)
        return self._inertia_torque(rows, inputs[self.gears[rows]])

    def _inertia_torque(self, rows: Integers, link: int | Integers) -> Floats:
        """Return the inertia torques ``-J dw/dt`` in the steps `rows` [N*m].

        `link` is a link, or the link of each step.
        """
        change = self.trace.acceleration[rows] / self.vehicle.radius * self.vehicle.final_drive
        inertias = np.zeros(self.case.links + 1)
        inertias[[*self.case.heavy]] = [*self.case.heavy.values()]
        # a link of unknown speed is free and not accelerated
        ratios = np.nan_to_num(self.ratios[self.gears[rows], link - 1])
        torque: Floats = -inertias[link] * ratios * change
        return torque

    def _elsewhere(self, case: Transmission, rows: Integers) -> dict[str, Floats]:
        """Return inertia torques and drag by path [N*m].

        Outputs and links with given speeds have no inertia torque here, nor has the input link of a
        gear with a loss as a whole. This loss depends on the torque that the inertia of the input
        link leaves for the gear.
        """
        drag = {path: part * self.entering[rows] for path, part in relative_drag(case).items()}
        return drag | {
            f"gears.{gear.name}.torques.{case.link_name(link)}": self._inertia_torque(rows, link)
            for gear in case.gears
            for link, inertia in case.heavy.items()
            if inertia and link != case.gear_output(gear) and link not in gear.speeds
            if gear.loss is None or link != case.gear_input(gear)
        }

    def _output_torques(self, case: Transmission, rows: Integers, loads: PointLoads) -> Floats:
        """Return torques of the outputs of a case on their loads in the steps `rows` [N*m]."""
        _, outputs = ends_of(case)
        # An output cannot have a given torque in a case, so its inertia torque is added here.
        added = self._inertia_torque(rows, outputs[self.gears[rows]])
        return loads.taken(loads.results.lossy_output_torque_Nm) + added

    @property
    def inertia_energies(self) -> Floats:
        """Increases of kinetic energy [J], of all steps link by link, shape (links * steps,)."""
        before, after = self.trace.ends
        factor = self.vehicle.final_drive / self.vehicle.radius
        energies = [np.zeros(0)]
        for link, inertia in self.case.heavy.items():
            turned = self.ratios[self.gears, link - 1] * factor
            turns = self.at_rest[self.gears, link - 1]
            for gear, converter in self.converters.items():
                by_engine = converter.per_engine[1 + link] * self.engine_speeds
                by_engine = by_engine + converter.added[1 + link]
                turns = np.where(self.gears == gear, by_engine, turns)
            change = turned**2 * (after**2 - before**2) + 2 * turns * turned * (after - before)
            change = np.where(self.trace.speed > 0, change, 0.0)
            energies.append(np.nan_to_num(inertia / 2 * change))
        return np.concatenate(energies)

    def _from_wheels(self, rows: Integers) -> PointLoads:
        """Solve the steps `rows` backwards, with output and input exchanged."""
        points = DutyPoints(self.gears[rows], *self._load_of_wheels(rows), np.ones(len(rows)))
        return self._solved(turned(self.case, self.ratios), rows, points)

    def _load_of_wheels(
        self, rows: Integers, forces: Floats | None = None
    ) -> tuple[Floats, Floats]:
        """Return speeds [rad/s] and torques [N*m] of the output, for the backward calculation.

        `forces` are wheel forces [N], by default `asked_forces`.
        """
        here = self.at(rows)
        speeds = here.output_speeds
        forces = here.asked_forces if forces is None else forces
        torques = -forces * self.vehicle.radius / self.vehicle.final_drive
        return speeds, torques * np.sign(speeds)

    def _with_open_elements(self, rows: Integers) -> CycleSteps:
        """Return the steps with `least_forces`, at which freewheels and slipping clutches open.

        Where the wheels ask for less force, a freewheel of `opening` would overrun, or a slipping
        clutch would produce power. This shift element therefore carries no torque, and brakes
        absorb the difference.
        """
        slipping = [gear.slipping for gear in self.case.gears]
        opening = [self.opening.get(index, ()) for index in range(len(self.case.gears))]
        may_open = [bool(slip or held) for slip, held in zip(slipping, opening, strict=True)]
        rows = rows[np.array(may_open)[self.gears[rows]]]
        if not rows.size:
            return self
        numbers = range(1, len(self.case.shift_elements) + 1)
        slips, opens = np.array(
            [[[n in given for n in numbers] for given in gears] for gears in (slipping, opening)]
        )
        case = turned(self.case, self.ratios)
        case = case.replace(gears=[gear._replace(slip_drives=True) for gear in case.gears])

        def excess(part: Integers, forces: Floats) -> Floats:
            """Return the largest torque [N*m] or power [kW] with a wrong sign, else 0 or less."""
            here, gears = np.arange(len(part)), self.gears[rows[part]]
            speeds, torques = self._load_of_wheels(rows[part], forces)
            vary = {"load.speed": speeds, "load.torque": torques}
            results = solve(case, vary=vary | self._further(case, rows[part]))
            overrun = results.lossy_torques_Nm[here, gears, : len(numbers)]
            wrong = np.where(slips[gears], -results.slip_losses_kW[here, gears], -math.inf)
            wrong = np.where(opens[gears], overrun, wrong).max(axis=1)
            # Forces without torques, where a gear would be self-locking, are above the least force.
            wrong = np.where(np.isnan(wrong), -size[part], wrong)
            return np.where(np.abs(wrong) <= LEAST_OPENING * size[part], 0.0, wrong)

        low, size = self.asked_forces[rows], np.full(len(rows), np.nan)
        at_low = excess(np.arange(len(rows)), low)
        size = np.abs(at_low)
        part = np.flatnonzero(at_low > 0)
        if not part.size:
            return self
        high = np.maximum(low, 0.0)
        for _ in range(MOST_ENLARGEMENTS):
            at_high = excess(part, high[part])
            if not (at_high > 0).any():
                break
            larger = ENLARGEMENT * (high[part] + 1 + np.abs(low[part]))
            high[part] = np.where(at_high > 0, larger, high[part])
        part, at_high = part[at_high <= 0], at_high[at_high <= 0]
        forces = illinois_root(
            lambda places, x: excess(part[places], x),
            (low[part], high[part]),
            (at_low[part], at_high),
        )
        # The margin covers all forces at which the torque or power counts as 0.
        forces += np.where(forces, LEAST_FORCE_EXCESS * (np.abs(forces) + np.abs(low[part])), 0.0)
        least_forces = self.least_forces.copy()
        least_forces[rows[part]] = forces
        return self._replace(least_forces=least_forces)

    def _solved(self, case: Transmission, rows: Integers, points: DutyPoints) -> PointLoads:
        try:
            return PointLoads.of(case, points, self._further(case, rows))
        except CaseError as error:
            raise at_rows(error, rows) from None

    def _further(self, case: Transmission, rows: Integers) -> dict[str, Floats]:
        """Return the values of numbers other than the load in the steps `rows`, by path."""
        return self._elsewhere(case, rows) | self._speed_ratios(rows) | self._slips(rows)

    def _speed_ratios(self, rows: Integers) -> dict[str, Floats]:
        """Return the speed ratios of free converters in the steps `rows`, by path [-].

        In steps of other gears, a converter has its `free_ratio`. Where a freewheel can lock it up,
        the ratio is slightly below 1, because the converter itself cannot brake there.
        """
        here = self.at(rows)
        output = np.abs(here.output_speeds)
        return {
            converter.path: np.where(
                here.gears == gear,
                converter.driven_ratio(here.engine_speeds, output),
                converter.free_ratio,
            )
            for gear, converter in self.converters.items()
        }

    def _slips(self, rows: Integers) -> dict[str, Floats]:
        """Return slips [rad/s] by path, in gears with slips in rpm or with a free converter."""
        engine = self.engine_speeds[rows]
        return {
            path: slip * engine
            for index, gear in enumerate(self.case.gears)
            if index in self.converters or any(isinstance(s, OfLoad) for s in gear.slip.values())
            for path, slip in relative_slips(self.case, gear).items()
        }

    def _with_converters(self, rows: Integers) -> Iterator[ConverterSteps]:
        """Yield the steps among `rows` in each gear with a free converter."""
        for gear, converter in self.converters.items():
            places = rows[self.gears[rows] == gear]
            if places.size:
                cases = converter.case, turned(converter.case, self.ratios[[gear]])
                further = [self._elsewhere(case, places) for case in cases]
                load = self._load_of_wheels(places)
                slowing = self.trace.acceleration[places] < 0
                yield ConverterSteps(converter, self.vehicle, cases, further, load, places, slowing)

    def driven(self, rows: Integers) -> DrivenSteps:
        """Return the steps `rows` with engine speeds, and torques limited to the overrun torque.

        Raises
        ------
        CaseError
            If a step has no torques.
        """
        steps, is_relative = self, bool(relative_drag(self.case))
        earlier = self.entering, self.entering
        for _ in range(MOST_DRAG_ROUNDS):
            driven = steps._with_open_elements(rows).driven_by_engine(rows)
            entering, before = np.zeros(len(self.gears)), steps.entering
            entering[rows] = np.abs(driven.torques[rows] + self._input_inertia(rows))
            changed = np.flatnonzero(np.abs(entering - before) > SAME_DRAG_TORQUE * (1 + entering))
            if not (is_relative and changed.size):
                return driven
            steps = self._replace(entering=_along_secant(earlier, (before, entering)))
            earlier = before, entering
        raise CaseError([Problem("E424", _ALL_IS_DRAG, (row,)) for row in changed.tolist()])

    def driven_by_engine(self, rows: Integers) -> DrivenSteps:
        """Return the result of `driven` if `least_forces` are known."""
        speeds, torques = self.engine_speeds.copy(), np.zeros(len(self.gears))
        limited = np.zeros(len(self.gears), np.bool_)
        for part in self._with_converters(rows):
            speeds[part.rows], torques[part.rows] = part.from_wheels()
            limited[part.rows] = np.isfinite(torques[part.rows])
        steps = self._replace(engine_speeds=speeds)
        free = rows[~limited[rows]]
        for block in blocks(len(free)):
            torques[free[block]] = steps.engine_torques(free[block])
        least = self.vehicle.overrun_torque(speeds)
        over = np.zeros(len(self.gears), np.bool_)
        over[rows] = torques[rows] < least[rows] - SAME_ENGINE_TORQUE
        torques = np.where(over, least, torques)
        for part in self._with_converters(np.flatnonzero(over)):
            speeds[part.rows], torques[part.rows] = part.at_overrun()
        return DrivenSteps(self._replace(engine_speeds=speeds), torques, limited | over)

    def engine_torques(self, rows: Integers) -> Floats:
        """Return engine torques in the steps `rows`, with all losses; above 0 if driving [N*m].

        Raises
        ------
        CaseError
            If no torque, or several torques, agree with the loss of a gear as a whole.
        """
        here, loads = self.at(rows), self._from_wheels(rows)
        speeds = here.engine_speeds
        torques = -self._output_torques(turned(self.case, self.ratios), rows, loads) * np.sign(
            speeds
        )
        for number, gear in enumerate(self.case.gears):
            if gear.loss is not None:
                in_gear = here.gears == number
                inertia = self._input_inertia(rows)[in_gear]
                entering = _with_loss(
                    gear.loss, rows[in_gear], speeds[in_gear], torques[in_gear] + inertia
                )
                torques[in_gear] = entering - inertia
        return torques

    def add_losses(self, rows: Integers, engine: Floats, lost: CycleLosses) -> float:
        """Add the losses of steps in which engine or machine are not limited.

        Return the energy of the brakes, which supply the braking force beyond `recuperation` [J].
        """
        lost.add(self._from_wheels(rows), rows, self.trace.duration[rows])
        here = self.at(rows)
        speeds, entering = here.engine_speeds, engine[rows] + self._input_inertia(rows)
        for number, gear in enumerate(self.case.gears):
            own = here.gears == number
            if gear.loss is not None and own.any():
                sizes = speeds[own], np.abs(entering[own])
                if gear.loss.is_outside(*sizes).any():
                    lost.outside[f"the loss of gear {gear.name} ({gear.loss.domain()})"] = None
                brake = brake_torque(gear.loss, *sizes)
                energy = float((brake * speeds[own]) @ here.trace.duration[own])
                lost.energies[loss_name(gear)] += energy
        power = (here.asked_forces - here.forces) * here.trace.speed
        return float(power @ here.trace.duration)

    def braked(self, rows: Integers, engine: Floats, lost: CycleLosses) -> float:
        """Add the losses of steps with excess power; return the energy that brakes take [J]."""
        here = self.at(rows)
        has_loss = np.array([gear.loss is not None for gear in self.case.gears])[here.gears]
        entering = engine[rows] + np.where(has_loss, self._input_inertia(rows), 0.0)
        points = DutyPoints(here.gears, here.engine_speeds, entering, np.ones(len(rows)))
        loads = self._solved(self.case, rows, points)
        lost.add(loads, rows, self.trace.duration[rows])
        torque = self._output_torques(self.case, rows, loads) * np.sign(here.output_speeds)
        force = torque * self.vehicle.final_drive / self.vehicle.radius
        power = (force - here.forces) * here.trace.speed
        return float(power @ here.trace.duration)


def _along_secant(earlier: tuple[Floats, Floats], latest: tuple[Floats, Floats]) -> Floats:
    """Return the fixed points of functions on secants; arguments are pairs (x, function of x).

    Where a secant is as steep as ``y = x`` or steeper, the latest value is returned.

    >>> _along_secant((np.zeros(2), np.ones(2)), (np.ones(2), np.array([1.5, 3.0])))
    array([2., 3.])
    """
    (x0, y0), (x, y) = earlier, latest
    moved = np.where(x == x0, 1.0, x - x0)
    slope = np.where(x == x0, 0.0, (y - y0) / moved)
    steep = slope >= 1
    return np.where(steep, y, (y - slope * x) / np.where(steep, 1.0, 1 - slope))


class DrivenSteps(NamedTuple):
    """Time steps of a cycle with engine torques."""

    steps: CycleSteps
    torques: Floats
    """Engine torques, shape (steps,). [N*m]"""
    limited: Booleans
    """True in steps in which brakes absorb excess drive, or replace missing engine braking."""


def _with_loss(loss: Law, rows: Integers, speeds: Floats, torques: Floats) -> Floats:
    """Return input torques in a gear, increased by its overall loss, in the steps `rows` [N*m]."""
    with_loss, counts = braked_torques(loss, speeds, torques)
    problems = [
        Problem(
            "E424",
            f"{'no torque is' if count == 0 else 'more than one torque is'} consistent with "
            f"the loss of the gear as a whole, at {speed * RPM:.6g} rpm; in W, its "
            "torque loss/|w| has no bound near rest",
            (row,),
        )
        for row, speed, count in zip(rows.tolist(), speeds.tolist(), counts, strict=True)
        if count != 1
    ]
    if problems:
        raise CaseError(problems)
    return with_loss
