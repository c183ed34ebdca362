"""Searches for whole gearboxes: a small one, then that for the eight-speed of four sets.

Each is the command as it is called, with a process for each core. The small one comes first: the
compiled search is kept, so only the first call on a machine compiles it, and that is told by
itself. What is found is checked: the production structure, that of ZF 8HP, has to be among the
first five by mean loss.
"""

import json
import sys
import tempfile
from functools import partial
from pathlib import Path
from typing import Any

from common import VSTATICS, options, print_table, spent

from vstatics.core.jobs.workers import cores
from vstatics.synthesis.boxes.box import HELD, FoundBox
from vstatics.synthesis.boxes.figures.case import box_element_name
from vstatics.synthesis.boxes.least_form import least_box
from vstatics.synthesis.structures.scheme import SetScheme

SMALL = (
    *("--sets=2", "--shift-elements=4", "--engaged=2", "--own-input"),
    "--ratios=2.45,1.45,1,-2.2",
)
EIGHT = (
    *("--sets=4", "--shift-elements=5", "--engaged=3", "--tolerance=.005"),
    "--ratios=4.70,3.13,2.10,1.67,1.28,1,.84,.67,-3.30",
)
FIRST = 5
"""The production structure is among so many."""
PRODUCTION = FoundBox(
    scheme=SetScheme(((1, 3, 2), (1, 0, 4), (4, 6, 5), (5, 7, 3))),
    held=None,
    input=0,
    output=7,
    elements=((1, HELD), (2, HELD), (0, 5), (6, 7), (4, 5)),
    ratios=(-2.0, -2.0, -111 / 69, -85 / 23),
    gears=(
        (0, 1, 2),
        (0, 1, 4),
        (1, 2, 4),
        (1, 3, 4),
        (1, 2, 3),
        (2, 3, 4),
        (0, 2, 3),
        (0, 3, 4),
        (0, 1, 3),
    ),
    error=0.0,
)
"""The ZF 8HP70, as cases/zf-8hp70.yaml has it."""


def searched(asked: tuple[str, ...], folder: Path) -> tuple[float, dict[str, Any]]:
    """Wall-clock time [s] of a search, and what it has found."""
    output = folder / "boxes.json"
    seconds = spent([*VSTATICS, "synth", "box", *asked, "-q", "-o", str(output)], folder).wall
    found: dict[str, Any] = json.loads(output.read_text(encoding="utf-8"))
    return seconds, found


def place(found: dict[str, Any]) -> int:
    """The place of the production structure in the order, from 1; 0 if it is not there."""
    least = least_box(PRODUCTION)
    own = (least.scheme.code, least.input, least.output, {*map(box_element_name, least.elements)})
    for number, box in enumerate(found["boxes"], 1):
        if own == (box["code"], box["input"], box["output"], {*box["elements"]}):
            return number
    return 0


def main() -> None:
    """Search and print."""
    given = options(__doc__, peer=False)
    named = {"three gears and reverse, two sets": SMALL}
    if not given.quick:
        named["eight gears and reverse, four sets"] = EIGHT
    rows: list[tuple[object, ...]] = []
    with tempfile.TemporaryDirectory() as folder:
        search = partial(searched, folder=Path(folder))
        rows.append(("the small one for the first time", "", "", "", f"{search(SMALL)[0]:.1f} s"))
        for name, asked in named.items():
            seconds, found = search(asked)
            counts = (f"{found['searched']:.3g}", found["found"], found["families"])
            rows.append((name, *counts, f"{seconds:.1f} s"))
    if not (given.quick or 0 < place(found) <= FIRST):
        sys.exit(f"the production structure has place {place(found)}, not one of the first {FIRST}")
    jobs = cores()
    columns = ("", "boxes looked at", "found", "families", "time")
    print_table(f"Searches for boxes, {jobs} {'jobs' if jobs > 1 else 'job'}", columns, rows)


if __name__ == "__main__":
    main()
