"""Imports run one way: each room takes from those before it only, and no modules go in a circle."""

from __future__ import annotations

import ast
import textwrap
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import vstatics

PACKAGE = Path(vstatics.__file__).parent
ROOMS = (
    "interrupt",
    "errors",
    "extras",
    "numerics",
    "model",
    "statics",
    "elements",
    "jobs",
    "tables",
    "readers",
    "torsion",
    "simulation",
    "sweep",
    "writers",
    "flow",
    "summary",
    "explain",
    "synthesis",
    "pictures",
    "report",
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
def imported(name: str) -> set[str]:
    """The modules of the package that a module imports: anywhere in it, for types too."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(modules()[name].read_text(encoding="utf-8"))):
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


def test_architecture_shows_the_rooms_in_their_order() -> None:
    text = (PACKAGE.parent / "docs" / "architecture.md").read_text(encoding="utf-8")
    assert f"```\n{order()}\n```" in text


def test_every_module_is_in_a_room() -> None:
    assert {room(name) for name in modules()} == set(ROOMS)


def test_imports_run_one_way() -> None:
    place = {room: number for number, room in enumerate(ROOMS)}
    for name in modules():
        own = room(name)
        upward = {other for other in imported(name) if place[room(other)] > place[own]}
        assert not upward, f"{name} imports {upward}"


def test_no_modules_import_each_other_in_a_circle() -> None:
    graph = {name: imported(name) - {name} for name in modules() if name != "vstatics"}
    TopologicalSorter(graph).prepare()


def test_only_the_command_line_and_the_report_draw() -> None:
    """Pictures are large, and matplotlib is an extra: nothing else comes to depend on them.

    The package itself names them, and imports them when they are asked for.
    """
    for name in modules().keys() - {"vstatics"}:
        if any(room(other) == "pictures" for other in imported(name)):
            assert room(name) in ("pictures", "report", "cli"), name


@cache
def called(path: Path) -> set[str]:
    """What a module calls, as it stands there."""
    return {
        ast.unparse(node.func)
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call)
    }


def test_only_the_command_line_prints_and_leaves() -> None:
    for name, path in modules().items():
        if room(name) not in ("cli", "__main__"):
            assert not called(path) & {"print", "sys.exit", "exit"}, name
            if room(name) not in ("jobs", "interrupt"):  # worker processes end, so does Ctrl-C
                assert "os._exit" not in called(path), name


def test_all_that_is_printed_goes_through_two_modules() -> None:
    """They escape what would reach the terminal: no other has to think of it."""
    printing = {"print", "click.echo", "click.secho", "Console", "sys.stdout.write"}
    printing |= {"sys.stderr.write", "sys.stdout.buffer.write"}
    for name, path in modules().items():
        if room(name) == "cli" and name not in ("vstatics.cli.files", "vstatics.cli.console"):
            assert not called(path) & printing, name


def test_a_class_name_is_used_once() -> None:
    """A name stands for one thing, so that it can be searched for."""
    homes: dict[str, list[str]] = {}
    for module, path in modules().items():
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ClassDef):
                homes.setdefault(node.name.lstrip("_"), []).append(module)
    assert {name: own for name, own in homes.items() if len(own) > 1} == {}


def test_each_module_of_the_solver_has_its_tests() -> None:
    own = {path.stem for path in (PACKAGE / "statics").glob("*.py")} - {"__init__"}
    tests = {path.stem for path in (Path(__file__).parent / "statics").glob("test_*.py")}
    assert {f"test_{name}" for name in own} <= tests


def test_folders_of_tests_are_rooms() -> None:
    others = {"published", "oracle", "golden", "bad", "__pycache__"}
    folders = {path.name for path in Path(__file__).parent.iterdir() if path.is_dir()}
    assert folders - others <= set(ROOMS)
