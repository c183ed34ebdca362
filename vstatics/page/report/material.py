"""Everything that the page shows of a case, calculated once."""

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
    """What a case does not say of itself."""

    name: str = ""
    """Of the scenario that runs it; else of its file, for a case without a name."""
    description: str = ""
    """Of the scenario."""

    def title(self, case: str, *, runs: bool) -> str:
        """The title of the page.

        Parameters
        ----------
        case : str
            The name that the case has, if any.
        runs : bool
            Whether the page has a run.

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
    """What the page is made of."""

    results: Results
    document: dict[str, Any]
    """The result as ``vstatics run -f json`` writes it."""
    summary: Summary
    flows: Sequence[GearFlow]
    pictures: Pictures
    messages: Sequence[str]
    """Of the input, then of the results."""
    without: str
    """Why there are no pictures at all, else nothing."""
    parts: Mapping[str, PagePart] = {}
    """Sections of annexes, by the words that choose them."""
    digits: int | None = None
    """After the point; None: those that suit a number."""
    naming: Naming = UNNAMED
    asked: AskedPage = EVERYTHING
    has_marks: bool = False
    """Whether numbers say what they are, for a script that changes them."""

    def marked(self, grids: Iterable[Grid]) -> Iterator[Grid]:
        """Tables as the page has them, with marks on their numbers if it has these."""
        if not self.has_marks:
            return iter(grids)
        return (with_tool_marks(marked(one), self.results.case) for one in grids)

    @property
    def has_run(self) -> bool:
        """Whether the page has the run of a scenario."""
        return "run" in self.parts

    @property
    def shown_flows(self) -> Sequence[GearFlow]:
        """Of the gears that are shown."""
        return [one for one in self.flows if self.asked.shows(one.gear)]


def gather(  # noqa: PLR0913 - what there is, and how it is shown
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
    """What the page of a case shows.

    Parameters
    ----------
    results : Results
        Of one case, not of arrays of variants.
    problems : iterable of Problem
        Warnings of the input; those that are among the messages of the results already
        do not come twice.
    digits : int, optional
        After the point, where they are not those that suit a number.
    motion : Motion, optional
        A run of the case.
    naming : Naming, optional
        What the case does not say of itself: the name of its file, the scenario.
    asked : AskedPage, optional
        What of it the page has.
    has_marks : bool, optional
        Whether numbers say what they are; see `vstatics.page.report.marks`.
    drawn : Pictures, optional
        What stands in place of the pictures that would be drawn.
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
    told = []
    for one in problems:
        if not _is_among(one, results.messages):  # with its line, but not its file
            line = one.place.line if one.place else 0
            told.append(f"{one.severity}: {f'line {line}: ' if line else ''}{one.message}")
    return Material(
        results,
        result_json.document(results),
        summarize(results),
        flows(results),
        drawn,
        [*told, *map(str, results.messages)],
        without,
        dict(_parts(request, asked)),
        digits,
        naming,
        asked,
        has_marks,
    )


def _parts(request: PartRequest, asked: AskedPage) -> Iterator[tuple[str, PagePart]]:
    """Yield the sections of annexes that the page has."""
    for key in filter(asked.has, report_parts()):
        if part := part_of(key, request._replace(in_full=asked.in_full(key))):
            yield key, part


def part_of(key: str, request: PartRequest) -> PagePart | None:
    """Return a section of an annex; nothing where the case has nothing for it."""
    part: PagePart | None = module_of_part(key).part(request)
    return part


def module_of_part(key: str) -> ModuleType:
    """Import the module of a section of an annex."""
    return module(report_parts()[key].module)


def _is_among(problem: Problem, messages: Iterable[Message]) -> bool:
    """Whether a message says it too: readers name fields, results name the parts."""
    said = problem.message
    return any(
        said.endswith(f": {one.text}" if one.gear else one.text.partition(": ")[2])
        for one in messages
    )
