"""Options of a sweep, declared once for the command line, sweep files and `sweep()`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, fields
from typing import Any, Literal, NamedTuple, get_args

from vstatics.core.errors import Place, Problem, ReadError
from vstatics.core.model.transmission import IdleConvention
from vstatics.sweep.formats import FORMATS
from vstatics.sweep.variants.samples import METHODS


class PlacedPart(NamedTuple):
    """Place in a sweep file of a part of the text of an option."""

    first: int
    """First column of the part in the text, from 1."""
    place: Place
    as_written: bool = True
    """True if the columns of text and file correspond; False for text joined from several lines."""


class PlacedFile(str):
    """Name of a file that a sweep file gives, with the place of the name."""

    __slots__ = ("place",)
    place: Place

    def at(self, place: Place) -> PlacedFile:
        """Set the place, and return the name."""
        self.place = place
        return self


class Text(NamedTuple):
    """Text of an option; text from a sweep file has the places of its parts."""

    text: str
    parts: tuple[PlacedPart, ...] = ()

    def place(self, column: int) -> Place | None:
        """Return the place of a column of the text."""
        for first, place, as_written in reversed(self.parts):
            if column >= first:
                further = column - first if as_written else 0
                return place._replace(column=place.column + further)
        return self.parts[0].place if self.parts else None


def joined(first: Text, others: tuple[Text, ...], separator: str) -> Text:
    """Join texts after a first text with a separator, and keep all places.

    >>> joined(Text("D1.ratio="), (Text("-2"), Text("-3")), ",").text
    'D1.ratio=-2,-3'
    """
    text, parts = first.text, list(first.parts)
    for number, other in enumerate(others):
        text += separator if number else ""
        parts += [part._replace(first=len(text) + part.first) for part in other.parts]
        text += other.text
    return Text(text, tuple(parts))


@contextmanager
def located(text: Text) -> Iterator[None]:
    """Add places in the sweep file to problems of the text of an option."""
    try:
        yield
    except ReadError as error:
        raise ReadError([_moved(problem, text) for problem in error.problems]) from None


def _moved(problem: Problem, text: Text) -> Problem:
    place = problem.place
    if place is None or not text.parts or not place.file.startswith("--"):
        return problem
    return problem._replace(place=text.place(place.column))


Kind = Literal["path", "count", "flag", "choice", "text", "texts", "list", "vary"]
"""Kind of the value of an option: `list` is a text with commas, `vary` are texts such as `a=1`."""


class Option(NamedTuple):
    """Declaration of an option; the name is the name of the field."""

    kind: Kind
    help: str = ""
    """Help on the command line; empty for an option that other commands have, too."""
    metavar: str | None = None
    short: str = ""
    """Short name on the command line."""
    least: int = 1
    """Smallest count."""
    choices: tuple[str, ...] = ()
    heading: str = "Variants"
    """Heading of the option in the help text."""
    key: str = ""
    """Name on the command line and in sweep files; empty for the name of the field."""


_ROWS = "Rows and columns"
_OUTPUT = "Output"


def _option(kind: Kind, help: str = "", **more: Any) -> Any:  # noqa: A002
    default = () if kind in ("texts", "vary") else None
    return field(default=default, metadata={"option": Option(kind, help, **more)})


@dataclass(frozen=True)
class SweepOptions:
    """Options of a command line, a sweep file or a call; `None` and () if missing."""

    case: str | None = _option("path")
    vary: tuple[Text, ...] = _option("vary", "Vary a number. Repeatable.", metavar="NAME=VALUES")
    zip: bool | None = _option(
        "flag", "Combine the first values, then the second, and so on, instead of a grid."
    )
    sample: int | None = _option("count", "Number of random variants within LOW:HIGH.", metavar="N")
    method: str | None = _option("choice", "Sampling method.  [default: sobol]", choices=METHODS)
    seed: int | None = _option(
        "count", "Seed of the random numbers.  [default: 0]", metavar="S", least=0
    )
    variants: str | None = _option(
        "path", "Table of variants: a column for each varied number.", metavar="FILE"
    )
    linked: tuple[Text, ...] = _option(
        "vary",
        "Calculate a further number of the case from varied numbers. Repeatable.",
        metavar="NAME=FORMULA",
        key="with",
    )
    out: Text | None = _option(  # noqa: RUF009 (a field)
        "list", "Columns to write.  [default: ratio,efficiency]", metavar="LIST", heading=_ROWS
    )
    where: Text | None = _option(  # noqa: RUF009 (a field)
        "text", "Keep the variants for which EXPR is true.", metavar="EXPR", heading=_ROWS
    )
    by: str | None = _option(
        "choice", "Write a row for each gear of a variant.", choices=("gear",), heading=_ROWS
    )
    min: tuple[Text, ...] = _option(
        "texts", "Keep the rows with the smallest EXPR.", metavar="EXPR", heading=_ROWS
    )
    max: tuple[Text, ...] = _option(
        "texts", "Keep the rows with the largest EXPR.", metavar="EXPR", heading=_ROWS
    )
    best: int | None = _option(
        "count", "Number of rows to keep.  [default: 20]", metavar="N", heading=_ROWS
    )
    output: str | None = _option(
        "path", "Output file, written completely or not at all.", short="-o", heading=_OUTPUT
    )
    format: str | None = _option(
        "choice",
        "Format of the output.  [default: by the suffix of -o, else csv]",
        short="-f",
        choices=FORMATS,
        heading=_OUTPUT,
    )
    coast: bool | None = _option("flag")
    idle: str | None = _option("choice", choices=get_args(IdleConvention))

    @classmethod
    def of(cls, **values: Any) -> SweepOptions:
        """Return options from plain values, in which texts are of type str.

        >>> SweepOptions.of(vary=["D1.ratio=-2,-3"], out=["ratio", "losses"]).out.text
        'ratio,losses'
        """
        return cls(
            **{name: _with_texts(OPTIONS[name].kind, value) for name, value in values.items()}
        )

    def over(self, others: SweepOptions) -> SweepOptions:
        """Return the options, completed by others.

        Options in `others` that these options exclude are dropped, together with options that
        depend on them. A given table, for example, replaces a grid. Objectives are replaced
        together.
        """
        options = vars(self)
        given = {name for name in options if says(options[name])}
        dropped = {"min", "max"} if given & {"min", "max"} else set()
        for rule in EXCLUSIONS:
            dropped |= set(rule.others) if rule.option in given else set()
            dropped |= {rule.option} if given & set(rule.others) else set()
        dropped |= {rule.option for rule in NEEDS if dropped - given >= set(rule.others)}
        completions = {name: value for name, value in vars(others).items() if name not in dropped}
        given_options = {name: value for name, value in options.items() if value not in (None, ())}
        return SweepOptions(**{**completions, **given_options})


OPTIONS: Mapping[str, Option] = {
    option_field.name: option_field.metadata["option"] for option_field in fields(SweepOptions)
}
"""All options by name, in order."""


KEYS: Mapping[str, str] = {option.key or name: name for name, option in OPTIONS.items()}
"""Names of the options by their names on the command line and in sweep files."""


class Rule(NamedTuple):
    """Option, and other options that it excludes, or of which it needs one."""

    option: str
    others: tuple[str, ...]
    message: str
    """Message with names of options in braces, which are spelled as given."""


EXCLUSIONS = (
    Rule(
        "variants",
        ("vary", "zip", "sample"),
        "{variants} is a table of all variants: it excludes {vary}, {zip} and {sample}",
    ),
    Rule("zip", ("sample",), "{zip} and {sample} exclude one another"),
)
NEEDS = (
    Rule("method", ("sample",), "{method} and {seed} belong to {sample}"),
    Rule("seed", ("sample",), "{method} and {seed} belong to {sample}"),
    Rule("best", ("min", "max"), "{best} needs {min} or {max}: the best by what?"),
)


def conflicts(said: Mapping[str, object], spelled: Callable[[str], str] = str) -> Iterator[str]:
    """Yield messages about options that are contradictory or incomplete.

    Parameters
    ----------
    said : mapping of str to object
        Options and their values.
    spelled : callable
        Function that spells an option as the user gave it: ``--zip``.

    Examples
    --------
    >>> list(conflicts({"zip": True, "sample": 5, "best": None}, "--{}".format))
    ['--zip and --sample exclude one another']
    """
    given = {name for name, value in said.items() if says(value)}
    names = {name: spelled(name) for name in OPTIONS}
    for rules, wanted in ((EXCLUSIONS, False), (NEEDS, True)):
        for rule in rules:
            if rule.option in given and given.isdisjoint(rule.others) == wanted:
                yield rule.message.format(**names)


def says(value: object) -> bool:
    """Return whether an option is given; a count of 0 is given, a flag that is False is not."""
    return value is not False and value not in (None, (), "")


def _with_texts(kind: Kind, value: Any) -> Any:
    if kind in ("vary", "texts"):
        return tuple(map(Text, value))
    if kind in ("text", "list") and value is not None:
        return Text(value if isinstance(value, str) else ",".join(value))
    return value
