"""Going on with a run into a directory: what is left out, what is calculated again."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from tests.commands import BAD, MZKT, NEUTRAL, TIED_UP, vstatics


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    """Four cases that were calculated an hour after they were written; one is bad, one tied up."""
    (folder / "mzkt.dat").write_bytes(MZKT.read_bytes())
    for name, text in (("neutral", NEUTRAL), ("tied", TIED_UP), ("bad", BAD)):
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
    for name in CASES:
        os.utime(name, (0, Path(name).stat().st_mtime - 3600))
    assert vstatics("run", *CASES, "-o", "out", "-f", "json").status == 1


CASES = ("mzkt.dat", "neutral.yaml", "tied.yaml", "bad.yaml")


def resumed(*arguments: str) -> tuple[list[str], str]:
    """Overwrite all results, go on; which of them were calculated again, and what was said last."""
    for path in Path("out").glob("*.json"):
        times = path.stat()
        path.write_text("mark".ljust(times.st_size), encoding="utf-8")
        os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
    said = vstatics("run", *CASES, "-o", "out", "-f", "json", "--resume", *arguments)
    assert said.status == 1
    made = [one for one in Path("out").glob("*.json") if one.read_text("utf-8")[:4] != "mark"]
    summary = next(line for line in said.err.splitlines() if "cases calculated" in line)
    return sorted(path.stem for path in made), summary


def test_what_is_done_is_left_out_and_failures_are_tried_again() -> None:
    """The case that is tied up has a result, and fails all the same."""
    summary = "3 of 4 cases calculated (2 of them before), 1 with errors, 1 failed:"
    assert resumed() == (["tied"], summary)
    assert resumed("--jobs", "2") == (["tied"], summary)


def test_a_case_that_was_changed_is_calculated_again() -> None:
    """A later time alone is no change."""
    Path("mzkt.dat").touch()
    assert resumed()[0] == ["tied"]
    Path("mzkt.dat").write_bytes(MZKT.read_bytes() + b"\n")
    assert resumed()[0] == ["mzkt", "tied"]


def test_a_result_that_somebody_wrote_since_is_calculated_again() -> None:
    """Another program, another run without a record; or a power cut left it empty."""
    result = Path("out/neutral.json")
    for text in ("", result.read_text("utf-8")):
        result.write_text(text, encoding="utf-8")
        assert resumed()[0] == ["neutral", "tied"]


def test_a_case_that_an_older_file_replaced_is_calculated_again() -> None:
    """As `cp -p`, `mv` and the unpacking of an archive do."""
    Path("older.yaml").write_text(NEUTRAL + "\n", encoding="utf-8")
    os.utime("older.yaml", (0, 0))
    Path("older.yaml").replace("neutral.yaml")
    assert resumed()[0] == ["neutral", "tied"]


def swapped(name: str) -> list[str]:
    """All cases, one of them another file of the same name, as old as that."""
    Path("other").mkdir(exist_ok=True)
    path = Path("other", name)
    path.write_text(Path(name).read_text("utf-8") + "\n", encoding="utf-8")
    os.utime(path, (0, Path(name).stat().st_mtime))
    return [str(path) if case == name else case for case in CASES]


def test_a_result_of_another_case_of_the_same_name_does_not_count() -> None:
    names = swapped("neutral.yaml")
    said = vstatics("run", *names, "-o", "out", "-f", "json", "--resume")
    assert "3 of 4 cases calculated (1 of them before)" in said.err
    again = vstatics("run", *names, "-o", "out", "-f", "json", "--resume")
    assert "3 of 4 cases calculated (2 of them before)" in again.err


def test_a_run_that_was_stopped_says_nothing_of_cases_that_it_did_not_reach() -> None:
    """The old result is still there, of the other case of that name."""
    names = swapped("neutral.yaml")
    first = vstatics("run", names[0], "-o", "out/", "-f", "json", "--resume")
    assert "calculated" not in first.err  # one case alone tells nothing
    said = vstatics("run", *names, "-o", "out", "-f", "json", "--resume")
    assert "(1 of them before)" in said.err


def test_a_case_that_was_mended_is_done_once() -> None:
    Path("tied.yaml").write_text(NEUTRAL, encoding="utf-8")
    assert resumed()[0] == ["tied"]
    assert resumed()[0] == []


def test_a_link_that_leads_elsewhere_leads_to_another_case() -> None:
    Path("mzkt.dat").rename("first.dat")
    Path("second.dat").write_bytes(MZKT.read_bytes() + b"\n")
    Path("mzkt.dat").symlink_to("first.dat")
    assert resumed()[0] == ["tied"]
    Path("mzkt.dat").unlink()
    Path("mzkt.dat").symlink_to("second.dat")
    assert resumed()[0] == ["mzkt", "tied"]


def test_a_result_that_is_not_there_is_made() -> None:
    Path("out/neutral.json").unlink()
    assert resumed()[0] == ["neutral", "tied"]
    assert resumed()[0] == ["tied"]


def test_results_from_before_the_run_do_not_count() -> None:
    """A run with other options was stopped before it came to the second case."""
    for path in Path("out").iterdir():
        os.utime(path, (0, path.stat().st_mtime - 1800))
    vstatics("run", "mzkt.dat", "-f", "json", "--coast", "-o", "out/")
    assert resumed("--coast")[0] == ["neutral", "tied"]


def test_a_corrected_case_counts_as_done_later() -> None:
    Path("tied.yaml").write_text(NEUTRAL, encoding="utf-8")
    Path("bad.yaml").write_text(NEUTRAL, encoding="utf-8")
    said = vstatics("run", *CASES, "-o", "out", "-f", "json", "--resume")
    assert said.status == 0
    assert said.err.endswith("4 of 4 cases calculated (2 of them before)\n")


@pytest.mark.parametrize(
    ("option", "words"),
    [
        ("--coast", "--coast was not given, is true"),
        ("--drive", "--coast was not given, is false"),
        ("--unloaded exact", '--unloaded was not given, is "exact"'),
        ("--from yaml", '--from was not given, is "yaml"'),
    ],
)
def test_another_run_is_not_mixed_in(option: str, words: str) -> None:
    result = Path("out/mzkt.json")
    before = result.stat()
    said = vstatics("run", *CASES, "-o", "out", "-f", "json", "--resume", *option.split())
    assert (said.status, result.stat()) == (2, before)
    assert f"({words}): use the same options, or calculate all" in said.err


def test_the_language_counts_for_listings_only() -> None:
    assert resumed("--lang", "ru")[0] == ["tied"]
    vstatics("run", *CASES, "-o", "out")
    said = vstatics("run", *CASES, "-o", "out", "--resume", "--lang", "ru")
    assert said.is_wrong_use('--lang was "en", is "ru"')


def test_results_of_another_build_are_calculated_again_with_a_word() -> None:
    """A record of before builds were told has a version in their place, and other lines."""
    path = Path("out/.vstatics-run-json")
    first, *lines = path.read_text(encoding="utf-8").splitlines()
    options = {key: value for key, value in json.loads(first).items() if key != "build"}
    for earlier in ({"build": "0123456789ab", **options}, {"version": "0.1.0", **options}):
        path.write_text("\n".join([json.dumps(earlier), *lines]), encoding="utf-8")
        said = vstatics("run", *CASES, "-o", "out", "-f", "json", "--resume")
        assert said.err.startswith(
            "out: the finished work belongs to another build of vstatics; every case is calculated\n"
        )
        assert "3 of 4 cases calculated, 1 with errors, 1 failed:" in said.err
        assert resumed()[0] == ["tied"]


def test_results_of_another_run_are_not_taken_for_those_of_this_one() -> None:
    """As a run left them that wrote its lines into the record of a later one."""
    path = Path("out/.vstatics-run-json")
    lines = path.read_text(encoding="utf-8").splitlines()[1:]
    vstatics("run", "bad.yaml", "-o", "out/", "-f", "json", "--coast")
    with path.open("a", encoding="utf-8") as record:
        record.write("\n".join(lines) + "\n")
    assert resumed("--coast")[0] == ["mzkt", "neutral", "tied"]


@pytest.mark.parametrize("record", [None, b"", b"{", b"[]", b"null", b'{"began": "x"}', b"\xff"])
def test_without_a_record_everything_is_calculated(record: bytes | None) -> None:
    path = Path("out/.vstatics-run-json")
    path.unlink()
    if record is not None:
        path.write_bytes(record)
    made, summary = resumed()
    assert (made, summary) == (
        ["mzkt", "neutral", "tied"],
        "3 of 4 cases calculated, 1 with errors, 1 failed:",
    )
    assert resumed()[0] == ["tied"]


def test_lines_of_a_record_that_are_none_are_passed_over() -> None:
    """The last one may have been cut; anybody may have written the others."""
    with Path("out/.vstatics-run-json").open("a", encoding="utf-8") as record:
        record.write('[[], "", "", [], false]\n{}\n7\n["a", {}, [], null, 0]\n["neutral.js')
    assert resumed()[0] == ["tied"]


def test_each_format_has_a_run_of_its_own() -> None:
    said = vstatics("run", *CASES, "-o", "out", "--resume")
    assert "out: there is no earlier run to resume; every case is calculated\n" in said.err
    assert resumed()[0] == ["tied"]


def test_standard_input_is_never_left_out() -> None:
    given = ("run", "-", "mzkt.dat", "-o", "new", "--resume")
    for _ in range(2):
        said = vstatics(*given, stdin=MZKT.read_bytes())
    assert said.err == "2 of 2 cases calculated (1 of them before)\n"


def test_a_case_whose_file_of_points_was_changed_is_calculated_again() -> None:
    """A drag of 1 N*m, then of 3, takes 5 %, then 15 % of 20 N*m."""
    Path("drag.csv").write_text("speed [rad/s],torque [N*m]\n0,1\n", encoding="utf-8")
    text = (
        "links: [a, b]\nload: {speed: 1000 rpm, torque: 20 N*m}\ngears: {g: []}\n"
        "mechanisms: {p: {first: a, second: b, ratio: -2}}\ndrag: {a: {file: drag.csv}}\n"
    )
    Path("drag.yaml").write_text(text, encoding="utf-8")
    command = ("run", "drag.yaml", "-o", "points/", "-f", "json", "--resume", "-q")
    found = []
    for torque in (1, 1, 3):
        Path("drag.csv").write_text(f"speed [rad/s],torque [N*m]\n0,{torque}\n", encoding="utf-8")
        assert vstatics(*command).status == 0
        result = Path("points/drag.json")
        found.append(
            (json.loads(result.read_text("utf-8"))["efficiency"][0], result.stat().st_mtime_ns)
        )
    (first, written), again, (changed, _) = found
    assert (first, changed) == (pytest.approx(0.95), pytest.approx(0.85))
    assert again == (first, written)


def test_results_of_other_allowed_messages_are_no_results() -> None:
    """A warning that was allowed when a result was made would never be told of it."""
    call = ["run", "neutral.yaml", "-q", "--strict", "-f", "json", "-o", "gate/"]
    assert vstatics(*call, "--allow", "w414").status == 0
    assert vstatics(*call, "--allow", "W414", "--resume").status == 0
    said = vstatics(*call, "--resume")
    assert said.is_wrong_use("--allow was")
