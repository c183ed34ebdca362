"""Explanations: links that turn together, gears without a solution, the text and JSON."""

import pytest

from tests.commands import LOCKED, NEUTRAL, TIED_UP, vstatics
from tests.core.explain.explained import explained
from tests.shipped import shipped_results
from vstatics import Gear, Mechanism, ShiftElement, Transmission, exercise, solve
from vstatics.core.explain import explain_gear
from vstatics.core.explain.text import write
from vstatics.core.readers import loads

FREEWHEEL = """\
links: [sun, ring, carrier]
shift_elements: {F: {kind: freewheel, links: [ring, housing]}}
mechanisms: {P: {first: sun, second: ring, third: carrier, ratio: -2}}
gears: {"1": {drag: {carrier: 0.01}}}
"""
CONFLICT = """\
links: 2
shift_elements: {F: {kind: freewheel, links: [2, housing]}}
mechanisms: {P: {first: 1, second: 2, ratio: -1.5}}
gears: {"1": {}}
"""
DRAGGED = """\
links: [in, out]
mechanisms: {pair: {first: in, second: out, ratio: 2, efficiency: 0.98}}
gears:
  little: {load: {speed: 3000 rpm, torque: 1 N*m}, drag: {out: 5 N*m}}
  none: {load: {speed: 3000 rpm, torque: 0 N*m}, drag: {in: 1 N*m}}
"""
CURVE = """
links: [in, left, right]
output: left
mechanisms: {axle: {first: left, second: right, third: in, ratio: -1}}
gears: {g: {speeds: {right: 1.05*left}}}
"""


def told(text: str, *options: str, status: int = 0) -> str:
    said = vstatics("explain", "-", "--from", "yaml", *options, stdin=text.encode())
    assert said.status == status
    return said.out


def test_links_turn_together_by_structure_and_not_by_coincidence() -> None:
    """Link 3 turns as link 1 does only because -2 times -1/2 is 1; the clutch joins 4 to 1."""
    pairs = [Mechanism(1, 2, 0, -2), Mechanism(2, 3, 0, -0.5)]
    case = Transmission(4, [ShiftElement(1, 4, name="C")], pairs, [Gear([1])], output=3)
    found = explain_gear(solve(case), 1)
    assert found.speeds.values["w_3"] == 1
    assert [(body.links, body.elements) for body in found.together] == [(["1", "4"], ["C"])]


def test_a_locked_set_turns_as_one_piece_and_a_braked_link_stands() -> None:
    direct = explained("differential.yaml", "1")
    assert [body.links for body in direct.together] == [["1", "2", "3"]]
    assert (direct.engaged, direct.not_engaged, direct.one_piece) == (["F"], ["T"], ["D"])
    [body] = explained("differential.yaml", "2").together
    assert (body.links, body.stands, body.elements) == (["2"], True, ["T"])


def test_a_neutral_gear_says_what_is_not_determined() -> None:
    said = told(NEUTRAL, "--gear", "N")
    assert "not determined: w_2, w_3" in said
    assert "neutral: the output speed is not determined" in said


def test_gears_in_conflict_have_equations_but_no_solution() -> None:
    """The pair turns link 2 backward, which the freewheel does not let."""
    said = told(TIED_UP, "--gear", "both", status=1)
    for words in ("error: tied up", "solution: there is none", "the gear is tied up"):
        assert words in said
    said = told(CONFLICT, status=1)
    assert "w_1 - u_P w_2 = 0" in said
    assert "the freewheels are in conflict" in said


def test_speeds_that_follow_one_another_have_no_formula_and_it_says_so() -> None:
    """On a curve the right wheel turns at 1.05 of the left: i = 2.05/2."""
    line = "i = w_in/w_left = 1.025\n  формулы нет, так как скорость звена right"
    assert line in told(CURVE, "--lang", "ru")


def test_a_gear_locked_by_friction_has_no_solution_with_losses() -> None:
    said = told(LOCKED)
    for words in ("self-locking", "there is no solution with losses", "1 - 1/u_D"):
        assert words in said


