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
    """Place in a sweep file from which a part of an option's text was read."""

    first: int
    """Column in the text of the option where this part begins, from 1."""
    place: Place
    as_written: bool = True
    """True if columns of text and file correspond; False for a text joined from several lines."""


class PlacedFile(str):
    """File name in a sweep file, with the place of the name."""

    __slots__ = ("place",)
    place: Place

    def at(self, place: Place) -> PlacedFile:
        """Set the place of the file name, and return the name."""
        self.place = place
        return self


class Text(NamedTuple):
    """Text of an option; if from a sweep file, with the places of all parts."""

    text: str
    parts: tuple[PlacedPart, ...] = ()

    def place(self, column: int) -> Place | None:
        """Return the place of a column of the text, counted from 1, in the sweep file.

        Return None if the place is unknown.
        """
        for first, place, as_written in reversed(self.parts):
            if column >= first:
                further = column - first if as_written else 0
                return place._replace(column=place.column + further)
        return self.parts[0].place if self.parts else None


def joined(first: Text, others: tuple[Text, ...], separator: str) -> Text:
    """Append texts to a first text with separators between the texts, and keep all places.

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
    """Add the place in the sweep file to problems found in the text of an option."""
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
"""Kind of an option's value: `list` is a text with commas, `vary` is texts such as `a=1`."""


class Option(NamedTuple):
    """Declaration of an option, stored with the corresponding field of `SweepOptions`."""

    kind: Kind
    help: str = ""
    """Help on the command line; empty for an option whose help other commands share."""
    metavar: str | None = None
    short: str = ""
    """Single letter for the option on the command line; can be empty."""
    least: int = 1
    """Smallest value of an option of kind `count`."""
    choices: tuple[str, ...] = ()
    heading: str = "Variants"
    """Heading of the group of options in the help text."""
    key: str = ""
    """Name on the command line and in sweep files; if empty, the name of the field."""


_ROWS = "Rows and columns"
_OUTPUT = "Output"


def _option(kind: Kind, help: str = "", **more: Any) -> Any:  # noqa: A002
    default = () if kind in ("texts", "vary") else None
    return field(default=default, metadata={"option": Option(kind, help, **more)})


@dataclass(frozen=True)
class SweepOptions:
    """Options of a sweep from a command line, sweep file or call.

    Options that are not given are None or ().
    """

    case: str | None = _option("path")
    vary: tuple[Text, ...] = _option("vary", "Vary a number. Repeatable.", metavar="NAME=VALUES")
    zip: bool | None = _option(
        "flag",
        "Combine the first values of all --vary, then the second values, and so on, "
        "instead of a grid.",
    )
    sample: int | None = _option(
        "count", "Number of random variants in the ranges LOW:HIGH.", metavar="N"
    )
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
    out: Text | None = _option(  # noqa: RUF009 (immutable default)
        "list", "Columns to write.  [default: ratio,efficiency]", metavar="LIST", heading=_ROWS
    )
    where: Text | None = _option(  # noqa: RUF009 (immutable default)
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
        """Return options from plain values, with str instead of `Text`.

        >>> SweepOptions.of(vary=["D1.ratio=-2,-3"], out=["ratio", "losses"]).out.text
        'ratio,losses'
        """
        return cls(
            **{name: _with_texts(OPTIONS[name].kind, value) for name, value in values.items()}
        )

    def over(self, others: SweepOptions) -> SweepOptions:
        """Return these options, completed by other options.

        Other options that contradict these options are dropped, with any options that depend on
        them. For example, a given table of variants replaces a grid. If these options have an
        objective, all other objectives are dropped.
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
"""Declarations of all options by name, in the order of the fields."""


KEYS: Mapping[str, str] = {option.key or name: name for name, option in OPTIONS.items()}
"""Names of the fields of `SweepOptions`, by the name on the command line and in sweep files."""


class Rule(NamedTuple):
    """Rule that an option excludes all options in `others`, or needs an option in `others`."""

    option: str
    others: tuple[str, ...]
    message: str
    """Message with names of options in braces, to be replaced by the user's spelling."""


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
    """Yield a message for each contradictory or incomplete combination of options.

    Parameters
    ----------
    said : mapping of str to object
        Values of the options, by name.
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
    """Return whether an option is given: any value except None, False, empty text or tuple."""
    return value is not False and value not in (None, (), "")


def _with_texts(kind: Kind, value: Any) -> Any:
    if kind in ("vary", "texts"):
        return tuple(map(Text, value))
    if kind in ("text", "list") and value is not None:
        return Text(value if isinstance(value, str) else ",".join(value))
    return value
