"""Saving of the page of a case to a file."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from vstatics.core.annexes import module_of_name
from vstatics.core.arguments import refusing
from vstatics.core.jobs.files import replacing
from vstatics.core.statics.results import Results, expect_one_case
from vstatics.page.report.html_page import page
from vstatics.page.report.material import gather

if TYPE_CHECKING:
    from vstatics.pictures.runs import PicturedRun as Motion


@refusing(Motion=module_of_name("Motion"))
def write_report(
    results: Results, path: str | os.PathLike[str], *, motion: Motion | None = None
) -> None:
    """Write a case and its results as an HTML page, completely or not at all.

    Parameters
    ----------
    results : Results
        Results of a single case.
    path : path-like
        File to write; an existing file is replaced.
    motion : Motion, optional
        Simulated run of the case, shown in a section.

    Raises
    ------
    ValueError
        If the suffix of the file is not ``.html`` or ``.htm``.
    OSError
        If the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> results = solve(Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear(name="drive")]))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_report(results, Path(folder, "pair.html"))
    ...     "drive" in Path(folder, "pair.html").read_text(encoding="utf-8")
    True
    """
    expect_one_case(results, "write_report")
    suffix = os.path.splitext(os.fspath(path))[1]  # noqa: PTH122
    if suffix.lower() not in ("", ".html", ".htm"):
        raise ValueError(f"a report as {os.fspath(path)}: the page is HTML, expected .html")
    with replacing(os.fspath(path)) as write:
        write(page(gather(results, motion=motion)).encode(errors="backslashreplace"))
