"""Formulas of gears: against published ones, and against the solver on all shipped cases."""

import math
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from tests.chance import count, seeded
from tests.commands import CASES, SHIPPED
from tests.trains import random_slipping
from vstatics import CaseError, Gear, Mechanism, ShiftElement, Transmission, load, solve
from vstatics.core.explain.bodies import on_own_links
from vstatics.core.model.transmission import SpeedOf
from vstatics.core.numerics.arrays import Floats
from vstatics.core.summary.sensitivity import sensitivities
from vstatics.synthesis.ratios.arrays import ratio_arrays, reach
from vstatics.synthesis.ratios.formula import GearFormula, gear_formula

FILES = [
    pytest.param(file, marks=[pytest.mark.slow] * bool(number % 8))
    for number, file in enumerate(SHIPPED)
]
"""All shipped cases, most of them for the slow tests."""
BELAZ = {
    "1": ({0: -1, 0b1: 1, 0b100: 1, 0b101: -1}, {0b1: 1}),
    "2": ({0: 1, 0b100: -1}, {0: 1}),
    "4": ({0: 1, 0b10: -1, 0b100: -1, 0b110: 1}, {0: 1, 0b10: -1, 0b100: -1}),
    "5": ({0: -1, 0b1: 1}, {0b1: 1}),
    "R2": ({0: 1, 0b1100: -1}, {0: 1}),
}
"""Evseenko, tables 1 and 2, worked out by hand from the speeds: (K1 - 1)/K1 (1 - K3), 1 - K3,
(1 - K2)(1 - K3)/(1 - K2 - K3), (K1 - 1)/K1, 1 - K3 K4."""


def formulas(case: Transmission) -> dict[str, GearFormula]:
    own = on_own_links(case)
    engaged = solve(own.case).with_freewheels_engaged
    fixed = {n: one.ratio for n, one in enumerate(own.case.mechanisms) if own.is_fixed(n)}
    own = own._replace(case=engaged)
    return {gear.name: gear_formula(own, gear, fixed) for gear in engaged.gears}


def basic_ratios(case: Transmission) -> Floats:
    """Return the basic ratios of a case as a row."""
    return np.array([[one.ratio for one in case.mechanisms]])


@pytest.mark.parametrize("gear", BELAZ)
def test_formulas_of_the_belaz(gear: str) -> None:
    found = formulas(load(CASES / "belaz7516.yaml"))[gear]
    parts = [dict(found.above), dict(found.below)]
    opposite = [{ratios: -factor for ratios, factor in part.items()} for part in parts]
    assert [*BELAZ[gear]] in (parts, opposite)


def test_sensitivities_of_the_belaz_are_those_of_its_formulas() -> None:
    """Derivatives by hand, for K = -2, -2.6, -2.2, -2.4: -K/(1 - K) of 1 - K and so on."""
    k1, k2, k3, k4 = ratios = -2.0, -2.6, -2.2, -2.4
    together = 1 - k2 - k3
    expected = {
        "2": (0, 0, -k3 / (1 - k3), 0),
        "4": (0, -k2 / (1 - k2) + k2 / together, -k3 / (1 - k3) + k3 / together, 0),
        "5": (1 / (k1 - 1), 0, 0, 0),
        "R2": (0, 0, -k3 * k4 / (1 - k3 * k4), -k3 * k4 / (1 - k3 * k4)),
    }
    found = formulas(load(CASES / "belaz7516.yaml"))
    arrays = ratio_arrays([found[name] for name in expected], 4)
    by_hand = pytest.approx(np.array([*expected.values()]), abs=1e-14)
    assert arrays.sensitivities(np.array([ratios]))[0] == by_hand


@pytest.mark.parametrize("file", FILES, ids=lambda path: path.name)
def test_every_shipped_gear_has_the_ratio_of_the_solver(file: Path) -> None:
    """The solver eliminates in floats, and knows no polynomials."""
    case = on_own_links(load(file)).case
    ratios = basic_ratios(case)
    results = solve(case)
    expected = dict(zip((gear.name for gear in case.gears), results.ratio.tolist(), strict=True))
    change = dict(zip(expected, sensitivities(results), strict=True))
    for name, formula in formulas(load(file)).items():
        if formula.kind == "ratio":
            arrays = ratio_arrays([formula], ratios.shape[1])
            assert arrays.ratios(ratios)[0, 0] == pytest.approx(expected[name], rel=1e-9)
            matter = formula.ratios
            found = arrays.sensitivities(ratios)[0, 0, matter]
            if file.name != "wolfrom.yaml":  # whose digits cancel
                assert found == pytest.approx(change[name][matter], abs=1e-6), name
        elif formula.kind == "constant":
            assert formula.constant == pytest.approx(expected[name], rel=1e-12)
        else:
            assert not math.isfinite(expected[name])


