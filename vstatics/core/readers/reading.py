"""Code shared by all readers of cases: the text with line numbers, and the final checks."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

from vstatics.core.errors import (
    CaseError,
    Path,
    Place,
    Problem,
    ReadError,
    not_allowed,
    plural,
    spoken,
)
from vstatics.core.groups import grouped
from vstatics.core.model.checks import doubtful_mechanisms, doubts
from vstatics.core.model.transmission import Transmission
from vstatics.core.start import NamedTuple

if TYPE_CHECKING:
    from vstatics.core.statics.results import Results


class Source:
    """Text of a file, with methods that return places (line and column)."""

    def __init__(self, file: str, text: str) -> None:
        self.file = file
        self.text = text

    @cached_property
    def lines(self) -> list[str]:
        """Lines of the text, without their line endings, which can be of any kind.

        Readers of long tables delete this cached list to save memory.
        """
        return self.text.replace("\r\n", "\n").replace("\r", "\n").split("\n")

    def place(self, line: int, column: int = 1) -> Place:
        """Return the place at a line and column, both from 1. Line 0 means the whole file."""
        text = self.lines[line - 1] if 0 < line <= len(self.lines) else ""
        return Place(self.file, line, column, text)


class Reading(NamedTuple):
    """Case that was read, with warnings and the places of all parts."""

    case: Transmission
    warnings: list[Problem]
    locate: Callable[[Problem], Problem]
    """Function that adds the place and the field name to a problem of the model."""

    def allowing(self, ids: Sequence[str]) -> Reading:
        """Return a reading in which further ids of messages are suppressed."""
        if not ids:
            return self
        case = self.case.replace(hushed=(*self.case.hushed, *ids))
        return self._replace(case=case, warnings=not_allowed(self.warnings, ids))

    def located_messages(self, results: Results, *, each_gear: bool) -> Iterator[Problem]:
        """Yield the messages of results with places; equal messages are merged.

        Messages that differ only in the gear are also merged unless `each_gear` is True.
        """
        if not results.messages:
            return
        numbers = {gear.name: number for number, gear in enumerate(results.case.gears, 1)}
        together = grouped(
            (message if each_gear else message._replace(gear=""), message)
            for message in results.messages
            if message.gear
        )
        for first, *others in together.values():
            place = self.locate(Problem(first.id, "", ("gears", numbers[first.gear]))).place
            names = spoken([first.gear, *(other.gear for other in others)])
            text = f"{plural('gear', 1 + len(others))} {names}: {first.text}"
            yield Problem(first.id, text, place=place)


def finish(
    parts: dict[str, Any],
    problems: Iterable[Problem],
    unreadable: Iterable[Path],
    locate: Callable[[Problem], Problem],
) -> Reading:
    """Build the case from its parts, and report all problems of text and model together.

    Parameters
    ----------
    parts : dict
        Arguments of `Transmission`, with stand-ins for unreadable values.
    problems : iterable of Problem
        Problems found by the reader, with their places.
    unreadable : iterable of Path
        Paths of the stand-ins. Problems of the model at these paths are not reported, nor warnings
        about the case as a whole.
    locate : callable
        Function that adds the place in the text to a problem of the model.

    Raises
    ------
    ReadError
        If there is any error. Contains the errors in the order of the text, then the warnings.
    """
    problems, hidden = list(problems), list(unreadable)
    is_certain = certain(hidden)
    try:
        case = Transmission(**parts)
    except CaseError as error:
        problems += [locate(problem) for problem in error.problems if is_certain(problem.path)]
    else:
        # A warning about the whole case can compare any of the values, including stand-ins.
        of_case = doubtful_mechanisms(case) if hidden else doubts(case)
        problems += [locate(problem) for problem in of_case if is_certain(problem.path)]
    problems.sort(key=lambda problem: problem.place[1:3] if problem.place else (0, 0))
    errors = [problem for problem in problems if problem.severity == "error"]
    doubtful = [problem for problem in problems if problem.severity != "error"]
    warnings = not_allowed(doubtful, parts.get("allow", ()))
    if errors:
        raise ReadError([*errors, *warnings])
    return Reading(case, warnings, locate)


def certain(unreadable: Iterable[Path]) -> Callable[[Path], bool]:
    """Return a function that accepts paths of problems that do not depend on a stand-in.

    The rows of a table or curve are compared with each other, so a stand-in in a row hides all
    problems of the table. The time of a call does not depend on the number of stand-ins.

    >>> is_certain = certain([("gears", 2, "loss", "rows", 1)])
    >>> is_certain(("gears", 1)), is_certain(("gears",)), is_certain(("gears", 2, "loss"))
    (True, False, False)
    """
    hidden = {path[:3] for path in unreadable}
    above = {path[:length] for path in hidden for length in range(len(path))}

    def is_certain(path: Path) -> bool:
        return path not in above and hidden.isdisjoint(path[:length] for length in range(4))

    return is_certain
