"""Dampings from decrements: table 2.4 of the book, round trips; П2.1 is for `test_measured`."""

import math
from typing import NamedTuple

import pytest

from vstatics.torsion.vibration.decrements import (
    dampings,
    decrement,
    decrements,
    divided,
    dry_friction,
    moved,
)  # fmt: skip


class Gear(NamedTuple):
    """A gear of table 2.4: what is given, and K omega in N*m on the input shaft."""

    ratio: float
    decrement: float
    compliances: tuple[float, ...]
    """Input shaft with damper, gearbox, propshaft, half-shafts, axle, tyres; from table 2.2."""
    parts: tuple[float | None, ...]
    """Printed decrements of transmission, axle, tyres."""
    products: tuple[float | None, ...]
    """Printed K omega of transmission, axle, tyres; half-shafts, propshaft, gearbox."""


TABLE_2_4 = {
    "I": Gear(
        3.49, 0.681, (84e-5, 167e-5, 50e-5, 1476e-5, 1525e-5, 211e-5), (0.165, 1.32, 0.388),
        (2.97, 27.5, 58.6, 4.3, 19.1, None),
    ),
    "II": Gear(
        2.04, 0.695, (84e-5, 62.4e-5, 17.1e-5, 503e-5, 520e-5, 72e-5), (0.175, 1.4, 0.412),
        (8.36, 86, None, None, 55.8, 51),
    ),
    "III": Gear(
        1.33, 0.665, (84e-5, 28.3e-5, 7.25e-5, 214e-5, 221e-5, 30.6e-5), (0.178, 1.43, None),
        (None, 206, None, None, 132, 113),
    ),
    "IV": Gear(
        1.0, 0.554, (84e-5, 17.7e-5, 4.1e-5, 121e-5, 125e-5, 17.3e-5), (0.161, 1.29, 0.38),
        (22.6, 329, 700, 79, None, 180),
    ),
}  # fmt: skip
"""Tsitovich, Algin, Vehicle dynamics (1981), Москвич-412. None stands for print that its own
formulas do not give: I, gearbox 16.1 (they give 19.1); II, tyres 240 (182), half-shafts 19.4
(14.7); III, decrement of tyres .41 (.421), transmission 18 (17.1), tyres 427 (438), half-shafts
43.6 (41.5); IV, propshaft 238 (233)."""
RATIOS = {"transmission": 1.0, "axle": 8.0, "tyres": 2.35}
PROPSHAFT, GEARBOX = 0.03, 0.10
"""Their decrements: the means of table П1.3, with which the columns of table 2.4 agree."""


@pytest.mark.parametrize("gear", TABLE_2_4)
def test_table_2_4(gear: str) -> None:
    """At 1 rad/s a damping is K omega."""
    given = TABLE_2_4[gear]
    _, box, propshaft, half_shafts, axle, tyres = given.compliances
    parts = {"transmission": math.fsum(given.compliances[:4]), "axle": axle, "tyres": tyres}
    whole = math.fsum(parts.values())
    made = divided(given.decrement, {name: one / whole for name, one in parts.items()}, RATIOS)
    by_part = dampings(made, parts, 1.0)
    at_half_shafts = moved(by_part["transmission"], parts["transmission"], half_shafts)
    single = dampings(
        {"propshaft": PROPSHAFT, "box": GEARBOX}, {"propshaft": propshaft, "box": box}, 1.0
    )
    products = [*by_part.values(), at_half_shafts, single["propshaft"], single["box"]]
    for calculated, printed in (
        *zip(made.values(), given.parts, strict=True),
        *zip(products, given.products, strict=True),
    ):
        if printed is not None:
            assert calculated == pytest.approx(printed, rel=1e-2)


def test_the_clutch_damper_of_table_2_4() -> None:
    """M_T = 14, M_3 = 100 N*m, E = 75.8e-5; at the input shaft E1 = 84e-5: 235 and 193 N*m."""
    product = dry_friction(14, 100, 75.8e-5)
    assert product == pytest.approx(235, rel=2e-3)
    assert moved(product, 75.8e-5, 84e-5) == pytest.approx(193, rel=1e-2)


class Vehicle(NamedTuple):
    """A gear of table П2.1: one-link scheme, measured frequency, what follows."""

    inertias: tuple[float, float, float]
    compliance: float
    calculated: float | None
    measured: float
    corrected: float
    decrement: float
    damping: float | None


TABLE_P2_1 = {
    "I": Vehicle((0.136, 0.0061, 0.41), 0.0439, 14.7, 12.8, 0.058, 0.71, None),
    "II": Vehicle((0.136, 0.0076, 1.09), 0.0165, 21.8, 18.8, 0.022, 0.94, 0.715),
    "III": Vehicle((0.136, 0.0105, 2.60), 0.00699, 32.1, 27.4, 0.0096, 1.06, 1.28),
    "IV": Vehicle((0.136, 0.0172, 5.77), 0.00312, None, 39.2, 0.0043, 0.95, None),
}
"""Tsitovich, Algin, Vehicle dynamics (1981), ВАЗ-2101. None stands for print that its own
formulas do not give: damping .313 (they give .305) in gear I, frequency 48.3 (46.3) and damping
1.67 (1.77) in gear IV."""


def test_decrements_come_back_from_dampings() -> None:
    given, compliances = {"shaft": 0.03, "damper": 0.2}, {"shaft": 1e-3, "damper": 8e-4}
    assert decrements(dampings(given, compliances, 80.0), compliances, 80.0) == pytest.approx(given)


def test_parts_of_a_decrement_add_to_it() -> None:
    shares = {"a": 0.5, "b": 0.3, "c": 0.2}
    made = divided(0.7, shares, {"a": 1.0, "b": 8.0, "c": 2.35})
    assert decrement(made, shares) == pytest.approx(0.7)
    assert divided(0.7, shares, dict.fromkeys(shares, 1.0)) == pytest.approx(
        dict.fromkeys(shares, 0.7)
    )
