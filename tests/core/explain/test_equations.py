"""The equations of a gear, as in the figures of the source."""

import json
import math

import numpy as np
import pytest

from tests.chance import count, examples, seeded
from tests.core.explain.explained import check, equations, explained, holds
from tests.shipped import shipped_results
from tests.trains import random_slipping, random_train, with_variators
from vstatics import explain_gear, loads, solve
from vstatics.core.explain.formula import SLIPS
from vstatics.core.explain.sums import in_symbols
from vstatics.core.tables.answer import plain_data

SHIPPED = (
    *("belaz7516", "gm-6t70", "mercedes-9g", "power-split", "self-locking", "simpson-th400"),
    *("toyota-p410", "umdm", "wheel-hub", "wolfrom", "zf-6hp26", "zf-8hp70"),
)
"""Of every kind: sets, groups of planets, freewheels, given speeds, several inputs."""


def test_speeds_are_written_as_in_figure_3_of_the_source() -> None:
    """Figure 3 b: brake engaged, u = -2.5; w3 = 1/3.5 in the text."""
    brake = explained("differential.yaml", "2")
    assert equations(brake.speeds) == ["w_1 + 2.5 w_2 - 3.5 w_3 = 0", "w_2 = 0", "w_1 = 1"]
    clutch = explained("differential.yaml", "1")
    assert equations(clutch.speeds)[1] == "w_1 - w_2 = 0"
    assert brake.speeds.values["w_3"] == pytest.approx(1 / 3.5)
    first = brake.speeds.equations[0]
    assert " ".join(in_symbols(first)) == "w_1 - u_D w_2 + (u_D - 1) w_3 = 0"


def test_torques_are_written_as_in_figure_4_of_the_source() -> None:
    """Figure 4 a and b, without the terms that are 0 and the elements that carry no torque."""
    clutch, brake = (explained("differential.yaml", gear) for gear in "12")
    assert equations(clutch.torques) == [
        "M_F + M_D = 1",
        "-M_F + 2.5 M_D = 0",
        "-3.5 M_D + Mx = 0",
    ]
    assert equations(brake.torques) == ["M_D = 1", "M_T + 2.5 M_D = 0", "-3.5 M_D + Mx = 0"]


@pytest.mark.parametrize("name", SHIPPED)
def test_equations_hold_and_formulas_give_the_ratios_of_shipped_cases(name: str) -> None:
    results = shipped_results(f"{name}.yaml")
    check(results, range(len(results.case.gears)))


def test_equations_hold_and_formulas_give_the_ratios_of_random_trains() -> None:
    rng = seeded(7)
    for _ in range(12):
        results = solve(random_train(rng, regular=False))
        check(results, range(len(results.case.gears)))


@examples(4, 12, 200)
def test_converters_have_their_speed_ratio_in_speeds_and_their_torque_ratio_in_torques(
    examples: int,
) -> None:
    """Interpolated by numpy, the torque ratio is in the column of both tables."""
    chance = seeded(58)
    for _ in range(examples):
        train = with_variators(chance, random_train(chance, regular=True))
        points = ((0.0, chance.uniform(1.5, 3)), (chance.uniform(0.5, 0.9), 1.0))
        mechanisms = [
            part._replace(kind="converter", points=points, efficiency=1.0, back_efficiency=None)
            if part.kind and part.ratio > 0
            else part
            for part in train.mechanisms
        ]
        case = train.replace(mechanisms=mechanisms)
        results = solve(case)
        check(results, range(len(case.gears)))
        gear = explain_gear(results, 1)
        for part in mechanisms:
            if part.kind == "converter" and part.second and part.name in gear.columns:
                column = gear.matrix[part.second - 1, gear.columns.index(part.name)]
                K = np.interp(part.ratio, *np.transpose(points))  # noqa: N806
                assert column == pytest.approx(-K, rel=1e-12)
        if gear.lossy and not math.isnan(results.lossy_output_torque[0]):
            assert gear.lossy.values["Mx"] == pytest.approx(results.lossy_output_torque[0])


def test_a_given_slip_is_on_the_right_of_its_equation() -> None:
    """The equations are true at the speeds and torques; the gear has no formula."""
    chance = seeded(57)
    for case in (case for _ in range(count(6, 100)) for case in random_slipping(chance)):
        made = explain_gear(solve(case), 1)
        given = {case.shift_elements[n - 1].name: slip for n, slip in case.gears[0].slip.items()}
        right = {one.of: one.right for one in made.speeds.equations if one.of in given}
        assert right == given
        assert made.slipping == [*given]
        assert (made.formula, made.reason) == (None, SLIPS)
        answer = json.loads(json.dumps(plain_data(made), allow_nan=False))
        for name in ("speeds", "torques", "lossy"):
            if answer[name] is not None:
                holds(answer[name])


def test_a_converter_has_different_ratios_of_speeds_and_of_torques() -> None:
    """The speed ratio lies where the straight lambda times w^2 is the torque of the load."""
    chance = seeded(279)
    for turn in range(count(3, 60)):
        torque, speed, u = (chance.uniform(low, 2 * low) for low in (80, 150, 1.5))
        at = chance.uniform(0.1, 0.9)
        end = chance.uniform(0, 0.5) * (torque / speed**2)
        start = end + (torque / speed**2 - end) / (1 - at)  # lambda is straight from start to end
        given = turn % 3 == 1
        case = loads(f"""
links: [engine, turbine, ring, mid, out]
load: {{speed: {speed} rad/s, torque: {torque} N*m}}
elements: {{P: {{kind: planetary, sun: turbine, ring: ring, carrier: mid, teeth: {{sun: 30, ring: 72}}}}}}
mechanisms:
  TC: {{kind: converter, first: engine, second: turbine, points: [[0, 2, {start}], [1, 1, {end}]]}}
  pair: {{first: mid, second: out, ratio: {u}, efficiency: "0.98 - 1/(T + 9)"}}
shift_elements: {{B: [ring, housing], L: [engine, turbine]}}
gears:
  low: {{engaged: [B], drag: {{out: 3 N*m}}{f", speed_ratios: {{TC: {at}}}" if given else ""}}}
  lock: [B, L]
""")  # fmt: skip
        results = solve(case)
        check(results, range(2))
        made = explain_gear(results, "low")
        [point] = made.converters or ()
        assert list(point[1:3]) == pytest.approx([at, 2 - at], rel=1e-9)
        assert (point.torque is None) == given
        assert point.torque is None or point.torque == pytest.approx(torque)
        assert made.ratio == pytest.approx((1 + 72 / 30) * u / at)
        answer = plain_data(made)
        assert "K_TC" in answer["torques"]["equations"][1]["symbols"]
        output = float(results.lossy_torques[0, -1])
        assert answer["lossy"]["values"]["Mx"] == pytest.approx(output)
        assert explain_gear(results, "lock").converters is None
