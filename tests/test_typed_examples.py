"""Who checks types finds the examples of the pages right, and mistakes in them wrong."""

import doctest
import subprocess
import sys
from pathlib import Path
from typing import get_args

import pytest

from tests.commands import ROOT
from tests.installed import ANNEXES, needs
from tests.test_readme import blocks
from vstatics.core.statics.result_arrays import GearTable
from vstatics.core.tables.quantities import BY_NAME

PAGES = ("docs/python.md", "docs/how-to/commands-in-python.md")


def typed(page: str) -> str:
    """The lines of Python of a page."""
    parser = doctest.DocTestParser()
    texts = [block.text for block in blocks(ROOT / page) if block.kind == "python"]
    return "".join(one.source for text in texts for one in parser.get_examples(text))


@pytest.mark.slow
@needs(*ANNEXES)
def test_the_examples_of_the_pages_pass_a_strict_check_of_types(tmp_path: Path) -> None:
    """In the way of one who has the package installed: only their own lines are looked at."""
    for number, page in enumerate(PAGES):
        (tmp_path / f"page{number}.py").write_text(typed(page), "utf-8")
    wrong = 'import vstatics\nresults = vstatics.solve(vstatics.example("simpson"))\n'
    wrong += 'results["ratio", "1"].round(3)\nvstatics.simulate(results)\n'
    (tmp_path / "wrong.py").write_text(wrong, "utf-8")
    call = [sys.executable, "-m", "mypy", "--strict", "--follow-imports=silent"]
    call += ["--cache-dir", str(ROOT / ".mypy_cache/pages"), "--config-file=", str(tmp_path)]
    said = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, check=False)
    found = [line for line in said.stdout.splitlines() if ": error:" in line]
    assert [":".join(one.rsplit("/", 1)[-1].split(":")[:2]) for one in found] == [
        "wrong.py:3",
        "wrong.py:4",
    ], said.stdout + said.stderr


def test_a_checker_of_types_knows_the_tables_of_one_number_a_gear() -> None:
    assert set(get_args(GearTable)) == {one.name for one in BY_NAME.values() if one.rows == "one"}
