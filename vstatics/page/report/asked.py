"""What of a case its page has: sections, gears, what is printed, a head that says whose it is."""

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
"""The sections of a page, of annexes too, by the words that choose them, in their order."""
PRINTED = (
    *("overview", "gears", "flow", "efficiency", "vehicle", "duty", "largest"),
    *(key for key, part in report_parts().items() if part.is_printed),
)
"""Those that are printed where nobody asks for others."""


class AskedPage(NamedTuple):
    """What of a case its page has.

    Parameters
    ----------
    sections : collection of str
        Keys of `SECTIONS`; nothing is all. What is asked for is printed, too.
    gears : sequence of str
        Names of the only gears of which something is shown; nothing is all.
    prints_all : bool
        Whether everything is printed that the screen shows.
    stamp : mapping of str to str
        A head: who made it, for what, when.
    """

    sections: Collection[str] = ()
    gears: Sequence[str] = ()
    prints_all: bool = False
    stamp: Mapping[str, str] = {}

    def has(self, section: str) -> bool:
        """Whether there is a section.

        >>> AskedPage().has("input"), AskedPage(["flow"]).has("input")
        (True, False)
        """
        return section in (self.sections or SECTIONS)

    def prints(self, section: str) -> bool:
        """Whether a section is printed.

        >>> AskedPage().prints("lever"), AskedPage(["lever"]).prints("lever")
        (False, True)
        """
        return self.prints_all or section in (self.sections or PRINTED)

    def in_full(self, section: str) -> bool:
        """Whether all is printed that the screen shows in a section.

        >>> AskedPage().in_full("flow"), AskedPage(["flow"]).in_full("flow")
        (False, True)
        """
        return self.prints_all or section in self.sections

    def shows(self, gear: str) -> bool:
        """Whether something is shown of a gear."""
        return gear in self.gears if self.gears else True

    def cut(self, grid: Grid) -> Grid:
        """A table with rows and columns of the gears that are shown, where it has any."""
        if not self.gears:
            return grid
        chosen = [
            place
            for place, one in enumerate(grid.columns)
            if one.over != "gear" or self.shows(one.heading)
        ]
        if grid.columns and grid.columns[0].heading == "gear":
            grid = grid._replace(rows=[row for row in grid.cells if self.shows(row[0].text)])
        return grid.with_columns(chosen)


EVERYTHING = AskedPage()


def section(name: str) -> str:
    """A section by its word.

    Raises
    ------
    ValueError
        If there is none.

    Examples
    --------
    >>> section("flow")
    'flow'
    """
    if name not in SECTIONS:
        raise ValueError(nearest(name, SECTIONS).lstrip("; ") or f"expected {', '.join(SECTIONS)}")
    return name
