"""Signs of the power flow, lossy torques, efficiency: exact, over all sets of signs.

With losses the internal ratio u of a mechanism becomes ``u * eta**x``. Closed
form: ``x = sign(M (w_first - w_third))`` with the ideal torque M; coasting
turns every flow, so every x that is not idle.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import product

from tests.oracle.linear import ONE, ZERO, exact, sign, times
from tests.oracle.systems import Speeds, Torques, Values, ratios
from vstatics.core.model.transmission import Gear, Transmission

Signs = tuple[int | None, ...]


@dataclass(frozen=True)
class Flow:
    """The ideal flow of a gear: what the signs are decided from."""

    case: Transmission
    gear: Gear
    speeds: Speeds
    ideal: Torques

    @property
    def turn(self) -> int:
        """-1 when coasting: all flows run the other way."""
        return -1 if self.case.coast else 1

    @cached_property
    def moments(self) -> Values:
        """Ideal torque on the first link of each mechanism."""
        return tuple(self.ideal.mechanism(k) for k in range(len(self.case.mechanisms)))

    @cached_property
    def relative(self) -> Values:
        """w_first - w_third of each mechanism."""
        return tuple(self.speeds.difference(m.first, m.third) for m in self.case.mechanisms)

    @cached_property
    def powers(self) -> Values:
        """M (w_first - w_third): 0 for an idle mechanism, None where not determined."""
        return tuple(map(times, self.moments, self.relative))

    @cached_property
    def loss_free(self) -> list[Fraction]:
        """Internal ratios."""
        return ratios(self.case)

    @cached_property
    def efficiencies(self) -> list[Fraction]:
        """Efficiencies with the third link held."""
        return [exact(mechanism.efficiency) for mechanism in self.case.mechanisms]

    def convention(self, k: int) -> int:
        """The sign of an idle mechanism: 0, or what the published table shows."""
        if self.case.idle == "exact":
            return 0
        return 1 if self.moments[k] == 0 else sign(self.loss_free[k])

    @cached_property
    def closed_form(self) -> Signs:
        """Signs of the ideal flow; the convention where idle, None where unknown."""
        return tuple(
            None if power is None else self.turn * sign(power) if power else self.convention(k)
            for k, power in enumerate(self.powers)
        )

    @property
    def open(self) -> list[int]:
        """Mechanisms with losses whose ideal flow is not determined."""
        return [k for k, eta in enumerate(self.efficiencies) if self.powers[k] is None and eta < 1]

    @cached_property
    def fickle(self) -> frozenset[int]:
        """Mechanisms without ideal torque that get some when ratios change, and that move.

        Their torque is 0 by coincidence: it is not 0 with slightly different ratios.
        """
        step = Fraction(1, 10**6)
        changed = [u * (1 + step * (k * k + 3 * k + 7)) for k, u in enumerate(self.loss_free)]
        other = Torques(self.case, self.gear, changed)
        return frozenset(
            k
            for k, moment in enumerate(self.moments)
            if moment == 0 and self.relative[k] not in (0, None) and other.mechanism(k) != 0
        )

    def torques(self, signs: Signs) -> Torques:
        """Torques with losses for a set of signs; None only where the efficiency is 1."""
        lossy = [
            u * eta ** (x or 0)
            for u, eta, x in zip(self.loss_free, self.efficiencies, signs, strict=True)
        ]
        return Torques(self.case, self.gear, lossy)

    @cached_property
    def sides(self) -> tuple[list[int], list[int]] | None:
        """Links that ideal power enters and leaves by; None if one flow is unknown."""
        enters: list[int] = []
        leaves: list[int] = []
        for link in self.ideal.ports():
            power = self.ideal.power(self.speeds, [link])
            if power is None:
                return None
            if power:
                (enters if self.turn * power > 0 else leaves).append(link)
        return enters, leaves

    def eta(self, torques: Torques) -> Fraction | None:
        """- (lossy power at the links that power leaves by) / (... enters by)."""
        if self.sides is None:
            return None
        entering, leaving = (torques.power(self.speeds, side) for side in self.sides)
        if not entering or leaving is None:
            return None
        return -leaving / entering

    def told_eta(self, torques: Torques) -> Fraction | None:
        """As it is told: of several ports power out by power in, by their flows with losses."""
        if not self.gear.speeds and not self.gear.torques:
            return self.eta(torques)
        powers = [torques.power(self.speeds, [link]) for link in torques.ports()]
        if None in powers:
            return None
        flows = [self.turn * power for power in powers if power is not None]
        entering = sum((flow for flow in flows if flow > 0), ZERO)
        return -sum((flow for flow in flows if flow < 0), ZERO) / entering if entering else None


class Trial:
    """One set of signs, and what the lossy torques say about it."""

    def __init__(self, flow: Flow, signs: Signs) -> None:
        """Solve with these signs."""
        self.flow, self.signs = flow, signs
        self.torques = flow.torques(signs)
        self.eta = flow.eta(self.torques)
        moments = [self.torques.mechanism(k) for k in range(len(signs))]
        self.powers = tuple(map(times, moments, flow.relative))

    @cached_property
    def losses(self) -> Values:
        """M' (w_first - w_third) (1 - eta**x) of each mechanism."""
        shares = [
            1 - eta ** (x or 0) for eta, x in zip(self.flow.efficiencies, self.signs, strict=True)
        ]
        return tuple(map(times, self.powers, shares))

    @property
    def settled(self) -> bool:
        """Every mechanism without ideal torque has the sign of its lossy flow."""
        flow = self.flow
        for k in flow.fickle:
            power = self.powers[k]
            if power is None:
                return False
            if self.signs[k] != (flow.turn * sign(power) if power else flow.convention(k)):
                return False
        return True

    @property
    def admissible(self) -> bool:
        """No mechanism gives power, and power comes out."""
        turn = self.flow.turn
        if not self.torques.system.consistent or not self.settled:
            return False
        if any(loss is None or turn * loss < 0 for loss in self.losses):
            return False
        return self.flow.eta(self.flow.ideal) is None or (self.eta is not None and self.eta > 0)


