"""The torque that balances a battery: an input split in closed form, none, two, all points."""

from collections.abc import Sequence
from itertools import product
from random import Random
from typing import NamedTuple

import numpy as np
import pytest

from tests.chance import examples, ranges_with_slow, seeded
from tests.core.writers.again import is_read_again
from vstatics import CaseError, ReadError, solve
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers import loads
from vstatics.core.writers.deck_limits import check_deck

SPLIT = """\
links: [MG1, axle, engine, MG2]
input: engine
output: axle
load: {speed: 2000 rpm, torque: 80 N*m}
mechanisms:
  split: {first: MG1, second: axle, third: engine, ratio: -2.6, efficiency: .98}
  motor: {first: MG2, second: axle, ratio: -2.5, efficiency: .97}
gears:
  hold: {speeds: {MG1: 3000 rpm}, balance: {MG1: .92, MG2: .90, battery: -2 kW}}
"""


def test_a_balance_that_can_not_be_is_reported() -> None:
    for old, new, said in (
        ("balance: {MG1: .92, MG2: .90,", "balance: {MG1: .92,", "read no link without speed"),
        ("speeds: {MG1: 3000 rpm}, ", "", "read MG1 and MG2 without speed and torque"),
        ("MG2: .90", "MG2: 1.90", "read 1.9, expected an efficiency above 0 and up to 1"),
        ("MG2: .90", "MG3: .90", "MG3"),
        ("-2 kW", "-2 N*m", "power"),
        ("load: {speed: 2000 rpm, torque: 80 N*m}\n", "", "load"),
    ):
        with pytest.raises((CaseError, ReadError), match=r"\[E\d\d\d\]") as caught:
            solve(loads(SPLIT.replace(old, new)))
        assert said in str(caught.value), new


def test_a_deck_holds_no_balance_and_other_formats_keep_it() -> None:
    case = loads(SPLIT)
    assert is_read_again(case)
    with pytest.raises(CaseError, match="the balance of gear hold"):
        check_deck(case)


GOES_ROUND = """\
links: [in, A, out, B]
input: in
output: out
load: {{speed: {speed!r} rad/s, torque: {torque!r} N*m}}
mechanisms:
  one: {{first: in, second: A, third: out, ratio: {u[0]!r}, efficiency: {eta[0]!r}}}
  two: {{first: B, second: A, third: out, ratio: {u[1]!r}, efficiency: {eta[1]!r}}}
gears:
  d:
    speeds: {{A: {held!r} rad/s}}
    balance: {{A: {of[0]!r}, B: {of[1]!r}, battery: {battery!r} W}}
"""
"""Two sets share A and the output, so power may go round by machines and battery."""


class RoundTrip(NamedTuple):
    """A case of `GOES_ROUND`."""

    u: list[float]
    eta: list[float]
    of: list[float]
    """Efficiencies of both machines."""
    speed: float
    held: float
    torque: float
    battery: float

    @property
    def torques(self) -> set[float]:
        """All torques on B that balance, with every set of directions that agrees with its flow.

        The sets carry T and M on their first links, so A gets -k1 T - k2 M with k = u eta^s, the
        output (k1 - 1) T + (k2 - 1) M.
        """
        out = (self.speed - self.u[0] * self.held) / (1 - self.u[0])
        second = out + self.u[1] * (self.held - out)
        speeds = np.array([self.speed, self.held, out, second])
        found = set()
        for s, t, charges, charges_b in product((1, -1), repeat=4):
            k = self.u[0] * self.eta[0] ** s, self.u[1] * self.eta[1] ** t
            of_a, of_b = self.of[0] ** charges, self.of[1] ** charges_b
            fixed = of_a * k[0] * self.torque * self.held
            m = (self.battery - fixed) / (of_a * k[1] * self.held - of_b * second)
            power = self._ports(k, m) * speeds
            ideal = self._ports(self.u, m) * speeds
            flows = s * self.torque * (self.speed - out), t * m * (second - out)
            given = -charges * power[1], -charges_b * power[3]
            passed = -power[ideal < 0].sum() / power[ideal > 0].sum()
            if min(*flows, *given, passed) > 0:
                found.add(round(m, 9))
        return found

    def _ports(self, k: Sequence[float], m: float) -> Floats:
        """Torques on input, A, output and B from outside."""
        at_a, at_out = -k[0] * self.torque - k[1] * m, (k[0] - 1) * self.torque + (k[1] - 1) * m
        return np.array([self.torque, at_a, at_out, m])


def random_trip(rng: Random) -> RoundTrip:
    u = [rng.choice([-1, 1]) * rng.uniform(1.5, 3.5) for _ in range(2)]
    eta, of = ([rng.uniform(low, 0.99) for _ in range(2)] for low in (0.6, 0.5))
    speeds = rng.uniform(80, 400), rng.uniform(-600, 600)
    return RoundTrip(u, eta, of, *speeds, rng.uniform(-200, 200), rng.uniform(-25e3, 25e3))


