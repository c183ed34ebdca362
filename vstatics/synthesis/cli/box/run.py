"""Search for gearboxes with output to a stream, file or directory. It can be resumed."""

from __future__ import annotations

import math
import time
from typing import NamedTuple

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.exit_status import DONE, FAILED, stopped_by
from vstatics.core.cli.shared.formats import Destination
from vstatics.core.cli.shared.progress import progress
from vstatics.core.cli.shared.sharing import Sharing, going_on_later, kept_pieces
from vstatics.core.errors import count_of
from vstatics.core.jobs.alone import Workers
from vstatics.core.jobs.files import is_stream
from vstatics.core.jobs.finished_pieces import FinishedPieces
from vstatics.core.jobs.piece_file import ASSEMBLED
from vstatics.core.jobs.stopping import StoppedError
from vstatics.core.jobs.workers import workers
from vstatics.synthesis.boxes.batches.cut import cut
from vstatics.synthesis.boxes.batches.found import prepare
from vstatics.synthesis.boxes.batches.work import (
    MOST_MEASURED,
    BoxWork,
    SearchedPieces,
    check_most,
    description,
    find,
    measure,
    portions,
)
from vstatics.synthesis.boxes.box import COARSEST
from vstatics.synthesis.boxes.choice import family_count, ranked
from vstatics.synthesis.boxes.figures.measured import MeasuredBox, measured
from vstatics.synthesis.cli.box.options import BoxAsked
from vstatics.synthesis.cli.box.output import FoundBoxes, write_folder
from vstatics.synthesis.code_cache import CACHE_TROUBLE
from vstatics.synthesis.compiled import HAS_COMPILER, WITHOUT_COMPILER

NEAREST_SECONDS = 10.0
"""Time limit of the search for the nearest gearbox. It follows a search without result that took no
longer. [s]
"""
FINEST = 0.01
"""Smallest tolerance in the search for the nearest gearbox. [-]"""


class BoxRun(NamedTuple):
    """Request for gearboxes, with output and workers."""

    asked: BoxAsked
    to: Destination
    sharing: Sharing
    quiet: bool
    complete: bool
    """True if a list from which gearboxes may be missing is a failure."""

    def workers(self, pieces: int) -> Workers:
        """Return the workers for the pieces of a search."""
        asked, scheduler = self.asked, self.sharing.scheduler
        work = BoxWork(asked.search, asked.efficiency, pieces, asked.weights)
        jobs = max(min(self.sharing.processes, pieces), 1)
        return workers(work, work.describe, jobs=jobs, scheduler=scheduler)


def carry_out(run: BoxRun) -> int:
    """Search, write the found gearboxes, print a summary, and return the exit status."""
    began = time.perf_counter()
    if not HAS_COMPILER:
        files.say(f"warning: {WITHOUT_COMPILER}")
    with progress(None, "made ready", quiet=run.quiet):
        prepare(run.asked.search)  # compiled once here, and not in every process
        count = cut(run.asked.search)
    for why in CACHE_TROUBLE[:1]:
        files.say(f"saved machine code cannot be used, so it is compiled again: {why}")
    result = _to_stream(run, count) if is_stream(run.to.output) else _to_store(run, count)
    if isinstance(result, int):
        return result
    took = time.perf_counter() - began
    if not (run.quiet or is_stream(run.to.output)):
        files.say(_summary(str(run.to.output), result, took))
    if result.boxes:
        return FAILED if run.complete and result.given_up else DONE
    if result.with_ratios:
        with_ratios = _boxes(result.with_ratios)
        files.say(f"no gearbox is found: {with_ratios} with these ratios, none as wanted")
    else:
        search = run.asked.search
        within = "these ranges" if search.tolerances else f"{search.tolerance:g} of these ratios"
        missed = _nearest(run) if took < NEAREST_SECONDS else ""
        files.say(f"no gearbox is found: none of {result.searched} is within {within}{missed}")
    return FAILED


