"""The directory of finished pieces beside the output, so that a killed sweep goes on.

While a sweep into `out.csv` runs there is a directory `out.csv.parts`. It holds a file for
each finished piece, a description of the sweep, and a lock that a process has for as long
as it lives.
"""

from __future__ import annotations

import contextlib
import errno
import json
import os
import time
from typing import Any, Self

from vstatics.errors import Place, Problem, ReadError
from vstatics.jobs.pieces import ASSEMBLED, Account, read_account

SUFFIX = ".parts"
PLAN, LOCK = "plan.json", "lock"
PATIENCE = 10
"""Tenths of a second to wait for a lock."""


class Store:
    """The directory of finished pieces of one sweep, held by one process."""

    def __init__(self, output: str) -> None:
        """For an output file; `open` makes the directory."""
        self.output = os.path.realpath(output)
        self.directory = self.output + SUFFIX
        self.accounts: dict[int, Account] = {}
        self._lock: int | None = None
        self._opened = False

    def __enter__(self) -> Self:
        """The store itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Let go of the directory; what is finished stays."""
        if self._opened and not self.finished():
            self._remove()
        self.unlock()

    def path(self, name: str) -> str:
        """A file in the directory."""
        return os.path.join(self.directory, name)  # noqa: PTH118

    def exists(self) -> bool:
        """Whether there is a directory of pieces."""
        return os.path.isdir(self.directory)  # noqa: PTH112

    def problem(self, message: str) -> ReadError:
        """An error about the directory."""
        return ReadError([Problem(message, place=Place(self.directory, 0, 0))])

    def open(self, description: dict[str, Any], pieces: int, *, resume: bool) -> None:
        """Make the directory, or take up the pieces that it holds.

        Parameters
        ----------
        description : dict
            What the sweep is; its `fingerprint` must be that of the pieces that are there.
        pieces : int
            How many there will be.
        resume : bool
            Whether pieces may be there.

        Raises
        ------
        ReadError
            If another process is at it, or pieces are there that are not to be taken up.
        OSError
        """
        if os.path.isdir(self.output):  # noqa: PTH112
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        self._make()
        self.lock()
        known = self._known()
        found = [] if known is None else [piece for piece in self.finished() if piece < pieces]
        if found and known is not None:
            self._check(known, description, found, resume=resume)
            accounts = (read_account(self.directory, piece) for piece in found)
            self.accounts = {account.piece: account for account in accounts if account}
        self._opened = True
        self._tidy()
        self._write_plan(description)

    def _make(self) -> None:
        with contextlib.suppress(FileExistsError):
            os.mkdir(self.directory)  # noqa: PTH102

    def _known(self) -> dict[str, Any] | None:
        """The description of the sweep whose pieces are there."""
        names = set(os.listdir(self.directory)) - {LOCK}  # noqa: PTH208
        if not names:
            return None
        try:
            with open(self.path(PLAN), encoding="utf-8") as file:  # noqa: PTH123
                known = json.load(file)
        except (OSError, ValueError):
            known = None
        if not isinstance(known, dict) or "fingerprint" not in known:
            if all(name.endswith(".tmp") for name in names):
                return None
            raise self.problem("holds no sweep that can be taken up; move it away")
        return known

    def finished(self) -> list[int]:
        """The numbers of the pieces that are there, whoever finished them."""
        there = os.listdir(self.directory) if self.exists() else []  # noqa: PTH208
        return sorted(int(name) for name in there if name.isdigit())

    def _check(
        self, known: dict[str, Any], wanted: dict[str, Any], found: list[int], *, resume: bool
    ) -> None:
        """Refuse pieces of another sweep, and pieces that nobody asked to take up."""
        held = f"holds {len(found)} of {known.get('pieces')} finished pieces"
        if known["fingerprint"] != wanted["fingerprint"]:
            changed = [key for key in wanted if key in known and known[key] != wanted[key]]
            changed = [key for key in changed if key not in ("fingerprint", "pieces")]
            what = f": {', '.join(changed)} changed" if changed else ""
            raise self.problem(
                f"{held} of another sweep{what}; repeat that one with --resume, or remove the "
                "directory to begin anew"
            )
        if not resume:
            raise self.problem(
                f"{held} of this sweep, which was stopped; go on with --resume, or remove the "
                "directory to begin anew"
            )

    def _tidy(self) -> None:
        """Remove what a killed process left unfinished."""
        for name in os.listdir(self.directory):  # noqa: PTH208
            kept = name in (PLAN, LOCK) or (name.isdigit() and int(name) in self.accounts)
            if not kept:
                os.unlink(self.path(name))  # noqa: PTH108

    def _write_plan(self, description: dict[str, Any]) -> None:
        temporary = self.path(PLAN + ".tmp")
        with open(temporary, "w", encoding="utf-8") as file:  # noqa: PTH123
            json.dump(description, file, indent=2, ensure_ascii=False)
        os.replace(temporary, self.path(PLAN))  # noqa: PTH105

    def lock(self) -> None:
        """Take the directory for this process; a process that was killed holds nothing.

        Raises
        ------
        ReadError
            If another process has it.
        """
        try:
            import fcntl
        except ImportError:  # no such locks on this system
            return
        lock = -1
        for attempt in range(PATIENCE):
            if attempt:
                os.close(lock)
                time.sleep(0.1)
                self._make()
            lock = os.open(self.path(LOCK), os.O_RDWR | os.O_CREAT, 0o666)
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                if attempt + 1 < PATIENCE:  # workers of a killed process leave soon
                    continue
                holder = os.read(lock, 100).decode(errors="replace").strip()
                os.close(lock)
                process = f" (process {holder})" if holder else ""
                raise self.problem(f"another sweep{process} is writing this output") from None
            if _is_same(lock, self.path(LOCK)):  # else it was removed, by one that has finished
                break
        os.truncate(lock, 0)
        os.write(lock, f"{os.getpid()}\n".encode())
        self._lock = lock

    def unlock(self) -> None:
        """Let go of the directory."""
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None

    def discard(self, name: str) -> None:
        """Remove a file from the directory, if it is there."""
        with contextlib.suppress(OSError):
            os.unlink(self.path(name))  # noqa: PTH108

    def finish(self) -> None:
        """Move the assembled output into place and remove the pieces.

        Raises
        ------
        OSError
        """
        os.replace(self.path(ASSEMBLED), self.output)  # noqa: PTH105
        self._remove()
        self.unlock()

    def _remove(self) -> None:
        """Remove the directory, last what tells of which sweep it is: so any rest can go on."""
        names = os.listdir(self.directory) if self.exists() else []  # noqa: PTH208
        for name in sorted(names, key=(PLAN, LOCK).__contains__):
            self.discard(name)
        with contextlib.suppress(OSError):
            os.rmdir(self.directory)  # noqa: PTH106


def _is_same(file: int, path: str) -> bool:
    """Whether an open file still has this name."""
    try:
        return os.path.samestat(os.fstat(file), os.stat(path))  # noqa: PTH116
    except OSError:
        return False
