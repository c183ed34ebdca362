"""Numbers with a unit, or relative to the input: how they are read and refused."""

import re
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.rejects import rejects
from vstatics.core.readers.named.arithmetic import LONGEST_ARITHMETIC
from vstatics.core.readers.named.units import QUANTITY, Quantity, WithUnit, quantity, relative


def test_a_calculation_stands_before_the_unit() -> None:
    numbers: tuple[tuple[str, Quantity, float], ...] = (
        ("400Nm", "torque", 400),
        ("1.3*400 Nm", "torque", 520),
        ("1.3*400*Nm", "torque", 520),
        ("(2 + 3)*100 rpm", "speed", 500),
        ("3000 1/min", "speed", 3000),
        ("3000/min", "speed", 3000),
        ("-60/2 U/min", "speed", -30),
        ("100 л.с.", "power", 73.549875),  # 75 kgf*m/s
    )
    for text, kind, value in numbers:
        assert quantity(text, kind) == pytest.approx(value, rel=1e-15)
        assert re.fullmatch(QUANTITY, text)


def test_what_is_no_such_quantity_is_told() -> None:
    texts: tuple[tuple[str, Quantity, str], ...] = (
        ("2100", "speed", "expected a speed with its unit, such as `2100 rpm` or `220 rad/s`"),
        ("rpm", "speed", "expected a speed with its unit"),
        ("300 Nm", "speed", "such as `2100 rpm` or `220 rad/s`; this is a torque"),
        ("300 rpn", "speed", "; did you mean `rpm`?"),
        ("50 s^-1", "speed", "; did you mean `rev/s` or `rad/s`?"),
        ("35 Hz", "speed", "; did you mean `rev/s` or `rad/s`?"),
        ("300 nm", "torque", "; did you mean `N*m`?"),
        ("300 NM", "torque", "; did you mean `N*m`?"),
        ("3 knm", "torque", "; did you mean `kN*m`?"),
        ("30 kg*m", "torque", "; did you mean `kgf*m`?"),
        ("120 kw", "power", "such as `120 kW` or `160 hp`; did you mean `kW`?"),
        ("2 mw", "power", "; did you mean `MW`?"),
        ("1,5 kW", "power", "(with a decimal point)"),
        ("90 °C", "power", "expected a power with its unit"),
        ("1e308 krpm", "speed", "expected a speed that is smaller"),
        ("1/0 rpm", "speed", "expected a denominator other than 0"),
    )
    for text, kind, words in texts:
        with rejects(ValueError, words):
            quantity(text, kind)


def test_without_a_unit_a_number_is_relative_to_the_input() -> None:
    assert relative("-78/30", "speed") == -2.6
    assert not isinstance(relative("1/500", "torque"), WithUnit)
    assert f"{relative('2*1.5 kNm', 'torque'):g}" == "3000 N*m"
    for text, words in (
        ("1.2.3", "expected a number or a calculation such as -96/39"),
        ("1,5", "(with a decimal point)"),
        ("fast", "such as `2100 rpm` or `220 rad/s`, or a number relative to the input speed"),
        ("3 rmp", "or a number relative to the input speed; did you mean `rpm`?"),
    ):
        with rejects(ValueError, words):
            relative(text, "speed")


@given(st.text("0123456789.eE+-*/() ^Nmrpkfltbi°·,", max_size=LONGEST_ARITHMETIC))
def test_any_text_is_read_or_refused_in_bounded_time(text: str) -> None:
    begin = time.process_time()
    for kind in ("speed", "torque", "power"):
        try:
            quantity(text, kind)
        except ValueError:
            continue
        assert re.match(QUANTITY, text)
    assert time.process_time() - begin < 0.5