@ranges_with_slow(range(14, 21), 60, 300, start=100)
def test_a_balance_is_that_of_all_sets_of_directions(seeds: range) -> None:
    """Also beside torques at which friction locks the gear, and where there are none, or two."""
    counts = set()
    for seed in seeds:
        trip = random_trip(seeded(seed))
        results = solve(loads(GOES_ROUND.format(**trip._asdict())))
        expected = trip.torques
        counts.add(min(len(expected), 2))
        said = [one.text.split()[1] for one in results.messages if one.id == "W427"]
        if len(expected) == 1:
            found = results.lossy_holding_torques_Nm[0, 3]
            assert said == [], seed
            assert found == pytest.approx(expected.pop(), rel=1e-8, abs=1e-8), seed
        else:
            assert said == ["two" if expected else "no"], seed
    assert len(seeds) < 60 or counts == {0, 1, 2}


SERIES = """\
links: [engine, MGA, MGB, sun, ring, output]
input: engine
output: output
load: {{speed: {speed!r} rad/s, torque: {torque!r} N*m}}
mechanisms:
  first: {{first: engine, second: MGA, ratio: {u[0]!r}, efficiency: {eta[0]!r}}}
  second: {{first: MGB, second: sun, ratio: {u[1]!r}, efficiency: {eta[1]!r}}}
  set: {{first: sun, second: ring, third: output, ratio: {u[2]!r}, efficiency: {eta[2]!r}}}
shift_elements: {{B: [ring, housing]}}
gears:
  series:
    engaged: [B]
    speeds: {{{given}: {held!r} rad/s}}
    balance: {{MGA: {of[0]!r}, MGB: {of[1]!r}, battery: {battery!r} W}}
"""
"""A series hybrid: two trains that the battery alone connects, a gear pair before each machine."""


@examples(6, 24, 400)
def test_a_series_hybrid_is_balanced_as_by_hand(examples: int) -> None:
    """The engine's train gives MGA all of its power but the loss; the battery gives the rest."""
    for seed in range(examples):
        rng, given = seeded(seed), ("MGB", "output")[seed % 2]
        u = [rng.choice([-1, 1]) * rng.uniform(0.4, 3) for _ in range(2)] + [-rng.uniform(1.3, 3)]
        eta, of = [rng.uniform(0.9, 1) for _ in range(3)], [rng.uniform(0.8, 1) for _ in range(2)]
        speed, torque = rng.uniform(80, 400), rng.uniform(30, 200)
        battery, held = rng.uniform(-2e4, 2e4), rng.uniform(50, 500)
        case = loads(SERIES.format(**locals()))
        results = solve(case)
        brought = torque * speed * eta[0]
        spare = brought * of[0] - battery
        mgb = held if given == "MGB" else held * (1 - u[2]) * u[1]
        power = spare * of[1] if spare > 0 else spare / of[1]
        torques = results.lossy_holding_torques_Nm[0]
        assert torques[1] == pytest.approx(-brought * u[0] / speed, rel=1e-9), seed
        assert torques[2] == pytest.approx(power / mgb, rel=1e-8), seed
        assert results.messages == (), seed
        assert results.power_balance[0] == pytest.approx(0, abs=1e-9)
        vary = {"gears.series.balance.battery": [0.0, battery], "load.speed": [9.0, speed]}
        varied = solve(case, vary=vary).lossy_holding_torques_Nm[1, 0]
        assert varied == pytest.approx(torques, rel=1e-9, nan_ok=True)


@examples(4, 12, 500)
def test_all_torques_that_a_jagged_map_balances_are_counted(examples: int) -> None:
    """MG2 alone varies: with e = c + s T it gives the battery -W T e, at torques below 0."""
    rng, numbers = seeded(52), set()
    case = SPLIT.replace("efficiency: .98", "efficiency: 1").replace("cy: .97", "cy: 1")
    results = solve(loads(case))
    powers, speeds = -1000 * results.port_powers_kW[0], results.speeds_rpm[0] * np.pi / 30
    of_first = powers[0] * 0.92 if powers[0] > 0 else powers[0] / 0.92
    for _ in range(examples):
        need = rng.uniform(300, 4000)
        width = need / float(abs(speeds[3]))
        ends = [-1.6 * width, *sorted(-rng.uniform(0.6, 1.4) * width for _ in range(6)), 0.0]
        values = [round(rng.uniform(0.5, 0.98), 3) for _ in ends]
        roots = []
        for place in range(len(ends) - 1):
            s = (values[place + 1] - values[place]) / (ends[place + 1] - ends[place])
            terms = s, values[place] - s * ends[place], width
            inside = [t for t in np.roots(terms) if ends[place] <= t.real < ends[place + 1]]
            roots += [t.real for t in inside if t.imag == 0]
        rows = [[0, *values], [2000, *values]]
        law = f"{{over: [speed, torque], columns: {ends}, rows: {rows}}}"
        text = case.replace("MG2: .90", f"MG2: {law}")
        text = text.replace("-2 kW", f"{need + float(of_first)!r} W")
        said = [message.text for message in solve(loads(text)).messages if message.id == "W427"]
        assert len(said) == (len(roots) > 1), (law, roots)
        numbers.add(len(roots))
    assert max(numbers) > 1
