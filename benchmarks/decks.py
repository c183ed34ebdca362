"""A thousand decks: `vstatics run` with one job against a shell loop over the peer.

The decks are the MZKT deck with other ratios. `vstatics run` starts once, the peer once
for each deck. Both read, calculate and write a file for each deck: JSON with all digits
there, tables with three decimals here.
"""

import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from common import MZKT, VSTATICS, medians, options, print_table, timed
from numeric import numeric

from vstatics import load
from vstatics.writers import deck

COUNT = 1000
SEED = 7
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


def seconds(folder: Path, command: Sequence[str]) -> float:
    """Time of a command that writes into a new folder; the results of earlier ones stay.

    To write over files takes longer; so does to make files just after others were removed
    (ext4 looks for places that were not free a moment ago).
    """
    results = folder / "results"
    if results.exists():
        results.rename(folder / f"results-{len(list(folder.glob('results-*')))}")
    results.mkdir()
    run = partial(subprocess.run, command, check=True, cwd=folder, stderr=subprocess.DEVNULL)
    return timed(run)


def same_results(theirs: Path, ours: Path) -> None:
    """The last rows of the torques with losses agree as far as the peer prints them."""
    lines = theirs.read_text(encoding="ascii").splitlines()
    printed = [float(word) for word in lines[lines.index("ETA") - 1].split()]
    full = json.loads(ours.read_text(encoding="utf-8"))["AMLGP"][-1]
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
        commands = {
            "peer": [shell, "-c", LOOP, str(given.peer)],
            "vstatics": [
                *(*VSTATICS, "run", "--files-from", "list"),
                *("-f", "json", "-o", f"results{os.sep}"),
            ],
        }
        for label, command in commands.items():  # fills the file cache, too
            seconds(folder, command)
            (folder / "results").rename(folder / label)
        for path in (folder / "peer").iterdir():
            same_results(path, folder / "vstatics" / f"{path.stem}.json")
        measured = medians(
            {label: partial(seconds, folder, command) for label, command in commands.items()},
            rounds,
        )
    rows = [
        (label, f"{measured[name]:.2f} s", f"{measured[name] / measured['peer']:.2f}")
        for label, name in (
            ("shell loop over the peer", "peer"),
            ("`vstatics run --files-from LIST -f json -o DIR/`", "vstatics"),
        )
    ]
    print_table(f"{count:,} decks, one job", ("", "time", "by the peer's"), rows)


if __name__ == "__main__":
    main()
