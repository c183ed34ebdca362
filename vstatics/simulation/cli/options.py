"""What `vstatics simulate` takes: a scenario, how it is run once, or many times by samples."""

from __future__ import annotations

from typing import Literal, NamedTuple, get_args

import click

from vstatics.core import readers
from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import formats
from vstatics.core.cli.shared.formats import OutputOptions
from vstatics.core.cli.shared.options import gathered
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.sharing import Sharing, shared
from vstatics.core.cli.shared.values import above_0, value
from vstatics.simulation.tolerances import RTOL

Method = Literal["events", "tarasik"]
FORMATS = ("text", "json", "jsonl", "csv", "npz", "parquet", "markdown", "latex", "xlsx")


class SampleOptions(NamedTuple):
    """How many runs, and who calculates them."""

    samples: int | None = None
    """None: one run, of the scenario as it is."""
    seed: int | None = None
    out: str | None = None
    sharing: Sharing = Sharing()

    def check(self, **of_one_run: bool) -> None:
        """Refuse what belongs to samples where there are none, and what goes not with them.

        Parameters
        ----------
        **of_one_run : bool
            Options that are for one run, and whether they are given.

        Raises
        ------
        UsageError
        """
        of_one = [f"--{name}" for name, given in of_one_run.items() if given]
        if self.samples is not None and of_one:
            raise click.UsageError(f"{of_one[0]} is for one run, without --samples.")
        given = {"seed": self.seed, **self.sharing._asdict()}
        alone = [name for name, value in given.items() if value not in (None, False)]
        if self.samples is None and alone:
            raise click.UsageError(f"--{alone[0]} belongs to --samples.")


class SimulateOptions(NamedTuple):
    """A scenario, and how it is run."""

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
        "--samples",
        type=click.IntRange(1),
        metavar="N",
        help="N runs with numbers drawn as `samples` says: their statistics; -o has the runs.",
    ),
    click.option("--seed", type=click.IntRange(0), metavar="S", help="Of --samples.  [default: 0]"),
    click.option(
        "--out",
        metavar="LIST",
        help="More columns, as accelerations[out]; what is told of --samples.",
    ),
    shared("--samples that were stopped"),
)
options = gathered(
    "asked",
    SimulateOptions,
    click.argument("scenario", type=click.Path(), metavar="SCENARIO"),
    click.argument("case", type=click.Path(), metavar="[CASE]", required=False),
    click.option(
        "--step",
        type=float,
        callback=value(above_0),
        metavar="S",
        help="Also every multiple of this time, in s.",
    ),
    click.option(
        "--rtol",
        type=float,
        default=RTOL,
        show_default=True,
        callback=value(above_0),
        metavar="X",
        help="Accuracy of speeds and energies, as a part of their largest.",
    ),
    click.option(
        "--method",
        type=click.Choice(get_args(Method)),
        default="events",
        help="`tarasik`: the published equations (12) to (15), for comparison.",
    ),
    arguments.limit,
    click.option(
        "--damage", is_flag=True, help="Also what torques do to devices that have `fatigue`."
    ),
    _SAMPLES,
    formats.options(*FORMATS),
    arguments.input_format,
    arguments.telling,
)
"""All of them; the command gets `asked`."""