def test_all_signs_of_a_locked_gear_are_shown_with_what_speaks_against_them() -> None:
    """One link drives the carrier over u = .995: Mx = 1 - u', at -199 of the unit speed."""
    case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, 0.995, 0.98)], [Gear([1])])
    results = solve(case)
    tried = explain_gear(results, 1).tried
    assert tried is not None
    torques = [1 - 0.995 / 0.98, 1 - 0.995 * 0.98]
    assert [one.output_torque for one in tried] == pytest.approx(torques)
    assert [one.against for one in tried] == ["", "D1"]  # the output drives; x is not that of M w
    asked = {one.table for one in exercise(results, 1).blanks}
    assert asked.isdisjoint({"power_sign", "efficiency"})


def test_a_freewheel_that_holds_is_part_of_the_gear() -> None:
    """Ring held by the freewheel: 1 - u = 3; the drag of the carrier stands on the right."""
    said = told(FREEWHEEL)
    assert said.startswith("Gear 1: F holds\n")
    assert "i = w_sun/w_carrier = 1 - u_P\n" in said
    assert "-3 M_P + Mx = -0.01" in said


def test_a_dragged_gear_has_torques_and_no_efficiency() -> None:
    """At the output 2 x .98 of the 5 N*m come from the input, 3.04 from outside."""
    said = told(DRAGGED, "--gear", "little")
    assert "warning: back-driven: losses take more than the input gives" in said
    assert "    M_pair = 1  Mx = -3.04\n  there is no efficiency\n" in said
    assert "N*m" not in said


def test_torques_that_are_relative_to_nothing_are_in_newton_metres() -> None:
    """The drag of 1 N*m is driven from the output, by 2/.98 N*m."""
    said = told(DRAGGED, "--gear", "none")
    assert "Torques: the balance of each link, in N*m\n" in said
    assert "Torques with losses, in N*m: u eta^x" in said
    assert f"Mx = -{2 / 0.98:.4f}\n  there is no efficiency\n" in said
    said = vstatics("flow", "-", "--from", "yaml", "--gear", "none", stdin=DRAGGED.encode()).out
    assert "1 is the power of 1 N*m" in said


def test_every_gear_of_a_shipped_case_fits_80_columns() -> None:
    for name in ("zf-9hp48.yaml", "toyota-p410.yaml", "ford-model-t.yaml", "ravigneaux-aod.yaml"):
        results = shipped_results(name)
        text = write(explain_gear(results, number + 1) for number in range(len(results.case.gears)))
        assert max(map(len, text.splitlines())) <= 80


def test_the_planet_without_teeth_is_named() -> None:
    text = " ".join(told("""
input: s1
output: r
elements:
  set: {kind: ravigneaux, small_sun: s1, large_sun: s2, ring: r, carrier: c,
        teeth: {small_sun: 28, large_sun: 32, ring: 76}}
shift_elements: {B: [c, housing]}
gears: {low: [B]}
""").split())  # fmt: skip
    assert "the teeth of planet set.short are not given" in text
    assert "set.long are not given" not in text


def test_a_converter_beside_gear_sets_drawn_is_open_in_their_explanation() -> None:
    """72 ring and 30 sun teeth, and the sun at 0.98 of the engine: i = 2.4/0.98."""
    case = loads("""\
links: [engine, turbine, sun, big, carrier, ring]
input: engine
output: ring
load: {speed: 2200 rpm, torque: 200 N*m}
shift_elements: {A: [turbine, sun], B: [carrier, housing], LU: [engine, turbine]}
mechanisms: {TC: {kind: converter, first: engine, second: turbine, points: [[0, 2], [1, 1]]}}
elements:
  set: {kind: ravigneaux, small_sun: sun, large_sun: big, ring: ring, carrier: carrier,
        teeth: {small_sun: 30, large_sun: 36, ring: 72}}
gears: {creep: {engaged: [A, B], slip: {LU: 0.02}, open: [TC]}}
""")
    assert explain_gear(solve(case), "creep").ratio == pytest.approx(2.4 / 0.98)
