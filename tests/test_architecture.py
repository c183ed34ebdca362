"""Imports run one way: each room takes from those below it only."""

from __future__ import annotations

import ast
from pathlib import Path

import vstatics

PACKAGE = Path(vstatics.__file__).parent
ROOMS = [
    {"arrays", "errors", "memory", "parts", "tape", "templates"},
    {"checks", "extras", "traced"},
    {"entries", "model", "replay"},
    {"elimination", "plans", "results"},
    {"matrix"},
    {"speeds"},
    {"drag"},
    {"torques"},
    {"losses"},
    {"signs"},
    {"freewheels", "idling"},
    {"gears", "diagnosis"},
    {"batch"},
    {"statics"},
    {"elements"},
    {"readers", "writers"},
    {"compare", "sweep"},
    {"insight"},
    {"frames"},
    {"cli", "__init__"},
    {"__main__"},
]
"""From the ground floor up; the rooms of one floor do not meet."""

FOR_THE_HAND = {"results": {"frames"}}
"""A method that only calls a function upstairs, imported when somebody calls it."""

FLOOR = {room: floor for floor, rooms in enumerate(ROOMS) for room in rooms}


def imports(path: Path) -> set[str]:
    """The rooms of the package that a module imports at run time."""
    found: set[str] = set()
    tree = ast.parse(path.read_text(encoding="utf-8"))
    typing_only = {
        id(node)
        for block in ast.walk(tree)
        if isinstance(block, ast.If) and ast.unparse(block.test) == "TYPE_CHECKING"
        for node in ast.walk(block)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and id(node) not in typing_only:
            module = (node.module or "").split(".")
            if module == ["vstatics"]:
                found.update(alias.name for alias in node.names)
            elif module[0] == "vstatics":
                found.add(module[1])
    return {room for room in found if room in FLOOR}


def room(path: Path) -> str:
    """The room that a module belongs to."""
    return path.relative_to(PACKAGE).with_suffix("").parts[0]


def test_every_module_is_in_a_room() -> None:
    assert {room(path) for path in PACKAGE.rglob("*.py")} == set(FLOOR)


def test_imports_run_one_way() -> None:
    for path in PACKAGE.rglob("*.py"):
        own = room(path)
        upward = {other for other in imports(path) if other != own and FLOOR[other] >= FLOOR[own]}
        upward -= FOR_THE_HAND.get(own, set())
        assert not upward, f"{path.relative_to(PACKAGE)} imports {upward}"


def test_only_the_command_line_prints_and_leaves() -> None:
    for path in PACKAGE.rglob("*.py"):
        if room(path) not in ("cli", "__main__"):
            called = {
                ast.unparse(node.func)
                for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
                if isinstance(node, ast.Call)
            }
            assert not called & {"print", "sys.exit", "exit", "os._exit"}, path.name
