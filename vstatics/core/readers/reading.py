"""What every reader of cases shares: the text with its lines, and the way it ends."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from typing import Any, NamedTuple

from vstatics.core.errors import CaseError, Path, Place, Problem, ReadError, not_allowed
from vstatics.core.model.checks import doubts
from vstatics.core.model.transmission import Transmission


class Source:
    """A text and its file name; gives places in it."""

    def __init__(self, file: str, text: str) -> None:
        """Keep the text."""
        self.file = file
        self.text = text

    @cached_property
    def lines(self) -> list[str]:
        """The lines, whatever ends them; those of a long table are deleted when it is read."""
        return self.text.replace("\r\n", "\n").replace("\r", "\n").split("\n")

    def place(self, line: int, column: int = 1) -> Place:
        """The place at a line and column, both from 1; line 0 is the file as a whole."""
        text = self.lines[line - 1] if 0 < line <= len(self.lines) else ""
        return Place(self.file, line, column, text)


class Reading(NamedTuple):
    """A case that was read, what is doubtful about it, and where its parts stand."""

    case: Transmission
    warnings: list[Problem]
    locate: Callable[[Problem], Problem]
    """Gives a problem of the model its place, and puts the name of the field before it."""

    def allowing(self, ids: Sequence[str]) -> Reading:
        """The same with more messages that are not told, of which the case itself says nothing."""
        if not ids:
            return self
        case = self.case.replace(hushed=(*self.case.hushed, *ids))
        return self._replace(case=case, warnings=not_allowed(self.warnings, ids))


def finish(
    parts: dict[str, Any],
    found: Iterable[Problem],
    unreadable: Iterable[Path],
    locate: Callable[[Problem], Problem],
) -> Reading:
    """Make the case from its parts, and report all problems of text and model together.

    Parameters
    ----------
    parts : dict
        The arguments of `Transmission`; what could not be read holds a stand-in.
    found : iterable of Problem
        What the reader itself found, with places.
    unreadable : iterable of Path
        Where the stand-ins are: what the model says about these is not reported.
    locate : callable
        Gives a problem of the model its place in the text.

    Raises
    ------
    ReadError
        If there is any error: errors in the order of the text, then what is doubtful.
    """
    found = list(found)
    is_certain = certain(unreadable)
    try:
        case = Transmission(**parts)
    except CaseError as error:
        found += [locate(one) for one in error.problems if is_certain(one.path)]
    else:
        found += [locate(one) for one in doubts(case) if is_certain(one.path)]
    found.sort(key=lambda problem: problem.place[1:3] if problem.place else (0, 0))
    if any(problem.severity == "error" for problem in found):
        raise ReadError(sorted(found, key=lambda problem: problem.severity != "error"))
    return Reading(case, not_allowed(found, case.untold), locate)


def certain(unreadable: Iterable[Path]) -> Callable[[Path], bool]:
    """Tells whether no stand-in is above or below the part that a problem is about.

    However many there are of both, it takes no longer than to go through them once.

    >>> is_certain = certain([("gears", 2)])
    >>> is_certain(("gears", 1)), is_certain(("gears",)), is_certain(("gears", 2, "speeds"))
    (True, False, False)
    """
    hidden = set(unreadable)
    above = {path[:length] for path in hidden for length in range(len(path))}

    def is_certain(path: Path) -> bool:
        below = any(path[:length] in hidden for length in range(len(path) + 1))
        return path not in above and not below

    return is_certain
