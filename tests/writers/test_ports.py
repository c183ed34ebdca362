"""Ports in JSON: relative numbers, and with a load those in its units."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from vstatics import Gear, Load, Mechanism, Transmission, solve
from vstatics.tables.ports import port_tables
from vstatics.writers.ports import port_document

PAIR = Mechanism(1, 2, 0, -4.0, 0.98)
BARE = Transmission(2, [], [PAIR], [Gear()], link_names=["engine", "shaft"])


def test_plain_data_have_both() -> None:
    [table] = port_tables(solve(replace(BARE, load=Load(2000.0, 100.0))))
    engine, shaft = port_document(table)["ports"]
    assert (engine["link"], engine["way"], engine["output"]) == ("engine", "in", False)
    assert (shaft["torque"], shaft["torque_Nm"]) == pytest.approx((-3.92, -392))
    assert shaft["power_kW"] == pytest.approx(0.98 * 2000 * 100 * math.pi / 30000)
    [bare] = port_tables(solve(BARE))
    assert "power_kW" not in port_document(bare)["ports"][0]
