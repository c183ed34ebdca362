"""Tests of what is installed: they import no annex that may be missing where they run."""

import ast
import re
from collections.abc import Iterator

import pytest

from tests.installed import ANNEXES, FILES, HERE, KINDS, TESTS, skip_without_command, used_in
from vstatics.core.annexes import annexes

NEEDS = {annex.name: {annex.name, *annex.needs} for annex in annexes()}


def imported_at_once(tree: ast.Module) -> Iterator[str]:
    """Return the annexes that a module imports when it is imported itself."""
    for node in tree.body:
        if isinstance(node, ast.ImportFrom):
            for alias in node.names:
                yield from used_in(f"{node.module}.{alias.name}")
        elif isinstance(node, ast.Import):
            for alias in node.names:
                yield from used_in(alias.name)


def test_files_of_tests_import_what_is_installed_where_they_run() -> None:
    """Files import their annex and the annexes it needs. `FILES` names exactly the other imports.

    Imports come before functions and classes, which the linter checks.
    """
    more: dict[str, tuple[str, ...]] = {}
    for path in TESTS.rglob("*.py"):
        name = path.relative_to(TESTS).as_posix()
        own = name.split("/")[0]
        head = re.split(
            r"^(?:class|def|@)", path.read_text("utf-8"), maxsplit=1, flags=re.MULTILINE
        )[0]
        used = {*imported_at_once(ast.parse(head))}
        if others := used - NEEDS.get(own, set()):
            more[name] = tuple(annex for annex in ANNEXES if annex in others)
    removed = {name for name in FILES if name.split("/")[0] not in HERE}
    assert more == {name: needs for name, needs in FILES.items() if name not in removed}


def test_a_command_of_a_missing_annex_is_skipped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tests.installed.HERE", HERE - {"page"})
    monkeypatch.setitem(KINDS, "page picture", "page")
    skip_without_command("run", "summary")
    with pytest.raises(pytest.skip.Exception, match="needs page"):
        skip_without_command("report")
    with pytest.raises(pytest.skip.Exception, match="needs page"):
        skip_without_command("plot", "box.yaml", "-k", "page picture")


def test_kinds_of_pictures_are_those_of_the_records() -> None:
    declared = {
        kind: annex.name
        for annex in annexes()
        if annex.name != "pictures"
        for kind in annex.pictures
    }
    assert {kind: name for kind, name in KINDS.items() if name in HERE} == declared
