"""Imports run one way: each room takes from those before it only, and no modules go in a circle."""

import ast
import re
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

from tests.installed import missing, needs
from tests.rooms import (
    PACKAGE,
    ROOMS,
    imported,
    imported_first,
    modules,
    nodes,
    order,
    places_of_tests,
    room,
    standing_on,
    sub_rooms,
)
from vstatics.core.annexes import annexes


def test_architecture_shows_the_rooms_in_their_order() -> None:
    text = (PACKAGE.parent / "docs" / "architecture.md").read_text("utf-8")
    assert f"```\n{order()}\n```" in text


def test_every_module_is_in_a_room() -> None:
    installed = {name for name in ROOMS if not missing({name.split(".")[0]} & {*ANNEXES})}
    assert {room(name) for name in modules()} == installed


def test_imports_run_one_way() -> None:
    place = {room: number for number, room in enumerate(ROOMS)}
    for name in modules():
        own = room(name)
        upward = {other for other in imported(name) if place[room(other)] > place[own]}
        assert not upward, f"{name} imports {upward}"


def test_imports_of_sub_rooms_run_one_way() -> None:
    """The docstring of a room names its sub-rooms in their order."""
    for above in ROOMS[:-2]:
        if PACKAGE.joinpath(*above.split(".")).is_dir():
            place = {one: number for number, one in enumerate(sub_rooms(above))}
            for name in modules():
                depth = above.count(".") + 2
                own = name.split(".")[depth : depth + 1]
                if room(name) == above and own and own[0] in place:
                    others = {
                        to.split(".")[depth]
                        for to in imported(name)
                        if to.count(".") >= depth and to.startswith(f"vstatics.{above}.")
                    }
                    upward = {to for to in others & place.keys() if place[to] > place[own[0]]}
                    assert not upward, f"{name} imports {upward}"


@needs("torsion")
def test_what_stands_on_a_room_is_tested_with_it() -> None:
    """Pictures take torsion, and torsion takes statics; nothing takes the command line."""
    assert {"pictures", "core.cli"} <= {*standing_on("torsion")} <= {*standing_on("core.statics")}
    assert standing_on("core.cli") == []
    assert Path(__file__) in places_of_tests("torsion", above=True)
    assert PACKAGE / "torsion" in places_of_tests("torsion", above=False)


def test_any_module_can_be_imported_first_and_there_is_no_circle() -> None:
    """A package runs before its modules: what it imports may not need one of them again."""
    TopologicalSorter({name: imported_first(name) for name in modules()}).prepare()
    graph = {name: imported(name) - {name} for name in modules() if name != "vstatics"}
    TopologicalSorter(graph).prepare()


def test_only_the_command_line_and_the_report_draw() -> None:
    """Pictures are large, and matplotlib is an extra: nothing else comes to depend on them.

    The package itself names them, and imports them when they are asked for.
    """
    for name in modules().keys() - {"vstatics"}:
        if any(room(other) == "pictures" for other in imported(name)):
            assert room(name) in ("pictures", "page.report", "page.serve", "core.cli"), name


ANNEXES = ("pictures", "sweep", "torsion", "simulation", "synthesis", "vehicle", "page")


