"""The closed forms of ratios."""

from __future__ import annotations

import importlib.util

import pytest

from tests.commands import CASES, vstatics
from tests.core.explain.explained import check, explained, formula
from tests.shipped import shipped_results
from vstatics import load, loads, solve
from vstatics.core.explain import explain_gear
from vstatics.core.model.transmission import Gear, Mechanism, Transmission


def test_the_published_gearbox_has_its_closed_forms() -> None:
    """Table AMLG of the source: output torques 6.230, 3.461, 1.8, 1, -5.538, -1.6."""
    forms = ["(1 - u_D1)(1 - u_D3)", "1 - u_D3", "1 - u_D1", "1", "(1 - u_D2)(1 - u_D3)"]
    assert [formula("mzkt7922.dat", gear) for gear in "123456"] == [*forms, "1 - u_D2"]
    printed = [6.230, 3.461, 1.8, 1, -5.538, -1.6]
    results = shipped_results("mzkt7922.dat")
    for number, ratio in enumerate(printed):
        found = explain_gear(results, number + 1).formula
        assert found is not None
        assert found.value == pytest.approx(ratio, abs=5e-4)


def test_a_set_with_its_ring_or_its_sun_held() -> None:
    """Ring held, sun in: 1 - u. Sun held, ring in: 1 - 1/u. Sun held, carrier in: u/(u - 1)."""
    assert formula("wheel-hub.yaml", "left") == "1 - u1"
    assert formula("simpson.yaml", "2") == "1 - 1/u_P1"
    assert formula("zf-8hp70.yaml", "8") == "u_P2/(u_P2 - 1)"


def test_simpson_gears_in_one_ratio() -> None:
    """Two equal sets: 2 - 1/u, 1 - 1/u, 1 and u; with u = -73/35."""
    first = explained("simpson.yaml", "1").formula
    assert first is not None
    assert (first.text, first.shared_text) == ("(u_P1 + u_P2 - 1)/u_P1", "2 - 1/u")
    assert first.shared == {"u": ["u_P1", "u_P2"]}
    assert first.value == pytest.approx(2 + 35 / 73)
    assert formula("simpson.yaml", "3") == "1"
    assert formula("simpson.yaml", "R") == "u_P2"


def test_a_ratio_that_is_set_is_no_other_one() -> None:
    """A pair of -2 behind a variator: i = u_pair/speed ratio, also where this is -1/2 just then."""
    pair = Mechanism(2, 3, 0, -2.0, name="pair")
    variator = Mechanism(1, 2, 0, -0.5, name="variator", kind="variator")
    found = explain_gear(solve(Transmission(3, [], [variator, pair], [Gear()])), 1).formula
    assert found is not None
    assert found.text == "u_variator u_pair"
    assert found.value == pytest.approx(4)
    assert (found.shared, found.shared_text) == ({}, "")


CVT = """
links: [engine, first, second, sun, ring, out]
mechanisms:
  variator: {kind: variator, first: first, second: second, speed_ratio: 1}
  reduction: {first: second, second: sun, ratio: 1.6}
elements:
  set: {kind: planetary, sun: sun, ring: ring, carrier: engine, teeth: {sun: 30, ring: 70}}
  final: {kind: gear_pair, first: ring, second: out, teeth: {first: 20, second: 61}}
shift_elements: {C: [engine, first]}
gears: {own: {engaged: [C], speed_ratios: {variator: 0.5}}, even: [C]}
"""


@pytest.mark.parametrize(("gear", "x"), [("own", 0.5), ("even", 1.0)])
def test_a_variator_beside_drawn_elements_is_in_the_formula(gear: str, x: float) -> None:
    """Willis: w_sun - 1 = u (w_ring - 1); x = 1 is set, so nothing turns together by it."""
    ring = 1 + (x / 1.6 - 1) / (-70 / 30)
    found = explain_gear(solve(loads(CVT)), gear)
    assert found.formula is not None
    assert found.formula.value == pytest.approx(-61 / 20 / ring, rel=1e-12)
    assert {one.name: one.value for one in found.formula.symbols}["u_variator"] == 1 / x
    assert [body.links for body in found.together] == [["engine", "first"]]