def test_kinds_of_gears_without_a_ratio() -> None:
    elements = [ShiftElement(2), ShiftElement(1, 2), ShiftElement(3), ShiftElement(1)]
    sets = [Mechanism(1, 2, 3, -2.5), Mechanism(3, 4, 0, -1.5)]
    gears = [Gear(engaged) for engaged in ([1], [2], [3], [], [4], [1, 2])]
    case = Transmission(4, elements, sets, gears, output=3)
    kinds = [one.kind for one in formulas(case).values()]
    assert kinds == ["ratio", "constant", "output stands", "open", "tied up", "tied up"]


def test_given_speeds_are_constants_of_the_formula() -> None:
    """Held at half the input speed: w_carrier = (w_sun - u w_ring)/(1 - u) with w_ring = .5."""
    for speed in (0.5, SpeedOf(1, 0.5)):
        case = Transmission(3, [], [Mechanism(1, 2, 3, -2.0)], [Gear([], {2: speed})])
        [formula] = formulas(case).values()
        arrays = ratio_arrays([formula], 1)
        found = arrays.ratios(np.array([[-2.0], [-3.0]]))[:, 0]
        assert found == pytest.approx([3 / 2, 4 / 2.5])


def test_ratios_of_locked_sets_do_not_matter() -> None:
    """Two sets that share three links turn as one piece: the third alone makes the ratio."""
    sets = [Mechanism(1, 2, 3, -2.0), Mechanism(2, 3, 1, -3.0), Mechanism(3, 4, 5, -2.5)]
    [formula] = formulas(Transmission(5, [ShiftElement(4)], sets, [Gear([1])])).values()
    assert formula.ratios == [2]


def entangled(count: int) -> Transmission:
    """So many sets, each with a new link, and equations that are to be solved together."""
    mechanisms = []
    for first in range(1, count + 1):
        other = first * 7 % (count + 2)
        second = first + 1 if other + 1 in (first, first + 2) or not other else other + 1
        mechanisms.append(Mechanism(first, second, first + 2, -2.0 - first / 100))
    return Transmission(count + 2, [ShiftElement(2)], mechanisms, [Gear([1])])


@pytest.mark.slow
def test_a_formula_that_would_be_too_long_is_refused_and_given_ratios_make_it_shorter() -> None:
    case = entangled(18)
    with pytest.raises(CaseError, match="has more than 30000 terms"):
        gear_formula(on_own_links(case), case.gears[0], {})
    given = {n: case.mechanisms[n].ratio for n in range(4, 18)}
    formula = gear_formula(on_own_links(case), case.gears[0], given)
    ratios = basic_ratios(case)
    found = ratio_arrays([formula], 18).ratios(ratios)[0, 0]
    assert formula.ratios == [0, 1, 2, 3]
    assert found == pytest.approx(solve(case).ratio[0], rel=1e-9)


def test_reach_is_that_of_all_ratios_within_the_bounds() -> None:
    """Against a fine grid: (1 - K2)(1 - K3)/(1 - K2 - K3), extremes at corners."""
    formula = formulas(load(CASES / "belaz7516.yaml"))["4"]
    low, high = np.full(4, -4.0), np.full(4, -1.5)
    grid = np.linspace(-4, -1.5, 41)
    k2, k3 = np.meshgrid(grid, grid)
    ratios = (1 - k2) * (1 - k3) / (1 - k2 - k3)
    assert reach(formula, low, high) == pytest.approx((ratios.min(), ratios.max()), rel=1e-12)


def test_a_ratio_without_bounds_has_no_reach() -> None:
    """1/(1 + K): the output stands at K = -1."""
    one = Fraction(1)
    formula = GearFormula("ratio", {0: one}, {0: one, 1: one})
    assert reach(formula, np.array([-2.0]), np.array([-0.5])) is None
    assert reach(formula, np.array([-4.0]), np.array([-2.0])) == pytest.approx((-1.0, -1 / 3))


def test_reach_of_many_sets_in_series() -> None:
    """The product of 1 - K over 13 sets, each from 2 to 15 while K is from -14 to -1."""
    above = {ratios: Fraction((-1) ** ratios.bit_count()) for ratios in range(2**13)}
    formula = GearFormula("ratio", above, {0: Fraction(1)})
    found = reach(formula, np.full(13, -14.0), np.full(13, -1.0))
    assert found == pytest.approx((2**13, 15**13), rel=1e-12)


def test_given_slips_are_constants_of_the_formula() -> None:
    """Of random trains; the solver eliminates in floats, and knows no polynomials."""
    chance = seeded(58)
    for case in (case for _ in range(count(6, 200)) for case in random_slipping(chance)):
        [formula] = formulas(case).values()
        ratios = basic_ratios(case)
        if formula.kind == "ratio":
            found = ratio_arrays([formula], ratios.shape[1]).ratios(ratios)[0, 0]
            assert found == pytest.approx(solve(case).ratio[0], rel=1e-8)
