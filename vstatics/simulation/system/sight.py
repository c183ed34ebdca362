"""What formulas see of a box in motion: where each of their words stands among what is seen.

All that is seen stands in one row: the rates of ports, twists, angles, values (states and
temperatures), then what follows from torques (`derived`).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import Path
from vstatics.core.model.springs import SpringLimit, TwistCurve
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.expressions.grammar import Applied
from vstatics.core.readers.expressions.operands import Constant
from vstatics.simulation.scenario.algebra import variables
from vstatics.simulation.scenario.conditions import StepCondition
from vstatics.simulation.scenario.crossings import MeetingParts, Pairs, asked, met
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.formula_code import Seen
from vstatics.simulation.scenario.programme import Look, Programme
from vstatics.simulation.system.curves import curve_along
from vstatics.simulation.system.matrices import Contact, Elastic, MotionSystem


def place_of(system: MotionSystem, seen: Seen) -> int:
    """Where something stands among all that is seen."""
    layout, names = system.layout, system.names
    twists = layout.ports
    angles = twists + len(system.springs)
    values = angles + len(layout.angles)
    match seen.word:
        case "speed":
            return layout.sensors + layout.sensed.index(names.index(seen.of))
        case "slip":
            return _slip(system, seen.of)
        case "twist":
            return twists + [one.name for one in system.springs].index(seen.of)
        case "angle":
            return angles + layout.angles.index(names.index(seen.of))
        case "value" | "temperature":
            return values + layout.values.index(seen)
        case _:
            return values + len(layout.values) + layout.derived.index(seen)


def _slip(system: MotionSystem, name: str) -> int:
    """The port of a shift element."""
    [number] = (n for n, one in enumerate(system.case.shift_elements) if one.name == name)
    for index, contact in enumerate(system.contacts):
        if contact.element == number:
            return system.layout.contacts + index
    [index] = (n for n, one in enumerate(system.springs) if one.element == number)
    return system.layout.springs + index


def looking(system: MotionSystem, formula: Formula, rate: int = 0, angle: int = -1) -> Look:
    """A formula as a function of the time and all that is seen, with the numbers that are set.

    Parameters
    ----------
    rate : int
        The port of its own link.
    angle : int
        The place of its own angle among those that are followed; -1: it has none.
    """
    function, along = formula.function, formula.along
    inputs: list[Look] = [
        fixed(system.settings[one.of])
        if one.word == "value" and one.of in system.settings
        else _place_seen(place_of(system, one))
        for one in formula.seen
    ]
    turned = system.layout.ports + len(system.springs) + angle if angle >= 0 else -1

    def value(time: float, seen: Sequence[float]) -> float:
        own = seen[turned] if turned >= 0 else 0.0
        return function(time, seen[rate], own, *[one.at(time, seen) for one in inputs])

    def values(times: Floats, seen: Floats) -> Floats:
        own = seen[turned] if turned >= 0 else 0.0
        return along(times, seen[rate], own, *[one.along(times, seen) for one in inputs])

    places = [turned] * (turned >= 0) + [rate] * ("speed" in formula.variables)
    return Look(value, values, (*places, *chain.from_iterable(one.places for one in inputs)))


class Compared(NamedTuple):
    """Two numbers that are compared."""

    first: Look
    second: Look

    def at(self, time: float, seen: Sequence[float]) -> tuple[float, float]:
        """Return both at an instant, by everything that is seen there."""
        return self.first.at(time, seen), self.second.at(time, seen)


class Corner(NamedTuple):
    """A place at which a formula, or a limit, bends or jumps."""

    path: Path
    """Of its key in the scenario."""
    text: str
    """The formula."""
    compared: Sequence[Compared]
    """One number, compared with ascending ones: of these the nearest count."""
    jumps: Sequence[bool]
    """For each of them, whether the formula may jump where it is reached."""


def compared(system: MotionSystem, difference: Formula, rate: int = 0, angle: int = -1) -> Compared:
    """The two sides of a difference, with the numbers that are set."""
    tree = difference.whole
    assert isinstance(tree, Applied)  # noqa: S101 - a difference is one
    first, second = (
        looking(system, difference._replace(tree=one), rate, angle) for one in tree.operands
    )
    return Compared(first, second)


def corners(system: MotionSystem) -> list[Corner]:
    """Where formulas that see something bend or jump: what they compare.

    What a table is asked with is compared with all its steps: of these the nearest count.
    """
    layout = system.layout
    found: list[tuple[Path, Formula, Pairs, int, int]] = []
    for device in system.may_slip:
        programme = device.programme
        if programme.look is not None and isinstance(programme.curve, Formula):
            most = () if programme.largest is None else (programme.largest,)
            path: Path = control_path(device)
            whole = programme.curve.whole
            bounds: list[Pairs] = [[MeetingParts(whole, Constant(bound))] for bound in (0.0, *most)]
            found += [(path, programme.curve, pairs, 0, -1) for pairs in (*bounds, *met(whole))]
    for port, one in enumerate(system.outside):
        if isinstance(one.law, Formula):  # jumps by its own motion are switches
            path = ("torques", system.names[one.link])
            place = layout.angles.index(one.link) if one.link in layout.angles else -1
            compares = met if one.law.seen else asked
            found += [(path, one.law, pairs, port, place) for pairs in compares(one.law.whole)]
    for state in system.scenario.states:
        if isinstance(state.rate, Formula):
            path = ("states", state.name, "rate")
            found += [(path, state.rate, pairs, 0, -1) for pairs in met(state.rate.whole)]
    for path, when in _conditions(system):
        found += [(path, one, pairs, 0, -1) for one in when.comparisons for pairs in met(one.whole)]
    made = [*_rubbing_corners(system), *_vanishing_limits(system)]
    for path, formula, pairs, rate, angle in found:
        first = pairs[0].first
        if not variables(Applied("-", pairs[0][:2], 0, 0)) - {"t"} - {*system.settings}:
            continue
        look = looking(system, formula._replace(tree=first), rate, angle)
        others = (
            looking(system, formula._replace(tree=pair.second), rate, angle) for pair in pairs
        )
        both = [Compared(look, other) for other in others]
        made.append(Corner(path, formula.text, both, [pair.jumps for pair in pairs]))
    return made


def control_path(device: Contact | Elastic) -> tuple[str, str]:
    """The key of a scenario that says what a device can carry."""
    return "limits" if device.element is None else "controls", device.name


def _conditions(system: MotionSystem) -> Iterator[tuple[Path, StepCondition]]:
    """What steps of sequences wait for, with its key in the scenario."""
    for sequence in system.scenario.sequences:
        for number, step in enumerate(sequence.steps, 1):
            if step.when is not None:
                yield ("sequences", sequence.name, number, "when"), step.when


def conditions(system: MotionSystem) -> Iterator[StepCondition]:
    """What steps of sequences wait for."""
    return (when for _, when in _conditions(system))


def _rubbing_corners(system: MotionSystem) -> Iterator[Corner]:
    """Temperatures and slips at which coefficients of friction bend."""
    for device in system.may_slip:
        if device.programme.table is not None:
            slip, temperature = _rubbing_places(system, device)
            table = device.programme.table
            places = [(temperature, column) for column in table.columns]
            places += [(slip, way * x) for way in (1, -1) for x in table.x if x]
            for place, bend in places:
                pair = Compared(_place_seen(place), fixed(bend))
                yield Corner(control_path(device), "friction", [pair], [False])


def _vanishing_limits(system: MotionSystem) -> Iterator[Corner]:
    """Where limits that follow other springs are cut at 0."""
    names = [spring.name for spring in system.springs]
    for one in system.springs:
        follows, look = one.programme.follows, one.programme.look
        if follows and look:
            index = names.index(follows.of)
            places = system.layout.springs + index, system.layout.ports + index
            pair = Compared(look._replace(places=places), fixed(0.0))
            yield Corner(control_path(one), "limit", [pair], [False])


def _place_seen(place: int) -> Look:
    return Look(lambda _time, seen: seen[place], lambda _times, seen: seen[place], (place,))


def fixed(value: float) -> Look:
    """A number that changes with nothing."""
    return Look(lambda _time, _seen: value, lambda times, _seen: np.full(len(times), value))


def with_settings(system: MotionSystem, settings: Mapping[str, float]) -> MotionSystem:
    """The system with numbers for what its formulas call so; its controls look by them."""
    system = replace(system, settings=settings)
    contacts = tuple(one._replace(programme=_seeing(system, one)) for one in system.contacts)
    springs = tuple(one._replace(programme=_seeing(system, one)) for one in system.springs)
    return replace(system, contacts=contacts, springs=springs)


def _seeing(system: MotionSystem, device: Contact | Elastic) -> Programme:
    programme, curve = device.programme, device.programme.curve
    if programme.follows:
        return programme._replace(look=following(system, programme.follows))
    if isinstance(curve, Formula) and curve.seen:
        programme = programme._replace(look=looking(system, curve))
    table = programme.table
    if table is None:
        return programme
    slip, temperature = _rubbing_places(system, device)

    rub = Look(
        lambda _time, seen: table.at(abs(seen[slip]), seen[temperature]),
        lambda _times, seen: table.along(np.abs(seen[slip]), seen[temperature]),
        (slip, temperature),
    )
    timed = Look(lambda time, _seen: curve.at(time), lambda times, _seen: curve_along(curve, times))
    return programme._replace(look=programme.look or timed, rub=rub)


def following(system: MotionSystem, limit: SpringLimit, pieces: Sequence[int] = ()) -> Look:
    """A limit by the torque of another spring, and of its damper.

    Parameters
    ----------
    pieces : sequence of int
        On which springs are, where it holds there alone.
    """
    [index] = (n for n, one in enumerate(system.springs) if one.name == limit.of)
    spring = system.springs[index]
    rate, twist = system.layout.springs + index, system.layout.ports + index
    if pieces and isinstance(spring.curve, TwistCurve) and not spring.can_part:
        spring = spring._replace(curve=spring.curve.alone(pieces[index]))

    def value(_time: float, seen: Sequence[float]) -> float:
        torque = spring.carried(seen[twist], seen[rate])
        return float(limit.base + limit.times * torque)

    def values(_times: Floats, seen: Floats) -> Floats:
        carried = map(spring.carried, seen[twist].tolist(), seen[rate].tolist())
        return np.asarray(limit.base + limit.times * np.array([*carried]))

    return Look(value, values)


def _rubbing_places(system: MotionSystem, device: Contact | Elastic) -> tuple[int, int]:
    """Where the slip and the temperature of a shift element stand among all that is seen."""
    temperature = place_of(system, Seen("temperature", device.name))
    return _slip(system, device.name), temperature
