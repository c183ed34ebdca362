"""Rows of numbers in a temporary file, for tables too large for memory."""

from __future__ import annotations

import os
import weakref
from tempfile import mkstemp
from typing import Any

import numpy as np

from vstatics.core.errors import ReadError, of_file
from vstatics.core.jobs.state_files import StateFolder
from vstatics.core.numerics.arrays import Floats

PREFIX = "vstatics-table-"


class Spool:
    """Rows of doubles in a temporary file, which a single process writes and all can read.

    The original object owns the file. It deletes the file on `close`, when it is deleted itself, or
    at the end of the process. A pickled copy can read the file on the same machine while the owner
    exists.

    Parameters
    ----------
    columns : int
        Number of values in a row.

    Raises
    ------
    ReadError
        If the file cannot be created.

    Examples
    --------
    >>> import contextlib
    >>> with contextlib.closing(Spool(2)) as spool:
    ...     spool.write(np.array([[1.0, 2.0], [3.0, 4.0]]))
    ...     spool.take(1, 2)
    array([[3., 4.]])
    """

    def __init__(self, columns: int) -> None:
        self.columns = columns
        self.rows = 0
        try:
            handle, self.path = mkstemp(prefix=PREFIX)
        except OSError as error:
            raise _unwritable("the folder for temporary files", error) from None
        os.close(handle)
        folder, self._name = os.path.split(self.path)
        self._folder = StateFolder(folder, has_results=True)
        self._remove = weakref.finalize(self, _remove, self._folder, self._name, os.getpid())

    def write(self, rows: Floats) -> None:
        """Append rows of shape (n, columns).

        Raises
        ------
        ReadError
            If the rows cannot be written; the file is removed.
        """
        try:
            with self._folder.appending(self._name) as write:
                write(np.ascontiguousarray(rows, dtype=np.float64).data.cast("B"))
        except OSError as error:
            self.close()
            raise _unwritable(self.path, error) from None
        self.rows += len(rows)

    def take(self, start: int, stop: int) -> Floats:
        """Return the rows from `start` up to `stop`, shape (stop - start, columns).

        Raises
        ------
        ReadError
            If the file is missing or cut off.
        """
        count, before = (stop - start) * self.columns, start * self.columns * 8
        try:
            with self._folder.reading(self._name) as opened:
                opened.seek(before)
                data = opened.read(count * 8)
        except OSError as error:
            raise _gone(self.path, error.strerror or str(error)) from None
        if len(data) < count * 8:
            raise _gone(self.path, "it is cut off")
        return np.frombuffer(data).reshape(stop - start, self.columns)

    def close(self) -> None:
        """Delete the file, unless the object is a copy."""
        if self._remove is not None:
            self._remove()

    def __getstate__(self) -> dict[str, Any]:
        """Return the attributes of a copy that does not own the file, for pickling."""
        return {**vars(self), "_remove": None}


def _remove(folder: StateFolder, name: str, owner: int) -> None:
    if os.getpid() == owner:
        folder.remove(name)


def _unwritable(path: str, error: OSError) -> ReadError:
    reason, advice = error.strerror or error, "make room there, or set TMPDIR to another folder"
    message = f"the temporary copy of the table cannot be written: {reason}; {advice}"
    return ReadError([of_file("E037", path, message)])


def _gone(path: str, reason: str) -> ReadError:
    message = f"the temporary copy of the table cannot be read: {reason}; start the sweep again"
    return ReadError([of_file("E038", path, message)])
