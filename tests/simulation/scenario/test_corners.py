"""Where formulas bend or jump along a variable."""

from __future__ import annotations

import pytest

from vstatics.simulation.scenario.formula import Formula


@pytest.mark.parametrize(
    ("text", "jumps"),
    [
        ("-100*sign(speed)", (0.0,)),
        ("100*(2*speed < 600)", (300.0,)),
        ("100*(abs(speed) < 300)", (-300.0, 300.0)),
        ("100*(abs(abs(speed) - 200) <= 50)", (-250.0, -150.0, 150.0, 250.0)),
        ("5*(min(speed, 40) > 30)*(max(speed, -3) != 7)", (7.0, 30.0)),
        ("100*(10 < speed < 20 or not speed < 80)*t", (10.0, 20.0, 80.0)),
        ("(speed < 3*10^2)*exp(-speed/100)", (300.0,)),
        ("abs(speed) + max(speed, 3)", ()),
        ("100*(speed^2 < 90000)", (-300.0, 300.0)),
        ("sign(speed*abs(speed) - 400)", (20.0,)),
        ("sign(speed^3 - 2*speed^2/3 - speed/3)", (-1 / 3, 0.0, 1.0)),
        ("sign(speed^2 + 1)*sign(1/speed)*sign(speed^99)", ()),
        ("100*(speed < 3*t)", ()),
        ("100*(angle < 5)", ()),
        ("100*(t < 5)", ()),
    ],
)
def test_jumps_over_the_speed(text: str, jumps: tuple[float, ...]) -> None:
    assert Formula(text).jumps("speed") == pytest.approx(jumps)


@pytest.mark.parametrize(
    ("low", "high", "speed"), [(-9e9, -300, -400), (-300, 300, 8), (300, 9e9, 301)]
)
def test_between_jumps_a_formula_is_what_it_is_there(low: float, high: float, speed: float) -> None:
    """And goes on so beyond, where steps of an integration may ask for it."""
    whole = Formula("t*speed*(abs(speed) < 300) - 7*sign(speed + 300)")
    piece = whole.between("speed", low, high)
    assert piece.function(2.0, speed, 0.0) == whole.function(2.0, speed, 0.0)
    assert piece.jumps("speed") == ()
    slope = piece.function(2.0, 1000.0, 0.0) - piece.function(2.0, 0.0, 0.0)
    assert slope == (2000.0 if low == -300 else 0.0)


@pytest.mark.parametrize(
    ("text", "switches"),
    [("100*(speed < 3*t)", True), ("sign(speed^2 - 4)", True), ("100*(t < 1)*speed", False)],
)
def test_a_switch_of_which_no_jump_is_known(text: str, switches: bool) -> None:
    assert Formula(text).switches == switches
