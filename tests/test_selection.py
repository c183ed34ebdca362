"""Tests of which tests run: the cases of each test, and the tests that a change can break."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.changed import ALL, changed_files, places
from tests.installed import HERE, needs

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize(
    "number", [pytest.param(1, marks=pytest.mark.skipif("1", reason="-")), 2, 3]
)
def test_of_three_cases(number: int) -> None:
    """Serve as an example for the test below: the first case is left out."""
    assert number in (2, 3)


@pytest.mark.parametrize(
    ("cases", "taken"), [("first", ["1", "2"]), ("other", ["3"]), ("all", ["1", "2", "3"])]
)
def test_the_first_case_that_is_not_skipped_stands_for_all(cases: str, taken: list[str]) -> None:
    words = ["-m", "pytest", "--collect-only", "-q", f"--cases={cases}", f"{__file__}"]
    done = subprocess.run(
        [sys.executable, *words, "-k", "test_of_three_cases", "-p", "no:cacheprovider"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    assert re.findall(r"test_of_three_cases\[(\d)\]", done.stdout) == taken


@needs("sweep", "simulation")
def test_a_change_of_an_annex_concerns_it_and_the_annexes_that_need_it() -> None:
    found = places(["vstatics/sweep/variants/table.py"])
    assert found[:2] == ["tests/sweep", "vstatics/sweep"]
    assert {"tests/simulation", "tests/test_golden.py"} <= {*found}  # simulation needs sweep
    assert {"tests/pictures", "tests/core/statics"}.isdisjoint(found)


def test_a_change_of_the_core_concerns_the_rooms_above_it_and_all_annexes() -> None:
    found = places(["vstatics/core/flow/paths.py", "README.md"])
    above = {"tests/core/flow", "tests/core/cli", *(f"tests/{annex}" for annex in HERE)}
    assert above <= {*found}
    assert "tests/core/statics" not in found  # below


def test_a_change_of_a_document_concerns_tests_of_the_whole_program_only() -> None:
    assert {Path(name).parent.name for name in places(["docs/method.md"])} == {"tests"}


def test_without_a_known_change_everything_is_tested() -> None:
    assert places([]) == places(["pyproject.toml"]) == places(["tests/oracle/gears.py"]) == [*ALL]


def test_a_renamed_file_is_named_by_both_paths_and_a_wrong_commit_is_an_error(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tests.changed.ROOT", folder)
    (folder / "a b.txt").write_text("of some length\n" * 9)
    person = ("-c", "user.name=x", "-c", "user.email=x")
    for words in (["init", "-q"], ["add", "."], [*person, "commit", "-qm", "x"]):
        subprocess.run(["git", *words], check=True)
    subprocess.run(["git", "mv", "a b.txt", "c.txt"], check=True)
    (folder / "new.txt").touch()
    assert changed_files("HEAD") == ["a b.txt", "c.txt", "new.txt"]
    for wrong in ("unknown", "new.txt", "--help"):
        with pytest.raises(subprocess.CalledProcessError):
            changed_files(wrong)
    assert changed_files() == []  # of a repository without `origin`
