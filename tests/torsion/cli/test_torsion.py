"""What all commands of `vstatics torsion` have in common: formats, files, gears, exit statuses."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import openpyxl
import pytest

from tests.commands import CASES, NEUTRAL, environment, vstatics
from tests.core.cli.test_schemas import validator
from tests.installed import needs
from tests.processes import names
from tests.torsion.cli.torsional import (
    ASKED,
    BOX,
    CHAIN,
    GOOD,
    OF_GEARS,
    STUCK,
    asked,
    document,
    said,
    tables,
)  # fmt: skip

SIMPLIFY = ("simplify", "--gear", "direct", "--links", "2")
ALL = (*((name, *options) for name, options in ASKED.items()), SIMPLIFY)
ONE_GEAR = (
    ("simplify", "--links", "1"), ("identify", "--omega", "2"), ("damping", "--decrements", "t=.1"),
)  # fmt: skip
STANDS = {
    "reduce": "link engine does not turn: nothing can be reduced to it",
    "response": "link engine stands still: expected another, such as disc, sun, ring",
}
"""What commands say of a gear that holds the engine."""
FORMS = (
    ("json", "json", '{\n "format": "vstatics-'), ("jsonl", "jsonl", '{"format": "vstatics-'),
    ("csv", "csv", "table,"), ("md", "markdown", "# two gears\n"), ("tex", "latex", "\\noindent"),
    ("txt", "text", "two gears\n"),
)  # fmt: skip
"""Suffixes, formats, beginnings."""
each_call = pytest.mark.parametrize("call", ALL, ids=lambda call: call[0])


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    (folder / "box.yaml").write_text(GOOD, "utf-8")


def with_lost(text: str) -> str:
    return text.replace("casing]\noutput", "casing, lost]\noutput")


def no_constant(text: str) -> Any:
    raise AssertionError(text)


@pytest.mark.parametrize("command", ASKED)
def test_a_file_holds_what_stdout_would(command: str) -> None:
    """A pipe gives the same but for its name; a workbook has a sheet for each kind of table."""
    call = ("torsion", command, "box.yaml", *ASKED[command])
    made = asked(command, "-f", "json", text=GOOD).json
    assert (made["file"], made["case"], made["version"]) == ("<stdin>", "two gears", 2)
    assert vstatics(*call, "-f", "json").json == {**made, "file": "box.yaml"}
    for suffix, form, begins in FORMS:
        printed = vstatics(*call, "-f", form)
        assert printed.is_without_messages()
        assert printed.out.startswith(begins)
        written = vstatics(*call, "-o", f"new.{suffix}")
        assert (written.status, written.all, names()) == (0, "", ["box.yaml", f"new.{suffix}"])
        assert Path(f"new.{suffix}").read_text("utf-8") == printed.out
        Path(f"new.{suffix}").unlink()
    assert asked(command, "-o", "new.xlsx").status in (0, 1)  # with gears without results
    book = openpyxl.load_workbook("new.xlsx")
    assert len(book.sheetnames) < 10
    cells = [cell for sheet in book for row in sheet.iter_rows(values_only=True) for cell in row]
    assert sum(isinstance(cell, float) for cell in cells) >= 4


SCHEMAS = {
    "reduce": "reduction", "simplify": "simplification", "identify": "identification",
    **{command: command for command in ("modes", "response", "damping")},
}  # fmt: skip


@each_call
def test_json_fits_its_schema_and_has_null_but_no_nan(call: tuple[str, ...]) -> None:
    command, *options = call
    schema = validator(SCHEMAS[command])
    more = {
        "identify": ("--gear", "direct", "--omega", "5", "--decrement", ".2"),
        "simplify": ("--gear", "direct", "--links", "1", "--rule", "u"),
        "modes": ("--modes", "1", "--coast"),
    }
    for text in (BOX, with_lost(BOX), GOOD):
        for asked_for in (options, more.get(command, options)):
            answer = said(command, *asked_for, "-f", "json", text=text)
            made = json.loads(answer.out, parse_constant=no_constant)
            assert [error.json_path for error in schema.iter_errors(made)] == []
    for key in made.keys() - {"file", "decrement" if command == "identify" else ""}:
        assert not schema.is_valid({name: one for name, one in made.items() if name != key}), key
        assert not schema.is_valid({**made, key: {"more": ["1"]}}), key
    assert not schema.is_valid({**made, "more": 1})


def test_tables_for_people_fit_a_terminal() -> None:
    shown = [asked(command, text=GOOD).out for command in ASKED]
    assert all("\n\n" in text for text in shown)
    asked_for = ("--at", "1", "--orders", "2,4,4.5,6", "--speed", "600:4000:3", "--sum")
    for call in (("modes", "--gear", "1"), ("response", *asked_for), ("dump", "--rate", "50")):
        found = vstatics("torsion", call[0], CASES / "moskvich412.yaml", *call[1:]).out
        shown.append(found.partition("\nMessages\n")[0])
    assert max(len(line) for text in shown for line in text.splitlines()) <= 80


@each_call
def test_files_that_cannot_be_read_or_written(call: tuple[str, ...]) -> None:
    Path("old.json").write_text("old", "utf-8")
    command, *options = call
    wrong = said(*call, "-o", "old.json", text=BOX.replace("474", "-474"))
    stiffness = "springs.tyre.stiffness: read -474, expected a stiffness above 0"
    assert wrong.gives_nothing(f"<stdin>:8:46: error: {stiffness}")
    for output in ("box.yaml", "./box.yaml"):
        answer = vstatics("torsion", command, "box.yaml", *options, "-o", output)
        assert answer.is_wrong_use("box.yaml is what is read, and would be overwritten")
    for output in ("./", "out/", "new.xyz"):
        answer = vstatics("torsion", command, "nowhere.yaml", *options, "-o", output)
        assert answer.is_wrong_use()
        assert "nowhere" not in answer.err
    missing = "no/new.json: error: cannot be written: there is no directory no; create it"
    assert said(*call, "-o", "no/new.json").gives_nothing(missing)
    answer = vstatics("torsion", command, "bos.yaml", *options)
    hint = "bos.yaml: error: cannot be read: No such file or directory; did you mean `box.yaml`?\n"
    assert (answer.status, answer.out, answer.err) == (1, "", hint)
    assert Path("old.json").read_text("utf-8") == "old"
    assert Path("box.yaml").read_text("utf-8") == GOOD
    assert names() == ["box.yaml", "old.json"]


@pytest.mark.parametrize("command", OF_GEARS)
def test_all_gears_or_those_asked_for_by_name_or_number_each_once(command: str) -> None:
    def told(*options: str) -> list[str]:
        made = asked(command, *options, "-f", "json").json
        return [gear["name"] for gear in made["gears"]]

    assert told() == ["low", "direct", "tied", "N"]
    assert told("--gear", "direct", "--gear", "1", "--gear", "low") == ["direct", "low"]
    assert told("--gear", "4") == ["N"]


def test_a_gear_in_which_nothing_can_move_does_not_stop_the_others() -> None:
    answer = said("modes", "-f", "json", text=STUCK)
    free, stuck = answer.json["gears"]
    why = "tied up: A and B let nothing move; release one of the engaged shift elements"
    assert (answer.status, free["rigid_modes"], stuck["modes"]) == (1, 1, [])
    assert stuck["error"].startswith(why)
    told = "<stdin>:4:19: error: gear stuck: tied up: A and B let nothing move"
    assert told in answer.err
    for call in (("simplify", "--links", "2"), ("identify", "--omega", "5")):
        assert said(*call, "--gear", "stuck", "-f", "json", text=STUCK).gives_nothing(told)


def test_a_gear_that_has_no_answer_does_not_stop_the_others() -> None:
    for command, why in STANDS.items():
        answer = asked(command, "-f", "json")
        low, direct, tied, neutral = answer.json["gears"]
        assert answer.status == 1
        assert (tied.pop("name"), tied.pop("error")) == ("tied", why)
        assert all(values in ([], {}) for values in tied.values())
        assert not any("error" in gear for gear in (low, direct, neutral))
        assert f"<stdin>:20:3: error: gear tied: {why}" in answer.err
        assert asked(command, "--gear", "low", "--gear", "N").status == 0
        for form in ("text", "csv", "markdown"):
            shown = asked(command, "-f", form)
            assert shown.status == 1
            is_bare = (command, form) == ("response", "csv")
            assert why in (shown.err if is_bare else shown.out)
        assert asked(command, "-q").fails(why)


@each_call
def test_a_gear_that_is_not_there_is_wrong_use(call: tuple[str, ...]) -> None:
    for gear, hint in (
        ("lwo", "did you mean `low`?"), ("9", "gears are low, direct, tied, N"),
        ("", "no gear ''"), ("0", "gears are"), ("-1", "gears are"),
    ):  # fmt: skip
        assert said(*call, "--gear", gear).is_wrong_use(hint), gear


@pytest.mark.parametrize("call", ONE_GEAR, ids=lambda call: call[0])
def test_where_there_is_one_gear_it_need_not_be_named(call: tuple[str, ...]) -> None:
    without = said(*call, "-f", "json", text=CHAIN)
    assert without.is_without_messages()
    assert without.json["gear"] == "1"
    assert without.out == said(*call, "--gear", "1", "-f", "json", text=CHAIN).out
    assert said(*call).is_wrong_use("Missing option '--gear': gears are low, direct, tied, N")


@each_call
def test_a_warning_of_reader_or_command_fails_if_strict(call: tuple[str, ...]) -> None:
    doubts = [(GOOD.replace("ratio: -2}", "ratio: 2}"), "mechanisms.P: ratio 2 is not")]
    if call == ("modes",):
        doubts.append((with_lost(GOOD), "lost has neither an inertia nor a component"))
    for text, words in doubts:
        answer = said(*call, text=text)
        assert (answer.status, words in answer.err) == (0, True)
        for options, status in (["-q"], 0), (["--strict"], 1), (["-q", "--strict"], 1):
            again = said(*call, *options, text=text)
            assert (again.status, again.out) == (status, answer.out)
            assert (words in again.err) == ("-q" not in options)


@pytest.mark.slow
def test_the_help_of_the_group_imports_no_command() -> None:
    code = (
        "import sys; from vstatics.core.cli import main\n"
        "main(['torsion', '--help'], standalone_mode=False)\n"
        "late = 'scipy', 'vstatics.torsion'\n"
        "print(*sorted(one for one in sys.modules if one.startswith(late)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environment()
    )
    imported = done.stdout.splitlines()[-1].split()
    names = ["", ".annex", ".cli", ".cli.group"]
    assert imported == [f"vstatics.torsion{name}" for name in names]


def test_a_case_without_inertias_or_without_springs_has_no_modes() -> None:
    assert said("modes", text=CHAIN).out.startswith("<stdin>\n")  # it has no name
    answer = said("modes", text=CHAIN.partition("\n")[2])
    assert answer.gives_nothing("<stdin>", "inertias: nothing has an inertia, so nothing vibrates")
    answer = said("modes", "-f", "json", text=NEUTRAL + "inertias: {1: 1, 2: 2, 3: 3}\n")
    assert answer.err.count("warning: gear") == 1
    assert "gears N and low: nothing is elastic; expected `springs`" in answer.err
    fluid = (
        "links: 2\ninertias: {1: 1, 2: 2}\nload: {speed: 1000 rpm, torque: 15 N*m}\ngears: {1: []}\n"
        "mechanisms: {TC: {kind: converter, first: 1, second: 2, points: [[0, 2, 2e-3], [1, 1, 0]]}}"
    )
    assert "gear 1: nothing is elastic" in said("modes", text=fluid).err
    gears = answer.json["gears"]
    assert [(one["rigid_modes"], one["modes"]) for one in gears] == [(2, []), (1, [])]


def test_without_scipy_it_is_refused_before_anything_is_read(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    extra = 'pip install ".[torsion]" in the source folder, or pip install scipy\n'
    message = f"vstatics torsion needs the package scipy: {extra}"
    for command, *options in ALL:
        answer = vstatics("torsion", command, "nowhere.yaml", *options, "-o", "new.json")
        assert (answer.status, answer.all, names()) == (1, message, ["box.yaml"])


def test_what_does_not_exist_is_null_in_json_and_empty_in_csv() -> None:
    text = with_lost(GOOD)
    [gear] = document("modes", text=text)["gears"]
    assert {mode["shape"]["lost"] for mode in gear["modes"]} == {None}
    rows = tables(said("modes", "-f", "csv", text=text).out)["Gear direct: amplitudes of links"]
    [lost] = [row for row in rows if row[0] == "lost"]
    assert lost[1:] == [""] * len(gear["modes"])


@needs("vehicle")
def test_a_vehicle_and_a_half_shaft_to_nothing_are_noted() -> None:
    """The half-shaft cannot twist; 1200 kg on wheels of 0.3 m are 108 kg*m^2."""
    text = (
        "links: [engine, differential, wheel]\nmechanisms: {axle: {first: engine, second: "
        "differential, ratio: 4}}\nsprings: {half-shaft: {links: [differential, wheel], "
        "stiffness: 9e3}}\ninertias: {engine: 0.2}\nvehicle: {mass: 1200, radius: 0.3}\n"
    )
    notes = said("modes", text=text).err
    assert "springs.half-shaft: nothing else acts on link wheel, which has no inertia" in notes
    assert "its mass is an inertia of 108 kg*m^2 on the output" in notes
