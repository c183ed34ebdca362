"""The table of ports: names, units, losses."""

import math
from typing import Any

import pytest

from tests.shipped import shipped_results
from vstatics import Gear, Load, Mechanism, ShiftElement, Transmission, solve
from vstatics.core.tables.answer import plain_data
from vstatics.core.tables.ports import port_tables, ports_grid

PAIR = Mechanism(1, 2, 0, -4.0, 0.98)


def pair(*gears: Gear, **given: Any) -> Transmission:
    return Transmission(2, [], [PAIR], gears, link_names=["engine", "shaft"], **given)


def test_physical_where_all_gears_have_a_load_else_relative() -> None:
    """100 N*m at 2000 rpm are 2000 pi/30 * 100 W = 20.944 kW; the pair keeps .98 of it."""
    load = Load(2000.0, 100.0)
    both = port_tables(solve(pair(Gear(), load=load)))
    assert ports_grid(both).texts == [
        ["1", "engine", "2000.0", "100.0", "20.944", "in"],
        ["1", "shaft", "-500.0", "-392.0", "20.525", "out"],
        ["1", "lost: meshes", "", "", "0.419", ""],
    ]
    one = port_tables(solve(pair(Gear(load=load), Gear())))
    assert ports_grid(one).columns[2].heading == "speed"
    assert ports_grid(one[:1]).columns[2].heading == "speed, rpm"


def test_drag_and_meshes_are_lost_apart_and_together() -> None:
    [table] = port_tables(solve(pair(Gear(drag={1: 0.1}))))
    assert [name for name, _ in table.losses] == ["meshes", "drag", "meshes and drag"]
    lost = dict(table.losses)
    # .9 of the torque enters the pair, which loses 2 % of it
    assert lost == pytest.approx({"meshes": 0.018, "drag": 0.1, "meshes and drag": 0.118})


def test_no_power_comes_from_nowhere() -> None:
    """Into neutral none enters; from a freewheel that overruns none comes, nor from a lock."""
    elements = [ShiftElement(2, 3, "F", kind="freewheel"), ShiftElement(2, 3, "C")]
    gears, pair = [Gear([2], name="1"), Gear(name="F")], [Mechanism(1, 2, 0, 2.0)]
    for torque, ways in ((100.0, ["in", "out"]), (-100.0, ["out", "in"])):
        case = Transmission(3, elements, pair, gears, load=Load(2000.0, torque))
        [held, free] = port_tables(solve(case))
        assert [port.way for _, port in held.rows] == ways
        overruns = torque > 0  # its first link runs behind its second one there
        assert any(port.way for _, port in free.rows) != overruns
        [neutral] = port_tables(solve(case.replace(shift_elements=elements[1:], gears=gears[1:])))
        assert [math.isnan(port.torque) for _, port in neutral.rows] == [True, True]
    [drive, driven] = port_tables(shipped_results("self-locking.yaml", coast=True))
    assert [port.way for _, port in drive.rows] == ["", ""]
    assert {port.way for _, port in driven.rows} == {"in", "out"}


def test_slip_of_a_converter_and_losses_of_a_variator_are_not_those_of_meshes() -> None:
    """The converter passes .4 * 1.5 = .6, the set .98 of it, the variator .9 of that.

    The set stands on its carrier: it is a pair.
    """
    parts = [
        Mechanism(1, 2, 0, 0.4, name="TC", kind="converter", points=((0.4, 1.5),)),
        Mechanism(2, 3, 0, -4.0, 0.98),
        Mechanism(3, 4, 0, 0.5, 0.9, name="belt", kind="variator"),
    ]
    [table] = port_tables(solve(Transmission(4, [], parts, [Gear()])))
    lost = {"meshes": 0.6 * 0.02, "converters": 0.4, "variators": 0.6 * 0.98 * 0.1}
    assert dict(table.losses) == pytest.approx({**lost, "all together": sum(lost.values())})
    [alone] = port_tables(solve(Transmission(2, [], [parts[0]], [Gear()])))
    assert dict(alone.losses) == pytest.approx({"converters": 0.4})


def test_plain_data_have_both() -> None:
    [table] = port_tables(solve(pair(Gear(), load=Load(2000.0, 100.0))))
    engine, shaft = plain_data(table)["ports"]
    assert (engine["link"], engine["way"], engine["output"]) == ("engine", "in", False)
    assert (shaft["torque"], shaft["torque_Nm"]) == pytest.approx((-3.92, -392))
    assert shaft["power_kW"] == pytest.approx(0.98 * 2000 * 100 * math.pi / 30000)
    [bare] = port_tables(solve(pair(Gear())))
    assert "power_kW" not in plain_data(bare)["ports"][0]
