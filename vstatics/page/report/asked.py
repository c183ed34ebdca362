"""Choice of a page's contents: sections, gears, printed sections, and stamp."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

from vstatics.core.annexes import report_parts
from vstatics.core.suggestions import nearest
from vstatics.core.tables.grid import Grid

_PLACES = {
    "overview": ("Overview", 10),
    "gears": ("Gears", 30),
    "flow": ("Power flow", 40),
    "lever": ("Lever diagram", 50),
    "equations": ("Equations", 60),
    "efficiency": ("Efficiency", 70),
    "plan": ("Kinematic plan", 80),
    "vehicle": ("Vehicle", 90),
    "duty": ("Duty cycle", 100),
    "largest": ("Largest values", 120),
    "shifts": ("Shifts", 130),
    "input": ("Input", 140),
    "tables": ("Tables", 150),
    "conventions": ("Conventions", 160),
} | {key: (part.name, part.place) for key, part in report_parts().items()}
SECTIONS = {key: _PLACES[key][0] for key in sorted(_PLACES, key=lambda key: _PLACES[key][1])}
"""Headings of the sections by key, in the order of the page; includes annexes."""
PRINTED = (
    *("overview", "gears", "flow", "efficiency", "vehicle", "duty", "largest"),
    *(key for key, part in report_parts().items() if part.is_printed),
)
"""Keys of the sections that are printed by default."""


class AskedPage(NamedTuple):
    """Choice of the sections and gears on the page of a case, and of its printed sections.

    Parameters
    ----------
    sections : collection of str
        Keys of `SECTIONS`; empty for all sections. Chosen sections are also printed.
    gears : sequence of str
        Names of the gears to show; empty for all gears.
    prints_all : bool
        True to print everything that the screen shows.
    stamp : mapping of str to str
        Entries of the stamp at the head of the page, by name, such as author, project and date.
    """

    sections: Collection[str] = ()
    gears: Sequence[str] = ()
    prints_all: bool = False
    stamp: Mapping[str, str] = {}

    def has(self, section: str) -> bool:
        """Return whether the page has a section.

        >>> AskedPage().has("input"), AskedPage(["flow"]).has("input")
        (True, False)
        """
        return section in (self.sections or SECTIONS)

    def prints(self, section: str) -> bool:
        """Return whether a section is printed.

        >>> AskedPage().prints("lever"), AskedPage(["lever"]).prints("lever")
        (False, True)
        """
        return self.prints_all or section in (self.sections or PRINTED)

    def in_full(self, section: str) -> bool:
        """Return whether a section is printed in full, with everything that the screen shows.

        >>> AskedPage().in_full("flow"), AskedPage(["flow"]).in_full("flow")
        (False, True)
        """
        return self.prints_all or section in self.sections

    def shows(self, gear: str) -> bool:
        """Return whether the page shows a gear."""
        return gear in self.gears if self.gears else True

    def cut(self, grid: Grid) -> Grid:
        """Return a table without the rows and columns of gears that are not shown."""
        if not self.gears:
            return grid
        chosen = [
            place
            for place, column in enumerate(grid.columns)
            if column.over != "gear" or self.shows(column.heading)
        ]
        if grid.columns and grid.columns[0].heading == "gear":
            grid = grid._replace(rows=[row for row in grid.cells if self.shows(row[0].text)])
        return grid.with_columns(chosen)


EVERYTHING = AskedPage()


def section(name: str) -> str:
    """Return a name if it is the key of a section.

    Raises
    ------
    ValueError
        If no section has this key; the message suggests the nearest key.

    Examples
    --------
    >>> section("flow")
    'flow'
    """
    if name not in SECTIONS:
        raise ValueError(nearest(name, SECTIONS).lstrip("; ") or f"expected {', '.join(SECTIONS)}")
    return name
