"""Many cases in one file, JSON lines or Parquet: patterns, going on after a stop."""

import csv
import io
import os
import signal
from pathlib import Path

import pytest

from tests.commands import BAD, MZKT, NEUTRAL, Said, vstatics
from tests.core.cli.shared.test_many_stopped import ended, opened_for_reading
from tests.processes import names, running
from vstatics.core.cli.run import MANY
from vstatics.core.cli.shared import many

NAMES = ("drawer/a.dat", "drawer/deep/b.dat", "drawer/deep/c.dat")


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    """Three decks in two folders, and a bad one that no pattern here meets."""
    (folder / "drawer/deep").mkdir(parents=True)
    for name in NAMES:
        (folder / name).write_bytes(MZKT.read_bytes())
    (folder / "bad.yaml").write_text(BAD, "utf-8")
    (folder / "neutral.yaml").write_text(NEUTRAL, "utf-8")


def cases_of(*arguments: str) -> list[str]:
    """The cases in CSV, in their order."""
    rows = csv.DictReader(io.StringIO(vstatics("run", *arguments, "-q", "-f", "csv").out))
    return [name for name in dict.fromkeys(row["case"] for row in rows) if name]


def test_patterns_are_expanded_in_order_and_through_links_that_do_not_lead_up() -> None:
    """As in shells: a link that is named is a folder as any."""
    Path("drawer/up").symlink_to("..")
    Path("linked").symlink_to("drawer")
    assert cases_of("drawer/**/*.dat") == cases_of("**/*.dat") == [*NAMES]
    assert cases_of("linked/**/*.dat") == [name.replace("drawer", "linked") for name in NAMES]
    missing = vstatics("run", "drawer/*.yaml", "-f", "jsonl")
    assert missing.is_wrong_use("no file matches `drawer/*.yaml`")
    Path("odd[1].dat").write_bytes(MZKT.read_bytes())
    assert vstatics("run", "odd[1].dat", "-f", "json").status == 0


def test_a_file_that_a_pattern_finds_is_there_once() -> None:
    again = f"../{Path.cwd().name}/drawer/a.dat"
    named = ["./drawer/deep/c.dat", "drawer/deep/?.dat", "drawer/**/*.dat", "drawer/a.dat", again]
    assert cases_of(*named) == ["./drawer/deep/c.dat", "drawer/deep/b.dat", "drawer/a.dat"]


def test_parquet_has_the_rows_of_csv() -> None:
    """Rows of conventions and of the program are metadata in Parquet."""
    parquet = pytest.importorskip("pyarrow.parquet")
    cases = ("drawer/**/*.dat", "bad.yaml", "neutral.yaml")
    said = vstatics("run", *cases, "-o", "all.parquet", "-j", 2)
    assert said.fails("4 of 5 cases calculated, 1 failed")
    told = csv.DictReader(io.StringIO(vstatics("run", *cases, "-f", "csv").out))
    expected = [
        row | {"gear": row["gear"] or None, "value": float(row["value"]) if row["value"] else None}
        for row in told
        if row["table"] not in ("conventions", "program")
    ]
    assert parquet.read_table("all.parquet").to_pylist() == expected
    assert vstatics("run", "neutral.yaml", "-o", "one.parquet").status == 0
    alone = [row for row in expected if row["case"] == "neutral.yaml"]
    assert parquet.read_table("one.parquet").to_pylist() == alone


def assert_goes_on(said: Said, form: str, cases: tuple[str, ...], count: str) -> None:
    """A run has gone on to the bytes of a run that was never stopped."""
    assert (said.status, said.err.splitlines()[-1]) == (0, count)
    assert vstatics("run", *cases, "-o", f"whole.{form}").status == 0
    assert Path(f"all.{form}").read_bytes() == Path(f"whole.{form}").read_bytes()
    assert not Path(f"all.{form}.parts").exists()


@pytest.mark.slow
@pytest.mark.parametrize("form", ["jsonl", "parquet"])
def test_a_run_that_was_stopped_goes_on_and_gives_the_same(form: str) -> None:
    cases = ("drawer/a.dat", "neutral.yaml", "pipe.dat", NAMES[1])
    os.mkfifo("pipe.dat")
    with running("run", *cases, "-o", f"all.{form}") as run:
        pipe = opened_for_reading()
        run.send_signal(signal.SIGINT)
        status, lines = ended(run)
        os.close(pipe)
    kept = f"all.{form} was not written; the same command with --resume goes on"
    assert (status, lines[-1]) == (130, f"stopped after 2 of 4 cases; {kept}")
    assert not Path(f"all.{form}").exists()
    Path("pipe.dat").unlink()
    Path("pipe.dat").write_bytes(MZKT.read_bytes())
    call = "run", *cases, "-o", f"all.{form}"
    assert vstatics(*call, "--resume", "--coast").is_wrong_use("--coast was not given, is true")
    held = f"all.{form}.parts: error: holds 2 finished cases of a run that was stopped"
    assert vstatics(*call).fails(held)
    with Path(f"all.{form}.parts/parts").open("ab") as parts:
        parts.write(b'["pipe.dat", "0", {}, 1000]\ncut')  # as by a power failure
    Path("neutral.yaml").write_text(NEUTRAL.replace("-2.5", "-3"), "utf-8")
    count = "4 of 4 cases calculated (1 of them before)"
    assert_goes_on(vstatics(*call, "--resume"), form, cases, count)


def test_a_run_with_a_bad_case_goes_on_when_it_is_mended() -> None:
    """And it may be begun anew, since it was not stopped."""
    cases = ("drawer/a.dat", "bad.yaml", "neutral.yaml")
    kept = "all.jsonl.parts keeps the others: the same command with --resume calculates what "
    for _ in range(2):
        said = vstatics("run", *cases, "-o", "all.jsonl", "-q")
        assert said.status == 1
        assert said.err.splitlines()[-1] == f"{kept}failed or is changed"
    Path("all.jsonl.parts/.vstatics-7-0").touch()  # the output, of a run that was killed
    Path("bad.yaml").write_text(NEUTRAL, "utf-8")
    said = vstatics("run", *cases, "-o", "all.jsonl", "--resume")
    assert_goes_on(said, "jsonl", cases, "3 of 3 cases calculated (2 of them before)")


def test_nothing_to_go_on_with_is_reported_and_nothing_is_left() -> None:
    said = vstatics("run", *NAMES, "-o", "all.jsonl", "--resume")
    assert (said.status, "there is no earlier run to resume; every case" in said.err) == (0, True)
    assert names() == ["all.jsonl", "bad.yaml", "drawer", "neutral.yaml"]


@pytest.mark.parametrize(("cases", "jobs"), [(MANY - 1, 1), (MANY, 7)])
def test_many_cases_are_shared_by_all_cores(
    cases: int, jobs: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = []

    def to_stream(*_: object, jobs: int, **__: object) -> int:
        asked.append(jobs)
        return 0

    monkeypatch.setattr(many, "to_stream", to_stream)
    monkeypatch.setattr("vstatics.core.cli.run.cores", lambda: 7)
    call = "run", *(f"{n}.dat" for n in range(cases)), "-f", "jsonl"
    for more in ((), ("-j", 3)):
        assert vstatics(*call, *more).status == 0
    assert asked == [jobs, 3]
