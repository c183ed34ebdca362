"""Converters that find their speed ratio: closed forms, and equations by hand that scipy solves."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from itertools import pairwise
from random import Random
from typing import NamedTuple

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator
from scipy.optimize import brentq

from tests.chance import count, examples, seeded
from vstatics import solve
from vstatics.core.readers import loads
from vstatics.core.statics.points.roots import _RootSearch

POINTS = [[0, 2.2, 0.002], [0.4, 1.5, 0.003], [1, 1, 0]]
AT_INPUT = """links: [engine, turbine, output]
load: {{speed: {speed} rad/s, torque: {torque} N*m}}
mechanisms:
  TC: {{kind: converter, first: engine, second: turbine, points: {points}}}
  pair: {{first: turbine, second: output, ratio: -3, efficiency: 0.96}}
drag: {{engine: {drag} N*m}}
"""
SPLIT = """links: [engine, sun, pump, output]
load: {{speed: {speed} rad/s, torque: {torque} N*m}}
mechanisms:
  P: {{first: sun, second: output, third: engine, ratio: {u}, efficiency: {eta}}}
  G: {{first: sun, second: pump, ratio: {g}, efficiency: {law}}}
  TC: {{kind: converter, first: pump, second: output, points: {points}}}
"""


def at_input(torque: float, points: object = POINTS, *, speed: float = 200, drag: float = 0) -> str:
    return AT_INPUT.format(speed=speed, torque=torque, drag=drag, points=points)


def test_a_converter_at_the_input_takes_the_torque_of_the_load() -> None:
    """Lambda = 96/200^2 = 0.0024 is at i = 0.16 before the peak, and at i = 0.52 behind it."""
    results = solve(loads(at_input(100, drag=4)))
    assert results.speed_ratio.tolist() == [[pytest.approx(0.52, abs=1e-13)]]
    # K = 1.5 - 0.5 (0.12/0.6) = 1.4, before the pair of -3 with 0.96
    assert results.lossy_torques_Nm[0].tolist() == pytest.approx([96, 134.4, -387.072])
    assert results.ratio.tolist() == pytest.approx([-3 / 0.52])
    assert abs(results.power_balance[0]) < 1e-14
    text = "TC also takes the torque of the load at the speed ratio 0.16; the largest speed ratio is used"
    assert [(said.id, said.text) for said in results.messages] == [("N421", text)]


def test_a_constant_lambda_behind_a_split_has_a_closed_form() -> None:
    """The sun turns with 3 w/(1 + 2 i) and has T/3: i = (3 w (3 lambda/T)^0.5 - 1)/2."""
    points = [[0, 2, 0.001], [1, 1, 0.001]]
    text = SPLIT.format(speed=200, torque=100, u=-2, eta=1, g=1, law=1, points=points)
    torque = np.linspace(130, 1070, 200)
    results = solve(loads(text), vary={"load.torque": torque})
    expected = (3 * 200 * np.sqrt(0.003 / torque) - 1) / 2
    np.testing.assert_allclose(results.speed_ratio[:, 0, 0], expected, rtol=0, atol=1e-13)


def test_a_straight_surplus_is_followed_to_its_root_in_both_directions() -> None:
    """Surpluses of 1 and -3 vanish at a quarter of the interval."""
    for low, high in ((0.0, 1.0), (1.0, 0.0)):
        first, last, before, after = np.array([[low], [high], [1.0], [-3.0]])
        search = _RootSearch(first, last, before, after, np.array([True]))
        assert search.guess(halve=False) == low + (high - low) / 4


class Drawn(NamedTuple):
    """Random case with the torque on the pump less the torque that it takes [N*m]."""

    text: str
    torque: float
    points: list[list[float]]
    surplus: Callable[..., float]
    """Function of the speed ratio, and of the part of the torque of the load."""
    most: float
    """Largest torque that the pump takes [N*m]."""
    jump: float = math.nan
    """Speed ratio at which losses change their direction. [-]"""

    def roots(self, part: float = 1) -> list[float]:
        """All speed ratios that agree with a part of the load, in descending order, by scipy."""
        corners = [point[0] for point in self.points] + [self.jump] * (0 < self.jump < 1)
        found = []
        for low, high in pairwise(sorted(corners)):
            trials = np.linspace(low + 1e-13, high - 1e-13, 41)
            values = [self.surplus(trial, part) for trial in trials]
            for place in range(40):
                if values[place] * values[place + 1] < 0:
                    low_end, high_end = trials[place : place + 2].tolist()
                    at = brentq(partial(self.surplus, part=part), low_end, high_end, xtol=1e-15)
                    found.append(float(at))
        return sorted(found, reverse=True)


def taken(points: list[list[float]], ratio: float, speed: float) -> float:
    by_ratio, _, by_factor = zip(*points, strict=True)
    return float(np.interp(ratio, by_ratio, by_factor)) * speed * abs(speed)


def random_points(rng: Random, *, coasts: bool) -> list[list[float]]:
    by_ratio = [0.0, *sorted(rng.sample([0.2, 0.35, 0.5, 0.65, 0.8, 0.9], rng.randint(1, 4))), 1.0]
    points = [[i, 2 - i, rng.uniform(0.0005, 0.003)] for i in by_ratio[:-1]]
    points.append([1.0, 1.0, 0.0])
    return [*points, [1.4, 0.95, -0.002]] if coasts else points


def drawn_at_input(rng: Random) -> Drawn:
    speed, coasts = rng.uniform(100, 400), rng.random() < 0.4
    points = random_points(rng, coasts=coasts)
    torque = rng.uniform(-0.003 if coasts else 0.0005, 0.002) * speed**2
    drag = rng.uniform(0, 0.09) * abs(torque)  # less than any torque of the load
    text = at_input(torque, points, speed=speed, drag=drag)
    return Drawn(
        text,
        torque,
        points,
        lambda i, part=1: part * torque - drag - taken(points, i, speed),
        0.003 * speed**2,
    )


def drawn_split(rng: Random) -> Drawn:
    """The sun turns with s = (1 - u) w/(1 - u i/g); it has T/(1 - u eta^x) of the planetary set.

    x = -1 where it turns faster than the carrier. The pair to the pump loses by its map.
    """
    w, u, g = rng.uniform(100, 400), rng.uniform(-4, -1.5), rng.uniform(0.5, 2)
    eta, points = rng.uniform(0.9, 0.99), random_points(rng, coasts=False)
    torque = rng.uniform(0.0005, 0.01) * w**2
    axes = [50.0, 300.0, 1500.0], [1.0, 60.0, 900.0]
    rows = [[rng.uniform(0.8, 0.99) for _ in range(3)] for _ in range(3)]
    grid = RegularGridInterpolator(axes, np.array(rows))
    by_speed = [[speed, *row] for speed, row in zip(axes[0], rows, strict=True)]
    law = f"{{over: [speed, torque], columns: {axes[1]}, rows: {by_speed}}}"
    text = SPLIT.format(speed=w, torque=torque, u=u, eta=eta, g=g, law=law, points=points)

    def surplus(i: float, part: float = 1) -> float:
        sun = (1 - u) * w / (1 - u * i / g)
        given = part * torque / (1 - u * eta ** (-1 if sun > w else 1))
        at = min(max(sun, 50.0), 1500.0), min(max(given, 1.0), 900.0)
        return g * float(grid([at])[0]) * given - taken(points, i, sun / g)

    return Drawn(text, torque, points, surplus, 0.003 * (3 * w / g) ** 2, g)


@pytest.mark.parametrize(
    ("draw", "seed", "most"),
    [pytest.param(drawn_split, 511, 2, marks=pytest.mark.slow), (drawn_at_input, 512, 16)],
)
def test_random_converters_find_the_largest_ratio_that_scipy_finds(
    draw: Callable[[Random], Drawn], seed: int, most: int
) -> None:
    """All of them for the first point, for which other ratios are reported."""
    rng, kinds = seeded(seed), set()
    for _ in range(count(most, 20 * most)):
        case, parts = draw(rng), [rng.uniform(0.1, 2) for _ in range(8)]
        many = solve(loads(case.text), vary={"load.torque": case.torque * np.array([1, *parts])})
        expected = [case.roots(part) for part in [1, *parts]]
        largest = [max(ratios, default=math.nan) for ratios in expected]
        at = many.speed_ratio[:, 0, 0]
        assert at.tolist() == pytest.approx(largest, rel=0, abs=1e-10, nan_ok=True), case.text
        assert (np.isnan(many.lossy_torques[:, 0, -1]) == np.isnan(at)).all()
        for ratio, part in zip(at, [1, *parts], strict=True):
            assert math.isnan(ratio) or abs(case.surplus(ratio, part)) <= 1e-12 * case.most
        assert np.nanmax(np.abs(many.power_balance), initial=0) < 1e-12
        kinds |= {min(len(ratios), 2) for ratios in expected}
    assert kinds == {0, 1, 2}


@pytest.mark.parametrize(
    ("draw", "seed"),
    [(drawn_at_input, 513), pytest.param(drawn_split, 514, marks=pytest.mark.slow)],
)
def test_all_ratios_that_agree_are_reported(draw: Callable[[Random], Drawn], seed: int) -> None:
    rng, several = seeded(seed), 0
    while several < count(2, 20):
        case = draw(rng)
        expected = case.roots()
        if len(expected) < 2:
            continue
        results = solve(loads(case.text))
        assert results.points is not None
        found = [float(results.speed_ratio[0, 0]), *results.points.other_ratios[0]]
        assert found == pytest.approx(expected, rel=0, abs=1e-10), case.text
        several += 1


LOCK_UP = """links: [engine, turbine, ring, output]
load: {{speed: {speed} rad/s, torque: {torque} N*m}}
shift_elements: {{LU: [engine, turbine], B: [ring, housing]}}
mechanisms:
  TC: {{kind: converter, first: engine, second: turbine, points: {points}}}
  P: {{first: turbine, second: ring, third: output, ratio: {u}, efficiency: {eta}}}
