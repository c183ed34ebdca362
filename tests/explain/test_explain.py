"""Explanations of gears: equations of the source's figures, closed forms of ratios.

Closed forms are those of any textbook of planetary gears, from Willis' equation
``w_sun - u w_ring + (u - 1) w_carrier = 0``; that of each test stands beside it.
"""

from __future__ import annotations

import importlib.util
import json
import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from tests.commands import CASES, LOCKED, NEUTRAL, TIED_UP, vstatics
from tests.trains import random_train, seeded
from vstatics import load, solve
from vstatics.explain import Explanation, explain
from vstatics.explain.document import document
from vstatics.explain.equations import Equation, System
from vstatics.explain.sums import in_numbers, in_symbols
from vstatics.explain.text import write
from vstatics.model.transmission import Gear, Mechanism, ShiftElement, Transmission

SHIPPED = [
    CASES / f"{name}.yaml"
    for name in (
        "belaz7516",
        "gm-6t70",
        "mercedes-9g",
        "power-split",
        "self-locking",
        "simpson-th400",
        "toyota-p410",
        "umdm",
        "wheel-hub",
        "wolfrom",
        "zf-6hp26",
        "zf-8hp70",
    )
]
"""Of every kind: sets, groups of planets, freewheels, given speeds, several inputs."""


def explained(name: str, gear: str) -> Explanation:
    results = solve(load(CASES / name))
    return explain(results, [one.name for one in results.case.gears].index(gear))


def formula(name: str, gear: str) -> str:
    found = explained(name, gear).formula
    assert found is not None
    return found.text


def equations(system: System | None) -> list[str]:
    assert system is not None
    return [" ".join(in_numbers(equation)) for equation in system.equations]


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


def test_the_published_gearbox_has_its_closed_forms() -> None:
    """Table AMLG of the source: output torques 6.230, 3.461, 1.8, 1, -5.538, -1.6."""
    forms = ["(1 - u_D1)(1 - u_D3)", "1 - u_D3", "1 - u_D1", "1", "(1 - u_D2)(1 - u_D3)"]
    assert [formula("mzkt7922.dat", gear) for gear in "123456"] == [*forms, "1 - u_D2"]
    printed = [6.230, 3.461, 1.8, 1, -5.538, -1.6]
    results = solve(load(CASES / "mzkt7922.dat"))
    for number, ratio in enumerate(printed):
        found = explain(results, number).formula
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
    found = explain(solve(case), 0).formula
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
    found = explain(solve(case), 0).formula
    assert found is not None
    assert (found.left, found.text) == ("w_carrier", "(w_sun - u_P w_ring)/(1 - u_P)")
    assert found.value == pytest.approx((1 + 2 * 0.5) / 3)


def test_equal_wheels_of_a_differential_are_no_symbol() -> None:
    """w_left + w_right = 2 w_carrier: its ratio is -1 whatever its teeth."""
    found = explained("toyota-p410.yaml", "electric").formula
    assert found is not None
    assert "u_axle" not in found.text
    assert [symbol.name for symbol in found.symbols] == ["u2", "u3", "u4"]


def test_links_turn_together_by_structure_and_not_by_coincidence() -> None:
    """Link 3 turns as link 1 does only because -2 times -1/2 is 1; the clutch joins 4 to 1."""
    case = Transmission(
        4,
        [ShiftElement(1, 4, name="C")],
        [Mechanism(1, 2, 0, -2), Mechanism(2, 3, 0, -0.5)],
        [Gear([1])],
        output=3,
    )
    found = explain(solve(case), 0)
    assert found.speeds.values["w_3"] == 1
    assert [(body.links, body.elements) for body in found.together] == [(["1", "4"], ["C"])]


def test_a_locked_set_turns_as_one_piece() -> None:
    direct = explained("differential.yaml", "1")
    assert [body.links for body in direct.together] == [["1", "2", "3"]]
    assert direct.one_piece == ["D"]


def test_what_the_housing_holds_stands() -> None:
    [body] = explained("differential.yaml", "2").together
    assert (body.links, body.stands, body.elements) == (["2"], True, ["T"])


