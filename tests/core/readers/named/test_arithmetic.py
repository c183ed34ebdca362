"""Arithmetic in numbers of a case: as by hand, and in bounded time whatever is written."""

import contextlib
import math
import re
import time
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.rejects import rejects
from vstatics.core.readers.named.arithmetic import ARITHMETIC, LONGEST_ARITHMETIC, calculated


def test_a_number_and_what_stands_behind_it() -> None:
    for text, value, behind in (
        ("-96/39", -96 / 39, ""),
        ("2 - 3 - 4", -5.0, ""),
        ("24/2/3", 4.0, ""),
        ("-(1 + 30/60)*2", -3.0, ""),
        ("3 - -2", 5.0, ""),
        ("96/-39", -96 / 39, ""),
        ("1e3N*m", 1000.0, "N*m"),
        ("3000 1/min", 3000.0, "1/min"),
        ("60/2/min", 30.0, "/min"),
        ("1.05*FL", 1.05, "*FL"),
        ("400 N·m", 400.0, "N·m"),
    ):
        assert calculated(text) == (value, behind)


@st.composite
def sums(draw: st.DrawFn, depth: int = 3) -> str:
    """Arithmetic of whole numbers, with the blanks that people leave."""
    if depth == 0 or draw(st.booleans()):
        return str(draw(st.integers(1, 999)))
    sign = draw(st.sampled_from(("+", "-", "*", "/", " + ", " * ", " / ")))
    both = f"{draw(sums(depth - 1))}{sign}{draw(sums(depth - 1))}"
    return f"({both})" if draw(st.booleans()) else both


@given(sums())
def test_arithmetic_is_that_of_exact_fractions(text: str) -> None:
    exact = re.sub(r"[0-9]+", r"Fraction(\g<0>)", text)
    try:
        expected = eval(exact, {"Fraction": Fraction})  # noqa: S307
    except ZeroDivisionError:
        with pytest.raises(ValueError, match="other than 0"):
            calculated(text)
        return
    size = eval(exact.replace("-", "+"), {"Fraction": Fraction})  # noqa: S307
    assert calculated(text).value == pytest.approx(float(expected), abs=1e-12 * float(size))
    assert re.fullmatch(ARITHMETIC, text)


NO_NUMBERS = {
    "1/(3-3)": "other than 0",
    "1e999999999/3": "expected a smaller number",
    "1/1e999": "expected a smaller number",
    "1e308*10": "expected a smaller number",
    "1/(1e308*1e308)": "expected a smaller number",
    "(1,5)": "with a decimal point",
    "\u22122.6": "with `-` instead of `\u2212`",
    "\u20132.6 kg": "with `-` instead of `\u2013`",
    "(1 + 2": "and `)` after it",
    "--5": "a number or a calculation",
    "": "a number or a calculation",
    "٣": "a number or a calculation",
    "9" * 10**6: f"at most {LONGEST_ARITHMETIC} characters",
    "(" * 900 + "1" + ")" * 90: "at most 20 open brackets",
}


def test_what_is_no_number_is_reported() -> None:
    for text, words in NO_NUMBERS.items():
        with rejects(ValueError, words):
            calculated(text)


@given(st.text("0123456789.eE+-*/() ^Nm", max_size=LONGEST_ARITHMETIC))
def test_any_text_is_evaluated_in_bounded_time(text: str) -> None:
    begin = time.process_time()
    with contextlib.suppress(ValueError):
        assert math.isfinite(calculated(text).value)
    re.match(f"{ARITHMETIC}$", text)
    assert time.process_time() - begin < 0.5


def test_powers_are_not_calculated_and_long_chains_end() -> None:
    begin = time.process_time()
    for text in ("19**9**9**9", "110**10**10", "19^9^9^9", "1" + "*9" * 300):
        assert math.isfinite(calculated(text).value)
    for text in ("1" + "*9" * 400, "1" + "/9e-9" * 150):
        with rejects(ValueError, "expected a smaller number"):
            calculated(text)
    assert time.process_time() - begin < 2.5
