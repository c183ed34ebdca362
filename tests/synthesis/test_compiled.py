"""Machine code that is kept is by all files from which it is made."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import vstatics
from tests.chance import count, seeded, some
from tests.commands import environment
from vstatics.synthesis import code_cache

PACKAGE = Path(vstatics.__file__).parent


def test_the_key_of_machine_code_is_made_of_all_that_is_compiled() -> None:
    """The key contains the files with the words that `vstatics.synthesis.code_cache` looks for."""
    pattern = re.compile(r"^from vstatics\.([\w.]+)\.tolerances import", re.MULTILINE)
    for file in PACKAGE.rglob("*.py"):
        text = file.read_text()
        if "@compiled" in text:
            assert "import compiled" in text, file
            for room in pattern.findall(text):
                tolerances = PACKAGE.joinpath(*room.split("."), "tolerances.py")
                assert "Tolerances of" in tolerances.read_text()


PUT = """
import numpy as np
from vstatics.synthesis import code_cache, compiled

values, into = np.arange(3.0), np.zeros(3)
compiled.put(values, into)
assert (values == into).all()
print(len(code_cache.CACHE_TROUBLE), bool(compiled.put.stats.cache_hits))
"""


def put(cache: Path, program: str = PUT) -> str:
    """How many troubles another process tells, and whether it found machine code."""
    made = subprocess.run(
        [sys.executable, "-c", program],
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
    kept: Path, tmp_path: Path, damage: Callable[[Path], None]
) -> None:
    cache = shutil.copytree(kept, tmp_path / "cache")
    for file in [path for path in cache.rglob("*") if path.suffix == ".nbc"]:
        damage(file)
    assert put(cache) == "1 False"
    assert put(cache) == ("1 False" if damage is folder else "0 True")


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder for machine code below others, as they are by default."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "home" / "cache"))
    monkeypatch.setattr(code_cache, "CACHE_TROUBLE", [])
    made = Path(code_cache._cache())
    assert made.stat().st_mode & 0o777 == 0o700
    assert made.parents[2] == tmp_path / "home"
    for number in range(3):
        (made / f"room_{number}").mkdir()
        for name in ("code.nbi", "code.1.nbc"):
            (made / f"room_{number}" / name).write_bytes(b"code")
    return made


def is_used(tree: Path) -> bool:
    """Whether machine code is kept in the tree; otherwise one line says why not."""
    code_cache.CACHE_TROUBLE.clear()
    used = code_cache._cache()
    assert used in ("", str(tree))
    assert len(code_cache.CACHE_TROUBLE) == (not used)
    return bool(used)


def test_whatever_others_can_change_is_not_used(tree: Path, tmp_path: Path) -> None:
    """A folder above, in the tree or a file: its mode, its owner, or a link in its place."""
    choose, above = seeded(22), [tree, *list(tree.parents)[:3]]
    entries = [*above, *tree.rglob("*")]
    for _ in range(count(200, 2000)):
        entry = choose.choice(entries)
        mode = entry.stat().st_mode & 0o7777
        opened = choose.choice([0o020, 0o002, 0o022])
        entry.chmod(mode | opened)
        assert not is_used(tree), entry
        entry.chmod(mode | opened | 0o1000)
        assert is_used(tree) == (entry in above[1:]), entry  # the sticky bit
        entry.chmod(mode)
        if os.geteuid() == 0:
            os.chown(entry, 65534, -1)
            assert not is_used(tree), entry
            os.chown(entry, 0, -1)
        if entry not in above:
            entry.rename(tmp_path / "moved")
            entry.symlink_to(tmp_path / "moved")
            assert not is_used(tree), entry
            entry.unlink()
            (tmp_path / "moved").rename(entry)
        assert is_used(tree), code_cache.CACHE_TROUBLE


@pytest.mark.slow
def test_the_path_of_machine_code_is_resolved_once(kept: Path, tmp_path: Path) -> None:
    """A link that is turned elsewhere when Numba is there leads nobody to other machine code."""
    garbage_code = shutil.copytree(kept, tmp_path / "garbage")
    for file in garbage_code.rglob("*.nb*"):
        garbage(file)
    linked = tmp_path / "linked"
    linked.mkdir()
    link = linked / "vstatics"
    link.symlink_to(kept / "vstatics")
    turn = f"import os\nos.unlink({str(link)!r})\n"
    turn += f"os.symlink({str(garbage_code / 'vstatics')!r}, {str(link)!r})"
    head, tail = PUT.split("\n\n", 1)
    assert put(linked, f"{head}\n{turn}\n{tail}") == "0 True"


@pytest.mark.slow
def test_machine_code_is_kept_whatever_the_umask_is_and_not_where_it_cannot_be(
    tmp_path: Path,
) -> None:
    """Files and folders that others of the group may change would not be read again."""
    umask = "import os; os.umask(0o002)\n"
    assert [put(tmp_path / "cache", umask + PUT) for _ in range(2)] == ["0 False", "0 True"]
    garbage(tmp_path / "file")
    assert put(tmp_path / "file") == "1 False"
