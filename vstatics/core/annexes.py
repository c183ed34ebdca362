"""The annexes of the program and what each of them provides; no other module of the core knows one.

A record stands in ``annex.py`` of its annex. It is plain data, so that it can be read without what
it names, and it is read only when somebody asks for something that the core does not have.

>>> all(annex.name in _NAMES for annex in annexes())
True
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from importlib import import_module
from types import MappingProxyType, ModuleType
from typing import NamedTuple, TypeVar

Found = TypeVar("Found")

_NAMES = ("pictures", "sweep", "torsion", "simulation", "synthesis", "vehicle", "page")
_NOTHING: Mapping[str, str] = MappingProxyType({})
KEYS = MappingProxyType({"vehicle": "vehicle", "fatigue": "vehicle", "dump": "torsion"})
"""Key of a case, in the order of reading and writing -> the annex that provides it."""
DOCUMENTS = MappingProxyType(
    {
        "boxes": ("synthesis", b'"searched"'),
        "scenario": ("simulation", b"duration"),
        "sweep file": ("sweep", b"case"),
    }
)
"""Kind of documents other than cases -> its annex, and what they all contain, and hardly a case.

The names of the annexes are known here, too, so that a message can name one that is missing.
"""
COMMANDS = MappingProxyType(
    {
        "plot": "pictures",
        "sweep": "sweep",
        "torsion": "torsion",
        "simulate": "simulation",
        "synth": "synthesis",
        "cycle": "vehicle",
        "damage": "vehicle",
        "report": "page",
        "serve": "page",
    }
)
"""Command -> the annex that it belongs to, installed or not."""
PURPOSES = MappingProxyType(
    {
        "omega": "torsion",
        "plot": "pictures",
        "plot_sweep": "sweep",
        "plot_motion": "simulation",
        **dict.fromkeys(("damages", "torque_life", "vehicle_section"), "vehicle"),
    }
)
"""Other things that are asked for by name -> the annex that they belong to."""


class Command(NamedTuple):
    """A command of the program, which is imported when it is called."""

    module: str
    """Module with a function of the name of the command."""
    help: str
    """The line about it in the list of commands."""
    place: int
    """Commands are listed in ascending order of their places."""


class PictureKind(NamedTuple):
    """A kind of picture of `vstatics plot`."""

    module: str
    """Module that draws it, which is imported then."""
    help: str
    """Its description in the help of the command."""
    place: int
    """Kinds are listed in ascending order of their places."""
    title: str = ""
    """Its name on a page."""
    shows: str = "case"
    """Subject: case, vibration (a converter can be open), run, or a document of another kind."""
    options: Sequence[str] = ()
    """Options that few kinds have; see `Annex.picture_options`."""
    refused: Mapping[str, str] = _NOTHING
    """Option of most other kinds -> why this kind does not have it."""
    plots: str = ""
    """Function that plots a document of the kind that it shows."""
    least_width: float = 0.0
    """Width that its names and numbers need. [mm]"""
    alike: bool = False
    """Whether it can have the scales of another case, too."""


class DocumentKind(NamedTuple):
    """A kind of documents other than cases."""

    note: str
    """Message where a case is expected."""
    functions: Mapping[str, str] = _NOTHING
    """Function by which a command takes such a document -> the module that defines it."""


class Schema(NamedTuple):
    """A JSON Schema, by the type of what it describes."""

    module: str
    type: str
    """Name of the type in the module; without a title of the function that returns the schema."""
    title: str = ""
    documents: bool = True
    """Whether the type is that of each document of a file, or of the file as a whole."""


class ReportPart(NamedTuple):
    """A section of the page of a case."""

    name: str
    """Its heading."""
    module: str
    """Module with ``has_part(case, runs=...)`` and ``part(request)``."""
    place: int
    """Sections stand in ascending order of their places."""
    is_printed: bool = True
    """Whether it is printed unless other sections are asked for."""
    scripts: str = ""
    """Module with the `SCRIPTS` and the `STYLE` that a page with a run has, if any."""


class Annex(NamedTuple):
    """What an annex provides."""

    name: str
    needs: tuple[str, ...] = ()
    """Annexes that it imports from."""
    commands: Mapping[str, Command] = MappingProxyType({})
    names: Mapping[str, str] = _NOTHING
    """Public name of the package -> the module that defines it."""
    methods: Mapping[str, str] = _NOTHING
    """Function that the core or an earlier annex calls by name -> the module that defines it."""
    groups: Mapping[str, Mapping[str, tuple[str, str]]] = MappingProxyType({})
    """Command -> its sub-commands: name -> module, and the line of help about it."""
    own_names: Mapping[str, str] = _NOTHING
    """Public name of the annex itself -> the module that defines it."""
    pictures: Mapping[str, PictureKind] = MappingProxyType({})
    """Kind of picture -> what `vstatics plot` needs of it."""
    picture_options: Mapping[str, str] = _NOTHING
    """Option of pictures that few kinds have -> why {kinds} alone have it."""
    documents: Mapping[str, DocumentKind] = MappingProxyType({})
    """Kind of documents other than cases -> what commands can do with it."""
    schemas: Mapping[str, Schema] = MappingProxyType({})
    """Name of a file of `schemas/` -> the type that it describes."""
    report: Mapping[str, ReportPart] = MappingProxyType({})
    """Word that chooses a section of the page of a case -> the section."""
    keys: Mapping[str, str] = _NOTHING
    """Key of a case -> the module whose `KEY` declares it."""
    types: Mapping[str, str] = _NOTHING
    """Type of a part of other annexes' or the core's answers -> the module that defines it."""


@cache
def annexes() -> tuple[Annex, ...]:
    """Return the records of the annexes that are installed."""
    return tuple(_records())


def _records() -> list[Annex]:
    found = []
    for name in _NAMES:
        try:
            found.append(module(f"vstatics.{name}.annex").ANNEX)
        except ModuleNotFoundError as error:
            if error.name not in (f"vstatics.{name}", f"vstatics.{name}.annex"):
                raise
    return found


def module(name: str) -> ModuleType:
    """Import a record, or a module that a record names."""
    return import_module(name)


def _first(tables: Iterable[Mapping[str, Found]], name: str) -> Found | None:
    """Return the entry of a name in the first table that has the name."""
    return next((table[name] for table in tables if name in table), None)


def module_of_name(name: str) -> str:
    """Return the module of an annex that defines a public name; empty if there is none.

    >>> module_of_name("nothing")
    ''
    """
    return _first((annex.names for annex in annexes()), name) or ""


def public_names() -> list[str]:
    """Return the public names of the annexes that are installed."""
    return [name for annex in annexes() for name in annex.names]


def module_of_method(name: str) -> str:
    """Return the module of an annex that defines the function of a method; empty if none does."""
    return _first((annex.methods for annex in annexes()), name) or ""


def picture_kinds() -> Mapping[str, PictureKind]:
    """Return all kinds of pictures in the order of their places."""
    found = {kind: own for annex in annexes() for kind, own in annex.pictures.items()}
    return dict(sorted(found.items(), key=lambda entry: entry[1].place))


def picture_options() -> Mapping[str, str]:
    """Return the options of pictures that few kinds have, and what is said of other kinds."""
    return {name: why for annex in annexes() for name, why in annex.picture_options.items()}


def document_kind(kind: str) -> DocumentKind | None:
    """Return what is declared of a kind of documents; None if its annex is not installed."""
    return _first((annex.documents for annex in annexes()), kind)


def module_of_key(key: str) -> str:
    """Return the module that declares a key of a case; empty if its annex is not installed."""
    return _first((annex.keys for annex in annexes()), key) or ""


def module_of_type(name: str) -> str:
    """Return the module that defines a type of a part of an answer; empty if none does."""
    return _first((annex.types for annex in annexes()), name) or ""


def missing_command(name: str) -> str:
    """Return the message that the annex of a command is not installed; empty if it is."""
    if name not in COMMANDS or COMMANDS[name] in {annex.name for annex in annexes()}:
        return ""
    return not_installed(name, COMMANDS[name])


def not_installed(what: str, annex: str) -> str:
    """Return the message about a part of an annex that is not installed.

    >>> not_installed("omega", PURPOSES["omega"])
    'omega belongs to vstatics.torsion, which is not installed here'
    """
    return f"{what} belongs to vstatics.{annex}, which is not installed here"


def report_parts() -> Mapping[str, ReportPart]:
    """Return the sections that annexes add to the page of a case."""
    return {key: part for annex in annexes() for key, part in annex.report.items()}
