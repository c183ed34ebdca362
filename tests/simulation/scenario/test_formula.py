"""Formulas of a scenario: values by Python's own arithmetic, mistakes at their places."""

import math
import pickle

import numpy as np
import pytest

from tests.simulation.control.written import simulated
from vstatics import Gear, Mechanism, ReadError, Transmission, sweep
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.named.law_formulas import DragFormula
from vstatics.simulation import Formula
from vstatics.simulation.scenario.formula import Vocabulary, read_formula


def test_values() -> None:
    for text, expected in (
        ("182*(1 - exp(-60*t))", 182 * (1 - math.exp(-30))),
        ("-1200*tanh(speed/0.05)", -1200 * math.tanh(-7 / 0.05)),
        ("84e-5*speed^2", 84e-5 * 49),
        ("-2^2 + 2**3^2 + 2^-1", -4 + 2**9 + 0.5),
        ("speed^2^0.5", math.nan),
        ("2^2^0.5*sign(speed)", -(2 ** math.sqrt(2))),
        ("sign(t) + 2*sign(t - t) + 4*sign(speed/100)", 1 - 4),
        ("abs(speed)^1.5", 7**1.5),
        ("min(t, speed, angle) + max(3) - sqrt(16)", -8.0),
        ("sin(2*pi*t) + cos(angle)", math.sin(math.pi) + math.cos(3)),
        ("100*(0 < t <= 0.5) + (t > 1 or not angle > 3)", 101.0),
        ("log(angle) + atan(speed)", math.log(3) - math.atan(7)),
        ("log(speed)", math.nan),
        ("1/(1 + exp(2000*t))", 0.0),
        ("1/0", math.inf),
        ("0/0", math.nan),
        ("sqrt(speed)", math.nan),
        ("10^400", math.inf),
        ("min(1/0, 5)", 5.0),
    ):
        value = Formula(text).function(0.5, -7.0, 3.0)
        assert value == pytest.approx(expected, rel=1e-14, abs=1e-14, nan_ok=True)
        assert type(value) is float


def test_what_it_has() -> None:
    assert Formula("sin(angle)*t + pi").variables == {"t", "angle"}
    assert Formula("3").variables == frozenset()
    assert read_formula(Excerpt(" 3*t ", "FH"), ["t"]) == Formula("3*t")
    assert pickle.loads(pickle.dumps(Formula("t"))) == Formula("t")  # noqa: S301
    assert len({Formula("t"), Formula("t")}) == 1


def test_where_it_bends_or_jumps() -> None:
    for text, times in (
        ("min(t/0.3, 1)*9000", (0.3,)),
        ("100*(1 < t <= 2) + sign(3 - t)", (1.0, 2.0, 3.0)),
        ("max(-t*4 + 8, t - 2, 1)", (1.75, 2.0, 3.0)),
        ("abs(2*pi*t - 4*pi)", (2.0,)),
        ("min(t^2, 4) + min(speed, t) + min(1, 2) + abs(t - t)", (-2.0, 2.0)),
        ("t < 1e308*10", ()),
    ):
        assert Formula(text).breaks == pytest.approx(times)


