"""Machine code that is kept is by all files from which it is made."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import vstatics
from tests.chance import some
from tests.commands import environment

PACKAGE = Path(vstatics.__file__).parent


def test_the_key_of_machine_code_is_made_of_all_that_is_compiled() -> None:
    """It holds the files with the words by which `vstatics.numerics.compiled` tells them."""
    for file in PACKAGE.rglob("*.py"):
        text = file.read_text()
        if "@compiled" in text:
            assert "import compiled" in text, file
            for room in re.findall(r"^from vstatics\.(\w+)\.tolerances import", text, re.MULTILINE):
                assert "Tolerances of" in (PACKAGE / room / "tolerances.py").read_text()


PUT = """
import numpy as np
from vstatics.numerics import compiled

values, into = np.arange(3.0), np.zeros(3)
compiled.put(values, into)
assert (values == into).all()
print(len(compiled.CACHE_TROUBLE), bool(compiled.put.stats.cache_hits))
"""


def put(cache: Path) -> str:
    """How many troubles another process tells, and whether it found machine code."""
    made = subprocess.run(
        [sys.executable, "-c", PUT],
        env={**environment(XDG_CACHE_HOME=str(cache)), "NUMBA_DISABLE_JIT": "0"},
        capture_output=True,
        text=True,
        check=True,
    )
    return made.stdout.strip()


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with machine code, which is made once and found then."""
    made = tmp_path_factory.mktemp("kept")
    assert put(made) == "0 False"
    assert put(made) == "0 True"
    return made


@pytest.fixture
def cache(tmp_path: Path, kept: Path) -> Path:
    """A copy of it."""
    return shutil.copytree(kept, tmp_path / "cache")


def garbage(file: Path) -> None:
    file.write_bytes(b"garbage")


def cut(file: Path) -> None:
    file.write_bytes(file.read_bytes()[:100])


def folder(file: Path) -> None:
    file.unlink()
    file.mkdir()


@pytest.mark.slow
@pytest.mark.parametrize("damage", some([garbage, cut, folder]))
def test_machine_code_that_is_damaged_is_compiled_again(
    cache: Path, damage: Callable[[Path], None]
) -> None:
    for file in [path for path in cache.rglob("*") if path.suffix == ".nbc"]:
        damage(file)
    assert put(cache) == "1 False"
    assert put(cache) == ("1 False" if damage is folder else "0 True")


@pytest.mark.slow
@pytest.mark.parametrize("part", ["vstatics", "vstatics/*"])
def test_machine_code_where_others_may_write_is_not_read(cache: Path, part: str) -> None:
    [shared] = cache.glob(part)
    shared.chmod(0o777)
    assert put(cache) == "1 False"
    shared.chmod(0o700)
    assert put(cache) == "0 True"
    if os.geteuid() == 0:
        os.chown(shared, 65534, 65534)
        assert put(cache) == "1 False"


@pytest.mark.slow
def test_machine_code_that_can_be_kept_nowhere_is_no_error(tmp_path: Path) -> None:
    garbage(tmp_path / "file")
    assert put(tmp_path / "file") == "1 False"
