"""Explanations of gears that have no solution, from the command line."""

from __future__ import annotations

import pytest

from tests.commands import CASES, LOCKED, NEUTRAL, TIED_UP, vstatics
from vstatics import Gear, Mechanism, ShiftElement, Transmission, exercise, solve
from vstatics.core.explain import explain_gear


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


def test_speeds_that_follow_one_another_have_no_formula_and_it_says_so() -> None:
    """On a curve the right wheel turns at 1.05 of the left: i = 2.05/2."""
    curve = """
links: [in, left, right]
output: left
mechanisms: {axle: {first: left, second: right, third: in, ratio: -1}}
gears: {g: {speeds: {right: 1.05*left}}}
"""
    said = vstatics("explain", "-", "--lang", "ru", stdin=curve.encode()).out
    assert "i = w_in/w_left = 1.025\n  формулы нет, так как скорость звена right" in said


def test_a_gear_locked_by_friction_has_no_solution_with_losses() -> None:
    said = vstatics("explain", "-", stdin=LOCKED.encode())
    assert said.status == 0
    assert "self-locking" in said.out
    assert "there is no solution with losses" in said.out
    assert "1 - 1/u_D" in said.out


def test_all_signs_of_a_locked_gear_are_shown_with_what_speaks_against_them() -> None:
    """One link drives the carrier over u = .995: Mx = 1 - u', at -199 of the unit speed."""
    case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, 0.995, 0.98)], [Gear([1])])
    results = solve(case)
    tried = explain_gear(results, 1).tried
    assert tried is not None
    torques = [1 - 0.995 / 0.98, 1 - 0.995 * 0.98]
    assert [one.output_torque for one in tried] == pytest.approx(torques)
    assert [one.against for one in tried] == ["", "D1"]  # the output drives; x is not that of M w
    assert {one.table for one in exercise(results, 1).blanks}.isdisjoint(
        {"power_sign", "efficiency"}
    )


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


def test_a_gear_that_is_not_there_is_wrong_use() -> None:
    said = vstatics("explain", CASES / "ford-model-t.yaml", "--gear", "hihg")
    assert said.is_wrong_use("no gear 'hihg'; did you mean `high`?")


DRAGGED = b"""\
links: [in, out]
mechanisms: {pair: {first: in, second: out, ratio: 2, efficiency: 0.98}}
gears:
  little: {load: {speed: 3000 rpm, torque: 1 N*m}, drag: {out: 5 N*m}}
  none: {load: {speed: 3000 rpm, torque: 0 N*m}, drag: {in: 1 N*m}}
"""


def test_a_dragged_gear_has_torques_and_no_efficiency() -> None:
    """At the output 2 x .98 of the 5 N*m come from the input, 3.04 from outside."""
    said = vstatics("explain", "-", "--from", "yaml", "--gear", "little", stdin=DRAGGED).out
    assert "warning: back-driven: drag takes more than the input gives" in said
    assert "    M_pair = 1  Mx = -3.04\n  there is no efficiency\n" in said
    assert "N*m" not in said


def test_torques_that_are_relative_to_nothing_are_in_newton_metres() -> None:
    """The drag of 1 N*m is driven from the output, by 2/.98 N*m."""
    said = vstatics("explain", "-", "--from", "yaml", "--gear", "none", stdin=DRAGGED).out
    assert "Torques: the balance of each link, in N*m\n" in said
    assert "Torques with losses, in N*m: u eta^x" in said
    assert f"Mx = -{2 / 0.98:.4f}\n  there is no efficiency\n" in said
    said = vstatics("flow", "-", "--from", "yaml", "--gear", "none", stdin=DRAGGED).out
    assert "1 is the power of 1 N*m" in said
