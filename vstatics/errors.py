"""What can go wrong, and where.

Three classes of error: `VstaticsError`, the parent of all; `CaseError`, a
transmission that cannot be; `ReadError`, a text that cannot be read as one.
The last two carry a list of `Problem`, because one run reports all of them.
Only the command line prints. What it prints may hold text of anybody: `printable` makes it safe.
"""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Sequence
from typing import Literal, NamedTuple, Protocol, TypeVar

Path = tuple[str | int, ...]
"""Where a value stands in a model: ``("mechanisms", 2, "ratio")``, numbers from 1."""


Severity = Literal["error", "warning", "note"]
SEVERITIES: dict[str, Severity] = {"E": "error", "W": "warning", "N": "note"}
"""By the letters with which ids begin; see docs/messages.md."""


class Place(NamedTuple):
    """A place in a text: file, line and column from 1, and the line itself."""

    file: str
    line: int
    column: int
    text: str = ""


def severity(identity: str) -> Severity:
    """What the first letter of an id says.

    >>> severity("W201")
    'warning'
    """
    return SEVERITIES[identity[0]]


DOUBTS: dict[str, str] = {}
"""Of each warning and note its id, and what it says: these can be allowed."""


def why_not_allowed(identity: str) -> str:
    """Why no message of an id can be allowed; nothing where it can.

    >>> why_not_allowed("E234"), why_not_allowed("W999")
    ('`E234` is an error, expected a warning or a note', 'there is no message `W999`')
    """
    if identity in DOUBTS:
        return ""
    if re.fullmatch(r"E\d{3}", identity):
        return f"{quoted(identity)} is an error, expected a warning or a note"
    return f"there is no message {quoted(identity)}{nearest(identity, DOUBTS)}"


class Problem(NamedTuple):
    """One thing that is wrong or doubtful: what was read, what was expected."""

    id: str
    """Of its cause, whatever names it speaks of: a letter for the severity, and three digits."""
    message: str
    path: Path = ()
    place: Place | None = None

    @property
    def severity(self) -> Severity:
        """Whether it is an error, a warning or a note."""
        return severity(self.id)

    def __str__(self) -> str:
        """The problem in one line that is safe to print, in the wording of a compiler."""
        text = f"{self.message} [{self.id}]"
        if self.place is not None:
            file, line, column, _ = self.place
            where = f"{file}:{line}:{column}: " if line else f"{file}: "
            return printable(f"{where}{self.severity}: {text}")
        return printable(f"{path_text(self.path)}: {text}" if self.path else text)

    def in_file(self, file: str) -> Problem:
        """The same of a file as a whole."""
        return self._replace(path=(), place=Place(file, 0, 0))


class HasId(Protocol):
    """A message with the id of its cause."""

    @property
    def id(self) -> str:
        """A letter for the severity, and three digits."""


Told = TypeVar("Told", bound=HasId)


def not_allowed(found: Iterable[Told], allow: Container[str]) -> list[Told]:
    """The messages that are told: those whose id is not allowed."""
    return [one for one in found if one.id not in allow]


def of_file(identity: str, file: str, message: str) -> Problem:
    """A problem of a file as a whole."""
    return Problem(identity, message).in_file(file)


class VstaticsError(Exception):
    """Anything that this package raises on purpose."""


class CaseError(VstaticsError):
    """A transmission that cannot be; `problems` tells all that is wrong with it."""

    def __init__(
        self,
        problems: Iterable[Problem] | str,
        message: str = "",
        path: Path = (),
        place: Place | None = None,
    ) -> None:
        """Keep the problems, or the one of an id and a message; the text is a line for each.

        >>> CaseError("E234", "read 0, expected a ratio", ("mechanisms", 1, "ratio"))
        CaseError('mechanisms[1].ratio: read 0, expected a ratio [E234]')
        """
        given = [Problem(problems, message, path, place)] if isinstance(problems, str) else problems
        self.problems = list(given)
        super().__init__("\n".join(map(str, self.problems)))

    def __reduce__(self) -> tuple[type[CaseError], tuple[list[Problem]]]:
        """Come out of another process as what went in."""
        return type(self), (self.problems,)


