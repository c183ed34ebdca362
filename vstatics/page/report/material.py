"""Contents of the page of a case, calculated from its results."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from types import ModuleType
from typing import Any, NamedTuple

from vstatics.core.annexes import module, report_parts
from vstatics.core.errors import CaseError, Problem
from vstatics.core.flow.power import flows
from vstatics.core.flow.power_flow import GearFlow
from vstatics.core.statics.result_arrays import Message
from vstatics.core.statics.results import Results
from vstatics.core.summary import Summary, summarize
from vstatics.core.tables.grid import Grid
from vstatics.core.texts import tr
from vstatics.core.writers import result_json
from vstatics.page.report.asked import EVERYTHING, AskedPage
from vstatics.page.report.marks import marked
from vstatics.page.report.page_pictures import Pictures, pictures
from vstatics.page.report.tools.marks import with_tool_marks
from vstatics.pictures.paged.drawn import picture_of
from vstatics.pictures.paged.parts import PagePart, PartRequest
from vstatics.pictures.runs import PicturedRun


class Naming(NamedTuple):
    """Name and description of a page, from the file of the case or scenario."""

    name: str = ""
    """Name of the scenario, or of the case's file if there is no scenario."""
    description: str = ""
    """Description of the scenario."""

    def title(self, case: str, *, runs: bool) -> str:
        """Return the title of the page.

        Parameters
        ----------
        case : str
            Name of the case; can be empty.
        runs : bool
            True if the page shows a simulated run.

        Examples
        --------
        >>> Naming("box").title("", runs=False), Naming("box").title("8HP70", runs=False)
        ('box', '8HP70')
        >>> Naming("upshift").title("8HP70", runs=True), Naming().title("8HP70", runs=True)
        ('upshift, 8HP70', 'Run, 8HP70')
        """
        if runs:
            return f"{self.name or tr('Run')}, {case}" if case else self.name or tr("Run")
        return case or self.name or tr("Transmission")


UNNAMED = Naming()


class Material(NamedTuple):
    """Contents of the page of a case."""

    results: Results
    document: dict[str, Any]
    """Result of the case, as in the output of ``vstatics run -f json``."""
    summary: Summary
    flows: Sequence[GearFlow]
    pictures: Pictures
    messages: Sequence[str]
    """Messages about the input, then messages about the results."""
    without: str
    """Reason why the page has no pictures at all, or an empty text."""
    parts: Mapping[str, PagePart] = {}
    """Sections of annexes, by their key in `SECTIONS`."""
    digits: int | None = None
    """Number of decimals; None means a number that suits each quantity."""
    naming: Naming = UNNAMED
    asked: AskedPage = EVERYTHING
    has_marks: bool = False
    """True if numbers have marks for a script that changes values."""

    def marked(self, grids: Iterable[Grid]) -> Iterator[Grid]:
        """Return tables with marks on their numbers, if the page has marks."""
        if not self.has_marks:
            return iter(grids)
        return (with_tool_marks(marked(grid), self.results.case) for grid in grids)

    @property
    def has_run(self) -> bool:
        """True if the page shows the simulated run of a scenario."""
        return "run" in self.parts

    @property
    def shown_flows(self) -> Sequence[GearFlow]:
        """Power flows of the gears on the page."""
        return [flow for flow in self.flows if self.asked.shows(flow.gear)]


def gather(  # noqa: PLR0913 - contents and options of the page
    results: Results,
    problems: Iterable[Problem] = (),
    digits: int | None = None,
    motion: PicturedRun | None = None,
    naming: Naming = UNNAMED,
    *,
    asked: AskedPage = EVERYTHING,
    has_marks: bool = False,
    drawn: Pictures | None = None,
) -> Material:
    """Calculate the contents of the page of a case.

    Parameters
    ----------
    results : Results
        Results of a single case, not of variants.
    problems : iterable of Problem
        Warnings about the input; those that the results repeat are left out.
    digits : int, optional
        Number of decimals; by default a number that suits each quantity.
    motion : Motion, optional
        Simulated run of the case.
    naming : Naming, optional
        Name and description for the page.
    asked : AskedPage, optional
        Sections and gears of the page.
    has_marks : bool, optional
        True if numbers have marks for scripts; see `vstatics.page.report.marks`.
    drawn : Pictures, optional
        Placeholders instead of pictures.
    """
    without = ""
    if drawn is None:
        try:
            drawn = pictures(results, asked)
        except CaseError as error:
            without, drawn = str(error), Pictures()
    chosen = [n for n, gear in enumerate(results.case.gears, 1) if asked.shows(gear.name)]
    request = PartRequest(
        results,
        partial(picture_of, results),
        chosen if asked.gears else (),
        motion,
        has_pictures=not without,
        has_marks=has_marks,
    )
    messages = []
    for problem in problems:
        if not _is_among(problem, results.messages):
            # A message on the page contains the line, but not the name of the file.
            place = f"line {problem.place.line}: " if problem.place and problem.place.line else ""
            messages.append(f"{problem.severity}: {place}{problem.message}")
    return Material(
        results,
        result_json.document(results),
        summarize(results),
        flows(results),
        drawn,
        [*messages, *map(str, results.messages)],
        without,
        dict(_parts(request, asked)),
        digits,
        naming,
        asked,
        has_marks,
    )


def _parts(request: PartRequest, asked: AskedPage) -> Iterator[tuple[str, PagePart]]:
    for key in filter(asked.has, report_parts()):
        if part := part_of(key, request._replace(in_full=asked.in_full(key))):
            yield key, part


def part_of(key: str, request: PartRequest) -> PagePart | None:
    """Return the section of an annex, None if the case lacks its data."""
    part: PagePart | None = module_of_part(key).part(request)
    return part


def module_of_part(key: str) -> ModuleType:
    """Import the module of an annex's section."""
    return module(report_parts()[key].module)


def _is_among(problem: Problem, messages: Iterable[Message]) -> bool:
    """Return whether results repeat a problem of the input, except for the component it names."""
    text = problem.message
    return any(
        text.endswith(f": {message.text}" if message.gear else message.text.partition(": ")[2])
        for message in messages
    )
