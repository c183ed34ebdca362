"""Schemes with the parameters of printed tables, which stand in the JSON files beside this one."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from tests.commands import json_file
from vstatics.torsion.clutch.dumped import DumpCase
from vstatics.torsion.clutch.given import Dump
from vstatics.torsion.reduction.chain import Chain, ChainSpring
from vstatics.torsion.reduction.scheme import SchemeSpring, TorsionScheme

TENTH = 0.1
"""A heading "J*10" means that a tenth of the printed number is J."""


def table(name: str) -> Any:
    return json_file(Path(__file__).parent / f"{name}.json")


def chain(inertias: Sequence[float], compliances: Sequence[float], unit: float = 1e-5) -> Chain:
    """A chain with inertias J*10 and compliances in a unit [rad/(N*m)]; masses 1, 2, ..."""
    names = tuple(str(number) for number, _ in enumerate(inertias, 1))
    springs = [
        ChainSpring(f"{number}-{number + 1}", compliance * unit)
        for number, compliance in enumerate(compliances, 1)
    ]
    return Chain(names, tuple(inertia * TENTH for inertia in inertias), tuple(springs))


def scheme(
    inertias: Sequence[float], springs: Sequence[Mapping[str, Any]], unit: float
) -> TorsionScheme:
    """A scheme with inertias [kg*m^2], and twists by numbers of masses from 1."""
    names = tuple(str(number) for number, _ in enumerate(inertias, 1))
    twists = [{int(mass) - 1: a for mass, a in spring["twist"].items()} for spring in springs]
    made = [
        SchemeSpring(f"s{number}", twist, spring["compliance"] * unit)
        for number, (twist, spring) in enumerate(zip(twists, springs, strict=True), 1)
    ]
    return TorsionScheme(names, tuple(inertias), tuple(made))


def percent(found: float, printed: float) -> float:
    return abs(found / printed - 1) * 100


class Line(NamedTuple):
    """Line of tables 3.7 (given) and 3.8 (largest torques): Tsitovich, Algin, 1981."""

    vehicle: str
    gear: int
    case: DumpCase
    given: Dump
    torques: list[float | None]
    """Largest torque, torque at the input shaft, and both by the simplified formulas. [kN*m]"""
    integrated: float
    """Largest torque by an independent integration in time. [kN*m]"""


ROWS = table("table_3_8")["rows"]
TABLE_3_8 = [Line(**{**row, "given": Dump._make(map(float, row["given"]))}) for row in ROWS]
