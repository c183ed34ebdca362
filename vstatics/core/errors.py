"""Errors and problems of the program, their places, and texts for messages.

`VstaticsError` is the parent of all errors. `CaseError` is raised for an impossible transmission,
`ReadError` for a text that cannot be read. Both have a list of `Problem`, because a run reports all
problems at once. Only the command line prints; `printable` protects the terminal from text of
unknown origin.
"""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Sequence
from typing import Literal, NamedTuple, Protocol, TypeVar

Path = tuple[str | int, ...]
"""Path of a value in a model, such as ``("mechanisms", 2, "ratio")``, with numbers from 1."""


Severity = Literal["error", "warning", "note"]
SEVERITIES: dict[str, Severity] = {"E": "error", "W": "warning", "N": "note"}
"""Severities by the first letter of an id; see docs/messages.md."""


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
        """Return the place in the form that begins a message."""
        return f"{self.file}:{self.line}:{self.column}" if self.line else self.file


class CellPlace(Place):
    """Cell of a workbook; line and column are the row and column of the cell."""

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
    """Return the part of a line around a place that fits on a terminal, and a caret for below.

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


DOUBTS = {
    "W101": "a field of a deck is missing, and taken as 0",
    "W102": "a link is joined to nothing else",
    "W201": "a mechanism is no plain set and has no planet ratio: it has no planet speed",
    "W202": "the inertia of an output seems to hold the mass of the vehicle, which has it already",
    "W301": "a wheel has teeth, but no link",
    "W311": "no planet fits between the wheels around it",
    "W312": "axes of wheels around one planet do not coincide",
    "W313": "planets can't mesh: their axes and the main one make no triangle",
    "W314": "tips of rims touch that are not to mesh",
    "W315": "tips of neighbouring planets touch",
    "W316": "tips of neighbouring planets of different rims touch",
    "W317": "equally spaced planets can't be assembled",
    "W318": "equally spaced bevel pinions can't be assembled",
    "W320": "a wheel does not fit into a ring",
    "W321": "tips of a wheel and a ring interfere",
    "W401": "a drag has a unit and the case no load: it is left out",
    "W411": "other freewheels could hold as well: the torques that they share are not determined",
    "W412": "a drag is left out, as statics does not determine the speed there",
    "W413": "a further output gives no torque, as nothing is given of it",
    "W414": "conditions for the speeds are missing: the gear is neutral, or lacks a shift element",
    "W415": "the output stands still: there is no ratio",
    "W416": "conditions say the same, or engaged elements are in excess",
    "W417": "rounding shows near a singular train: few digits are certain",
    "W418": "there are no torques in balance",
    "W419": "output torque times output speed is not 1: few digits are certain",
    "W420": "statics does not determine a torque",
    "W421": "friction locks the gear",
    "W422": "the gear is dragged: drag takes more than the input gives",
    "W423": "the search for directions of power was cut short",
    "W424": "statics leaves directions of power open",
    "W425": "no power flows through a mechanism by coincidence, on whose direction torques depend",
    "W426": "no torque, or more than one, agrees with losses that depend on speed or torque",
    "W427": "no torque, or more than one, balances the battery of a gear",
    "W428": "the engine of a driving cycle would turn faster than at its last point",
    "W429": "the engine of a driving cycle would have to give more than at full load",
    "W430": "a shift element carries more than its capacity",
    "W431": "a converter can't take the torque of the load at its speed ratio",
    "W440": "a drag without a unit is a part of the input torque, but seems to be in N*m",
    "W501": "a partial frequency that is taken out is near one that is kept",
    "W502": "what a simplified scheme takes no account of",
    "W503": "what is doubtful about the modes of a gear",
    "W601": "loss factors damp nothing, as nothing swings at the start",
    "W602": "a link without inertia turns at once",
    "W603": "a shift begins after the end of the scenario",
    "W604": "the inertia of a vehicle is not that of its mass",
    "W610": "energies of the published method do not close",
    "W801": "what is doubtful before teeth are looked for",
    "W802": "what is doubtful about teeth that are found",
    "W803": "a search for teeth was ended before it was proven that no others are better",
    "W804": "what is doubtful before ratios are fitted",
    "W805": "what is doubtful about ratios that are found",
    "W806": "a found box has other ratios, gears or engaged elements than its `case`",
    "W807": "a case has a key of an annex that is not installed, which is left out",
    "W880": "of a device with `fatigue` no torque is known, so that it is left out",
    "W890": "power passes by more than engine and output: nothing of the vehicle is told there",
    "W891": "a vehicle has a converter, which stays at its speed ratio",
    "W895": "an efficiency depends on the signs of idle mechanisms in the published listing",
    "W896": "a column that was asked for has no value",
    "N001": "a run would take more than a minute",
    "N002": "no ratios are given for a case of a scheme",
    "N003": "what is told of found structures",
    "N004": "what statics says of a gear whose run is shown",
    "N005": "columns of a driving cycle are skipped, as they have other names",
    "N201": "the input of a gear is taken to turn forward, on which freewheels depend",
    "N202": "mechanisms look as if they shared planets: losses may not be exact",
    "N203": "a mechanism of three links has the ratio 1",
    "N204": "a mechanism of ratio -1 has no planet ratio, as bevel differentials",
    "N205": "a number is larger than such a part has, as if its unit were left out",
    "N301": "several wheels share planets: losses of the reduced form are not exact",
    "N302": "two wheels turn alike, by a ratio of 1",
    "N303": "elements have a wheel and the carrier in common, as halves of one set",
    "N304": "a belt or chain without an efficiency has no loss",
    "N311": "no standard planet fits between the wheels: its number of teeth is not whole",
    "N312": "axes coincide by shifted profiles only",
    "N313": "rims of a planet have different modules",
    "N314": "planets can't mesh, if all rims have one module",
    "N315": "tips of wheels would touch where they stood side by side",
    "N316": "a chain runs roughly on few teeth",
    "N317": "a wheel needs a shifted profile: it would be undercut",
    "N318": "numbers of teeth have a common divisor: the same teeth meet often",
    "N319": "a wheel has so few teeth that a shifted profile does not save it from undercut",
    "N411": "losses turn the flow of power through a mechanism round",
    "N412": "several sets of directions of power agree with the losses",
    "N413": "a differential turns as one piece: torques with losses depend on a direction",
    "N414": "a drag, efficiency or converter is asked outside its points: the last one counts",
    "N415": "the speed ratio of a converter that is open in statics has no effect there",
    "N416": "power enters at a further output, whose torque drives",
    "N417": "as many gears go one way as the other: forward is taken as those written first",
    "N420": "links turn freely and carry no torque: they are free on purpose",
    "N501": "a case of clutch dump is on the safe side",
    "N502": "a case of clutch dump does not come",
    "N503": "the torque with a clutch that stays stuck",
    "N504": "the factor of engagement is for a clutch that slips",
    "N505": "what a clutch dump of a gear takes no account of",
    "N506": "which slope a spring with points has in a gear",
    "N507": "dry friction of a spring that linear vibration leaves out",
    "N601": "loss factors are taken as viscous damping",
    "N602": "elements that hold together share a torque that is open",
    "N603": "capacities without a unit are in N*m",
    "N605": "a control is above the capacity in the case: it is cut there",
    "N606": "what breaks away is open: others could in place of those whose slip is shown",
    "N607": "a run or vibration leaves the mass of `vehicle` out",
    "N610": "energies of the published method close",
    "N611": "a formula sets a state beyond its limits",
    "N613": "a link turns in the direction opposite to its target",
    "N630": "a response has no bound near resonances that nothing damps",
    "N801": "elements that no wanted ratio needs stay as they are",
}
"""Meanings of all warnings and notes, by id; errors cannot be suppressed."""


class Problem(NamedTuple):
    """Error, warning or note, with the value that was read and the expectation.

    Examples
    --------
    >>> str(Problem("E190", "unknown key `a`", place=Place("box.yaml", 7, 8)))
    'box.yaml:7:8: error: unknown key `a` [E190]'
    """

    id: str
    """Id of the cause, independent of names: a letter for the severity and three digits."""
    message: str
    path: Path = ()
    place: Place | None = None

    @property
    def severity(self) -> Severity:
        """Severity of the problem: error, warning or note."""
        return severity(self.id)

    @property
    def told(self) -> str:
        """Message followed by the id, as in answers."""
        return f"{self.message} [{self.id}]"

    def __str__(self) -> str:
        """Return the problem as a line in the format of a compiler, safe to print."""
        text = self.told
        if self.place is not None:
            return printable(f"{self.place}: {self.severity}: {text}")
        return printable(f"{path_text(self.path)}: {text}" if self.path else text)

    def in_file(self, file: str) -> Problem:
        """Return the problem without path, as a problem of a whole file."""
        return self._replace(path=(), place=Place(file, 0, 0))


class HasId(Protocol):
    """Message with an id."""

    @property
    def id(self) -> str:
        """Id: a letter for the severity and three digits."""


MessageType = TypeVar("MessageType", bound=HasId)


def not_allowed(messages: Iterable[MessageType], allow: Container[str]) -> list[MessageType]:
    """Return the messages whose ids are not suppressed by `allow`."""
    return [message for message in messages if message.id not in allow]


def of_file(identity: str, file: str, message: str) -> Problem:
    """Return a problem of a whole file."""
    return Problem(identity, message).in_file(file)


class VstaticsError(Exception):
    """Base class of all errors raised by this package on purpose."""


class CaseError(VstaticsError):
    """Error of an impossible transmission; `problems` lists all faults."""

    def __init__(
        self,
        problems: Iterable[Problem] | str,
        message: str = "",
        path: Path = (),
        place: Place | None = None,
    ) -> None:
        """Store problems, or a single problem given by id and message.

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
"""Characters unsafe in any output: control characters above ASCII, line separators, marks that
reverse the direction of writing, and lone surrogates."""
_IN_LINE, _IN_LINES = f"[\0-\x1f{_OTHERS}]", f"[\0-\x08\x0b-\x1f{_OTHERS}]"


