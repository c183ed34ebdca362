"""Many cases in one file, JSON lines or Parquet: patterns, going on after a stop."""

from __future__ import annotations

import csv
import io
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.commands import BAD, MZKT, NEUTRAL, vstatics
from tests.core.cli.shared.test_many_stopped import ended, opened_for_reading, running
from vstatics.core.cli.run import MANY
from vstatics.core.cli.shared import many

NAMES = ("drawer/a.dat", "drawer/deep/b.dat", "drawer/deep/c.dat")


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    """Three decks in two folders, and a bad one that no pattern here meets."""
    (folder / "drawer/deep").mkdir(parents=True)
    for name in NAMES:
        (folder / name).write_bytes(MZKT.read_bytes())
    (folder / "bad.yaml").write_text(BAD, encoding="utf-8")
    (folder / "neutral.yaml").write_text(NEUTRAL, encoding="utf-8")


def rows(file: str) -> list[dict[str, object]]:
    parquet = pytest.importorskip("pyarrow.parquet")
    found: list[dict[str, object]] = parquet.read_table(file).to_pylist()
    return found


def test_patterns_are_expanded_in_order() -> None:
    said = vstatics("run", "drawer/**/*.dat", "-f", "jsonl")
    found = [json.loads(line)["file"] for line in said.out.splitlines()]
    assert found == [Path(name).name for name in NAMES]
    missing = vstatics("run", "drawer/*.yaml", "-f", "jsonl")
    assert missing.is_wrong_use("no file matches `drawer/*.yaml`")
    Path("odd[1].dat").write_bytes(MZKT.read_bytes())
    assert vstatics("run", "odd[1].dat", "-f", "json").status == 0


@pytest.mark.skipif(os.name == "nt", reason="links need a right there")
def test_a_link_back_up_is_no_way_to_more_files() -> None:
    """As in shells: a link that is named is a folder as any."""
    Path("drawer/up").symlink_to("..")
    Path("linked").symlink_to("drawer")
    linked = tuple(name.replace("drawer", "linked") for name in NAMES)
    for pattern, found in (("**/*.dat", NAMES), ("linked/**/*.dat", linked)):
        said = vstatics("run", pattern, "-q", "-f", "csv")
        cases = dict.fromkeys(row["case"] for row in csv.DictReader(io.StringIO(said.out)))
        assert tuple(filter(None, cases)) == found


def test_files_of_one_name_are_told_with_their_folders() -> None:
    Path("drawer/deep/a.dat").write_text(BAD, encoding="utf-8")
    names = sorted([*NAMES, "drawer/deep/a.dat"])
    for form in ("json", "jsonl"):
        text = vstatics("run", "drawer/**/*.dat", "-f", form).out
        found = json.loads(text) if form == "json" else map(json.loads, text.splitlines())
        assert [one["file"] for one in found] == names


def test_parquet_has_the_rows_of_csv() -> None:
    """Rows of conventions and of the program are metadata in Parquet."""
    cases = ("drawer/**/*.dat", "bad.yaml", "neutral.yaml")
    said = vstatics("run", *cases, "-o", "all.parquet", "-j", 2)
    assert said.fails("4 of 5 cases calculated, 1 failed")
    told = csv.DictReader(io.StringIO(vstatics("run", *cases, "-f", "csv").out))
    expected = [
        {
            "case": row["case"],
            "table": row["table"],
            "row": row["row"],
            "gear": row["gear"] or None,
            "value": float(row["value"]) if row["value"] else None,
        }
        for row in told
        if row["table"] not in ("conventions", "program")
    ]
    assert rows("all.parquet") == expected
    assert vstatics("run", "neutral.yaml", "-o", "one.parquet").status == 0
    assert rows("one.parquet") == [row for row in expected if row["case"] == "neutral.yaml"]


@pytest.mark.parametrize(
    ("options", "why"),
    [
        ("-f parquet -o out/", "parquet is one stream: expected -o FILE"),
        ("-f jsonl --resume", "--resume needs a directory to go on with"),
        ("-o all.csv --resume", "--resume needs a directory to go on with"),
        ("-o all.parquet --digits 3", "--digits does not apply to parquet"),
    ],
)
def test_what_does_not_go_together_is_refused(options: str, why: str) -> None:
    said = vstatics("run", *NAMES, *options.split())
    assert said.is_wrong_use(why)


def stopped(form: str) -> None:
    """A run that was stopped at its third case, which is there now."""
    os.mkfifo("pipe.dat")
    with running("drawer/a.dat", "neutral.yaml", "pipe.dat", NAMES[1], "-o", f"all.{form}") as run:
        pipe = opened_for_reading()
        run.send_signal(signal.SIGINT)
        status, said = ended(run)
        os.close(pipe)
    kept = f"all.{form} was not written; the same command with --resume goes on"
    assert (status, said[-1]) == (130, f"stopped after 2 of 4 cases; {kept}")
    assert not Path(f"all.{form}").exists()
    Path("pipe.dat").unlink()
    Path("pipe.dat").write_bytes(MZKT.read_bytes())


