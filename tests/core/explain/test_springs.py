"""Springs in the equations and the formula of a gear."""

from dataclasses import replace

import pytest
from hypothesis import given

from tests.core.explain.explained import check, equations
from tests.trains import on_springs, trains
from vstatics import Gear, Mechanism, ShiftElement, Spring, Transmission, solve
from vstatics.core.explain import explain_gear
from vstatics.core.explain.text import write
from vstatics.core.model.springs import between
from vstatics.core.model.transmission import SpeedOf

BOX = Transmission(
    6,
    [ShiftElement(3, 0, "B"), ShiftElement(2, 3, "C")],
    [Mechanism(2, 3, 4, -2.6, name="set"), Mechanism(4, 5, 6, 4.1, name="axle")],
    [Gear([1], name="low"), Gear([2], name="direct")],
    output=5,
    link_names=["engine", "sun", "ring", "prop", "wheel", "casing"],
    springs=[
        Spring(between(1, 2), compliance=84e-5, name="damper"),
        Spring(between(6), compliance=1.5e-2, name="wind-up"),
    ],
)


def text_of(case: Transmission, gear: int = 1) -> str:
    found = explain_gear(solve(case), gear).formula
    assert found is not None
    assert found.value == pytest.approx(solve(case).ratio[gear - 1])
    return found.text


def test_shafts_and_supports_leave_the_formula_as_it_is() -> None:
    """Ring held, then as one piece; the casing of the axle stands."""
    assert text_of(BOX) == "u_axle (1 - u_set)"
    assert text_of(BOX, 2) == "u_axle"
    alone = Transmission(2, [], [], [], springs=[Spring(between(1, 2), stiffness=8, name="s")])
    shown = write([explain_gear(solve(alone), 1)])
    assert ("  i = w_1/w_2 = 1\n" in shown, "losses" in shown) == (True, False)
    assert solve(BOX).ratio == pytest.approx([4.1 * 3.6, 4.1])


def test_coefficients_of_a_twist_stand_in_the_formula_as_they_are_typed() -> None:
    """``w_prop - 4.1 w_wheel + 3.1 w_casing = 0`` with the casing held: 4.1 of it is the ratio."""
    axle = Spring({4: 1, 5: -4.1, 6: 3.1}, stiffness=9e4, name="axle")
    case = replace(BOX, mechanisms=BOX.mechanisms[:1], springs=[*BOX.springs, axle])
    assert text_of(case) == "41 (1 - u_set)/10"
    assert solve(case).ratio == pytest.approx([4.1 * 3.6, 4.1])
    third = Spring({1: 1 / 3, 2: -1}, stiffness=9e4, name="axle")
    assert text_of(Transmission(2, [], [], [Gear()], springs=[third])) == "3"


def test_coefficients_that_cancel_but_for_rounding_are_0() -> None:
    """1 - .95 - (1 - .95) on one body; what is left of it would hold the output."""
    twist = {1: 1, 2: -0.95, 3: 0.95 - 1}
    rest = Spring(twist, stiffness=9e4, name="rest")
    shafts = [Spring(between(1, other), stiffness=9e4) for other in (2, 3)]
    case = Transmission(3, [], [], [Gear()], springs=[rest, *shafts[:1]])
    assert text_of(case) == "1"
    case = Transmission(4, [], [Mechanism(1, 4, 0, 2, name="D")], [Gear()], springs=[rest, *shafts])
    assert text_of(case) == "u_D"


def test_the_equations_have_the_columns_of_springs() -> None:
    """A twist is a row of the speed equations and a column of the torque equations."""
    one = explain_gear(solve(BOX), "low")
    assert list(one.columns) == ["B", "set", "axle", "damper", "wind-up"]
    assert equations(one.speeds)[2:5] == ["w_engine - w_sun = 0", "w_casing = 0", "w_ring = 0"]
    assert equations(one.torques) == [
        "M_damper = 1",
        "M_set - M_damper = 0",
        "M_B + 2.6 M_set = 0",
        "-3.6 M_set + M_axle = 0",
        "-4.1 M_axle + Mx = 0",
        "3.1 M_axle + M[wind-up] = 0",
    ]
    assert [(list(body.links), body.stands, list(body.elements)) for body in one.together] == [
        (["ring", "casing"], True, ["B", "wind-up"]),
        (["engine", "sun"], False, ["damper"]),
    ]


@given(trains(gears=2))
def test_equations_and_formulas_hold_with_springs(case: Transmission) -> None:
    """Every equation at its solution, every formula at its symbols, against what `run` has."""
    results = solve(on_springs(case, range(0, len(case.mechanisms), 2)))
    followed = [any(isinstance(s, SpeedOf) for s in gear.speeds.values()) for gear in case.gears]
    check(results, [n for n in range(2) if results.balanced[n] and not followed[n]])
