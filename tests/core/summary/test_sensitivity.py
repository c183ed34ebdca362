"""How ratios answer to those of the mechanisms."""

import math

import numpy as np
import pytest

from tests.chance import examples, seeded
from tests.oracle.gears import solve_gear
from tests.shipped import shipped_results
from tests.trains import random_slipping, random_train
from vstatics import Gear, Mechanism, Transmission, solve
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers import loads
from vstatics.core.statics.results import Results
from vstatics.core.summary import summarize
from vstatics.core.summary.sensitivity import efficiency_sensitivities, sensitivities
from vstatics.core.summary.tables import summary_grids


def by_differences(results: Results) -> Floats:
    """Central differences of ratios, of step 1e-5; freewheels stay as they are."""
    own = np.array([mechanism.ratio for mechanism in results.case.mechanisms])
    step = 1e-5
    numbers = np.concatenate([own * (1 + step * sign * np.eye(len(own))) for sign in (1, -1)])
    more, less = np.split(solve(results.with_freewheels_engaged, ratios=numbers).ratio, 2)
    found: Floats = ((more - less) / (2 * step * results.ratio)).T
    return found


def differ(results: Results) -> list[int]:
    """Gears whose sensitivities are not those of differences."""
    found, expected = sensitivities(results), by_differences(results)
    expected[~np.isfinite(results.ratio)] = np.nan
    close = np.isclose(found, expected, atol=1e-5, rtol=1e-4, equal_nan=True)
    return np.flatnonzero(~np.all(close, axis=1)).tolist()


BALANCED = """\
links: [MG1, output, engine, MG2]
input: engine
output: output
load: {speed: 2000 rpm, torque: 110 N*m}
mechanisms:
  set: {first: MG1, second: output, third: engine, ratio: -2.6, efficiency: .98}
  pair: {first: MG2, second: output, ratio: 2.63, efficiency: 0.98}
gears: {split: {speeds: {MG1: 5000 rpm}, balance: {MG1: 0.92, MG2: 0.90}}}
"""
ON_A_CURVE = """\
links: [engine, front, rear, FL, FR, RL, RR]
outputs: [FL, FR, RL, RR]
mechanisms:
  centre: {first: front, second: rear, third: engine, ratio: -1.5}
  front axle: {first: FL, second: FR, third: front, ratio: -1}
  rear axle: {first: RL, second: RR, third: rear, ratio: -1}
gears: {left: {speeds: {FR: 1.05*FL, RL: .98*FL, RR: 1.06*RL}}}
"""


@examples(8, 24, 800)
def test_sensitivities_agree_with_finite_differences(examples: int) -> None:
    """Of drawn sets, freewheels, gears with given speeds and torques; of any inputs and outputs."""
    for name in ("zf-8hp70", "ravigneaux-aod", "simpson-th400", "power-split", "wolfrom"):
        assert differ(shipped_results(f"{name}.yaml")) == []
    for seed in range(examples):
        assert differ(solve(random_train(seeded(seed), regular=False))) == [], seed
    chance = seeded(59)
    for case in (case for _ in range(examples // 4) for case in random_slipping(chance)):
        assert differ(solve(case)) == []
    for text in (BALANCED, ON_A_CURVE):
        assert differ(solve(loads(text))) == []
    fixed = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear(speeds={2: 0.4})], output=2)
    assert sensitivities(solve(fixed)).tolist() == [[0.0]]


def test_a_ratio_answers_to_the_speed_ratio_of_a_variator() -> None:
    """Of a set u between hyd = x engine and out: ``w_out = (x - u)/(1 - u)``, so ``-x/(x - u)``."""
    results = solve(
        loads("""\
links: [engine, hyd, out]
mechanisms:
  set: {first: hyd, second: engine, third: out, ratio: -2}
  hydro: {kind: variator, first: engine, second: hyd, speed_ratio: -0.3}
gears: {back: [], ahead: {speed_ratios: {hydro: .3}}}
""")
    )
    expected = [-x / (x + 2) for x in (-0.3, 0.3)]
    assert sensitivities(results)[:, 1].tolist() == pytest.approx(expected)
    grids = {one.key: one.title for one in summary_grids(summarize(results))}
    assert grids["sensitivity"].endswith("to basic and speed ratios")


