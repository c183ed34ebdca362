"""Errors and problems of the program, their places, and texts for messages.

`VstaticsError` is the base class of all errors. `CaseError` is raised for an impossible
transmission, `ReadError` for a file that cannot be read or written. Both contain a list of
`Problem`, because a run reports all problems together. `printable` protects terminals from text of
unknown origin.
"""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Sequence
from typing import Literal, Protocol, TypeVar

from vstatics.core.start import NamedTuple

Path = tuple[str | int, ...]
"""Path of a value in a model, such as ``("mechanisms", 2, "ratio")``. Items count from 1."""


Severity = Literal["error", "warning", "note"]
SEVERITIES: dict[str, Severity] = {"E": "error", "W": "warning", "N": "note"}
"""Severity of a message, by the first letter of the id."""


class Place(NamedTuple):
    """Place in a text: file, line and column from 1, and the text of the line.

    Examples
    --------
    >>> str(Place("box.yaml", 7, 8))
    'box.yaml:7:8'
    """

    file: str
    line: int
    column: int
    text: str = ""

    def __str__(self) -> str:
        """Return the place as text at the beginning of a message."""
        return f"{self.file}:{self.line}:{self.column}" if self.line else self.file


class CellPlace(Place):
    """Cell of a workbook. Line and column are the row and column of the cell."""

    sheet: str = ""
    """Name of the sheet."""

    @classmethod
    def of(cls, place: Place, sheet: str) -> CellPlace:
        """Return the cell of a sheet at a place.

        >>> str(CellPlace.of(Place("box.xlsx", 4, 28), "gears"))
        'box.xlsx:gears!AB4'
        """
        cell = cls(*place)
        cell.sheet = sheet
        return cell

    def __str__(self) -> str:
        """Return the place in the notation of spreadsheet programs."""
        if not (self.sheet and self.line):
            return super().__str__()
        letters, number = "", self.column
        while number:
            number, letter = divmod(number - 1, 26)
            letters = chr(ord("A") + letter) + letters
        return f"{self.file}:{self.sheet}!{letters}{self.line}"