class ReadError(CaseError):
    """A file that cannot be read as a case or a result, or not written; with places."""


_OTHERS = "\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufeff"
"""What no terminal should get: more controls, ends of lines, marks that turn the direction of
writing, half characters."""
_IN_LINE, _IN_LINES = f"[\0-\x1f{_OTHERS}]", f"[\0-\x08\x0b-\x1f{_OTHERS}]"


def printable(text: str, *, lines: bool = False) -> str:
    r"""A text that does nothing to a terminal, whoever wrote it; JSON stays the same JSON.

    Parameters
    ----------
    text : str
    lines : bool
        Whether ends of lines and tabs stay.

    Examples
    --------
    >>> print(printable("\x1b[31mred\n"), printable("a\n\u202eb", lines=True))
    \u001b[31mred\u000a a
    \u202eb
    """
    if (text.replace("\n", "") if lines else text).isprintable():
        return text  # as nearly all is, which a pattern takes ten times as long to see
    pattern = _IN_LINES if lines else _IN_LINE
    return re.sub(pattern, lambda found: f"\\u{ord(found[0]):04x}", text)


def path_text(path: Path) -> str:
    """A path as one writes it.

    >>> path_text(("mechanisms", 2, "ratio"))
    'mechanisms[2].ratio'
    """
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)
    return text.removeprefix(".")


def nearest(word: str, known: Iterable[str]) -> str:
    """A hint that names the known word nearest to a mistyped one, or nothing.

    >>> nearest("ratoi", ["ratio", "efficiency"]), nearest("eta", ["ratio", "ETA"])
    ('; did you mean `ratio`?', '; did you mean `ETA`?')
    >>> nearest("xyz", ["ratio", "efficiency"])
    ''
    """
    import difflib  # costs start-up time, and only mistakes need it

    words: dict[str, list[str]] = {}
    for one in known:
        words.setdefault(one.casefold(), []).append(one)
    matches = difflib.get_close_matches(word.casefold(), words, n=1)
    if not matches:
        return ""
    [match] = difflib.get_close_matches(word, words[matches[0]], n=1, cutoff=0)
    return f"; did you mean `{match}`?"


def quoted(read: str) -> str:
    """What was read, between marks and not too long."""
    return f"`{read if len(read) <= 40 else read[:37] + '...'}`"


def spoken(names: Iterable[str], last: str = "and") -> str:
    """Names as one says them, with a word before the last.

    >>> spoken(["a"]), spoken(["a", "b"]), spoken(["a", "b", "c"], "or")
    ('a', 'a and b', 'a, b or c')
    """
    *others, end = [*names] or [""]
    return f"{', '.join(others)} {last} {end}" if others else end


def plural(noun: str, count: int) -> str:
    """A noun as it stands with a number.

    >>> plural("gear", 1), plural("gear", 0)
    ('gear', 'gears')
    """
    return noun if count == 1 else f"{noun}s"


def typed_number(text: str, last: int) -> int | None:
    """The number from 1 that somebody typed for one of so many, if it is one.

    >>> typed_number("02", 3), typed_number("4", 3), typed_number("x", 3), typed_number("9" * 99, 3)
    (2, None, None, None)
    """
    digits = text.lstrip("0")
    if digits.isascii() and digits.isdigit() and len(digits) <= len(str(last)):
        return int(digits) if int(digits) <= last else None
    return None


def listed(names: Sequence[str], most: int = 8) -> str:
    """The first of some names."""
    return ", ".join(names[:most]) + (", ..." if len(names) > most else "")


def type_and_value(given: object) -> str:
    """What was given to a function, for a TypeError.

    >>> type_and_value("box.yaml")
    "str 'box.yaml'"
    """
    shown = repr(given)
    return f"{type(given).__name__} {shown if len(shown) <= 40 else shown[:37] + '...'}"
