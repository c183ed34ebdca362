"""Fortran's way of writing numbers, and reading it back."""

import math
import re
import struct

from hypothesis import example, given
from hypothesis import strategies as st

from vstatics.core.readers.deck.numbers import real
from vstatics.core.tables.numbers import exponent, fixed, fixed_rows, rounded, short

FINITE = st.floats(allow_nan=False, allow_infinity=False)


def test_fixed_has_a_zero_before_the_point_and_fills_its_field() -> None:
    texts = {0.726: "0.726", -2.656: "-2.656", 1.0: "1.000", -0.0004: "0.000", -0.0006: "-0.001"}
    texts |= {0.9996: "1.000", -12.5: "-12.500", math.nan: "*****"}
    assert {value: fixed(value) for value in texts} == texts
    assert fixed(0.0) == fixed(-0.0) == "0.000"
    wide = {0.726: "   0.726", -123456.0: "-123456.000", math.nan: "********", math.inf: "********"}
    assert {value: fixed(value, width=8) for value in wide} == wide
    assert [fixed(value, width=3, decimals=0) for value in (1, -1, 0)] == ["  1", " -1", "  0"]


def test_exponent_has_four_digits_or_as_many_as_needed() -> None:
    texts = {-0.8: "-.8000E+00", 2.6: ".2600E+01", -2.461: "-.2461E+01", 0.94: ".9400E+00"}
    texts |= {1.0: ".1000E+01", 0.05: ".5000E-01", 0.0: ".0000E+00", 2.6145: ".26145E+01"}
    texts |= {0.1 + 0.2: ".30000000000000004E+00", 1e-300: ".1000E-299", 5e-324: ".4941E-323"}
    assert {value: exponent(value) for value in texts} == texts
    assert exponent(math.nan) == "**********"


@given(FINITE)
def test_exponent_reads_back_to_the_last_bit(value: float) -> None:
    assert struct.pack("d", real(exponent(value))) == struct.pack("d", value)


@given(FINITE, st.integers(0, 6))
def test_fixed_is_the_number_rounded(value: float, decimals: int) -> None:
    text = fixed(value, decimals=decimals)
    assert float(text) == float(f"{value:.{decimals}f}")
    assert text.strip("-")[0].isdigit()
    assert text.strip("-.0") or not text.startswith("-")


def as_printed(value: float, width: int = 0, decimals: int = 3) -> str:
    """Format a number as in the listing of the source, without a zero before the point."""
    text = fixed(value, 0 if math.isfinite(value) else width, decimals)
    return re.sub(r"^(-?)0\.", r"\1.", text).rjust(width)


@given(st.lists(st.lists(st.floats(), min_size=3, max_size=3), min_size=1), st.integers(0, 6))
@example([[0.9995, -0.0005, -0.9996]], 3)
@example([[10.0, -100.01, 0.0]], 3)
@example([[999.9996, 0.0, 0.0]], 3)
@example([[-99.9996, 0.0, 0.0]], 3)
def test_a_table_has_each_number_as_it_is_alone(rows: list[list[float]], decimals: int) -> None:
    least = decimals + 4
    written = [as_printed(value, decimals=decimals) for row in rows for value in row]
    width = max(least, *map(len, written))
    assert fixed_rows(rows, least, decimals) == [
        " ".join(as_printed(value, width, decimals) for value in row) for row in rows
    ]


@given(st.integers(-9999, 9999), st.integers(-8, 7))  # above 5.6e11 the bits are decimals
def test_the_last_bits_of_a_number_choose_none_of_its_digits(digits: int, power: int) -> None:
    """What another processor calculates a few units in the last place off looks the same."""
    value = float(f"{digits}e{power}")
    nearby = [value * (1 + n * 2.0**-50) for n in (-1, 1)]
    assert {len(rounded(one)) for one in nearby} == {len(rounded(value))}
    if digits % 5:  # no digits end in the middle of two others
        assert {rounded(one) for one in nearby} == {rounded(value)}
    assert {short(one) for one in nearby} == {short(value)}
    if value == round(value):
        assert {short(one, 2) for one in nearby} == {short(value, 2)}
