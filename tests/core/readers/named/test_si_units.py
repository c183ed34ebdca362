"""Units of inertias, stiffnesses, pressures and whatever else is in SI."""

from __future__ import annotations

import math
import re
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.core.readers.named.test_units import FOOT, GRAVITY, LBF_FT, POUND
from vstatics.core.model.shape import UNIT_OF, Measure
from vstatics.core.readers.named.scalars import NUMBER
from vstatics.core.readers.named.si_units import WITH_UNIT, measured
from vstatics.core.readers.named.units import with_article

INCH = FOOT / 12
EXACT: dict[Measure, dict[Fraction, str]] = {
    "inertia": {
        Fraction(
            1
        ): "kg*m^2|kg m^2|kg·m²|kg.m2|kgm^2|kg*m*m|кг*м^2|кг·м²|N*m*s^2|Nms^2|N*m/(rad/s^2)*rad"
        "|Н·м·с²|kg*m**2|m^2*kg",
        Fraction(1, 10**4): "kg*cm^2|kg·cm²|кг*см^2",
        Fraction(1, 10**6): "kg*mm^2",
        Fraction(1, 10**7): "g*cm^2|gcm^2|г*см²",
        Fraction(1000): "t*m^2|kN*m*s^2",
        GRAVITY: "kgf*m*s^2|кгс*м*с^2|kp*m*s^2",
        GRAVITY / 100: "kgf*cm*s^2",
        POUND * FOOT**2: "lb*ft^2|lb ft^2|lb-ft^2|ft^2*lb|pound*foot^2",
        POUND * INCH**2: "lb*in^2|lb in²",
        POUND / 16 * INCH**2: "oz*in^2",
        LBF_FT: "lbf*ft*s^2|ft-lbf-s^2|lb*ft*s^2",
        LBF_FT / 12: "lbf*in*s^2|in*lb*s^2",
    },
    "mass": {
        Fraction(1): "kg|кг",
        Fraction(1, 1000): "g|г",
        Fraction(1000): "t|т",
        POUND: "lb|lbs|pounds",
        POUND / 16: "oz",
        GRAVITY: "kgf*s^2/m",
    },
    "length": {
        Fraction(1): "m|м|metre",
        Fraction(1, 1000): "mm|мм",
        Fraction(1, 100): "cm|см",
        INCH: "in|inch",
        FOOT: "ft",
    },
    "stiffness": {
        Fraction(1): "N*m/rad|Nm/rad|N m/rad|Н·м/рад|N*m*rad^-1|N*m per rad",
        Fraction(1000): "kN*m/rad|kNm/rad|кН*м/рад",
        Fraction(10**6): "MN*m/rad|MNm/rad",
        GRAVITY: "kgf*m/rad|кгс*м/рад|kp*m/rad",
        LBF_FT: "lbf*ft/rad|ft-lb/rad|lb-ft/rad",
        LBF_FT / 12: "lbf*in/rad|in-lb/rad",
    },
    "compliance": {
        Fraction(
            1
        ): "rad/(N*m)|rad/N/m|rad/Nm|1/(N*m)|1/Nm|N^(-1)*m^(-1)|рад/(Н·м)|Н^-1*м^-1|N⁻¹m⁻¹",
        Fraction(1, 1000): "rad/(kN*m)|rad/kNm|1/(kN*m)",
        1 / GRAVITY: "rad/(kgf*m)|1/(кгс*м)",
        1 / LBF_FT: "rad/(lbf*ft)|1/(ft*lb)",
    },
    "damping": {
        Fraction(1): "N*m*s/rad|Nms/rad|Nm/(rad/s)|N*m/(rad/s)|N*m*s|Nms|Н·м·с/рад|Н*м*с",
        Fraction(1000): "kN*m*s/rad|kNms",
        GRAVITY: "kgf*m*s/rad|кгс*м*с",
        LBF_FT: "lbf*ft*s/rad|lb-ft-s",
    },
    "area": {
        Fraction(1): "m^2|m²|м^2|m*m",
        Fraction(1, 10**4): "cm^2|cm²|см²",
        Fraction(1, 10**6): "mm^2",
        INCH**2: "in^2",
    },
    "pressure": {
        Fraction(1): "Pa|Па|N/m^2|N/m²",
        Fraction(100): "hPa|mbar",
        Fraction(1000): "kPa|кПа",
        Fraction(10**5): "bar|бар",
        Fraction(10**6): "MPa|МПа|N/mm^2",
        GRAVITY * 10**4: "kgf/cm^2|кгс/см²|kp/cm²",
        POUND * GRAVITY / INCH**2: "psi|lbf/in^2|lb/in^2",
    },
    "time": {
        Fraction(1): "s|sec|с",
        Fraction(1, 1000): "ms|мс",
        Fraction(60): "min",
        Fraction(3600): "h",
    },
    "velocity": {
        Fraction(1): "m/s|м/с|m*s^-1",
        Fraction(1000, 3600): "km/h|км/ч",
        FOOT: "ft/s",
    },
    "pump_factor": {
        Fraction(1): "N*m*s^2|N*m*s^2/rad^2|Nms²|kg*m^2",
        Fraction(1000): "kN*m*s^2",
    },
}
"""By size in SI: from the definitions of pound, foot and standard gravity."""
OF_ANGLES: dict[Measure, dict[float, str]] = {
    "stiffness": {
        180 / math.pi: "N*m/deg|Nm/°|N m/deg",
        1 / (2 * math.pi): "N*m/rev",
        1000 * 180 / math.pi: "kN*m/deg",
    },
    "compliance": {
        math.pi / 180: "deg/(N*m)|°/Nm",
        math.pi / 180 / 1000: "deg/(kN*m)|deg/kNm",
    },
    "angle": {
        1.0: "rad|рад",
        math.pi / 180: "deg|°",
        2 * math.pi: "rev",
    },
    "pump_factor": {
        (30 / math.pi) ** 2: "N*m/rpm^2",
    },
    "damping": {
        30 / math.pi: "N*m/rpm",
        180 / math.pi: "N*m*s/deg|N*m/(deg/s)",
    },
}
KNOWN = [
    (measure, float(size), text)
    for table in (EXACT, OF_ANGLES)
    for measure, sizes in table.items()
    for size, texts in sizes.items()
    for text in texts.split("|")
]


