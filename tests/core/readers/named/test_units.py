"""Common units: their sizes by definition, their spellings, and numbers with units."""

import contextlib
import math
import re
import time
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.rejects import rejects
from vstatics.core.model.shape import UNIT_OF, Measure
from vstatics.core.readers.named.arithmetic import LONGEST_ARITHMETIC, further
from vstatics.core.readers.named.scalars import NUMBER
from vstatics.core.readers.named.si_units import WITH_UNIT, measured
from vstatics.core.readers.named.units import (
    LONGEST_UNIT,
    QUANTITY,
    Quantity,
    WithUnit,
    quantity,
    relative,
    unit,
    with_article,
)

ONE, KILO, MEGA, MILLI = Fraction(1), Fraction(1000), Fraction(10**6), Fraction(1, 1000)
POUND = Fraction("0.45359237")
"""In kg; with the foot of .3048 m: International Yard and Pound Agreement, 1959."""
FOOT = Fraction("0.3048")
INCH = FOOT / 12
GRAVITY = Fraction("9.80665")
"""Standard gravity, m/s^2: 3rd General Conference on Weights and Measures, 1901."""
LBF_FT = POUND * GRAVITY * FOOT

TORQUES = {
    ONE: "N*m|Nm|N.m|N m|N-m|N·m|N⋅m|N∙m|N * m|m*N|newton*meter|newton metre|newtons*meters"
    "|Н*м|Нм|Н·м|N*m^1",
    KILO: "kN*m|kNm|kN m|kilonewton*meter|кН*м|кНм|MN*mm",
    MEGA: "MN*m|MNm",
    Fraction(10): "daN*m|daNm|даН*м",
    Fraction(1, 100): "N*cm|Ncm",
    MILLI: "mN*m|mNm|N*mm|Nmm",
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
    ONE: "rpm|RPM|Rpm|1/min|1 / min|/min|min^-1|min-1|min⁻¹|min\u22121|min**-1|rev/min|r/min|U/min"
    "|u/min|Umdr/min|tr/min|об/мин|turn/minute|revolutions per minute|revs per min|rev*min^-1",
    Fraction(60): "rev/s|rps|turn/s|revolution/second|cycle/s|об/с",
    Fraction(1, 60): "rev/h|rev/hour",
    KILO: "krpm",
    Fraction(1, 6): "deg/s|degree/second|degrees per second|°/s",
}
POWERS = {
    ONE: "kW|kilowatt|kilowatts|кВт",
    KILO: "MW|МВт",
    MILLI: "W|watt|watts|Вт|N*m/s|Nm/s",
    1 / MEGA: "mW",
    550 * LBF_FT / 1000: "hp|HP|Hp|bhp|horsepower",  # 550 ft*lbf/s
    75 * GRAVITY / 1000: "PS|ps|CV|ch|л.с.|лс",  # 75 kgf*m/s
    GRAVITY / 1000: "kgf*m/s",
    LBF_FT / 1000: "ft*lbf/s",
}
OF_LOADS = [
    (kind, size, text)
    for kind, table in (("torque", TORQUES), ("speed", SPEEDS), ("power", POWERS))
    for size, texts in table.items()
    for text in texts.split("|")
]
EXACT: dict[Measure, dict[Fraction, str]] = {
    "inertia": {
        ONE: "kg*m^2|kg m^2|kg·m²|kg.m2|kgm^2|kg*m*m|кг*м^2|кг·м²|N*m*s^2|Nms^2|N*m/(rad/s^2)*rad"
        "|Н·м·с²|kg*m**2|m^2*kg",
        Fraction(1, 10**4): "kg*cm^2|kg·cm²|кг*см^2",
        1 / MEGA: "kg*mm^2",
        Fraction(1, 10**7): "g*cm^2|gcm^2|г*см²",
        KILO: "t*m^2|kN*m*s^2",
        GRAVITY: "kgf*m*s^2|кгс*м*с^2|kp*m*s^2",
        GRAVITY / 100: "kgf*cm*s^2",
        # convexengineering/gpkit/issues/487: `lbm`, which is never a force
        POUND * FOOT**2: "lb*ft^2|lb ft^2|lb-ft^2|ft^2*lb|pound*foot^2|lbm*ft^2",
        POUND * INCH**2: "lb*in^2|lb in²",
        POUND / 16 * INCH**2: "oz*in^2",
        LBF_FT: "lbf*ft*s^2|ft-lbf-s^2|lb*ft*s^2",
        LBF_FT / 12: "lbf*in*s^2|in*lb*s^2",
    },
    "mass": {
        ONE: "kg|кг",
        MILLI: "g|г",
        KILO: "t|т",
        POUND: "lb|lbs|pounds|lbm|LBM",
        POUND / 16: "oz",
        GRAVITY: "kgf*s^2/m",
    },
    "length": {ONE: "m|м|metre", MILLI: "mm|мм", ONE / 100: "cm|см", INCH: "in|inch", FOOT: "ft"},
    "stiffness": {
        ONE: "N*m/rad|Nm/rad|N m/rad|Н·м/рад|N*m*rad^-1|N*m per rad",
        KILO: "kN*m/rad|kNm/rad|кН*м/рад",
        MEGA: "MN*m/rad|MNm/rad",
        GRAVITY: "kgf*m/rad|кгс*м/рад|kp*m/rad",
        LBF_FT: "lbf*ft/rad|ft-lb/rad|lb-ft/rad",
        LBF_FT / 12: "lbf*in/rad|in-lb/rad",
    },
    "compliance": {
        ONE: "rad/(N*m)|rad/N/m|rad/Nm|1/(N*m)|1/Nm|N^(-1)*m^(-1)|рад/(Н·м)|Н^-1*м^-1|N⁻¹m⁻¹",
        MILLI: "rad/(kN*m)|rad/kNm|1/(kN*m)",
        1 / GRAVITY: "rad/(kgf*m)|1/(кгс*м)",
        1 / LBF_FT: "rad/(lbf*ft)|1/(ft*lb)",
    },
    "damping": {
        ONE: "N*m*s/rad|Nms/rad|Nm/(rad/s)|N*m/(rad/s)|N*m*s|Nms|Н·м·с/рад|Н*м*с",
        KILO: "kN*m*s/rad|kNms",
        GRAVITY: "kgf*m*s/rad|кгс*м*с",
        LBF_FT: "lbf*ft*s/rad|lb-ft-s",
    },
    "area": {ONE: "m^2|m²|м^2|m*m", 100 / MEGA: "cm^2|cm²|см²", 1 / MEGA: "mm^2", INCH**2: "in^2"},
    "pressure": {
        ONE: "Pa|Па|N/m^2|N/m²",
        Fraction(100): "hPa|mbar",
        KILO: "kPa|кПа",
        Fraction(10**5): "bar|Bar|бар",
        MEGA: "MPa|МПа|N/mm^2",
        GRAVITY * 10**4: "kgf/cm^2|кгс/см²|kp/cm²",
        # angularsen/UnitsNet/pull/591: both `5 PSI` and `5 psi`
        POUND * GRAVITY / INCH**2: "psi|PSI|lbf/in^2|lb/in^2",
        # Qalculate/libqalculate/pull/374: 30000 ksi are 206.8427188 GPa
        1000 * POUND * GRAVITY / INCH**2: "ksi|KSI|kip/in^2",
    },
    "time": {ONE: "s|sec|с", MILLI: "ms|мс", Fraction(60): "min", Fraction(3600): "h"},
    "velocity": {ONE: "m/s|м/с|m*s^-1", Fraction(1000, 3600): "km/h|км/ч", FOOT: "ft/s"},
    "pump_factor": {ONE: "N*m*s^2|N*m*s^2/rad^2|Nms²|kg*m^2", KILO: "kN*m*s^2"},
}
"""By size in SI: from the definitions of pound, foot and standard gravity."""
OF_ANGLES: dict[Measure, dict[float, str]] = {
    "stiffness": {
        180 / math.pi: "N*m/deg|Nm/°|N m/deg|N∙m/deg|Н*м/град",
        10800 / math.pi: "N*m/arcmin|Nm/arcmin",
        1000.0: "N*m/mrad",
        1 / (2 * math.pi): "N*m/rev",
        1000 * 180 / math.pi: "kN*m/deg",
    },
    "compliance": {math.pi / 180: "deg/(N*m)|°/Nm", math.pi / 180 / 1000: "deg/(kN*m)|deg/kNm"},
    "angle": {
        1.0: "rad|рад",
        math.pi / 180: "deg|°|град",
        2 * math.pi: "rev",
        math.pi / 10800: "arcmin",
        math.pi / 648000: "arcsec",  # github.com/amusecode/amuse/pull/169
        0.001: "mrad|мрад",
    },
    "inertia": {1.0: "kg*m^2/rad|N*m*s^2/rad"},
    "pump_factor": {(30 / math.pi) ** 2: "N*m/rpm^2"},
    "damping": {30 / math.pi: "N*m/rpm", 180 / math.pi: "N*m*s/deg|N*m/(deg/s)"},
}
KNOWN = [
    (measure, float(size), text)
    for table in (EXACT, OF_ANGLES)
    for measure, sizes in table.items()
    for size, texts in sizes.items()
    for text in texts.split("|")
]


