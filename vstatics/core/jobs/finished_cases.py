"""Results in a directory, which a resumed run reuses.

A run into a directory writes a hidden file (the record) for each format. The first line contains
the options and the build of this package. A line for each finished result follows. It contains
hashes of the case, of the files that the case names, and of the first line. It also contains size
and time of the result, and whether the case failed (a gear is tied up). A result counts as done if
its line agrees with the present case and run, and the result has not changed since. Each line
begins with its own hash, and damaged lines are ignored.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple, Self

from vstatics.core.errors import ReadError, of_file
from vstatics.core.extras import build
from vstatics.core.jobs.files import hash_of, hash_of_file, replace, write_all
from vstatics.core.jobs.lock import lock, unlock
from vstatics.core.jobs.state_files import StateFolder

Description = dict[str, Any]
"""Options and other data on which finished work depends, except the input files."""
LOCKED = ".lock"
PAGED = ("svg", "png")
"""Formats of pictures whose pages are separate files."""
_SEAL = 16
"""Number of hexadecimal digits of the hash of a line (64 bits)."""
NO_RUN = "there is no earlier run to resume"
OTHER_BUILD = "the finished work belongs to another build of vstatics"


def differing(known: Mapping[str, Any], wanted: Mapping[str, Any]) -> list[str]:
    """Return the keys with different values in the descriptions of finished and new work.

    >>> differing({"gears": [7, [6.5, 9]]}, {"gears": (7, (6.5, 9.0))})
    []
    >>> differing({"--coast": True, "--unloaded": None}, {"--coast": False, "--unloaded": None})
    ['--coast']
    """
    as_read = json.loads(json.dumps(dict(wanted)))
    return [key for key in as_read if key in known and known[key] != as_read[key]]


def sealed(text: bytes) -> bytes:
    r"""Return a line of a record: a text after its hash, which reveals damage.

    >>> unsealed(sealed(b"[1, 2]").rstrip(b"\n")), unsealed(b"[1, 3]")
    (b'[1, 2]', None)
    """
    return hash_of(text)[:_SEAL].encode() + b" " + text + b"\n"


def unsealed(line: bytes) -> bytes | None:
    """Return the text of a line of a record (without line end); None if the line is damaged."""
    text = line[_SEAL + 1 :]
    return text if sealed(text) == line + b"\n" else None


def described(options: Description) -> bytes:
    """Return the line that identifies a run: the options and the build of the package."""
    return json.dumps({"build": build(), **options}).encode()


def why_not_taken(
    first: bytes,
    options: Description,
    path: str,
    anew: str = "calculate all cases again without --resume",
) -> str:
    """Return the reason why finished work cannot be reused; "" if it can.

    Parameters
    ----------
    first : bytes
        First line of the record of finished work, which identifies the run.
    options : dict
    path : str
        File that contains the line, for messages.
    anew : str
        Advice in the message about how to start a new run.

    Raises
    ------
    ReadError
        If the earlier run had other options, so that its results do not belong to the new run.
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
        message = f"the earlier run was different ({changed}): use the same options, or {anew}"
        raise ReadError([of_file("E031", path, message)])
    return "" if first.rstrip(b"\n") == described(options) else OTHER_BUILD


class CaseMark(NamedTuple):
    """Hashes that identify the content of a case."""

    case: str
    """Hash of the case."""
    named_files: dict[str, str | None]
    """Hashes of the files that the case names."""

    def is_of(self, file: str) -> bool:
        """Return whether a case file, and all files that the case names, are unchanged."""
        hashes = {file: self.case, **self.named_files}
        return all(hash_of_file(name) == known for name, known in hashes.items())


def case_mark(data: bytes, named_files: Iterable[str]) -> CaseMark:
    """Return the hashes of a case (from its bytes), and of the files that the case names.

    >>> case_mark(b"links: 2", ["nowhere.csv"]).named_files
    {'nowhere.csv': None}
    """
    return CaseMark(hash_of(data), {file: hash_of_file(file) for file in named_files})


class _Entry(NamedTuple):
    """Line of the record for a result."""

    mark: CaseMark
    run: str
    """Hash of the options and the build of the run."""
    state: list[int]
    """Size of the result [bytes], and time of writing [ns]."""


