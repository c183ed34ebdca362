"""Records of annexes name what is there, and each thing once; what is missing is named."""

import io
import shutil
from importlib import import_module
from pathlib import Path

import pytest

import vstatics
from tests import commands
from tests.commands import CASES, ROOT
from tests.installed import HERE, NAMES, needs
from tests.without import removed_with
from vstatics import CaseError, check, loads, solve
from vstatics.core import annexes, extras
from vstatics.core.annexes import COMMANDS, DOCUMENTS
from vstatics.core.cli import main
from vstatics.core.readers.named.schema import json_schema
from vstatics.core.summary import summarize

ANNEXES = annexes.annexes()
CASE = """\
links: [engine, shaft]
mechanisms: {pair: {first: engine, second: shaft, ratio: 2.5}}
gears: {"1": []}
vehicle: {mass: 1200, radius: 0.3, engine: [[100, 150], [500, 120]]}
"""
MESSAGE = "vehicle belongs to vstatics.vehicle, which is not installed here"


@needs("torsion")
def test_a_function_without_its_package_names_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    """The module of `mode_names` imports scipy, before the function can ask for it."""

    def without_scipy(_: str) -> None:
        raise ModuleNotFoundError("No module named 'scipy'", name="scipy")

    monkeypatch.setattr(extras, "module", without_scipy)
    message = r'^omega needs the package scipy: pip install "\.\[torsion\]" in the source folder'
    with pytest.raises(CaseError, match=message):
        extras.higher("mode_names", "omega")


def test_every_name_of_a_record_is_in_its_module() -> None:
    for annex in ANNEXES:
        documents = [kind.functions for kind in annex.documents.values()]
        schemas = [{one.type: one.module} for one in annex.schemas.values()]
        for names in (annex.names, annex.methods, annex.types, *documents, *schemas):
            for name, module in names.items():
                assert module.startswith(f"vstatics.{annex.name}"), name
                assert hasattr(import_module(module), name), name
        for key, module in annex.keys.items():
            assert module.startswith(f"vstatics.{annex.name}."), key
            assert import_module(module).KEY.shape.name == key
        for name, command in annex.commands.items():
            assert command.module.startswith(f"vstatics.{annex.name}."), name
            assert main.module(name) == command.module


def test_names_and_places_are_there_once_and_known_to_the_core_and_to_tests() -> None:
    """The core can name an annex that is missing; tests skip what is of one."""
    commands = [command for annex in ANNEXES for command in annex.commands.values()]
    assert len({command.place for command in commands}) == len(commands)
    names = [name for annex in ANNEXES for name in annex.names]
    assert len({*names}) == len(names)
    assert {*names} <= {*vstatics.__all__}
    documents = {kind: annex.name for annex in ANNEXES for kind in annex.documents}
    assert documents.items() <= {kind: annex for kind, (annex, _) in DOCUMENTS.items()}.items()
    keys = {key: annex.name for annex in ANNEXES for key in annex.keys}
    assert keys == {key: annex for key, annex in annexes.KEYS.items() if annex in HERE}
    for annex in ANNEXES:
        assert {name for name in COMMANDS if COMMANDS[name] == annex.name} == {*annex.commands}
        assert {name for name in NAMES if NAMES[name] == annex.name} == {*annex.names}


def test_annexes_that_need_an_annex_go_with_it() -> None:
    for annex in ANNEXES:
        gone = removed_with(annex.name)
        assert annex.name in gone
        for other in ANNEXES:
            needs_gone = bool(gone.intersection(other.needs)) or other.name == annex.name
            assert needs_gone == (other.name in gone)
    with pytest.raises(SystemExit, match="no annex is called 'core'"):
        removed_with("core")


def remove(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    others = tuple(annex for annex in annexes.annexes() if annex.name != name)
    monkeypatch.setattr(annexes, "annexes", lambda: others)


@pytest.fixture
def without_vehicle(monkeypatch: pytest.MonkeyPatch) -> None:
    remove("vehicle", monkeypatch)


def test_a_part_of_a_missing_annex_has_a_plain_message(monkeypatch: pytest.MonkeyPatch) -> None:
    for missing, line, message in (
        ("simulation", "check", "scenario belongs to vstatics.simulation, which is not"),
        ("simulation", "run", "scenario belongs to vstatics.simulation, which is not"),
        ("simulation", "sweep --vary duration=1,2", "scenario belongs to vstatics.sim"),
        ("torsion", "sweep --vary inertias.1=1,2 --out omega", "omega belongs to"),
    ):
        file = "scenarios/tarasik-box" if missing == "simulation" else "tarasik-box"
        with monkeypatch.context() as patch:
            remove(missing, patch)
            assert commands.vstatics(*line.split(), CASES / f"{file}.yaml").fails(message)


@pytest.mark.usefixtures("without_vehicle")
def test_a_key_of_a_missing_annex_is_a_warning_and_the_rest_is_calculated() -> None:
    [problem] = check(io.StringIO(CASE))
    assert (problem.id, problem.severity, problem.message) == ("W807", "warning", MESSAGE)
    assert problem.place is not None
    assert problem.place[1:3] == (4, 1)
    assert check(io.StringIO(f"{CASE}allow: [W807]")) == []
    case = loads(CASE)
    summary = summarize(solve(case))
    assert (case.vehicle, summary.vehicle, summary.results.ratio.tolist()) == (None, None, [2.5])


@pytest.mark.usefixtures("without_vehicle")
def test_data_of_a_missing_annex_is_refused_and_not_lost() -> None:
    converted = commands.vstatics("convert", "-", "-", "--to", "json", stdin=CASE.encode())
    assert converted.gives_nothing(f"<stdin>:4:1: error: {MESSAGE}")
    with pytest.raises(CaseError, match=MESSAGE):
        loads(CASE.partition("vehicle")[0]).replace(vehicle=3)


@needs("pictures")
@pytest.mark.usefixtures("without_vehicle")
def test_a_command_or_method_names_its_missing_annex(monkeypatch: pytest.MonkeyPatch) -> None:
    assert annexes.missing_command("cycle") == MESSAGE.replace("vehicle", "cycle", 1)
    assert [annexes.missing_command(name) for name in ("plot", "run", "cycl")] == ["", "", ""]
    remove("pictures", monkeypatch)
    with pytest.raises(CaseError, match=r"plot belongs to vstatics\.pictures, which is not"):
        solve(loads(CASE)).plot("lever")


@needs("torsion")
@pytest.mark.usefixtures("without_vehicle")
def test_the_schema_of_cases_has_no_keys_of_a_missing_annex() -> None:
    keys = json_schema()["properties"]
    assert [key in keys for key in ("vehicle", "fatigue", "dump")] == [False, False, True]


@pytest.mark.slow
def test_commands_work_in_a_tree_without_the_annex(folder: Path) -> None:
    left_out = shutil.ignore_patterns("vehicle", "__pycache__")
    shutil.copytree(ROOT / "vstatics", folder / "vstatics", ignore=left_out)
    (folder / "case.yaml").write_text(CASE)
    for command in ("check", "run", "summary"):
        call = commands.process(command, "case.yaml", cwd=folder, PYTHONPATH=str(folder))
        assert call[0] == 0
        assert f"case.yaml:4:1: warning: {MESSAGE} [W807]" in call[2].decode()
    call = commands.process("cycle", "case.yaml", "x.csv", cwd=folder, PYTHONPATH=str(folder))
    assert (call[0], MESSAGE.replace("vehicle", "cycle", 1) in call[2].decode()) == (2, True)
    assert b"Traceback" not in call[2]