def test_a_unit_of_a_load_has_its_exact_size_rounded_once() -> None:
    """That of headings and sweeps is the same in SI."""
    assert {text: unit(text) for *_, text in OF_LOADS} == {
        text: (kind, float(size)) for kind, size, text in OF_LOADS
    }
    of_si: dict[str, tuple[Measure, float]] = {
        "speed": ("si_speed", math.pi / 30),
        "torque": ("si_torque", 1.0),
    }
    for kind, size, text in OF_LOADS:
        if kind in of_si:
            measure, factor = of_si[kind]
            expected = pytest.approx(float(size) * factor, rel=1e-15)
            assert measured(f"1 {text}", measure) == expected, text


def test_printed_sizes() -> None:
    """NIST Special Publication 811 (2008), appendix B.8; a metric horsepower is 735.49875 W."""
    printed = {"lbf*ft": 1.3558179, "hp": 0.74569987, "PS": 0.73549875, "kgf*m": 9.80665}
    printed |= {"lbf*in": 0.1129848, "ozf*in": 7.061552e-3}
    assert {text: unit(text)[1] for text in printed} == pytest.approx(printed, rel=5e-7)


def test_units_in_words_as_pint_prints_them() -> None:
    """Names of default_en.txt of pint (see github.com/hgrecco/pint/issues/817 and 1540)."""
    for kind, size, texts in (
        ("torque", 1.0, "newton * meter|newton_meter|meter * newton|Newton Meter|Newton-metres"),
        ("torque", 1.3558179483314004, "foot * force_pound|force_pound * foot|foot_pound|lbf_ft"),
        ("speed", 1.0, "revolutions_per_minute|revolution / minute|rotations per minute"),
        ("speed", 30 / math.pi, "rad/s|RAD/S|radian/second|rad*s^-1|рад/с|rad s-1"),
        ("power", 0.73549875, "metric_horsepower"),
        ("power", 1.0, "kilowatt"),
        (None, 1.0, "MWatt|N_2m|_Nm|N*m_"),
    ):
        for text in texts.split("|"):
            assert unit(text) == (kind, size), text
    for text in ("kilogram * meter ** 2", "meter**2 * kilogram", "kilogram_meter**2"):
        assert measured(f"0.2 {text}", "inertia") == 0.2
    assert measured("1 slug", "mass") == pytest.approx(14.593903, abs=5e-7)  # NIST SP 811
    for text in ("slug*ft^2", "slugs*ft^2"):  # the plural: nasa/T-MATS/issues/61
        assert measured(f"1 {text}", "inertia") == pytest.approx(LBF_FT)


