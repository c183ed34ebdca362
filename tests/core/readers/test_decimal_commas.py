"""CSV of German and Russian spreadsheets says the same as that with commas and decimal points."""

import codecs
import csv
import io
import re
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from tests.installed import needs, skip_without
from vstatics.core.errors import ReadError
from vstatics.core.model.shape import Measure
from vstatics.core.model.transmission import Gear, Mechanism, Transmission
from vstatics.core.readers.named.point_files import points_of
from vstatics.core.readers.records import read_record

CASE = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
WANTED: dict[str, Measure | None] = {"time": "time", "torques[shaft]": "si_torque"}


def _in_file(read: Callable[[str, str], object], data: bytes, folder: Path) -> object:
    (folder / "it.csv").write_bytes(data)
    return read(str(folder / "scenario.yaml"), "it.csv")


def annex(place: str) -> Any:
    """A function of an annex, whose tests are skipped where it is not installed."""
    skip_without(place.partition(".")[0])
    module, _, name = place.rpartition(".")
    return getattr(import_module(f"vstatics.{module}"), name)


Read = Callable[[bytes, Path], object]
FILES: dict[str, tuple[str, Read]] = {
    "drag": (
        "speed [1/min],torque [N*m]\n0,.5\n1500,2.25\n",
        lambda data, at: _in_file(lambda _, name: points_of(str(at / name)), data, at),
    ),
    "pedal": (
        "speed [rpm],.2,1\n0,10.5,50\n3000,-2e1,90.25\n",
        lambda data, at: _in_file(annex("simulation.scenario.table_files.table_of"), data, at),
    ),
    "record": (
        "time,torques[shaft] [kN*m]\n0,1.5\n.1,-2\n",
        lambda data, _: {
            n: c.tolist() for n, c in read_record(data, "r.csv", WANTED).columns.items()
        },
    ),
    "fuel": (
        "speed [rad/s],torque [N*m],fuel [g/h]\n100.5,0,360\n100.5,50,720.75\n",
        lambda data, _: annex("vehicle.operation.fuel_map.read_fuel_map")(
            data, "f.csv"
        ).fuel.tolist(),
    ),
    "trace": (
        'time [s],speed [km/h],gear,slope\n0,0,"1,5",0\n2.5,36.5,R,-.05\n',
        lambda data, _: [
            [*part] for part in annex("vehicle.operation.trace.read_trace")(data, "t.csv")[:5]
        ],
    ),
    "duty": (
        "time [s],gear,speed [1/min],torque [N*m]\n.5,1,2000,100.25\n",
        lambda data, _: annex("vehicle.duty_file.read_duty_table")(data, "d.csv", 3.0).table[:2],
    ),
    "orders": (
        "order,amplitude,phase [deg]\n.5,80.25,90\n4.5,20,0\n",
        lambda data, _: annex("torsion.forced.torque_table.read_torque_table")(data, "o.csv"),
    ),
    "variants": (
        "D1.efficiency,D1.ratio\n.96,-2.5\n.97,-97.5/39\n",
        lambda data, _: (
            annex("sweep.variants.table.read_table")(io.BytesIO(data), "v.csv", CASE)
            .block(0, 2)
            .tolist()
        ),
    ),
}
"""By name: a file as spreadsheets in English save it, and what reads it."""


def german(text: str, separator: str = ";") -> bytes:
    """As a spreadsheet saves it where a comma is the decimal sign, an empty row at its end."""
    rows = [
        [re.sub(r"\.(?=\d)", ",", cell) for cell in row] for row in csv.reader(text.splitlines())
    ]
    return "".join(f"{separator.join(row)}\r\n" for row in [*rows, [""] * len(rows[0])]).encode()


