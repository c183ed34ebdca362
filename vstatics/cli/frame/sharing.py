"""Who shares the work of a command, and whether work that was stopped is taken up."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import click

from vstatics.cli.frame.options import Command, Option, gathered
from vstatics.jobs.files import is_stream

JOBS = click.option("-j", "--jobs", type=click.IntRange(1), help="Processes.  [default: all cores]")


class Sharing(NamedTuple):
    """What -j, --scheduler and --resume say."""

    jobs: int | None = None
    """None: as many as there are cores."""
    scheduler: str | None = None
    resume: bool = False

    @property
    def processes(self) -> int:
        """So many processes share the work here."""
        from vstatics.jobs.workers import cores

        return 1 if self.scheduler else self.jobs or cores()

    def check(self, output: str | None, expected: str = "a file to go on with: -o FILE") -> None:
        """Refuse what does not go together, and nothing to go on with.

        Raises
        ------
        UsageError
        """
        if self.scheduler and (self.jobs or 1) > 1:
            raise click.UsageError("--jobs and --scheduler exclude one another.")
        if self.resume and is_stream(output):
            raise click.UsageError(f"--resume needs {expected}.")


def shared(resumed: str, *between: Option, jobs: Option = JOBS) -> Callable[[Command], Command]:
    """The options of who shares the work; the command gets `sharing`.

    Parameters
    ----------
    resumed : str
        What --resume goes on with.
    *between : callable
        Options before that.
    jobs : callable
    """
    return gathered(
        "sharing",
        Sharing,
        jobs,
        click.option(
            "--scheduler", metavar="ADDRESS", help="Dask scheduler, such as tcp://HOST:8786."
        ),
        *between,
        click.option("--resume", is_flag=True, help=f"Go on with {resumed}."),
    )
