"""CSV of German and Russian spreadsheets says the same as that with commas and decimal points."""

from __future__ import annotations

import codecs
import csv
import io
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.installed import needs
from vstatics.core.errors import ReadError
from vstatics.core.model.transmission import Gear, Mechanism, Transmission
from vstatics.core.readers.named.point_files import points_of
from vstatics.core.readers.records import read_record

CASE = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])


def _drag(data: bytes, folder: Path) -> object:
    (folder / "drag.csv").write_bytes(data)
    return points_of(str(folder / "drag.csv"))


def _pedal(data: bytes, folder: Path) -> object:
    from vstatics.simulation.scenario.table_files import table_of

    (folder / "pedal.csv").write_bytes(data)
    return table_of(str(folder / "scenario.yaml"), "pedal.csv")


def _record(data: bytes, _: Path) -> object:
    read = read_record(data, "r.csv", {"time": "time", "torques[shaft]": "si_torque"})
    return {name: column.tolist() for name, column in read.columns.items()}


def _fuel(data: bytes, _: Path) -> object:
    from vstatics.vehicle.operation.fuel_map import read_fuel_map

    return read_fuel_map(data, "f.csv").fuel.tolist()


def _trace(data: bytes, _: Path) -> object:
    from vstatics.vehicle.operation.trace import read_trace

    read = read_trace(data, "t.csv")
    return read.duration.tolist(), read.speed.tolist(), read.slope.tolist(), read.gears


def _duty(data: bytes, _: Path) -> object:
    from vstatics.vehicle.duty_file import read_duty_table

    read = read_duty_table(data, "d.csv", 3.0).table
    return read.numbers, read.texts


def _orders(data: bytes, _: Path) -> object:
    from vstatics.torsion.forced.torque_table import read_torque_table

    return read_torque_table(data, "o.csv")


def _variants(data: bytes, _: Path) -> object:
    from vstatics.sweep.variants.table import read_table

    table = read_table(io.BytesIO(data), "v.csv", CASE)
    return [target.name for target in table.targets], table.block(0, 2).tolist()


Read = Callable[[bytes, Path], object]
ANNEX: dict[Read, str] = {
    _pedal: "simulation",
    _fuel: "vehicle",
    _trace: "vehicle",
    _duty: "vehicle",
    _orders: "torsion",
    _variants: "sweep",
}
"""The annex of each reader that is not of the core."""
FILES: list[tuple[Read, str]] = [
    (_drag, "speed [1/min],torque [N*m]\n0,.5\n1500,2.25\n"),
    (_pedal, "speed [rpm],.2,1\n0,10.5,50\n3000,-2e1,90.25\n"),
    (_record, "time,torques[shaft] [kN*m]\n0,1.5\n.1,-2\n"),
    (_fuel, "speed [rad/s],torque [N*m],fuel [g/h]\n100.5,0,360\n100.5,50,720.75\n"),
    (_trace, 'time [s],speed [km/h],gear,slope\n0,0,"1,5",0\n2.5,36.5,R,-.05\n'),
    (_duty, "time [s],gear,speed [1/min],torque [N*m]\n.5,1,2000,100.25\n"),
    (_orders, "order,amplitude,phase [deg]\n.5,80.25,90\n4.5,20,0\n"),
    (_variants, "D1.efficiency,D1.ratio\n.96,-2.5\n.97,-97.5/39\n"),
]


def files(*others: Read) -> list[Any]:
    """Return the readers that are installed, but some, with what they read."""
    return [
        pytest.param(read, text, marks=needs(*filter(None, [ANNEX.get(read)])))
        for read, text in FILES
        if read not in others
    ]


def german(text: str, separator: str = ";") -> bytes:
    """As a spreadsheet saves it where a comma is the decimal sign, an empty row at its end."""
    rows = [
        [re.sub(r"\.(?=\d)", ",", cell) for cell in row] for row in csv.reader(text.splitlines())
    ]
    return "".join(f"{separator.join(row)}\r\n" for row in [*rows, [""] * len(rows[0])]).encode()


