"""Registry of the annexes: optional packages such as `vstatics.torsion`, built on the core.

The module ``annex.py`` of each annex contains a record (`Annex`) of its commands, public names,
pictures, keys and schemas. The core uses an annex only through this registry, so that an annex can
be deleted. A record contains names of modules, which are imported when needed. Records are imported
when the core does not contain a name.

>>> all(annex.name in _NAMES for annex in annexes())
True
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from importlib import import_module
from types import MappingProxyType, ModuleType
from typing import Never, TypeVar

from vstatics.core.start import NamedTuple

Entry = TypeVar("Entry")

_NAMES = ("pictures", "sweep", "torsion", "simulation", "synthesis", "vehicle", "page")
_NOTHING: Mapping[str, Never] = MappingProxyType({})
# These tables list all annexes, installed or not, so that messages can name a missing annex.
KEYS = MappingProxyType(
    {"vehicle": "vehicle", "fatigue": "vehicle", "bearings": "vehicle", "dump": "torsion"}
)
"""Annex that provides each key of a case, in the order of reading and writing."""
DOCUMENTS = MappingProxyType(
    {
        "boxes": ("synthesis", (b'"searched"',)),
        "scenario": ("simulation", (b"duration", b"start", b"shifts", b"controls")),
        "sweep file": ("sweep", (b"case",)),
    }
)
"""Annex for each kind of document other than cases, with texts that identify the kind.

Each document of the kind contains one of these texts. Cases hardly ever do.
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
"""Annex that provides each command."""
PURPOSES = MappingProxyType(
    {
        "omega": "torsion",
        "plot": "pictures",
        "plot_sweep": "sweep",
        "plot_motion": "simulation",
        **dict.fromkeys(
            ("damages", "duty_points", "full_load_curves", "torque_life", "vehicle_section"),
            "vehicle",
        ),
    }
)
"""Annex that provides each other function or feature, by name."""


class Command(NamedTuple):
    """Command of the program."""

    module: str
    """Module that defines the command as `NAME_command`."""
    help: str
    """Summary in the list of commands."""
    place: int
    """Position in the list of commands (sort key, ascending)."""


class PictureKind(NamedTuple):
    """Kind of picture drawn by `vstatics plot`."""

    module: str
    """Module that draws the picture."""
    help: str
    """Description in the help text of `vstatics plot`."""
    place: int
    """Position in lists of kinds (sort key, ascending)."""
    title: str = ""
    """Heading of the picture on a page."""
    shows: str = "case"
    """Subject of the picture: `case`, `vibration`, `run`, or another kind of document."""
    options: Sequence[str] = ()
    """Names of special options of the kind, from `Annex.picture_options`."""
    refused: Mapping[str, str] = _NOTHING
    """Common options that the kind does not support, with the reasons."""
    reads: str = ""
    """Name of a function that reads further files for the picture; empty if not needed."""
    plots: str = ""
    """Name of a function that draws a document; empty for pictures of a case."""
    least_width: float = 0.0
    """Smallest width of the picture with readable labels. [mm]"""
    alike: bool = False
    """True if pictures of two cases can be drawn with common scales."""
    at_any_load: bool = False
    """True if the picture does not depend on the operating point of the case."""


class DocumentKind(NamedTuple):
    """Kind of document other than cases."""

    note: str
    """Message when a user gives such a document instead of a case."""
    functions: Mapping[str, str] = _NOTHING
    """Modules of the functions that commands call for the document, by function name."""


class Schema(NamedTuple):
    """JSON Schema of a kind of files."""

    module: str
    type: str
    """Name of the described type or, without `title`, of a function that returns the schema."""
    title: str = ""
    documents: bool = True
    """True if the type describes each document in a file, False if it describes the whole file."""


class ReportPart(NamedTuple):
    """Section on the HTML page of a case."""

    name: str
    """Heading of the section."""
    module: str
    """Module that defines ``has_part(case, runs=...)`` and ``part(request)``."""
    place: int
    """Position of the section on the page (sort key, ascending)."""
    is_printed: bool = True
    """True if a page contains the section by default."""
    scripts: str = ""
    """Module with `SCRIPTS` and `STYLE` for a page with a simulation; empty without scripts."""