def test_other_units_are_none() -> None:
    others = (
        *("", "1/s", "s^-1", "Hz", "1/h", "rad", "1/min/min", "N", "N*m^2", "N*m/rad", "J", "kW*h"),
        *("lbm", "K", "degC", "°C", "°F", "kg*m", "nm", "NM", "KW", "kw", "kNM", "MWatt", "g", "m"),
        *("%", "N**m", "N//m", "-Nm", ".Nm", "Nm*", "N*m^9", "N*m^3^3^3^3", "N*m^-1", "rpm rpm"),
        *("N" * LONGEST_UNIT, "N" * 10**6, "kip " * 10, "1/" * 20 + "min", "*" * 40, "^-1" * 13),
    )
    assert {text for text in others if unit(text)[0]} == set()


def test_a_unit_has_its_size_in_si() -> None:
    for measure, size, text in KNOWN:
        assert measured(f"1 {text}", measure) == pytest.approx(size, rel=5e-16), text
        assert measured(f"-2.5e3 {text}", measure) == pytest.approx(-2500 * size, rel=5e-16)
        assert re.fullmatch(f"{NUMBER}|{WITH_UNIT}", f"2.5 {text}")


def test_decimal_units_are_exact() -> None:
    numbers: dict[str, tuple[Measure, float]] = {
        "150 kg*cm^2": ("inertia", 0.015),
        "1.3*400 Nm/rad": ("stiffness", 520.0),
        "84 g": ("mass", 0.084),
        "2.5kNm/rad": ("stiffness", 2500.0),
        "(1 + 2)/4 rad/kNm": ("compliance", 0.00075),
        "3.2*N*m*s/rad": ("damping", 3.2),
        "3/4": ("area", 0.75),
        "(3) (N*m)/((rad)(s)^-1)**2": ("pump_factor", 3.0),
        "4 (m)^2/(s/s)^4": ("area", 4.0),
    }
    for text, (measure, number) in numbers.items():
        assert measured(text, measure) == number


