"""Dampings from decrements: table 2.4 of the book, round trips; П2.1 is for `test_measured`."""

import math
from typing import NamedTuple

import pytest

from tests.torsion.book import table
from vstatics.torsion.vibration.decrements import dampings, decrement, decrements


class Gear(NamedTuple):
    """A gear of table 2.4, as its file has it."""

    ratio: float
    decrement: float
    compliances: list[float]
    parts: list[float | None]
    products: list[float | None]


TABLE_2_4 = {gear: Gear(**of) for gear, of in table("table_2_4")["gears"].items()}
RATIOS = {"transmission": 1.0, "axle": 8.0, "tyres": 2.35}
PROPSHAFT, GEARBOX = 0.03, 0.10
"""Their decrements: the means of table П1.3, with which the columns of table 2.4 agree."""


@pytest.mark.parametrize("gear", TABLE_2_4)
def test_table_2_4(gear: str) -> None:
    """At 1 rad/s a damping is K omega, (П1.19), which on e times the compliance is K omega/e^2, (П1.27)."""
    given = TABLE_2_4[gear]
    _, box, propshaft, half_shafts, axle, tyres = given.compliances
    parts = {"transmission": math.fsum(given.compliances[:4]), "axle": axle, "tyres": tyres}
    whole = math.fsum(parts.values())
    first = given.decrement / decrement(RATIOS, {name: one / whole for name, one in parts.items()})
    made = {name: first * ratio for name, ratio in RATIOS.items()}
    by_part = dampings(made, parts, 1.0)
    at_half_shafts = by_part["transmission"] * (parts["transmission"] / half_shafts) ** 2
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


class Vehicle(NamedTuple):
    """A gear of table П2.1: one-link scheme, measured frequency, what follows."""

    inertias: list[float]
    compliance: float
    calculated: float | None
    measured: float
    corrected: float
    decrement: float
    damping: float | None


TABLE_P2_1 = {gear: Vehicle(**of) for gear, of in table("table_p2_1")["gears"].items()}


def test_decrements_come_back_from_dampings() -> None:
    given, compliances = {"shaft": 0.03, "damper": 0.2}, {"shaft": 1e-3, "damper": 8e-4}
    assert decrements(dampings(given, compliances, 80.0), compliances, 80.0) == pytest.approx(given)
