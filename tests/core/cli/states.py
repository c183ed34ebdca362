"""Commands that leave a state, small enough to be called hundreds of times in this process."""

from __future__ import annotations

import math
import os
import shutil
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.commands import NEUTRAL, Said, vstatics
from tests.simulation.variants.scenarios import CASE, SCENARIO
from tests.sweep.sweeps import CASE_TEXT
from vstatics.sweep import build, runs
from vstatics.synthesis.boxes.batches import work
from vstatics.synthesis.boxes.batches.found import FoundPiece
from vstatics.synthesis.boxes.box import HELD, BoxSearch, FoundBox
from vstatics.synthesis.cli.box import run as box_run
from vstatics.synthesis.cli.box.output import RECORD
from vstatics.synthesis.structures.scheme import SetScheme

CASES = tuple(f"{name}.yaml" for name in "abcdef")
PIECES = 3


class StatedCommand(NamedTuple):
    """A command, the folder in which its state is, and the names of the files of the state."""

    arguments: tuple[str, ...]
    output: str
    folder: str
    names: tuple[str, ...]

    def call(self, *more: str) -> Said:
        """Call the command."""
        return vstatics(*self.arguments, "-o", self.output, *more)

    def written(self) -> dict[str, bytes]:
        """Return the bytes of each result."""
        output = Path(self.output)
        results = output.iterdir() if output.is_dir() else [output] if output.exists() else []
        return {entry.name: entry.read_bytes() for entry in sorted(results) if entry.name[0] != "."}

    @property
    def state(self) -> list[str]:
        """The files of the state that are there."""
        folder = Path(self.folder)
        pattern = "*" if self.folder.endswith(".parts") else ".vstatics*"
        return sorted(str(path) for path in folder.glob(pattern))


OF_PIECES = ("lock", "plan.json", "00000000", "output")
OF_PARTS = ("lock", "parts", "over")
SWEEP = ("sweep", "box.yaml", "--vary", "D.ratio=-4:-2:20", "-j", "1")
SAMPLES = ("simulate", "lock.yaml", "--samples", "5", "--jobs", "1", "--out", "locks[brake]")
RUN = ("run", *CASES, "-j", "1")
BOX = (
    *("synth", "box", "--sets", "1", "--elements", "2", "--engaged", "1"),
    *("--ratios", "3,1", "-j", "1"),
)
COMMANDS = {
    "sweep csv": StatedCommand(SWEEP, "o.csv", "o.csv.parts", OF_PIECES),
    "sweep npz": StatedCommand(SWEEP, "o.npz", "o.npz.parts", OF_PIECES),
    "sweep parquet": StatedCommand(SWEEP, "o.parquet", "o.parquet.parts", OF_PIECES),
    "sweep best": StatedCommand(
        (*SWEEP, "--max", "ratio[low]"), "o.jsonl", "o.jsonl.parts", OF_PIECES
    ),
    "samples": StatedCommand(SAMPLES, "o.csv", "o.csv.parts", OF_PIECES),
    "run jsonl": StatedCommand(RUN, "o.jsonl", "o.jsonl.parts", OF_PARTS),
    "run parquet": StatedCommand(RUN, "o.parquet", "o.parquet.parts", OF_PARTS),
    "run folder": StatedCommand(
        (*RUN, "-f", "json"), "out/", "out", (".vstatics-run-json", ".vstatics-run-json.lock")
    ),
    "boxes": StatedCommand(BOX, "found.json", "found.json.parts", OF_PIECES),
    "boxes folder": StatedCommand(BOX, "found/", "found.parts", OF_PIECES),
    "record of boxes": StatedCommand(BOX, "found/", "found", (RECORD,)),
}


def found_in(_: BoxSearch, piece: int, count: int) -> FoundPiece:
    """A simple set with a brake at its ring, in each piece another one."""
    assert count == PIECES
    p = 2 + piece / 1000
    error = max(math.log((1 + p) / 3), 1e-9)
    box = FoundBox(
        SetScheme.of_code("0-1-2"), None, 0, 1, ((2, HELD), (0, 1)), (-p,), ((0,), (1,)), error
    )
    return FoundPiece(100, (box,), 0)


def prepare(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Make a folder with all inputs the current one, with small pieces of work."""
    monkeypatch.chdir(folder)
    for number, name in enumerate(CASES):
        Path(name).write_text(NEUTRAL.replace("-2.5", f"-2.{number + 1}"), encoding="utf-8")
    Path("box.yaml").write_text(CASE_TEXT, encoding="utf-8")
    Path("set.yaml").write_bytes(CASE)
    Path("lock.yaml").write_bytes(SCENARIO)
    whole = build.plan
    monkeypatch.setattr(build, "plan", lambda *of: replace(whole(*of), piece=8))
    monkeypatch.setattr(runs, "piece_of_runs", lambda _: 2)
    monkeypatch.setattr(box_run, "cut", lambda _: PIECES)
    monkeypatch.setattr(box_run, "prepare", lambda _: None)
    monkeypatch.setattr(work, "found_in", found_in)
    monkeypatch.setattr("vstatics.synthesis.pictures.stick.stick_diagram", lambda _: b"<svg/>")
    monkeypatch.setattr(
        "vstatics.synthesis.report.boxes.box_pages", lambda _: {"boxes.html": b"<html/>"}
    )


def remove(command: StatedCommand) -> None:
    """Remove what a command has left."""
    for name in (command.output, command.folder):
        path = Path(name)
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        elif os.path.lexists(path):
            path.unlink()