@cache
def annexes_known(name: str) -> set[str]:
    """Return the annexes that a module knows besides its own: by imports, and by texts alone."""
    texts = {
        node.value
        for node in nodes(modules()[name])
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    texts |= {f"vstatics.{text}" for text in texts if "." in text}
    found = imported(name) | {text for text in texts if text in modules()}
    return {home(other) for other in found} - {home(name), "core"}


def home(name: str) -> str:
    """Return the annex of a module, or core."""
    first = name.partition(".")[2].partition(".")[0]
    return first if first in ANNEXES else "core"


def test_annexes_know_only_what_their_records_need() -> None:
    needs = {annex.name: {*annex.needs} for annex in annexes()}
    for name in modules().keys() - {"vstatics", "vstatics.core.annexes"}:
        own = home(name)
        known = annexes_known(name) - needs.get(own, set())
        assert not known, f"{name} knows {known}"


def test_records_are_plain_data_and_need_only_annexes_before_them() -> None:
    """They can be read without the modules that they name."""
    for annex in annexes():
        record = modules()[f"vstatics.{annex.name}.annex"]
        assert imported_names(record) == {"vstatics.core.annexes"}, annex.name
        assert {*annex.needs} <= {*ANNEXES[: ANNEXES.index(annex.name)]}, annex.name


def test_one_module_of_the_core_knows_the_names_of_annexes() -> None:
    listing = [name for name, path in modules().items() if ANNEXES in tuples(path)]
    assert listing == ["vstatics.core.annexes"]


def tuples(path: Path) -> set[tuple[object, ...]]:
    """Return the tuples, lists and sets of plain values that stand in a module."""
    lists = (node for node in nodes(path) if isinstance(node, ast.Tuple | ast.List | ast.Set))
    return {
        tuple(each.value for each in node.elts if isinstance(each, ast.Constant)) for node in lists
    }


@cache
def called(path: Path) -> set[str]:
    """What a module calls, as it stands there."""
    return {ast.unparse(node.func) for node in nodes(path) if isinstance(node, ast.Call)}


def test_only_the_command_line_prints_and_leaves() -> None:
    for name, path in modules().items():
        if room(name) not in ("core.cli", "__main__"):
            assert not called(path) & {"print", "sys.exit", "exit"}, name
            # worker processes end, so does Ctrl-C
            may_end = room(name) in ("core.jobs", "core.start")
            assert may_end or "os._exit" not in called(path), name


def test_all_that_is_printed_goes_through_two_modules() -> None:
    """They escape what would reach the terminal: no other has to think of it."""
    printing = {"print", "click.echo", "click.secho", "Console", "sys.stdout.write"}
    printing |= {"sys.stderr.write", "sys.stdout.buffer.write"}
    for name, path in modules().items():
        if room(name) == "core.cli" and name not in (
            "vstatics.core.cli.shared.files",
            "vstatics.core.cli.shared.console",
        ):
            assert not called(path) & printing, name


OF_OTHER_FILES = {
    "vstatics.core.jobs.input_files",  # inputs, with a bound
    "vstatics.core.jobs.files",  # outputs, and hashes of what is read
    "vstatics.core.jobs.page_files",  # outputs
    "vstatics.core.jobs.state_files",
    "vstatics.sweep.variants.table_file",  # tables of variants
    "vstatics.synthesis.code_cache",  # folder of machine code
}


def imported_names(path: Path) -> set[str]:
    """The modules that a module imports, by their names."""
    plain = {one.name for node in nodes(path) if isinstance(node, ast.Import) for one in node.names}
    return plain | {str(node.module) for node in nodes(path) if isinstance(node, ast.ImportFrom)}


def test_one_module_opens_state_files() -> None:
    """It looks at them before; any other way to a file would follow a link."""
    acts = ("open", "truncate", "unlink", "remove", "rename", "replace", "rmdir", "mkdir")
    calls = {"open", *(f"os.{act}" for act in acts)}
    for name, path in modules().items():
        if room(name) in ("core.jobs", "sweep", "synthesis") and name not in OF_OTHER_FILES:
            assert not called(path) & calls, name
            assert not {"pathlib", "shutil"} & imported_names(path), name


def test_a_class_name_is_used_once() -> None:
    """A name stands for one thing, so that it can be searched for."""
    homes: dict[str, list[str]] = {}
    for module, path in modules().items():
        for node in nodes(path):
            if isinstance(node, ast.ClassDef):
                homes.setdefault(node.name.lstrip("_"), []).append(module)
    assert {name: own for name, own in homes.items() if len(own) > 1} == {}


def test_each_module_of_the_solver_has_its_tests() -> None:
    own = {path.stem for path in (PACKAGE / "core" / "statics").glob("*.py")} - {"__init__"}
    tests = {path.stem for path in (Path(__file__).parent / "core" / "statics").glob("test_*.py")}
    assert {f"test_{name}" for name in own} <= tests


def test_folders_of_tests_are_rooms() -> None:
    others = {"published", "oracle", "golden", "bad", "__pycache__"}
    folders = {path.name for path in Path(__file__).parent.iterdir() if path.is_dir()}
    assert folders - others <= {name.split(".")[0] for name in ROOMS}


def test_slow_tests_are_found_by_their_files() -> None:
    """`make test-beside` and `test-alone` collect the files with a mark, by its text."""
    tests = Path(__file__).parent
    marked = {
        path
        for path in tests.rglob("*.py")
        if re.search(r"mark\.(slow|alone)|with_slow\(", path.read_text("utf-8"))
    } - {tests / "chance.py"}
    assert all(path.name.startswith("test_") for path in marked), marked
    for path in marked:
        names = re.findall(
            r"(?!test_)\b(\w+)\s*=\s*pytest\.mark\.(?:slow|alone)", path.read_text("utf-8")
        )
        assert {*names} <= {"marks", "pytestmark"}, f"{path}: other files could take {names}"
