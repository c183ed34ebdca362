"""Finished work that a resumed run trusts: results in a directory, and pieces of a sweep.

A run into a directory leaves a hidden file for each format there: the options on which the
results depend, then a line for each result as it is finished, with the state of its case
and whether that failed (a gear is tied up). A result counts as done if neither it nor its
case has changed since.

While a sweep into `out.csv` runs there is a directory `out.csv.parts`. It holds a file for
each finished piece, a description of the sweep, and a lock.
"""

from __future__ import annotations

import contextlib
import errno
import json
import os
import stat
from collections.abc import Mapping
from typing import Any, Self

from vstatics.errors import ReadError, of_file
from vstatics.jobs.files import is_temporary, replace
from vstatics.jobs.lock import LOCK, lock
from vstatics.jobs.pieces import ASSEMBLED, Account, read_account

SUFFIX = ".parts"
PLAN = "plan.json"
Description = dict[str, Any]
"""Everything that the finished work depends on."""
CaseState = list[int]
"""Of a case: another file under its name, or another content, has another one."""


def differing(known: Mapping[str, Any], wanted: Mapping[str, Any]) -> list[str]:
    """Where finished work is not what is wanted.

    >>> differing({"--coast": True, "--idle": None}, {"--coast": False, "--idle": None})
    ['--coast']
    """
    return [key for key in wanted if key in known and known[key] != wanted[key]]


def case_state(file: str) -> CaseState | None:
    """The state of a case, before it is read; None if it is no file."""
    try:
        status = os.stat(file)  # noqa: PTH116
    except OSError:
        return None
    if not stat.S_ISREG(status.st_mode):
        return None
    return [status.st_ino, status.st_size, status.st_mtime_ns]


class FinishedCases:
    """The results of a run in a directory."""

    def __init__(self, folder: str, suffix: str) -> None:
        """Name the file; it is not touched yet."""
        self.path = os.path.join(folder, f".vstatics-run-{suffix[1:]}")  # noqa: PTH118
        self._done: dict[str, tuple[CaseState, int]] = {}
        """Name of a result -> state of its case, and when it was written [ns]."""

    def begin(self, options: Description) -> None:
        """Begin a run.

        Raises
        ------
        OSError
            If that cannot be written.
        """
        replace(self.path, json.dumps(options).encode() + b"\n")

    def resume(self, options: Description) -> bool:
        """Take up the run that is there; whether there is one.

        Raises
        ------
        ReadError
            If that run had other options, so that its results would not go together
            with those to come.
        """
        try:
            with open(self.path, encoding="utf-8") as file:  # noqa: PTH123
                first, *lines = file.read().splitlines()
            known = dict(json.loads(first))
        except (OSError, ValueError, TypeError):
            return False
        if not options.keys() <= known.keys():
            return False
        changed = "; ".join(
            f"{key} was {_shown(known[key])}, is {_shown(options[key])}"
            for key in differing(known, options)
        )
        if changed:
            message = (
                f"the run to go on with was another one ({changed}): use the same options, "
                "or calculate all cases again without --resume"
            )
            raise ReadError([of_file(self.path, message)])
        for line in lines:
            self._take(line)
        return True

    def _take(self, line: str) -> None:
        """An entry; the last line may have been cut."""
        try:
            name, case, written, failed = json.loads(line)
        except (ValueError, TypeError):
            return
        self._done.pop(name, None)
        if not failed:
            self._done[name] = case, written

    def is_done(self, file: str, target: str) -> bool:
        """Whether there is a result of this run, and of the case as it is now."""
        case, written = self._done.get(os.path.basename(target), (None, 0))  # noqa: PTH119
        if case is None or case != case_state(file):
            return False
        try:
            return os.lstat(target).st_mtime_ns == written
        except OSError:
            return False

    def note(self, target: str, case: CaseState | None, *, failed: bool) -> None:
        """Note a result that is in its place.

        Raises
        ------
        OSError
            If that is not possible.
        """
        if case is not None:
            written = os.stat(target).st_mtime_ns  # noqa: PTH116
            entry = [os.path.basename(target), case, written, failed]  # noqa: PTH119
            with open(self.path, "ab", buffering=0) as file:  # noqa: PTH123
                file.write(json.dumps(entry).encode() + b"\n")


def _shown(value: object) -> str:
    return "not given" if value is None else json.dumps(value)


class FinishedPieces:
    """The directory of finished pieces of one sweep, held by one process."""

    def __init__(self, output: str) -> None:
        """For an output file; `open` makes the directory."""
        self.output = os.path.realpath(output)
        self.directory = self.output + SUFFIX
        self.accounts: dict[int, Account] = {}
        self._lock: int | None = None
        self._opened = False

    def __enter__(self) -> Self:
        """Nothing is touched yet."""
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

    def open(self, description: Description, pieces: int, *, resume: bool) -> None:
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
        self.lock()
        known = self._known()
        finished = [piece for piece in self.finished() if piece < pieces]
        if finished and known is not None:
            self._check(known, description, len(finished), resume=resume)
            accounts = (read_account(self.directory, piece) for piece in finished)
            self.accounts = {account.piece: account for account in accounts if account}
        self._opened = True
        for name in self._names():  # what a killed process left unfinished
            if name not in (PLAN, LOCK) and not (name.isdigit() and int(name) in self.accounts):
                os.unlink(self.path(name))  # noqa: PTH108
        text = json.dumps(description, indent=2, ensure_ascii=False)
        replace(self.path(PLAN), text.encode())

    def _known(self) -> Description | None:
        """The description of the sweep whose pieces are there."""
        try:
            with open(self.path(PLAN), encoding="utf-8") as file:  # noqa: PTH123
                known = json.load(file)
        except (OSError, ValueError):
            known = None
        if isinstance(known, dict) and "fingerprint" in known:
            return known
        if all(name == LOCK or is_temporary(name) for name in self._names()):
            return None
        message = "holds no sweep that can be taken up; move it away"
        raise ReadError([of_file(self.directory, message)])

    def _names(self) -> list[str]:
        """What is in the directory."""
        return os.listdir(self.directory) if self.exists() else []  # noqa: PTH208

    def finished(self) -> list[int]:
        """The numbers of the pieces that are there, whoever finished them."""
        return sorted(int(name) for name in self._names() if name.isdigit())

    def _check(
        self, known: Description, wanted: Description, finished: int, *, resume: bool
    ) -> None:
        """Refuse pieces of another sweep, and pieces that nobody asked to take up."""
        changed = differing(known, wanted)
        if "fingerprint" in changed:
            keys = [key for key in changed if key not in ("fingerprint", "pieces")]
            what = f": {', '.join(keys)} changed" if keys else ""
            sweep = f"of another sweep{what}; repeat that one with --resume"
        elif not resume:
            sweep = "of this sweep, which was stopped; go on with --resume"
        else:
            return
        held = f"holds {finished} of {known.get('pieces')} finished pieces"
        message = f"{held} {sweep}, or remove the directory to begin anew"
        raise ReadError([of_file(self.directory, message)])

    def lock(self) -> None:
        """Take the directory for this process; see `vstatics.jobs.lock.lock`."""
        self._lock = lock(self.directory)

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
        for name in sorted(self._names(), key=(PLAN, LOCK).__contains__):
            self.discard(name)
        with contextlib.suppress(OSError):
            os.rmdir(self.directory)  # noqa: PTH106
