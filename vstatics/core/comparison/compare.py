"""The function `compare`, for two results, two files or two directories of results."""

from __future__ import annotations

import os
from collections.abc import Iterable

from vstatics.core.arguments import refusing
from vstatics.core.comparison.compared_files import (
    Content,
    content,
    verdicts_of_directories,
    verdicts_of_files,
)
from vstatics.core.comparison.tolerances import Tolerances, left_out, tolerance
from vstatics.core.comparison.verdicts import Verdict, verdict
from vstatics.core.jobs.input_files import TABLE_BYTES, read_file
from vstatics.core.numerics.tolerances import ATOL, RTOL
from vstatics.core.statics.results import Results

Compared = str | os.PathLike[str] | Results


@refusing()
def compare(
    actual: Compared,
    expected: Compared,
    *,
    atol: float = ATOL,
    rtol: float = RTOL,
    leave_out: str | Iterable[str] = (),
) -> Verdict:
    """Compare results with expected results: changes of the cases and differing numbers.

    Parameters
    ----------
    actual, expected : path-like or Results
        Results, two files from `run` (listing, JSON, JSON lines, CSV or Parquet), two files with
        sweeps, or two directories of such files.
    atol, rtol : float
        Absolute tolerance, in the unit of a number, and tolerance relative to the expected number.
    leave_out : str or iterable of str
        Tables that are not compared.

    Returns
    -------
    Verdict
        Counts of cases that are `same`, `changed`, `added`, `gone` or `unreadable`, and the
        differences of each case in `cases`. Messages are not compared, nor are the name,
        description and source of a case.

    Raises
    ------
    ReadError
        If a file or both directories have no results, or a table does not exist.
    OSError
        If a file cannot be opened. In a directory such a file counts as unreadable.
    ValueError
        If a tolerance is negative or not finite.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> new, old = (solve(Transmission(2, [], [Mechanism(1, 2, 0, u)], [Gear()])) for u in (3, 2))
    >>> verdict = compare(new, old)
    >>> verdict.changed, verdict.cases[0].case[0]
    (1, CaseChange(path='D1.ratio', expected=2.0, actual=3.0))
    """
    try:
        how = Tolerances(tolerance(atol), tolerance(rtol), left_out(leave_out))
    except ValueError as error:
        raise ValueError(f"tolerance of compare: {error}") from None
    new, old = _folder(actual), _folder(expected)
    if new and old:
        return verdict([*verdicts_of_directories(new, old, how)])
    (here, name), (there, other) = _written(actual), _written(expected)
    return verdict(verdicts_of_files(here, there, (name, other), how))


def _folder(given: Compared) -> str:
    return "" if isinstance(given, Results) or not os.path.isdir(given) else os.fspath(given)  # noqa: PTH112


def _written(given: Compared) -> tuple[Content, str]:
    if isinstance(given, Results):
        return content(given.to_json().encode(), given.case.name), given.case.name
    file = os.fspath(given)
    return content(read_file(file, TABLE_BYTES), file), file
