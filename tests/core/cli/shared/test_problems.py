"""What is printed of warnings and notes, and what they do to the exit status."""

import re
from pathlib import Path

import pytest

from tests.commands import MZKT, NEUTRAL, on_terminal, vstatics

WARNED = "open.yaml"
"""A and B hold the same link in one gear."""
NOTED = str(MZKT)
"""Mechanisms that may share planets are worth a note, no more."""
READING = {
    **{name: [name] for name in ("run", "check", "flow", "summary", "explain")},
    "report": ["report", "-o", "page.html"],
    "plot": ["plot", "--kind", "structure", "-o", "plot.svg"],
}
"""Call of each command that calculates a case."""
QUIET_FAILURE = "error: 1 warning ({}), so --strict fails; run without -q to see it\n"
VARIED = ["sweep", "doubtful.yaml", "--vary", "D.efficiency=.9,.95"]


@pytest.fixture(autouse=True)
def _here(files: Path) -> None:
    text = NEUTRAL.replace("-2.5", "2.5").replace("N: {}, ", "")
    (files / "doubtful.yaml").write_text(text, "utf-8")


@pytest.mark.usefixtures("without_pictures")
@pytest.mark.parametrize("command", READING)
def test_problems_are_printed_unless_quiet_and_fail_if_strict(command: str) -> None:
    """Errors always; notes by `check` alone, and they never fail."""
    call = [*READING[command], WARNED]
    plain = vstatics(*call)
    for options, status, is_told in (([], 0, True), (["-q"], 0, False), (["--strict"], 1, True)):
        said = vstatics(*call, *options)
        assert said.status == status, options
        assert ("warning: gear both: A and B impose" in said.err) is is_told, options
    said = vstatics(*call, "--quiet", "--strict")
    assert (said.status, said.out) == (1, plain.out)
    assert said.err == f"open.yaml: {QUIET_FAILURE.format('W416')}"
    for case in ("bad.yaml", "tied.yaml"):
        said = vstatics(*READING[command], "-q", case)
        assert said.fails("error: ")
        assert "warning" not in said.err
    said = vstatics(*READING[command], NOTED, "--strict")
    assert (said.status, "note: " in said.err) == (0, command == "check")
    assert "note: " not in vstatics(*READING[command], NOTED, "-q").err


def test_commands_without_results_tell_the_warnings_of_the_input() -> None:
    for call in (
        ["convert", "doubtful.yaml", "-", "--to", "json"],
        VARIED,
        [*VARIED, "-o", "out.csv"],
        [*VARIED, "--dry-run"],
    ):
        said = vstatics(*call)
        assert (said.status, "warning: " in said.err) == (0, True)
        assert vstatics(*call, "--strict").status == 1
        quiet = vstatics(*call, "-q", "--strict")
        assert quiet.status == 1
        assert quiet.err.endswith(f": {QUIET_FAILURE.format('W201')}")


def test_what_a_command_allows_is_not_part_of_the_case() -> None:
    """It is for the call: a case that is written, and a result, are what they are without it."""
    for call in (["convert", "doubtful.yaml", "-", "--to", "json"], ["run", WARNED, "-f", "json"]):
        told, allowed = vstatics(*call), vstatics(*call, "--allow", "W201,w416")
        assert ("warning: " in told.err, allowed.err) == (True, "")
        assert "W416" not in allowed.out
    assert allowed.json["case"] == told.json["case"]


@pytest.mark.parametrize("command", ["check", "run", "flow", "sweep"])
def test_an_allowed_warning_is_also_suppressed_beside_an_error(command: str) -> None:
    """A misspelled key is an error; no simple planetary gear set has a basic ratio of 2.5."""
    wrong = Path("doubtful.yaml").read_text("utf-8") + "nmae: box\n"
    call = [command, "-", *["--vary", "D.efficiency=.9"][: 2 * (command == "sweep")]]
    for text, options in ((wrong, ["--allow", "w201"]), (f"{wrong}allow: [W201]\n", [])):
        assert "warning: mechanisms.D: " in vstatics(*call, stdin=wrong.encode()).err
        said = vstatics(*call, *options, stdin=text.encode())
        assert said.fails("error: unknown key `nmae`")
        assert "warning: " not in said.err


