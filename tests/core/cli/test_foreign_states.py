"""A link, a FIFO, a device, a folder or another's file in the place of a lock or a state file."""

import os
import socket
from collections.abc import Callable, Iterable
from functools import partial
from itertools import product
from pathlib import Path

import pytest

from tests.chance import seeded
from tests.core.cli.states import COMMANDS, StatedCommand
from vstatics.core.jobs.state_files import StateFolder

CANARY = b"precious data\n"
EACH = pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)


@pytest.fixture(autouse=True)
def _canary(prepared: Path) -> None:
    assert Path.cwd() == prepared
    Path("canary").write_bytes(CANARY)
    os.utime("canary", ns=(10**18, 10**18))
    Path("aviary").mkdir()


def bind_socket(path: Path) -> None:
    with socket.socket(socket.AF_UNIX) as created:
        created.bind(str(path))


def of_another(make: Callable[[Path], None]) -> Callable[[Path], None]:
    def made(path: Path) -> None:
        make(path)
        os.chown(path, 65534, 65534)

    return made


LINKS: dict[Callable[[Path], None], str] = {
    partial(lambda name, path: path.symlink_to(Path(name).absolute()), name): "is a link"
    for name in ("canary", "nothing", "aviary")
}
FILES: dict[Callable[[Path], None], str] = {
    **LINKS,
    lambda path: path.hardlink_to("canary"): "has a second name",
    os.mkfifo: "is a named pipe (FIFO)",
    os.mkdir: "is a folder",
    bind_socket: "is a socket",
}
FOLDERS = {**LINKS, os.mkfifo: FILES[os.mkfifo], Path.touch: "is a file"}
if os.geteuid() == 0:
    null = os.makedev(1, 3)
    FILES[lambda path: os.mknod(path, 0o20666, null)] = "is a device"
    FILES[of_another(Path.touch)] = "has another owner"
    FOLDERS[of_another(Path.mkdir)] = "has another owner"


def seen() -> dict[str, tuple[int, int]]:
    status = {str(path): path.lstat() for path in Path().rglob("*")}
    return {name: (entry.st_mode, entry.st_size) for name, entry in status.items()}


def assert_refused(command: StatedCommand, name: str, words: str) -> None:
    """A command names what is wrong at once, and touches nothing."""
    before = seen()
    for more in ((), ("--resume",)):
        said = command.call(*more)
        assert said.fails(name, words), said
        assert "Traceback" not in said.err
    assert seen() == before
    assert (Path("canary").read_bytes(), Path("canary").stat().st_mtime_ns) == (CANARY, 10**18)


def assert_files_refused(
    command: StatedCommand, places: Iterable[tuple[str, Callable[[Path], None]]]
) -> None:
    for name, hostile in places:
        Path(command.folder).mkdir()
        hostile(Path(command.folder, name))
        assert_refused(command, name, FILES[hostile])
        command.remove()


@EACH
def test_what_is_no_state_file_is_refused_by_name(command: StatedCommand) -> None:
    """A link as the first file, which is the lock if there is one, and two others by chance."""
    choose = seeded(46)
    link, *others = FILES
    places = [(choose.choice(command.names), hostile) for hostile in others]
    assert_files_refused(command, [(command.names[0], link), *choose.sample(places, 2)])


@pytest.mark.slow
@EACH
def test_whatever_is_no_state_file_is_refused_anywhere(command: StatedCommand) -> None:
    assert_files_refused(command, product(command.names, FILES))


@EACH
def test_what_is_no_folder_of_a_state_is_refused_by_name(command: StatedCommand) -> None:
    for hostile, words in FOLDERS.items() if command.folder.endswith(".parts") else ():
        hostile(Path(command.folder))
        assert_refused(command, command.folder, words)
        command.remove()


@EACH
def test_an_output_and_its_folder_may_be_links(command: StatedCommand) -> None:
    """The result is that of an output that is not a link."""
    expected = command.whole()
    Path("real").mkdir()
    Path("real", "old").write_bytes(b"old")
    link = Path(command.output.rstrip("/"))
    if "synth" in command.arguments:
        link.symlink_to("real")
        assert command.call().is_wrong_use("is a link: expected a directory or a file")
    else:
        link.symlink_to("real" if command.output.endswith("/") else "real/old")
        Path("real", "old").unlink()
        assert command.call("-q").status == 0
        assert (link.is_symlink(), [*command.written().values()]) == (True, [*expected.values()])
    Path("door").symlink_to("real")
    other = command._replace(output=f"door/{command.output}")
    assert other.call("-q").status == 0
    assert [*other.written().values()] == [*expected.values()]


@pytest.mark.parametrize("hostile", [*FILES][:6])
def test_a_file_that_is_swapped_after_it_was_looked_at_is_refused_all_the_same(
    hostile: Callable[[Path], None], monkeypatch: pytest.MonkeyPatch
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
