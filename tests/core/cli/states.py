"""Commands that leave a state, small enough to be called hundreds of times in this process."""

import os
import shutil
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.commands import NEUTRAL, Said, vstatics
from tests.installed import HERE, missing
from vstatics.core.annexes import COMMANDS as ANNEX_OF

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

    def whole(self) -> dict[str, bytes]:
        """Return the result of the undisturbed command, and remove it."""
        assert self.call("-q").status == 0
        expected = self.written()
        self.remove()
        return expected

    @property
    def state(self) -> list[Path]:
        """The files of the state that are there."""
        pattern = "*" if self.folder.endswith(".parts") else ".vstatics*"
        return sorted(Path(self.folder).glob(pattern))

    def remove(self) -> None:
        """Remove what the command has left."""
        for name in (self.output, self.folder, self.folder.removesuffix(".parts")):
            path = Path(name)
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path)
            elif os.path.lexists(path):
                path.unlink()


OF_PIECES = ("lock", "plan.json", "00000000", "output")
OF_PARTS = ("lock", "parts", "over")
SWEEP = ("sweep", "box.yaml", "--vary", "D.ratio=-4:-2:20", "-j", "1")
SAMPLES = ("simulate", "lock.yaml", "--samples", "5", "--jobs", "1", "--out", "locks[brake]")
RUN = ("run", *CASES, "-j", "1")
BOX = (
    *("synth", "box", "--sets", "1", "--shift-elements", "2", "--engaged", "1"),
    *("--ratios", "3,1", "-j", "1"),
)
RECORD = ".vstatics-boxes"
"""Hidden file in a folder of found boxes."""
_BEST = (*SWEEP, "--max", "ratio[low]")
_RECORDS = (".vstatics-run-json", ".vstatics-run-json.lock")
_ALL = {
    "sweep csv": StatedCommand(SWEEP, "o.csv", "o.csv.parts", OF_PIECES),
    "sweep npz": StatedCommand(SWEEP, "o.npz", "o.npz.parts", OF_PIECES),
    "sweep parquet": StatedCommand(SWEEP, "o.parquet", "o.parquet.parts", OF_PIECES),
    "sweep best": StatedCommand(_BEST, "o.jsonl", "o.jsonl.parts", OF_PIECES),
    "samples": StatedCommand(SAMPLES, "o.csv", "o.csv.parts", OF_PIECES),
    "run jsonl": StatedCommand(RUN, "o.jsonl", "o.jsonl.parts", OF_PARTS),
    "run parquet": StatedCommand(RUN, "o.parquet", "o.parquet.parts", OF_PARTS),
    "run folder": StatedCommand((*RUN, "-f", "json"), "out/", "out", _RECORDS),
    "boxes": StatedCommand(BOX, "found.json", "found.json.parts", OF_PIECES),
    "boxes folder": StatedCommand(BOX, "found/", "found.parts", OF_PIECES),
    "record of boxes": StatedCommand(BOX, "found/", "found", (RECORD,)),
}
COMMANDS = {
    name: command
    for name, command in _ALL.items()
    if not missing(ANNEX_OF[word] for word in command.arguments[:1] if word in ANNEX_OF)
}
"""Commands of annexes that are installed, and of the core."""


def prepare(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Make a folder with all inputs the current one, with small pieces of work."""
    monkeypatch.chdir(folder)
    for number, name in enumerate(CASES):
        Path(name).write_text(NEUTRAL.replace("-2.5", f"-2.{number + 1}"), "utf-8")
    if "sweep" in HERE:
        from tests.sweep.states import prepare_sweeps

        prepare_sweeps(monkeypatch)
    if "simulation" in HERE:
        from tests.simulation.variants.states import prepare_runs

        prepare_runs(monkeypatch)
    if "synthesis" in HERE:
        from tests.synthesis.boxes.states import prepare_boxes

        prepare_boxes(monkeypatch, PIECES)