def test_signs_have_a_reason() -> None:
    """Published IX of gear 6: +1 +1 +1; D1 has no torque there, D3 turns as one piece."""
    signs = explained("mzkt7922.dat", "6").signs
    assert [sign.sign for sign in signs] == [1, 1, 1]
    assert [sign.why for sign in signs] == [
        "idle: no torque; x by the convention `published`",
        "power enters by the first link",
        "idle: it turns as one piece; x by the convention `published`",
    ]


def test_drag_decides_a_sign_where_nothing_else_loads_the_mechanism() -> None:
    """Drag .1 on the second link of a pair of ratio -1.5 takes .1/1.5 from its first."""
    case = Transmission(
        3,
        [],
        [
            Mechanism(1, 2, 0, -3.0, 0.98, name="main"),
            Mechanism(1, 3, 0, -1.5, 0.9, name="side"),
        ],
        [Gear(drag={3: 0.1})],
        output=2,
    )
    main, side = explain(solve(case), 0).signs
    assert side.torque == side.power == pytest.approx(0.1 / 1.5)
    assert main.torque == pytest.approx(1 - 0.1 / 1.5)
    assert (side.sign, side.why) == (1, "power enters by the first link")


def test_an_efficiency_multiplies_or_divides_by_the_direction_of_power() -> None:
    """Equation 4 of the source, u eta^x; all sets of the 8HP carry power in gear 5."""
    for sign in explained("zf-8hp70.yaml", "5").signs:
        assert sign.lossy_ratio == pytest.approx(sign.ratio * 0.98**sign.sign)
        assert math.copysign(1, sign.power) == sign.sign


def holds(system: dict[str, Any]) -> None:
    """The equations of a system in JSON are true at the values beside them."""
    values = system["values"]
    for equation in system["equations"]:
        used = [term for term in equation["terms"] if term["coefficient"]]
        if all(values[term["unknown"]] is not None for term in used):
            terms = [term["coefficient"] * values[term["unknown"]] for term in used]
            size = sum(map(abs, terms)) + abs(equation["right"])
            assert math.fsum(terms) == pytest.approx(equation["right"], abs=1e-12 * max(1, size))


def value(made: dict[str, Any]) -> Fraction:
    """A formula in JSON at the values of its symbols, by Python's own arithmetic."""
    given = (*made["symbols"], *made["speeds"])
    names = {one["symbol"]: Fraction(one["value"]) for one in given}
    return Fraction(eval(made["expression"], {"__builtins__": {}}, names))  # noqa: S307


def check(results: Any, numbers: Sequence[int]) -> None:
    for number in numbers:
        one = json.loads(json.dumps(document(explain(results, number)), allow_nan=False))
        for name in ("speeds", "torques", "lossy"):
            if one[name] is not None:
                holds(one[name])
        made = one["formula"]
        if made is not None:
            ratio = one["ratio"] if made["left"] == "i" else one["speeds"]["values"][made["left"]]
            assert float(value(made)) == pytest.approx(ratio, rel=1e-8, abs=1e-12)
        else:  # a formula is missing only where there is no ratio
            assert one["reason"]
            assert one["ratio"] is None


@pytest.mark.parametrize("file", SHIPPED, ids=lambda file: file.name)
def test_equations_hold_and_formulas_give_the_ratios_of_shipped_cases(file: Path) -> None:
    results = solve(load(file))
    check(results, range(len(results.case.gears)))


def test_equations_hold_and_formulas_give_the_ratios_of_random_trains() -> None:
    rng = seeded(7)
    for _ in range(12):
        results = solve(random_train(rng, regular=False))
        check(results, range(len(results.case.gears)))


def test_every_gear_of_a_shipped_case_fits_80_columns() -> None:
    for name in ("zf-9hp48.yaml", "toyota-p410.yaml", "ford-model-t.yaml", "ravigneaux-aod.yaml"):
        results = solve(load(CASES / name))
        text = write(explain(results, number) for number in range(len(results.case.gears)))
        assert max(map(len, text.splitlines())) <= 80


def test_a_long_train_has_a_formula() -> None:
    """Sixty pairs in a row: the product of their ratios."""
    pairs = [Mechanism(k, k + 1, 0, -1.1) for k in range(1, 61)]
    found = explain(solve(Transmission(61, [], pairs, [Gear()])), 0).formula
    assert found is not None
    assert found.value == pytest.approx(1.1**60)


