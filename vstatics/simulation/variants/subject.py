"""Scenario as the subject of a sweep: each variant is a run."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import zip_longest

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.elements.part_numbers import are_assembled
from vstatics.core.errors import CaseError, Place, Problem, ReadError
from vstatics.core.extras import require
from vstatics.core.jobs.input_files import read_file
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.simulation.bounds import Pace, wall_limit
from vstatics.simulation.record.asked import TABLES as ASKED
from vstatics.simulation.record.motion import Motion
from vstatics.simulation.run import simulate
from vstatics.simulation.scenario.file import case_bytes, read_scenario
from vstatics.simulation.variants.asked import asked_rows
from vstatics.simulation.variants.motion_names import MotionNames
from vstatics.simulation.variants.motion_tables import TABLES, MotionTables, along_time
from vstatics.simulation.variants.numbers import ScenarioNumbers, number_paths
from vstatics.sweep.chunk import INVALID, NOT_ASSEMBLED, STOPPED
from vstatics.sweep.results.documents import RunOutcome, SweptDocument
from vstatics.sweep.results.meanings import Selection
from vstatics.sweep.variants.scenario_numbers import NumberPath
from vstatics.sweep.variants.subject import Document, varied_beside_teeth
from vstatics.sweep.variants.targets import Varied, refusal


@dataclass(frozen=True)
class VariedScenario(ScenarioNumbers, SweptDocument):
    """Scenario and case as the subject of a sweep.

    Parameters
    ----------
    scenario : Document
        Scenario in YAML or JSON.
    case : Document
        Case in any format; the numbers of a deck cannot vary.
    rtol : float
        Tolerance of the runs, like `rtol` of `simulate`. [-]
    limit : float, optional
        Wall-clock time after which a run ends and its variant is `stopped`. [s]
    case_format : {"deck", "yaml", "json"}, optional
        Format of the case; by default according to its suffix, or its content.
    """

    default_columns = "heat,work"

    @property
    def file(self) -> str:
        """File name of the scenario."""
        return self.scenario.file

    @property
    def case_file(self) -> str:
        """File name of the case."""
        return self.case.file

    def limited(self, seconds: float) -> VariedScenario:
        """Return the subject with a limit on the wall-clock time of each run [s]."""
        return replace(self, limit=seconds)

    def run(
        self,
        paths: Sequence[NumberPath],
        values: Sequence[float],
        columns: Sequence[tuple[str, str]] = (),
    ) -> Motion:
        """Run a variant with replaced numbers; see `simulate` for `columns`.

        Raises
        ------
        ReadError
            If the variant cannot be read.
        CaseError
            If the run cannot start.
        """
        watch = None if self.limit is None else wall_limit(self.limit)
        scenario = self.variant(paths, values).scenario
        return simulate(scenario, rtol=self.rtol, watch=watch, columns=columns)

    def check_targets(self, targets: Sequence[Varied], places: Sequence[Place | None]) -> None:
        """Reject varied ratios that follow from teeth, since the planets also follow from them."""
        paths = number_paths(targets)
        toothed = {
            path_of_case.keys[1]
            for path_of_case in paths
            if path_of_case.of_case and path_of_case.keys[2:3] == ("teeth",)
        }
        for path, place in zip_longest(paths, places):
            if path.keys[-1] == "ratio" and self.follows_teeth(path):
                name = f"{path.keys[1]}.ratio"
                if path.keys[1] in toothed:
                    raise varied_beside_teeth(name, place)
                raise refusal(
                    f"{name} follows from teeth, and runs have their planets, too: "
                    f"expected teeth such as {path.keys[1]}.teeth.sun",
                    place,
                )

    def check_runs(self, targets: Sequence[Varied], values: Sequence[float]) -> None:
        """Check that scipy is installed and the documents allow the varied numbers."""
        require("simulation", "a sweep of a scenario")
        self.check_new(number_paths(targets), values)

    def names(self, source: Excerpt, targets: Sequence[Varied]) -> MotionNames:
        """Return the resolver of the names in an expression."""
        return MotionNames(source, self, targets)

    def unit_of(self, table: str) -> str:
        """Return the unit of a table; empty for a case that contains masses in straight motion."""
        return "" if self.base_case.masses else TABLES[table].unit

    def asked(self, selections: Iterable[Selection]) -> list[tuple[str, str]]:
        """Return the additional columns that expressions need, as pairs (table, row)."""
        asked = {
            row
            for part in selections
            if part.table in ASKED and along_time(part.table)
            for row in asked_rows(part, self.rows(ASKED[part.table].kind))
        }
        return sorted(asked)

    def outcome(
        self, targets: Sequence[Varied], values: Floats, asked: Sequence[tuple[str, str]]
    ) -> RunOutcome:
        """Run a variant, and return its status, tables and messages."""
        paths, motion, status = number_paths(targets), None, INVALID
        if np.isfinite(values).all():
            with suppress(ReadError, CaseError):
                motion = self.run(paths, values.tolist(), asked)
        if motion is not None:
            status = STOPPED if motion.stopped else 0
        unknown = status > 0
        if motion is not None and motion.case and not unknown:
            varied = {str(path.keys[1]) for path in paths if path.keys[0] == "elements"}
            status = 0 if are_assembled(motion.case, varied) else NOT_ASSEMBLED
        mechanisms = len(self.base_case.mechanisms)
        tables = MotionTables(None if unknown else motion, self.rows, mechanisms)
        return RunOutcome(status, tables, unknown, motion.messages if motion else ())

    def reason(self, targets: Sequence[Varied], values: Sequence[float]) -> list[Problem]:
        """Return the problems that deprive a variant of results; empty for a complete run."""
        try:
            motion = self.run(number_paths(targets), values)
        except (ReadError, CaseError) as error:
            return error.problems
        return [motion.stopped] if motion.stopped else []

    def seconds(self, tried: float) -> float:
        """Return the estimated processor time of a run [s]; 0 if it ends within `tried` seconds."""
        pace = Pace(self.own.scenario.duration, tried)
        with suppress(CaseError):  # other variants can start even if this run cannot
            simulate(self.own.scenario, rtol=self.rtol, watch=pace)
        return min(pace.needed, self.limit or math.inf)


@refusing()
def load_varied(
    file: str | os.PathLike[str], case: str | os.PathLike[str] | None = None
) -> VariedScenario:
    """Read a scenario and case for a sweep of numbers by `vstatics.sweep`.

    Parameters
    ----------
    file : path-like
    case : path-like, optional
        Case to use instead of the case that the scenario names.

    Returns
    -------
    VariedScenario
        Scenario and case as documents, in which numbers can be replaced.

    Raises
    ------
    ReadError
        If a document cannot be read, with every problem and its position.
    OSError
        If a file cannot be opened.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "box.yaml").write_text("{links: [wheel], inertias: {wheel: 2.0}}")
    ...     _ = Path(folder, "run.yaml").write_text(
    ...         "{case: box.yaml, duration: 2, start: {speeds: {wheel: 10}}}"
    ...     )
    ...     load_varied(f"{folder}/run.yaml").own.scenario.duration
    2.0
    """
    scenario = Document(read_file(file), os.fspath(file))
    instead = None if case is None else os.fspath(case)
    varied = VariedScenario(scenario, Document(*case_bytes(read_scenario(*scenario), instead)))
    varied.own  # noqa: B018 (faults are reported now)
    return varied
