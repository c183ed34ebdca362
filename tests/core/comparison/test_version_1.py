"""Results of version 1 of the formats, with deck names, agree with results of today.

The files in `version_1` were written by the last program that wrote version 1. The golden files
of that time and a case with every table stand for the files that users keep.
"""

import json
from pathlib import Path

import pytest

from tests.commands import ROOT, json_file, vstatics
from tests.installed import skip_without
from vstatics.core.tables.quantities import BY_NAME, QUANTITIES

OLD = Path(__file__).parent / "version_1"
GOLDEN = sorted(OLD.glob("*.*.json"))
FORMATS = ("json", "csv", "parquet")


def assert_equal(*files: Path) -> None:
    for actual, expected in (files, files[::-1]):
        said = vstatics("compare", actual, expected)
        assert said.is_silent()


@pytest.fixture
def case(tmp_path: Path) -> Path:
    """Case with every quantity, as the old result contains it."""
    path = tmp_path / "everything.json"
    path.write_text(json.dumps(json_file(OLD / "everything.json")["case"]), "utf-8")
    return path


def run(case: Path, name: str) -> Path:
    file = case.with_name(name)
    assert vstatics("run", case, "-o", file).status == 0
    return file


@pytest.mark.parametrize("old", GOLDEN, ids=lambda path: path.name)
def test_golden_files_agree_in_both_directions(old: Path) -> None:
    assert_equal(ROOT / "tests/golden" / old.name, old)


@pytest.mark.parametrize("suffix", FORMATS)
def test_every_table_agrees_in_every_format(suffix: str, case: Path) -> None:
    if suffix == "parquet":
        pytest.importorskip("pyarrow")
    assert_equal(run(case, f"new.{suffix}"), OLD / f"everything.{suffix}")


def test_the_old_result_has_every_table_under_its_old_name(case: Path) -> None:
    old, new = json_file(OLD / "everything.json"), json_file(run(case, "new.json"))
    assert (old["version"], new["version"]) == (1, 2)
    later = {"gear_losses", "gear_losses_kW", "slip_losses", "slip_losses_kW"}
    then = [one for one in QUANTITIES if one.name not in later]
    assert [name for name in new if name in BY_NAME] == [quantity.name for quantity in then]
    assert [name for name in old if name in BY_NAME] == [
        quantity.name if quantity.name in old else quantity.deck_name for quantity in then
    ]
    assert new["rows"].keys() < {quantity.name for quantity in QUANTITIES}
    assert {"AJK", "W", "AMLGP", "AMLGP_Nm"} < old["rows"].keys()


def test_a_change_is_found_under_the_new_name(case: Path) -> None:
    changed = json_file(OLD / "everything.json")
    changed["ETA"][0] *= 1.1
    files = run(case, "new.json"), case.with_name("old.json")
    files[1].write_text(json.dumps(changed), "utf-8")
    found = vstatics("compare", *files, "-f", "json").json["cases"][0]["numbers"]
    assert [item["table"] for item in found] == ["efficiency"]
    for key in ("efficiency", "ETA"):
        assert vstatics("compare", *files, "--leave-out", key).status == 0


def test_sweeps_agree_by_the_names_in_their_headings(case: Path) -> None:
    skip_without("sweep")
    out = "ETA[low], AMLGP_Nm[Mx,low], max(W[:,low]) - 1"
    new = case.with_name("new.csv")
    said = vstatics("sweep", case, "--vary", "P1.ratio=-2.5,-3", "--out", out, "-o", new)
    assert said.status == 0
    heading = new.read_text("utf-8").partition("\n")[0]
    assert heading == (
        'variant,P1.ratio,status,efficiency[low],"lossy_torques_Nm[Mx,low]",'
        '"max(speeds[:,low]) - 1"'
    )
    assert_equal(new, OLD / "sweep.csv")
    assert vstatics("compare", new, OLD / "sweep.csv", "--leave-out", "ETA").status == 0


def test_the_program_that_wrote_a_result_is_not_compared(case: Path) -> None:
    new = json_file(run(case, "new.json"))
    assert new["program"].startswith("vstatics ")
    new["program"] = "vstatics 99.0"
    other = case.with_name("other.json")
    other.write_text(json.dumps(new), "utf-8")
    assert_equal(case.with_name("new.json"), other)
