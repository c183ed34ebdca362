"""Places of the tests that a change can break: ``python -m tests.changed [COMMIT]``.

A change is what differs from COMMIT, or without COMMIT from the commit at which the branch left
the main branch of `origin`. Files of an annex can break this annex and those that need it; files
of a room of the core can break the rooms that import it, and all annexes. Where no difference is
known, or where it concerns files that all tests share, everything is named.
"""

import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

from tests.rooms import PACKAGE, ROOMS, TESTS, places_of_tests, room, standing_on
from vstatics.core.annexes import annexes

ROOT = TESTS.parent
ALL = ("tests", "vstatics", "website")
PAGES = ("README.md", "CHANGELOG.md", "docs", "website")
"""Files that only tests of the whole program read; these always run."""
SHARED = ("bad", "oracle", "published")
"""Folders of `tests` with helpers and data that tests of other rooms use, too."""


def lines_of(*command: str) -> list[str]:
    """Return the lines that git prints.

    Raises
    ------
    subprocess.CalledProcessError
        If git fails; its reason is on stderr.
    """
    done = subprocess.run(
        ("git", *command), cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True
    )
    return done.stdout.splitlines()


def changed_files(commit: str | None = None) -> list[str]:
    """Return the files that differ from a commit, by their paths in the project.

    A file that was renamed is named by both paths.
    """
    if commit is None:
        try:
            [commit] = lines_of("merge-base", "HEAD", "origin/HEAD")
        except (OSError, subprocess.CalledProcessError):
            print("no main branch of origin found, so all tests run", file=sys.stderr)  # noqa: T201
            return []
    changed = lines_of("diff", "--name-only", "--no-renames", "--end-of-options", commit, "--")
    return [*changed, *lines_of("ls-files", "--others", "--exclude-standard")]


def places(files: Iterable[str]) -> list[str]:
    """Return the places of all tests that changed files can break.

    Parameters
    ----------
    files : iterable of str
        Paths of the changed files in the project; without any, all tests are named.

    Examples
    --------
    >>> places(["Makefile"])
    ['tests', 'vstatics', 'website']
    """
    names = [*files]
    if not names:
        return [*ALL]
    rooms: dict[str, None] = {}
    for file in names:
        top, *inner = Path(file).with_suffix("").parts
        if Path(file).parts[0] in PAGES or file.startswith("tests/test_"):
            continue
        if top not in ("vstatics", "tests") or len(inner) < 2:
            return [*ALL]
        if inner[0] in SHARED and not inner[-1].startswith("test_"):
            return [*ALL]
        rooms.update(dict.fromkeys(_rooms(inner)))
    found = [place for name in rooms for place in _of_room(name)]
    whole = (path.relative_to(ROOT).as_posix() for path in sorted(TESTS.glob("test_*.py")))
    return _outermost([*found, *whole])


def _rooms(inner: list[str]) -> list[str]:
    """Return the room or annex of a file, with all that its change can break."""
    if inner[0] != "core":
        return _with_needing(inner[0])
    own = room(".".join(["vstatics", *inner]))
    if own not in ROOMS:
        return [*ROOMS]
    above = [name for name in standing_on(own) if name.startswith("core.")]
    return [own, *above, *(annex.name for annex in annexes())]


def _with_needing(name: str) -> list[str]:
    """Return an annex with the annexes that need it, directly or through another."""
    found = [name]
    for annex in annexes():
        if {*annex.needs} & {*found}:
            found.append(annex.name)
    return found


def _of_room(name: str) -> list[str]:
    """Return the places of the tests of a room or an annex, by their paths in the project."""
    annex = [TESTS / name, PACKAGE / name]
    paths = places_of_tests(name, above=False) if "." in name else annex
    return [path.relative_to(ROOT).as_posix() for path in paths if path.exists()]


def _outermost(names: list[str]) -> list[str]:
    """Return paths without those inside another, each once."""
    unique = dict.fromkeys(names)
    return [
        name
        for name in unique
        if not any(Path(name).is_relative_to(other) for other in unique if other != name)
    ]


if __name__ == "__main__":
    try:
        print(*places(changed_files(*sys.argv[1:])))  # noqa: T201
    except subprocess.CalledProcessError as error:
        sys.exit(error.returncode)
