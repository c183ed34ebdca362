"""Processes that tests start, watch and disturb, and the files that they leave."""

import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tests.commands import ID, environment


def end(process: Any) -> tuple[int, str]:
    """Exit status, and stderr without ids."""
    said = ID.sub("", process.communicate(timeout=120)[1])
    return process.returncode, said


@contextmanager
def running(*arguments: str, **variables: str) -> Iterator[subprocess.Popen[bytes]]:
    """A command in the background; it is killed if the test fails."""
    line = [sys.executable, "-m", "vstatics", *arguments]
    pipe, environ = subprocess.PIPE, environment(**variables)
    with subprocess.Popen(line, stdout=pipe, stderr=pipe, env=environ) as process:
        try:
            yield process
        finally:
            process.kill()


def names(folder: Path = Path()) -> list[str]:
    """Return the sorted names in a folder, by default the current one; empty if it is missing."""
    return sorted(path.name for path in folder.iterdir()) if folder.is_dir() else []


def wait_for(condition: Callable[[], object], seconds: float = 60) -> None:
    """Wait until something is so."""
    limit = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < limit, "it never happened"
        time.sleep(0.01)


def children(process: int) -> list[int]:
    """The processes that a process has started."""
    found = []
    for folder in Path("/proc").iterdir():
        if folder.name.isdigit():
            try:
                text = (folder / "stat").read_text("utf-8")
            except OSError:
                continue
            if int(text.rpartition(")")[2].split()[1]) == process:
                found.append(int(folder.name))
    return sorted(found)
