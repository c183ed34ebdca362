"""The annexes of the program and what each of them provides; no other module of the core knows one.

A record stands in ``annex.py`` of its annex. It is plain data, so that it can be read without what
it names, and it is read only when somebody asks for something that the core does not have.

>>> [annex.name for annex in annexes()][:2]
['pictures', 'sweep']
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib import import_module
from types import MappingProxyType, ModuleType
from typing import NamedTuple

_NAMES = ("pictures", "sweep", "torsion", "simulation", "synthesis", "vehicle", "page")
_NOTHING: Mapping[str, str] = MappingProxyType({})
KEYS = MappingProxyType({"vehicle": "vehicle", "fatigue": "vehicle", "dump": "torsion"})
"""Key of a case, in the order of reading and writing -> the annex that provides it.

The names of the annexes are known here, too, so that a message can name one that is missing.
"""


class Command(NamedTuple):
    """A command of the program, which is imported when it is called."""

    module: str
    """Module with a function of the name of the command."""
    help: str
    """The line about it in the list of commands."""
    place: int
    """Commands are listed in ascending order of their places."""


class Annex(NamedTuple):
    """What an annex provides."""

    name: str
    commands: Mapping[str, Command] = MappingProxyType({})
    names: Mapping[str, str] = _NOTHING
    """Public name of the package -> the module that defines it."""
    methods: Mapping[str, str] = _NOTHING
    """Function that the core calls by its name alone -> the module that defines it."""
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


def module_of_name(name: str) -> str:
    """Return the module of an annex that defines a public name; empty if there is none.

    >>> module_of_name("simulate"), module_of_name("nothing")
    ('vstatics.simulation.run', '')
    """
    return next((annex.names[name] for annex in annexes() if name in annex.names), "")


def module_of_method(name: str) -> str:
    """Return the module of an annex that defines the function of a method; empty if none does."""
    return next((annex.methods[name] for annex in annexes() if name in annex.methods), "")


def module_of_key(key: str) -> str:
    """Return the module that declares a key of a case; empty if its annex is not installed."""
    return next((annex.keys[key] for annex in annexes() if key in annex.keys), "")


def module_of_type(name: str) -> str:
    """Return the module that defines a type of a part of an answer; empty if none does."""
    return next((annex.types[name] for annex in annexes() if name in annex.types), "")


def not_installed(what: str, annex: str) -> str:
    """Return the message about a part of an annex that is not installed.

    >>> not_installed("vehicle", KEYS["vehicle"])
    'vehicle belongs to vstatics.vehicle, which is not installed here'
    """
    return f"{what} belongs to vstatics.{annex}, which is not installed here"
