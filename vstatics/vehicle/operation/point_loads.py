"""Loads of links, members and shift elements at operating points."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Problem, listed, quoted
from vstatics.core.model.parts import Load
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.statics.carried import larger_torques
from vstatics.core.statics.matrix import column_of, held_links
from vstatics.core.statics.points.paths import columns_of
from vstatics.core.statics.points.relative import with_numbers
from vstatics.core.statics.power import loss_name, slip_name
from vstatics.core.statics.result_arrays import all_row_names, first_rows
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.vehicle.tolerances import NO_DRAG

MOST_REASONS = 20
"""Largest number of points without torques for which a reason is sought by solving again."""
REASONS = (
    *("E451", "E452", "W414", "W415", "W418", "W420", "W421", "W422", "W423", "W426", "W427"),
    *("W431", "W433", "W438"),
)
"""Ids of messages why a gear has no speeds or torques, most important first."""


class DutyPoints(NamedTuple):
    """Operating points of a duty cycle, as arrays of the same length."""

    gears: Integers
    """Gear index of each point."""
    speeds: Floats
    """Input speeds. [rad/s]"""
    torques: Floats
    """Input torques. [N*m]"""
    weights: Floats
    """Durations [s], or shares of time with any sum."""
    are_shares: bool = False


def at_rows(error: CaseError, rows: Integers) -> CaseError:
    """Return an error whose paths contain rows of a table instead of indices in `rows`."""
    problems = []
    for problem in error.problems:
        first = next(iter(problem.path), None)
        path = (int(rows[first]),) if isinstance(first, int) else problem.path
        problems.append(problem._replace(path=path))
    return CaseError(problems)


class PointLoads(NamedTuple):
    """Results of operating points, each in its gear; arrays have shape (points, ...)."""

    case: Transmission
    points: DutyPoints
    results: Results

    @classmethod
    def of(
        cls, case: Transmission, points: DutyPoints, further: Mapping[str, Floats] | None = None
    ) -> PointLoads:
        """Solve every point in its gear.

        `further` contains values of other numbers at the points by path, like `vary` of `solve`.

        Raises
        ------
        CaseError
            If a point has no torques; the path of a problem is the index of its point.
        """
        gears = [gear._replace(load=None) for gear in case.gears]
        bare = replace(case, gears=gears, load=Load(1000.0, 1.0))
        vary = {"load.speed": points.speeds, "load.torque": points.torques}
        vary |= further or {}
        loads = cls(bare, points, solve(bare, vary=vary))
        lacking = ~np.isfinite(loads.taken(loads.results.lossy_output_torque_Nm))
        problems = [
            Problem("E424", loads._lacking(row, vary if place < MOST_REASONS else {}), (row,))
            for place, row in enumerate(np.flatnonzero(lacking).tolist())
        ]
        if problems:
            raise CaseError(problems)
        return loads

    def _lacking(self, row: int, vary: Mapping[str, Floats]) -> str:
        """Return the error for a point without torques, with a reason unless `vary` is empty."""
        number = int(self.points.gears[row])
        text = f"gear {self.case.gears[number].name} has no torques with losses at this speed and "
        text += "torque"
        if not vary:
            return text
        here = {path: values[row : row + 1] for path, values in vary.items()}
        settled = with_numbers(self.case, columns_of(self.case, here, {}))
        alone = solve(replace(settled, gears=[settled.gears[number]]))
        texts = {message.id: message.text for message in reversed(alone.messages)}
        reasons = [texts[id_] for id_ in REASONS if id_ in texts]
        return ": ".join((text, *reasons[:1]))

    def taken(self, array: Any) -> Floats:
        """Return an entry of a results array (points, gears, ...) for each point, in its gear."""
        values: Floats = array[np.arange(len(self.points.gears)), self.points.gears]
        return values

    @property
    def input_torques(self) -> Floats:
        """Input torques, opposite to the speeds while the case coasts [N*m]."""
        assert self.results.points is not None  # noqa: S101 - loads vary
        units = self.taken(self.results.points.scales["Nm"])
        return np.where(self.points.torques == 0, 0.0, units)

    @property
    def outside(self) -> list[str]:
        """Names of laws that are evaluated out of their range at any point."""
        assert self.results.points is not None  # noqa: S101 - loads vary
        return [law for law, at in self.results.points.outside.items() if self.taken(at).any()]

    def losses(self) -> dict[str, Floats]:
        """Return the power loss of each gear set at each point, by name [W]."""
        powers = 1e3 * self.taken(self.results.losses_kW)
        names = [device.name for device in self.case.own_devices]
        return {name: np.nan_to_num(column) for name, column in zip(names, powers.T, strict=True)}

    def port_powers(self) -> tuple[Floats, Floats]:
        """Return the total input power, and the total output power, at each point [W]."""
        results = self.results
        return 1e3 * self.taken(results.input_power_kW), 1e3 * self.taken(results.output_power_kW)

    @property
    def speeds(self) -> Floats:
        """Speeds of links, with the housing first, shape (points, links) [rad/s]."""
        speeds = self.taken(self.results.speeds_rpm) * math.pi / 30
        return np.concatenate([np.zeros((len(speeds), 1)), speeds], axis=1)

    def elements(self) -> Iterator[tuple[str, Floats, Floats]]:
        """Yield each shift element: name, torques on its first link [N*m], and slips [rad/s]."""
        torques = self.taken(self.results.lossy_torques_Nm)
        slips = self.taken(self.results.slip_speeds_rpm) * math.pi / 30
        for place, element in enumerate(self.case.shift_elements):
            yield element.name, torques[:, place], slips[:, place]

    @property
    def held_torques(self) -> Floats:
        """Torque magnitudes of engaged shift elements, else 0, (points, elements) [N*m]."""
        holds, results = self.taken(self.results.holds), self.results
        sizes = larger_torques(results.torques_Nm, results.lossy_torques_Nm)
        return np.where(holds, self.taken(sizes)[:, : holds.shape[1]], 0.0)

    def device_torques(self) -> dict[str, Floats]:
        """Return torques on the first links of components, by name [N*m].

        A gear set has the torque of its mechanism, or the torques of mechanisms that represent its
        meshes, as in simulations.
        """
        rows, results = all_row_names(self.case), self.results
        torques = self.taken(results.lossy_torques_Nm).T
        by_name = dict(zip(rows["torques"], torques, strict=True))
        meshes = self.taken(results.lossy_mesh_torques_Nm).T
        by_name |= dict(zip(rows["meshes"], meshes, strict=True))
        for index, row in first_rows(self.case).items():
            by_name[self.case.mechanisms[index].name] = torques[row]
        return by_name

    def member_torques(self) -> dict[tuple[int, str], Floats]:
        """Return the torques from links on members [N*m], by gear set index and member."""
        torques = self.taken(self.results.lossy_torques_Nm)
        first = len(self.case.shift_elements)
        places = [
            (number, member.name)
            for number, device in enumerate(self.case.own_devices)
            for member in device.members
        ]
        if self.case.drawing is not None:
            return {place: torques[:, first + n] for n, place in enumerate(places)}
        by_member = {}
        for number, mechanism in enumerate(self.case.mechanisms):
            on_first = torques[:, first + number]
            first_part, second_part, _ = column_of(mechanism, self._ratios(number))
            with np.errstate(all="ignore"):
                second = second_part / first_part * on_first
            if mechanism.kind != "converter":  # its torque ratio includes losses
                second = second * self._loss_factor(number, on_first)
            by_name = {"first": on_first, "second": second, "third": -on_first - second}
            for device, name in places:
                if device == number:
                    by_member[device, name] = by_name[name]
        return by_member

    def _ratios(self, number: int) -> Floats:
        """Return the ratios of a mechanism at the points, constant or from speeds [-]."""
        mechanism, speeds = self.case.mechanisms[number], self.speeds
        by_gear = [self.case.gear_ratios(gear)[number] for gear in self.case.gears]
        given = np.array(by_gear, dtype=float)[self.points.gears]
        if not mechanism.kind:
            return given
        with np.errstate(all="ignore"):
            turned = speeds[:, mechanism.second] / speeds[:, mechanism.first]
        return np.where(np.isfinite(turned), turned, given)

    def _loss_factor(self, number: int, on_first: Floats) -> Floats:
        """Return ``1 - loss/power`` of a mechanism, for the power at its first link [-]."""
        mechanism, speeds = self.case.mechanisms[number], self.speeds
        power = on_first * (speeds[:, mechanism.first] - speeds[:, mechanism.third])
        lost = list(self.losses().values())[number]
        with np.errstate(all="ignore"):
            factor = np.where(np.abs(lost) > 0, 1 - lost / power, 1.0)
        return np.where(np.isfinite(factor), factor, 1.0)

    def link_torques(self) -> tuple[dict[int, list[Floats]], dict[int, Floats]]:
        """Return all torques on each link, and its drag torque, by link number [N*m]."""
        case, results, count = self.case, self.results, len(self.points.gears)
        on_link: dict[int, list[Floats]] = {link: [] for link in range(case.own_links + 1)}
        for place, (_, torque, _) in enumerate(self.elements()):
            element = case.shift_elements[place]
            on_link[element.first].append(-torque)
            on_link[element.second].append(torque)
        for (device, name), torque in self.member_torques().items():
            links = {member.name: member.link for member in case.own_devices[device].members}
            on_link[links[name]].append(-torque)
        torques = self.taken(results.lossy_torques_Nm)
        for place, spring in enumerate(case.springs, torques.shape[1] - 1 - len(case.springs)):
            for link, part in spring.form.items():
                on_link[link].append(-part * torques[:, place])
        held = np.nan_to_num(self.taken(results.lossy_holding_torques_Nm))
        assert results.points is not None  # noqa: S101 - loads vary
        points, units = results.points, self.taken(results.points.scales["Nm"])
        for index, gear in enumerate(case.gears):
            here = self.points.gears == index
            unit = np.where(here, self.input_torques, 0.0)
            on_link[case.gear_input(gear)].append(unit)
            on_link[case.gear_output(gear)].append(np.where(here, -torques[:, -1], 0.0))
            for link, given in points.gears[index].torques.items():
                on_link[link].append(np.where(here, given * units, 0.0))
            for link in held_links(case, gear):
                on_link[link].append(np.where(here, held[:, link - 1], 0.0))
        drags = {}
        for link in range(1, case.own_links + 1):
            known = [np.nan_to_num(torque) for torque in on_link[link]] or [np.zeros(count)]
            balance = -np.sum(known, axis=0)
            size = np.max(np.abs(known), axis=0)
            drags[link] = np.where(np.abs(balance) > NO_DRAG * size, balance, 0.0)
            on_link[link] = [*known, drags[link]]
        return on_link, drags

    def other_losses(self) -> dict[str, Floats]:
        """Return powers lost outside gear sets: in drag, slip, or a gear as a whole [W].

        The names are ``drag.NAME``, ``slip.NAME`` and ``gear.NAME``.
        """
        _, drags = self.link_torques()
        wholes = self._gear_losses()
        dragged = {link for gear in self.case.gears for link in self.case.gear_drag(gear)}
        losses = {}
        for link in sorted(dragged):
            power = np.abs(np.nan_to_num(drags[link] * self.speeds[:, link]))
            for gear in self.case.gears:
                if self.case.gear_input(gear) == link and gear.loss is not None:
                    power = power - wholes[loss_name(gear)]
            losses[f"drag.{self.case.link_name(link)}"] = power
        holds = self.taken(self.results.holds)
        for place, (name, torque, slip) in enumerate(self.elements()):
            powers = np.where(holds[:, place], 0.0, np.abs(np.nan_to_num(torque * slip)))
            if powers.any():
                losses[f"drag.{name}"] = powers
        return losses | self._slip_losses() | wholes

    def _slip_losses(self) -> dict[str, Floats]:
        """Return the power losses of shift elements that slip in any gear [W], by ``slip.NAME``."""
        slipping = sorted({number for gear in self.case.gears for number in gear.slip})
        if not slipping:
            return {}
        powers = 1e3 * np.nan_to_num(self.taken(self.results.slip_losses_kW))
        elements = self.case.shift_elements
        return {slip_name(elements[number - 1]): powers[:, number - 1] for number in slipping}

    def _gear_losses(self) -> dict[str, Floats]:
        """Return power losses of whole gears [W], by ``gear.NAME``; 0 at points of other gears."""
        if all(gear.loss is None for gear in self.case.gears):
            return {}
        powers = 1e3 * np.nan_to_num(np.abs(self.taken(self.results.gear_losses_kW)))
        return {
            loss_name(gear): np.where(self.points.gears == number, powers, 0.0)
            for number, gear in enumerate(self.case.gears)
            if gear.loss is not None
        }

    def members(self) -> Iterator[tuple[str, tuple[Floats, Floats]]]:
        """Yield links, members, planets and shift elements: name, torques [N*m], speeds [rad/s]."""
        case, speeds = self.case, self.speeds
        on_link, _ = self.link_torques()
        for link in range(1, case.own_links + 1):
            through = np.sum([np.maximum(torque, 0.0) for torque in on_link[link]], axis=0)
            yield case.link_name(link), (through, speeds[:, link])
        torques: dict[tuple[int, str], Any] = self.member_torques()
        for number, device in enumerate(case.own_devices):
            third = case.mechanisms[device.mechanisms[0]].third
            for member in device.members:
                relative = speeds[:, member.link] - speeds[:, third]
                yield f"{device.name}.{member.name}", (torques[number, member.name], relative)
        planets = [planet.name for device in case.own_devices for planet in device.planets]
        turning = self.taken(self.results.planet_speeds_rpm) * math.pi / 30
        for name, column in zip(planets, turning.T, strict=True):
            if not np.isnan(column).all():
                yield name, (np.full(len(column), np.nan), column)
        for name, torque, slip in self.elements():
            yield name, (torque, slip)


def numbers_of_gears(case: Transmission, names: Iterable[str]) -> list[int | None]:
    """Return the number of each gear (from 0) in a column of names; None for an unknown name.

    A table that was saved by pandas with an empty cell has `1.0` for gear 1.
    """
    numbers = {gear.name: number for number, gear in enumerate(case.gears)}
    return [numbers.get(name, numbers.get(name.removesuffix(".0"))) for name in names]


def unknown_gear(case: Transmission, name: str) -> str:
    """Return the message about a name that no gear of the case has."""
    gears = listed([gear.name for gear in case.gears], 12)
    return f"there is no gear {quoted(name)}, expected one of {gears}"