def _nearest(run: BoxRun) -> str:
    """Return a hint about the nearest gearbox, if a search with wider tolerances soon ends."""
    search, end = run.asked.search, time.perf_counter() + NEAREST_SECONDS
    if search.tolerances or search.sequence is not None:
        return ""  # without a common tolerance, no gearbox is the nearest
    while search.tolerance < COARSEST:
        search = search._replace(tolerance=min(max(2 * search.tolerance, FINEST), COARSEST))
        wider = run._replace(asked=run.asked._replace(search=search))
        count, nearest = cut(search), None
        try:
            with wider.workers(count) as called:
                for _, piece in called.each(find, range(count)):
                    near = [*piece.boxes, *([nearest] if nearest else [])]
                    nearest = min(near, key=lambda box: box.error, default=None)
                    if time.perf_counter() > end:
                        return ""
        except StoppedError:
            return ""
        if nearest is not None:
            least = measured(search, nearest, run.asked.efficiency, run.asked.weights)
            gears = ", ".join(f"{gear.name}: {gear.ratio:.4g}" for gear in least.gears)
            return f"; the nearest has {gears}: --tolerance {rounded_up(nearest.error):g} finds it"
    return f", nor within {COARSEST:g}"


def rounded_up(error: float) -> float:
    """Round an error up to three digits.

    >>> rounded_up(0.0339211)
    0.034
    """
    unit = 10.0 ** (math.floor(math.log10(error)) - 2)
    return float(f"{math.ceil(error / unit) * unit:.3g}")


def _to_stream(run: BoxRun, count: int) -> FoundBoxes | int:
    """Search and write to a stream; return the exit status instead if interrupted."""
    pieces = SearchedPieces(count)
    try:
        with run.workers(count) as called:
            result = _search(run, pieces, called)
    except StoppedError as stopped:
        files.say(f"stopped after {pieces.done} of {count_of('piece', count)} of the search")
        return stopped_by(stopped.signal)
    files.write_data(result.text(run.to.form, run.to.style), run.to.output)
    return result


def _to_store(run: BoxRun, count: int) -> FoundBoxes:
    """Search and write a file or directory; an adjacent directory stores finished pieces."""
    output = str(run.to.output).rstrip("/") or "/"
    with FinishedPieces(output, "search", into_folder=run.to.is_folder) as store:
        whole = f"{count_of('piece', count)} of the search"
        with going_on_later(
            output, store, lambda: kept_pieces(len(store.finished()), whole, store, output)
        ):
            searched_for, quiet = description(run.asked.search, count), run.quiet
            run.sharing.open(store, output, searched_for, count, "piece is searched", quiet=quiet)
            with run.workers(count) as called:
                result = _search(run, SearchedPieces(count, store), called)
                if run.to.is_folder:
                    write_folder(output, result, run.to.style, called, quiet=quiet)
                    store.drop()
                else:
                    store.folder.replace(ASSEMBLED, result.text(run.to.form, run.to.style))
                    store.finish()
    if run.to.is_folder and run.to.form != "xlsx":
        files.write_data(result.text(run.to.form, run.to.style), None)
    return result


def _search(run: BoxRun, pieces: SearchedPieces, called: Workers) -> FoundBoxes:
    """Search the pending pieces, and calculate the figures of the found gearboxes."""
    with progress(pieces.count, "pieces", quiet=run.quiet) as advance:
        advance(pieces.done)
        for piece, boxes_of_piece in called.each(find, pieces.pending):
            pieces.take(piece, boxes_of_piece)
            advance(1)
    asked = run.asked
    if pieces.given_up:
        choices = f"{count_of('choice', pieces.given_up)} of shift elements could not be searched"
        advice = "expected narrower --bounds, or more --ratios"
        files.say(f"warning: {choices} completely, so gearboxes can be missing; {advice}")
    boxes = [box for box in pieces.boxes() if asked.wanted.before(box)]
    check_most(len(boxes), MOST_MEASURED)
    figured: list[MeasuredBox] = []
    with progress(len(boxes), "boxes", quiet=run.quiet) as advance:
        for _, some in called.each(measure, portions(boxes)):
            figured += some
            advance(len(some))
    chosen = ranked(asked.search, figured, asked.wanted, asked.order)
    return FoundBoxes(asked.search, pieces.searched, pieces.found, chosen, pieces.given_up)


def _summary(output: str, result: FoundBoxes, seconds: float) -> str:
    families = family_count(result.boxes)
    count = f"{_boxes(len(result.boxes))} in {families} {'family' if families == 1 else 'families'}"
    return f"{output}: {count} of {result.searched} that were looked at; {seconds:.3g} s"


def _boxes(count: int) -> str:
    return f"{count} {'box' if count == 1 else 'boxes'}"