def test_mistakes() -> None:
    for text, column, message in (
        ("2*tt", 3, "read `tt`, expected a formula of t, speed and angle"),
        ("tanch(speed)", 1, "no function `tanch`, expected abs, min, max, sqrt, exp, tanh"),
        ("t.real", 1, "read `t.real`, expected a number, t, speed or angle, or a function"),
        ("speed[out]", 1, "read `[` after `speed`, expected speed alone: that of the link itself"),
        ("exp(1, 2)", 1, "exp of 2 values, expected one, as in exp(t)"),
        ("__import__('os')", 1, "there is no function `__import__`"),
        ("exp + 1", 1, "`exp` is a function, expected `(` after it, such as exp(t)"),
        ("2*(t", 5, "a bracket `(` is not closed"),
        ("", 1, "read nothing, expected a number, t, speed or angle"),
        ("lambda: 0", 1, "which this language does not have"),
        ("2 if t < 1 else 0", 3, "so write a factor such as `2*(x > 1)`"),
        ("if(t < 1, 2, 0)", 1, "so write a factor such as `2*(x > 1)`"),
        ("t < 1 ? 2 : 0", 7, "so write a factor such as `2*(x > 1)`"),
        ("(" * 60 + "t", 51, "more than 50 brackets are open"),
        ("0<" + "(0<" * 20 + "t" + "<1)" * 20, 32, "read too many nested comparisons, expected"),
        ("1" * 3000, 1, "read 3000 characters"),
    ):
        with pytest.raises(ReadError) as caught:
            read_formula(Excerpt(text, "formula"))
        [problem] = caught.value.problems
        assert message in problem.message
        assert problem.place is not None
        assert problem.place.column == column


def test_jumps_over_the_speed() -> None:
    for text, jumps in (
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
    ):
        assert Formula(text).jumps("speed") == pytest.approx(jumps)


def test_between_jumps_a_formula_is_what_it_is_there() -> None:
    for low, high, speed in ((-9e9, -300, -400), (-300, 300, 8), (300, 9e9, 301)):
        whole = Formula("t*speed*(abs(speed) < 300) - 7*sign(speed + 300)")
        piece = whole.between("speed", low, high)
        assert piece.function(2.0, speed, 0.0) == whole.function(2.0, speed, 0.0)
        assert piece.jumps("speed") == ()
        slope = piece.function(2.0, 1000.0, 0.0) - piece.function(2.0, 0.0, 0.0)
        assert slope == (2000.0 if low == -300 else 0.0)


def test_a_switch_of_which_no_jump_is_known() -> None:
    texts = "100*(speed < 3*t)", "sign(speed^2 - 4)", "100*(t < 1)*speed"
    assert [Formula(text).switches for text in texts] == [True, True, False]


def test_given_speeds_of_logarithm_and_arc_tangent_need_the_torques_of_their_derivatives() -> None:
    """As torques their integrals from 0 to 2 are 3 log 3 - 2 and 2 atan 2 - log(5)/2."""
    start = "duration: 2\nstart: {speeds: {a: 0}}\n"
    for text, last, integral in (
        ("log(1 + t)", 1 / 3, 3 * math.log(3) - 2),
        ("atan(t)", 1 / 5, 2 * math.atan(2) - math.log(5) / 2),
    ):
        driven = simulated(f'{start}torques: {{a: "{text}"}}\n', "inertias: {a: 1}")
        assert driven.speeds[-1, 0] == pytest.approx(integral, rel=1e-9)
        motion = simulated(f'duration: 2\nspeeds: {{a: "{text}"}}\n', "inertias: {a: 1}")
        torques = motion.torques[:, motion.devices.index("a")]
        assert (torques[0], torques[-1]) == pytest.approx((1, last), rel=1e-9)


def test_numbers_of_formulas_can_be_powers_or_percentages() -> None:
    """With a power P, w^2 rises by 2 P t/J; 1 hp is 745.69987 W (NIST SP 811)."""
    text = (
        "duration: 1\nstart: {speeds: {a: 50}}\nnumbers: {P: 80 kW, full: 75 %%}\n"
        "tables: {engine: {columns: [0%%, 100%%], rows: [[0, 0, %s]]}}\n"
        "torques: {a: 'P*full/speed + engine(speed, 0.5)/speed'}\n"
    )
    last = simulated(text % "1 hp", "inertias: {a: 1}").speeds[-1, 0]
    assert last == pytest.approx(math.sqrt(50**2 + 2 * (60e3 + 745.69987 / 2)), rel=1e-8)
    with pytest.raises(ReadError, match=r"read '1 kVA', expected a number, .* `kW` or `%`"):
        simulated(text % "1 kVA", "inertias: {a: 1}")


