"""Ratios fitted to wanted gears: closed forms, published gearboxes, what can't be."""

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.chance import generator
from tests.commands import CASES
from tests.synthesis.ratios.test_formula import FILES, entangled
from vstatics import (
    CaseError,
    Gear,
    Load,
    Mechanism,
    ShiftElement,
    Transmission,
    load,
    loads,
    solve,
)
from vstatics.core.explain.bodies import on_own_links
from vstatics.synthesis.ratios.fitting import fit, fitted_case
from vstatics.synthesis.ratios.least_squares import minimize

BELAZ = load(CASES / "belaz7516.yaml")
SET = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
"""The ring is held: i = 1 - K."""
SERIES = Transmission(
    6,
    [*(ShiftElement(link) for link in (2, 3, 5, 6)), ShiftElement(3, 4), ShiftElement(2, 4)],
    [Mechanism(1, 2, 3, -2.5), Mechanism(4, 5, 6, -2.5)],
    [Gear([5, 1, 3], name="slow", output=6), Gear([6, 2, 4], name="back", output=5)],
)
"""Two sets in series: (1 - K1)(1 - K2) with both rings held, K1 K2 with both carriers."""


def complaints(case: Transmission, ratios: dict[str, float], **options: Any) -> str:
    with pytest.raises(CaseError) as caught:
        fit(case, ratios, **options)
    return str(caught.value)


def test_the_published_targets_of_the_belaz() -> None:
    """Closed form: p3 = i2 - 1, p2 = i2(i4 - 1)/(i2 - i4), p4 = (1 - iR)/p3, p1 = 1/(i5 - 1)."""
    found = fit(BELAZ, {"2": 4.0, "4": 2.01, "R2": -5.12, "5": 1.4925})
    expected = {"P1": -1 / 0.4925, "P2": -4 * 1.01 / 1.99, "P3": -3.0, "P4": -6.12 / 3}
    assert found.ratios == pytest.approx(expected, rel=1e-12)
    assert found.residual < 1e-12
    assert (found.unmet, len(found.solutions)) == ([], 1)
    assert found.gears["6"] == 1.0
    assert found.gears["1"] == pytest.approx(4.0 * 1.4925)


@pytest.mark.parametrize("file", FILES, ids=lambda path: path.name)
def test_ratios_of_shipped_gears_give_them_back(file: Path) -> None:
    """From other ratios: those of the case, a tenth farther from 1."""
    case = on_own_links(load(file)).case
    gears = zip(case.gears, solve(case).ratio.tolist(), strict=True)
    wanted = {gear.name: ratio for gear, ratio in gears if math.isfinite(ratio) and ratio}
    own, others = on_own_links(case), list(case.mechanisms)
    for n, one in enumerate(others):
        if not own.is_fixed(n) and not case.freewheels:
            others[n] = one._replace(ratio=1 + 1.1 * (one.ratio - 1))
    found = fit(case.replace(mechanisms=others), wanted)
    assert found.residual < 1e-11
    assert found.unmet == []


def test_sets_that_may_change_places_are_two_solutions() -> None:
    """K1 + K2 = 1 + b - a and K1 K2 = b have the solutions -2, -3 for a = 12, b = 6.

    Steps are told: a formula of each gear at least, and a step of the search.
    """
    told: list[int] = []
    found = fit(SERIES, {"slow": 12.0, "back": 6.0}, advance=told.append)
    pairs = sorted([*one.ratios.values()] for one in found.solutions)
    assert pairs == [pytest.approx([-3.0, -2.0]), pytest.approx([-2.0, -3.0])]
    assert all(one.residual < 1e-12 for one in found.solutions)
    assert len(told) > len(SERIES.gears)
    assert set(told) == {1}


@pytest.mark.parametrize("weight", [1.0, 3.0])
def test_what_contradicts_itself_is_met_in_the_mean(weight: float) -> None:
    """One set: where d/dK of ln^2((1 - K)/4) + w ln^2((K - 1)/(1.3 K)) is 0, by bisection."""
    gears = [Gear([1]), Gear([2], input=2)]
    case = SET.replace(shift_elements=[ShiftElement(2), ShiftElement(1)], gears=gears)

    def slope(k: float) -> float:
        one = math.log((1 - k) / 4) * (1 / (k - 1))
        other = math.log((k - 1) / (1.3 * k)) * (1 / (k - 1) - 1 / k)
        return one + weight * other

    low, high = -13.0, -1.01
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if slope(low) * slope(middle) > 0 else (low, middle)
    found = fit(case, {"1": 4.0, "2": 1.3}, weights={"2": weight})
    assert found.ratios["D1"] == pytest.approx(low, rel=1e-9)
    assert found.unmet == ["1", "2"]
    quotients = (1 - low) / 4, (low - 1) / (1.3 * low)
    assert found.residual == pytest.approx(max(abs(math.log(q)) for q in quotients), rel=1e-9)


