"""Units of the trade: their size from the definitions that fix them, and how they are spelled."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vstatics.core.model.shape import Measure
from vstatics.core.readers.named.si_units import measured
from vstatics.core.readers.named.units import LONGEST_UNIT, unit

POUND = Fraction("0.45359237")
"""In kg; with the foot of .3048 m: International Yard and Pound Agreement, 1959."""
FOOT = Fraction("0.3048")
GRAVITY = Fraction("9.80665")
"""Standard gravity, m/s^2: 3rd General Conference on Weights and Measures, 1901."""
LBF_FT = POUND * GRAVITY * FOOT

TORQUES = {
    Fraction(1): "N*m|Nm|N.m|N m|N-m|N·m|N⋅m|N * m|m*N|newton*meter|newton metre|newtons*meters"
    "|Н*м|Нм|Н·м|N*m^1",
    Fraction(1000): "kN*m|kNm|kN m|kilonewton*meter|кН*м|кНм|MN*mm",
    Fraction(10**6): "MN*m|MNm",
    Fraction(10): "daN*m|daNm|даН*м",
    Fraction(1, 100): "N*cm|Ncm",
    Fraction(1, 1000): "mN*m|mNm|N*mm|Nmm",
    LBF_FT: "lbf*ft|lb*ft|lbf ft|lb ft|lb-ft|lb.ft|lb. ft|ft*lb|ft-lb|ft lbf|ft-lbs|lbft|ftlbf"
    "|LB-FT|FT-LB|Lbf*Ft|foot*pound|footpound|pounds*feet",
    LBF_FT / 12: "in*lbf|lbf*in|in-lb|in lbs|inlb|lbf*inch",
    LBF_FT / 12 / 16: "ozf*in|oz-in|oz*in",
    LBF_FT * 1000: "kip*ft",
    LBF_FT * 3: "lbf*yd",
    GRAVITY: "kgf*m|kgf m|kgfm|kp*m|kpm|mkp|кгс*м|кгс м|кгсм",
    GRAVITY / 100: "kgf*cm|kgfcm|kp*cm|кгс*см",
    GRAVITY / 100_000: "gf*cm|pond*cm",
    GRAVITY * 1000: "tf*m|тс*м",
    Fraction(1, 10**7): "dyn*cm",
}
SPEEDS = {
    Fraction(
        1
    ): "rpm|RPM|Rpm|1/min|1 / min|/min|min^-1|min-1|min⁻¹|min\u22121|min**-1|rev/min|r/min|U/min"
    "|u/min|Umdr/min|tr/min|об/мин|turn/minute|revolutions per minute|revs per min|rev*min^-1",
    Fraction(60): "rev/s|rps|turn/s|revolution/second|cycle/s|об/с",
    Fraction(1, 60): "rev/h|rev/hour",
    Fraction(1000): "krpm",
    Fraction(1, 6): "deg/s|degree/second|degrees per second|°/s",
}
POWERS = {
    Fraction(1): "kW|kilowatt|kilowatts|кВт",
    Fraction(1000): "MW|МВт",
    Fraction(1, 1000): "W|watt|watts|Вт|N*m/s|Nm/s",
    Fraction(1, 10**6): "mW",
    550 * LBF_FT / 1000: "hp|HP|Hp|bhp|horsepower",  # 550 ft*lbf/s
    75 * GRAVITY / 1000: "PS|ps|CV|ch|л.с.|лс",  # 75 kgf*m/s
    GRAVITY / 1000: "kgf*m/s",
    LBF_FT / 1000: "ft*lbf/s",
}
KNOWN = [
    (quantity, size, text)
    for quantity, table in (("torque", TORQUES), ("speed", SPEEDS), ("power", POWERS))
    for size, texts in table.items()
    for text in texts.split("|")
]


@pytest.mark.parametrize(("quantity", "size", "text"), KNOWN, ids=[text for *_, text in KNOWN])
def test_a_unit_has_its_exact_size_rounded_once(quantity: str, size: Fraction, text: str) -> None:
    assert unit(text) == (quantity, float(size))


OF_SI: dict[str, tuple[Measure, float]] = {
    "speed": ("si_speed", math.pi / 30),
    "torque": ("si_torque", 1.0),
}


@pytest.mark.parametrize(
    ("quantity", "size", "text"), [one for one in KNOWN if one[0] in OF_SI], ids=str
)
def test_units_of_loads_are_those_of_headings_and_sweeps(
    quantity: str, size: Fraction, text: str
) -> None:
    measure, of_si = OF_SI[quantity]
    assert measured(f"1 {text}", measure) == pytest.approx(float(size) * of_si, rel=1e-15)


def test_printed_sizes() -> None:
    """NIST Special Publication 811 (2008), appendix B.8; a metric horsepower is 735.49875 W."""
    assert unit("lbf*ft")[1] == 1.3558179483314004
    assert unit("hp")[1] == 0.74569987158227022
    assert unit("PS")[1] == 0.73549875
    assert unit("lbf*in")[1] == pytest.approx(0.1129848, abs=5e-8)
    assert unit("ozf*in")[1] == pytest.approx(7.061552e-3, abs=5e-10)
    assert unit("kgf*m") == ("torque", 9.80665)


@pytest.mark.parametrize(
    "text", ["rad/s", "RAD/S", "radian/second", "rad*s^-1", "рад/с", "rad s-1"]
)
def test_an_angle_may_be_in_radians(text: str) -> None:
    assert unit(text) == ("speed", 30 / math.pi)


@pytest.mark.parametrize(
    "text",
    [
        *("", "1/s", "s^-1", "Hz", "1/h", "rad", "1/min/min", "N", "N*m^2", "N*m/rad", "J", "kW*h"),
        *("K", "degC", "°C", "°F", "kg*m", "nm", "NM", "KW", "kw", "w", "kNM", "MWatt", "g", "%"),
        *("N**m", "N//m", "-Nm", ".Nm", "Nm*", "N*m^9", "N*m^3^3^3^3", "N*m^-1", "rpm rpm", "m"),
        *("N" * LONGEST_UNIT, "N" * 10**6, "kip " * 10, "1/" * 20 + "min", "*" * 40, "^-1" * 13),
    ],
)
def test_other_units_are_none(text: str) -> None:
    assert unit(text)[0] is None


@given(
    st.text("Nmkrpslbft1*/.-^ °", max_size=LONGEST_UNIT + 5) | st.text(max_size=LONGEST_UNIT + 5)
)
def test_any_text_has_a_size_or_is_none(text: str) -> None:
    quantity, size = unit(text)
    assert quantity in ("speed", "torque", "power", None)
    assert 0 < size < math.inf