def trials(flow: Flow, *, turned: bool) -> Iterator[Trial]:
    """The ideal signs, or all sets that differ from them (fewest turned signs first).

    A mechanism without losses keeps its ideal sign: it changes nothing.
    """
    ideal = flow.closed_form
    choices: list[Sequence[int | None]] = []
    for k, x in enumerate(ideal):
        if k in flow.fickle:
            choices.append(sorted({flow.convention(k), 1, -1}, reverse=True))
        elif turned and flow.powers[k] and flow.efficiencies[k] < 1:
            choices.append((1, -1))
        else:
            choices.append((x,))
    busy = [k for k in range(len(ideal)) if k not in flow.fickle]

    def distance(signs: Signs) -> int:
        return sum(signs[k] != ideal[k] for k in busy)

    for signs in sorted(product(*choices), key=distance):
        if distance(signs) or not turned:
            yield Trial(flow, signs)


def admissible_sets(flow: Flow) -> list[Trial]:
    """Every admissible set of signs, the ideal ones first."""
    found = [trial for trial in trials(flow, turned=False) if trial.admissible]
    return found + [trial for trial in trials(flow, turned=True) if trial.admissible]


def best(found: Sequence[Trial]) -> Trial:
    """The one with the largest efficiency; the first of equals."""
    return max(found, key=lambda trial: ZERO if trial.eta is None else trial.eta)


def every_guess(flow: Flow) -> list[Trial]:
    """Where flows are not determined: all signs of these, the ideal signs of the others."""
    choices = [(1, -1) if k in flow.open else (x,) for k, x in enumerate(flow.closed_form)]
    return [Trial(flow, signs) for signs in product(*choices)]


def balance(flow: Flow, trial: Trial) -> Fraction | None:
    """External power minus the losses: 0 exactly for any signs."""
    total = trial.torques.power(flow.speeds, trial.torques.ports())
    if total is None or None in trial.losses:
        return None
    return total - sum((loss for loss in trial.losses if loss is not None), ZERO)


def published_sign(flow: Flow, k: int) -> int | None:
    """The published test of one mechanism, driving: +1 if abs(Mx) falls with abs(u).

    Exact derivative; 0 for a tie. Only for one input and one output.
    """
    mx = flow.ideal.mx()
    slope = flow.ideal.mx_slope(k, flow.loss_free)
    if mx is None or slope is None:
        return None
    return sign(mx) * sign(flow.loss_free[k]) * sign(slope)


def probed_sign(flow: Flow, k: int, step: Fraction = Fraction(1, 10**40)) -> int | None:
    """The published test with a finite, very small step; it agrees with half the step."""
    seen = set()
    for small in (step, step / 2):
        changed = list(flow.loss_free)
        changed[k] *= ONE - small
        before, after = flow.ideal.mx(), Torques(flow.case, flow.gear, changed).mx()
        if before is None or after is None:
            return None
        seen.add(sign(abs(before) - abs(after)))
    return seen.pop() if len(seen) == 1 else None
