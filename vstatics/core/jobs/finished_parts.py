"""Parts of one output of many cases that a resumed run trusts.

While a run writes one file, a directory beside it holds the parts of cases that are finished: a
line for what they depend on (options and the build of this package), then for each part a line,
with the hashes of the case that was read, of the files that it names and of the part, and the part
itself. Each of these lines begins with its own hash, and whatever is damaged does not count. The
directory goes when the output is there, if no case failed: else the others need not be calculated
again.
"""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Iterable, Iterator
from typing import IO, NamedTuple, Self

from vstatics.core.errors import ReadError, of_file, plural
from vstatics.core.jobs.files import hash_of, hash_of_file, write_all
from vstatics.core.jobs.finished_cases import (
    NO_RUN,
    Description,
    described,
    sealed,
    unsealed,
    why_not_taken,
)
from vstatics.core.jobs.finished_pieces import LOCK, SUFFIX
from vstatics.core.jobs.lock import lock, unlock
from vstatics.core.jobs.state_files import StateFolder

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
    """Place of a part in the file of parts."""

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
        self.folder = StateFolder(self.directory)
        self.path = self.folder.file(PARTS)
        self.options = options
        self.stays = False
        """Whether parts stay after a run that came to its end."""
        self._parts: dict[str, _Stretch] = {}
        """Of the run that is taken up."""
        self._added = False
        self._lock: int | None = None
        self._file: int | None = None

    def __enter__(self) -> Self:
        """Nothing is touched yet."""
        return self

    def __exit__(self, *error: object) -> None:
        """Let go of the parts; they stay after an error, or where that is wanted."""
        if self._file is not None:
            with contextlib.suppress(OSError):  # a part that is not there is calculated again
                os.close(self._file)
            self._leave(is_over=error[0] is None)
        elif self._lock is not None:
            self._remove()
        unlock(self._lock)

    def _leave(self, *, is_over: bool) -> None:
        """Remove the parts, or leave them with a mark if their run came to its end."""
        if (self._parts or self._added) and (self.stays or not is_over):
            if is_over:
                with contextlib.suppress(OSError):
                    self.folder.replace(OVER, b"")
            return
        self.folder.remove(PARTS)
        self._remove()

    def _remove(self) -> None:
        """Remove the directory, unless it holds parts."""
        self.folder.remove(LOCK)
        self.folder.drop()

    @property
    def count(self) -> int:
        """Number of parts of the run that is taken up."""
        return len(self._parts)

    def exists(self) -> bool:
        """Return whether anything has the name of the directory of parts."""
        return self.folder.exists()

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
        self.folder.make()
        self.folder.check()
        self._lock = lock(self.folder, LOCK, "run")
        if self._lock is not None:
            self.folder.forget()  # the output itself, of a run that was killed
        if not (resume or OVER in self.folder.names()):
            self._refuse()
        without = self._take() if resume else NO_RUN
        self.folder.remove(OVER)
        first = described(self.options) + b"\n"
        if without:
            self.folder.replace(PARTS, first)
        self._file = self.folder.open(PARTS, os.O_RDWR)
        end = max([len(first), *(part.start + part.size for part in self._parts.values())])
        os.ftruncate(self._file, end)  # what a run that was killed has cut
        os.lseek(self._file, end, os.SEEK_SET)
        return without if resume else ""

    def _refuse(self) -> None:
        """Keep the parts of a run that was stopped."""
        count = 0
        with contextlib.suppress(FileNotFoundError), self.folder.reading(PARTS) as file:
            file.readline()
            count = len(dict(_whole_parts(file)))
        if count:
            held = f"holds {count} finished {plural('case', count)} of a run that was stopped"
            message = f"{held}; go on with --resume, or {ANEW}"
            raise ReadError([of_file("E033", self.directory, message)])

    def _take(self) -> str:
        """Learn which parts are there; why they can't be taken up."""
        try:
            with self.folder.reading(PARTS) as file:
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
        assert self._file is not None  # noqa: S101 - it was opened
        stretch = self._parts[file]
        return os.pread(self._file, stretch.size, stretch.start)

    def put(self, file: str, mark: CaseMark, part: bytes) -> None:
        """Keep the part of a case.

        Raises
        ------
        OSError
            If that is not possible.
        """
        assert self._file is not None  # noqa: S101 - it was opened
        entry = [file, mark.case, mark.beside, len(part), hash_of(part)]
        write_all(self._file, sealed(json.dumps(entry).encode()) + part)
        self._added = True  # what is new is in memory no longer than it takes to write it


def _whole_parts(file: IO[bytes]) -> Iterator[tuple[str, _Stretch]]:
    """Give the parts behind the first line, each with its case, without damaged parts.

    A line that is cut or damaged ends them: nobody knows where the next one begins.
    """
    while (text := unsealed(file.readline()[:-1])) is not None:
        name, case, beside, length, known = json.loads(text)
        start = file.tell()
        if hash_of(file.read(length)) == known:
            yield name, _Stretch(CaseMark(case, beside), start, length)
