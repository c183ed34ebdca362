"""Test the program without an annex: ``python -m tests.without torsion``.

A copy of the project loses the folders of the annex, and of the annexes that need it. The fast
tests of the rest run in the copy; words after the name of the annex are passed to pytest.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from vstatics.core.annexes import annexes

ROOT = Path(__file__).parents[1]


def removed_with(name: str) -> set[str]:
    """Return an annex with the annexes that need it, directly or through another.

    Raises
    ------
    SystemExit
        If no annex has this name.
    """
    names = [annex.name for annex in annexes()]
    if name not in names:
        sys.exit(f"no annex is called {name!r}; annexes are {', '.join(names)}")
    gone = {name}
    for annex in annexes():  # an annex needs annexes before it only
        if gone.intersection(annex.needs):
            gone.add(annex.name)
    return gone


def copy_without(gone: set[str], target: Path) -> None:
    """Copy the files of the project that git knows, but the folders of annexes."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    for name in filter(None, listed.split("\0")):
        top, _, below = name.partition("/")
        is_gone = top in ("vstatics", "tests", "docs") and below.split("/")[0] in gone
        if not is_gone and (ROOT / name).exists():
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, target / name)


def main(name: str, *options: str) -> int:
    """Run the fast tests without an annex and return the status of pytest."""
    gone = removed_with(name)
    with tempfile.TemporaryDirectory() as folder:
        copy_without(gone, Path(folder))
        tests = [sys.executable, "-m", "pytest", "-q", "-m", "not slow", *options]
        print(f"without {', '.join(sorted(gone))}:", *tests, flush=True)  # noqa: T201
        environment = {**os.environ, "PYTHONPATH": folder}
        return subprocess.run(tests, cwd=folder, env=environment, check=False).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
