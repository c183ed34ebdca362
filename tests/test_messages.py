"""Each message has an id by its cause, and warnings and notes can be allowed."""

import ast
import json
import re
from collections import Counter
from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner

from tests.commands import json_answer, vstatics
from tests.installed import ANNEXES, missing
from tests.rooms import PACKAGE, modules, nodes
from vstatics.core import readers
from vstatics.core.annexes import KEYS
from vstatics.core.cli import main
from vstatics.core.messages.catalogue import (
    ExplainedMessage,
    causes_of_allowable,
    explained,
    known_ids,
)

MAKERS = {"Problem", "of_file", "CaseError", "ReadError", "Message", "Said", "Doubt", "warnings_of"}
CASE = """\
links: [a, b, c]
output: b
shift_elements: {B: [c, housing]}
mechanisms: {D: {first: a, second: b, third: c, ratio: 2}}
gears: {low: [B], free: []}
"""
"""No plain set (W201); its second gear is neutral (W414)."""


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    (folder / "box.yaml").write_text(CASE, "utf-8")


@cache
def ids_in_code(room: str = "") -> set[str]:
    """The ids with which messages are made, in the core, an annex, or anywhere."""
    found = set()
    for name, file in modules().items():
        if room and name.split(".")[1:2] != [room]:
            continue
        for node in nodes(file):
            if isinstance(node, ast.Constant) and re.fullmatch(r"[EWN]\d{3}", str(node.value)):
                found.add(str(node.value))
    return found


def test_no_message_is_made_without_an_id() -> None:
    for file in modules().values():
        for node in nodes(file):
            if not isinstance(node, ast.Call) or getattr(node.func, "id", "") not in MAKERS:
                continue
            first = node.args[0] if node.args else None
            assert not isinstance(first, ast.JoinedStr), (file, node.lineno)
            if isinstance(first, ast.Constant):
                assert re.fullmatch(r"[EWN]\d{3}", str(first.value)), (file, node.lineno)


HOW_TO_ADD = """
Each id has three lines in a file of vstatics/core/messages/causes: the id, the cause, the remedy,
both in whole sentences, then an empty line. The file core.txt has the ids that the core uses, the
others have those of an annex. If a case alone shows the message, the case is
vstatics/core/messages/examples/ID.yaml."""
CAUSES = PACKAGE / "core/messages/causes"


def test_every_id_has_a_cause_and_a_remedy() -> None:
    known = {*known_ids()}
    lacking, unknown = sorted(ids_in_code() - known), sorted(known - ids_in_code())
    assert not lacking, f"no explanation of {lacking}.{HOW_TO_ADD}"
    assert not unknown or missing(ANNEXES), (
        f"the code has no message {unknown}: remove their explanations.{HOW_TO_ADD}"
    )


@pytest.mark.parametrize("file", sorted(CAUSES.iterdir()), ids=lambda file: file.stem)
def test_explanations_are_in_order_and_whole(file: Path) -> None:
    blocks = file.read_text("utf-8").removesuffix("\n").split("\n\n")
    rows = [block.split("\n") for block in blocks]
    assert [row for row in rows if len(row) != 3] == [], HOW_TO_ADD
    ids = [row[0] for row in rows]
    assert ids == sorted({*ids}, key=lambda identity: ("EWN".index(identity[0]), identity))
    assert file.stem == "core" or file.stem in ANNEXES


def test_an_id_has_one_explanation_where_it_is_used() -> None:
    found = Counter[str]()
    for file in CAUSES.iterdir():
        ids = re.findall(r"^[EWN]\d{3}$", file.read_text("utf-8"), re.MULTILINE)
        found.update(ids)
        if not missing(ANNEXES):
            assert {*ids} <= ids_in_code(file.stem), file.name
    assert [identity for identity, count in found.items() if count > 1] == []
    of_core = re.findall(r"^[EWN]\d{3}$", (CAUSES / "core.txt").read_text("utf-8"), re.MULTILINE)
    assert {*of_core} == ids_in_code("core")


EXAMPLES = [one for one in map(explained, known_ids()) if one.example]


def test_every_example_is_of_an_id() -> None:
    files = {path.stem for path in (PACKAGE / "core/messages/examples").iterdir()}
    assert files == {one.id for one in EXAMPLES}


@pytest.mark.parametrize("one", EXAMPLES, ids=lambda one: one.id)
def test_an_example_tells_its_message(one: ExplainedMessage) -> None:
    Path("example.yaml").write_text(str(one.example), "utf-8")
    keys = re.findall(r"^(\w+):", str(one.example), re.MULTILINE)
    absent = missing(KEYS[key] for key in keys if key in KEYS)
    if absent or (missing(ANNEXES) and one.id not in ids_in_code()):
        pytest.skip("it is a message of an annex that is not installed")
    records = json_answer("check", "example.yaml")
    assert one.id in {record["id"] for record in records}
    severities = {record["severity"] for record in records if record["id"] == one.id}
    assert severities == {one.severity}


