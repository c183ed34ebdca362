"""A thousand decks: `vstatics run` with one job against a shell loop over the peer.

The decks are the MZKT deck with other ratios. `vstatics run` starts once, the peer once
for each deck. Both read, calculate and write a file for each deck, tables with three
decimals. JSON with all digits, and JSON lines into one file, stand beside it.
"""

import json
import os
import random
import shutil
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from common import (
    MZKT,
    VSTATICS,
    Spent,
    bytecode,
    medians_spent,
    options,
    print_table,
    rows_of_spent,
    spent,
)
from numeric import numeric

from vstatics import load
from vstatics.core.writers import deck

COUNT = 1000
SEED = 7
RUNS = [
    ["run", "--files-from", "list", "-o", f"results{os.sep}"],
    ["run", "--files-from", "list", "-f", "json", "-o", f"results{os.sep}"],
    ["run", "--files-from", "list", "-f", "jsonl", "-o", f"results{os.sep}all.jsonl"],
]
AS_JSON = 2
"""Place of the second one, after the peer."""
LOOP = 'for f in *.num; do "$0" "$f" > "results/${f%.num}.lst"; done'


def write_decks(folder: Path, count: int) -> None:
    """Decks, the same for the peer, and a list of the decks."""
    case, rng = load(MZKT), random.Random(SEED)  # noqa: S311
    for number in range(count):
        varied = [
            mechanism._replace(ratio=round(mechanism.ratio * rng.uniform(0.9, 1.1), 4))
            for mechanism in case.mechanisms
        ]
        variant = replace(case, mechanisms=varied)
        path = folder / f"mzkt{number:04}.dat"
        path.write_text(deck.write(variant), encoding="utf-8")
        path.with_suffix(".num").write_text(numeric(variant), encoding="ascii")
    names = sorted(str(path) for path in folder.glob("*.dat"))
    (folder / "list").write_text("\n".join(names) + "\n", encoding="utf-8")


def into_new_folder(folder: Path, command: Sequence[str]) -> Spent:
    """What a command takes that writes into a new folder; the results of earlier ones stay.

    To write over files takes longer; so does to make files just after others were removed
    (ext4 looks for places that were not free a moment ago).
    """
    results = folder / "results"
    if results.exists():
        results.rename(folder / f"results-{len(list(folder.glob('results-*')))}")
    results.mkdir()
    return spent(command, folder)


def same_results(theirs: Path, ours: Path) -> None:
    """The last rows of the torques with losses agree as far as the peer prints them."""
    lines = theirs.read_text(encoding="ascii").splitlines()
    printed = [float(word) for word in lines[lines.index("ETA") - 1].split()]
    full = json.loads(ours.read_text(encoding="utf-8"))["lossy_torques"][-1]
    if any(abs(a - b) > 0.51e-3 for a, b in zip(full, printed, strict=True)):
        sys.exit(f"{ours.stem}: the peer has other results")


def main() -> None:
    """Measure and print."""
    given = options(__doc__)
    count, rounds = (20, 1) if given.quick else (COUNT, 5)
    shell = shutil.which("bash") or "/bin/sh"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_decks(folder, count)
        bytecode()
        commands = {
            "shell loop over the peer": [shell, "-c", LOOP, str(given.peer)],
            **{f"`vstatics {' '.join(words)}`": [*VSTATICS, *words] for words in RUNS},
        }
        made: list[Path] = []
        for command in commands.values():  # fills the file cache, too
            into_new_folder(folder, command)
            made.append((folder / "results").rename(folder / f"made-{len(made)}"))
        for path in made[0].iterdir():
            same_results(path, made[AS_JSON] / f"{path.stem}.json")
        actions = {
            name: partial(into_new_folder, folder, command) for name, command in commands.items()
        }
        measured = medians_spent(actions, rounds)
    columns = ("", "time", "by the peer's", "processor time", "by the peer's")
    print_table(f"{count:,} decks, one job", columns, rows_of_spent(measured, decimals=2))


if __name__ == "__main__":
    main()