def test_numbers_of_numpy_are_numbers_of_formulas() -> None:
    assert Formula("p*t").knowing({"p": np.float64(3)}).function(2.0, 0.0, 0.0) == 6.0


@pytest.mark.parametrize(
    ("torque", "said"),
    [
        ("5 if t < 1 else 0", r"read `if`, .* so write a factor such as `2\*\(x > 1\)`"),
        ("5*ln(1 + t)", r"there is no function `ln`, .*; did you mean `log`\?"),
        ("5*omega", r"read `omega`, .*; did you mean `speed`\?"),
        # log is the natural logarithm, but others expect log10: beltoforion/muparser/issues/24
        ("5*log10(t)", r"there is no function `log10`, .*; write log10 as `log\(x\)/log\(10\)`"),
        # rounded numbers as steps, in github.com/tranleduy2000/ncalc/issues/32
        ("5*floor(t)", r"there is no function `floor`, .*; no function rounds, so write steps as"),
        ("t % 2", r"read `%` after `t`, expected an operator .*; no function rounds"),
        # codeplea/tinyexpr/issues/37: products without a sign
        ("2 sin(t)", r"bare or with its unit; in a formula, write `\*` between factors"),
        ("t + 2t", r"write `2\*t`, or a name in quotes"),
        # pjkundert/cpppo/issues/14: a fault in an index caused a message of Python
        ("speed[a, a]", r"read `a`, expected a name in quotes, such as speed\('a'\)"),
    ],
)
def test_formulas_of_other_languages_are_rejected_with_the_right_spelling(
    torque: str, said: str
) -> None:
    with pytest.raises(ReadError, match=said):
        simulated(f"duration: 1\ntorques: {{a: '{torque}'}}\n", "inertias: {a: 1}")


def test_a_product_with_the_time_is_not_a_mass_in_tonnes() -> None:
    with pytest.raises(ReadError, match=r"set.F: read '2\*t', expected a number, not a formula"):
        simulated("duration: 1\nset: {F: 2*t}\ntorques: {a: F}\n", "inertias: {a: 1}")


def test_sequences_set_powers_and_percentages() -> None:
    """From 0.25 s, a quarter of 4 kW: w^2 rises by 2 P t/J."""
    motion = simulated(
        "duration: 1\nstart: {speeds: {a: 50}}\nset: {P: 0, part: 0}\n"
        "torques: {a: 'P*part/speed'}\n"
        "sequences: {s: [{when: 't >= 0.25', set: {P: 4 kW, part: 25 %}}]}\n",
        "inertias: {a: 1}",
    )
    assert motion.speeds[-1, 0] == pytest.approx(math.sqrt(50**2 + 2 * 1000 * 0.75), rel=1e-8)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("log(2) + atan(2)", math.log(2) + math.atan(2)),
        ("sin(2)*cos(2) + sign(-2)", math.sin(4) / 2 - 1),
        ("exp(2)*tanh(2)", math.exp(2) * math.tanh(2)),
    ],
)
def test_sweeps_laws_and_scenarios_have_the_same_functions(text: str, expected: float) -> None:
    case = Transmission(2, [], [Mechanism(1, 2, 0, 3.0)], [Gear()])
    [chunk] = sweep(case, {"D1.ratio": [3.0]}, out=f"{text} + 0*D1.ratio")
    assert chunk.columns.item() == pytest.approx(expected)
    assert DragFormula(f"{text} + 0*w").at(1.0) == pytest.approx(expected)
    assert Formula(f"{text} + 0*t").function(1.0, 0.0, 0.0) == pytest.approx(expected)


def test_an_unknown_name_is_answered_with_the_states_of_the_scenario() -> None:
    with pytest.raises(ReadError, match="read `p`, expected a formula of t, grip and slide"):
        read_formula(Excerpt("2*p", "F"), ["t"], Vocabulary(values=["grip", "slide"]))
