"""Cases with a key of an annex that is not installed: they are calculated, with a warning."""

from __future__ import annotations

import io
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests import commands
from tests.commands import ROOT
from tests.installed import HERE, needs
from vstatics import CaseError, check, loads, solve
from vstatics.core import annexes
from vstatics.core.readers.named.schema import json_schema
from vstatics.core.summary import summarize

CASE = """\
links: [engine, shaft]
mechanisms: {pair: {first: engine, second: shaft, ratio: 2.5}}
gears: {"1": []}
vehicle: {mass: 1200, radius: 0.3, engine: [[100, 150], [500, 120]]}
"""
MESSAGE = "vehicle belongs to vstatics.vehicle, which is not installed here"


@pytest.fixture
def without_vehicle(monkeypatch: pytest.MonkeyPatch) -> None:
    others = tuple(annex for annex in annexes.annexes() if annex.name != "vehicle")
    monkeypatch.setattr(annexes, "annexes", lambda: others)


@pytest.mark.usefixtures("without_vehicle")
def test_a_key_of_a_missing_annex_is_a_warning_at_its_place() -> None:
    [problem] = check(io.StringIO(CASE))
    assert (problem.id, problem.severity, problem.message) == ("W807", "warning", MESSAGE)
    assert problem.place is not None
    assert problem.place[1:3] == (4, 1)
    assert check(io.StringIO(f"{CASE}allow: [W807]")) == []


@pytest.mark.usefixtures("without_vehicle")
def test_the_rest_of_the_case_is_calculated() -> None:
    case = loads(CASE)
    summary = summarize(solve(case))
    assert (case.vehicle, summary.vehicle, summary.results.ratio.tolist()) == (None, None, [2.5])


@pytest.mark.usefixtures("without_vehicle")
def test_data_of_a_missing_annex_is_refused_and_not_lost(tmp_path: Path) -> None:
    file = tmp_path / "car.yaml"
    file.write_text(CASE)
    converted = commands.vstatics("convert", file, "-", "--to", "json")
    assert converted.gives_nothing(f"car.yaml:4:1: error: {MESSAGE}")
    with pytest.raises(CaseError, match=MESSAGE):
        loads(CASE.partition("vehicle")[0]).replace(vehicle=3)


@needs("pictures")
@pytest.mark.usefixtures("without_vehicle")
def test_a_command_and_a_method_of_a_missing_annex_name_the_annex(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert annexes.missing_command("cycle") == MESSAGE.replace("vehicle", "cycle", 1)
    assert [annexes.missing_command(name) for name in ("plot", "run", "cycl")] == ["", "", ""]
    others = tuple(annex for annex in annexes.annexes() if annex.name != "pictures")
    monkeypatch.setattr(annexes, "annexes", lambda: others)
    with pytest.raises(CaseError, match=r"plot belongs to vstatics\.pictures, which is not"):
        solve(loads(CASE)).plot("lever")


@needs("torsion")
@pytest.mark.usefixtures("without_vehicle")
def test_the_schema_of_cases_has_no_keys_of_a_missing_annex() -> None:
    keys = json_schema()["properties"]
    assert [key in keys for key in ("vehicle", "fatigue", "dump")] == [False, False, True]


def test_every_key_belongs_to_the_annex_that_declares_it() -> None:
    declared = {key: annex.name for annex in annexes.annexes() for key in annex.keys}
    assert declared == {key: annex for key, annex in annexes.KEYS.items() if annex in HERE}


@pytest.mark.slow
def test_commands_work_in_a_tree_without_the_annex(tmp_path: Path) -> None:
    left_out = shutil.ignore_patterns("vehicle", "__pycache__")
    shutil.copytree(ROOT / "vstatics", tmp_path / "vstatics", ignore=left_out)
    (tmp_path / "case.yaml").write_text(CASE)
    for command in ("check", "run", "summary"):
        words = [sys.executable, "-m", "vstatics", command, "case.yaml"]
        done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        assert f"case.yaml:4:1: warning: {MESSAGE} [W807]" in done.stdout + done.stderr
    words = [sys.executable, "-m", "vstatics", "cycle", "case.yaml", "trace.csv"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, MESSAGE.replace("vehicle", "cycle", 1) in done.stderr) == (2, True)
    assert "Traceback" not in done.stderr
