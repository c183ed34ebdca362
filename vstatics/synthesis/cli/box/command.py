"""Command `vstatics synth box`: gearboxes for wanted ratios."""

from __future__ import annotations

import os
import time
from typing import NamedTuple

import click

from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files, formats
from vstatics.core.cli.shared.estimates import CommandEstimate, about, duration_text
from vstatics.core.cli.shared.exit_status import DONE
from vstatics.core.cli.shared.formats import Destination, OutputOptions
from vstatics.core.cli.shared.options import PROCESSING, command, under
from vstatics.core.cli.shared.progress import progress
from vstatics.core.cli.shared.sharing import Sharing, shared
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.extras import missing, require
from vstatics.core.jobs.files import is_stream
from vstatics.synthesis.cli.box.options import BoxAsked, options

LOADING_SECONDS = 5.0
"""Loading time above which machine code was compiled, not just loaded from the cache. [s]"""


@command
@options
@formats.options(
    *formats.TABLES,
    output_help="Output file, or a directory for all gearboxes as cases with diagrams and a page.",
)
@shared("a stopped search; requires -o")
@under(
    PROCESSING,
    click.option(
        "--complete",
        is_flag=True,
        help="Exit with status 1 if the search may have missed gearboxes.",
    ),
    click.option(
        "--dry-run",
        is_flag=True,
        help="Print only estimates of the number of gearboxes and of the time.",
    ),
)
@arguments.quiet
def box_command(
    asked: BoxAsked,
    wanted: OutputOptions,
    sharing: Sharing,
    complete: bool,
    dry_run: bool,
    quiet: bool,
) -> int:
    """Find all gearboxes of N planetary gear sets and M shift elements for wanted ratios.

    All structures of the gear sets are tried with all inputs and outputs, all brakes on
    links other than input and output, and all clutches between two links. A gearbox is
    found if ratios of its gear sets exist with which every gear is within the tolerance.
    The gearboxes are listed by the mean loss of their forward gears. Gearboxes with equal
    ratios in all gears are a family.

    -o DIR writes each gearbox as a case with its stick diagram, and for all gearboxes together
    the tables and an HTML page. Files of an earlier search in DIR are replaced. If you have
    edited one of these files, the command stops and replaces nothing.

    \b
    Examples:
      vstatics synth box --sets 2 --shift-elements 4 --engaged 2 --own-input \\
          --ratios 2.45,1.45,1,-2.2
      vstatics synth box --sets 2 --shift-elements 4 --engaged 2 --own-input \\
          --ratios 2.45,1.45,1,-2.2 --limit torque=4 -o found/
      vstatics synth box --sets 4 --shift-elements 5 --engaged 3 \\
          --ratios 4.70,3.13,2.10,1.67,1.28,1,0.84,0.67,-3.30 \\
          --tolerance 0.005 --dry-run

    During the search, finished pieces are kept in DIR.parts or FILE.parts. --resume
    continues from them, also with other options of the selection.

    The search needs networkx, and numba for its speed: pip install ".[boxes]" in the
    source folder. Diagrams also need matplotlib, ".[boxes,plot]".

    \b
    Exit status 1: no gearbox is found, the search is not finished, or, with
    --complete, the search may have missed gearboxes.
    """
    try:
        require("boxes", "synth box")
        to = wanted.destination([], several=True)
        if to.output and os.path.islink(to.output.rstrip("/")) and not is_stream(to.output):  # noqa: PTH114
            raise click.UsageError(f"{to.output} is a link: expected a directory or a file")
        if to.is_folder:
            _check_folder(str(to.output))
        sharing.check(to.output, "the output of the stopped search: -o DIR or FILE")
        if sharing.scheduler is not None:
            require("dask", "--scheduler")
        if dry_run:
            _print_estimate(asked, to, sharing.processes, quiet=quiet)
            return DONE
        from vstatics.synthesis.cli.box.run import BoxRun, carry_out

        return carry_out(BoxRun(asked, to, sharing, quiet, complete))
    except CaseError as error:  # printed in the same way as an error in a file
        raise ReadError(error.problems) from error


def _check_folder(output: str) -> None:
    """Refuse an unusable output directory before the search begins.

    Raises
    ------
    UsageError
    """
    if not output:
        raise click.UsageError("-o names nothing: expected a directory or a file.")
    if os.path.exists(output.rstrip("/") or "/") and not os.path.isdir(output):  # noqa: PTH110, PTH112
        raise click.UsageError(f"{output} is a file: expected a directory")
    from vstatics.synthesis.cli.box.output import of_others

    if name := of_others(output):
        path = os.path.join(output, name)  # noqa: PTH118
        what = f"{path} is not as a search wrote it, so it may be yours, and would be lost"
        raise click.UsageError(f"{what}; move it away, or expected another directory")


class BoxSearchEstimate(NamedTuple):
    """Estimated size and time of a search."""

    searched: float
    """Number of gearboxes to examine."""
    found: float
    """Number of gearboxes with the wanted ratios."""
    exact: bool
    """True if the whole search was carried out, so that the numbers of gearboxes are exact."""
    at_least: bool
    """True if sampled searches were aborted for lack of time, so that `seconds` is a lower bound.
    """
    seconds: float
    """Time of the search with all processes, including writing of the directory. [s]"""
    compile_seconds: float
    """Processor time to compile or load machine code. [s]"""


def _print_estimate(asked: BoxAsked, to: Destination, jobs: int, *, quiet: bool) -> None:
    from vstatics.synthesis.boxes.batches.estimate import box_estimate
    from vstatics.synthesis.boxes.batches.found import prepare
    from vstatics.synthesis.code_cache import CACHE
    from vstatics.synthesis.compiled import HAS_COMPILER, WITHOUT_COMPILER

    began = time.process_time()
    with progress(None, "compiled", quiet=quiet):
        prepare(asked.search)
    compiling = time.process_time() - began
    with progress(None, "pieces tried", quiet=quiet):
        estimate = box_estimate(asked.search)
    count_text = (lambda number: f"{number:.0f}") if estimate.exact else about
    seconds = estimate.seconds / min(jobs, max(estimate.pieces, 1))
    counts = round(estimate.boxes), round(estimate.found)
    texts = {
        "boxes": count_text(estimate.boxes),
        "found": count_text(estimate.found) if estimate.exact or estimate.found else "few, or none",
    }
    if to.is_folder:
        from vstatics.synthesis.cli.box.output import drawn_count, writing_seconds

        writing = writing_seconds(counts[1]) / jobs
        count = drawn_count(counts[1])
        drawn = (
            f"{count_text(count)} diagrams"
            if count or not counts[1]
            else missing("plot", "a diagram")
        )
        texts["files"] = (
            f"{count_text(counts[1])} cases, {drawn}, in about {duration_text(writing)}"
        )
        seconds += writing
    if not HAS_COMPILER:
        texts["compiled"] = f"not: {WITHOUT_COMPILER}"
    elif compiling > LOADING_SECONDS:
        later = "and kept for later calls" if CACHE else "and again at each call: it cannot be kept"
        texts["compiled"] = f"now, in {duration_text(compiling)}, {later}"
    printed = CommandEstimate(
        texts,
        BoxSearchEstimate(*counts, estimate.exact, estimate.at_least, seconds, compiling),
        seconds,
        jobs,
        estimate.at_least,
    )
    files.write_output(printed.text(to.form), None)
