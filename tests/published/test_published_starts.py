"""Starts by dumping the clutch, against what is printed and against other integrations.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (in Russian), Minsk 1981: tables 3.8,
3.9 and 3.11; tests/published/tsitovich-table-3-9.json says what was repaired.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.simulation.boxes import held
from tests.simulation.test_golden import closes
from tests.torsion.table_3_8 import TABLE_3_8, Line
from vstatics.model.springs import Spring, Twist, between
from vstatics.model.transmission import Gear, ShiftElement, Transmission
from vstatics.simulation import simulate
from vstatics.simulation.formula import Formula
from vstatics.simulation.motion import Motion
from vstatics.simulation.scenario import Capacity, Scenario, Start

PUBLISHED = Path(__file__).with_name("tsitovich-table-3-9.json")
TABLE_3_9: dict[str, Any] = json.loads(PUBLISHED.read_text(encoding="utf-8"))


def one_spring(line: Line) -> Scenario:
    """The scheme of table 3.8: clutch, one spring, grip; the clutch slips with 0.8 M_C0."""
    j1, j2, j3, j4, j5, compliance, clutch, grip, speed = line.given[:9]
    case = Transmission(
        4,
        [ShiftElement(1, 2, "clutch", static=1.25), ShiftElement(3, 4, "grip")],
        [],
        [Gear()],
        inertias={1: j1, 2: j2 + j3, 3: j4, 4: j5},
        springs=[Spring(between(2, 3), compliance=compliance)],
    )
    start = Start(speeds={1: speed, 2: 0.0, 3: 0.0, 4: 0.0}, engaged=(2,))
    # until the spring has swung back
    return Scenario(case, 0.25, start, {1: held(0.8 * clutch), 2: held(grip)})


@pytest.mark.parametrize("line", TABLE_3_8, ids=lambda line: f"{line.vehicle} {line.gear}")
def test_one_spring(line: Line) -> None:
    """A case that slips throughout has the printed torque; others what another program found."""
    motion = simulate(one_spring(line))
    assert closes(motion)
    if line.case.startswith("A"):
        found = motion.peaks["S1"].torque / 1000
        assert found == pytest.approx(line.integrated, rel=1.5e-3)


def reduced_chain(row: dict[str, Any]) -> Scenario:
    """Six links with the reaction of the axle; links: engine, disc, box ... vehicle."""
    clutch, grip, speed, rate, duration = (
        row["params"][key] for key in ("MC0", "Mphi", "w0", "K", "T")
    )
    twists: list[Twist | dict[int, float]] = [
        between(2, 3),
        between(3, 4),
        between(4, 5),
        {5: 1, 7: -1, 6: -1},
        between(6),
    ]
    twists.append(between(7, 8))
    scheme = TABLE_3_9["scheme"]
    parts = zip(twists, scheme["E"], scheme["K"], scheme["springs"], strict=True)
    case = Transmission(
        8,
        [ShiftElement(1, 2, "clutch", static=1.25)],
        [],
        [Gear()],
        inertias=dict(enumerate(scheme["J"], 1)),
        springs=[
            Spring(twist, None, compliance, damping, name, grip if name == "tyres" else None)
            for twist, compliance, damping, name in parts
        ],
    )
    control = Capacity(Formula(f"0.8*{clutch}*(1 - exp(-{rate}*t))"))
    start = Start(speeds={1: speed} | dict.fromkeys(range(2, 9), 0.0))
    return Scenario(case, duration, start, {1: control})


def of_table_3_9(row: dict[str, Any]) -> dict[str, float]:
    """What the table prints of a start."""
    motion = simulate(reduced_chain(row))
    assert closes(motion)
    shaft = motion.peaks["input shaft"]
    return {
        "M_PV": shaft.torque,
        "t_PV": shaft.time,
        "Y_po": motion.peaks["half-shafts"].torque,
        "A_B": motion.energy.heat["clutch"],
    } | _locked(motion)


def _locked(motion: Motion) -> dict[str, float]:
    times = [one.time for one in motion.events if (one.element, one.event) == ("clutch", "locks")]
    return {"t_B": times[0]} if times else {}


@pytest.mark.slow
@pytest.mark.parametrize("row", TABLE_3_9["cases"], ids=lambda row: row["variant"])
def test_moskvich_starts(row: dict[str, Any]) -> None:
    """Friction work to 1.5 %, slow engagement to 3 %, fast to 7.5 %, times to 12 %."""
    found = of_table_3_9(row)
    torque = 0.03 if row["params"]["K"] <= 30 else 0.075
    tolerances = {"A_B": 0.015, "M_PV": torque, "Y_po": torque, "t_PV": 0.12, "t_B": 0.12}
    for name, printed in row["published"].items():
        assert found[name] == pytest.approx(printed, rel=tolerances[name]), name