@pytest.mark.parametrize(("measure", "size", "text"), KNOWN)
def test_a_unit_has_its_size(measure: Measure, size: float, text: str) -> None:
    assert measured(f"1 {text}", measure) == pytest.approx(size, rel=5e-16)
    assert measured(f"-2.5e3 {text}", measure) == pytest.approx(-2500 * size, rel=5e-16)
    assert re.fullmatch(f"{NUMBER}|{WITH_UNIT}", f"2.5 {text}")


@pytest.mark.parametrize("measure", UNIT_OF)
def test_what_is_bare_is_in_si(measure: Measure) -> None:
    for text, number in (("84e-5", 0.00084), ("9e4", 90000.0), ("3/4", 0.75), ("-1", -1.0)):
        assert measured(text, measure) == number
        assert measured(f"{text} {UNIT_OF[measure]}", measure) == number


@pytest.mark.parametrize(
    ("text", "measure", "number"),
    [
        ("150 kg*cm^2", "inertia", 0.015),
        ("1.3*400 Nm/rad", "stiffness", 520.0),
        ("84 g", "mass", 0.084),
        ("52 mm", "length", 0.052),
        ("2.5kNm/rad", "stiffness", 2500.0),
        ("(1 + 2)/4 rad/kNm", "compliance", 0.00075),
        ("3.2*N*m*s/rad", "damping", 3.2),
    ],
)
def test_decimal_units_are_exact(text: str, measure: Measure, number: float) -> None:
    assert measured(text, measure) == number


IN = {
    measure: f"expected {with_article(measure)} in {unit}, bare or with its unit"
    for measure, unit in UNIT_OF.items()
}


@pytest.mark.parametrize(
    ("text", "measure", "said"),
    [
        ("3 rpm", "inertia", "; this is a speed"),
        ("3 N*m", "inertia", "; this is a torque"),
        ("3 kW", "damping", "; this is a power"),
        ("3 kg", "inertia", "; this is a mass"),
        ("3 lb", "length", "; this is a force"),
        ("3 kg*m^2", "mass", "; this is an inertia"),
        ("3 m", "mass", "; this is a length"),
        ("3 N*m", "stiffness", "; this is a torque"),
        ("3 rad/(N*m)", "stiffness", "; this is a compliance"),
        ("3 N*m/rad", "compliance", "; this is a stiffness"),
        ("3 N*m/rad", "damping", "; this is a stiffness"),
        ("3 N*m*s/rad", "stiffness", "; this is a damping"),
        ("3 N*ms/rad", "time", "; this is a damping"),
        ("3 bar", "area", "; this is a pressure"),
        ("3 km/h", "time", "; this is a velocity"),
        ("0,15", "inertia", " (with a decimal point)"),
        ("0,15 kg*m^2", "inertia", " (with a decimal point)"),
        ("heavy", "inertia", ""),
        ("nan", "mass", ""),
        (".inf", "length", ""),
        ("", "inertia", ""),
        ("3 furlong", "length", ""),
        ("3 Hz", "si_speed", "; did you mean `rev/s` or `rad/s`?"),
        ("3 nm", "si_torque", "; did you mean `N*m`?"),
        ("3 Nm/rad^", "stiffness", ""),
        ("3 kg*m^5", "inertia", ""),
        ("3 kg*m^2^2", "inertia", ""),
        ("3 (kg*m^2", "inertia", ""),
        ("3 kg)*m^2", "inertia", ""),
        ("3 kg//m^2", "inertia", ""),
        ("3 " + "kg*m^2/kg*" * 10 + "kg", "inertia", ""),
    ],
)
def test_another_unit_is_refused_with_what_it_is(text: str, measure: Measure, said: str) -> None:
    with pytest.raises(ValueError, match=re.escape(IN[measure]) + re.escape(said) + "$"):
        measured(text, measure)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("1e308 kN*m/rad", "expected a stiffness that is smaller"),
        ("1e999", "expected a smaller number"),
        ("1e308*10 N*m/rad", "expected a smaller number"),
    ],
)
def test_what_overflows_is_refused(text: str, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        measured(text, "stiffness")


@given(st.floats(allow_nan=False, allow_infinity=False), st.sampled_from(list(UNIT_OF)))
def test_any_number_is_read_to_the_last_bit(number: float, measure: Measure) -> None:
    assert measured(repr(number), measure) == number
    assert measured(f"{number!r} {UNIT_OF[measure]}", measure) == number


@given(st.text(max_size=60), st.sampled_from(list(UNIT_OF)))
def test_any_text_is_a_number_or_refused(text: str, measure: Measure) -> None:
    try:
        assert math.isfinite(measured(f"3 {text}", measure))
    except ValueError as error:
        assert str(error).startswith("expected ")  # noqa: PT017 - either may be
