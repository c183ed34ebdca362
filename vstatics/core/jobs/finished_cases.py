"""Results in a directory that a resumed run trusts.

A run into a directory leaves a hidden file for each format there: what the results depend
on (options and the build of this package), then a line for each result as it is finished.
The line holds the hash of the case that was read and of the files that it names, a number for
all that the run depends on, the state of the result, and whether the case failed (a gear is tied
up). A result counts as done if its line says so: of this case, this run, and not written by
anybody since. Each line begins with its own hash; a line that is damaged does not count.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple, Self

from vstatics.core.errors import ReadError, of_file
from vstatics.core.extras import build
from vstatics.core.jobs.files import hash_of, hash_of_file
from vstatics.core.jobs.lock import lock, unlock
from vstatics.core.jobs.state_files import StateFolder

Description = dict[str, Any]
"""Everything that finished work depends on, besides what is read."""
LOCKED = ".lock"
_SEAL = 16
"""Digits of the hash of a line: 64 bits."""
NO_RUN = "there is no run to go on with"
OTHER_BUILD = "what is there is of another build of vstatics"


def differing(known: Mapping[str, Any], wanted: Mapping[str, Any]) -> list[str]:
    """Name the keys in which finished work, as JSON has it, is not what is wanted.

    >>> differing({"gears": [7, [6.5, 9]]}, {"gears": (7, (6.5, 9.0))})
    []
    >>> differing({"--coast": True, "--idle": None}, {"--coast": False, "--idle": None})
    ['--coast']
    """
    as_read = json.loads(json.dumps(dict(wanted)))
    return [key for key in as_read if key in known and known[key] != as_read[key]]


def sealed(text: bytes) -> bytes:
    r"""Return a line of a state: its hash, by which damage is noticed later, and a text.

    >>> unsealed(sealed(b"[1, 2]").rstrip(b"\n")), unsealed(b"[1, 3]")
    (b'[1, 2]', None)
    """
    return hash_of(text)[:_SEAL].encode() + b" " + text + b"\n"


def unsealed(line: bytes) -> bytes | None:
    """Return the text of a line of a state, without its end; None if it is damaged."""
    text = line[_SEAL + 1 :]
    return text if sealed(text) == line + b"\n" else None


def described(options: Description) -> bytes:
    """A line that tells of what run something is: its options, and the build of this package."""
    return json.dumps({"build": build(), **options}).encode()


def why_not_taken(
    first: bytes,
    options: Description,
    path: str,
    anew: str = "calculate all cases again without --resume",
) -> str:
    """Why finished work can't be taken up, by the line that tells of what run it is; "" if it can.

    Parameters
    ----------
    first : bytes
        That line.
    options : dict
    path : str
        Where it stands.
    anew : str
        What to do for another run, in words.

    Raises
    ------
    ReadError
        If that run had other options, so that its results would not go together
        with those to come.
    """
    try:
        known = dict(json.loads(first))
    except (ValueError, TypeError):
        return NO_RUN
    if not known.keys() & options.keys():
        return NO_RUN
    changed = "; ".join(
        f"{key} was {_shown(known[key])}, is {_shown(options[key])}"
        for key in differing(known, options)
    )
    if changed:
        message = (
            f"the run to go on with was another one ({changed}): use the same options, or {anew}"
        )
        raise ReadError([of_file("E031", path, message)])
    return "" if first.rstrip(b"\n") == described(options) else OTHER_BUILD


class _Entry(NamedTuple):
    """A line: what is known of a result."""

    case: str
    """The hash of its case."""
    beside: dict[str, str | None]
    """The hashes of the files that the case names."""
    run: str
    """A number for all that its run depended on."""
    state: list[int]
    """Its size, and when it was written [ns]."""


class FinishedCases:
    """The results of a run in a directory, which one process at a time writes."""

    def __init__(self, folder: str, suffix: str, options: Description) -> None:
        """Name the file; nothing is touched yet."""
        self.folder = folder
        self.mark = suffix[1:]
        self.name = f".vstatics-run-{self.mark}"
        self._files = StateFolder(folder, has_results=True)
        self.path = self._files.file(self.name)
        self.options = options
        self._run = hashlib.sha256(described(options)).hexdigest()[:16]
        self._done: dict[str, _Entry] = {}
        self._lock: int | None = None

    def __enter__(self) -> Self:
        """Nothing is touched yet."""
        return self

    def __exit__(self, *_: object) -> None:
        """Let go of the directory, without what a worker was writing when it was ended."""
        if self._lock is not None:
            self._files.forget(self.mark)
            self._files.remove(self.name + LOCKED)
        unlock(self._lock)

    def exists(self) -> bool:
        """Return whether there is a record of a run."""
        return os.path.isdir(self.folder) and self.name in self._files.names()  # noqa: PTH112

    def lock(self) -> None:
        """Take the results of this format for this process; see `vstatics.core.jobs.lock.lock`."""
        self._files.check(self.name, self.name + LOCKED)
        self._lock = lock(self._files, self.name + LOCKED, "run")
        if self._lock is not None:
            self._files.forget(self.mark)  # of a run that was killed

    def begin(self) -> None:
        """Begin a run.

        Raises
        ------
        OSError
            If that cannot be written.
        """
        self._files.replace(self.name, described(self.options) + b"\n")

    def resume(self) -> str:
        """Take up the run that is there; why every case is calculated, if there is none.

        Raises
        ------
        ReadError
            If that run had other options, so that its results would not go together
            with those to come.
        """
        try:
            with self._files.reading(self.name) as file:
                first, *lines = file.read().split(b"\n")
        except FileNotFoundError:
            return NO_RUN
        without = why_not_taken(first, self.options, self.path)
        if without:
            return without
        for line in lines:
            self._take(line)
        if lines[-1:] != [b""]:  # a disk was full: the next line is not to be added to this one
            self._append(b"\n")
        return ""

    def _append(self, data: bytes) -> None:
        with self._files.appending(self.name) as write:
            write(data)

    def _take(self, line: bytes) -> None:
        """Take up an entry, unless its line was cut or damaged."""
        text = unsealed(line)
        if text is None:
            return
        name, case, beside, run, state, failed = json.loads(text)
        self._done.pop(name, None)
        if not failed:
            self._done[name] = _Entry(case, dict(beside), run, state)

    def is_done(self, file: str, target: str) -> bool:
        """Whether there is a result of this run, and of the case as it is now."""
        entry = self._done.get(os.path.basename(target))  # noqa: PTH119
        if entry is None or entry.run != self._run or entry.state != _state(target):
            return False
        hashes = {file: entry.case, **entry.beside}
        return all(hash_of_file(name) == known for name, known in hashes.items())

    def put(
        self,
        target: str,
        result: Sequence[bytes],
        case: bytes,
        beside: Iterable[str],
        *,
        failed: bool,
    ) -> None:
        """Write a result, and note of what case as it was read, and files beside it, it is.

        Parameters
        ----------
        result : sequence of bytes
            Its pages; a text has one.

        Raises
        ------
        ReadError
            If a page would overwrite a file of others.
        OSError
            If that is not possible.
        """
        from vstatics.core.jobs.page_files import replace_pages  # few runs write pages

        replace_pages(target, result, self.mark)
        name, others = os.path.basename(target), {one: hash_of_file(one) for one in beside}  # noqa: PTH119
        entry = [name, hash_of(case), others, self._run, _state(target), failed]
        self._append(sealed(json.dumps(entry).encode()))


def _state(target: str) -> list[int] | None:
    """The size of a result, and when it was written [ns]; None if it is not there."""
    try:
        status = os.lstat(target)
    except OSError:
        return None
    return [status.st_size, status.st_mtime_ns]


def _shown(value: object) -> str:
    return "not given" if value is None else json.dumps(value)
