"""`compare` in Python: results, files of them, or directories of such files."""

from __future__ import annotations

import os
from collections.abc import Iterable

from vstatics.arguments import refusing
from vstatics.comparison.numbers import ATOL, RTOL
from vstatics.comparison.pairs import verdicts_of_directories, verdicts_of_files
from vstatics.comparison.verdicts import CaseVerdict, Tolerances, Verdict, verdict
from vstatics.errors import ReadError
from vstatics.readers.results import read_results
from vstatics.statics.results import Results
from vstatics.tables.names import quantity_named
from vstatics.tables.written_results import WrittenResult

Compared = str | os.PathLike[str] | Results


@refusing()
def compare(
    actual: Compared,
    expected: Compared,
    *,
    atol: float = ATOL,
    rtol: float = RTOL,
    leave_out: Iterable[str] = (),
) -> Verdict:
    """What changed in cases, and which numbers differ by that.

    Parameters
    ----------
    actual, expected : path-like or Results
        Files of `run` in any format, or two directories of them.
    atol, rtol : float
        Absolute tolerance, and that relative to the expected number.
    leave_out : iterable of str
        Tables that are not compared.

    Returns
    -------
    Verdict
        `same`, `changed`, `added` and `gone` count cases; `cases` tell of each what is other.

    Raises
    ------
    ReadError
        If a file holds no results.
    OSError
        If a file cannot be opened.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> one, other = (solve(Transmission(2, [], [Mechanism(1, 2, 0, u)], [Gear()])) for u in (3, 2))
    >>> made = compare(one, other)
    >>> made.changed, made.cases[0].case[0]
    (1, CaseChange(path='D1.ratio', expected=2.0, actual=3.0))
    """
    how = Tolerances(atol, rtol, frozenset(quantity_named(name).key for name in leave_out))
    new, old = _folder(actual), _folder(expected)
    if new and old:
        found = list(verdicts_of_directories(new, old, how, _read_file))
        problems = [problem for one in found if isinstance(one, list) for problem in one]
        if problems:
            raise ReadError(problems)
        return verdict([one for one in found if isinstance(one, CaseVerdict)])
    (here, name), (there, other) = _written(actual), _written(expected)
    return verdict(verdicts_of_files(here, there, (name, other), how))


def _folder(given: Compared) -> str:
    """The directory that is given; empty where it is something else."""
    return "" if isinstance(given, Results) or not os.path.isdir(given) else os.fspath(given)  # noqa: PTH112


def _written(given: Compared) -> tuple[list[WrittenResult], str]:
    """Results as they are written, and the name of their file."""
    if isinstance(given, Results):
        from vstatics.writers import result_json

        text = result_json.text(result_json.document(given))
        return read_results(text.encode(), given.case.name), given.case.name
    file = os.fspath(given)
    return read_results(*_read_file(file)), file


def _read_file(file: str) -> tuple[bytes, str]:
    with open(file, "rb") as opened:  # noqa: PTH123
        return opened.read(), file