drag: {{engine: {drag} N*m}}
gears: {{slip: {{engaged: [B], slip: {{LU: {slip} rad/s}}}}}}
"""


@examples(15, 60, 600)
def test_beside_a_slipping_lock_up_the_slip_determines_the_speed_ratio(examples: int) -> None:
    """The pump takes lambda w |w|, and the clutch carries the rest, in the direction of its slip."""
    rng, kinds = seeded(515), set()
    for _ in range(examples):
        points = [[0, rng.uniform(1.8, 2.5), 0.003], [0.9, 1.0, rng.uniform(0.001, 0.002)]]
        points += [[1.0, 1.0, 0.0], [1.3, 1.0, -rng.uniform(0.001, 0.002)]]
        w, torque = rng.choice([-1, 1]) * rng.uniform(60, 400), rng.uniform(-300, 300)
        u, eta, drag, slip = -rng.uniform(1.5, 4), 0.96, rng.choice([0, 4]), rng.uniform(-20, 80)
        given = {"speed": w, "torque": torque, "points": points, "slip": slip}
        text = LOCK_UP.format(**given, u=u, eta=eta, drag=drag)
        results = solve(loads(text))
        ratio = 1 - slip / w
        of_points, multiplied, factor = np.transpose(points)
        pump = np.interp(ratio, of_points, factor) * w * abs(w)
        clutch = torque - math.copysign(drag, w) - pump
        k = np.interp(ratio, of_points, multiplied)
        turbine = clutch + k * pump
        loses = clutch * slip >= 0 and pump * w * (1 - k * ratio) >= -1e-12
        if not (0 <= ratio <= 1.3 and loses) or turbine * torque <= 0:
            assert np.isnan(results.lossy_torques).all(), text
            kinds.add([said.id for said in results.messages][-1])
            continue
        x = 1 if turbine * w > 0 else -1
        ring = u * eta**x * turbine
        expected = [clutch, ring, pump, turbine, turbine - ring]
        assert results.lossy_torques_Nm[0].tolist() == pytest.approx(expected, abs=1e-9), text
        assert results.slip_losses_kW[0, 0] == pytest.approx(clutch * slip / 1000, abs=1e-12)
        assert results.speed_ratio.tolist() == [[pytest.approx(ratio)]]
        assert abs(results.power_balance[0]) < 1e-12
        kinds.add("torques")
    assert kinds >= {"torques", "W431", "W438"}
