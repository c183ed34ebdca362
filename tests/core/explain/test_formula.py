"""The closed forms of ratios."""

import importlib.util

import pytest

from tests.commands import CASES, vstatics
from tests.core.explain.explained import check, explained
from tests.shipped import shipped_results
from vstatics import load, loads, solve
from vstatics.core.explain import explain_gear
from vstatics.core.explain.formula import RatioFormula
from vstatics.core.explain.text import write
from vstatics.core.model.transmission import Gear, Mechanism, Transmission

FORMS = {
    "mzkt7922.dat": {
        "1": "(1 - u_D1)(1 - u_D3)", "2": "1 - u_D3", "3": "1 - u_D1", "4": "1",
        "5": "(1 - u_D2)(1 - u_D3)", "6": "1 - u_D2",
    },
    "wheel-hub.yaml": {"left": "1 - u1"},  # sun in, ring held
    "simpson.yaml": {"2": "1 - 1/u_P1", "3": "1", "R": "u_P2"},  # ring in, sun held
    "zf-8hp70.yaml": {"1": "1 - u_P4", "8": "u_P2/(u_P2 - 1)"},  # ring held; carrier in, sun held
    "two-stage.yaml": {"1": "u_P0 u_P1"},  # gears of the other pairs change nothing
}  # fmt: skip
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


def of(found: RatioFormula | None, value: float) -> RatioFormula:
    """A formula that has a value."""
    assert found is not None
    assert found.value == pytest.approx(value, rel=1e-12)
    return found


def of_case(links: int, mechanisms: list[Mechanism], value: float, **more: object) -> RatioFormula:
    gear = Gear(**more)  # type: ignore[arg-type]
    return of(explain_gear(solve(Transmission(links, [], mechanisms, [gear])), 1).formula, value)


def test_closed_forms_of_shipped_cases() -> None:
    """The formulas of the MZKT 7922 give the output torques of its table AMLG."""
    printed = [6.230, 3.461, 1.8, 1, -5.538, -1.6]
    for name, forms in FORMS.items():
        results = shipped_results(name)
        found = [explain_gear(results, gear).formula for gear in forms]
        assert [one and one.text for one in found] == [*forms.values()], name
        if name == "mzkt7922.dat":
            values = [one.value for one in found if one]
            assert values == pytest.approx(printed, abs=5e-4)
    assert "stand still as a whole: P1\n" in write([explained("zf-8hp70.yaml", "1")])


def test_equal_ratios_share_a_symbol_except_a_set_ratio() -> None:
    """Simpson: two sets of -73/35, 2 - 1/u."""
    first = of(explained("simpson.yaml", "1").formula, 2 + 35 / 73)
    assert (first.text, first.shared_text) == ("(u_P1 + u_P2 - 1)/u_P1", "2 - 1/u")
    assert first.shared == {"u": ["u_P1", "u_P2"]}
    # a pair of -2 behind a variator: i = u_pair/speed ratio, also if the result is -1/2
    pair = Mechanism(2, 3, 0, -2.0, name="pair")
    found = of_case(3, [Mechanism(1, 2, 0, -0.5, name="variator", kind="variator"), pair], 4)
    assert (found.text, found.shared, found.shared_text) == ("u_variator u_pair", {}, "")


@pytest.mark.parametrize(("gear", "x"), [("own", 0.5), ("even", 1.0)])
def test_a_variator_beside_drawn_elements_is_in_the_formula(gear: str, x: float) -> None:
    """Willis: w_sun - 1 = u (w_ring - 1); x = 1 is set, so nothing turns together by it."""
    ring = 1 + (x / 1.6 - 1) / (-70 / 30)
    made = explain_gear(solve(loads(CVT)), gear)
    found = of(made.formula, -61 / 20 / ring)
    assert {one.name: one.value for one in found.symbols}["u_variator"] == 1 / x
    assert [body.links for body in made.together] == [["engine", "first"]]


def test_ratios_that_are_replaced_alone_are_those_of_the_formula() -> None:
    """Teeth of the drawing would give others: planets that are links, too."""
    for name in ("simpson.yaml", "ravigneaux-aod.yaml"):
        case = load(CASES / name)
        others = [1.1 * one.ratio for one in case.mechanisms]
        check(solve(case, ratios=others), range(len(case.gears)))


def test_ravigneaux_gears_are_formulas_between_toothed_gears() -> None:
    """Teeth 30, 36, 72: ring/small sun, then Willis for both suns; no planets in it."""
    assert of(explained("ravigneaux-aod.yaml", "1").formula, 72 / 30).text == "k1"
    second = of(explained("ravigneaux-aod.yaml", "2").formula, (72 / 30 + 2) / (1 + 2))
    assert second.text == "(k1 - k2)/(1 - k2)"
    assert [symbol.value for symbol in second.symbols] == pytest.approx([72 / 30, -72 / 36])


def test_stages_in_a_row_are_a_product() -> None:
    """Each stage with its ring held has 1 - u; a pair has u."""
    stages = [Mechanism(1, 0, 2, -2), Mechanism(2, 0, 3, -3), Mechanism(3, 4, 0, -1.5)]
    assert of_case(4, stages, -1.5 * 3 * 4).text == "u_D3 (1 - u_D1)(1 - u_D2)"
    of_case(61, [Mechanism(k, k + 1, 0, -1.1) for k in range(1, 61)], 1.1**60)


def test_given_speeds_add_up() -> None:
    """First and second link given: w_third = (w_first - u w_second)/(1 - u)."""
    found = of_case(3, [Mechanism(1, 2, 3, -2, name="P")], (1 + 2 * 0.5) / 3, speeds={2: 0.5})
    assert (found.left, found.text) == ("w_3", "(w_1 - u_P w_2)/(1 - u_P)")


def test_equal_gears_of_a_differential_are_no_symbol() -> None:
    """w_left + w_right = 2 w_carrier: its ratio is -1 whatever its teeth."""
    found = explained("toyota-p410.yaml", "electric").formula
    assert found is not None
    assert "u_axle" not in found.text
    assert [symbol.name for symbol in found.symbols] == ["u2", "u3", "u4"]


def test_without_flint_all_but_the_formula_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)
    said = vstatics("explain", CASES / "differential.yaml", "--gear", "2")
    assert said.status == 0
    assert "w_1 + 2.5 w_2 - 3.5 w_3 = 0" in said.out
    assert 'the formula needs the package python-flint: pip install ".[formula]"' in said.out
