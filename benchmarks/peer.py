"""The compiled peer, and a transmission as the text of numbers that the peer reads.

In this order, separated by blanks: links, shift elements, mechanisms, mechanisms with a planet
ratio of their own; first links of the elements, then second ones; first, second and third links
of the mechanisms; ratios; efficiencies; numbers of the mechanisms with planet ratios, then these
ratios; gears; the number of engaged elements of each gear; these elements, gear by gear; two rows
of zeros. ``python -m benchmarks.peer CASE`` prints the text of a case.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from benchmarks.measuring import Setting, Timer, command, timer
from vstatics import Transmission, load


def compiled(folder: Path) -> Path:
    """Return the peer, compiled into a folder."""
    compiler = shutil.which(os.environ.get("CC", "cc"))
    if compiler is None:
        sys.exit("a C compiler is needed for the peer: install one, or name it in CC")
    program, source = folder / "peer", Path(__file__).with_name("peer.c")
    flags = ("-O3", "-march=native", "-Wall")
    subprocess.run([compiler, *flags, "-o", str(program), str(source), "-lm"], check=True)
    return program


class Peer:
    """The compiled peer with one case."""

    def __init__(self, setting: Setting, case: Transmission) -> None:
        self.folder, self.program = setting.folder, str(setting.peer)
        self.file = str(setting.folder / f"{case.links}-links.num")
        Path(self.file).write_text(numeric(case), encoding="ascii")

    def printed(self, variants: int) -> str:
        """Return the text for a number of variants; for 0 all tables, with all digits."""
        words = [self.program, self.file, str(variants)]
        return subprocess.run(words, check=True, capture_output=True, text=True).stdout

    def check_sum(self, variants: int) -> float:
        """Return the sum of input torque in the first gear and efficiency in the last one."""
        return float(self.printed(variants).split()[-1])

    def timer(self, variants: int, parts: int) -> Timer:
        """Return the measurement of variants, without the start and the reading of the case."""
        all_of_them, one = (
            timer(command(self.program, self.file, str(count), folder=self.folder))
            for count in (variants + 1, 1)
        )
        return lambda: (all_of_them() - one()) / parts


def numeric(case: Transmission) -> str:
    """Return the text of a case with one input, one output, and gears of engaged elements only.

    Raises
    ------
    ValueError
        If the peer cannot express the case.
    """
    plain = case.input == 1 and case.output == case.links and not case.coast
    for gear in case.gears:
        plain = plain and not (gear.speeds or gear.torques or gear.input or gear.output)
    if not plain:
        raise ValueError("the peer takes the input to be link 1, the output to be the last one")
    mechanisms, elements = case.mechanisms, case.shift_elements
    planets = {n: m.planet_ratio for n, m in enumerate(mechanisms, 1) if m.planet_ratio is not None}
    rows: list[Sequence[float]] = [
        [case.links, len(elements), len(mechanisms), len(planets)],
        *zip(*((element.first, element.second) for element in elements), strict=True),
        *zip(*(mechanism.links for mechanism in mechanisms), strict=True),
        [mechanism.ratio for mechanism in mechanisms],
        [mechanism.efficiency for mechanism in mechanisms],
        list(planets),
        list(planets.values()),
        [len(case.gears)],
        [len(gear.engaged) for gear in case.gears],
        *(gear.engaged for gear in case.gears),
        *2 * [[0] * len(case.gears)],
    ]
    return "".join(" ".join(map(repr, row)) + "\n" for row in rows)


if __name__ == "__main__":
    print(numeric(load(sys.argv[1])), end="")
