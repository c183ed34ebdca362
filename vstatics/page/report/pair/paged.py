"""Contents of each of two cases on a page, and their merged tables."""

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
    """Case on a page that compares two cases, with its contents."""

    label: str
    """Letter of the case, A or B."""
    file: str
    """Name of the file without its folder."""
    material: Material
    motion: PicturedRun | None = None
    """Simulated run of a scenario, if any."""

    @property
    def title(self) -> str:
        """Title of the case, as on a page of a single case."""
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
    """Return a case with its contents for the page; parameters as in `gather`."""
    quick = AskedPage([key for key in SECTIONS if key not in report_parts()])
    options: dict[str, Any] = {"asked": quick, "has_marks": True, "drawn": NO_PICTURES}
    material = gather(results, problems, digits, None, naming, **options)
    return PagedCase(label, file, material, motion)


def merged_tables(both: Sequence[PagedCase], grids: Sequence[Grid | None]) -> Grid:
    """Merge the tables of both cases. A missing table counts as empty."""
    present = next(grid for grid in grids if grid)
    empty = present._replace(columns=present.columns[:1], rows=[])
    return merged([grid or empty for grid in grids], "".join(case.label for case in both))
