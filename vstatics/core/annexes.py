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
from types import MappingProxyType
from typing import NamedTuple

_NAMES = ("pictures", "sweep", "torsion", "simulation", "synthesis", "vehicle", "page")
_NOTHING: Mapping[str, str] = MappingProxyType({})


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


@cache
def annexes() -> tuple[Annex, ...]:
    """Return the records of the annexes that are installed."""
    return tuple(_records())


def _records() -> list[Annex]:
    found = []
    for name in _NAMES:
        try:
            found.append(import_module(f"vstatics.{name}.annex").ANNEX)
        except ModuleNotFoundError as error:
            if error.name not in (f"vstatics.{name}", f"vstatics.{name}.annex"):
                raise
    return found


def module_of_name(name: str) -> str:
    """Return the module of an annex that defines a public name; empty if there is none.

    >>> module_of_name("simulate"), module_of_name("nothing")
    ('vstatics.simulation.run', '')
    """
    return next((annex.names[name] for annex in annexes() if name in annex.names), "")


def public_names() -> list[str]:
    """Return the public names of the annexes that are installed."""
    return [name for annex in annexes() for name in annex.names]


def module_of_method(name: str) -> str:
    """Return the module of an annex that defines the function of a method; empty if none does."""
    return next((annex.methods[name] for annex in annexes() if name in annex.methods), "")