def test_a_bound_holds_and_the_others_give_way() -> None:
    """1 - K3 is 3.9 at most, and K4 = (1 + 5.12)/K3 follows; a bound is met to the last digit."""
    found = fit(BELAZ, {"2": 4.0, "R2": -5.12}, bounds={"P3": (-2.9, -2.0)})
    assert found.ratios["P3"] == -2.9
    assert found.ratios["P4"] == pytest.approx(-6.12 / 2.9, rel=1e-9)
    assert found.unmet == ["2"]
    assert found.residual == pytest.approx(math.log(4 / 3.9), rel=1e-9)
    assert found.warnings == ["gear 2 cannot have 4: within the bounds its ratio is 3 to 3.9"]
    found = fit(BELAZ, {"2": 20.0})
    assert (found.ratios["P3"], found.unmet) == (-14.0, ["2"])


def test_a_ratio_may_be_given() -> None:
    found = fit(BELAZ, {"4": 2.01}, bounds={"P3": (-3.0, -3.0)})
    assert found.ratios["P3"] == -3.0
    assert found.ratios["P2"] == pytest.approx(-4 * 1.01 / 1.99, rel=1e-12)
    assert found.free == ["P1", "P4"]  # in no wanted ratio


def test_bounds_on_both_sides_of_0_give_solutions_of_both_signs() -> None:
    """The case has K = -2.5, and K = 1.5 is wanted."""
    found = fit(SET, {"1": -0.5}, bounds={"D1": (-4, 4)})
    assert found.ratios["D1"] == pytest.approx(1.5)
    assert complaints(SET, {"1": -0.5}) == (
        "ratios[0]: gear 1: read -0.5, but within the bounds its ratio is 2 to 15: "
        "expected a ratio above 0 [E831]"
    )
    told = complaints(BELAZ, {"2": 4.0}, bounds={"P3": (1.5, 4)})
    words = "P3 has the ratio -3 in the case, but its bounds have the other sign; did you mean "
    assert f"{words}-4:-1.5?" in told
    assert fit(BELAZ, {"2": 4.0}, bounds={"P3": (-4, 4)}).warnings == []


def test_where_there_is_a_choice_the_case_decides() -> None:
    """1 - K3 K4 alone: (ln K3, ln K4) moves at right angles to the hyperbola; gear 6 has none."""
    found = fit(BELAZ, {"R2": -5.12})
    assert [found.ratios["P3"], found.ratios["P4"]] == pytest.approx([-3.0, -2.04], rel=1e-6)
    assert (found.free, len(found.solutions)) == (["P1", "P2", "P3", "P4"], 1)
    moved = fit(BELAZ, {"R2": -8.0})
    assert moved.ratios["P3"] == pytest.approx(-3.0 * math.sqrt(9 / 6.12), rel=1e-3)
    assert moved.residual < 1e-12
    found = fit(BELAZ, {"6": 1.0})
    assert (found.residual, found.unmet, len(found.solutions)) == (0.0, [], 1)
    assert found.ratios["P3"] == -3.0


def test_what_cant_be_is_reported() -> None:
    for ratios, options, said in (
        ({"7": -7.0}, {}, "no gear `7`; gears are 1, 2, 3, 4, 5, 6, R1, R2"),
        ({"R3": 2.0}, {}, "did you mean `3`?"),
        ({"N": 2.0}, {}, "gear N has no ratio: the speed of the output is not determined"),
        ({"6": 1.1}, {}, "its ratio is 1 whatever the ratios of the mechanisms are"),
        ({"2": -4.0}, {}, "within the bounds its ratio is 2 to 15: expected a ratio above 0"),
        ({"R2": 5.12}, {}, "expected a ratio below 0"),
        ({"2": 0.0}, {}, "read 0, expected a finite ratio other than 0"),
        ({"2": math.nan}, {}, "read nan, expected a finite ratio"),
        ({}, {}, "expected a ratio for at least one gear"),
        ({str(n): 2.0 for n in range(11)}, {}, "read 11 numbers, but the case has 9 gears"),
        ({"2": 4.0}, {"weights": {"1": 2.0}}, "gear 1: read a weight without a ratio"),
        ({"2": 4.0}, {"weights": {"2": 0.0}}, "read 0, expected a weight above 0"),
        ({"2": 4.0}, {"weights": {"x": 1.0}}, "no gear `x`"),
        ({"2": 4.0}, {"tolerance": 0.0}, "expected a number above 0"),
        ({"2": 4.0}, {"bounds": {"P9": (-4, -2)}}, "no mechanism `P9`"),
        ({"2": 4.0}, {"bounds": {"P3": (-2, -4)}}, "did you mean -4:-2?"),
        ({"2": 4.0}, {"bounds": {"P3": (0, 0)}}, "expected a ratio other than 0"),
        ({"2": 4.0}, {"bounds": {"P3": (-math.inf, -2)}}, "expected finite numbers"),
        ({"2": 4.0}, {"bounds": {"P3": (2, 4)}}, "expected a ratio below 0"),
        ({"2": 4.0}, {"bounds": {"P1": (-1e300, -1)}}, "expected sizes from 1e-09 to 1e+09"),
    ):
        neutral = BELAZ.replace(gears=[*BELAZ.gears, Gear([], name="N")])
        assert said in complaints(neutral, ratios, **options)
        wrong = {"bounds": {"Q": (1, 2)}, "weights": {"3": 1}, "tolerance": -1}
        assert len(complaints(BELAZ, {"x": 1.0, "2": math.inf}, **wrong).splitlines()) == 5


