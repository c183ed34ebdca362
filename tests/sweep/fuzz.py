"""Good inputs of readers of sweeps, for `tests.fuzz`."""

import io

import numpy as np

from tests.commands import CASES
from tests.fuzz import Kind
from vstatics import load, solve
from vstatics.sweep.file import read_sweep_file
from vstatics.sweep.results.columns import read_columns
from vstatics.sweep.results.expressions import read_expression
from vstatics.sweep.variants.table import read_table
from vstatics.sweep.variants.targets import target
from vstatics.sweep.variants.variation import read_variation


def kinds_of_sweeps() -> dict[str, Kind]:
    case = load(CASES / "mzkt7922.yaml")
    varied = [target("D1.ratio", case), target("D3.efficiency", case)]
    values = np.array([[-0.8, 0.97], [-0.9, 0.98]])
    numbers = solve(case)

    def expression(data: bytes) -> object:
        made = read_expression(data.decode(errors="replace"), case, varied, "--where")
        return made(numbers, values[:1])

    def columns(data: bytes) -> object:
        return read_columns(data.decode(errors="replace"), case, varied)

    def variation(data: bytes) -> object:
        return read_variation(data.decode(errors="replace"), case)

    return {
        "sweep file": Kind(
            (
                "case: box.yaml\nvary: {D1.ratio: [-3, -2], D2.efficiency: '.9:.99:5'}\n"
                "out: ratio[1],efficiency[1]\nwhere: ratio[1] > 2\nmax: ETA[1]\nbest: 3\n",
                "case: box.yaml\nsample: 1000\nmethod: sobol\nseed: 1\nvary: {D1.ratio: '-3:-2'}\n",
            ),
            lambda data: read_sweep_file(data, "sweep.yaml"),
        ),
        "table": Kind(
            ("D1.ratio,D3.efficiency\n-.8,.97\n-.9,.98\n", "D1.ratio;D2.ratio\n-0,8;2,6\n"),
            lambda data: read_table(io.BytesIO(data), "table.csv", case),
        ),
        "expression": Kind(
            (
                "abs(ratio[1] / ratio[2] - 1.8) < .1 and min(efficiency) > .9",
                "max(abs(slip_speeds[T1]), 2 * AMLGP[Mx, 1] ** 2) - D1.ratio",
                "not (W[2, :] <= 1) or IX[D1,1] == -1",
            ),
            expression,
        ),
        "columns": Kind(
            ("ratio[1],ETA[1],speeds[:,2]", "AMLGP[Mx,1] - AMLG[Mx,1], ratio"), columns
        ),
        "variation": Kind(
            ("D1.ratio=-3:-2:5", "D1.ratio=-3:-2", "D2.efficiency=.9,.95,.97", "D1.ratio=-96/39"),
            variation,
        ),
    }
