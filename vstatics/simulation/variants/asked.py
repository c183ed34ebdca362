"""Additional columns of a single run, read from the text of the option --out.

>>> from vstatics.core.model.transmission import Transmission
>>> from vstatics.simulation.scenario.parts import Scenario
>>> case = Transmission(2, [], [], [], inertias={1: 1.0, 2: 1.0}, link_names=["in", "out"])
>>> read_asked("jerks[out], accelerations", Scenario(case, 1.0))
[('jerks', 'out'), ('accelerations', 'in'), ('accelerations', 'out')]
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from vstatics.core.errors import Problem, ReadError, listed, quoted
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import parse
from vstatics.core.readers.expressions.operands import TableName
from vstatics.core.suggestions import nearest
from vstatics.simulation.record.asked import ALWAYS, TABLES
from vstatics.simulation.record.row_names import rows_of_kind
from vstatics.simulation.scenario.parts import Scenario
from vstatics.simulation.variants.motion_names import LANGUAGE, RunNames
from vstatics.sweep.results.columns import OPTION, items
from vstatics.sweep.results.meanings import Selection

_LANGUAGE = LANGUAGE._replace(operands="a column such as accelerations[out]", example="jerks")


def read_asked(text: str, scenario: Scenario) -> list[tuple[str, str]]:
    """Read a list of tables and rows such as ``accelerations[out], heat[C]``.

    Raises
    ------
    ReadError
        If a table or row is unknown, with every problem and its position.
    """
    asked: list[tuple[str, str]] = []
    problems: list[Problem] = []
    for start, stop in items(text):
        source = Excerpt(text, OPTION, start, stop)
        names = RunNames(source, partial(rows_of_kind, scenario=scenario))
        try:
            tree = parse(source, _LANGUAGE)
            if not isinstance(tree, TableName) or tree.name not in (*ALWAYS, *TABLES):
                read = source.part.strip()
                hint = nearest(tree.name, TABLES) if isinstance(tree, TableName) else ""
                raise source.error(
                    f"read {quoted(read)}, expected columns of {listed([*TABLES], 30)}{hint}",
                    source.text.index(read, source.start),
                )
            rows = asked_rows(names.selection(tree), names.rows(tree.name))
            asked += rows if tree.name in TABLES else []
        except ReadError as error:
            problems += error.problems
    if problems:
        raise ReadError(problems)
    return asked


def asked_rows(part: Selection, rows: Sequence[str]) -> list[tuple[str, str]]:
    """Return pairs of table and row for a selected row, or for all rows if none is selected.

    The row name is empty for a table of a single number.
    """
    names = rows or [""] if part.row is None else [rows[part.row]]
    return [(part.table, row) for row in names]
