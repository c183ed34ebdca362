"""Simulated run and name of a scenario that replaces a case on a page."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from vstatics.core.cli.shared.cases import CalculatedCase
from vstatics.core.extras import higher
from vstatics.core.jobs.files import STDIN_NAME

if TYPE_CHECKING:
    from vstatics.page.report.material import Naming
    from vstatics.pictures.runs import PicturedRun


def run_of(outcome: CalculatedCase) -> PicturedRun | None:
    """Return the simulated run of a scenario, and print its problems.

    The result is None if the document is a case.

    Raises
    ------
    ReadError
        If the run cannot begin; each problem is located at its cause.
    """
    if outcome.scenario is None:
        return None
    run: PicturedRun = higher("run_of")(outcome)
    return run


def naming_of(outcome: CalculatedCase) -> Naming:
    """Return the file name and description of a case or scenario on a page."""
    from vstatics.page.report.material import Naming

    path, read = outcome.file, outcome.scenario
    file = "" if path == STDIN_NAME else os.path.splitext(os.path.basename(path))[0]  # noqa: PTH119, PTH122
    return Naming(file) if read is None else Naming(read.name or file, read.description)
