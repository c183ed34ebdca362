"""The JSON Schemas: up to date, each by itself, and of one mind with what commands write."""

import copy
import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from tests.chance import with_slow
from tests.commands import BAD, CASES, ROOT, SHIPPED, TIED_UP, json_answer, json_file, vstatics
from tests.installed import ANNEXES, needs
from vstatics.core.cli.schemas import schemas, text

SCHEMAS = ROOT / "schemas"
OF_COMMAND = {"run": "result", "flow": "flow", "summary": "summary", "explain": "explain"}


def validator(name: str) -> Draft202012Validator:
    """Of the file alone: a reference to another one would fail."""
    return Draft202012Validator(json_file(SCHEMAS / f"{name}.schema.json"))


VALIDATORS = {command: validator(name) for command, name in OF_COMMAND.items()}


def complaints(command: str, document: Any) -> list[str]:
    errors = VALIDATORS[command].iter_errors(document)
    return [f"{error.json_path}: {error.message[:200]}" for error in errors]


@needs(*ANNEXES)
@pytest.mark.parametrize("name", schemas())
def test_a_schema_is_valid_and_its_file_up_to_date(name: str) -> None:
    made = schemas()[name]
    Draft202012Validator.check_schema(made)
    assert set(re.findall(r'"#/\$defs/(\w+)"', json.dumps(made))) <= set(made.get("$defs", ()))
    file = SCHEMAS / f"{name}.schema.json"
    assert file.read_text("utf-8") == text(made), "write them: make schema"


@needs(*ANNEXES)
def test_the_page_of_results_leads_to_every_schema() -> None:
    page = (ROOT / "docs/results.md").read_text("utf-8")
    rows = "".join(line for line in page.splitlines() if line.startswith("| "))
    linked = re.findall(r"\(\.\./schemas/([a-z]+)\.schema\.json\)", rows)
    assert sorted(linked) == sorted(schemas())
    assert {path.name for path in SCHEMAS.iterdir()} == {f"{n}.schema.json" for n in schemas()}


def test_what_changed_between_results_fits(tmp_path: Path) -> None:
    """A number, a gear that is gone, a case that is new, one that can't be read."""
    case = (CASES / "simpson.yaml").read_text("utf-8")
    for folder, own in (("old", case), ("new", case.replace("-73/35", "-75/35", 1))):
        (tmp_path / folder).mkdir()
        (tmp_path / f"{folder}.yaml").write_text(own, "utf-8")
        vstatics("run", tmp_path / f"{folder}.yaml", "-o", tmp_path / folder / "box.json")
    (tmp_path / "new/other.json").write_bytes((tmp_path / "new/box.json").read_bytes())
    (tmp_path / "new/broken.json").write_text("{", "utf-8")
    (tmp_path / "old/broken.json").write_text("{", "utf-8")
    written = json_answer("compare", tmp_path / "new", tmp_path / "old")
    assert {one["state"] for one in written["cases"]} == {"changed", "added", "unreadable"}
    assert [*validator("compare").iter_errors(written)] == []
    written["cases"][0]["state"] = "other"
    assert [*validator("compare").iter_errors(written)] != []


@pytest.mark.parametrize("command", OF_COMMAND)
@pytest.mark.parametrize("cases", with_slow([SHIPPED[:4]], [SHIPPED[4:]]))
def test_what_is_written_of_shipped_cases_fits(command: str, cases: list[Path]) -> None:
    written = json_answer(command, *cases)
    assert len(written) == len(cases)
    assert complaints(command, written) == complaints(command, written[0]) == []
    written[0].pop("file")  # as earlier results are
    assert complaints(command, written[0]) == []


@pytest.mark.parametrize("command", OF_COMMAND)
def test_gears_without_results_and_cases_in_error_fit(command: str, folder: Path) -> None:
    for name, case in (("tied.yaml", TIED_UP), ("bad.yaml", BAD)):
        (folder / name).write_text(case, "utf-8")
    written = json_answer(command, "tied.yaml", "bad.yaml")
    assert complaints(command, written) == []
    assert written[1].keys() == {"file", "case", "errors"}
    for line in vstatics(command, "tied.yaml", "bad.yaml", "-f", "jsonl").out.splitlines():
        assert complaints(command, json.loads(line)) == []


def test_what_a_summary_is_asked_for_fits(folder: Path) -> None:
    (folder / "duty.yaml").write_text("energy: {'1': 1, '2': 2}\n", "utf-8")
    asked = ("summary", CASES / "simpson.yaml", "--combinations", "--duty", "duty.yaml")
    written = json_answer(*asked)
    assert {"duty", "combinations"} <= written.keys()
    assert complaints("summary", written) == []


def test_solutions_of_exercises_fit() -> None:
    """Of one case, of several, drawn by a seed or not."""
    exercise = validator("exercise")
    for cases, seed in (([CASES / "simpson.yaml"], ()), (SHIPPED[:2], ("--seed", "3"))):
        asked = "explain", *cases, "--gear", "1", "--solution", *seed, "-f", "json"
        written = vstatics(*asked).json
        assert [*exercise.iter_errors(written)] == []
        one = written if isinstance(written, dict) else written[0]
        one["blanks"][0]["value"] = None
        assert [*exercise.iter_errors(written)] != []


def _of_first_gear(change: dict[str, Any]) -> Callable[[Any], None]:
    return lambda document: document["gears"][0].update(change)


def test_a_wrong_document_does_not_fit() -> None:
    for command, spoil in (
        ("run", lambda document: document.update(case={"links": 3, "ratoi": 1})),
        ("run", lambda document: document.update(efficiency=["1"])),
        ("run", lambda document: document.pop("speeds")),
        ("run", lambda document: document.update(version=1)),
        ("flow", _of_first_gear({"gear": 1})),
        ("flow", _of_first_gear({"lossy": {}})),
        ("flow", _of_first_gear({"more": 1})),
        ("summary", _of_first_gear({"ratio": "1"})),
        ("summary", lambda document: document.pop("spread")),
        ("explain", _of_first_gear({"matrix": [1]})),
        ("explain", _of_first_gear({"speeds": None})),
    ):
        right = json_answer(command, CASES / "simpson.yaml")
        wrong = copy.deepcopy(right)
        spoil(wrong)
        for documents in (wrong, [right, wrong]):
            assert complaints(command, documents) != []