def test_the_efficiency_of_pairs_in_a_row_is_their_product() -> None:
    """Without losses, too: each of many pairs has all of the power."""
    for links, efficiency in ((3, 0.9), (150, 1.0)):
        pairs = [Mechanism(one, one + 1, 0, -1.1, efficiency) for one in range(1, links)]
        case = Transmission(links, [], pairs, [Gear()])
        np.testing.assert_allclose(sensitivities(solve(case)), np.ones((1, links - 1)), rtol=1e-6)
        for coast in (False, True):
            found = efficiency_sensitivities(solve(case, coast=coast))
            np.testing.assert_allclose(found, 1, rtol=1e-9)


def test_laws_and_a_load_of_0_leave_the_sensitivities_of_the_ratio() -> None:
    """A pair: i = u and ETA = eta (T - T_d)/T, both in proportion; none of ETA without a torque."""
    case = loads("""\
links: [a, b]
load: {speed: 1000 rpm, torque: 30 N*m}
mechanisms: {pair: {first: a, second: b, ratio: -2, efficiency: 0.98}}
drag: {a: [[0, 3]]}
gears: {drives: [], idles: {load: {torque: 0 N*m}}}
""")
    results = solve(case)
    assert results.efficiency[0] == pytest.approx(0.98 * 27 / 30)
    assert sensitivities(results)[:, 0].tolist() == pytest.approx([1, 1])
    of_efficiency = efficiency_sensitivities(results)[:, 0].tolist()
    assert of_efficiency[0] == pytest.approx(1)
    assert math.isnan(of_efficiency[1])


def test_a_law_counts_as_the_number_that_it_comes_to() -> None:
    """Two pairs and a drag d at the output: ETA = n1 n2 - d/(i T), so both go as n1 n2/ETA.

    In gear `fast` n1 = .95 + .035 w/400 is .98, in `slow` .96; n2 stands for 30 and 15 N*m.
    """
    case = loads("""\
links: [a, b, c]
mechanisms:
  first: {first: a, second: b, ratio: -3, efficiency: {over: speed, points: [[0, .95], [400, .99]]}}
  second: {first: b, second: c, ratio: -2,
           efficiency: {over: torque, points: [[0, .9], [200, .98]]}}
drag: {c: [[0, 6]]}
gears:
  fast: {load: {speed: 300 rad/s, torque: 40 N*m}}
  slow: {load: {speed: 100 rad/s, torque: 20 N*m}}
""")
    results = solve(case)
    found = efficiency_sensitivities(results)
    for gear, (n1, torque) in enumerate([(0.98, 40), (0.96, 20)]):
        n2 = 0.9 + 0.08 * torque * 3 * n1 / 200
        eta = n1 * n2 - 6 / (6 * torque)
        assert results.efficiency[gear] == pytest.approx(eta, rel=1e-12)
        assert found[gear] == pytest.approx([n1 * n2 / eta] * 2, rel=1e-9)


@examples(3, 8, 80)
def test_efficiencies_of_random_gears_answer_as_exact_ones_do(examples: int) -> None:
    """A hundred-millionth less of one efficiency, in fractions; where no sign turns by that."""
    cases = [random_train(seeded(seed), regular=True) for seed in range(examples)]
    for case, index in ((each, n) for each in cases for n in range(len(each.gears))):
        gear, found = case.gears[index], efficiency_sensitivities(solve(case))[index]
        own = solve_gear(case, gear)
        for place, one in enumerate(case.mechanisms):
            lower = [*case.mechanisms]
            lower[place] = one._replace(efficiency=round(one.efficiency - 1e-8, 9))
            other = solve_gear(case.replace(mechanisms=lower), gear)
            if not (own.efficiency and other.efficiency and own.power_sign == other.power_sign):
                continue
            change = float((own.efficiency - other.efficiency) / own.efficiency) / 1e-8
            assert found[place] == pytest.approx(change * one.efficiency, abs=2e-6, rel=1e-5)