def test_a_quiet_sweep_counts_where_variants_are_unlike() -> None:
    call = ["sweep", "neutral.yaml", "--vary", "D.ratio=-2,-3", "--out", "ratio[low]", "-q"]
    assert vstatics(*call).err == ""
    Path("tied.csv").write_text("D.efficiency\n.9\n.8\n", "utf-8")
    said = vstatics("sweep", "tied.yaml", "--variants", "tied.csv", "-q")
    assert "2 tied up" in said.err


def test_errors_of_a_text_are_reported_without_its_warnings() -> None:
    """A deck that is cut off before its last field, with a link 9 of 6; then only cut off."""
    cut_off = MZKT.read_text("utf-8").rpartition("KM Z(I)")[0]
    deck = cut_off.replace("1 1 4", "1 1 9", 1).encode()
    for call in (["convert", "-", "-", "--to", "json"], ["run", "-"]):
        assert "warning: " in vstatics(*call, stdin=deck).err
        quiet = vstatics(*call, "-q", stdin=deck)
        assert quiet.fails("error: ")
        assert "warning: " not in quiet.err
    said = vstatics("check", "-", stdin=cut_off.encode()).err
    assert re.findall("(?m)^<stdin>:[0-9:]+ (warning|note): ", said) == ["warning", "note"]


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize("output", ["out/", "all.json"])
def test_the_count_stays_unless_all_is_well(jobs: int, output: str) -> None:
    """A strict run that failed fails again when it is resumed."""
    call = ["run", WARNED, "locked.yaml", "-f", "json", "-o", output, "-j", jobs]
    assert vstatics(*call).err.splitlines()[-1] == "2 of 2 cases calculated"
    assert vstatics(*call, "-q") == (0, "", "")
    for more in [[], ["--resume"]][: 2 if output == "out/" else 1]:
        said = vstatics(*call, "-q", "--strict", *more)
        count, first, second = said.err.splitlines()
        assert (said.status, count[:23]) == (1, "2 of 2 cases calculated")
        assert count.endswith("2 with errors or warnings:")
        assert re.match(r"  open\.yaml:4:\d+: warning: gear both: ", first)
        assert second.startswith("  locked.yaml:")
    last = vstatics(*call, "tied.yaml", "-q").err.splitlines()[-2]
    assert last.startswith("3 of 3 cases calculated, 1 with")


def test_a_quiet_run_mentions_no_earlier_run_and_draws_no_bar(files: Path) -> None:
    call = ["run", "locked.yaml", "-f", "json", "-o", "out/", "--resume"]
    assert "there is no earlier run to resume" in vstatics(*call).err
    Path("out/.vstatics-run-json").unlink()
    assert vstatics(*call, "-q").err == ""
    call = ["sweep", "doubtful.yaml", "--vary", "D.ratio=2:3:5000", "-o", "out.csv"]
    assert "\x1b[" in on_terminal(*call, cwd=files)
    assert on_terminal(*call, "-q", cwd=files) == ""


def test_one_text_about_several_gears_is_one_line_and_a_message_of_each() -> None:
    text = NEUTRAL.replace("N: {}", "N: {}, P: {}")
    said = vstatics("run", "-", "-f", "json", stdin=text.encode())
    [warning] = [line for line in said.err.splitlines() if "warning" in line]
    assert warning.startswith("<stdin>:4:9: warning: gears N and P: neutral: one more shift")
    assert "nothing supports the input torque" in warning
    told = [one.partition(": neutral")[0] for one in said.json["messages"]]
    assert told == ["warning: gear N", "warning: gear P"]
