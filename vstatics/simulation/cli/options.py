"""Options of `vstatics simulate`: scenario, single run, samples and output."""

from __future__ import annotations

from typing import Literal, NamedTuple, get_args

import click

from vstatics.core import readers
from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import formats
from vstatics.core.cli.shared.formats import OutputOptions
from vstatics.core.cli.shared.options import RenamedOption, gathered, under
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.sharing import Sharing, shared
from vstatics.core.cli.shared.values import FILE, above_0, value
from vstatics.simulation.tolerances import RTOL

Method = Literal["events", "tarasik"]
FORMATS = ("text", "json", "jsonl", "csv", "npz", "parquet", "markdown", "latex", "xlsx")


class SampleOptions(NamedTuple):
    """Options of random samples: number of runs, seed, columns and worker processes."""

    samples: int | None = None
    """Number of runs; None for a single run as written."""
    seed: int | None = None
    out: str | None = None
    sharing: Sharing = Sharing()

    def check(self, **of_one_run: bool) -> None:
        """Reject sampling options without `--samples`, and single-run options with `--samples`.

        Parameters
        ----------
        **of_one_run : bool
            True for each single-run option that is present, by its name.

        Raises
        ------
        UsageError
        """
        refused = [f"--{name}" for name, given in of_one_run.items() if given]
        if self.samples is not None and refused:
            raise click.UsageError(f"{refused[0]} applies to a single run: leave out --samples.")
        given = {"seed": self.seed, **self.sharing._asdict()}
        alone = [name for name, value in given.items() if value not in (None, False)]
        if self.samples is None and alone:
            raise click.UsageError(f"--{alone[0]} belongs to --samples.")


class SimulateOptions(NamedTuple):
    """Options of `vstatics simulate`."""

    scenario: str
    case: str | None
    step: float | None
    rtol: float
    method: Method
    limit: float | None
    damage: bool
    sampling: SampleOptions
    wanted: OutputOptions
    input_format: readers.Format | None
    telling: Telling


_SAMPLES = gathered(
    "sampling",
    SampleOptions,
    click.option(
        "--out",
        metavar="LIST",
        help="Columns to add, such as accelerations[out]. With --samples: all columns to write.",
    ),
    under(
        "Random samples",
        click.option(
            "--samples",
            type=click.IntRange(1),
            metavar="N",
            help="Number of runs with random numbers from the distributions in `samples`.",
        ),
        click.option(
            "--seed",
            type=click.IntRange(0),
            metavar="S",
            help="Seed of the random numbers.  [default: 0]",
        ),
    ),
    shared("a stopped run of --samples"),
)
options = gathered(
    "asked",
    SimulateOptions,
    click.argument("scenario", type=FILE, metavar="SCENARIO"),
    click.argument("case", type=FILE, metavar="[CASE]", required=False),
    click.option(
        "--time-step",
        "step",
        cls=RenamedOption,
        former=["--step"],
        type=float,
        callback=value(above_0),
        metavar="S",
        help="Add a row at every multiple of this time, in s.",
    ),
    click.option(
        "--rtol",
        type=float,
        default=RTOL,
        show_default=True,
        callback=value(above_0),
        metavar="X",
        help="Tolerance of speeds and energies, relative to their largest values.",
    ),
    click.option(
        "--method",
        type=click.Choice(get_args(Method)),
        default="events",
        help="Method of integration. `tarasik` uses equations (12) to (15) of Tarasik (2018), for "
        "comparison.",
    ),
    arguments.limit,
    click.option(
        "--damage", is_flag=True, help="Add the fatigue damage of components with `fatigue`."
    ),
    _SAMPLES,
    formats.options(*FORMATS),
    arguments.input_format,
    arguments.telling,
)
"""Decorator with all options, which the command receives as its argument `asked`."""
