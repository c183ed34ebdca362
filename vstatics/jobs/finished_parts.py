"""Parts of one output of many cases that a resumed run trusts.

While a run writes one file, a directory beside it holds the parts of cases that are finished: a
line for what they depend on (options and the build of this package), then for each part a line,
with the hash of the case that was read and of the files that it names, and the part itself. It
goes when the output is there, if no case failed: else the others need not be calculated again.
"""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Iterable, Iterator
from typing import IO, NamedTuple, Self

from vstatics.errors import ReadError, of_file, plural
from vstatics.jobs.files import forget, replace
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

PARTS, OVER = "parts", "over"
"""The parts; a file that is there where their run was not stopped."""
ANEW = "remove the directory to begin anew"


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
        self.stays = False
        """Whether parts stay after a run that came to its end."""
        self._parts: dict[str, _Stretch] = {}
        """Of the run that is taken up."""
        self._added = False
        self._lock: int | None = None
        self._file: IO[bytes] | None = None

    def __enter__(self) -> Self:
        """Nothing is touched yet."""
        return self

    def __exit__(self, *error: object) -> None:
        """Let go of the parts; they stay after an error, or where that is wanted."""
        if self._file is not None:
            self._file.close()
            self._leave(is_over=error[0] is None)
        unlock(self._lock)

    def _leave(self, *, is_over: bool) -> None:
        """Remove the parts, or leave them with a mark if their run came to its end."""
        if (self._parts or self._added) and (self.stays or not is_over):
            if is_over:
                with contextlib.suppress(OSError):
                    replace(self._over, b"")
            return
        for path in (self.path, os.path.join(self.directory, LOCK)):  # noqa: PTH118
            with contextlib.suppress(OSError):
                os.unlink(path)  # noqa: PTH108
        with contextlib.suppress(OSError):
            os.rmdir(self.directory)  # noqa: PTH106

    @property
    def _over(self) -> str:
        return os.path.join(self.directory, OVER)  # noqa: PTH118

    def exists(self) -> bool:
        """Whether there is a directory of parts."""
        return os.path.isdir(self.directory)  # noqa: PTH112

    def open(self, *, resume: bool) -> str:
        """Begin, or take up what is there; why nothing is taken up, where that was asked for.

        Raises
        ------
        ReadError
            If what is there had other options, another process writes it, or it was stopped and
            nobody asked to take it up.
        OSError
            If nothing can be written.
        """
        self._lock = lock(self.directory, LOCK, "run")
        if self._lock is not None:
            forget(self.directory)  # the output itself, of a run that was killed
        if not (resume or os.path.exists(self._over)):  # noqa: PTH110
            self._refuse()
        without = self._take() if resume else NO_RUN
        with contextlib.suppress(FileNotFoundError):
            os.unlink(self._over)  # noqa: PTH108
        if without:
            self._parts.clear()
            replace(self.path, described(self.options) + b"\n")
        self._file = open(self.path, "r+b")  # noqa: PTH123, SIM115 - closed with the parts
        self._file.readline()  # what the parts depend on
        ends = [one.start + one.size for one in self._parts.values()]
        self._file.truncate(max([self._file.tell(), *ends]))  # what a run that was killed has cut
        self._file.seek(0, os.SEEK_END)
        return without if resume else ""

    def _refuse(self) -> None:
        """Keep the parts of a run that was stopped."""
        count = 0
        with contextlib.suppress(FileNotFoundError), open(self.path, "rb") as file:  # noqa: PTH123
            file.readline()
            count = len(dict(_whole_parts(file)))
        if count:
            held = f"holds {count} finished {plural('case', count)} of a run that was stopped"
            message = f"{held}; go on with --resume, or {ANEW}"
            raise ReadError([of_file("E033", self.directory, message)])

    def _take(self) -> str:
        """Learn which parts are there; why they can't be taken up."""
        try:
            with open(self.path, "rb") as file:  # noqa: PTH123
                without = why_not_taken(file.readline(), self.options, self.path, ANEW)
                if not without:
                    self._parts.update(_whole_parts(file))
        except FileNotFoundError:
            return NO_RUN
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


def _whole_parts(file: IO[bytes]) -> Iterator[tuple[str, _Stretch]]:
    """The parts that stand behind the first line, each with its case; what is cut is left out."""
    size = os.fstat(file.fileno()).st_size
    with contextlib.suppress(ValueError, TypeError):  # a disk was full; what is before it counts
        while (line := file.readline()).endswith(b"\n"):
            name, case, beside, length = json.loads(line)
            start = file.tell()
            if start + length > size:
                return
            yield name, _Stretch(CaseMark(case, beside), start, length)
            file.seek(start + length)
