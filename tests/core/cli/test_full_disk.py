"""A disk that is full at any moment: the output is named, and with room again the work goes on.

The reference is the result of the same command with room. A small file system is really full,
page by page and file by file; where none can be mounted, each call of the system fails in turn.
"""

import errno
import os
import re
import subprocess
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path
from typing import Any

import pytest

from tests.chance import seeded, with_slow
from tests.commands import Said
from tests.core.cli.states import COMMANDS, RECORD, StatedCommand, prepare

PAGE = 4096
COMMANDS_ONCE = [name for name in COMMANDS if name != "record of boxes"]
FULL = "cannot be written: |are free"
RECORDS = (RECORD, ".vstatics-run-json")
"""Hidden files that stay in a folder of results."""
CALLS = ("write", "open", "mkdir", "replace", "ftruncate", "pwrite", "copy_file_range", "fsync")


def judge(said: Said, command: StatedCommand) -> None:
    """A command that could not write names its output, and --resume where work is left."""
    assert said.status == 1, said
    assert "an error of vstatics" not in said.err
    assert "<stdout>" not in said.err
    lines = [line for line in said.err.splitlines() if re.search(FULL, line)]
    assert lines, said
    assert all(command.output.rstrip("/") in line for line in lines), said
    work = [file for file in command.state if file.name not in ("lock", "plan.json", "output")]
    results = command.written() if command.folder == "out" else {}
    # without work a file has only its first line, which says of what run it is
    if results or any(one.name.isdigit() or one.read_bytes().count(b"\n") > 1 for one in work):
        assert "--resume" in said.err, (said, work)


def goes_on(command: StatedCommand, expected: dict[str, bytes]) -> None:
    """With room the command goes on to the same bytes, and leaves nothing."""
    said = command.call("--resume")
    assert (said.status, command.written()) == (0, expected), said
    left = [path for path in Path().rglob("*") if re.search(r"\.(parts|vstatics)", str(path))]
    assert [path for path in left if path.name not in RECORDS] == []
    command.remove()


@pytest.fixture
def small(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    place = tmp_path / "small"
    place.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=256k,nr_inodes=64", "tmpfs", str(place)]
    try:
        is_mounted = subprocess.run(mount, capture_output=True, check=False).returncode == 0
    except OSError:
        is_mounted = False
    if not is_mounted:
        pytest.skip("nothing can be mounted here")
    prepare(place, monkeypatch)
    yield place
    monkeypatch.chdir(tmp_path)
    subprocess.run(["umount", str(place)], check=True)


def fill_pages(place: Path, free: int) -> None:
    status = os.statvfs(place)
    with (place / "ballast").open("wb") as file:
        file.write(bytes((status.f_bavail * status.f_frsize // PAGE - free) * PAGE))


def fill_inodes(place: Path, free: int) -> None:
    for number in range(os.statvfs(place).f_favail - free):
        (place / f"ballast {number}").touch()


def unload(place: Path) -> None:
    for path in place.glob("ballast*"):
        path.unlink()


def try_full(command: StatedCommand, fill: Callable[[Path, int], None], place: Path) -> int:
    """Have less and less room missing until the command succeeds; how often it did not."""
    expected = command.whole()
    for free in count():
        fill(place, free)
        said = command.call()
        if said.status == 0:
            unload(place)
            command.remove()
            return free
        judge(said, command)
        again = command.call("--resume")  # the disk is as full as it was
        if again.status:
            judge(again, command)
        unload(place)
        goes_on(command, expected)
    raise AssertionError


SOON = ("run jsonl", "sweep parquet", "boxes folder")


@pytest.mark.parametrize(
    ("name", "fill"),
    [
        pytest.param(
            name, fill, marks=[pytest.mark.slow] * (fill is fill_inodes or name not in SOON)
        )
        for name in COMMANDS_ONCE
        for fill in (fill_pages, fill_inodes)
    ],
)
def test_a_full_file_system_is_reported(
    name: str, fill: Callable[[Path, int], None], small: Path
) -> None:
    assert try_full(COMMANDS[name], fill, small) > 1


class FullDisk:
    """Calls of the system that need room: all fail from one on, which is counted from 0."""

    def __init__(self, patch: pytest.MonkeyPatch, first: int) -> None:
        self.calls, self.first = 0, first
        for name in CALLS:
            patch.setattr(os, name, self._limited(name, getattr(os, name)))

    def _limited(self, name: str, call: Callable[..., Any]) -> Callable[..., Any]:
        def limited(*values: Any, **named: Any) -> Any:
            if name == "open" and not values[1] & os.O_CREAT:
                return call(*values, **named)
            self.calls += 1
            if self.calls > self.first:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            return call(*values, **named)

        return limited


@pytest.mark.usefixtures("prepared")
@pytest.mark.parametrize("name", COMMANDS_ONCE)
@pytest.mark.parametrize("all_calls", with_slow([False], [True]))
def test_a_call_that_fails_for_a_full_disk_is_reported_by_the_output(
    name: str, all_calls: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Let the disk be full from one of all calls on, then have room again."""
    command = COMMANDS[name]
    expected = command.whole()
    with monkeypatch.context() as patch:
        disk = FullDisk(patch, 10**9)
        assert command.call("-q").status == 0
    command.remove()
    chosen = seeded(26).randrange(disk.calls)
    for first in range(disk.calls) if all_calls else [chosen]:
        with monkeypatch.context() as patch:
            FullDisk(patch, first)
            said = command.call()
        if said.status:  # the number of the process in a lock, say, is not needed
            judge(said, command)
        goes_on(command, expected)