@pytest.mark.slow
@pytest.mark.parametrize("form", ["jsonl", "parquet"])
def test_a_run_that_was_stopped_goes_on_and_gives_the_same(form: str) -> None:
    stopped(form)
    cases = ("drawer/a.dat", "neutral.yaml", "pipe.dat", NAMES[1])
    other = vstatics("run", *cases, "-o", f"all.{form}", "--resume", "--coast")
    assert other.is_wrong_use("--coast was not given, is true")
    anew = vstatics("run", *cases, "-o", f"all.{form}")
    held = f"all.{form}.parts: error: holds 2 finished cases of a run that was stopped"
    assert anew.fails(held)
    with Path(f"all.{form}.parts/parts").open("ab") as parts:
        parts.write(b'["pipe.dat", "0", {}, 1000]\ncut')  # as by a power failure
    Path("neutral.yaml").write_text(NEUTRAL.replace("-2.5", "-3"), encoding="utf-8")
    said = vstatics("run", *cases, "-o", f"all.{form}", "--resume")
    assert (said.status, said.err.splitlines()[-1]) == (
        0,
        "4 of 4 cases calculated (1 of them before)",
    )
    assert vstatics("run", *cases, "-o", f"whole.{form}").status == 0
    assert Path(f"all.{form}").read_bytes() == Path(f"whole.{form}").read_bytes()
    assert not Path(f"all.{form}.parts").exists()


@pytest.mark.skipif(os.name == "nt", reason="there are no limits of files")
def test_a_disk_that_is_full_at_the_parts_is_told_of_them() -> None:
    import resource

    def full() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (5000, 5000))

    cases = ["drawer/a.dat"] * 4
    line = [sys.executable, "-m", "vstatics", "run", *cases, "-o", "all.jsonl", "-q"]
    done = subprocess.run(line, preexec_fn=full, capture_output=True, text=True, check=False)
    told, last = done.stderr.splitlines()
    assert (done.returncode, Path("all.jsonl").exists()) == (1, False)
    assert told.endswith("all.jsonl.parts/parts: error: cannot be written: File too large [E030]")
    assert last.endswith("all.jsonl was not written; the same command with --resume goes on")


def test_a_run_with_a_bad_case_goes_on_when_it_is_mended() -> None:
    """And it may be begun anew, since it was not stopped."""
    cases = ("drawer/a.dat", "bad.yaml", "neutral.yaml")
    for _ in range(2):
        said = vstatics("run", *cases, "-o", "all.jsonl", "-q")
        assert (said.status, said.err.splitlines()[-1]) == (
            1,
            "all.jsonl.parts keeps the others: the same command with --resume calculates what "
            "failed or is changed",
        )
    Path("all.jsonl.parts/.vstatics-7-0").touch()  # the output, of a run that was killed
    Path("bad.yaml").write_text(NEUTRAL, encoding="utf-8")
    said = vstatics("run", *cases, "-o", "all.jsonl", "--resume")
    assert (said.status, said.err.splitlines()[-1]) == (
        0,
        "3 of 3 cases calculated (2 of them before)",
    )
    assert vstatics("run", *cases, "-o", "whole.jsonl").status == 0
    assert Path("all.jsonl").read_bytes() == Path("whole.jsonl").read_bytes()
    assert not Path("all.jsonl.parts").exists()


def test_nothing_to_go_on_with_is_told_and_nothing_is_left() -> None:
    said = vstatics("run", *NAMES, "-o", "all.jsonl", "--resume")
    assert (said.status, "there is no earlier run to resume; every case" in said.err) == (0, True)
    assert sorted(path.name for path in Path.cwd().iterdir()) == [
        "all.jsonl",
        "bad.yaml",
        "drawer",
        "neutral.yaml",
    ]


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
    assert vstatics("run", *(f"{n}.dat" for n in range(cases)), "-f", "jsonl").status == 0
    assert vstatics("run", *(f"{n}.dat" for n in range(cases)), "-f", "jsonl", "-j", 3).status == 0
    assert asked == [jobs, 3]


def test_a_table_of_nothing_has_its_headings() -> None:
    """Of no case at all, and where all cases failed: whoever reads it finds no rows."""
    Path("cut.dat").write_text("KJG= 3", encoding="utf-8")
    failed = vstatics("run", "cut.dat", "cut.dat", "-q", "-o", "all.csv")
    assert failed.fails("0 of 2 cases calculated, 2 failed:")
    none = vstatics("run", "--files-from", "-", "-f", "csv", stdin=b"# none\n")
    assert (none.status, none.out) == (0, Path("all.csv").read_text("utf-8"))
    assert none.out.startswith("case,table,row,gear,value\n")
    assert vstatics("run", "--files-from", "-", "-f", "json").out == "[]\n"


def test_a_file_that_a_pattern_finds_is_there_once() -> None:
    again = f"../{Path.cwd().name}/drawer/a.dat"
    named = ["./drawer/deep/c.dat", "drawer/deep/?.dat", "drawer/**/*.dat", "drawer/a.dat", again]
    said = vstatics("run", *named, "-q", "-f", "csv")
    cases = dict.fromkeys(row["case"] for row in csv.DictReader(io.StringIO(said.out)))
    assert [*filter(None, cases)] == ["./drawer/deep/c.dat", "drawer/deep/b.dat", "drawer/a.dat"]
    ratios = said.out.count("drawer/a.dat,ratio,")
    assert ratios == vstatics("run", "drawer/a.dat", "-f", "csv").out.count("\nratio,")
