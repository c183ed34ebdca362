"""Shares that keep a motion on the jumps of formulas along which it slides.

Let g be the difference of the terms that a formula compares. The shares s of both sides follow from
``dg/dt = -k g``: the motion stays on the jump, and rounding errors of g decay. If dg/dt does not
depend on shares, such as behind a lag, they follow from ``d2g/dt2 = -2 k dg/dt - k^2 g``. Torques
and rates of states are linear in each share, so Newton's method converges in few steps.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, largest
from vstatics.core.readers.expressions.operands import TableName
from vstatics.simulation.scenario.formula_code import Seen, seen_in
from vstatics.simulation.system.known import KnownMotion
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.system.shares import NOW, JumpPlace, Slide, total_slope
from vstatics.simulation.system.sight import SAMPLES, Compared, looking, place_of
from vstatics.simulation.tolerances import NOT_ZERO, PROPORTIONAL, ROUNDED_SHARE, SIGHT

_RETURN = 1e3
"""Rate at which a distance from the jump decays, times the duration."""
_NEWTON_ROUNDS = 12
"""Largest number of Newton steps."""
_SAME_SLOPES = 4
"""Number of Newton steps with the same derivatives."""
_CALM = 0.1
"""Largest ratio of k |dg/dt| to the change of d2g/dt2 by a share from 0 to 1, behind a lag. [-]"""

Change = Callable[[Floats, Floats, Floats], Floats]
"""Function of times, seen quantities and rates of these quantities; returns a rate."""


class Sliding:
    """Shares of the jumps along which a motion slides, between two events.

    Parameters
    ----------
    equations : KnownMotion
    """

    def __init__(self, equations: KnownMotion) -> None:
        self.equations = equations
        system = equations.system
        self.back = _RETURN / system.scenario.span
        firsts = {slide.share: slide for slide in reversed(system.slides)}
        self.slides = [firsts[number] for number in range(len(equations.layout.shares))]
        self.looks = [
            looking(system, slide.place.difference, slide.place.rate, slide.place.angle)
            for slide in self.slides
        ]
        self.changes = [_change(system, slide) for slide in self.slides]
        known = {*range(equations.layout.seen_shares)}
        known -= {*np.flatnonzero(np.abs(equations.structure.light_rates).sum(axis=1)).tolist()}
        known -= {
            equations.layout.ports + index for index in np.flatnonzero(~equations.ports.bends)
        }
        self.unknown = np.array(
            [
                change is None or not known.issuperset(look.places)
                for change, look in zip(self.changes, self.looks, strict=True)
            ]
        )
        """Flags of jumps whose dg/dt is a difference quotient."""
        self.moves_all = not equations.light and bool(equations.ports.bends.all())
        """True if the derivatives of all states are known."""
        self.slow = np.zeros(len(self.slides), dtype=bool)
        """Flags of jumps with a dg/dt that does not depend on shares."""
        self.last: tuple[Floats, ...] = ()
        """Latest arguments and result of `at`, which is often needed again."""
        self.slopes: Floats | None = None
        """Latest derivatives with respect to the shares, which change little."""

    def at(self, times: Floats, states: Floats, rates: Floats) -> Floats:
        """Return the shares at several times, shape (shares, times); NaN if undetermined."""
        known = times, states, rates
        if self.last and all(map(np.array_equal, known, self.last)):
            return self.last[-1]
        shares = np.zeros((len(self.slides), len(times)))
        if (self.unknown | self.slow).any() and not self.moves_all:
            return shares * np.nan
        slopes = self.slopes
        for number in range(_NEWTON_ROUNDS):
            left = self._left(*known, shares)
            if slopes is None or number % _SAME_SLOPES == _SAME_SLOPES - 1:
                moved = (shares + unit[:, None] for unit in np.eye(len(shares)))
                slopes = np.array([self._left(*known, near) - left for near in moved])
                flat = np.all(slopes == 0, axis=0)
                slow = flat.all(axis=1) & np.any(left, axis=1)
                if self.slopes is None and slow.any() and not self.slow.any():
                    self._slow_down(slow, known)
                    return self.at(times, states, rates)
                # No share moves links that stick to each other, so the mean of both sides acts.
                # Where a jump vanishes, its share grows beyond 1, which ends the slide.
                shares_of, places = np.nonzero(flat)
                slopes[shares_of, shares_of, places] = 1.0
            try:
                by_time = np.linalg.solve(slopes.transpose(2, 1, 0), left.T[..., None])
            except np.linalg.LinAlgError:
                return shares * np.nan
            shares = shares - by_time[..., 0].T
            if not largest(np.abs(by_time)) > ROUNDED_SHARE * max(1.0, largest(np.abs(shares))):
                break
        if slopes is not None and np.isfinite(slopes).all():
            self.slopes = slopes[..., -1:]
        self.last = *(array.copy() for array in known), shares
        return shares

    def steps(self, time: float, state: Floats, rates: Floats) -> list[tuple[Floats, Floats]]:
        """Return the changes of torques and of rates of states across each jump."""
        equations = self.equations
        now = np.array([time]), state[:, None], rates[:, None]

        def acting(shares: Floats) -> tuple[Floats, Floats]:
            torques = equations.torques_with(*now, shares[:, None])
            seen = equations.seen_with(*now, torques, shares[:, None])
            return torques, equations.changes.along(now[0], seen)

        sides = ((acting(-unit), acting(unit)) for unit in np.eye(len(self.slides)))
        return [(above[0] - below[0], above[1] - below[1]) for below, above in sides]

    def _slow_down(self, slow: Booleans, known: tuple[Floats, Floats, Floats]) -> None:
        """Calculate `slow` shares from second derivatives of g, and limit k by their size."""
        self.slow = slow
        still = np.zeros((len(slow), len(known[0])))
        _, speeds, _ = self._moving(*known, still)
        push = self._left(*known, still + 1) - self._left(*known, still)
        fastest = _CALM * np.abs(push[slow]) / np.maximum(np.abs(speeds[slow]), NOT_ZERO)
        self.back = min(self.back, float(fastest.min()))

    def _left(self, times: Floats, states: Floats, rates: Floats, shares: Floats) -> Floats:
        """Return the remainders of the equations of the shares, shape (shares, times)."""
        apart, speeds, moving = self._moving(times, states, rates, shares)
        left = speeds + self.back * apart
        if not (self.unknown | self.slow).any():
            return left
        equations, step = self.equations, SIGHT * self.equations.system.scenario.span
        turning = equations.structure.rates @ moving[: equations.motions]
        later, earlier = (
            self._moving(times + h, states + h * moving, rates + h * turning, shares)
            for h in (step, -step)
        )
        change, pull = (
            (after - before) / (2 * step)
            for after, before in zip(later[:2], earlier[:2], strict=True)
        )
        left = np.where(self.unknown[:, None], change + self.back * apart, left)
        pull += self.back * (speeds + left)
        return np.where(self.slow[:, None], pull, left)

    def _moving(
        self, times: Floats, states: Floats, rates: Floats, shares: Floats
    ) -> tuple[Floats, Floats, Floats]:
        """Return g and dg/dt, shape (shares, times), and the derivatives of states."""
        equations = self.equations
        torques = equations.torques_with(times, states, rates, shares)
        seen = equations.seen_with(times, states, rates, torques, shares)
        change = np.zeros((equations.size, len(times)))
        change[equations.works] = torques * rates
        derivative = change[: len(states)]
        derivative[: equations.motions] = equations.structure.accelerations @ torques
        derivative[equations.twists] = rates[equations.layout.spring_ports]
        turned = equations.speeds_at(times, states)[list(equations.layout.angles)]
        derivative[equations.angles] = turned
        if equations.system.scenario.states:
            of_states = equations.changes.along(times, seen)
            derivative[equations.values][: len(of_states)] = of_states
        equations.changes.warm(derivative[equations.values], states, change)
        moving = np.zeros_like(seen)
        inner = derivative[equations.motions : equations.values.stop]
        moving[: equations.layout.ports] = (
            equations.structure.rates @ derivative[: equations.motions]
        )
        moving[equations.layout.ports : equations.layout.ports + len(inner)] = inner
        inside = equations.ports.inside(times)
        return (
            np.array([look.along(inside, seen) for look in self.looks]),
            np.array(
                [change(inside, seen, moving) if change else 0.0 * times for change in self.changes]
            ),
            derivative,
        )


def _change(system: MotionSystem, slide: Slide) -> Change | None:
    """Return the derivative with respect to time of a compared difference, None if unknown."""
    place = slide.place
    known = total_slope(place.difference, system.settings)
    if known is None:
        return None
    formula, moving = known
    turned = system.layout.seen_angles + place.angle

    def index(part: TableName) -> int:
        seen = seen_in(part)
        if seen is not None:
            return place_of(system, seen)
        return place.rate if part.name == "speed" else turned

    along, rates = formula.along, {name: index(part) for name, part in moving.items()}

    def read(quantity: Seen, times: Floats, seen: Floats, moving: Floats) -> Floats | float:
        name = quantity.of if quantity.word == "value" else ""
        if name in rates:
            changing: Floats = moving[rates[name]]
            return changing
        if name == NOW:
            return times
        return (
            system.settings[name] if name in system.settings else seen[place_of(system, quantity)]
        )

    def change(times: Floats, seen: Floats, moving: Floats) -> Floats:
        inputs = [read(quantity, times, seen, moving) for quantity in formula.seen]
        angle = seen[turned] if place.angle >= 0 else 0.0
        return along(times, seen[place.rate], angle, *inputs)

    return change


def slides(
    system: MotionSystem,
    places: Sequence[JumpPlace],
    pairs: Sequence[Compared],
    near: Sequence[float],
) -> list[Slide]:
    """Return the slides along jumps; jumps of proportional differences have the same share.

    Parameters
    ----------
    system : MotionSystem
    places : sequence of JumpPlace
    pairs : sequence of Compared
        Terms that are compared at each place.
    near : sequence of float
        Distance from each jump that counts as nearly 0; see `Slide.near`.
    """
    chance = np.random.default_rng(SAMPLES)
    samples = chance.uniform(1.0, 2.0, (system.layout.quantities, SAMPLES))
    speeds = chance.uniform(1.0, 2.0, (len(system.names), SAMPLES))
    samples[: system.layout.ports] = system.port_rows @ speeds
    times = np.full(SAMPLES, system.scenario.span)
    firsts: list[Floats] = []
    result = []
    for place, pair, distance in zip(places, pairs, near, strict=True):
        apart = pair.first.along(times, samples) - pair.second.along(times, samples)
        ratios = [apart @ first / (first @ first) for first in firsts]
        same = [
            number
            for number, (ratio, first) in enumerate(zip(ratios, firsts, strict=True))
            if np.allclose(apart, ratio * first, rtol=PROPORTIONAL, atol=0.0)
        ]
        if not same:
            firsts.append(apart)
        sign = -1.0 if same and ratios[same[0]] < 0 else 1.0
        result.append(Slide(place, same[0] if same else len(firsts) - 1, sign, distance))
    return result