def test_signs_that_only_together_can_not_be() -> None:
    """1 - K and K - 1 by turns of the same set: one above 0, the other above 0 as well."""
    elements = [ShiftElement(2), ShiftElement(2), ShiftElement(3, 4)]
    sets = [Mechanism(1, 2, 3, -2.5), Mechanism(3, 4, 0, -1.0)]
    gears = [Gear([1], name="a", output=3), Gear([2], name="b", output=4)]
    case = Transmission(4, elements, sets, gears, output=3)
    told = complaints(case, {"a": 3.0, "b": 3.0}, bounds={"D1": (-4, 4), "D2": (-1, -1)})
    assert re.search(r"none of \d+ sets of ratios within the bounds lets all gears rotate as", told)


def test_ratios_of_shared_planets_are_those_between_central_wheels() -> None:
    """Ravigneaux, ring as output: small sun with the large one or the carrier held: K1/K2-like."""
    case = load(CASES / "ravigneaux-aod.yaml")
    own = on_own_links(case).case
    pairs = zip(own.gears, solve(own).ratio.tolist(), strict=True)
    found = fit(case, {gear.name: ratio for gear, ratio in pairs})
    assert [*found.ratios] == [one.name for one in own.mechanisms]
    assert [*found.ratios.values()] == pytest.approx([one.ratio for one in own.mechanisms])
    told = complaints(case, {"1": 2.0}, bounds={"set": (-4, -2)})
    assert "`set` has several ratios: expected set.small_sun-ring or set.large_sun-ring" in told


@pytest.mark.slow
def test_random_ratios_are_found_again() -> None:
    """Gears of random ratios: their ratios by the solver, none of which knows of the fit."""
    random = generator(4)
    for name in ("zf-9hp48", "zf-8hp70", "belaz7516", "gm-8l90", "mercedes-9g", "umdm-reduced"):
        case = load(CASES / f"{name}.yaml")
        own = on_own_links(case)
        signs = np.sign([one.ratio for one in own.case.mechanisms])
        for _ in range(6):
            ratios = signs * np.exp(random.uniform(0.05, 2.0, len(signs)))
            gears = solve(own.case, ratios=ratios).ratio.tolist()
            named = {gear.name: ratio for gear, ratio in zip(case.gears, gears, strict=True)}
            kept = [one for one, ratio in named.items() if math.isfinite(ratio)]
            wanted = random.choice(kept, random.integers(1, len(kept) + 1), replace=False)
            assert fit(case, {str(one): named[one] for one in wanted}).residual < 1e-11


def test_minima_settle_where_slopes_vanish() -> None:
    """(x - 3)^2 + (1.5)^2 (x - 1)^2 is least at x = (3 + 2.25)/3.25."""

    def line(x: Any, _: Any) -> tuple[Any, Any]:
        slopes = np.broadcast_to([[1.0], [1.5]], (len(x), 2, 1))
        return np.concatenate([x - 3, 1.5 * (x - 1)], axis=1), slopes

    bounds = np.full((4, 1), 10.0)
    found = minimize(line, np.array([[-9.0], [0.0], [2.0], [9.0]]), -bounds, bounds)
    assert found.settled.all()
    assert found.unknowns[:, 0] == pytest.approx([5.25 / 3.25] * 4, abs=1e-12)


@pytest.mark.slow
def test_a_gear_that_nobody_asked_for_may_have_a_formula_that_is_too_long() -> None:
    long = entangled(18)
    sets = [*long.mechanisms, Mechanism(1, long.links + 1, 0, -2.0)]
    gears = [Gear([1], output=long.links), Gear([1], name="pair")]
    case = Transmission(long.links + 1, long.shift_elements, sets, gears)
    found = fit(case, {"pair": -4.0})
    assert found.ratios["D19"] == pytest.approx(-4.0)
    assert found.gears["1"] == pytest.approx(solve(case).ratio[0])
    assert "gears[1]: the formula of its ratio has more than" in complaints(case, {"1": 2.0})


