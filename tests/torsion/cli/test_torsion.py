"""What all commands of `vstatics torsion` have in common: formats, files, gears, exit statuses."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import openpyxl
import pytest

from tests.commands import CASES, NEUTRAL, vstatics
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
)
from vstatics.torsion.cli.group import TorsionCommands

SIMPLIFY = ("simplify", "--gear", "direct", "--links", "2")
ALL = (*((name, *options) for name, options in ASKED.items()), SIMPLIFY)
STANDS = {
    "reduce": "link engine does not turn: nothing can be reduced to it",
    "response": "link engine stands still: expected another, such as disc, sun, ring",
}
"""What commands say of a gear that holds the engine."""
CSV_OF_VALUES = ("response", "csv")
"""It has values alone."""


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    """A folder with the case, the current one."""
    (folder / "box.yaml").write_text(GOOD, encoding="utf-8")


# formats


@pytest.mark.parametrize("command", ASKED)
@pytest.mark.parametrize(
    ("suffix", "form", "begins"),
    [
        ("json", "json", '{\n "format": "vstatics-'),
        ("jsonl", "jsonl", '{"format": "vstatics-'),
        ("csv", "csv", "table,"),
        ("md", "markdown", "# two gears\n"),
        ("tex", "latex", "\\noindent"),
        ("txt", "text", "two gears\n"),
    ],
)
def test_a_file_holds_what_stdout_would(command: str, suffix: str, form: str, begins: str) -> None:
    call = ("torsion", command, "box.yaml", *ASKED[command])
    printed = vstatics(*call, "-f", form)
    assert (printed.status, printed.err) == (0, "")
    assert printed.out.startswith(begins)
    written = vstatics(*call, "-o", f"new.{suffix}")
    assert (written.status, written.all, names()) == (0, "", ["box.yaml", f"new.{suffix}"])
    assert Path(f"new.{suffix}").read_text(encoding="utf-8") == printed.out


@pytest.mark.parametrize("command", ASKED)
def test_a_workbook_has_a_sheet_for_each_kind_of_table(command: str) -> None:
    assert asked(command, "-o", "new.xlsx").status in (0, 1)
    book = openpyxl.load_workbook("new.xlsx")
    assert len(book.sheetnames) < 10
    values = [cell for sheet in book for row in sheet.iter_rows(values_only=True) for cell in row]
    assert sum(isinstance(one, float) for one in values) >= 4


@pytest.mark.parametrize("command", ASKED)
def test_tables_for_people_fit_a_terminal(command: str) -> None:
    shown = asked(command, text=GOOD).out
    assert max(map(len, shown.splitlines())) <= 80
    assert "\n\n" in shown


@pytest.mark.parametrize("name", ["moskvich412", "driveline-8hp70"])
def test_tables_of_shipped_cases_fit_a_terminal(name: str) -> None:
    case = CASES / f"{name}.yaml"
    for call in (
        ("modes", "--gear", "1"),
        ("response", "--at", "1", "--orders", "2,4,4.5,6", "--speed", "600:4000:3", "--sum"),
        *([("dump", "--rate", "50")] if name == "moskvich412" else []),
    ):
        shown = vstatics("torsion", call[0], case, *call[1:]).out.partition("\nMessages\n")[0]
        assert max(map(len, shown.splitlines())) <= 80, call[0]


def test_digits_are_those_asked_for() -> None:
    text = asked("modes", "--digits", "7", text=CHAIN.replace("name: ", "")).out
    assert re.search(r"\b\d*\.\d{7}\b", text)
    assert asked("modes", "--digits", "7", "-f", "json").status == 2


@pytest.mark.parametrize("command", ASKED)
def test_json_from_a_pipe_tells_its_file_as_other_commands_do(command: str) -> None:
    made = asked(command, "-f", "json", text=GOOD).json
    assert (made["file"], made["case"], made["version"]) == ("<stdin>", "two gears", 2)
    from_file = vstatics("torsion", command, "box.yaml", *ASKED[command], "-f", "json").out
    assert json.loads(from_file) == {**made, "file": "box.yaml"}


def test_a_case_without_a_name_is_called_by_its_file() -> None:
    assert said("modes", text=CHAIN).out.startswith("<stdin>\n")


@pytest.mark.parametrize("name", ["box.dat", "box.json", "box.txt"])
def test_the_input_may_be_of_any_format(name: str) -> None:
    case = vstatics("convert", "box.yaml", "-", "--to", "json").out
    Path(name).write_text(case, encoding="utf-8")
    found = vstatics("torsion", "modes", name, "--from", "json", "-f", "csv")
    assert found.out == said("modes", "-f", "csv", text=GOOD).out
    assert vstatics("torsion", "modes", name, "--from", "deck").status == 1


# files


@pytest.mark.parametrize("call", ALL, ids=lambda call: call[0])
def test_a_case_in_error_writes_nothing(call: tuple[str, ...]) -> None:
    Path("old.json").write_text("old", encoding="utf-8")
    answer = said(*call, "-o", "old.json", text=BOX.replace("474", "-474"))
    assert answer.gives_nothing(
        "<stdin>:8:46: error: springs.tyre.stiffness: read -474, expected a stiffness above 0"
    )
    assert Path("old.json").read_text(encoding="utf-8") == "old"
    assert names() == ["box.yaml", "old.json"]


@pytest.mark.parametrize("call", ALL, ids=lambda call: call[0])
def test_the_case_is_not_written_over(call: tuple[str, ...]) -> None:
    command, *options = call
    for output in ("box.yaml", "./box.yaml"):
        answer = vstatics("torsion", command, "box.yaml", *options, "-o", output)
        assert answer.is_wrong_use("box.yaml is what is read, and would be overwritten")
    assert Path("box.yaml").read_text(encoding="utf-8") == GOOD


@pytest.mark.parametrize("call", ALL, ids=lambda call: call[0])
@pytest.mark.parametrize("output", ["./", "out/", "new.xyz"])
def test_an_output_that_is_none_is_refused_before_anything_is_read(
    call: tuple[str, ...], output: str
) -> None:
    command, *options = call
    answer = vstatics("torsion", command, "nowhere.yaml", *options, "-o", output)
    assert (answer.status, answer.out, names()) == (2, "", ["box.yaml"])
    assert "nowhere" not in answer.err


@pytest.mark.parametrize("call", ALL, ids=lambda call: call[0])
def test_an_output_that_cannot_be_written_is_told(call: tuple[str, ...]) -> None:
    answer = said(*call, "-o", "no/new.json")
    assert answer.gives_nothing(
        "no/new.json: error: cannot be written: there is no directory no; create it"
    )


# gears


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
    assert (answer.status, free["rigid_modes"], stuck.keys()) == (1, 1, {"name", "error"})
    assert stuck["error"].startswith(why)
    assert "<stdin>:5:19: error: gear stuck: tied up: A and B let nothing move" in answer.err


def test_a_gear_that_holds_the_input_vibrates() -> None:
    """The engine stands; all frequencies are those of the rest on the damper."""
    answer = said("modes", "--gear", "tied", "-f", "json")
    [gear] = answer.json["gears"]
    assert (answer.status, gear["rigid_modes"], len(gear["modes"])) == (0, 1, 4)
    assert {mode["shape"]["engine"] for mode in gear["modes"]} == {0.0}


@pytest.mark.parametrize("command", STANDS)
def test_a_gear_that_has_no_answer_does_not_stop_the_others(command: str) -> None:
    answer = asked(command, "-f", "json")
    low, direct, tied, neutral = answer.json["gears"]
    assert answer.status == 1
    assert tied.keys() == {"name", "error"}
    assert tied["error"] == STANDS[command]
    assert not any("error" in gear for gear in (low, direct, neutral))
    assert f"<stdin>:20:3: error: gear tied: {STANDS[command]}" in answer.err
    assert asked(command, "--gear", "low", "--gear", "N").status == 0
    for form in ("text", "csv", "markdown"):
        shown = asked(command, "-f", form)
        assert shown.status == 1
        assert STANDS[command] in (shown.err if (command, form) == CSV_OF_VALUES else shown.out)


@pytest.mark.parametrize("call", [("simplify", "--links", "2"), ("identify", "--omega", "5")])
def test_of_one_gear_that_is_tied_up_there_is_nothing(call: tuple[str, ...]) -> None:
    answer = said(*call, "--gear", "stuck", "-f", "json", text=STUCK)
    assert answer.gives_nothing(
        "<stdin>:5:19: error: gear stuck: tied up: A and B let nothing move"
    )


@pytest.mark.parametrize("call", ALL, ids=lambda call: call[0])
@pytest.mark.parametrize(
    ("gear", "hint"),
    [
        ("lwo", "did you mean `low`?"),
        ("9", "gears are low, direct, tied, N"),
        ("", "no gear ''"),
        ("0", "gears are"),
        ("-1", "gears are"),
    ],
)
def test_a_gear_that_is_not_there_is_wrong_use(call: tuple[str, ...], gear: str, hint: str) -> None:
    answer = said(*call, "--gear", gear)
    assert answer.is_wrong_use(hint)


ONE_GEAR = (
    ("simplify", "--links", "1"),
    ("identify", "--omega", "2"),
    ("damping", "--decrements", "t=.1"),
)


@pytest.mark.parametrize("call", ONE_GEAR, ids=lambda call: call[0])
def test_where_there_is_one_gear_it_need_not_be_named(call: tuple[str, ...]) -> None:
    """That of a case without gears, too."""
    without = said(*call, "-f", "json", text=CHAIN)
    assert (without.status, without.err) == (0, "")
    assert without.json["gear"] == "1"
    assert without.out == said(*call, "--gear", "1", "-f", "json", text=CHAIN).out


@pytest.mark.parametrize("call", ONE_GEAR, ids=lambda call: call[0])
def test_one_of_several_gears_must_be_named(call: tuple[str, ...]) -> None:
    answer = said(*call)
    assert answer.is_wrong_use("Missing option '--gear': gears are low, direct, tied, N")


# what is told, and the exit status


def test_a_warning_is_printed_unless_quiet_and_fails_if_strict() -> None:
    text = GOOD.replace("wheel, vehicle, casing]", "wheel, vehicle, casing, lost]")
    for options, status, is_told in (
        ([], 0, True),
        (["-q"], 0, False),
        (["--strict"], 1, True),
        (["-q", "--strict"], 1, False),
    ):
        answer = said("modes", *options, text=text)
        assert answer.status == status, options
        assert ("lost has neither an inertia nor a component" in answer.err) is is_told, options
        assert answer.out == said("modes", text=text).out
    quiet = "<stdin>: error: 1 warning (W503), which --strict makes fail; without -q it is shown\n"
    assert said("modes", "-q", "--strict", text=text).err == quiet


@pytest.mark.parametrize("command", STANDS)
def test_an_error_is_printed_whoever_is_quiet(command: str) -> None:
    answer = asked(command, "-q")
    assert answer.fails(STANDS[command])


@pytest.mark.parametrize("call", ALL, ids=lambda call: call[0])
def test_a_doubt_of_the_reader_is_told_and_fails_if_strict(call: tuple[str, ...]) -> None:
    text = GOOD.replace("ratio: -2}", "ratio: 2}")
    answer = said(*call, text=text)
    assert (answer.status, "warning: mechanisms.P: ratio 2 is not" in answer.err) == (0, True)
    strict = said(*call, "--strict", text=text)
    assert (strict.status, strict.out) == (1, answer.out)
    assert "ratio 2" not in said(*call, "-q", text=text).err


@pytest.mark.parametrize("command", [*TorsionCommands.modules])
def test_without_its_argument_or_with_two_it_is_wrong_use(command: str) -> None:
    assert vstatics("torsion", command).status == 2
    assert vstatics("torsion", command, "a.yaml", "b.yaml").status == 2


@pytest.mark.parametrize("call", ALL, ids=lambda call: call[0])
def test_a_file_that_is_not_there_gets_the_nearest_as_a_hint(call: tuple[str, ...]) -> None:
    command, *options = call
    answer = vstatics("torsion", command, "bos.yaml", *options)
    assert answer.gives_nothing()
    hint = "bos.yaml: error: cannot be read: No such file or directory; did you mean `box.yaml`?\n"
    assert answer.err == hint


def test_a_case_without_inertias_vibrates_nowhere() -> None:
    text = CHAIN.partition("\n")[2]
    answer = said("modes", text=text)
    assert answer.gives_nothing("<stdin>", "inertias: nothing has an inertia, so nothing vibrates")


def test_a_case_without_anything_elastic_has_rigid_modes_only() -> None:
    text = NEUTRAL + "inertias: {1: 1, 2: 2, 3: 3}\n"
    answer = said("modes", "-f", "json", text=text)
    assert (answer.status, answer.err.count("warning: gear ")) == (0, 2)
    assert "nothing is elastic; expected `springs`" in answer.err
    gears = answer.json["gears"]
    assert [(one["rigid_modes"], one["modes"]) for one in gears] == [(2, []), (1, [])]


def test_without_scipy_it_is_refused_before_anything_is_read(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    message = 'vstatics torsion needs the package scipy: pip install ".[torsion]" in the source folder, or pip install scipy\n'
    for command, *options in ALL:
        answer = vstatics("torsion", command, "nowhere.yaml", *options, "-o", "new.json")
        assert (answer.status, answer.all, names()) == (1, message, ["box.yaml"])


# null


def no_constant(text: str) -> Any:
    raise AssertionError(text)


@pytest.mark.parametrize("call", ALL, ids=lambda call: call[0])
def test_json_has_null_and_no_nan(call: tuple[str, ...]) -> None:
    text = BOX.replace("casing]\noutput", "casing, lost]\noutput")
    answer = said(*call, "-f", "json", text=text)
    json.loads(answer.out, parse_constant=no_constant)


def test_what_does_not_exist_is_null_in_json_and_empty_in_csv() -> None:
    text = GOOD.replace("casing]\noutput", "casing, lost]\noutput")
    [gear] = document("modes", text=text)["gears"]
    assert {mode["shape"]["lost"] for mode in gear["modes"]} == {None}
    rows = tables(said("modes", "-f", "csv", text=text).out)["Gear direct: amplitudes of links"]
    [lost] = [row for row in rows if row[0] == "lost"]
    assert lost[1:] == [""] * len(gear["modes"])
    [gear] = document("response", *ASKED["response"][:4], "--speed", "0,100", text=CHAIN_AT)[
        "gears"
    ]
    assert [one is None for one in gear["orders"][0]["amplitudes"]["engine"]] == [True, False]


CHAIN_AT = CHAIN.replace("a:", "engine:").replace("[a,", "[engine,")
"""Masses that turn freely, the first of them called as that of the box."""
