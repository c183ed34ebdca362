"""`vstatics torsion response`: orders, speeds, tables of torque, what is shown of them."""

import csv
import io
import math
from pathlib import Path

import numpy as np
import openpyxl
import pytest

from tests.torsion.cli.torsional import GOOD, document, said
from vstatics import loads
from vstatics.torsion.forced.harmonic_torques import Harmonic, response

AT = ("--at", "engine")
SPEED = ("--speed", "600:1000:5")
TABLE = "order,amplitude,phase [deg]\n2,80,0\n4,25,90\n6,8,-45\n"
MASS = """\
links: [mass]
inertias: {mass: 0.5}
springs: {mount: {links: [mass, housing], stiffness: 800}}
output: mass
"""
"""It is hit at 40 rad/s."""
HIT = 40 * 30 / math.pi
OF_MASS = ("response", "--at", "mass", "--orders", "1", "--speed")
CSV = ["table", "gear", "order", "mode", "speed", "row", "value"]


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    (folder / "engine.csv").write_text(TABLE, "utf-8")


def test_json_has_what_the_library_has() -> None:
    speeds = [600.0, 700.0, 800.0, 900.0, 1000.0]
    six = Harmonic(6.0, 8.0, -math.pi / 4)
    two, four = Harmonic(2.0, 80.0), Harmonic(4.0, 25.0, math.pi / 2)
    table = ("--torque", "engine.csv", "--sum")
    for options, harmonics in (
        (("--orders", "2,4.5"), [Harmonic(2.0), Harmonic(4.5)]),
        (table, [two, four, six]), ((*table, "--orders", "4,2,4"), [four, two]),
    ):  # fmt: skip
        made = document("response", *AT, *options, *SPEED, text=GOOD)
        [found], [expected] = made["gears"], response(loads(GOOD), "engine", harmonics, speeds)
        assert (made["at"], found["speeds"]) == ("engine", expected.speeds.tolist())
        assert set(found["speeds"]) == {*speeds, *(one["speed"] for one in found["resonances"])}
        assert found["resonances"] == [one._asdict() for one in expected.resonances]
        for told, one in zip(found["orders"], expected.orders, strict=True):
            assert told["order"] == one.order
            for key in ("amplitudes", "torques"):
                sizes = {name: np.abs(own).tolist() for name, own in getattr(one, key).items()}
                assert told[key] == sizes
        total = expected.with_sum().sum
        assert total is not None
        assert ("sum" in found) == ("--sum" in options)
        for part in ("largest", "rms") if "sum" in found else ():
            own = getattr(total.amplitudes["disc"], part).tolist()
            assert found["sum"]["amplitudes"]["disc"][part] == own


def test_speeds_are_a_range_or_a_list_and_may_fall() -> None:
    def speeds(written: str) -> list[float]:
        made = document("response", *AT, "--orders", "2", "--speed", written, text=GOOD)
        told: list[float] = made["gears"][0]["speeds"]
        return told

    [peak] = set(speeds("600:1000:3")) - {600.0, 800.0, 1000.0}
    assert speeds("600:1000:3") == [600.0, peak, 800.0, 1000.0]
    assert speeds("1000:600:3") == [1000.0, 800.0, peak, 600.0]
    assert speeds("600, 650.5,6e2") == [600.0, 650.5, 600.0]
    assert speeds("0:0:2") == [0.0, 0.0]
    assert speeds("600 1/min:1000 1/min:3") == speeds("600:1000:3")
    assert speeds("10 rev/s") == [600.0]


def test_without_orders_the_cylinders_fire() -> None:
    """In a four-stroke engine of 6 cylinders, 3 fire per revolution."""
    text = f"{GOOD}cylinders: 6\n"
    fires = document("response", *SPEED, text=text)
    assert fires == document("response", "--orders", "3", *SPEED, text=text)
    assert said("response", *AT, *SPEED, text=text).is_wrong_use("expected --orders")


def test_csv_is_one_table_with_a_line_for_each_value() -> None:
    call = ("response", *AT, "--orders", "2,4.5", *SPEED, "--sum")
    [gear] = document(*call, text=GOOD)["gears"]
    heading, *rows = csv.reader(io.StringIO(said(*call, "-f", "csv", text=GOOD).out))
    assert heading == CSV
    found = {tuple(row[:6]): row[6] for row in rows}
    assert len(found) == len(rows)
    expected = {
        ("resonance", "direct", str(one["order"]), str(one["mode"]), "", ""): one["speed"]
        for one in gear["resonances"]
    }
    for table, key in (("amplitude", "amplitudes"), ("torque", "torques")):
        for place, speed in enumerate(gear["speeds"]):
            for order in gear["orders"]:
                for row, values in order[key].items():
                    at = (table, "direct", str(order["order"]), "", str(speed), row)
                    expected[at] = values[place]
            for part in ("largest", "rms"):
                for row, values in gear["sum"][key].items():
                    at = (f"{table} {part}", "direct", "", "", str(speed), row)
                    expected[at] = values[part][place]
    assert found == {at: repr(value) for at, value in expected.items()}


def test_text_shows_what_is_largest_and_xlsx_every_speed() -> None:
    call = ("response", *AT, "--orders", "2,4", *SPEED, "--sum")
    text = said(*call, text=GOOD).out
    assert "Gear direct: largest torques of components [N*m]\n" in text
    assert "Gear direct, all orders: torques of components [N*m]\n" in text
    assert said(*call, "-o", "new.xlsx", text=GOOD).status == 0
    book = openpyxl.load_workbook("new.xlsx")
    told = document(*call, text=GOOD)["gears"][0]
    cells = [cell for sheet in book for row in sheet.values for cell in row]
    numbers = {f"{cell:.9g}" for cell in cells if isinstance(cell, float)}
    assert {f"{one:.9g}" for one in told["orders"][1]["torques"]["damper"]} <= numbers
    assert f"{max(told['sum']['torques']['damper']['rms']):.9g}" in numbers


