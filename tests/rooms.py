"""The rooms of the package, what each imports, and where its tests stand.

``python -m tests.rooms torsion`` names the tests of a room for ``make test ROOM=torsion``, with
``above`` behind it also those of the rooms that stand on it, and of the program as a whole.
"""

import ast
import gc
import re
import sys
import textwrap
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

import vstatics

TESTS = Path(__file__).parent
PACKAGE = Path(vstatics.__file__).parent
ROOMS = (
    "core.start", "core.annexes", "core.record", "core.groups", "core.errors", "core.messages",
    "core.suggestions", "core.extras", "core.arguments", "core.texts",
    "core.numerics", "core.model", "core.statics", "core.elements", "core.jobs",
    "core.tables", "core.readers", "core.examples", "core.checking",
    "sweep", "torsion", "simulation", "core.writers", "core.flow",
    "core.summary", "core.comparison", "core.explain", "synthesis", "vehicle", "pictures",
    "page.report", "page.serve", "core.cli", "__init__", "__main__",
)  # fmt: skip
"""The order of the rooms; docs/architecture.md shows it."""
STANDING_ELSEWHERE = {
    **{f"{annex}.pictures": "pictures" for annex in ("torsion", "simulation", "sweep")},
    **{f"{annex}.pictures": "pictures" for annex in ("synthesis", "vehicle")},
    **{f"{annex}.report": "pictures" for annex in ("torsion", "simulation", "synthesis")},
    **{f"{annex}.cli": "core.cli" for annex in ("pictures", "torsion", "simulation", "sweep")},
    **{f"{annex}.cli": "core.cli" for annex in ("synthesis", "vehicle", "page")},
}
"""Parts of annexes that still import, or are imported, as rooms of the core are."""


def order() -> str:
    """The order of the rooms as text."""
    return textwrap.fill("  ".join(ROOMS[:-2]), 100)


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
    parsed = ast.parse(path.read_text("utf-8"))
    gc.freeze()
    return parsed


@cache
def nodes(path: Path) -> list[ast.AST]:
    """All nodes of the tree of a module."""
    return [*ast.walk(tree(path))]


def statements(body: Iterable[ast.AST]) -> Iterator[ast.AST]:
    """Yield statements with all statements in them, which are a tenth of the syntax nodes."""
    for node in body:
        yield node
        for field in ("body", "handlers", "orelse", "finalbody", "cases"):
            yield from statements(getattr(node, field, ()))


@cache
def imported(name: str) -> set[str]:
    """Return the modules of the package that a module imports: anywhere in it, for types too."""
    return _named(name, statements(tree(modules()[name]).body))


@cache
def imported_first(name: str) -> set[str]:
    """Return the modules that run before a module does: its imports, and the packages above them.

    Imports in functions and for types come later, if at all.
    """
    body = tree(modules()[name]).body
    tried = [inner for node in body if isinstance(node, ast.Try) for inner in node.body]
    found = _named(name, [*body, *tried])
    above = {
        ".".join(words[:count])
        for words in (other.split(".") for other in found)
        for count in range(2, len(words))
    }
    return {one for one in found | above if not f"{name}.".startswith(f"{one}.")}


def _named(name: str, nodes: Iterable[ast.AST]) -> set[str]:
    """Return the modules of the package that imports among nodes name."""
    found: set[str] = set()
    for node in nodes:
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


@cache
def room(name: str) -> str:
    """The room that a module belongs to; `__init__` is the package and what only holds rooms."""
    words = name.split(".")[1:]
    for count in range(len(words), 0, -1):
        start = ".".join(words[:count])
        if found := STANDING_ELSEWHERE.get(start) or (start if start in ROOMS else ""):
            return found
    return "__init__"


def sub_rooms(name: str) -> list[str]:
    """The folders in a room, in the order in which its docstring names them first."""
    folder = PACKAGE.joinpath(*name.split("."))
    inside = {path.parent.name for path in folder.glob("*/__init__.py")}
    told = ast.get_docstring(tree(folder / "__init__.py")) or ""
    order = [word for word in dict.fromkeys(re.findall(r"`(\w+)`", told)) if word in inside]
    assert set(order) == inside, f"vstatics.{name} names {order} of {inside}"
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
        *above_it, own = one.split(".")
        tests, code = TESTS.joinpath(*above_it), PACKAGE.joinpath(*above_it)
        places = (tests / own, tests / f"test_{own}.py", code / own, code / f"{own}.py")
        yield from filter(Path.exists, places)
    if above:
        yield from (TESTS / "published", TESTS / "oracle")
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
