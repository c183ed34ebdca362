"""Which result is held against which: of two files, or of two directories by relative paths."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Iterator, Sequence

from vstatics.comparison.verdicts import CaseVerdict, Tolerances, by_name, compared
from vstatics.errors import CaseError, Problem, ReadError, of_file, spoken
from vstatics.jobs.files import STDIN_NAME
from vstatics.readers.results import read_results
from vstatics.readers.sweep_tables import is_sweep
from vstatics.tables.suffixes import known, suffix_of
from vstatics.tables.written_results import WrittenResult

Read = Callable[[str], tuple[bytes, str]]
"""Gives what a file holds, and its name."""
SUFFIXES = known(("listing", "json", "jsonl", "csv"))
"""Of the files in a directory that are compared."""


def verdicts_of_files(
    actual: Sequence[WrittenResult],
    expected: Sequence[WrittenResult],
    names: tuple[str, str],
    how: Tolerances,
) -> list[CaseVerdict]:
    """What is said of each result of two files.

    Parameters
    ----------
    actual, expected : sequence of WrittenResult
    names : (str, str)
        Of the files.
    how : Tolerances
    """
    if max(len(actual), len(expected)) == 1:
        one, other = actual[0], expected[0]
        told = [_called(result) for result in (one, other)]
        named = [_stem(name) for name in names if name != STDIN_NAME]
        name = next(filter(None, (*told, *named)), "result")
        return [compared(name, one, other, how)]
    found, wanted = by_name(actual, expected)
    both = {**wanted, **found}
    called = {name: _called(result) for name, result in both.items()}
    seen = Counter(called.values())
    return [
        compared(
            called[name] if seen[called[name]] == 1 and called[name] else name,
            found.get(name),
            wanted.get(name),
            how,
        )
        for name in both
    ]


def _called(result: WrittenResult) -> str:
    """What a result is called: the file of its case without suffix, else its name."""
    file = "" if result.file == STDIN_NAME else result.file
    return _stem(file) or result.case_name


def _stem(file: str) -> str:
    return os.path.splitext(os.path.basename(file))[0]  # noqa: PTH119, PTH122


def verdicts_of_directories(
    actual: str, expected: str, how: Tolerances, read: Read
) -> Iterator[CaseVerdict | list[Problem]]:
    """What is said of each file of two directories, or what is wrong with it.

    Files are paired by their relative paths without suffix; a file of several results has a name
    for each, behind its own.

    Raises
    ------
    ReadError
        If there is no result in either of them.
    """
    here, there = _found(actual), _found(expected)
    if not (here or there):
        message = f"no result is there, nor in {expected}, so there is nothing to compare"
        suffixes = spoken(SUFFIXES, "or")
        raise ReadError([of_file("E050", actual, f"{message}: expected files {suffixes}")])
    for name in sorted({*here, *there}):
        try:
            found, wanted = (
                _read(side[name], read) if name in side else [] for side in (here, there)
            )
        except CaseError as error:
            yield error.problems
            continue
        if max(len(found), len(wanted)) == 1:
            yield compared(name, next(iter(found), None), next(iter(wanted), None), how)
        else:
            for part in verdicts_of_files(found, wanted, ("", ""), how):
                yield part._replace(name=f"{name}/{part.name}")


def _found(folder: str) -> dict[str, str]:
    """Files of results below a folder by their relative paths, without suffix if that tells."""
    paths = []
    for place, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".")]
        paths += [
            os.path.join(place, name)  # noqa: PTH118
            for name in names
            if suffix_of(name) in SUFFIXES and not name.startswith(".")
        ]
    relative = {path: os.path.relpath(path, folder).replace(os.sep, "/") for path in paths}
    counts = Counter(os.path.splitext(path)[0] for path in relative.values())  # noqa: PTH122
    return {
        stem if counts[stem := os.path.splitext(name)[0]] == 1 else name: path  # noqa: PTH122
        for path, name in relative.items()
    }


def _read(file: str, read: Read) -> list[WrittenResult]:
    data, name = read(file)
    if is_sweep(data):
        message = "a sweep, expected a result: compare two sweeps by their files"
        raise CaseError([of_file("E050", name, message)])
    return read_results(data, name)
