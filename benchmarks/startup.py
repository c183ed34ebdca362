"""Whole-process time of `vstatics run` against importing numpy and click.

They alternate, so that a machine that slows down slows both.
"""

import sys
from functools import partial

from common import (
    MZKT,
    VSTATICS,
    bytecode,
    medians_spent,
    options,
    print_table,
    rows_of_spent,
    spent,
)

RUNS = 15
COMMANDS = {
    "import numpy, click": [sys.executable, "-c", "import numpy, click"],
    "`vstatics run` of the MZKT deck": [*VSTATICS, "run", str(MZKT)],
}


def main() -> None:
    """Measure and print."""
    given = options(__doc__, peer=False)
    bytecode()
    actions = {name: partial(spent, command) for name, command in COMMANDS.items()}
    if not given.quick:
        medians_spent(actions, 1)  # fills the file cache
    measured = medians_spent(actions, 1 if given.quick else RUNS)
    columns = ("process", "time", "by the bare import", "processor time", "by the bare import")
    print_table("Start", columns, rows_of_spent(measured, decimals=3))


if __name__ == "__main__":
    main()
