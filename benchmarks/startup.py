"""Whole-process time of `vstatics run` against importing numpy and click.

Prints the median of each and their ratio. The two alternate, so that a machine that
slows down slows both. Run it with ``make bench``.
"""

import statistics
import subprocess
import sys
import time
from pathlib import Path

RUNS = 15
CASE = Path(__file__).parent.parent / "cases" / "mzkt7922.dat"
COMMANDS = {
    "vstatics run": [str(Path(sys.executable).with_name("vstatics")), "run", str(CASE)],
    "import numpy, click": [sys.executable, "-c", "import numpy, click"],
}


def seconds(command: list[str]) -> float:
    """Wall-clock time of one process [s]."""
    start = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - start


def main() -> None:
    """Measure and print."""
    for command in COMMANDS.values():
        seconds(command)  # fills the file cache
    times: dict[str, list[float]] = {name: [] for name in COMMANDS}
    for _ in range(RUNS):
        for name, command in COMMANDS.items():
            times[name].append(seconds(command))
    medians = {name: statistics.median(measured) for name, measured in times.items()}
    for name, median in medians.items():
        print(f"{name:22} {1000 * median:6.1f} ms (median of {RUNS})")
    run, bare = medians.values()
    print(f"{'ratio':22} {run / bare:6.3f}")


if __name__ == "__main__":
    main()
