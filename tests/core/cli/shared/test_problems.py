"""What is printed of warnings and notes, and what they do to the exit status."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.commands import MZKT, NEUTRAL, TIED_UP, on_terminal, vstatics

WARNED = "open.yaml"
"""A and B hold the same link in one gear."""
NOTED = str(MZKT)
"""Mechanisms that may share planets are worth a note, no more."""
READING = {
    "run": ["run"],
    "check": ["check"],
    "flow": ["flow"],
    "summary": ["summary"],
    "explain": ["explain"],
    "report": ["report", "-o", "page.html"],
    "plot": ["plot", "--kind", "structure", "-o", "plot.svg"],
}
"""How each command is called that calculates a case."""


@pytest.fixture(autouse=True)
def _here(files: Path) -> None:
    (files / "doubtful.yaml").write_text(
        NEUTRAL.replace("-2.5", "2.5").replace("N: {}, ", ""), encoding="utf-8"
    )


QUIET_FAILURE = (
    "open.yaml: error: 1 warning (W416), which --strict makes fail; without -q it is shown\n"
)


@pytest.mark.usefixtures("without_pictures")
@pytest.mark.parametrize("command", READING)
def test_a_warning_is_printed_unless_quiet_and_fails_if_strict(command: str) -> None:
    call = [*READING[command], WARNED]
    for options, status, is_told in (
        ([], 0, True),
        (["-q"], 0, False),
        (["--strict"], 1, True),
        (["--quiet", "--strict"], 1, False),
    ):
        said = vstatics(*call, *options)
        assert said.status == status, options
        assert ("warning: gear both: A and B impose" in said.err) is is_told, options
        assert is_told or said.err == (QUIET_FAILURE if status else "")
    assert vstatics(*call, "-q", "--strict").out == vstatics(*call).out


@pytest.mark.parametrize("command", READING)
@pytest.mark.parametrize("case", ["bad.yaml", "tied.yaml"])
def test_errors_are_printed_whoever_is_quiet(command: str, case: str) -> None:
    said = vstatics(*READING[command], "-q", case)
    assert said.fails("error: ")
    assert "warning" not in said.err


@pytest.mark.usefixtures("without_pictures")
@pytest.mark.parametrize("command", READING)
def test_a_note_does_not_fail_and_is_told_by_check_alone(command: str) -> None:
    said = vstatics(*READING[command], NOTED, "--strict")
    assert said.status == 0
    assert ("note: " in said.err) is (command == "check")
    assert "note: " not in vstatics(*READING[command], NOTED, "-q").err


@pytest.mark.parametrize(
    "call",
    [
        ["convert", "doubtful.yaml", "-", "--to", "json"],
        ["sweep", "doubtful.yaml", "--vary", "D.efficiency=.9,.95"],
        ["sweep", "doubtful.yaml", "--vary", "D.efficiency=.9,.95", "-o", "out.csv"],
        ["sweep", "doubtful.yaml", "--vary", "D.efficiency=.9,.95", "--dry-run"],
    ],
)
def test_commands_without_results_tell_the_warnings_of_the_input(call: list[str]) -> None:
    assert vstatics(*call).status == 0
    assert "warning: " in vstatics(*call).err
    assert vstatics(*call, "--strict").status == 1
    quiet = vstatics(*call, "-q", "--strict")
    assert quiet.status == 1
    assert quiet.err.endswith(
        ": error: 1 warning (W201), which --strict makes fail; without -q it is shown\n"
    )


def test_a_quiet_sweep_counts_where_variants_are_unlike() -> None:
    """At a ratio of 1 the held link of the differential stops its output."""
    call = ["sweep", "neutral.yaml", "--vary", "D.ratio=-2,-3", "--out", "ratio[low]", "-q"]
    assert vstatics(*call).err == ""
    Path("tied.csv").write_text("D.efficiency\n.9\n.8\n", encoding="utf-8")
    said = vstatics("sweep", "tied.yaml", "--variants", "tied.csv", "-q")
    assert "2 tied up" in said.err


def test_errors_of_a_text_are_told_without_its_warnings() -> None:
    """A deck that is cut off before its last field, with a link 9 of 6."""
    deck = MZKT.read_text(encoding="utf-8").rpartition("KM Z(I)")[0].replace("1 1 4", "1 1 9", 1)
    for call in (["convert", "-", "-", "--to", "json"], ["run", "-"]):
        assert "warning: " in vstatics(*call, stdin=deck.encode()).err
        quiet = vstatics(*call, "-q", stdin=deck.encode())
        assert quiet.fails("error: ")
        assert "warning: " not in quiet.err


# several cases


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize("output", ["out/", "all.json"])
def test_the_count_stays_unless_all_is_well(jobs: int, output: str) -> None:
    call = ["run", WARNED, "locked.yaml", "-f", "json", "-o", output, "-j", jobs]
    assert vstatics(*call).err.splitlines()[-1] == "2 of 2 cases calculated"
    assert vstatics(*call, "-q") == (0, "", "")
    said = vstatics(*call, "-q", "--strict")
    assert said.status == 1
    count, first, second = said.err.splitlines()
    assert count == "2 of 2 cases calculated, 2 with errors or warnings:"
    assert first.startswith("  open.yaml:4:")
    assert "warning: gear both: " in first
    assert second.startswith("  locked.yaml:")
    assert (
        vstatics(*call, "tied.yaml", "-q")
        .err.splitlines()[-2]
        .startswith("3 of 3 cases calculated, 1 with")
    )


def test_a_list_of_cases_is_strict_too() -> None:
    call = ["run", "--files-from", "-", "-f", "jsonl", "-q"]
    assert vstatics(*call, "--strict", stdin=WARNED.encode()).status == 1
    assert vstatics(*call, "--strict", stdin=NOTED.encode()).status == 0


def test_what_a_run_that_was_not_strict_has_done_is_no_proof_for_one_that_is() -> None:
    call = ["run", WARNED, "-f", "json", "-o", "out/"]
    assert vstatics(*call).status == 0
    said = vstatics(*call, "--resume", "--strict")
    assert said.is_wrong_use("--strict was false, is true")
    assert vstatics(*call, "--strict").status == 1
    assert vstatics(*call, "--resume", "--strict").status == 1


def test_what_was_done_before_is_not_mentioned_quietly() -> None:
    call = ["run", "locked.yaml", "-f", "json", "-o", "out/", "--resume"]
    assert "there is no earlier run to resume" in vstatics(*call).err
    Path("out/.vstatics-run-json").unlink()
    assert vstatics(*call, "-q").err == ""


def test_no_bar_is_drawn_quietly(files: Path) -> None:
    (files / "tied.yaml").write_text(TIED_UP, encoding="utf-8")
    call = ["sweep", "neutral.yaml", "--vary", "D.ratio=-3:-2:5000", "-o", "out.csv"]
    assert "\x1b[" in on_terminal(*call, cwd=files)
    assert on_terminal(*call, "-q", cwd=files) == ""


# each once


def test_one_text_about_several_gears_is_one_line_and_a_message_of_each() -> None:
    text = NEUTRAL.replace("N: {}", "N: {}, P: {}")
    said = vstatics("run", "-", "-f", "json", stdin=text.encode())
    [warning] = [line for line in said.err.splitlines() if "warning" in line]
    assert warning.startswith("<stdin>:4:9: warning: gears N and P: neutral: one more shift")
    assert "nothing supports the input torque" in warning
    told = [one.partition(": neutral")[0] for one in said.json["messages"]]
    assert told == ["warning: gear N", "warning: gear P"]


def test_shared_torques_are_told_with_the_element_in_excess() -> None:
    said = vstatics("run", "open.yaml").err
    [warning] = [line for line in said.splitlines() if "warning" in line]
    assert warning.endswith(
        "gear both: A and B impose the same constraint on the speeds, so one is redundant; the "
        "torque of B and A is indeterminate, release one"
    )


def test_notes_stand_behind_the_warnings() -> None:
    text = MZKT.read_text(encoding="utf-8").rpartition("KM Z(I)")[0]
    said = vstatics("check", "-", stdin=text.encode()).err
    told = re.findall("(?m)^<stdin>:[0-9:]+ (warning|note): ", said)
    assert told == ["warning", "note"]