@pytest.mark.parametrize(("read", "text"), files())
def test_semicolons_and_decimal_commas_say_the_same(read: Read, text: str, tmp_path: Path) -> None:
    with_points = read(text.encode(), tmp_path)
    for separator in ";\t":
        assert read(german(text, separator), tmp_path) == with_points
        assert read(codecs.BOM_UTF8 + german(text, separator), tmp_path) == with_points
    cells = csv.reader(text.splitlines())
    assert read("\n".join(map("\t".join, cells)).encode(), tmp_path) == with_points


def _with_last(text: str, first: str) -> str:
    """A table with semicolons whose last row begins with another number."""
    *above, last, _, end = german(text).decode().split("\r\n")
    return "\n".join([*above, ";".join([first, *last.split(";")[1:]]), end])


@pytest.mark.parametrize(("read", "text"), files())
def test_a_sign_that_may_stand_between_thousands_is_refused(
    read: Read, text: str, tmp_path: Path
) -> None:
    """A comma between tabs, a point between semicolons, with other decimal signs and without."""
    *above, last = ("\t".join(row) for row in csv.reader(text.splitlines()))
    comma = "\n".join([*above, "\t".join(["1,200", *last.split("\t")[1:]]), ""])
    point = _with_last(text, "1.200")
    signs = "with decimal commas but {} with decimal points; write"
    of_point = f"read '1.200', 1200 {signs.format('1.2')} 1200 or 1"
    for data, said in (
        (comma, f"read '1,200', 1.2 {signs.format(1200)} 1.2"),
        (point, of_point),
        (point.replace(",", ""), of_point),
    ):
        line = text.count("\n")
        with pytest.raises((ReadError, ValueError), match=f"(line |:){line}:.*{said}"):
            read(data.encode(), tmp_path)


@pytest.mark.parametrize(("read", "text"), files(_fuel, _trace))
def test_a_point_between_semicolons_is_a_decimal_one_where_others_can_be_nothing_else(
    read: Read, text: str, tmp_path: Path
) -> None:
    points = _with_last(text, "1.200").replace(",", ".")
    commas = _with_last(text, "1,200")
    assert read(points.encode(), tmp_path) == read(commas.encode(), tmp_path)


@pytest.mark.parametrize(("read", "text"), files())
def test_what_spreadsheets_add_to_a_table_says_nothing(
    read: Read, text: str, tmp_path: Path
) -> None:
    expected = read(text.encode(), tmp_path)
    for end in (",", ",,"):
        assert read(text.replace("\n", f"{end}\n").encode(), tmp_path) == expected
        longer = german(text).replace(b"\r\n", end.replace(",", ";").encode() + b"\r\n")
        assert read(longer, tmp_path) == expected
        assert read(b"sep=;\r\n" + longer, tmp_path) == expected


@pytest.mark.parametrize(("read", "text"), files(_pedal))
def test_decimal_commas_between_commas_are_refused(read: Read, text: str, tmp_path: Path) -> None:
    with pytest.raises((ReadError, ValueError), match="semicolons have to separate the cells"):
        read(german(text, ","), tmp_path)


@needs("vehicle")
def test_numbers_as_in_print_are_refused_with_what_is_meant() -> None:
    from vstatics.vehicle.operation.trace import read_trace

    trace = 'time [s],speed [km/h]\n0,\u22120\n10,"36,5"\n'
    with pytest.raises(ReadError) as caught:
        read_trace(trace.encode(), "t.csv")
    minus, comma = map(str, caught.value.problems)
    assert "t.csv:2:1: error: speed: read '\u22120', expected a finite number (with `-`" in minus
    assert "t.csv:3:1: error: speed: read '36,5', expected a finite number (with a dec" in comma
