"""Result file of each case of a run, with checks for conflicts."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import lru_cache, partial
from typing import NamedTuple

import click

from vstatics.core.cli.shared import files
from vstatics.core.tables.file_suffixes import known

STDIN_STEM = "stdin"
MOST_TOLD = 5
"""Largest number of conflicts in a message."""
TABULAR = known(("listing", "text", "json", "csv"))


class CaseTask(NamedTuple):
    """Case with its result file; None if results are written to a stream."""

    file: str
    target: str | None = None


def tasks(
    cases: Sequence[str], folder: str, suffix: str, others: Sequence[str] = ()
) -> list[CaseTask]:
    """Return each case with its result file in `folder`, which has the name of the case.

    Parameters
    ----------
    others : sequence of str
        Further files that must not be overwritten.

    Raises
    ------
    UsageError
        If a case is named twice, two results have the same name, or a result would overwrite a
        case. The message lists all such pairs.

    Examples
    --------
    >>> [task.target for task in tasks(["a/x.dat", "y.v2.yaml"], "results", ".json")]
    ['results/x.json', 'results/y.v2.json']
    """
    planned = [CaseTask(file, os.path.join(folder, _stem(file) + suffix)) for file in cases]  # noqa: PTH118
    real = partial(_real_path, lru_cache(maxsize=None)(os.path.realpath))
    refused = []
    inputs: dict[str, CaseTask] = {}
    for task in planned:
        before = inputs.setdefault(real(task.file), task)
        if before is not task:
            same = f" (the same file as {before.file})" if before.file != task.file else ""
            refused.append(f"{task.file} is named twice{same}")
    results: dict[str, str] = {}
    for file, target in inputs.values():
        place = real(str(target))
        before_file = results.setdefault(place, file)
        if before_file is not file:
            refused.append(f"{before_file} and {file} would both give {target}")
        if place in inputs:
            refused.append(f"the result of {file} would overwrite the case {inputs[place].file}")
    refused += [
        f"the result of {results[real(other)]} would overwrite {other}"
        for other in others
        if real(other) in results
    ]
    if refused:
        lines = [*refused[:MOST_TOLD]]
        if more := len(refused) - len(lines):
            lines.append(f"... and {more} more")
        if len(results) < len(inputs):
            to_one_file = "write all to one file, -o all.jsonl, where they keep their folders, or "
            lines.append(
                "cases with the same name need different folders: "
                f"{to_one_file * (suffix in TABULAR)}each folder to a directory of its own"
            )
        raise click.UsageError("nothing was calculated:\n  " + "\n  ".join(lines))
    return planned


def _stem(file: str) -> str:
    if file == files.STDIN:
        return STDIN_STEM
    return os.path.splitext(os.path.basename(file))[0]  # noqa: PTH119, PTH122


def _real_path(real_folder: Callable[[str], str], file: str) -> str:
    if file == files.STDIN:
        return file
    folder, name = os.path.split(file)
    if os.path.islink(file) or name in ("", ".", ".."):  # noqa: PTH114
        return os.path.realpath(file)
    return os.path.join(real_folder(folder), name)  # noqa: PTH118
