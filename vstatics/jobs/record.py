"""What a run into a directory leaves there beside the results, so that --resume can go on.

A hidden file for each format: how the cases are calculated, then a line for each result as
it is finished, with the state of its case and whether that failed (a gear is tied up). A
result counts as done if neither it nor its case has changed since.
"""

from __future__ import annotations

import json
import os
import stat
from typing import Any

import click

from vstatics.jobs import files

Options = dict[str, Any]
"""Everything besides the cases that the results depend on."""

State = list[int]
"""Of a case: another file under its name, or another content, has another one."""


def state(file: str) -> State | None:
    """The state of a case, before it is read; None if it is no file."""
    try:
        found = os.stat(file)  # noqa: PTH116
    except OSError:
        return None
    if not stat.S_ISREG(found.st_mode):
        return None
    return [found.st_ino, found.st_size, found.st_mtime_ns]


class Record:
    """The record of a run into a folder."""

    def __init__(self, folder: str, suffix: str) -> None:
        """Name the file; it is not touched yet."""
        self.path = os.path.join(folder, f".vstatics-run-{suffix[1:]}")  # noqa: PTH118
        self._done: dict[str, tuple[State, int]] = {}
        """Name of a result -> state of its case, and when it was written [ns]."""

    def begin(self, options: Options) -> None:
        """Write the record of a run that begins now.

        Raises
        ------
        OSError
            If that is not possible.
        """
        with files.replacing(self.path) as write:
            write(json.dumps(options).encode() + b"\n")

    def resume(self, options: Options) -> bool:
        """Take up the run that is recorded; whether there is one.

        Raises
        ------
        UsageError
            If that run had other options, so that its results would not go together
            with those to come.
        """
        try:
            with open(self.path, encoding="utf-8") as opened:  # noqa: PTH123
                first, *lines = opened.read().splitlines()
            before = dict(json.loads(first))
        except (OSError, ValueError, TypeError):
            return False
        if not options.keys() <= before.keys():
            return False
        differing = [key for key in options if before.get(key) != options[key]]
        if differing:
            told = "; ".join(
                f"{key} was {_said(before.get(key))}, is {_said(options[key])}" for key in differing
            )
            raise click.UsageError(
                f"the run to go on with was another one ({told}): use the same options, "
                "or calculate all cases again without --resume"
            )
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
        if case is None or case != state(file):
            return False
        try:
            return os.lstat(target).st_mtime_ns == written
        except OSError:
            return False

    def note(self, target: str, case: State | None, *, failed: bool) -> None:
        """Note a result that is in its place.

        Raises
        ------
        OSError
            If that is not possible.
        """
        if case is not None:
            written = os.stat(target).st_mtime_ns  # noqa: PTH116
            entry = [os.path.basename(target), case, written, failed]  # noqa: PTH119
            with open(self.path, "ab", buffering=0) as opened:  # noqa: PTH123
                opened.write(json.dumps(entry).encode() + b"\n")


def _said(value: object) -> str:
    return "not given" if value is None else json.dumps(value)