def test_ratios_that_are_replaced_alone_are_those_of_the_formula() -> None:
    """Teeth of the drawing would give others: planets that are links, too."""
    for name in ("simpson.yaml", "ravigneaux-aod.yaml"):
        case = load(CASES / name)
        others = [1.1 * one.ratio for one in case.mechanisms]
        check(solve(case, ratios=others), range(len(case.gears)))


def test_ravigneaux_gears_are_formulas_between_wheels() -> None:
    """Teeth 30, 36, 72: ring/small sun, then Willis for both suns; no planets in it."""
    first, second = (explained("ravigneaux-aod.yaml", gear).formula for gear in "12")
    assert first is not None
    assert second is not None
    assert (first.text, second.text) == ("k1", "(k1 - k2)/(1 - k2)")
    assert [symbol.value for symbol in second.symbols] == pytest.approx([72 / 30, -72 / 36])
    assert second.value == pytest.approx((72 / 30 + 72 / 36) / (1 + 72 / 36))


def test_first_gear_of_the_zf_8hp() -> None:
    """Sun of the last set in, its ring held by both brakes: 1 + 85/23 = 4.696."""
    first = explained("zf-8hp70.yaml", "1")
    assert first.formula is not None
    assert first.formula.text == "1 - u_P4"
    assert first.formula.value == pytest.approx(1 + 85 / 23)
    assert first.standing == ["P1"]


def test_stages_in_a_row_are_a_product() -> None:
    """Each stage with its ring held has 1 - u; a pair has u."""
    case = Transmission(
        4,
        [],
        [Mechanism(1, 0, 2, -2), Mechanism(2, 0, 3, -3), Mechanism(3, 4, 0, -1.5)],
        [Gear()],
    )
    found = explain_gear(solve(case), 1).formula
    assert found is not None
    assert found.text == "u_D3 (1 - u_D1)(1 - u_D2)"
    assert found.value == pytest.approx(-1.5 * 3 * 4)


def test_only_what_matters_is_in_the_formula() -> None:
    """Gear 1 of a countershaft gearbox: the wheels of the others turn and change nothing."""
    assert formula("two-stage.yaml", "1") == "u_P0 u_P1"


def test_given_speeds_add_up() -> None:
    """Sun and ring given: w_carrier = (w_sun - u w_ring)/(1 - u)."""
    case = Transmission(
        3,
        [],
        [Mechanism(1, 2, 3, -2, name="P")],
        [Gear(speeds={2: 0.5})],
        link_names=["sun", "ring", "carrier"],
    )
    found = explain_gear(solve(case), 1).formula
    assert found is not None
    assert (found.left, found.text) == ("w_carrier", "(w_sun - u_P w_ring)/(1 - u_P)")
    assert found.value == pytest.approx((1 + 2 * 0.5) / 3)


def test_equal_wheels_of_a_differential_are_no_symbol() -> None:
    """w_left + w_right = 2 w_carrier: its ratio is -1 whatever its teeth."""
    found = explained("toyota-p410.yaml", "electric").formula
    assert found is not None
    assert "u_axle" not in found.text
    assert [symbol.name for symbol in found.symbols] == ["u2", "u3", "u4"]


def test_a_long_train_has_a_formula() -> None:
    """Sixty pairs in a row: the product of their ratios."""
    pairs = [Mechanism(k, k + 1, 0, -1.1) for k in range(1, 61)]
    found = explain_gear(solve(Transmission(61, [], pairs, [Gear()])), 1).formula
    assert found is not None
    assert found.value == pytest.approx(1.1**60)


def test_without_sympy_all_but_the_formula_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)
    said = vstatics("explain", CASES / "differential.yaml", "--gear", "2")
    assert said.status == 0
    assert "w_1 + 2.5 w_2 - 3.5 w_3 = 0" in said.out
    assert 'the formula needs the package sympy: pip install ".[formula]"' in said.out