@pytest.mark.parametrize("name", FILES)
def test_semicolons_and_decimal_commas_say_the_same(name: str, tmp_path: Path) -> None:
    text, read = FILES[name]
    with_points = read(text.encode(), tmp_path)
    for separator in ";\t":
        assert read(german(text, separator), tmp_path) == with_points
        # two marks: github.com/plaintextaccounting/hledger/issues/2189
        assert read(2 * codecs.BOM_UTF8 + german(text, separator), tmp_path) == with_points
    cells = csv.reader(text.splitlines())
    assert read("\n".join(map("\t".join, cells)).encode(), tmp_path) == with_points
    for end in (",", ",,"):  # empty columns, and the first line of Excel
        assert read(text.replace("\n", f"{end}\n").encode(), tmp_path) == with_points
        longer = german(text).replace(b"\r\n", end.replace(",", ";").encode() + b"\r\n")
        assert read(longer, tmp_path) == with_points
        assert read(b"sep=;\r\n" + longer, tmp_path) == with_points


def _with_last(text: str, first: str) -> str:
    """A table with semicolons whose last row begins with another number."""
    *above, last, _, end = german(text).decode().split("\r\n")
    return "\n".join([*above, ";".join([first, *last.split(";")[1:]]), end])


@pytest.mark.parametrize("name", FILES)
def test_a_sign_that_may_stand_between_thousands_is_refused(name: str, tmp_path: Path) -> None:
    """A comma between tabs, a point between semicolons, with other decimal signs and without."""
    text, read = FILES[name]
    *above, last = ("\t".join(row) for row in csv.reader(text.splitlines()))
    comma = "\n".join([*above, "\t".join(["1,200", *last.split("\t")[1:]]), ""])
    point = _with_last(text, "1.200")
    signs = "with decimal commas but {} with decimal points; write"
    of_comma = f"read '1,200', 1.2 {signs.format(1200)} 1.2"
    of_point = f"read '1.200', 1200 {signs.format('1.2')} 1200 or 1"
    for data, said in (
        (comma, of_comma),
        (re.sub(r"\.(?=\d)", "", comma), of_comma),
        (point, of_point),
        (point.replace(",", ""), of_point),
    ):
        line = text.count("\n")
        with pytest.raises((ReadError, ValueError), match=f"(line |:){line}:.*{said}"):
            read(data.encode(), tmp_path)


@pytest.mark.parametrize("name", sorted(FILES.keys() - {"fuel", "trace"}))
def test_a_point_between_semicolons_is_a_decimal_one_where_others_can_be_nothing_else(
    name: str, tmp_path: Path
) -> None:
    text, read = FILES[name]
    points = _with_last(text, "1.200").replace(",", ".")
    commas = _with_last(text, "1,200")
    assert read(points.encode(), tmp_path) == read(commas.encode(), tmp_path)


@pytest.mark.parametrize("name", sorted(FILES.keys() - {"pedal"}))
def test_decimal_commas_between_commas_are_refused(name: str, tmp_path: Path) -> None:
    text, read = FILES[name]
    with pytest.raises((ReadError, ValueError), match="semicolons have to separate the cells"):
        read(german(text, ","), tmp_path)


@pytest.mark.parametrize("name", sorted(FILES.keys() - {"duty", "fuel", "pedal", "trace"}))
def test_grouped_digits_with_a_decimal_comma_are_refused(name: str, tmp_path: Path) -> None:
    """Source: github.com/pandas-dev/pandas/issues/59299."""
    text, read = FILES[name]
    with pytest.raises((ReadError, ValueError), match=r"digits without `.`: 1234\.56"):
        read(_with_last(text, "1.234,56").encode(), tmp_path)


@needs("vehicle")
def test_numbers_as_in_print_are_refused_with_what_is_meant() -> None:
    trace = 'time [s],speed [km/h]\n0,\u22120\n10,"36,5"\n'
    with pytest.raises(ReadError) as caught:
        annex("vehicle.operation.trace.read_trace")(trace.encode(), "t.csv")
    minus, comma = map(str, caught.value.problems)
    assert "t.csv:2:1: error: speed: read '\u22120', expected a finite number (with `-`" in minus
    assert "t.csv:3:1: error: speed: read '36,5', expected a finite number (with a dec" in comma