def test_a_neutral_gear_says_what_is_not_determined() -> None:
    said = vstatics("explain", "-", "--gear", "N", stdin=NEUTRAL.encode())
    assert said.status == 0
    assert "not determined: w_2, w_3" in said.out
    assert "neutral: the output speed is not determined" in said.out


def test_a_tied_up_gear_has_equations_but_no_solution() -> None:
    said = vstatics("explain", "-", "--gear", "both", stdin=TIED_UP.encode())
    assert said.status == 1
    assert "error: tied up" in said.out
    assert "solution: there is none" in said.out
    assert "the gear is tied up" in said.out


def test_a_gear_locked_by_friction_has_no_solution_with_losses() -> None:
    said = vstatics("explain", "-", stdin=LOCKED.encode())
    assert said.status == 0
    assert "locked by friction" in said.out
    assert "there is no solution with losses" in said.out
    assert "1 - 1/u_D" in said.out


FREEWHEEL = """\
links: [sun, ring, carrier]
shift_elements: {F: {kind: freewheel, links: [ring, housing]}}
mechanisms: {P: {first: sun, second: ring, third: carrier, ratio: -2}}
gears: {"1": {drag: {carrier: 0.01}}}
"""


def test_a_freewheel_that_holds_is_part_of_the_gear() -> None:
    """Ring held by the freewheel: 1 - u = 3; the drag of the carrier stands on the right."""
    said = vstatics("explain", "-", stdin=FREEWHEEL.encode())
    assert said.out.startswith("Gear 1: F holds\n")
    assert "i = w_sun/w_carrier = 1 - u_P\n" in said.out
    assert "-3 M_P + Mx = -0.01" in said.out


CONFLICT = """\
links: 2
shift_elements: {F: {kind: freewheel, links: [2, housing]}}
mechanisms: {P: {first: 1, second: 2, ratio: -1.5}}
gears: {"1": {}}
"""


def test_a_gear_that_drives_a_freewheel_backward_has_no_solution() -> None:
    """The pair turns link 2 backward, which the freewheel does not let."""
    said = vstatics("explain", "-", stdin=CONFLICT.encode())
    assert said.status == 1
    assert "w_1 - u_P w_2 = 0" in said.out
    assert "the freewheels are in conflict" in said.out


def test_without_sympy_all_but_the_formula_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)
    said = vstatics("explain", CASES / "differential.yaml", "--gear", "2")
    assert said.status == 0
    assert "w_1 + 2.5 w_2 - 3.5 w_3 = 0" in said.out
    assert 'the formula needs the package sympy: pip install "vstatics[formula]"' in said.out


def test_a_gear_that_is_not_there_is_wrong_use() -> None:
    said = vstatics("explain", CASES / "ford-model-t.yaml", "--gear", "hihg")
    assert said.status == 2
    assert "no gear 'hihg'; did you mean `high`?" in said.err


def test_json_tells_the_same() -> None:
    said = vstatics("explain", CASES / "mzkt7922.dat", "--gear", "1", "--gear", "2", "-f", "json")
    [first, second] = json.loads(said.out)["gears"]
    assert first["formula"]["text"] == "(1 - u_D1)(1 - u_D3)"
    assert second["matrix"][1][:2] == [1.0, 0.0]
    assert second["engaged"] == ["F2", "T4"]


def test_coasting_turns_the_signs() -> None:
    results = solve(load(CASES / "mzkt7922.dat"), coast=True)
    [first, _, third] = explain(results, 0).signs
    assert (first.sign, third.sign) == (-1, -1)
    assert first.why == "coasting, power leaves by the first link"


def residual(equation: Equation, values: Mapping[str, float]) -> float:
    """Left less right side at given values, NaN where one of them does not exist."""
    terms = [term.coefficient * values[term.unknown] for term in equation.terms if term.coefficient]
    return math.fsum([*terms, -equation.right])


def test_a_residual_shows_what_does_not_hold() -> None:
    speeds = explained("differential.yaml", "2").speeds
    assert residual(speeds.equations[0], {**speeds.values, "w_1": 2.0}) == pytest.approx(1)
