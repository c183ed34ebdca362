"""One of two cases on a page, and what both have as one table."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

from vstatics.core.annexes import report_parts
from vstatics.core.errors import Problem
from vstatics.core.statics.results import Results
from vstatics.core.tables.grid import Grid
from vstatics.page.report.asked import SECTIONS, AskedPage
from vstatics.page.report.material import UNNAMED, Material, Naming, gather
from vstatics.page.report.page_pictures import Pictures
from vstatics.page.report.pair.merged import merged
from vstatics.pictures.runs import PicturedRun

NO_PICTURES = Pictures()


class PagedCase(NamedTuple):
    """One of two cases."""

    label: str
    """A letter."""
    file: str
    """Its name without a path."""
    material: Material
    motion: PicturedRun | None = None
    """The run of a scenario."""

    @property
    def title(self) -> str:
        """As a page of its own has it."""
        name = self.material.results.case.name
        return self.material.naming.title(name, runs=self.motion is not None)


def paged(  # noqa: PLR0913, PLR0917 - as `gather`
    label: str,
    results: Results,
    file: str,
    problems: Iterable[Problem] = (),
    digits: int | None = None,
    naming: Naming = UNNAMED,
    motion: PicturedRun | None = None,
) -> PagedCase:
    """A case with what its side of the page is made of; parameters as of `gather`."""
    quick = AskedPage([key for key in SECTIONS if key not in report_parts()])
    options: dict[str, Any] = {"asked": quick, "has_marks": True, "drawn": NO_PICTURES}
    material = gather(results, problems, digits, None, naming, **options)
    return PagedCase(label, file, material, motion)


def merged_tables(both: Sequence[PagedCase], grids: Sequence[Grid | None]) -> Grid:
    """The tables of both as one; the other case may have none."""
    there = next(one for one in grids if one)
    empty = there._replace(columns=there.columns[:1], rows=[])
    return merged([one or empty for one in grids], "".join(one.label for one in both))