class Annex(NamedTuple):
    """Record of everything that an annex adds to the program.

    Modules have full names, and are imported only when needed.
    """

    name: str
    """Name of the package in `vstatics`."""
    needs: tuple[str, ...] = ()
    """Names of the annexes that this annex imports."""
    commands: Mapping[str, Command] = _NOTHING
    """Commands of `vstatics`, by name."""
    names: Mapping[str, str] = _NOTHING
    """Modules that define public names in `vstatics`, by name."""
    methods: Mapping[str, str] = _NOTHING
    """Modules of functions that the core or other annexes call by name."""
    groups: Mapping[str, Mapping[str, tuple[str, str]]] = _NOTHING
    """Sub-commands of each command: module and line of help, by name."""
    own_names: Mapping[str, str] = _NOTHING
    """Modules that define public names of the annex package, by name."""
    pictures: Mapping[str, PictureKind] = _NOTHING
    """Kinds of pictures, by the name of the kind."""
    picture_options: Mapping[str, str] = _NOTHING
    """Options that only some kinds of pictures support, with the message for other kinds.

    The message can contain ``{kinds}``, the names of the kinds.
    """
    documents: Mapping[str, DocumentKind] = _NOTHING
    """Kinds of documents other than cases, by the name of the kind."""
    schemas: Mapping[str, Schema] = _NOTHING
    """JSON Schemas, by the name of the file in `schemas/`."""
    report: Mapping[str, ReportPart] = _NOTHING
    """Sections for the HTML page of a case, by the word with which a user selects the section."""
    keys: Mapping[str, str] = _NOTHING
    """Modules whose `KEY` declares a key of a case, by name of the key."""
    types: Mapping[str, str] = _NOTHING
    """Modules that define types in records of the core or of other annexes, by name."""


@cache
def annexes() -> tuple[Annex, ...]:
    """Return the records of the installed annexes."""
    records = []
    for name in _NAMES:
        try:
            records.append(module(f"vstatics.{name}.annex").ANNEX)
        except ModuleNotFoundError as error:
            if error.name not in (f"vstatics.{name}", f"vstatics.{name}.annex"):
                raise
    return tuple(records)


def module(name: str) -> ModuleType:
    """Import a module from a record, and return it."""
    return import_module(name)


def _first(tables: Iterable[Mapping[str, Entry]], name: str) -> Entry | None:
    """Return the entry for a name from the first table that contains the name, or None."""
    return next((table[name] for table in tables if name in table), None)


def module_of_name(name: str) -> str:
    """Return the module of an annex that defines a public name; empty if unknown.

    >>> module_of_name("nothing")
    ''
    """
    return _first((annex.names for annex in annexes()), name) or ""


def public_names() -> list[str]:
    """Return the public names of the installed annexes."""
    return [name for annex in annexes() for name in annex.names]


def module_of_method(name: str) -> str:
    """Return the module of an annex from its `methods`, by function name; empty if unknown."""
    return _first((annex.methods for annex in annexes()), name) or ""


def picture_kinds() -> Mapping[str, PictureKind]:
    """Return all kinds of pictures, sorted by `place`."""
    kinds = {name: kind for annex in annexes() for name, kind in annex.pictures.items()}
    return dict(sorted(kinds.items(), key=lambda entry: entry[1].place))


def picture_kind_of(command: Sequence[str]) -> str:
    """Return the kind of picture that shows the results of a command; empty if none is obvious.

    The kind has the name of the command, or is the only kind of the annex with the command.

    >>> picture_kind_of(["vstatics", "run"])
    ''
    """
    named = [annex for annex in annexes() if not annex.commands.keys().isdisjoint(command)]
    only = [kind for annex in named if len(annex.pictures) == 1 for kind in annex.pictures]
    return next((kind for kind in picture_kinds() if kind in command or kind in only), "")


def picture_options() -> Mapping[str, str]:
    """Return the special options of pictures, with the message for other kinds."""
    return {name: why for annex in annexes() for name, why in annex.picture_options.items()}


def document_kind(kind: str) -> DocumentKind | None:
    """Return the declaration of a kind of document; None if no installed annex declares it."""
    return _first((annex.documents for annex in annexes()), kind)


def module_of_key(key: str) -> str:
    """Return the module that declares a key of a case; empty if the annex is missing."""
    return _first((annex.keys for annex in annexes()), key) or ""


def module_of_type(name: str) -> str:
    """Return the module of a type from the `types` of annexes; empty if the annex is missing."""
    return _first((annex.types for annex in annexes()), name) or ""


def missing_command(name: str) -> str:
    """Return the message that the annex of a command is missing; empty if it is installed."""
    if name not in COMMANDS or COMMANDS[name] in {annex.name for annex in annexes()}:
        return ""
    return not_installed(name, COMMANDS[name])


def not_installed(what: str, annex: str) -> str:
    """Return the message that the annex of a feature is not installed.

    >>> not_installed("omega", PURPOSES["omega"])
    'omega belongs to vstatics.torsion, which is not installed here'
    """
    return f"{what} belongs to vstatics.{annex}, which is not installed here"


def report_parts() -> Mapping[str, ReportPart]:
    """Return the sections that the annexes (optional packages) add to the HTML page of a case."""
    return {key: part for annex in annexes() for key, part in annex.report.items()}
