"""Pairing of results for a comparison, from two files or two directories."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from vstatics.core.comparison.sweeps import sweep_counts, sweep_places
from vstatics.core.comparison.tolerances import Tolerances
from vstatics.core.comparison.verdicts import CaseVerdict, compared, largest_first, unreadable
from vstatics.core.errors import CaseError, Problem, ReadError, of_file, spoken
from vstatics.core.jobs.files import STDIN_NAME
from vstatics.core.jobs.input_files import TABLE_BYTES, read_file
from vstatics.core.jobs.input_files import unreadable as unreadable_file
from vstatics.core.readers import sweep_tables
from vstatics.core.readers.result_rows import is_parquet, no_result
from vstatics.core.readers.results import TAKEN, read_results
from vstatics.core.tables.file_suffixes import known, suffix_of
from vstatics.core.tables.written_results import WrittenResult, WrittenSweep

Content = list[WrittenResult] | WrittenSweep
"""Content of a file: results or a sweep."""
SUFFIXES = known(("listing", "json", "jsonl", "csv", "parquet", "npz"))
"""Suffixes of files that are compared if they are in a directory."""
SEPARATORS = re.compile(r"[/\\]")
"""Pattern of the separator of folders, for paths of any operating system."""


def content(data: bytes, file: str) -> Content:
    """Read the results or the sweep of a file.

    Raises
    ------
    ReadError
        If the file contains neither results nor a sweep.
    """
    if sweep_tables.is_workbook(data):
        try:
            return sweep_tables.read(data, file)
        except ReadError:
            raise no_result(f"a workbook; {TAKEN}", file) from None
    if sweep_tables.is_sweep(data) and not is_parquet(data):
        return sweep_tables.read(data, file)
    return read_results(data, file)


def verdicts_of_files(
    actual: Content, expected: Content, names: tuple[str, str], how: Tolerances
) -> list[CaseVerdict]:
    """Return the verdicts on the results or the sweeps of two files.

    Parameters
    ----------
    actual, expected : list of WrittenResult, or WrittenSweep
        Contents of both files, either results or sweeps. An empty list means a missing file.
    names : (str, str)
        Names of the files.
    how : Tolerances

    Raises
    ------
    ReadError
        If only one of the contents is a sweep.
    """
    of_file_names = [file_stem(name) for name in names if name != STDIN_NAME]
    if isinstance(actual, WrittenSweep) or isinstance(expected, WrittenSweep):
        name = next(filter(None, of_file_names), "sweep")
        return [_sweeps_compared(name, actual, expected, names, how)]
    if max(len(actual), len(expected)) == 1:
        new, old = (next(iter(side), None) for side in (actual, expected))
        names_of_cases = [_called(result) for result in (new, old) if result]
        name = next(filter(None, (*names_of_cases, *of_file_names)), "result")
        return [compared(name, new, old, how)]
    here, there = _paired(actual, expected)
    called = {key: _called(result, key[0]) for key, result in {**there, **here}.items()}
    seen = Counter((short, time) for (_, time), short in called.items())
    return [
        compared(
            _counted(short if short and seen[short, time] == 1 else path, time),
            here.get((path, time)),
            there.get((path, time)),
            how,
        )
        for (path, time), short in called.items()
    ]


def sweep_alone(actual: Content, expected: Content, names: tuple[str, str]) -> str:
    """Return a message if only one of the files is a sweep, else an empty text."""
    sweeps = [isinstance(file, WrittenSweep) for file in (actual, expected)]
    if sweeps[0] == sweeps[1]:
        return ""
    sweep, other = names if sweeps[0] else names[::-1]
    return f"{sweep} is a sweep, {other} is not: expected two sweeps or two results"


def _sweeps_compared(
    name: str, actual: Content, expected: Content, names: tuple[str, str], how: Tolerances
) -> CaseVerdict:
    if not (actual and expected):
        return CaseVerdict(name, "added" if actual else "gone", differs=True)
    if not (isinstance(actual, WrittenSweep) and isinstance(expected, WrittenSweep)):
        raise ReadError([of_file("E050", names[0], sweep_alone(actual, expected, names))])
    differences = largest_first(sweep_places(actual, expected, **how._asdict()))
    counts = sweep_counts(actual, expected, how.leave_out)
    return CaseVerdict(
        name, "changed" if differences else "same", None, differences, counts, bool(differences)
    )


def _called(result: WrittenResult, path: str = "") -> str:
    """Return the name of a result: the file name without suffix, or the name of the case.

    Parameters
    ----------
    result : WrittenResult
    path : str
        Path of the file, with as many folders as distinguish it from other files.
    """
    file = "" if result.file == STDIN_NAME else result.file
    if file and SEPARATORS.search(path) and file.endswith(path):
        return os.path.splitext(path)[0]  # noqa: PTH122
    return file_stem(file) or result.case_name


def file_stem(file: str) -> str:
    """Return the name of a file without folders and suffix, for paths of any operating system."""
    return os.path.splitext(SEPARATORS.split(file)[-1])[0]  # noqa: PTH122


_Key = tuple[str, int]
"""Key of a result: name of the file or case, and number among results of this name (from 1)."""


def _counted(name: str, time: int) -> str:
    """Return the name of a result, with its number if an earlier result has the same name.

    >>> _counted("box", 1), _counted("box", 2), _counted("box", 3)
    ('box', 'box (there twice)', 'box (there 3 times)')
    """
    if time == 1:
        return name
    return f"{name} (there {'twice' if time == 2 else f'{time} times'})"


def _paired(
    actual: Sequence[WrittenResult], expected: Sequence[WrittenResult]
) -> list[dict[_Key, WrittenResult]]:
    """Return the actual and the expected results by the names of files or of cases.

    Files or cases are chosen, whichever have more different names. Names of files contain as few
    folders as possible, because folders of actual and expected files can differ.
    """
    sides = actual, expected
    paths = [[SEPARATORS.split(result.file) for result in side] for side in sides]
    ways = [
        [["/".join(path[-depth:]) for path in side] for side in paths]
        for depth in range(1, max(len(path) for side in paths for path in side) + 1)
    ]
    ways.append([[result.case_name for result in side] for side in sides])
    complete = [pair for pair in ways if all(map(all, pair))]
    best = max(complete, key=lambda pair: sum(len(set(side)) for side in pair), default=None)
    keys = best or [[f"result {n}" for n, _ in enumerate(side, 1)] for side in sides]
    return [
        dict(zip(_numbered(names), side, strict=True))
        for names, side in zip(keys, sides, strict=True)
    ]


def _numbered(names: Iterable[str]) -> Iterator[_Key]:
    times = Counter[str]()
    for name in names:
        times[name] += 1
        yield name, times[name]


def verdicts_of_directories(actual: str, expected: str, how: Tolerances) -> Iterator[CaseVerdict]:
    """Yield the verdicts on the files of two directories, including unreadable files.

    Files are paired by relative path without suffix. If a file contains several results, their
    names consist of file and case.

    Raises
    ------
    ReadError
        If neither directory has a result.
    """
    here, there = _result_files(actual), _result_files(expected)
    if not (here or there):
        message = (
            f"contains no result, and {expected} contains none, so there is nothing to compare"
        )
        suffixes = spoken(SUFFIXES, "or")
        raise ReadError([of_file("E050", actual, f"{message}: expected files {suffixes}")])
    for name in sorted({*here, *there}):
        paths = [side.get(name, "") for side in (here, there)]
        yield from _verdicts_of_pair(name, paths, how)


def _verdicts_of_pair(name: str, paths: Sequence[str], how: Tolerances) -> Iterator[CaseVerdict]:
    contents, problems = list[Content](), list[Problem]()
    for path in paths:
        try:
            data = read_file(path, TABLE_BYTES, regular=True) if path else b""
            contents.append(content(data, path) if path else [])
        except CaseError as error:
            problems += error.problems
        except OSError as error:
            problems.append(unreadable_file(path, error))
    if problems:
        yield unreadable(name, problems)
        return
    try:
        parts = verdicts_of_files(contents[0], contents[1], (paths[0], paths[1]), how)
    except ReadError as error:  # only one of the files is a sweep
        yield unreadable(name, error.problems)
        return
    for part in parts:
        yield part._replace(name=f"{name}/{part.name}" if len(parts) > 1 else name)


def _result_files(folder: str) -> dict[str, str]:
    """Return the files of results in a folder by relative path, without suffix if unique."""
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