OTHER_UNITS: tuple[tuple[str, Measure, str], ...] = (
    ("3 rpm", "inertia", "; this is a speed"),
    ("3 kgf*m^2", "inertia", "; write a flywheel effect (GD^2) of 4 kgf*m^2 as 1 kg*m^2"),
    ("3 kW", "damping", "; this is a power"),
    ("3 lbm", "si_torque", "; this is a mass"),
    ("3 kg", "inertia", "; this is a mass"),
    ("3 lb", "length", "; this is a force"),
    ("3 kg*m^2", "mass", "; this is an inertia"),
    ("3 N*m", "stiffness", "; this is a torque"),
    ("3 rad/(N*m)", "stiffness", "; this is a compliance"),
    ("3 N*m/rad", "compliance", "; this is a stiffness"),
    ("3 N*m*s/rad", "stiffness", "; this is a damping"),
    ("3 N*ms/rad", "time", "; this is a damping"),
    ("3 bar", "area", "; this is a pressure"),
    ("3 km/h", "time", "; this is a velocity"),
    ("0,15", "inertia", " (with a decimal point)"),
    ("heavy", "inertia", ""),
    ("80e9*pi*0.05**4/32", "stiffness", further("pi")),  # stiffness of a shaft, as a formula
    ("80e9*0.05^4/10", "stiffness", further("pi")),
    ("3 furlong", "length", ""),
    ("345 mmm", "length", "; did you mean `mm`?"),
    ("0.6 mmm", "area", ""),
    ("9 kgg", "mass", "; did you mean `kg`?"),
    ("3 Hz", "si_speed", "; did you mean `rev/s` or `rad/s`?"),
    ("3 nm", "si_torque", "; did you mean `N*m`?"),
    ("3 Nm/rad^", "stiffness", "; did you mean `N*m/rad`?"),
    ("3 kg*m^2^2", "inertia", "; did you mean `kg*m^2`?"),
    ("3 (kg*m^2", "inertia", "; did you mean `kg*m^2`?"),
    ("3 kg)*m^2", "inertia", "; did you mean `kg*m^2`?"),
    ("3 ((((m)^4)^4)^4)^4", "length", ""),
    ("3 kg//m^2", "inertia", "; did you mean `kg*m^2`?"),
    ("3 " + "kg*m^2/kg*" * 10 + "kg", "inertia", ""),
)


def test_another_unit_is_refused_with_what_it_is() -> None:
    for text, measure, said in OTHER_UNITS:
        unit_of = f"{with_article(measure)} in {UNIT_OF[measure]}"
        words = re.escape(f"expected {unit_of}, bare or with its unit{said}")
        with pytest.raises(ValueError, match=f"{words}$"):
            measured(text, measure)
    for text in ("1e308 kN*m/rad", "1e999", "1e308*10 N*m/rad"):
        with pytest.raises(ValueError, match=r"expected a (stiffness that is )?smaller"):
            measured(text, "stiffness")


@given(st.floats(allow_nan=False, allow_infinity=False), st.sampled_from(list(UNIT_OF)))
def test_any_number_is_read_to_the_last_bit(number: float, measure: Measure) -> None:
    assert measured(repr(number), measure) == number
    assert measured(f"{number!r} {UNIT_OF[measure]}", measure) == number


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


def test_what_is_no_such_quantity_is_reported() -> None:
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


SIGNS = "0123456789.eE+-*/() ^Nmrpkfltbis°·,"


@given(st.text(SIGNS, max_size=LONGEST_ARITHMETIC) | st.text(max_size=60))
def test_any_text_is_read_or_refused_in_bounded_time(text: str) -> None:
    begin = time.process_time()
    of, size = unit(text)
    assert of in ("speed", "torque", "power", None)
    assert 0 < size < math.inf
    for kind in ("speed", "torque", "power"):
        with contextlib.suppress(ValueError):
            quantity(text, kind)
            assert re.match(QUANTITY, text)
    for measure in UNIT_OF:
        try:
            assert math.isfinite(measured(f"3 {text}", measure))
        except ValueError as error:
            assert str(error).startswith("expected ")  # noqa: PT017 - either may be
    assert time.process_time() - begin < 0.5
