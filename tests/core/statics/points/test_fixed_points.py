"""Efficiencies over torque with several fixed points: counted in exact fractions, gear by gear.

For an efficiency that is guessed the oracle gives the torque of the mechanism, and the law the
efficiency that this torque has. Where both are one is a solution; a fine net of guesses sees all
that are not closer together than its meshes.
"""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from tests.chance import count, examples, seeded
from tests.oracle.gears import solve_gear
from tests.trains import is_regular, random_train, shown
from vstatics import Load, Results, Transmission, loads, solve
from vstatics.core.model.laws import PointLaw

NET = 60
"""Guesses between the least and the largest efficiency."""
HALVES = 40
TORQUE = 100.0
"""[N*m]"""


def with_efficiency(case: Transmission, place: int, efficiency: float) -> Transmission:
    mechanisms = [*case.mechanisms]
    mechanisms[place] = mechanisms[place]._replace(efficiency=efficiency)
    return case.replace(mechanisms=mechanisms)


def steep(seed: int) -> tuple[Transmission, int, PointLaw]:
    """A random gear, a mechanism of it, and steps about the torque that this has."""
    rng = seeded(seed)
    case = random_train(rng, regular=True, gears=1, coast=False).replace(load=Load(1000, TORQUE))
    place = rng.randrange(len(case.mechanisms))
    found = solve(with_efficiency(case, place, 0.6)).lossy_torques_Nm[0]
    torque = abs(float(np.nan_to_num(found[len(case.shift_elements) + place]))) or 50.0
    points = [(0.0, round(rng.uniform(0.3, 0.6), 3))]
    at = torque * rng.uniform(0.6, 1.0)
    for least in rng.choice(((0.7,), (0.7, 0.3))):
        width = torque * rng.choice((0.02, 0.2))
        points += [(at, points[-1][1]), (at + width, round(rng.uniform(least, 0.99), 3))]
        at += width + torque * rng.uniform(0.05, 0.3)
    return case, place, PointLaw(points, "torque")


def left_over(case: Transmission, place: int, law: PointLaw) -> Callable[[float], float]:
    """What the law gives above the guess; NaN where friction locks the gear."""

    def of(guess: float) -> float:
        with_guess = with_efficiency(case, place, guess)
        torque = solve_gear(with_guess, with_guess.gears[0]).lossy_torques.mechanisms[place]
        return np.nan if torque is None else law.at(abs(float(torque)) * TORQUE) - guess

    return of


def solutions(of: Callable[[float], float], law: PointLaw) -> list[float]:
    """All efficiencies that agree with the torques that they make."""
    ends = [y for _, y in law.points]
    net = np.unique([*np.linspace(min(ends), max(ends), NET), *ends]).tolist()
    found = [guess for guess in net if of(guess) == 0]
    for before, after in pairwise(net):
        low, high, at_low = before, after, of(before)
        if not at_low * of(high) < 0:
            continue
        for _ in range(HALVES):
            middle = (low + high) / 2
            low, high = (middle, high) if of(middle) * at_low > 0 else (low, middle)
        if abs(of(middle)) < 1e-8:
            found.append(middle)
    return found


def said(results: Results) -> str:
    texts = [one.text for one in results.messages if one.id == "W426"]
    return "several" if "more than" in "".join(texts) else "none" if texts else "one"


def checked(seed: int) -> str:
    """How many solutions a gear has, as the program says."""
    case, place, law = steep(seed)
    results = solve(with_efficiency(case, place, law))
    of = left_over(case, place, law)
    found = [] if results.locked[0] else solutions(of, law)
    if results.locked[0] or not is_regular(case, case.gears[0]):
        return "locked"
    expected = "several" if len(found) > 1 else "one" if found else "none"
    assert said(results) == expected, (shown(case), place, law.points, found)
    if expected == "one":
        exact = with_efficiency(case, place, found[0])
        output = solve_gear(exact, exact.gears[0]).lossy_torques.output
        assert output is not None
        assert results.lossy_torques[0, -1] == pytest.approx(float(output), rel=1e-6)
    return expected


@pytest.mark.slow
@pytest.mark.parametrize("seeds", [range(count(24, 200))])
def test_solutions_are_as_many_as_in_exact_fractions(seeds: range) -> None:
    assert "one" in {checked(seed) for seed in seeds}


CHAIN = """links: [a, b, c]
load: {{speed: 100 rad/s, torque: 100 N*m}}
mechanisms:
  G: {{first: b, second: a, ratio: 0.8, efficiency: {{over: torque, points: {laws[0]}}}}}
  H: {{first: c, second: b, ratio: 1.2, efficiency: {{over: torque, points: {laws[1]}}}}}
"""


def crossings(law: list[list[float]], torque: float) -> list[float]:
    """All efficiencies e that the law has at the torque e T, in closed form between corners."""
    places, values = np.transpose([[0, law[0][1]], *law, [1e6, law[-1][1]]])
    found = []
    for (left, low), (right, high) in pairwise(zip(places, values, strict=True)):
        slope = (high - low) / (right - left)
        e = (low - slope * left) / (1 - slope * torque)
        found += [float(e)] * bool(left <= e * torque < right)
    return found


@examples(3, 8, 600)
def test_all_efficiencies_of_two_jagged_laws_are_searched(examples: int) -> None:
    """The torque on the first link is that behind each pair: e G T/0.8, then e H of it by 1.2."""
    rng, numbers = seeded(528), set()
    for _ in range(examples):
        laws = [
            [[x, rng.uniform(0.6, 0.99)] for x in sorted(rng.uniform(35, 110) for _ in range(7))]
            for _ in "GH"
        ]
        firsts = crossings(laws[0], 100 / 0.8)
        pairs = [(e, f) for e in firsts for f in crossings(laws[1], 100 / 0.8 / 1.2 * e)]
        numbers.add(len(pairs))
        results = solve(loads(CHAIN.format(laws=laws)))
        assert said(results) == ("one" if len(pairs) == 1 else "several"), laws
        if len(pairs) == 1:
            [(e, f)] = pairs
            torques = np.abs(results.lossy_torques_Nm[0, :2])
            assert torques == pytest.approx([e * 125, e * f * 125 / 1.2], rel=1e-10), laws
    assert 1 in numbers
    assert max(numbers) > 1


def test_solutions_outside_0_to_1_do_not_count() -> None:
    """With T = 100 e, each formula is linear in e; 5/4 e - 0.3 = e only at 1.2."""
    text = "links: [a, b]\nload: {speed: 100 rad/s, torque: 100 N*m}\n"
    text += "mechanisms: {m: {first: b, second: a, ratio: 1, efficiency: %s}}\n"
    for formula, efficiency in (("T/50 - 0.5", 0.5), ("1.3 - 0.006*T", 0.8125)):
        found = solve(loads(text % formula)).efficiency
        assert found == pytest.approx([efficiency], rel=1e-12), formula
    assert "W433" in [message.id for message in solve(loads(text % "T/80 - 0.3")).messages]
