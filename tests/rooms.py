"""The rooms of the package, what each imports, and where its tests stand.

``python -m tests.rooms torsion`` names the tests of a room for ``make test ROOM=torsion``, with
``above`` behind it also those of the rooms that stand on it, and of the program as a whole.
"""

from __future__ import annotations

import ast
import gc
import re
import sys
import textwrap
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import vstatics

TESTS = Path(__file__).parent
PACKAGE = Path(vstatics.__file__).parent
ROOMS = (
    "start",
    "errors",
    "extras",
    "arguments",
    "texts",
    "numerics",
    "model",
    "statics",
    "elements",
    "jobs",
    "tables",
    "readers",
    "damage",
    "torsion",
    "simulation",
    "examples",
    "checking",
    "sweep",
    "writers",
    "flow",
    "summary",
    "comparison",
    "explain",
    "synthesis",
    "pictures",
    "report",
    "serve",
    "cli",
    "__init__",
    "__main__",
)
"""The order of the rooms; docs/architecture.md shows it."""


def order() -> str:
    """The order of the rooms as text."""
    return textwrap.fill("  ".join(ROOMS[:-2]), 80)


@cache
def modules() -> dict[str, Path]:
    """The modules of the package by their names with dots."""
    found = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
        found[".".join(part for part in parts if part != "__init__")] = path
    return found


@cache
def tree(path: Path) -> ast.Module:
    """A module as it is parsed, once for all tests that look at the code.

    All trees stay to the end: without `freeze` the collector of garbage would go through them
    again and again, which takes longer than the parser.
    """
    parsed = ast.parse(path.read_text(encoding="utf-8"))
    gc.freeze()
    return parsed


@cache
def nodes(path: Path) -> list[ast.AST]:
    """All nodes of the tree of a module."""
    return [*ast.walk(tree(path))]


@cache
def imported(name: str) -> set[str]:
    """The modules of the package that a module imports: anywhere in it, for types too."""
    found: set[str] = set()
    for node in nodes(modules()[name]):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{name} imports by dots alone"
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        else:
            continue
        for one in names:
            found.add(one if one in modules() else one.rpartition(".")[0])
    return found & set(modules())


def room(name: str) -> str:
    """The room that a module belongs to."""
    return name.split(".")[1] if "." in name else "__init__"


def sub_rooms(name: str) -> list[str]:
    """The folders in a room, in the order in which its docstring names them first."""
    folder = PACKAGE / name
    inside = {path.parent.name for path in folder.glob("*/__init__.py")}
    told = ast.get_docstring(tree(folder / "__init__.py")) or ""
    order = [word for word in dict.fromkeys(re.findall(r"`(\w+)`", told)) if word in inside]
    assert set(order) == inside, f"vstatics/{name}/__init__.py names {order} of {inside}"
    return order


def standing_on(name: str) -> list[str]:
    """The rooms that import a room, or one that does, in their order."""
    found = {name}
    for other in ROOMS[:-2]:
        below = {room(to) for own in modules() if room(own) == other for to in imported(own)}
        if below & found:
            found.add(other)
    return [other for other in ROOMS if other in found - {name}]


def places_of_tests(name: str, *, above: bool) -> Iterator[Path]:
    """Where the tests of a room stand; `above`: all tests that a change of it may break."""
    for one in [name, *(standing_on(name) if above else ())]:
        places = (TESTS / one, TESTS / f"test_{one}.py", PACKAGE / one, PACKAGE / f"{one}.py")
        yield from filter(Path.exists, places)
    if above:
        folders = {path.parent for path in TESTS.glob("*/test_*.py")}
        yield from sorted(one for one in folders if one.name not in ROOMS)
        yield from sorted(TESTS.glob("test_*.py"))


def main(name: str, *words: str) -> None:
    """Name the tests of a room.

    Raises
    ------
    SystemExit
        If there is no such room.
    """
    if name not in ROOMS[:-2]:
        sys.exit(f"there is no room {name}; rooms are {', '.join(ROOMS[:-2])}")
    found = dict.fromkeys(places_of_tests(name, above=bool(words)))
    print(*(path.relative_to(TESTS.parent) for path in found))  # noqa: T201


if __name__ == "__main__":
    main(*sys.argv[1:])