class FinishedCases:
    """Results of a run in a directory. Only a single run at a time may write to it."""

    def __init__(self, folder: str, suffix: str, options: Description) -> None:
        self.folder = folder
        self.mark = suffix[1:]
        self.name = f".vstatics-run-{self.mark}"
        self._files = StateFolder(folder, has_results=True)
        self.path = self._files.file(self.name)
        self.options = options
        self._run = hashlib.sha256(described(options)).hexdigest()[:16]
        self._done: dict[str, _Entry] = {}
        self._lock: int | None = None
        self._record: int | None = None

    def __getstate__(self) -> dict[str, Any]:
        """Return the attributes for pickling. The receiving process opens the record again."""
        return vars(self) | {"_record": None}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Release the lock, and remove the unfinished files of workers."""
        if self._record is not None:
            os.close(self._record)
        if self._lock is not None:
            self._files.forget(self.mark)
            self._files.remove(self.name + LOCKED)
        unlock(self._lock)

    def exists(self) -> bool:
        """Return whether the record of a run exists."""
        return os.path.isdir(self.folder) and self.name in self._files.names()  # noqa: PTH112

    def lock(self) -> None:
        """Lock the results of a format; see `vstatics.core.jobs.lock.lock`."""
        self._files.check(self.name, self.name + LOCKED)
        self._lock = lock(self._files, self.name + LOCKED, "run")
        if self._lock is not None:
            self._files.forget(self.mark)  # remove unfinished files of a killed run

    def begin(self) -> None:
        """Begin a run with a new record.

        Raises
        ------
        OSError
            If the record cannot be written.
        """
        self._files.replace(self.name, described(self.options) + b"\n")

    def resume(self) -> str:
        """Resume the run; return "", or the reason why every case must be calculated again.

        Raises
        ------
        ReadError
            If the earlier run had other options, so that its results do not belong to the new run.
        """
        try:
            with self._files.reading(self.name) as file:
                first, *lines = file.read().split(b"\n")
        except FileNotFoundError:
            return NO_RUN
        why_not = why_not_taken(first, self.options, self.path)
        if why_not:
            return why_not
        for line in lines:
            self._take(line)
        if lines[-1:] != [b""]:  # a full disk can have cut off the last line
            self._append(b"\n")
        return ""

    def _append(self, data: bytes) -> None:
        if self._record is None:
            self._record = self._files.open(self.name, os.O_WRONLY | os.O_APPEND | os.O_CREAT)
        write_all(self._record, data)

    def _take(self, line: bytes) -> None:
        """Register the result of a line, unless the line is damaged or the case failed."""
        text = unsealed(line)
        if text is None:
            return
        name, case, named_files, run, state, failed = json.loads(text)
        self._done.pop(name, None)
        if not failed:
            self._done[name] = _Entry(CaseMark(case, named_files), run, state)

    def is_done(self, file: str, target: str) -> bool:
        """Return whether the run has a result for the present content of a case."""
        entry = self._done.get(os.path.basename(target))  # noqa: PTH119
        if entry is None or entry.run != self._run or entry.state != _state(target):
            return False
        return entry.mark.is_of(file)

    def put(
        self,
        target: str,
        result: Sequence[bytes],
        case: bytes,
        named_files: Iterable[str],
        *,
        failed: bool,
    ) -> None:
        """Write a result, and record the hashes of the case and of the files that it names.

        Parameters
        ----------
        result : sequence of bytes
            Contents of the pages of the result; a text has a single page.

        Raises
        ------
        ReadError
            If a page would overwrite a file of another origin.
        OSError
            If the result cannot be written.
        """
        if self.mark in PAGED:
            from vstatics.core.jobs.page_files import replace_pages  # few runs write pages

            replace_pages(target, result, self.mark)
        else:
            [page] = result
            replace(target, page, self.mark)
        name, mark = os.path.basename(target), case_mark(case, named_files)  # noqa: PTH119
        entry = [name, *mark, self._run, _state(target), failed]
        self._append(sealed(json.dumps(entry).encode()))


def _state(target: str) -> list[int] | None:
    try:
        status = os.lstat(target)
    except OSError:
        return None
    return [status.st_size, status.st_mtime_ns]


def _shown(value: object) -> str:
    return "not given" if value is None else json.dumps(value)
