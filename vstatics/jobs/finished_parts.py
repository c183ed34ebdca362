"""Parts of one output of many cases that a resumed run trusts.

While a run writes one file, a directory beside it holds the parts of cases that are finished: a
line for what they depend on (options and the build of this package), then for each part a line,
with the hash of the case that was read and of the files that it names, and the part itself. It
goes when the output is there.
"""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Iterable
from typing import IO, NamedTuple, Self

from vstatics.jobs.files import replace
from vstatics.jobs.finished_cases import (
    NO_RUN,
    Description,
    described,
    hash_of,
    hash_of_file,
    why_not_taken,
)
from vstatics.jobs.finished_pieces import LOCK, SUFFIX
from vstatics.jobs.lock import lock, unlock

PARTS = "parts"


class CaseMark(NamedTuple):
    """Of which case a part is."""

    case: str
    """Its hash."""
    beside: dict[str, str | None]
    """Hashes of the files that it names."""


def case_mark(data: bytes, beside: Iterable[str]) -> CaseMark:
    """The mark of a case as it was read, and of files beside it.

    >>> case_mark(b"links: 2", ["nowhere.csv"]).beside
    {'nowhere.csv': None}
    """
    return CaseMark(hash_of(data), {one: hash_of_file(one) for one in beside})


class _Stretch(NamedTuple):
    """Where a part stands."""

    mark: CaseMark
    start: int
    size: int


class FinishedParts:
    """The parts of one output, which one process writes.

    Parameters
    ----------
    output : str
        The file that will be there in the end.
    options : dict
        What the parts depend on, besides the cases.
    """

    def __init__(self, output: str, options: Description) -> None:
        self.output = output
        self.directory = os.path.realpath(output) + SUFFIX
        self.path = os.path.join(self.directory, PARTS)  # noqa: PTH118
        self.options = options
        self._parts: dict[str, _Stretch] = {}
        """Of the run that is taken up."""
        self._added = False
        self._lock: int | None = None
        self._file: IO[bytes] | None = None

    def __enter__(self) -> Self:
        """Nothing is touched yet."""
        return self

    def __exit__(self, *error: object) -> None:
        """Let go of the parts, which stay after an error, if there are any."""
        if self._file is not None:
            self._file.close()
        if self._file is not None and (error[0] is None or not (self._parts or self._added)):
            for path in (self.path, os.path.join(self.directory, LOCK)):  # noqa: PTH118
                with contextlib.suppress(OSError):
                    os.unlink(path)  # noqa: PTH108
            with contextlib.suppress(OSError):
                os.rmdir(self.directory)  # noqa: PTH106
        unlock(self._lock)

    def open(self, *, resume: bool) -> str:
        """Begin, or take up what is there; why nothing is taken up, where that was asked for.

        Raises
        ------
        ReadError
            If what is there had other options, or another process writes it.
        OSError
            If nothing can be written.
        """
        self._lock = lock(self.directory, LOCK, "run")
        without = self._take() if resume else NO_RUN
        if without:
            self._parts.clear()
            replace(self.path, described(self.options) + b"\n")
        self._file = open(self.path, "r+b")  # noqa: PTH123, SIM115 - closed with the parts
        self._file.readline()  # what the parts depend on
        ends = [one.start + one.size for one in self._parts.values()]
        self._file.truncate(max([self._file.tell(), *ends]))  # what a run that was killed has cut
        self._file.seek(0, os.SEEK_END)
        return without if resume else ""

    def _take(self) -> str:
        """Learn which parts are there; why they can't be taken up."""
        try:
            with open(self.path, "rb") as file:  # noqa: PTH123
                without = why_not_taken(file.readline(), self.options, self.path)
                size = os.fstat(file.fileno()).st_size
                while not without and (line := file.readline()).endswith(b"\n"):
                    name, case, beside, length = json.loads(line)
                    start = file.tell()
                    if start + length > size:
                        break
                    self._parts[name] = _Stretch(CaseMark(case, beside), start, length)
                    file.seek(length, os.SEEK_CUR)
        except FileNotFoundError:
            return NO_RUN
        except (ValueError, TypeError):  # a disk that was full; what is before it counts
            return ""
        return without

    def is_done(self, file: str) -> bool:
        """Whether there is the part of a case as it is now."""
        part = self._parts.get(file)
        if part is None:
            return False
        hashes = {file: part.mark.case, **part.mark.beside}
        return all(hash_of_file(name) == known for name, known in hashes.items())

    def part(self, file: str) -> bytes:
        """The part of a case."""
        found = self._parts[file]
        assert self._file is not None  # noqa: S101 - it was opened
        self._file.seek(found.start)
        return self._file.read(found.size)

    def put(self, file: str, mark: CaseMark, part: bytes) -> None:
        """Keep the part of a case.

        Raises
        ------
        OSError
            If that is not possible.
        """
        assert self._file is not None  # noqa: S101 - it was opened
        head = json.dumps([file, mark.case, mark.beside, len(part)]).encode() + b"\n"
        self._file.seek(0, os.SEEK_END)
        self._file.write(head + part)
        self._file.flush()
        self._added = True  # what is new is in memory no longer than it takes to write it
