"""Sweeps of the MZKT deck: one job and two to NPZ, rows a second to CSV, memory.

The memory is the largest resident set of each process, read while it runs from `/proc`;
elsewhere it is left out. The NPZ of ten million variants takes 1.3 GB, and while it is
made as much again. A loop that shares nothing with another one, run once and twice at a
time, tells what a second job can gain on this machine at this moment.
"""

import shutil
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path

from common import MZKT, VSTATICS, medians, options, print_table

NPZ = 10_000_000
CSV = 1_000_000
BYTES = 300
"""On the disk for a variant, at most, while a sweep ends."""
STEPS = 1_000_000
LOOP = """
import sys, numpy
numbers = numpy.ones(4096)
for _ in range(int(sys.argv[1])):
    numpy.multiply(numbers, 1.0, numbers)
"""
PROC = Path("/proc")
LOOK = 0.5
"""Time between looks at the memory; each takes some from the processes. [s]"""

Peaks = dict[int, float]
"""Process -> largest resident set [MB]."""


def family(parent: int) -> set[int]:
    """A process and all that it has started."""
    parents = {}
    for stat in PROC.glob("[0-9]*/stat"):
        try:
            fields = stat.read_text(encoding="utf-8", errors="replace").rpartition(")")[2].split()
        except OSError:
            continue  # it has just ended
        parents[int(stat.parent.name)] = int(fields[1])
    found = {parent}
    while more := {own for own, by in parents.items() if by in found} - found:
        found |= more
    return found


def look(parent: int, peaks: Peaks) -> None:
    """Note the peaks so far of a process and those that it has started."""
    for process in family(parent):
        try:
            lines = (PROC / str(process) / "status").read_text(encoding="utf-8").splitlines()
        except OSError:
            continue
        for line in lines:
            if line.startswith("VmHWM:"):
                peaks[process] = int(line.split()[1]) / 1024


def sweep(variants: int, suffix: str, jobs: int, peaks: Peaks) -> float:
    """Seconds of a sweep over three ratios in its own process; `peaks` get its processes."""
    counts = (100, 100, variants // 10_000)
    ranges = ("D1.ratio=-0.9:-0.7", "D2.ratio=2.4:2.8", "D3.ratio=-2.6:-2.3")
    varied = [f"--vary={text}:{count}" for text, count in zip(ranges, counts, strict=True)]
    with tempfile.TemporaryDirectory() as folder:
        if shutil.disk_usage(folder).free < BYTES * variants:
            sys.exit(f"{folder}: {BYTES * variants / 1e9:.1f} GB are needed; set TMPDIR")
        command = [*VSTATICS, "sweep", str(MZKT), *varied, "-o", f"out.{suffix}"]
        start = time.perf_counter()
        process = subprocess.Popen(
            [*command, "--jobs", str(jobs)], cwd=folder, stderr=subprocess.DEVNULL
        )
        peaks.clear()
        while process.poll() is None:
            look(process.pid, peaks)
            try:
                process.wait(timeout=LOOK)
            except subprocess.TimeoutExpired:
                continue
        seconds = time.perf_counter() - start
        if process.returncode:
            sys.exit(f"{' '.join(command)}: exit status {process.returncode}")
    return seconds


def loops(jobs: int, steps: int) -> float:
    """Seconds by loop of so many processes at a time that share nothing but the machine."""
    command = [sys.executable, "-c", LOOP, str(steps)]
    start = time.perf_counter()
    processes = [subprocess.Popen(command) for _ in range(jobs)]
    for process in processes:
        process.wait()
    return (time.perf_counter() - start) / jobs


def main() -> None:
    """Measure and print."""
    given = options(__doc__, peer=False)
    quick = (20_000, 20_000, 1000, 1)
    npz, csv, steps, rounds = quick if given.quick else (NPZ, CSV, STEPS, 5)
    bare = medians({str(jobs): partial(loops, jobs, steps) for jobs in (1, 2)}, rounds)
    gain = f"{bare['1'] / bare['2']:.2f}"
    rows: list[tuple[object, ...]] = [("loops that share nothing", 2, "", "", gain, "")]
    for suffix, variants in (("npz", npz), ("csv", csv)):
        peaks: dict[int, Peaks] = {1: {}, 2: {}}
        measured = medians(
            {str(jobs): partial(sweep, variants, suffix, jobs, peaks[jobs]) for jobs in (1, 2)},
            rounds,
        )
        for jobs in (1, 2):
            seconds = measured[str(jobs)]
            largest = sorted(peaks[jobs].values(), reverse=True)
            rows.append(
                (
                    f"{variants:,} to {suffix.upper()}",
                    jobs,
                    f"{seconds:.1f} s",
                    f"{variants / seconds:,.0f}",
                    f"{measured['1'] / seconds:.2f}",
                    ", ".join(f"{peak:.0f}" for peak in largest) or "-",
                )
            )
    print_table(
        "Sweeps of the MZKT deck, ratio and efficiency of six gears",
        ("", "jobs", "time", "variants a second", "times one job", "peak memory by process, MB"),
        rows,
    )


if __name__ == "__main__":
    main()
