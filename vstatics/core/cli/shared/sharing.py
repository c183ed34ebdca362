"""Distribution of a command's work over processes, and resumption after a stop."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.exit_status import FAILED, stopped_by
from vstatics.core.cli.shared.options import PROCESSING, Command, Option, gathered, under
from vstatics.core.errors import CaseError
from vstatics.core.jobs.files import is_stream, unwritable
from vstatics.core.jobs.stopping import StoppedError

if TYPE_CHECKING:
    from vstatics.core.jobs.finished_cases import Description
    from vstatics.core.jobs.finished_pieces import FinishedPieces

JOBS = click.option(
    "-j",
    "--jobs",
    type=click.IntRange(1),
    metavar="N",
    help="Number of worker processes.  [default: number of cores]",
)


class Sharing(NamedTuple):
    """Values of -j, --scheduler and --resume."""

    jobs: int | None = None
    """Number of processes; None for the number of processor cores."""
    scheduler: str | None = None
    resume: bool = False

    @property
    def processes(self) -> int:
        """Number of processes on this computer."""
        from vstatics.core.jobs.workers import cores

        return 1 if self.scheduler else self.jobs or cores()

    def check(
        self, output: str | None, expected: str = "the output of the stopped run: -o FILE"
    ) -> None:
        """Raise an error for contradictory options, and for --resume without an output file.

        Raises
        ------
        UsageError
        """
        if self.scheduler and (self.jobs or 1) > 1:
            raise click.UsageError("--jobs and --scheduler exclude one another.")
        if self.resume and is_stream(output):
            raise click.UsageError(f"--resume needs {expected}.")

    def open(
        self,
        store: FinishedPieces,
        output: str,
        description: Description,
        pieces: int,
        done: str,
        *,
        quiet: bool,
    ) -> None:
        """Open the finished pieces of a command, to begin or resume its work.

        Parameters
        ----------
        done : str
            Words of a message after "every", such as "piece is searched".

        Raises
        ------
        ReadError
            If the pieces belong to other work.
        OSError
        """
        if self.resume and not (quiet or store.exists()) and os.path.exists(output):  # noqa: PTH110
            files.say(f"{output} may be of another {store.what}: every {done} again")
        without = store.open(description, pieces, resume=self.resume)
        if without and not quiet:
            files.say(f"{store.directory}: {without}; every {done}")


@contextmanager
def going_on_later(
    output: str, store: FinishedPieces, remains: Callable[[], str]
) -> Iterator[None]:
    """Run the block. If it is stopped or cannot write, report the stored work, and exit.

    Raises
    ------
    Exit
    """
    try:
        yield
    except StoppedError as stopped:
        files.say(f"stopped; {remains()}")
        status = stopped_by(stopped.signal)
    except OSError as error:
        files.show([unwritable(output, error)])
        files.say(remains())
        status = FAILED
    except CaseError as error:
        files.show(error.problems)
        if store.is_open and store.finished():  # refused pieces are not open
            files.say(remains())
        status = FAILED
    else:
        return
    raise click.exceptions.Exit(status)


def kept_pieces(finished: int, whole: str, store: FinishedPieces, output: str) -> str:
    """Return a sentence about the finished pieces from which a command can be resumed.

    Parameters
    ----------
    finished : int
    whole : str
        Total amount of work, such as "64 variants".
    """
    if not finished:
        return "nothing was finished"
    from vstatics.core.jobs.finished_pieces import SUFFIX  # not needed for the help text

    is_named = os.path.basename(output) not in (".", "..")  # noqa: PTH119
    name = f"{output}{SUFFIX}" if is_named else store.directory
    there = f"{finished} of {whole} are finished and kept in {name}"
    return f"{there}; the same command with --resume goes on"


def shared(resumed: str, *between: Option, jobs: Option = JOBS) -> Callable[[Command], Command]:
    """Return a decorator that adds the options of `Sharing` to a command, as argument `sharing`.

    Parameters
    ----------
    resumed : str
        Words in the help text for the work that --resume continues.
    *between : callable
        Options that come before --resume in the help text.
    jobs : callable
    """
    return gathered(
        "sharing",
        Sharing,
        under(
            PROCESSING,
            jobs,
            click.option(
                "--scheduler",
                metavar="ADDRESS",
                help="Address of a Dask scheduler, such as tcp://HOST:8786.",
            ),
            *between,
            click.option("--resume", is_flag=True, help=f"Resume {resumed}."),
        ),
    )