def test_gears_that_have_the_same_ratio_can_not_differ() -> None:
    case = BELAZ.replace(gears=[*BELAZ.gears, BELAZ.gears[1]._replace(name="2b")])
    found = fit(case, {"2": 4.0, "2b": 3.0})
    assert found.warnings == ["gears 2 and 2b have the same ratio, but 4 and 3 are wanted"]
    assert found.gears["2"] == pytest.approx(math.sqrt(12))
    assert fit(case, {"2": 4.0, "2b": 4.01}).warnings == []


def test_starts_are_found_where_few_ratios_let_all_gears_turn_as_wanted() -> None:
    """Products of six ratios of either sign, some with fixed signs: one orthant in 64."""
    pairs = [Mechanism(n, n + 1, 0, -2.0) for n in range(1, 7)]
    gears = [Gear([], name=str(n), output=n + 1) for n in range(1, 7)]
    wanted = {str(n): 1.5**n for n in range(1, 7)}
    found = fit(Transmission(7, [], pairs, gears), wanted, bounds={"all": (-4, 4)})
    assert list(found.ratios.values()) == pytest.approx([1.5] * 6)
    assert (found.residual < 1e-12, len(found.solutions)) == (True, 1)


def test_numbers_of_any_size_do_no_harm() -> None:
    for found in (
        fit(BELAZ, {"2": 1e300, "R2": -1e-300}),
        fit(BELAZ, {"2": 4.0, "4": 2.0, "3": 9.0}, weights={"2": 1e-300, "3": 1e300}),
        fit(BELAZ, {"2": 4.0, "R2": -5.0}, bounds={"all": (-1e9, -1e-9)}),
        fit(BELAZ, {"2": 4.0, "R2": -5.0}, bounds={"all": (-1e9, 1e9)}),
    ):
        assert all(math.isfinite(ratio) and ratio for ratio in found.ratios.values())


def test_a_ratio_of_minus_1_is_kept_and_reported_where_it_is_in_the_way() -> None:
    case = SET.replace(mechanisms=[Mechanism(1, 2, 3, -1.0)])
    found = fit(case, {"1": 4.0})
    assert (found.ratios["D1"], found.unmet) == (-1.0, ["1"])
    words = "D1 keeps -1, as a symmetrical differential has it; --bounds D1=-14:-1"
    assert words in str(found.warnings)
    assert fit(case, {"1": 4.0}, bounds={"D1": (-14, -1)}).ratios["D1"] == pytest.approx(-3)


def test_the_best_is_the_least_sum_of_squares_also_where_another_one_meets_all() -> None:
    """Heavy weights: both sets in series, once met but for the light gear, once everywhere."""
    found = fit(SERIES, {"slow": 12.0, "back": 6.5}, weights={"back": 1e-6})
    gears = [solution.gears for solution in found.solutions]
    logs = [(math.log(own["slow"] / 12), math.log(own["back"] / 6.5)) for own in gears]
    squares = [slow**2 + 1e-6 * back**2 for slow, back in logs]
    assert squares == sorted(squares)
    assert found.residual == found.solutions[0].residual


def test_speed_ratios_of_a_gear_are_not_fitted() -> None:
    """Behind the speed ratios 0.8 and 0.4, i = -4 needs the ratio -3.2; the other gear has -8."""
    case = loads(
        "links: [a, b, c]\nmechanisms: {V: {kind: variator, first: a, second: b}}\nelements:\n"
        "  pair: {kind: gear_pair, first: b, second: c, teeth: {first: 20, second: 40}}\n"
        "gears: {1: {speed_ratios: {V: 0.8}}, 2: {speed_ratios: {V: 0.4}}}\n"
    )
    found = fit(case, {"1": -4.0})
    assert found.ratios["pair"] == pytest.approx(-3.2)
    assert solve(fitted_case(case, found.ratios)).ratio == pytest.approx([-4.0, -8.0])


def test_a_converter_that_finds_its_ratio_is_not_fitted() -> None:
    points = ((0, 2, 0.005), (1, 1, 0.0))
    converter = Mechanism(1, 2, 0, math.nan, name="TC", kind="converter", points=points)
    load = Load(2000, 100)
    case = Transmission(3, [], [converter, Mechanism(2, 3, 0, -2.0)], [Gear()], load=load)
    assert "TC has no given speed ratio" in complaints(case, {"1": 3.0})
