"""Parts of a single output of many cases, which a resumed run reuses.

While a run writes a file, a directory next to it contains a file with the parts of finished cases.
The first line identifies the options and the build of this package. Each part follows a line with
the hashes of the case, of the files that the case names, and of the part. Every line begins with
its own hash, and damaged lines are ignored. The directory is removed when the output is complete.
If a case failed, the directory stays, so that a resumed run calculates only the failed cases.
"""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Iterator
from typing import IO, NamedTuple, Self

from vstatics.core.errors import ReadError, of_file, plural
from vstatics.core.jobs.files import hash_of, write_all
from vstatics.core.jobs.finished_cases import (
    NO_RUN,
    CaseMark,
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
"""Names of the file with the parts, and of an empty file that marks a completed run."""
ANEW = "remove the directory to begin anew"


class _Stretch(NamedTuple):
    """Position of a part in the file with the parts."""

    mark: CaseMark
    start: int
    size: int


class FinishedParts:
    """Parts of an output that a single process writes, one part for each case.

    Parameters
    ----------
    output : str
        Final file.
    options : dict
        Options on which the parts depend, in addition to the cases.
    """

    def __init__(self, output: str, options: Description) -> None:
        self.output = output
        self.directory = os.path.realpath(output) + SUFFIX
        self.folder = StateFolder(self.directory)
        self.path = self.folder.file(PARTS)
        self.options = options
        self.stays = False
        """True if parts stay after a completed run, because a case failed."""
        self._parts: dict[str, _Stretch] = {}
        """Positions of the parts of the earlier run, by file name of the case."""
        self._added = False
        self._lock: int | None = None
        self._file: int | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        """Release the lock. Remove the parts, unless an error occurred or they are still needed."""
        if self._file is not None:
            with contextlib.suppress(OSError):  # a lost part is calculated again
                os.close(self._file)
            self._leave(is_over=error[0] is None)
        elif self._lock is not None:
            self._remove()
        unlock(self._lock)

    def _leave(self, *, is_over: bool) -> None:
        if (self._parts or self._added) and (self.stays or not is_over):
            if is_over:
                with contextlib.suppress(OSError):
                    self.folder.replace(OVER, b"")
            return
        self.folder.remove(PARTS)
        self._remove()

    def _remove(self) -> None:
        self.folder.remove(LOCK)
        self.folder.drop()

    @property
    def count(self) -> int:
        """Number of parts taken from the earlier run."""
        return len(self._parts)

    def exists(self) -> bool:
        """Return whether the directory of parts, or a file with this name, exists."""
        return self.folder.exists()

    def open(self, *, resume: bool) -> str:
        """Begin or resume a run; return "", or the reason why the run cannot be resumed.

        Raises
        ------
        ReadError
            If an earlier run had other options, is still active, or was stopped and `resume` is
            not set.
        OSError
            If the directory cannot be written to.
        """
        self.folder.make()
        self.folder.check()
        self._lock = lock(self.folder, LOCK, "run")
        if self._lock is not None:
            self.folder.forget()  # remove the unfinished output of a killed run
        if not (resume or OVER in self.folder.names()):
            self._refuse()
        why_not = self._take() if resume else NO_RUN
        self.folder.remove(OVER)
        first = described(self.options) + b"\n"
        if why_not:
            self.folder.replace(PARTS, first)
        self._file = self.folder.open(PARTS, os.O_RDWR)
        end = max([len(first), *(part.start + part.size for part in self._parts.values())])
        os.ftruncate(self._file, end)  # remove an incomplete part of a killed run
        os.lseek(self._file, end, os.SEEK_SET)
        return why_not if resume else ""

    def _refuse(self) -> None:
        """Raise an error if the run would overwrite parts of a stopped run."""
        count = 0
        with contextlib.suppress(FileNotFoundError), self.folder.reading(PARTS) as file:
            file.readline()
            count = len(dict(_whole_parts(file)))
        if count:
            held = f"holds {count} finished {plural('case', count)} of a run that was stopped"
            message = f"{held}; continue with --resume, or {ANEW}"
            raise ReadError([of_file("E033", self.directory, message)])

    def _take(self) -> str:
        """Load the existing parts; return "", or the reason why the run cannot be resumed."""
        try:
            with self.folder.reading(PARTS) as file:
                why_not = why_not_taken(file.readline(), self.options, self.path, ANEW)
                if not why_not:
                    self._parts.update(_whole_parts(file))
        except FileNotFoundError:
            return NO_RUN
        return why_not

    def is_done(self, file: str) -> bool:
        """Return whether a part exists for the present content of a case."""
        part = self._parts.get(file)
        return part is not None and part.mark.is_of(file)

    def part(self, file: str) -> bytes:
        """Return the part of a case."""
        assert self._file is not None  # noqa: S101 - it was opened
        stretch = self._parts[file]
        return os.pread(self._file, stretch.size, stretch.start)

    def put(self, file: str, mark: CaseMark, part: bytes) -> None:
        """Store the part of a case.

        Raises
        ------
        OSError
            If the part cannot be written.
        """
        assert self._file is not None  # noqa: S101 - it was opened
        entry = [file, *mark, len(part), hash_of(part)]
        write_all(self._file, sealed(json.dumps(entry).encode()) + part)
        # A flag is enough, because a resumed run reads new parts from the file, not from `_parts`.
        self._added = True


def _whole_parts(file: IO[bytes]) -> Iterator[tuple[str, _Stretch]]:
    """Yield the undamaged parts after the first line, with the file names of the cases.

    Reading ends at a damaged line, because the start of the next part is then unknown.
    """
    while (text := unsealed(file.readline()[:-1])) is not None:
        name, case, named_files, length, known = json.loads(text)
        start = file.tell()
        if hash_of(file.read(length)) == known:
            yield name, _Stretch(CaseMark(case, named_files), start, length)
