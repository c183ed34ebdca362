"""`vstatics torsion dump` of a case, or of a file of numbers."""

import json
from pathlib import Path
from typing import Any

import pytest

from tests.commands import MZKT, vstatics
from tests.core.cli.test_schemas import validator
from tests.torsion.clutch.test_dump_key import GOOD
from tests.torsion.clutch.test_gear_dump import car
from vstatics import loads
from vstatics.core.writers import named
from vstatics.torsion.clutch.dumped import dump
from vstatics.torsion.clutch.gear_dump import gear_dumps

VAZ = car("ВАЗ-2101")
FOUR = VAZ.replace(", N: [clutch], open: [dog 1]", "")
"""Without gears in which the clutch could not be dumped."""
FORWARD = ("--gear", "1", "--gear", "2", "--gear", "3", "--gear", "4")


def said(*options: str, text: str = VAZ) -> Any:
    return vstatics("torsion", "dump", "-", *options, stdin=text.encode())


def test_one_gear_is_as_a_file_of_numbers() -> None:
    answer = said("--gear", "2", "-f", "json")
    assert answer.is_without_messages()
    made = answer.json
    [expected] = gear_dumps(loads(VAZ), ["2"])
    assert expected.given is not None
    assert (made["name"], made["to"], made["case"]) == ("2", "propshaft", "A3")
    assert made["reduced"] == expected.given._asdict()
    numbers = said("-f", "json", text=json.dumps(made["reduced"])).json
    assert numbers["max_torque"] == made["max_torque"] == dump(expected.given).max_torque
    assert "engagement" not in numbers
    tabbed = named.write_json(loads(VAZ)).replace("\n ", "\n\t")  # which YAML does not take
    assert said("--gear", "2", "-f", "json", text=tabbed).json["reduced"] == made["reduced"]


def test_without_a_gear_all_are_listed_also_those_without_such_a_torque() -> None:
    answer = said("-f", "json", "--rate", "50")
    assert answer.status == 1
    *four, neutral, loose = answer.json["gears"]
    told = [(one["name"], one["case"], one["engagement"]["rate"]) for one in four]
    assert told == [("1", "A3", 50), ("2", "A3", 50), ("3", "A2", 50), ("4", "A2", 50)]
    assert neutral.keys() == {"name", "error"}
    assert loose["error"].startswith("engine of J1 does not rotate with propshaft")
    assert "error: gears N and open: engine of J1 does not rotate with propshaft" in answer.err


def test_json_fits_its_schema() -> None:
    schema = validator("dump")
    of_gears = [(), ("--gear", "1"), ("--gear", "N"), FORWARD, ("--gear", "3", "--rate", "9")]
    calls = [(VAZ, options) for options in of_gears] + [(GOOD, ()), (GOOD, ("--rate", "50"))]
    for text, options in calls:
        made = said("-f", "json", *options, text=text).json
        assert list(schema.iter_errors(made)) == []
        assert not schema.is_valid({**made, "more": 1})
        assert not schema.is_valid({key: made[key] for key in ("format", "version")})


NUMBERS = (
    "{J1: 4.29, J2: 0.1, J3: 0.0674, J4: 0.147, J5: 10.8, E: 2600e-6, M_C0: 1344, %s, omega1: 135}"
)


def test_json_has_the_limits_that_tables_have() -> None:
    """Of a GAZ-24 (table 3.7): ``M_C0 (J1 + J2 + J3)/J1``, ``M_phi (1 + J4/J5)``, (3.14)."""
    text = NUMBERS % "M_phi: 507"
    made = said("-f", "json", text=text).json
    assert made["case"] == "V3"
    assert made["clutch_breaks_at"] == pytest.approx(1344 * (4.29 + 0.1 + 0.0674) / 4.29)
    assert made["tyres_break_at"] == pytest.approx(507 * (1 + 0.147 / 10.8))
    assert made["grabs_below"] == pytest.approx(0.8 * 1344 * (2600e-6 / 0.1) ** 0.5)
    assert made["grip_ratio"] == pytest.approx(1344 / 507)  # (3.1)
    assert made["dynamic_factor_of_least"] == pytest.approx(1481 / 507, rel=1e-3)  # (3.4)
    cells = said("-f", "csv", text=text).out
    numbers = [one for one in made.values() if isinstance(one, float)]
    assert len(numbers) == 10
    assert all(repr(one) in cells for one in numbers)
    grips = said("-f", "json", text=NUMBERS % "M_phi: .inf").json
    assert (grips["tyres_break_at"], grips["grip_ratio"]) == (None, 0.0)
    assert grips["dynamic_factor_of_least"] == pytest.approx(grips["max_torque"] / 1344)
    assert said("-f", "json", text=GOOD.replace("1.36", ".inf")).json["case"] == "V1"


def test_tables_for_people() -> None:
    text = said(text=FOUR).out
    assert "Clutch dump, on propshaft\n" in text
    assert "Reduced to propshaft\n" in text
    assert "the clutch grabs below a speed of [rad/s]" in text
    assert "\nomega1 [rad/s]   156" in said("--gear", "1").out
    assert "engaged at the rate" in said("--rate", "50", text=FOUR).out
    assert "by 42 % compared with a measurement" in said(text=GOOD).out


@pytest.mark.parametrize("suffix", ["csv", "md", "tex", "xlsx", "jsonl"])
def test_every_format_can_be_written(suffix: str, tmp_path: Path) -> None:
    for name, text in (("case", FOUR), ("numbers", GOOD)):
        file = tmp_path / f"{name}.{suffix}"
        assert said("-o", str(file), text=text).status == 0
        assert file.stat().st_size > 0


def test_a_case_without_a_dump_is_reported(tmp_path: Path) -> None:
    answer = vstatics("torsion", "dump", MZKT)
    assert answer.fails("the case has no `dump`, expected the links of engine `J1`")
    file = tmp_path / "case.yaml"
    file.write_text(VAZ[: VAZ.index("dump:")], "utf-8")
    answer = vstatics("torsion", "dump", file)
    assert f"{file}:1:1: error: dump: the case has no `dump`" in answer.err


def test_all_that_is_wrong_in_a_file_of_numbers_is_reported_in_one_run() -> None:
    answer = said(text=GOOD.replace("16.6", "0").replace("0.538", "-1"))
    assert answer.gives_nothing("<stdin>:1:5: error: J1", "<stdin>:2:5: error: J2")
    large = GOOD.replace("3362", "1e308").replace("71.3e-5", "1e308").replace("81.7", "1e308")
    assert said(text=large).fails("<stdin>:1:1: error: the numbers are too large or too small")


def test_wrong_use() -> None:
    for options in (["--gear", "7"], ["-f", "png"], ["-o", "./"]):
        assert said(*options).is_wrong_use(), options
    for rate in ("0", "nan", "inf"):
        assert said("--rate", rate).is_wrong_use(), rate
        assert said("--rate", rate, text=GOOD).is_wrong_use(), rate
    answer = said("--gear", "1", text="{J1: 1, J2: 1}")
    assert answer.is_wrong_use("--gear is for a case, but <stdin> has numbers alone")
