"""Which result is held against which: of two files, or of two directories by relative paths."""

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
from vstatics.core.tables.suffixes import known, suffix_of
from vstatics.core.tables.written_results import WrittenResult, WrittenSweep

Content = list[WrittenResult] | WrittenSweep
"""Of a file that is compared."""
SUFFIXES = known(("listing", "json", "jsonl", "csv", "parquet", "npz"))
"""Of the files in a directory that are compared."""
SEPARATORS = re.compile(r"[/\\]")
"""Of folders, wherever a result was written."""


def content(data: bytes, file: str) -> Content:
    """The results of a file, or the sweep.

    Raises
    ------
    ReadError
        If it holds neither.
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
    """What is said of each result of two files, or of the sweeps in them.

    Parameters
    ----------
    actual, expected : list of WrittenResult, or WrittenSweep
        Two of a kind; an empty list is a file that is not there.
    names : (str, str)
        Of the files.
    how : Tolerances

    Raises
    ------
    ReadError
        If one is a sweep, the other is not.
    """
    of_file_names = [file_stem(name) for name in names if name != STDIN_NAME]
    if isinstance(actual, WrittenSweep) or isinstance(expected, WrittenSweep):
        name = next(filter(None, of_file_names), "sweep")
        return [_sweeps_compared(name, actual, expected, names, how)]
    if max(len(actual), len(expected)) == 1:
        one, other = (next(iter(side), None) for side in (actual, expected))
        told = [_called(result) for result in (one, other) if result]
        name = next(filter(None, (*told, *of_file_names)), "result")
        return [compared(name, one, other, how)]
    found, wanted = _paired(actual, expected)
    called = {key: _called(result, key[0]) for key, result in {**wanted, **found}.items()}
    seen = Counter((short, time) for (_, time), short in called.items())
    return [
        compared(
            _counted(short if short and seen[short, time] == 1 else way, time),
            found.get((way, time)),
            wanted.get((way, time)),
            how,
        )
        for (way, time), short in called.items()
    ]


def sweep_alone(actual: Content, expected: Content, names: tuple[str, str]) -> str:
    """What is said where one is a sweep, the other is not; else nothing."""
    sweeps = [isinstance(one, WrittenSweep) for one in (actual, expected)]
    if sweeps[0] == sweeps[1]:
        return ""
    one, other = names if sweeps[0] else names[::-1]
    return f"{one} is a sweep, {other} is not: expected two of a kind"


def _sweeps_compared(
    name: str, actual: Content, expected: Content, names: tuple[str, str], how: Tolerances
) -> CaseVerdict:
    if not (actual and expected):
        return CaseVerdict(name, "added" if actual else "gone", differs=True)
    if not (isinstance(actual, WrittenSweep) and isinstance(expected, WrittenSweep)):
        raise ReadError([of_file("E050", names[0], sweep_alone(actual, expected, names))])
    found = largest_first(sweep_places(actual, expected, **how._asdict()))
    counts = sweep_counts(actual, expected, how.leave_out)
    return CaseVerdict(name, "changed" if found else "same", None, found, counts, bool(found))


def _called(result: WrittenResult, way: str = "") -> str:
    """What a result is called: the file of its case without suffix, else its name.

    Parameters
    ----------
    way : str
        That file with the folders that tell it apart, where these do.
    """
    file = "" if result.file == STDIN_NAME else result.file
    if file and SEPARATORS.search(way) and file.endswith(way):
        return os.path.splitext(way)[0]  # noqa: PTH122
    return file_stem(file) or result.case_name


def file_stem(file: str) -> str:
    """The name of a file without folders and suffix, also of another system."""
    return os.path.splitext(SEPARATORS.split(file)[-1])[0]  # noqa: PTH122


_Key = tuple[str, int]
"""What tells a result from the others: file or name of its case, and which time it is there."""


def _counted(name: str, time: int) -> str:
    """The name of a result that may be there again.

    >>> _counted("box", 1), _counted("box", 2), _counted("box", 3)
    ('box', 'box (there twice)', 'box (there 3 times)')
    """
    if time == 1:
        return name
    return f"{name} (there {'twice' if time == 2 else f'{time} times'})"


def _paired(
    actual: Sequence[WrittenResult], expected: Sequence[WrittenResult]
) -> list[dict[_Key, WrittenResult]]:
    """Both by what tells most results of each apart; those of one name in their order.

    Of its folders a file has so many as it takes, as the same cases may have been named from
    another place.
    """
    ways = [pair for pair in _names(actual, expected) if all(map(all, pair))]
    best = max(ways, key=lambda pair: sum(len(set(side)) for side in pair), default=None)
    keys = best or [[f"result {n}" for n, _ in enumerate(s, 1)] for s in (actual, expected)]
    return [
        dict(zip(_numbered(names), side, strict=True))
        for names, side in zip(keys, (actual, expected), strict=True)
    ]


def _numbered(names: Iterable[str]) -> Iterator[_Key]:
    """Each name with the number of times it has been there."""
    times = Counter[str]()
    for name in names:
        times[name] += 1
        yield name, times[name]


def _names(*sides: Sequence[WrittenResult]) -> Iterator[list[list[str]]]:
    ways = [[SEPARATORS.split(one.file) for one in side] for side in sides]
    for depth in range(1, max(len(way) for side in ways for way in side) + 1):
        yield [["/".join(way[-depth:]) for way in side] for side in ways]
    yield [[one.case_name for one in side] for side in sides]


def verdicts_of_directories(actual: str, expected: str, how: Tolerances) -> Iterator[CaseVerdict]:
    """What is said of each file of two directories, also of one that can't be read.

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
    except ReadError as error:  # one is a sweep
        yield unreadable(name, error.problems)
        return
    for part in parts:
        yield part._replace(name=f"{name}/{part.name}" if len(parts) > 1 else name)


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
