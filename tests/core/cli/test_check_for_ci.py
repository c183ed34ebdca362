"""Problems in the formats of CI: annotations of GitHub, SARIF, JUnit; the hook of pre-commit."""

import re
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
import yaml

from tests.commands import ROOT, json_answer, vstatics
from tests.installed import needs

pytestmark = pytest.mark.usefixtures("files")
FILES = ("bad.yaml", "open.yaml", "tied.yaml", "none.yaml")
"""An error, a warning, an error of a gear, a file that is not there."""


@pytest.fixture
def records() -> list[dict[str, str]]:
    found: list[dict[str, str]] = json_answer("check", *FILES)
    assert {one["severity"] for one in found} == {"error", "warning"}
    return found


def test_annotations_of_github_are_the_problems(records: list[dict[str, str]]) -> None:
    """With relative paths, in which signs are escaped; a note is a notice."""
    said = vstatics("check", *FILES, "-f", "github")
    assert (said.status, said.err) == (1, "")
    expected = []
    for one in records:
        line = f",line={one['line']},col={one['column']}" if one["line"] else ""
        keys = f"file={one['file']}{line},title={one['id']}"
        expected.append(f"::{one['severity']} {keys}::{one['message'].replace('%', '%25')}")
    assert said.out.splitlines() == expected
    name = Path("bad.yaml").rename("50%,a:b.yaml")
    said = vstatics("check", name.absolute(), "-f", "github")
    assert said.out.startswith("::error file=50%25%2Ca%3Ab.yaml,line=3,")
    said = vstatics("check", ROOT / "vstatics/core/messages/examples/N203.yaml", "-f", "github")
    assert said.status == 0
    assert re.search(r"(?m)^::notice .*title=N203::", said.out)


def test_sarif_has_results_and_the_rules_that_occur(records: list[dict[str, str]]) -> None:
    Path("my boxes").mkdir()
    for file in FILES[:-1]:
        Path("my boxes", file).write_bytes(Path(file).read_bytes())
    absolute = [Path("my boxes", file).absolute() for file in FILES]
    said = vstatics("check", *absolute, "-f", "sarif")
    assert (said.status, said.json["version"]) == (1, "2.1.0")
    [run] = said.json["runs"]
    rules = [rule["id"] for rule in run["tool"]["driver"]["rules"]]
    assert rules == sorted({one["id"] for one in records})
    for result, record in zip(run["results"], records, strict=True):
        assert rules[result["ruleIndex"]] == result["ruleId"] == record["id"]
        assert result["level"] == record["severity"]
        hint = "; did you mean"  # of a file nearby, which is another there
        assert result["message"]["text"].split(hint)[0] == record["message"].split(hint)[0]
        place = result["locations"][0]["physicalLocation"]
        assert place["artifactLocation"]["uri"] == f"my%20boxes/{record['file']}"
        assert place.get("region", {}).get("startLine") == record["line"]


def test_junit_fails_by_warnings_only_with_strict(records: list[dict[str, str]]) -> None:
    for options, passed in (((), ["open.yaml"]), (("--strict",), [])):
        said = vstatics("check", *FILES, "-f", "junit", *options)
        root = ET.fromstring(said.out.encode())  # noqa: S314
        [suite] = root
        assert (root.tag, suite.get("name")) == ("testsuites", "vstatics check")
        assert suite.get("failures") == str(len(FILES) - len(passed))
        assert [case.get("name") for case in suite] == [*FILES]
        for case in suite:
            own = [record for record in records if record["file"] == case.get("name")]
            failures = [] if case.get("name") in passed else [own[0]["id"]]
            assert [failure.get("type") for failure in case] == failures
            assert all(one["message"] in str(f.text) for one in own for f in case)


def test_a_hook_of_pre_commit_checks_cases() -> None:
    [hook] = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8"))
    assert (hook["id"], hook["language"]) == ("vstatics-check", "python")
    command, *arguments = hook["entry"].split()
    assert command == "vstatics"
    for files, status in (("open.yaml", 0), ("neutral.yaml", 1), ("bad.yaml open.yaml", 1)):
        assert vstatics(*arguments, *files.split()).status == status
    assert re.search(hook["files"], "cases/box.yaml")
    assert not re.search(hook["files"], ".github/workflows/ci.yaml")


def test_a_red_job_has_a_red_report() -> None:
    """With -q a warning is not told, but that it makes the case fail, and its id, is."""
    for form in ("github", "sarif", "junit", "json", "text"):
        said = vstatics("check", "open.yaml", "-q", "--strict", "-f", form)
        told = said.err if form == "text" else said.out
        assert (said.status, "1 warning (W416), so --strict fails" in told) == (1, True)
    assert vstatics("check", "open.yaml", "-q").out == ""


@needs("simulation")
def test_a_case_of_several_scenarios_is_reported_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """But in JUnit, where each file has its own verdict."""
    monkeypatch.setattr("vstatics.simulation.cli.documents.TRIED", 0.05)
    names = ("8hp70-upshift", "8hp70-downshift")
    scenarios = [ROOT / "cases/scenarios" / f"{name}.yaml" for name in names]
    alone = json_answer("check", ROOT / "cases/driveline-8hp70.yaml")
    found = json_answer("check", *scenarios)
    of_case = [one["line"] for one in found if one["file"].endswith("driveline-8hp70.yaml")]
    assert of_case == [one["line"] for one in alone]
    assert of_case


def test_a_list_of_files_is_checked_as_if_they_were_named() -> None:
    """Those of a commit, say: `git diff --name-only -z`."""
    for form, end in (("text", "\n"), ("json", "\0"), ("junit", "\n")):
        listed = "".join(f"{name}{end}" for name in FILES).encode()
        said = vstatics("check", "--files-from", "-", "-f", form, stdin=listed)
        assert said == vstatics("check", *FILES, "-f", form)
    none = vstatics("check", "--files-from", "-", "-f", "json", stdin=b"")
    assert none == (0, "[]\n", "<stdin>: names no file\n")
