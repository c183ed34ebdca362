"""A sweep whose output has no room on its disk is refused before anything is written."""

import re
import shutil
from pathlib import Path
from types import SimpleNamespace

import pytest

from tests.commands import vstatics
from tests.installed import needs
from tests.processes import names
from tests.sweep.sweeps import CASE_TEXT
from vstatics.sweep.cli import estimate

HUGE = ("--vary", "D.ratio=-4:-2:1000000", "--vary", "D.efficiency=.9:1:1000000")
SMALL = ("--vary", "D.ratio=-4:-2:100", "--vary", "D.efficiency=.9:1:100")


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    (folder / "box.yaml").write_text(CASE_TEXT, "utf-8")


def free(monkeypatch: pytest.MonkeyPatch, size: int) -> None:
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(free=size))


def test_a_million_million_variants_are_refused_with_both_sizes(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Seven columns of 8 bytes and a status of one; 12 digits of text are near that."""
    free(monkeypatch, 2_500_000_000)
    for form, words in {
        "npz": "needs about 57 TB",
        "parquet": "its pieces need about 57 TB",
        "csv": "needs about 7",
        "jsonl": "needs about 2",
    }.items():
        said = vstatics("sweep", "box.yaml", *HUGE, "-o", f"out.{form}")
        assert said.fails(" TB, but only 2.5 GB are free: expected fewer variants")
        assert said.err.startswith(f"out.{form}: error: {words}")
        assert names(Path.cwd()) == ["box.yaml"]


def test_what_is_said_is_the_size_to_a_few_per_cent(monkeypatch: pytest.MonkeyPatch) -> None:
    for form in ("csv", "jsonl", "npz"):
        free(monkeypatch, 10**9)
        assert vstatics("sweep", "box.yaml", *SMALL, "-o", f"out.{form}").status == 0
        size = Path(f"out.{form}").stat().st_size
        for part, status in ((0.9, 1), (1.1, 0)):
            free(monkeypatch, round(part * size))
            assert vstatics("sweep", "box.yaml", *SMALL, "-o", f"no.{form}").status == status


def test_room_that_pieces_have_already_counts_and_chosen_rows_do_not(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A sweep that goes on needs what is missing; where rows are chosen, no size is known."""
    free(monkeypatch, 0)
    asked = ("sweep", "box.yaml", *SMALL, "-o", "out.csv")
    for option in (("--where", "ratio[low] > 3"), ("--max", "ratio[low]")):
        assert vstatics(*asked, *option).status == 0
    Path("out.csv").unlink()
    Path("out.csv.parts").mkdir()
    Path("out.csv.parts/.vstatics-1-0").write_bytes(bytes(10**6))
    assert vstatics(*asked).status == 0


GRIDS = "D.ratio=-4:-2:100 D.efficiency=.9:1:100", "D.ratio=-4:-2:50000"


@pytest.mark.slow
@pytest.mark.parametrize("varied", [*GRIDS, "D.efficiency=.9:1:3 D.ratio=-4:-2:20000"])
def test_a_dry_run_tells_the_size_of_what_is_packed(varied: str) -> None:
    """Repeated numbers take 0 to 2 bytes in Parquet, others 8 or more.

    It is told by a block: what is repeated farther apart makes the file smaller than that.
    """
    options = [word for number in varied.split() for word in ("--vary", number)]
    asked = ["sweep", "box.yaml", *options, "-o", "out.parquet"]
    told = re.search(r"size +about ([\d.]+) (kB|MB)", vstatics(*asked, "--dry-run").out)
    assert told is not None
    assert vstatics(*asked).status == 0
    size = Path("out.parquet").stat().st_size
    assert 0.9 * size < float(told[1]) * {"kB": 1e3, "MB": 1e6}[told[2]] < 1.6 * size


@needs("simulation")
def test_a_dry_run_of_runs_without_end_is_done_soon(monkeypatch: pytest.MonkeyPatch) -> None:
    """A mass on a spring swings 1.6 times a second: ten years are 3e8 periods, a run of hours."""
    monkeypatch.setattr(estimate, "TRIED", 0.02)
    case = "links: [m]\ninput: m\noutput: m\ninertias: {m: 1}\n"
    spring = "springs: {k: {links: [m, housing], stiffness: 100}}\n"
    Path("mass.yaml").write_text(case + spring, "utf-8")
    endless = "case: mass.yaml\nduration: 1e9\nstart: {speeds: {m: 1}}\ntorques: {m: 1}\n"
    Path("run.yaml").write_text(endless, "utf-8")
    options = ("--vary", "torques.m=1:2:1000", "--out", "peaks[k]", "--dry-run")
    said = vstatics("sweep", "run.yaml", *options)
    assert said.is_without_messages()
    assert re.search(r"\ntime +about [\d.e+]+ (days|years)", said.out)
    limited = vstatics("sweep", "run.yaml", *options, "--limit", "2", "--jobs", "1")
    assert "time      about 33 minutes\n" in limited.out
