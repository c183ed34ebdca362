"""A link, a FIFO, a device, a folder or another's file in the place of a lock or a state file."""

from __future__ import annotations

import os
import socket
from collections.abc import Callable, Iterable
from itertools import product
from pathlib import Path

import pytest

from tests.chance import seeded
from tests.core.cli.states import COMMANDS, StatedCommand, prepare, remove
from vstatics.core.jobs.state_files import StateFolder

NOBODY = 65534
CANARY = b"precious data\n"


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    prepare(tmp_path, monkeypatch)
    Path("canary").write_bytes(CANARY)
    os.utime("canary", ns=(10**18, 10**18))
    Path("aviary").mkdir()


def link(path: Path) -> None:
    path.symlink_to(Path("canary").absolute())


def dangling(path: Path) -> None:
    path.symlink_to(Path("nothing").absolute())


def link_to_folder(path: Path) -> None:
    path.symlink_to(Path("aviary").absolute())


def hard_link(path: Path) -> None:
    os.link("canary", path)


def folder(path: Path) -> None:
    path.mkdir()


def file(path: Path) -> None:
    path.write_bytes(CANARY)


def bound_socket(path: Path) -> None:
    with socket.socket(socket.AF_UNIX) as created:
        created.bind(str(path))


def device(path: Path) -> None:
    os.mknod(path, 0o20666, os.makedev(1, 3))


def of_another(path: Path) -> None:
    path.write_bytes(b"")
    os.chown(path, NOBODY, NOBODY)


def folder_of_another(path: Path) -> None:
    path.mkdir()
    os.chown(path, NOBODY, NOBODY)


Hostile = Callable[[Path], None]
FILES: dict[Hostile, str] = {
    link: "is a link",
    dangling: "is a link",
    link_to_folder: "is a link",
    hard_link: "has a second name",
    os.mkfifo: "is a named pipe (FIFO)",
    folder: "is a folder",
    bound_socket: "is a socket",
    **({device: "is a device", of_another: "has another owner"} if os.geteuid() == 0 else {}),
}
FOLDERS: dict[Hostile, str] = {
    link: "is a link",
    dangling: "is a link",
    link_to_folder: "is a link",
    os.mkfifo: "is a named pipe (FIFO)",
    file: "is a file",
    bound_socket: "is a socket",
    **({folder_of_another: "has another owner"} if os.geteuid() == 0 else {}),
}


def seen() -> dict[str, tuple[int, int]]:
    """All there is, with kinds and sizes."""
    status = {str(path): path.lstat() for path in Path().rglob("*")}
    return {name: (entry.st_mode, entry.st_size) for name, entry in status.items()}


def assert_refused(command: StatedCommand, name: str, words: str) -> None:
    """A command names what is wrong at once, and touches nothing."""
    before = seen()
    for more in ((), ("--resume",)):
        said = command.call(*more)
        assert said.status == 1, said
        assert name in said.err
        assert words in said.err
        assert "Traceback" not in said.err
    assert seen() == before
    assert (Path("canary").read_bytes(), Path("canary").stat().st_mtime_ns) == (CANARY, 10**18)


def assert_refused_in_places(command: StatedCommand, places: Iterable[tuple[str, Hostile]]) -> None:
    for name, hostile in places:
        Path(command.folder).mkdir()
        hostile(Path(command.folder, name))
        assert_refused(command, name, FILES[hostile])
        remove(command)


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
def test_what_is_no_state_file_is_refused_by_name(command: StatedCommand) -> None:
    """Each kind of it in one place, a link as the first file, which is the lock if there is one."""
    choose = seeded(46)
    others = [(choose.choice(command.names), hostile) for hostile in FILES if hostile is not link]
    assert_refused_in_places(command, [(command.names[0], link), *choose.sample(others, 2)])


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
def test_whatever_is_no_state_file_is_refused_anywhere(command: StatedCommand) -> None:
    assert_refused_in_places(command, product(command.names, FILES))


@pytest.mark.parametrize(
    "command",
    [entry for entry in COMMANDS.values() if entry.folder.endswith(".parts")],
    ids=[name for name, entry in COMMANDS.items() if entry.folder.endswith(".parts")],
)
def test_what_is_no_folder_of_a_state_is_refused_by_name(command: StatedCommand) -> None:
    for hostile, words in FOLDERS.items():
        hostile(Path(command.folder))
        assert_refused(command, command.folder, words)
        remove(command)


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
def test_an_output_and_its_folder_may_be_links(command: StatedCommand) -> None:
    """The result is that of an output that is not a link."""
    assert command.call("-q").status == 0
    expected = command.written()
    remove(command)
    Path("real").mkdir()
    if "synth" in command.arguments:
        Path(command.output.rstrip("/")).symlink_to("real")
        assert "is a link: expected a directory or a file" in command.call().err
    elif command.output.endswith("/"):
        Path(command.output.rstrip("/")).symlink_to("real")
        assert command.call("-q").status == 0
        assert command.written() == expected
    else:
        Path("real", "old").write_bytes(b"old")
        Path(command.output).symlink_to("real/old")
        assert command.call("-q").status == 0
        assert Path(command.output).is_symlink()
        assert list(command.written().values()) == list(expected.values())
    Path("door").symlink_to("real")
    other = command._replace(output=f"door/{command.output}")
    assert other.call("-q").status == 0
    assert list(other.written().values()) == list(expected.values())


@pytest.mark.parametrize("hostile", [link, dangling, hard_link, os.mkfifo, folder])
def test_a_file_that_is_swapped_after_it_was_looked_at_is_refused_all_the_same(
    hostile: Hostile, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The open file is looked at once more."""
    Path("state").mkdir()
    hostile(Path("state/lock"))
    monkeypatch.setattr(StateFolder, "_look", lambda *_: None)
    before = seen()
    for flags in (os.O_RDONLY, os.O_RDWR | os.O_CREAT, os.O_WRONLY | os.O_APPEND | os.O_CREAT):
        with pytest.raises(Exception, match=r"E040|\[Errno"):
            StateFolder("state").open("lock", flags)
    assert seen() == before
    assert Path("canary").read_bytes() == CANARY