def excerpt(place: Place) -> tuple[str, str]:
    """Return the text around a place, shortened for a terminal, and a line with a caret below it.

    >>> excerpt(Place("a.yaml", 2, 4, "B1: [rign, housing]"))
    ('B1: [rign, housing]', '   ^')
    """
    width, column = 76, min(place.column, len(place.text) + 1)
    start = max(0, column - width // 2) if len(place.text) > width else 0
    part = place.text[start : start + width]
    shown = "".join(letter if letter.isprintable() else " " for letter in part)
    return shown, " " * (column - 1 - start) + "^"


def severity(identity: str) -> Severity:
    """Return the severity of an id.

    >>> severity("W201")
    'warning'
    """
    return SEVERITIES[identity[0]]


class Problem(NamedTuple):
    """Error, warning or note. The message contains the value that was read and the expectation.

    Examples
    --------
    >>> str(Problem("E190", "unknown key `a`", place=Place("box.yaml", 7, 8)))
    'box.yaml:7:8: error: unknown key `a` [E190]'
    """

    id: str
    """Id of the cause: a letter for the severity and three digits, such as ``E190``."""
    message: str
    path: Path = ()
    place: Place | None = None

    @property
    def severity(self) -> Severity:
        """Severity of the problem: error, warning or note."""
        return severity(self.id)

    @property
    def told(self) -> str:
        """Message followed by the id."""
        return f"{self.message} [{self.id}]"

    def __str__(self) -> str:
        """Return the problem as a line in the style of compilers, safe to print."""
        text = self.told
        if self.place is not None:
            return printable(f"{self.place}: {self.severity}: {text}")
        return printable(f"{path_text(self.path)}: {text}" if self.path else text)

    def in_file(self, file: str) -> Problem:
        """Return the problem without its path and with the whole file as its place."""
        return self._replace(path=(), place=Place(file, 0, 0))


class HasId(Protocol):
    """Interface of a message with an id."""

    @property
    def id(self) -> str:
        """Id: a letter for the severity and three digits."""


MessageType = TypeVar("MessageType", bound=HasId)


def not_allowed(messages: Iterable[MessageType], allow: Container[str]) -> list[MessageType]:
    """Return the messages whose ids are not suppressed by `allow`."""
    return [message for message in messages if message.id not in allow]


def of_file(identity: str, file: str, message: str) -> Problem:
    """Return a problem whose place is a whole file."""
    return Problem(identity, message).in_file(file)


class VstaticsError(Exception):
    """Base class of all errors that vstatics raises intentionally."""


class CaseError(VstaticsError):
    """Error of an impossible transmission; `problems` lists all faults."""

    def __init__(
        self,
        problems: Iterable[Problem] | str,
        message: str = "",
        path: Path = (),
        place: Place | None = None,
    ) -> None:
        """Store problems, or a single problem from its id and message.

        >>> CaseError("E234", "read 0, expected a ratio", ("mechanisms", 1, "ratio"))
        CaseError('mechanisms[1].ratio: read 0, expected a ratio [E234]')
        """
        given = [Problem(problems, message, path, place)] if isinstance(problems, str) else problems
        self.problems = list(given)
        super().__init__("\n".join(map(str, self.problems)))

    def __reduce__(self) -> tuple[type[CaseError], tuple[list[Problem]]]:
        """Return the class and the arguments of the constructor, for pickling."""
        return type(self), (self.problems,)


class ReadError(CaseError):
    """Error of a file that cannot be read or written; the problems have places."""


_OTHERS = "\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufeff"
"""Characters that are unsafe in any output: control characters above ASCII, line separators, marks
of writing direction, and lone surrogates (halves of a character).
"""
_IN_LINE, _IN_LINES = f"[\0-\x1f{_OTHERS}]", f"[\0-\x08\x0b-\x1f{_OTHERS}]"

_SAFE = bytes([*b"\n", *range(0x20, 0x7F)])
"""ASCII characters that are safe in any output: line feed and all printable characters."""


def printable(text: str, *, lines: bool = False) -> str:
    r"""Return a text in which all characters that could control a terminal are escaped.

    Parameters
    ----------
    text : str
        Text of unknown origin. JSON remains equivalent JSON.
    lines : bool
        True to leave line feeds and tabs unchanged.

    Examples
    --------
    >>> print(printable("\x1b[31mred\n"), printable("a\n\u202eb", lines=True))
    \u001b[31mred\u000a a
    \u202eb
    """
    if lines and text.isascii():
        is_safe = not text.encode().translate(None, _SAFE)
    else:
        is_safe = (text.replace("\n", "") if lines else text).isprintable()
    if is_safe:
        return text  # fast test, sufficient for nearly all texts
    pattern = _IN_LINES if lines else _IN_LINE
    return re.sub(pattern, lambda match: f"\\u{ord(match[0]):04x}", text)


def path_text(path: Path) -> str:
    """Return a path as text.

    >>> path_text(("mechanisms", 2, "ratio"))
    'mechanisms[2].ratio'
    """
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)
    return text.removeprefix(".")


def quoted(read: str) -> str:
    """Return a text in backquotes, shortened to 40 characters."""
    return f"`{read if len(read) <= 40 else read[:37] + '...'}`"


def percent(value: float) -> str:
    """Return an example if an efficiency seems to be in percent, otherwise an empty text.

    >>> percent(95.0), percent(1.02)
    (', such as 0.95 for 95 %', '')
    """
    return f", such as {value / 100:g} for {value:g} %" if 10 <= value <= 100 else ""


def spoken(names: Iterable[str], last: str = "and") -> str:
    """Return names joined with commas, but with a word before the last name.

    >>> spoken(["a"]), spoken(["a", "b"]), spoken(["a", "b", "c"], "or")
    ('a', 'a and b', 'a, b or c')
    """
    *others, end = [*names] or [""]
    return f"{', '.join(others)} {last} {end}" if others else end


def plural(noun: str, count: int) -> str:
    """Return the singular or plural of a noun.

    >>> plural("gear", 1), plural("gear", 0)
    ('gear', 'gears')
    """
    return noun if count == 1 else f"{noun}s"


def count_of(noun: str, count: int) -> str:
    """Return a number followed by a noun.

    >>> count_of("gear", 1), count_of("gear", 2)
    ('1 gear', '2 gears')
    """
    return f"{count} {plural(noun, count)}"


def typed_number(text: str, last: int) -> int | None:
    """Return the whole number in a text, if it is from 1 to `last`; else None.

    >>> typed_number("02", 3), typed_number("4", 3), typed_number("x", 3), typed_number("9" * 99, 3)
    (2, None, None, None)
    """
    digits = text.lstrip("0")
    if digits.isascii() and digits.isdigit() and len(digits) <= len(str(last)):
        return int(digits) if int(digits) <= last else None
    return None


def listed(names: Sequence[str], most: int = 8) -> str:
    """Return up to `most` names joined with commas; three points stand for further names."""
    return ", ".join(names[:most]) + (", ..." if len(names) > most else "")
