"""What a run into a directory leaves there beside the results, so that --resume can go on.

A hidden file for each format: how the cases are calculated, when that began, of which case
each result is, and which results belong to cases that failed (a gear is tied up). A result
counts as done if it is of the same case, and younger than that and than this beginning.
"""

from __future__ import annotations

import json
import os
import stat
from collections.abc import Iterable
from typing import Any

import click

from vstatics.cli import files
from vstatics.cli.targets import Task

Options = dict[str, Any]
"""Everything besides the cases that the results depend on."""


class Record:
    """The record of a run into a folder."""

    def __init__(self, folder: str, suffix: str) -> None:
        """Name the file; it is not touched yet."""
        self.path = os.path.join(folder, f".vstatics-run-{suffix[1:]}")  # noqa: PTH118
        self.began = 0
        """Time of the file system. [ns]"""
        self.failed: set[str] = set()
        self.cases: dict[str, str] = {}
        """Name of a result -> path of its case."""

    def begin(self, options: Options, tasks: Iterable[Task]) -> None:
        """Write the record of a run that begins now.

        Raises
        ------
        OSError
            If that is not possible.
        """
        with files.replacing(self.path) as write:
            write(b"")
        self.began = os.stat(self.path).st_mtime_ns  # noqa: PTH116
        self.write(options, tasks)

    def write(self, options: Options, tasks: Iterable[Task]) -> None:
        """Write the record of a run with these cases, those before among them.

        Raises
        ------
        OSError
            If that is not possible.
        """
        self.cases |= {_name(str(task.target)): _path(task.file) for task in tasks}
        text = json.dumps({**options, "began": self.began, "cases": self.cases})
        with files.replacing(self.path) as write:
            lines = [text, *sorted(self.failed), ""]
            write("\n".join(lines).encode(errors="surrogateescape"))

    def resume(self, options: Options) -> bool:
        """Take up the run that is recorded; whether there is one.

        Raises
        ------
        UsageError
            If that run had other options, so that its results would not go together
            with those to come.
        """
        try:
            with open(self.path, encoding="utf-8", errors="surrogateescape") as opened:  # noqa: PTH123
                first, *failed = opened.read().split("\n")
            before = dict(json.loads(first))
            self.began, self.cases = int(before["began"]), dict(before["cases"])
        except (OSError, ValueError, KeyError, TypeError):
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
        self.failed = set(filter(None, failed))
        return True

    def is_done(self, file: str, target: str) -> bool:
        """Whether there is a result of this case and run that is younger than the case.

        A case may have been replaced by an older file: then its entry is young.
        """
        name = _name(target)
        if name in self.failed or self.cases.get(name) != _path(file):
            return False
        try:
            result, case = os.stat(target), os.stat(file)  # noqa: PTH116
        except OSError:
            return False
        changed = max(case.st_mtime_ns, case.st_ctime_ns)
        young = result.st_mtime_ns >= self.began and result.st_mtime_ns > changed
        return young and stat.S_ISREG(result.st_mode) and stat.S_ISREG(case.st_mode)

    def note_failure(self, target: str) -> None:
        """Note that a result belongs to a case that failed, to be tried again.

        Raises
        ------
        OSError
            If that is not possible.
        """
        name = _name(target)
        if name not in self.failed:
            self.failed.add(name)
            with open(self.path, "a", encoding="utf-8", errors="surrogateescape") as opened:  # noqa: PTH123
                opened.write(name + "\n")


def _name(target: str) -> str:
    return os.path.basename(target)  # noqa: PTH119


def _path(file: str) -> str:
    return os.path.abspath(file)  # noqa: PTH100


def _said(value: object) -> str:
    return "not given" if value is None else json.dumps(value)
