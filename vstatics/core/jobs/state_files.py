"""Locks and finished work in a folder to which other users can have access.

State files are locks and records of finished work. Only this module opens, renames or removes them.
The folder is opened first, and its files are opened relative to the folder, so that no other file
can replace a checked file. A state file must be a regular file of this user with a single name. A
link, a FIFO, a device, a socket, a folder or a file of another owner is refused before anything is
read or written. The folder itself is also checked.
"""

from __future__ import annotations

import contextlib
import os
import re
import stat
from collections.abc import Iterator
from typing import IO, NamedTuple

from vstatics.core.errors import ReadError, of_file
from vstatics.core.jobs.files import Write, descriptor_writing, front, replacing, sync, whole_file
from vstatics.core.jobs.input_files import AT_ONCE, KINDS

_NO_LINK = getattr(os, "O_NOFOLLOW", 0)
_FOLDER = getattr(os, "O_DIRECTORY", 0)
CURE = "remove it, or choose another output"


class StateFolder(NamedTuple):
    """Folder with state files: locks and records of finished work.

    Parameters
    ----------
    path : str
    has_results : bool
        True if the folder is the output itself, which can be a link or have another owner.
        Otherwise the folder contains only state files.
    """

    path: str
    has_results: bool = False

    def file(self, name: str) -> str:
        """Return the path of a file in the folder, for messages."""
        return os.path.join(self.path, name)  # noqa: PTH118

    def exists(self) -> bool:
        """Return whether the folder, or a file with its name, exists."""
        return os.path.lexists(self.path)

    def make(self) -> None:
        """Create the folder if necessary."""
        with contextlib.suppress(FileExistsError):
            os.mkdir(self.path)  # noqa: PTH102

    def check(self, *names: str) -> None:
        """Check that some files, by default all files of the folder, are state files.

        Raises
        ------
        ReadError
            If a file is refused; the message names the path.
        """
        if not self.exists():
            return
        with self._opened() as folder:
            for name in names or os.listdir(folder):  # noqa: PTH208
                self._look(folder, name)

    def names(self) -> list[str]:
        """Return the names of all files; empty if the folder does not exist."""
        if not self.exists():
            return []
        with self._opened() as folder:
            return os.listdir(folder)  # noqa: PTH208

    def size(self) -> int:
        """Return the size of all files in bytes."""
        if not self.exists():
            return 0
        with self._opened() as folder:
            names = os.listdir(folder)  # noqa: PTH208
            return sum(os.lstat(name, dir_fd=folder).st_size for name in names)

    def open(self, name: str, flags: int) -> int:
        """Open a file, and return its descriptor, which the caller must close.

        Raises
        ------
        ReadError
            If the file is not acceptable as a state file.
        OSError
        """
        with self._opened() as folder:
            self._look(folder, name)
            handle = os.open(name, flags | _NO_LINK | AT_ONCE, 0o666, dir_fd=folder)
        try:
            _refuse(self.file(name), os.fstat(handle), stat.S_IFREG)
        except BaseException:
            os.close(handle)
            raise
        return handle

    def has(self, name: str, handle: int) -> bool:
        """Return whether an open file still has the name `name` in the folder."""
        try:
            with self._opened() as folder:
                return os.path.samestat(os.fstat(handle), os.lstat(name, dir_fd=folder))
        except OSError:
            return False

    def reading(self, name: str) -> IO[bytes]:
        """Open a file for reading."""
        return open(self.open(name, os.O_RDONLY), "rb")  # noqa: PTH123

    def appending(self, name: str) -> contextlib.AbstractContextManager[Write]:
        """Open or create a file for appending."""
        return descriptor_writing(self.open(name, os.O_WRONLY | os.O_APPEND | os.O_CREAT))

    def writing(self, name: str) -> IO[bytes]:
        """Open a new file for writing, after removing an earlier file with its name."""
        self.check(name)
        self.remove(name)
        return open(self.open(name, os.O_RDWR | os.O_CREAT | os.O_EXCL), "r+b")  # noqa: PTH123

    @contextlib.contextmanager
    def replacing(self, name: str, mark: str = "") -> Iterator[Write]:
        """Write a file completely or not at all; see `vstatics.core.jobs.files.replacing`."""
        with self._opened() as folder:
            self._look(folder, name)
            with whole_file(name, mark, source=folder, target=folder) as write:
                yield write

    def replace(self, name: str, data: bytes) -> None:
        """Write a file completely or not at all."""
        with self.replacing(name) as write:
            write(data)

    @contextlib.contextmanager
    def replacing_output(self, path: str) -> Iterator[Write]:
        """Write a file in the folder, and move it to a path when the block ends."""
        with self._opened() as folder, replacing(path, folder=folder) as write:
            yield write

    def put_for_good(self, name: str, path: str) -> None:
        """Move a file to a path, and wait until the disk contains the file.

        Raises
        ------
        OSError
            If the data cannot be written. Both files are then unchanged.
        """
        with self.reading(name) as file:
            os.fsync(file.fileno())
        with self._opened() as folder:
            os.replace(name, path, src_dir_fd=folder)
        with contextlib.suppress(OSError):  # some systems cannot synchronise a folder
            sync(os.path.dirname(path) or os.curdir)  # noqa: PTH120

    def remove(self, name: str) -> None:
        """Remove a file if possible."""
        with contextlib.suppress(OSError), self._opened() as folder:
            os.unlink(name, dir_fd=folder)

    def forget(self, mark: str = "") -> None:
        """Remove unfinished files with a mark. No process may still be writing them."""
        for name in self.names():
            if re.fullmatch(rf"{re.escape(front(mark))}\d+-\d+", name):
                self.remove(name)

    def drop(self) -> None:
        """Remove the folder if empty."""
        with contextlib.suppress(OSError):
            os.rmdir(self.path)  # noqa: PTH106

    @contextlib.contextmanager
    def _opened(self) -> Iterator[int]:
        """Open the folder for a `with` block, and yield its descriptor.

        Raises
        ------
        ReadError
            If the path is not a folder, or if a folder for state files only has another owner.
        OSError
        """
        if not self.has_results:
            _refuse(self.path, os.lstat(self.path), stat.S_IFDIR)
        handle = os.open(self.path, os.O_RDONLY | _FOLDER | (0 if self.has_results else _NO_LINK))
        try:
            if not self.has_results:
                _refuse(self.path, os.fstat(handle), stat.S_IFDIR)
            yield handle
        finally:
            os.close(handle)

    def _look(self, folder: int, name: str) -> None:
        try:
            status = os.lstat(name, dir_fd=folder)
        except FileNotFoundError:
            return
        _refuse(self.file(name), status, stat.S_IFREG)


def _refuse(path: str, status: os.stat_result, kind: int) -> None:
    """Raise an error for a path that has another owner or is not of the type `kind`.

    Raises
    ------
    ReadError
    """
    seen, expected = stat.S_IFMT(status.st_mode), KINDS[kind]
    if seen != kind:
        message = f"is {KINDS.get(seen, 'something else')}, expected {expected}; {CURE}"
        raise ReadError([of_file("E040", path, message)])
    if status.st_uid != os.geteuid():
        message = f"has another owner ({_user(status.st_uid)}), expected {expected} of your own"
        raise ReadError([of_file("E041", path, f"{message}; {CURE}")])
    if kind == stat.S_IFREG and status.st_nlink > 1:
        message = f"has a second name (a hard link), expected {expected} with a single name; {CURE}"
        raise ReadError([of_file("E040", path, message)])


def _user(number: int) -> str:
    try:
        import pwd

        return pwd.getpwuid(number).pw_name
    except (ImportError, KeyError):
        return f"user {number}"
