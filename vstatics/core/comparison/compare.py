"""`compare` in Python: results, files of them, or directories of such files."""

from __future__ import annotations

import os
from collections.abc import Iterable

from vstatics.core.arguments import refusing
from vstatics.core.comparison.pairs import (
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
    """What changed in cases, and which numbers differ by that.

    Parameters
    ----------
    actual, expected : path-like or Results
        Files of `run`: listing, JSON, JSON lines, CSV, Parquet; two sweeps; or two directories
        of such files.
    atol, rtol : float
        Absolute tolerance, and that relative to the expected number.
    leave_out : str or iterable of str
        Tables that are not compared.

    Returns
    -------
    Verdict
        `same`, `changed`, `added`, `gone` and `unreadable` count cases; `cases` tell of each what
        is other. Messages are not compared, nor the name, description and source of a case.

    Raises
    ------
    ReadError
        If a file holds no results, of two directories neither of them, or a table is none.
    OSError
        If a file cannot be opened; in a directory it is one that is unreadable.
    ValueError
        If a tolerance is below 0 or not finite.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> one, other = (solve(Transmission(2, [], [Mechanism(1, 2, 0, u)], [Gear()])) for u in (3, 2))
    >>> made = compare(one, other)
    >>> made.changed, made.cases[0].case[0]
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
    """The directory that is given; empty where it is something else."""
    return "" if isinstance(given, Results) or not os.path.isdir(given) else os.fspath(given)  # noqa: PTH112


def _written(given: Compared) -> tuple[Content, str]:
    """Results as they are written, and the name of their file."""
    if isinstance(given, Results):
        return content(given.to_json().encode(), given.case.name), given.case.name
    file = os.fspath(given)
    return content(read_file(file, TABLE_BYTES), file), file
