"""Whole-process time of `vstatics run` against importing numpy and click.

They alternate, so that a machine that slows down slows both.
"""

import subprocess
import sys
from functools import partial

from common import MZKT, VSTATICS, medians, options, print_table, timed

RUNS = 15
COMMANDS = {
    "import numpy, click": [sys.executable, "-c", "import numpy, click"],
    "`vstatics run` of the MZKT deck": [*VSTATICS, "run", str(MZKT)],
}


def main() -> None:
    """Measure and print."""
    given = options(__doc__, peer=False)
    actions = {
        name: partial(
            timed, partial(subprocess.run, command, check=True, stdout=subprocess.DEVNULL)
        )
        for name, command in COMMANDS.items()
    }
    medians(actions, 1)  # fills the file cache
    measured = medians(actions, 1 if given.quick else RUNS)
    bare = next(iter(measured.values()))
    rows = [
        (name, f"{1000 * seconds:.0f} ms", f"{seconds / bare:.2f}")
        for name, seconds in measured.items()
    ]
    print_table("Start", ("process", "time", "by the bare import"), rows)


if __name__ == "__main__":
    main()