def printable(text: str, *, lines: bool = False) -> str:
    r"""Escape all characters that could control a terminal; JSON stays equivalent JSON.

    Parameters
    ----------
    text : str
        Text of unknown origin.
    lines : bool
        Whether to keep line feeds and tabs.

    Examples
    --------
    >>> print(printable("\x1b[31mred\n"), printable("a\n\u202eb", lines=True))
    \u001b[31mred\u000a a
    \u202eb
    """
    if (text.replace("\n", "") if lines else text).isprintable():
        return text  # nearly all texts; the pattern below takes ten times as long
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


def spoken(names: Iterable[str], last: str = "and") -> str:
    """Join names with commas and a word before the last name.

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


def typed_number(text: str, last: int) -> int | None:
    """Return the number from 1 to `last` in a text, or None.

    >>> typed_number("02", 3), typed_number("4", 3), typed_number("x", 3), typed_number("9" * 99, 3)
    (2, None, None, None)
    """
    digits = text.lstrip("0")
    if digits.isascii() and digits.isdigit() and len(digits) <= len(str(last)):
        return int(digits) if int(digits) <= last else None
    return None


def listed(names: Sequence[str], most: int = 8) -> str:
    """Join at most `most` names with commas; three points mark omitted names."""
    return ", ".join(names[:most]) + (", ..." if len(names) > most else "")