def test_ids_are_explained_without_a_case() -> None:
    said, warning = vstatics("check", "--explain", "W201"), explained("W201")
    assert said.out.startswith("W201 (warning)\nCause: ")
    assert " ".join(said.out.split()).startswith(
        f"W201 (warning) Cause: {warning.cause} Remedy: {warning.remedy} Example: "
    )
    assert "    links: [a, b, c]\n" in said.out
    heading = r"(?m)^([EWN]\d{3}) \((?:error|warning|note)\)$"
    for option in (("--explain", "all"), ("--explain",)):
        assert re.findall(heading, vstatics("check", *option).out) == known_ids()


def test_all_ids_are_an_array_in_json() -> None:
    told = json_answer("check", "--explain", "all")
    explained = {one["id"] for one in told}
    assert explained >= ids_in_code() if missing(ANNEXES) else explained == ids_in_code()
    assert {tuple(one) for one in told} == {("id", "severity", "cause", "remedy", "example")}
    two = vstatics("check", "--explain", "n318, w201", "-f", "json").out
    assert [one["id"] for one in json.loads(two)] == ["N318", "W201"]
    [one] = json_answer("check", "--explain", "E006")
    assert (one["severity"], one["example"]) == ("error", None)


def test_what_cannot_be_explained_is_wrong_use() -> None:
    for options, why in {
        "--explain W999": "there is no message `W999`",
        "--explain w2011": "did you mean `W201`?",
        "--explain W201 box.yaml": "--explain takes no case",
        "--explain W201 -f sarif": "--explain gives text or json, not sarif",
        "": "Missing argument 'CASE...'",
    }.items():
        assert vstatics("check", *options.split()).is_wrong_use(why)


def test_no_two_ids_have_the_same_cause() -> None:
    causes = Counter(explained(identity).cause for identity in known_ids())
    assert [cause for cause, count in causes.items() if count > 1] == []


def test_errors_cannot_be_allowed() -> None:
    assert [*causes_of_allowable()] == [name for name in known_ids() if name[0] in "WN"]


def test_a_message_ends_with_its_id() -> None:
    said = CliRunner().invoke(main, ["check", "box.yaml"]).stderr
    assert re.search(r"^box\.yaml:4:\d+: warning: .* \[W201\]$", said, re.MULTILINE)
    made = json_answer("run", "box.yaml")
    assert [text[-7:] for text in made["messages"]] == [" [W201]", " [W414]"]
    records = json_answer("check", "box.yaml")
    assert {one["id"] for one in records} == {"W201", "W414", "E453"}
    assert not any("[W" in one["message"] for one in records)


@pytest.mark.parametrize("command", ["run", "check", "summary", "flow", "explain"])
def test_a_warning_is_allowed_by_option_and_by_key(command: str) -> None:
    def ids(*options: str) -> list[str]:
        said = CliRunner().invoke(main, [command, "box.yaml", *options]).stderr
        return re.findall(r"warning: .*\[(W\d+)\]", said)

    assert ids() == ["W201", "W414"]
    assert ids("--allow", "W201") == ["W414"]
    assert ids("--allow", "W201", "--allow", "W414") == []
    Path("box.yaml").write_text(f"{CASE}allow: [W201, W414]\n", "utf-8")
    assert ids("--strict") == []


def test_conversion_keeps_what_is_allowed() -> None:
    Path("box.yaml").write_text(f"{CASE}allow: [W201]\n", "utf-8")
    for file in ("other.json", "other.yaml"):
        assert vstatics("convert", "box.yaml", file).status == 0
        assert list(readers.load(file).allow) == ["W201"]
    assert "allow" in vstatics("convert", "box.yaml", "other.dat").err


def test_what_cannot_be_allowed_is_wrong_use_and_in_the_case_an_error() -> None:
    for identity, why in {
        "W999": "there is no message `W999`",
        "E201": "`E201` is an error, expected a warning or a note",
        "W201B": "there is no message `W201B`; did you mean `W201`?",
    }.items():
        said = vstatics("run", "box.yaml", "--allow", identity)
        assert said.is_wrong_use(f"Invalid value for '--allow': {why}")
        Path("other.yaml").write_text(f"{CASE}allow: [W201, {identity}]\n", "utf-8")
        assert vstatics("run", "other.yaml").fails(f"other.yaml:6:15: error: allow[2]: {why}")


def test_a_belt_without_an_efficiency_is_reported_by_check_alone() -> None:
    for kind, sizes in (("belt", "diameters"), ("chain", "teeth")):
        element = f"{{kind: {kind}, first: a, second: b, {sizes}: {{first: 20, second: 40}}"
        text = f"input: a\noutput: b\nelements: {{E: {element}}}}}\ngears: {{1: []}}\n"
        Path("drive.yaml").write_text(text, "utf-8")
        said = vstatics("check", "drive.yaml").err
        assert said.startswith("drive.yaml:3:12: note: elements.E: `efficiency` is missing: belts")
        assert vstatics("run", "drive.yaml").err == ""
        Path("drive.yaml").write_text(text.replace(element, f"{element}, efficiency: .97"))
        assert vstatics("check", "drive.yaml").err == ""
