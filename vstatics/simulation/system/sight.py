"""Quantities of the motion that formulas read, in a fixed order (the *seen* quantities).

The order is: rates of ports, twists of springs, angles of links, values (control states and
temperatures), shares of jumps, and quantities derived from torques (`PortLayout.derived`).
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import Path
from vstatics.core.model.springs import SpringLimit, TwistCurve
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.expressions.grammar import Applied
from vstatics.core.readers.expressions.operands import Constant
from vstatics.simulation.scenario.algebra import bare, variables
from vstatics.simulation.scenario.conditions import StepCondition
from vstatics.simulation.scenario.crossings import MeetingParts, Pairs, asked, met
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.formula_code import Seen
from vstatics.simulation.scenario.parts import placed_steps
from vstatics.simulation.scenario.programme import Look, Programme, within
from vstatics.simulation.system.curves import curve_along
from vstatics.simulation.system.matrices import Contact, Elastic, MotionSystem
from vstatics.simulation.system.shares import JumpPlace, Slide, on_sides, shared
from vstatics.simulation.system.structure import null
from vstatics.simulation.tolerances import PROPORTIONAL

SAMPLES = 6
"""Number of samples in a comparison of two differences."""


def place_of(system: MotionSystem, seen: Seen) -> int:
    """Return the index of a quantity among all seen quantities."""
    layout, names = system.layout, system.names
    match seen.word:
        case "speed":
            return layout.sensors + layout.sensed.index(names.index(seen.of))
        case "slip":
            return _slip(system, seen.of)
        case "twist":
            return layout.ports + [spring.name for spring in system.springs].index(seen.of)
        case "angle":
            return layout.seen_angles + layout.angles.index(names.index(seen.of))
        case "value" | "temperature":
            return layout.seen_values + (*layout.values, *layout.shares).index(seen)
        case _:
            return layout.seen_derived + layout.derived.index(seen)


def _slip(system: MotionSystem, name: str) -> int:
    """Return the port of the contact or spring that represents a shift element."""
    [place] = (
        place
        for place, device in enumerate(system.may_slip, system.layout.contacts)
        if device.element is not None and device.name == name
    )
    return place


def looking(system: MotionSystem, formula: Formula, rate: int = 0, angle: int = -1) -> Look:
    """Return a formula as a function of time and seen quantities; settings are replaced by values.

    Parameters
    ----------
    rate : int
        Port of the link on which the formula acts.
    angle : int
        Index of the angle of this link among the recorded angles, or -1.
    """
    formula = shared(formula, system.slides, rate, angle)
    function, along = formula.function, formula.along
    inputs = [
        fixed(system.settings[quantity.of])
        if quantity.word == "value" and quantity.of in system.settings
        else place_seen(place_of(system, quantity))
        for quantity in formula.seen
    ]
    turned = system.layout.seen_angles + angle if angle >= 0 else -1

    def value(time: float, seen: Sequence[float]) -> float:
        link_angle = seen[turned] if turned >= 0 else 0.0
        return function(time, seen[rate], link_angle, *[look.at(time, seen) for look in inputs])

    def values(times: Floats, seen: Floats) -> Floats:
        link_angle = seen[turned] if turned >= 0 else 0.0
        return along(times, seen[rate], link_angle, *[look.along(times, seen) for look in inputs])

    places = [turned] * (turned >= 0) + [rate] * ("speed" in formula.variables)
    look = Look(value, values, (*places, *chain.from_iterable(look.places for look in inputs)))
    return _within_limits(system, look, {quantity.of for quantity in formula.seen})


def _within_limits(system: MotionSystem, look: Look, names: Collection[str]) -> Look:
    """Return a formula that takes states at their limits where it is NaN beyond the limits.

    A time step is calculated across a limit before the time at the limit is known. Without a
    limit, a formula such as ``sqrt(x)`` would then end the run.
    """
    limits = [
        (place_of(system, Seen("value", state.name)), state.least, state.most)
        for state in system.scenario.states
        if state.name in names and (state.least > -math.inf or state.most < math.inf)
    ]
    if not limits:
        return look

    def value(time: float, seen: Sequence[float]) -> float:
        number = look.at(time, seen)
        return number if math.isfinite(number) else look.at(time, limited(seen).tolist())

    def values(times: Floats, seen: Floats) -> Floats:
        numbers = look.along(times, seen)
        if (finite := np.isfinite(numbers)).all():
            return numbers
        return np.where(finite, numbers, look.along(times, limited(seen)))

    def limited(seen: Sequence[float] | Floats) -> Floats:
        within = np.array(seen)
        for place, least, most in limits:
            within[place] = np.clip(within[place], least, most)
        return within

    return look._replace(at=value, along=values)


class Compared(NamedTuple):
    """Two numbers that a formula compares, or a number and its limit."""

    first: Look
    second: Look

    @property
    def places(self) -> tuple[int, ...]:
        """Indices of the quantities that both numbers depend on, among all seen quantities."""
        return self.first.places + self.second.places

    def at(self, time: float, seen: Sequence[float]) -> tuple[float, float]:
        """Return both numbers at an instant."""
        return self.first.at(time, seen), self.second.at(time, seen)


class Corner(NamedTuple):
    """Numbers at which a formula or limit bends or jumps."""

    path: Path
    """Path of the formula in the scenario."""
    text: str
    """Text of the formula."""
    compared: Sequence[Compared]
    """Comparisons of a number with breakpoints, ascending; only the nearest breakpoints matter."""
    jumps: Sequence[bool]
    """For each comparison, True if the formula can jump there."""
    places: Sequence[JumpPlace] = ()
    """Terms and link of each comparison of a formula; empty for friction tables and springs."""


def compared(system: MotionSystem, difference: Formula, rate: int = 0, angle: int = -1) -> Compared:
    """Return the two operands of a difference, with the current settings."""
    tree = difference.whole
    assert isinstance(tree, Applied)  # noqa: S101 - a difference is an operation
    first, second = (
        looking(system, difference._replace(tree=operand), rate, angle) for operand in tree.operands
    )
    return Compared(first, second)


def corners(system: MotionSystem) -> list[Corner]:
    """Return the corners of formulas that depend on the motion.

    The argument of a lookup table is compared with all breakpoints of the table.
    """
    layout = system.layout
    candidates: list[tuple[Path, Formula, Iterable[Pairs], int, int]] = []
    for device in system.may_slip:
        programme = device.programme
        if programme.look is not None and isinstance(programme.curve, Formula):
            most = () if programme.largest is None else (programme.largest,)
            own = programme.jumps  # these jumps are part of the states of the contact
            path: Path = control_path(device)
            whole = programme.curve.whole
            bounds = [[MeetingParts(whole, Constant(bound))] for bound in (0.0, *most)]
            groups = [
                [pair for pair in pairs if (bare(pair.first), bare(pair.second)) not in own]
                for pairs in met(whole)
            ]
            candidates.append((path, programme.curve, [*bounds, *filter(None, groups)], 0, -1))
    for port, load in enumerate(system.outside):
        if isinstance(load.law, Formula):  # contacts represent jumps over speed or angle
            path = ("torques", system.names[load.link])
            place = layout.angles.index(load.link) if load.link in layout.angles else -1
            compares = met if load.law.seen or load.law.switches else asked
            candidates.append((path, load.law, compares(load.law.whole), port, place))
    candidates += [
        (("states", state.name, "rate"), state.rate, met(state.rate.whole), 0, -1)
        for state in system.scenario.states
        if isinstance(state.rate, Formula)
    ]
    for path, when in conditions(system):
        candidates += [
            (path, comparison, met(comparison.whole), 0, -1) for comparison in when.comparisons
        ]
    corner_list = [*_rubbing_corners(system), *_vanishing_limits(system)]
    for path, formula, group, rate, angle in candidates:
        for pairs in group:
            first = pairs[0].first
            if not variables(Applied("-", pairs[0][:2], 0, 0)) - {"t"} - {*system.settings}:
                continue
            look = looking(system, formula._replace(tree=first), rate, angle)
            others = (
                looking(system, formula._replace(tree=pair.second), rate, angle) for pair in pairs
            )
            both = [Compared(look, other) for other in others]
            places = [JumpPlace(bare(pair.first), bare(pair.second), rate, angle) for pair in pairs]
            jumps = [pair.jumps for pair in pairs]
            corner_list.append(Corner(path, formula.text, both, jumps, places))
    return corner_list


def control_path(device: Contact | Elastic) -> tuple[str, str]:
    """Return the scenario path of the control of a shift element or the limit of a spring."""
    return "limits" if device.element is None else "controls", device.name


def conditions(system: MotionSystem) -> Iterator[tuple[Path, StepCondition]]:
    """Yield the conditions of sequence steps, with their paths in the scenario."""
    for path, step in placed_steps(system.scenario):
        if step.when is not None:
            yield (*path, "when"), step.when


def _rubbing_corners(system: MotionSystem) -> Iterator[Corner]:
    """Yield the corners of friction coefficients that are tables over slip and temperature."""
    for device in system.may_slip:
        if device.programme.table is not None:
            slip, temperature = _rubbing_places(system, device)
            table = device.programme.table
            places = [(temperature, column) for column in table.columns]
            places += [(slip, way * x) for way in (1, -1) for x in table.x if x]
            for place, bend in places:
                pair = Compared(place_seen(place), fixed(bend))
                yield Corner(control_path(device), "friction", [pair], [False])


def _vanishing_limits(system: MotionSystem) -> Iterator[Corner]:
    names = [spring.name for spring in system.springs]
    for spring in system.springs:
        follows, look = spring.programme.follows, spring.programme.look
        if follows and look:
            index = names.index(follows.of)
            places = system.layout.springs + index, system.layout.ports + index
            pair = Compared(look._replace(places=places), fixed(0.0))
            yield Corner(control_path(spring), "limit", [pair], [False])


def place_seen(place: int) -> Look:
    """Return a quantity as a function of time and seen quantities."""
    return Look(lambda _time, seen: seen[place], lambda _times, seen: seen[place], (place,))


def fixed(value: float) -> Look:
    """Return a constant as a function of time and seen quantities."""
    return Look(lambda _time, _seen: value, lambda times, _seen: np.full(len(times), value))


def with_settings(system: MotionSystem, settings: Mapping[str, float]) -> MotionSystem:
    """Return the system with new values of the numbers that sequences set."""
    system = replace(system, settings=settings)
    contacts = tuple(
        contact._replace(programme=_seeing(system, contact)) for contact in system.contacts
    )
    springs = tuple(spring._replace(programme=_seeing(system, spring)) for spring in system.springs)
    return replace(system, contacts=contacts, springs=springs)


def _seeing(system: MotionSystem, device: Contact | Elastic) -> Programme:
    programme, curve = device.programme, device.programme.curve
    if programme.follows:
        return programme._replace(look=following(system, programme.follows))
    if isinstance(curve, Formula) and curve.seen:
        is_mean = shared(curve, system.slides) != curve
        clipped = within(curve, math.inf if programme.largest is None else programme.largest)
        if is_mean and isinstance(clipped, Formula):
            curve = clipped
        programme = programme._replace(look=looking(system, curve), is_mean=is_mean)
        if isinstance(device, Contact):
            programme = _on_both_sides(system, device, programme, curve)
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


def _on_both_sides(
    system: MotionSystem, contact: Contact, programme: Programme, curve: Formula
) -> Programme:
    """Return a control with its values on both sides of jumps at zero slip of its contact."""
    pairs = [pair for pair in chain.from_iterable(met(curve.whole)) if pair.jumps]
    if not pairs:
        return programme
    chance = np.random.default_rng(SAMPLES)
    motions = null(system.rows(mesh.row for mesh in system.meshes))
    half = motions @ chance.normal(size=(motions.shape[1], SAMPLES))
    speeds = np.hstack([half, -half])
    seen = chance.normal(size=(system.layout.quantities, 2 * SAMPLES))
    seen[: system.layout.ports] = system.port_rows @ speeds
    slip = contact.row @ speeds
    own: list[tuple[Slide, Slide]] = []
    for pair in pairs:
        place = JumpPlace(bare(pair.first), bare(pair.second))
        apart = looking(system, place.difference).along(np.ones_like(slip), seen)
        sizes = np.abs(apart * slip[0]), np.abs(slip * apart[0])
        if sizes[0][0] and np.allclose(*sizes, rtol=PROPORTIONAL, atol=0.0):
            sides = (float(np.sign(apart[slip * side > 0][0])) for side in (-1, 1))
            below, above = (Slide(place, 0, side) for side in sides)
            own.append((below, above))
    if not own:
        return programme
    trees = (on_sides(curve.whole, slides) for slides in zip(*own, strict=True))
    looks = tuple(looking(system, curve._replace(tree=tree)) for tree in trees)
    return programme._replace(sides=looks, jumps=[below.place[:2] for below, _ in own])


def following(system: MotionSystem, limit: SpringLimit, pieces: Sequence[int] = ()) -> Look:
    """Return a spring's torque limit that grows with the torque of another spring.

    Parameters
    ----------
    pieces : sequence of int
        Active linear pieces of the springs, if the limit is needed on these pieces only.
    """
    [index] = (n for n, spring in enumerate(system.springs) if spring.name == limit.of)
    spring = system.springs[index]
    rate, twist = system.layout.springs + index, system.layout.ports + index
    if pieces and isinstance(spring.curve, TwistCurve) and not spring.can_part:
        spring = spring._replace(curve=spring.curve.alone(pieces[index]))

    def value(_time: float, seen: Sequence[float]) -> float:
        return float(limit.base + limit.times * spring.carried(seen[twist], seen[rate]))

    def values(_times: Floats, seen: Floats) -> Floats:
        carried = map(spring.carried, seen[twist].tolist(), seen[rate].tolist())
        return np.asarray(limit.base + limit.times * np.array([*carried]))

    return Look(value, values)


def _rubbing_places(system: MotionSystem, device: Contact | Elastic) -> tuple[int, int]:
    """Return the indices of slip and temperature of a shift element among all seen quantities."""
    return _slip(system, device.name), place_of(system, Seen("temperature", device.name))
