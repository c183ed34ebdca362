"""Records of annexes name what is there, and each thing once."""

from __future__ import annotations

from importlib import import_module

import pytest

import vstatics
from tests import commands
from tests.commands import CASES
from tests.installed import NAMES
from tests.without import removed_with
from vstatics.core.annexes import COMMANDS, DOCUMENTS, annexes
from vstatics.core.cli import main


def test_every_name_of_a_record_is_in_its_module() -> None:
    for annex in annexes():
        documents = [kind.functions for kind in annex.documents.values()]
        schemas = [{one.type: one.module} for one in annex.schemas.values()]
        for names in (annex.names, annex.methods, annex.types, *documents, *schemas):
            for name, module in names.items():
                assert module.startswith(f"vstatics.{annex.name}"), name
                assert hasattr(import_module(module), name), name
        for key, module in annex.keys.items():
            assert module.startswith(f"vstatics.{annex.name}."), key
            assert import_module(module).KEY.shape.name == key


def test_documents_belong_to_the_annexes_that_declare_them() -> None:
    """The core knows them, too, so that it can name an annex that is missing."""
    declared = {kind: annex.name for annex in annexes() for kind in annex.documents}
    assert declared.items() <= {kind: annex for kind, (annex, _) in DOCUMENTS.items()}.items()


@pytest.mark.parametrize(
    ("missing", "words", "message"),
    [
        ("simulation", ["check"], "scenario belongs to vstatics.simulation, which is not"),
        ("simulation", ["run"], "scenario belongs to vstatics.simulation, which is not"),
        ("simulation", ["sweep", "--vary", "duration=1,2"], "scenario belongs to vstatics.sim"),
        ("torsion", ["sweep", "--vary", "inertias.1=1,2", "--out", "omega"], "omega belongs to"),
    ],
)
def test_a_part_of_a_missing_annex_has_a_plain_message(
    missing: str, words: list[str], message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    others = tuple(annex for annex in annexes() if annex.name != missing)
    monkeypatch.setattr("vstatics.core.annexes.annexes", lambda: others)
    file = "scenarios/tarasik-box" if missing == "simulation" else "tarasik-box"
    said = commands.vstatics(*words, CASES / f"{file}.yaml")
    assert said.fails(message)


def test_every_command_has_a_place_of_its_own_and_a_module_in_its_annex() -> None:
    commands = [command for annex in annexes() for command in annex.commands.values()]
    assert len({command.place for command in commands}) == len(commands)
    for annex in annexes():
        for name, command in annex.commands.items():
            assert command.module.startswith(f"vstatics.{annex.name}."), name
            assert main.module(name) == command.module


def test_public_names_of_annexes_are_those_of_the_package() -> None:
    names = [name for annex in annexes() for name in annex.names]
    assert len({*names}) == len(names)
    assert {*names} <= {*vstatics.__all__}


def test_annexes_that_need_an_annex_go_with_it() -> None:
    for annex in annexes():
        gone = removed_with(annex.name)
        kept = [other for other in annexes() if other.name not in gone]
        assert annex.name in gone
        assert not any(gone.intersection(other.needs) for other in kept)
        assert all(
            other.name == annex.name or gone & {*other.needs}
            for other in annexes()
            if other.name in gone
        )
    with pytest.raises(SystemExit, match="no annex is called 'core'"):
        removed_with("core")


def test_tests_know_the_annex_of_each_command_and_name() -> None:
    """They skip what is of an annex that is not installed, whose record is gone."""
    for annex in annexes():
        assert {name for name, other in COMMANDS.items() if other == annex.name} == {
            *annex.commands
        }
        assert {name for name, other in NAMES.items() if other == annex.name} == {*annex.names}