def test_a_torque_that_is_zero_in_neutral_is_largest_at_no_speed() -> None:
    text = said("response", "--gear", "N", *AT, "--orders", "2", *SPEED).out
    assert " P 0.0000 - " in " ".join(text.split())


def test_a_resonance_that_nothing_damps_has_no_bound_and_is_reported() -> None:
    call, damped = OF_MASS, MASS.replace("stiffness: 800", "stiffness: 800, damping: {ratio: 0.01}")
    told = said(*call, "100:400:4", text=MASS).err
    assert f"note: gear 1: nothing damps the resonance at {HIT:.6g} rpm" in told
    for text in (MASS, damped):
        [gear] = document(*call, "100:400:4", text=text)["gears"]
        assert gear["resonances"][0]["damped"] == (text is damped)
    assert said(*call, "100:400:4", text=damped).err == ""
    assert "Resonances: none at these speeds\n" in said(*call, "1000", text=MASS).out


def test_an_undamped_system_that_is_hit_exactly_has_null() -> None:
    call = OF_MASS
    [gear] = document(*call, f"{HIT!r},100", "--sum", text=MASS)["gears"]
    [order] = gear["orders"]
    assert order["amplitudes"]["mass"][0] is order["torques"]["mount"][0] is None
    assert gear["sum"]["torques"]["mount"]["largest"][0] is None
    assert order["amplitudes"]["mass"][1] is not None
    only_hit = said(*call, repr(HIT), text=MASS)
    assert (only_hit.status, "mass        -           -\n" in only_hit.out) == (0, True)
    heading = "Resonances\ngear  order  mode  speed [rpm]  participation\n"
    assert f"{heading}1         1     1        382.0          1.000\n" in only_hit.out
    rows = csv.reader(io.StringIO(said(*call, repr(HIT), "-f", "csv", text=MASS).out))
    _, resonance, *others = rows
    assert resonance[:4] == ["resonance", "1", "1.0", "1"]
    assert [row[-1] for row in others] == ["", ""]


def test_a_fault_of_a_table_is_reported_at_its_line_and_writes_nothing() -> None:
    call = ("response", *AT, "--torque", "engine.csv", *SPEED, "-o", "new.csv")
    Path("engine.csv").write_text("order,amplitude\n2,1 kN*m\n", "utf-8")
    answer = said(*call, text=GOOD)
    assert answer.gives_nothing("engine.csv:2:1: error: amplitude: read '1 kN*m'")
    Path("engine.csv").write_bytes(b"\xff\xfe\0order")
    assert said(*call, text=GOOD).gives_nothing("engine.csv:")
    assert not Path("new.csv").exists()


def test_the_table_is_not_written_over_and_case_and_table_can_not_both_be_stdin() -> None:
    call = ("response", *AT, "--torque", "engine.csv", *SPEED)
    assert said(*call, "-o", "engine.csv", text=GOOD).status == 2
    assert Path("engine.csv").read_text("utf-8") == TABLE
    answer = said("response", *AT, "--torque", "-", *SPEED, text=GOOD)
    assert answer.is_wrong_use("standard input (-) can be read only once")
    answer = said(*call, "--orders", "2,3", text=GOOD)
    assert answer.is_wrong_use("engine.csv has no order 3; it has 2, 4, 6")


WRONG = {
    "--orders": ("", "0", "-2", "nan", "inf", "x", "2,", ",2", "2,,4", "2;4", "1:3:3"),
    "--speed": (
        "", "-1", "nan", "inf", "x", "600,", "600:1000", "600:1000:5:2", "::", "a:b:5", "-5:10:3",
        "1:nan:3", "1:inf:3", "1:2:0", "1:2:1", "1:2:-3", "1:2:2.5", "1:2:nan", "1:2:", "1:2:1e3",
        "1:2:999999999999", "1:2:100001", "1:2:٣", "1 kg", "1 rpm,2 Hz",
    ),
    "--at": ("", "nobody", "housing"),
}  # fmt: skip


@pytest.mark.parametrize("option", WRONG)
def test_wrong_use(option: str) -> None:
    right = {"--at": "engine", "--orders": "2", "--speed": "600:1000:5"}
    for one in WRONG[option]:
        words = [word for pair in {**right, option: one}.items() for word in pair]
        answer = said("response", *words, text=GOOD)
        assert answer.is_wrong_use("such as 600:1000:9" * (one == "600:1000")), one
        assert len(answer.err) < 500
    if option != "--at":
        words = [word for key, one in right.items() if key != option for word in (key, one)]
        assert said("response", *words, text=GOOD).is_wrong_use()


def test_without_a_link_the_torque_acts_on_the_input() -> None:
    made = document("response", "--orders", "2", *SPEED, text=GOOD)
    assert made == document("response", *AT, "--orders", "2", *SPEED, text=GOOD)
    two = MASS.replace("[mass]", "[mass, other, out]").replace("output: mass", "output: out") + (
        "gears: {a: {}, b: {input: other}}\n"
    )
    asked = ("response", "--orders", "2", *SPEED)
    made = said(*asked, text=two)
    assert made.is_wrong_use("Missing option '--at': gears have the inputs mass, other")
    assert document(*asked, "--gear", "a", text=two)["at"] == "mass"
