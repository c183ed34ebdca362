"""Whole-process time of `vstatics plot` and `report` against importing matplotlib.

They alternate, so that a machine that slows down slows both. The case is a ten-speed, the
Ford 10R80; the last column has the size of what is written.
"""

import sys
import tempfile
from functools import partial
from pathlib import Path

from common import (
    ROOT,
    VSTATICS,
    bytecode,
    medians_spent,
    options,
    print_table,
    rows_of_spent,
    spent,
)

RUNS = 9
CASE = str(ROOT / "cases" / "ford-10r80.yaml")
KINDS = ("stick", "structure", "flow", "lever", "plan", "efficiency")
OF_A_GEAR = ("stick", "structure", "flow", "lever")


def commands(folder: Path) -> dict[str, list[str]]:
    """What is measured."""
    found = {"import matplotlib.pyplot": [sys.executable, "-c", "import matplotlib.pyplot"]}
    for kind in KINDS:
        gear = ["--gear", "1"] if kind in OF_A_GEAR else []
        name = f"`plot --kind {kind}{' --gear 1' if gear else ''}`"
        to = ["-o", str(folder / f"{kind}.svg")]
        found[name] = [*VSTATICS, "plot", CASE, "-q", "--kind", kind, *gear, *to]
    found["`report`"] = [*VSTATICS, "report", CASE, "-q", "-o", str(folder / "report.html")]
    return found


def main() -> None:
    """Measure and print."""
    given = options(__doc__, peer=False)
    bytecode()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        actions = {name: partial(spent, command) for name, command in commands(folder).items()}
        if not given.quick:
            medians_spent(actions, 1)  # fills the file cache
        measured = medians_spent(actions, 1 if given.quick else RUNS)
        written = [Path(command[-1]) for command in commands(folder).values()]
        sizes = [f"{one.stat().st_size / 1000:.0f}" if one.exists() else "" for one in written]
    columns = ("process", "time", "by the bare import", "processor time", "by the bare import")
    rows = rows_of_spent(measured, decimals=2)
    sized = [(*row, size) for row, size in zip(rows, sizes, strict=True)]
    print_table("Pictures of a ten-speed", (*columns, "file, kB"), sized)


if __name__ == "__main__":
    main()
