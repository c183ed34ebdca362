"""Going on with a run into a directory: what is left out, what is calculated again."""

import json
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.commands import BAD, MZKT, NEUTRAL, TIED_UP, Said, json_file, vstatics

CASES = ("mzkt.dat", "neutral.yaml", "tied.yaml", "bad.yaml")
RECORD = Path("out/.vstatics-run-json")


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    """Four cases that were calculated an hour after they were written; one is bad, one tied up."""
    (folder / "mzkt.dat").write_bytes(MZKT.read_bytes())
    for name, text in (("neutral", NEUTRAL), ("tied", TIED_UP), ("bad", BAD)):
        (folder / f"{name}.yaml").write_text(text, "utf-8")
    for name in CASES:
        os.utime(name, (0, Path(name).stat().st_mtime - 3600))
    assert vstatics("run", *CASES, "-o", "out", "-f", "json").status == 1


def resume(*arguments: str, cases: tuple[str, ...] = CASES) -> Said:
    return vstatics("run", *cases, "-o", "out", "-f", "json", "--resume", *arguments)


def resumed(*arguments: str, summary: str = "cases calculated") -> list[str]:
    """Overwrite all results, go on; which of them were calculated again."""
    for path in Path("out").glob("*.json"):
        times = path.stat()
        path.write_text("mark".ljust(times.st_size), "utf-8")
        os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
    assert resume(*arguments).fails(summary)
    made = [path for path in Path("out").glob("*.json") if path.read_text("utf-8")[:4] != "mark"]
    return sorted(path.stem for path in made)


def test_what_is_done_is_left_out_and_failures_are_tried_again() -> None:
    """The case that is tied up has a result, and fails all the same."""
    summary = "3 of 4 cases calculated (2 of them before), 1 with errors, 1 failed:"
    for options in ((), ("--jobs", "2"), ("--lang", "ru")):  # the language is for listings
        assert resumed(*options, summary=summary) == ["tied"]


def replace_case(age: int | None = None) -> None:
    """Replace a case by another file, which can be older, as `cp -p` and `mv` do."""
    Path("other.dat").write_bytes(MZKT.read_bytes() + b"\n")
    if age is not None:
        os.utime("other.dat", (0, age))
    Path("other.dat").replace("mzkt.dat")


def link_case(end: bytes) -> None:
    Path("mzkt.dat").unlink()
    Path("other.dat").write_bytes(MZKT.read_bytes() + end)
    Path("mzkt.dat").symlink_to("other.dat")


RESULT = Path("out/mzkt.json")
STRANGE = '[[], "", "", [], false]\n{}\n7\n["a", {}, [], null, 0]\n["neutral.js'
"""Lines of a record; the last one may have been cut, anybody may have written the others."""


@pytest.mark.parametrize(
    ("disturb", "again"),
    [
        (replace_case, ["mzkt", "tied"]),
        (lambda: replace_case(age=0), ["mzkt", "tied"]),
        (Path("mzkt.dat").touch, ["tied"]),
        (lambda: link_case(b""), ["tied"]),
        (lambda: link_case(b"\n"), ["mzkt", "tied"]),
        (lambda: RECORD.write_text(RECORD.read_text("utf-8") + STRANGE, "utf-8"), ["tied"]),
        (lambda: Path("tied.yaml").write_text(NEUTRAL), ["tied"]),
        (lambda: RESULT.write_text(RESULT.read_text("utf-8"), "utf-8"), ["mzkt", "tied"]),
        (lambda: RESULT.write_text("", "utf-8"), ["mzkt", "tied"]),
        (RESULT.unlink, ["mzkt", "tied"]),
    ],
)
def test_what_was_changed_is_calculated_again(
    disturb: Callable[[], object], again: list[str]
) -> None:
    """A later time alone is no change; a case that is mended counts as done later.

    A result may be written again by another program, by a run without a record, or by a power cut.
    """
    disturb()
    assert resumed() == again
    is_mended = Path("tied.yaml").read_text() == NEUTRAL
    assert resumed() == ([] if is_mended else ["tied"])


def test_a_result_of_another_case_of_the_same_name_does_not_count() -> None:
    """Nor if a run was stopped before it came to that case."""
    Path("other").mkdir()
    other = Path("other/neutral.yaml")
    other.write_text(Path("neutral.yaml").read_text("utf-8") + "\n", "utf-8")
    os.utime(other, (0, Path("neutral.yaml").stat().st_mtime))
    names = tuple(str(other) if case == "neutral.yaml" else case for case in CASES)
    assert "calculated" not in resume(cases=(f"{names[0]}",)).err
    for before in (1, 2):
        assert f"3 of 4 cases calculated ({before} of them before)" in resume(cases=names).err


