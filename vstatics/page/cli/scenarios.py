"""The scenario that names a case, on its page."""

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
    """Return the run of a scenario, with enough instants for pictures; its problems are printed.

    Raises
    ------
    ReadError
        If it can't begin, with the places of the reasons.
    """
    if outcome.scenario is None:
        return None
    run: PicturedRun = higher("run_of")(outcome)
    return run


def naming_of(outcome: CalculatedCase) -> Naming:
    """Return the name of the file, for a case without a name, and what happens in a scenario."""
    from vstatics.page.report.material import Naming

    path, read = outcome.file, outcome.scenario
    file = "" if path == STDIN_NAME else os.path.splitext(os.path.basename(path))[0]  # noqa: PTH119, PTH122
    return Naming(file) if read is None else Naming(read.name or file, read.description)