def test_results_from_before_the_run_do_not_count() -> None:
    """A run with other options was stopped before it came to the second case."""
    for path in Path("out").iterdir():
        os.utime(path, (0, path.stat().st_mtime - 1800))
    vstatics("run", "mzkt.dat", "-f", "json", "--coast", "-o", "out/")
    assert resumed("--coast") == ["neutral", "tied"]


def test_another_run_is_not_mixed_in() -> None:
    for option, words in (
        ("--coast", "--coast was not given, is true"),
        ("--drive", "--coast was not given, is false"),
        ("--unloaded exact", '--unloaded was not given, is "exact"'),
        ("--from yaml", '--from was not given, is "yaml"'),
        ("--strict", "--strict was false, is true"),
        ("--allow W414", '--allow was not given, is ["W414"]'),
    ):
        before = Path("out/mzkt.json").stat()
        said = resume(*option.split())
        assert said.is_wrong_use(f"({words}): use the same options, or calculate all")
        assert Path("out/mzkt.json").stat() == before


def test_each_format_has_a_run_of_its_own() -> None:
    call = "run", *CASES, "-o", "out", "--resume"
    none = "out: there is no earlier run to resume; every case is calculated\n"
    assert none in vstatics(*call).err
    assert resumed() == ["tied"]
    assert vstatics(*call, "--lang", "ru").is_wrong_use('--lang was "en", is "ru"')


def test_results_of_another_build_are_calculated_again_with_a_word() -> None:
    """A record of before builds were told has a version in their place, and other lines."""
    first, *lines = RECORD.read_text("utf-8").splitlines()
    options = {key: value for key, value in json.loads(first).items() if key != "build"}
    for earlier in ({"build": "0123456789ab", **options}, {"version": "0.1.0", **options}):
        RECORD.write_text("\n".join([json.dumps(earlier), *lines]), "utf-8")
        said = resume().err
        words = "the finished work belongs to another build of vstatics; every case is calculated"
        assert said.startswith(f"out: {words}\n")
        assert "3 of 4 cases calculated, 1 with errors, 1 failed:" in said
        assert resumed() == ["tied"]


def test_results_of_another_run_are_not_taken_for_those_of_this_one() -> None:
    """As a run left them that wrote its lines into the record of a later one."""
    lines = RECORD.read_text("utf-8").splitlines()[1:]
    vstatics("run", "bad.yaml", "-o", "out/", "-f", "json", "--coast")
    with RECORD.open("a", encoding="utf-8") as record:
        record.write("\n".join(lines) + "\n")
    assert resumed("--coast") == ["mzkt", "neutral", "tied"]


@pytest.mark.parametrize("record", [None, b"", b"{", b"[]", b"null", b'{"began": "x"}', b"\xff"])
def test_without_a_record_everything_is_calculated(record: bytes | None) -> None:
    RECORD.unlink()
    if record is not None:
        RECORD.write_bytes(record)
    summary = "3 of 4 cases calculated, 1 with errors, 1 failed:"
    assert resumed(summary=summary) == ["mzkt", "neutral", "tied"]
    assert resumed() == ["tied"]


def test_standard_input_is_never_left_out() -> None:
    given = ("run", "-", "mzkt.dat", "-o", "new", "--resume")
    for _ in range(2):
        said = vstatics(*given, stdin=MZKT.read_bytes())
    assert said.err == "2 of 2 cases calculated (1 of them before)\n"


def test_a_case_whose_file_of_points_was_changed_is_calculated_again() -> None:
    """A drag of 1 N*m, then of 3, takes 5 %, then 15 % of 20 N*m."""
    text = (
        "links: [a, b]\nload: {speed: 1000 rpm, torque: 20 N*m}\ngears: {g: []}\n"
        "mechanisms: {p: {first: a, second: b, ratio: -2}}\ndrag: {a: {file: drag.csv}}\n"
    )
    Path("drag.yaml").write_text(text, "utf-8")
    result, found = Path("points/drag.json"), []
    for torque in (1, 1, 3):
        Path("drag.csv").write_text(f"speed [rad/s],torque [N*m]\n0,{torque}\n", "utf-8")
        command = ("run", "drag.yaml", "-o", "points/", "-f", "json", "--resume", "-q")
        assert vstatics(*command).status == 0
        [efficiency] = json_file(result)["efficiency"]
        found.append((efficiency, result.stat().st_mtime_ns))
    (first, written), again, (changed, _) = found
    assert (first, changed) == (pytest.approx(0.95), pytest.approx(0.85))
    assert again == (first, written)


def test_messages_are_allowed_alike_in_any_case() -> None:
    """A warning that was allowed when a result was made would never be told of it."""
    call = ["run", "neutral.yaml", "-q", "--strict", "-f", "json", "-o", "gate/"]
    for more in (["--allow", "w414"], ["--allow", "W414", "--resume"]):
        assert vstatics(*call, *more).status == 0
    assert vstatics(*call, "--resume").is_wrong_use("--allow was")
