"""Duty cycle files: shares of gears in YAML, or operating points in CSV."""

from __future__ import annotations

import codecs
import operator
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple, get_args

from vstatics.core.errors import CaseError, Problem, ReadError, of_file, spoken
from vstatics.core.model.parts import RAD_PER_RPM, Load
from vstatics.core.model.shape import ByKey, KeyShape, Shares
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.kinds import KEYS, is_of_kind
from vstatics.core.readers.named.headings import MOST_TITLE_LINES, SHAFT_COLUMNS, TableColumn
from vstatics.core.readers.named.nodes import Spots
from vstatics.core.readers.named.reader import read_document
from vstatics.core.readers.unit_table import UnitTable, read_unit_table
from vstatics.core.statics.result_arrays import Message
from vstatics.core.statics.results import Results
from vstatics.core.tables.csv import unguarded
from vstatics.vehicle.duty import Cycle, Duty, Kind, cycle
from vstatics.vehicle.life.classes import Classes
from vstatics.vehicle.operation.load_spectrum import (
    EXPONENT,
    Spectrum,
    points_of,
    spectrum,
    wrong_numbers,
)

DUTY = ByKey(
    "Duty cycle",
    "Gears with their shares of energy or of time.",
    tuple(
        KeyShape(kind, Shares(), f"Share of the {kind} for each gear; of any sum.")
        for kind in get_args(Kind)
    ),
)
EXPECTED = "`energy` or `time` with a share for each gear"
_SHARES = re.compile(rf"^[^\w\n]*({'|'.join(get_args(Kind))})[^\w\n]*:".encode(), re.MULTILINE)


def has_points(data: bytes) -> bool:
    """Return whether data without a suffix are a table of points, not shares by gear.

    >>> has_points(b"Speed [rpm],time [s]"), has_points(b"# by speed\\ntime: {low: 1}")
    (True, False)
    """
    return _SHARES.search(data) is None


class DutyFile(NamedTuple):
    """Duty cycle of shares by gear, with positions in the file."""

    duty: Duty
    spots: Spots

    @property
    def load(self) -> None:
        """None, because shares by gear contain no operating point."""

    def of(self, results: Results) -> Cycle:
        """Calculate the duty cycle for a case.

        Raises
        ------
        ReadError
            If the duty cycle does not fit the case; problems have positions in the file.
        """
        try:
            return cycle(results, self.duty)
        except CaseError as error:
            problems = [
                problem._replace(path=(self.duty.kind, *problem.path)) for problem in error.problems
            ]
            raise ReadError([self.spots.locate(problem) for problem in problems]) from None


_COLUMNS = (
    TableColumn(
        "time",
        "time",
        optional=True,
        may_be_bare=True,
        aliases={"t": "", "seconds": "s", "minutes": "min", "hours": "h"},
    ),
    TableColumn("share", optional=True, sizes={"": 1.0, "-": 1.0, "%": 0.01}),
    TableColumn("gear", is_text=True, optional=True),
    *SHAFT_COLUMNS,
)


class DutyTable(NamedTuple):
    """Duty cycle of operating points, with positions in the file."""

    table: UnitTable
    exponent: float
    classes: Classes | None = None
    """Torque classes of load spectra, if requested."""

    load: Load | None = None
    """First operating point whose power is not 0, as the load of a case without `load`."""

    def of(self, results: Results) -> Spectrum:
        """Calculate the duty cycle for a case.

        Raises
        ------
        ReadError
            If a point cannot be calculated; problems have lines in the file.
        """
        table = self.table
        is_cycle = "duration" in table.numbers
        case = _driven(results.case) if is_cycle else results.case
        gears = _gears(table, case)
        try:
            points = points_of(case, gears, table.numbers)
            found = spectrum(case, points, self.exponent, self.classes)
        except CaseError as error:
            raise _at_rows(error.problems, table) from None
        notes = [*(without_inertias(results.case) if is_cycle else _instants(table))]
        if self.load is not None and self.load is results.case.load:
            rpm, torque = self.load.speed, self.load.torque
            text = f"the case has no load: gears are calculated at {rpm:g} rpm and {torque:g} N*m"
            notes = [Message("N423", f"{text}, the first of these points with a power"), *notes]
        return found._replace(messages=(*found.messages, *notes))


def _gears(table: UnitTable, case: Transmission | None = None) -> Sequence[str]:
    """Return the gear of each point; without a column `gear`, the only gear of the case, or ""."""
    names = [gear.name for gear in case.gears] if case else [""]
    if "gear" in table.texts:
        return table.texts["gear"]
    if len(names) > 1:
        message = (
            f"`gear` is missing, expected the gear of each point, as the case has {len(names)}"
        )
        raise ReadError("E121", message, place=table.head_place)
    return names * len(table.lines)


def _driven(case: Transmission) -> Transmission:
    """Return a case without `coast`, because torques in a driving cycle have a sign."""
    gears = [gear._replace(coast=None) for gear in case.gears]
    return replace(case, gears=gears, coast=None)


def _instants(table: UnitTable) -> Iterator[Message]:
    """Yield a warning if the durations of points are probably the times of a record."""
    times = table.numbers.get("time", ())
    if len(times) > 2 and times[0] == 0 and all(map(operator.lt, times, times[1:])):
        yield Message(
            "W893",
            "`time` starts at 0 and rises in each row, as in a record, but is read as the duration "
            "of each row; for a record with equal time steps, replace `time` with a column `share` "
            "that is 1 in each row",
        )


def without_inertias(case: Transmission) -> Iterator[Message]:
    """Yield a note on inertias behind the input, whose inertia torques are ignored."""
    inputs = {case.gear_input(gear) for gear in case.gears}
    behind = [link for link, inertia in case.heavy.items() if inertia and link not in inputs]
    if behind and "N418" not in case.untold:
        names = spoken([case.link_name(link) for link in behind])
        text = f"inertias behind the input, of {names}, load no member: only the torque of the "
        yield Message("N418", f"{text}inertia of the input itself is taken off")


def _at_rows(problems: Iterable[Problem], table: UnitTable) -> ReadError:
    """Return an error with the problems at their rows; a problem without a row is at the first."""
    firsts = ((problem, next(iter(problem.path), 0)) for problem in problems)
    return ReadError(
        problem._replace(path=(), place=table.place(first if isinstance(first, int) else 0))
        for problem, first in firsts
    )


_STEP_COLUMNS = (TableColumn("duration", "time", may_be_bare=True), *_COLUMNS[2:])
"""Columns that are read from the steps of a driving cycle."""


def read_duty_table(
    data: bytes, file: str, exponent: float | None = None, classes: Classes | None = None
) -> DutyTable:
    """Read a duty cycle of operating points: columns time or share, gear, speed and torque.

    A case with a single gear needs no column `gear`.

    In a table with the column `duration`, which `vstatics cycle` writes, `time` is an instant.
    Durations are then read from `duration`, and `time` and further columns are skipped.

    Parameters
    ----------
    exponent : float, optional
        Exponent of equivalent torques; 3 if omitted. [-]
    classes : int or sequence of float, optional
        Number of torque classes of the load spectra, or upper bounds of the classes [N*m].

    Raises
    ------
    ReadError
        If the file has errors, with every problem and its position.
    """
    table = _steps(data, file) if _has(data, "duration") else _points(data, file)
    return DutyTable(table, exponent or EXPONENT, classes, _first_load(table))


def _points(data: bytes, file: str) -> UnitTable:
    expected = "a duty cycle, such as `vstatics cycle --time-steps` writes: time or share, "
    table = read_unit_table(data, file, f"{expected}gear, speed, torque", _COLUMNS, "E121")
    if ("time" in table.numbers) == ("share" in table.numbers):
        message = "expected exactly one of the columns `time` and `share`"
        raise ReadError("E121", message, place=table.head_place)
    return table


def _first_load(table: UnitTable) -> Load | None:
    points = zip(table.numbers["speed"], table.numbers["torque"], strict=True)
    return next((Load(w / RAD_PER_RPM, torque) for w, torque in points if w and torque), None)


def _has(data: bytes, name: str) -> bool:
    """Return whether a heading is this name of a column, not an alias."""
    lines = data.removeprefix(codecs.BOM_UTF8).split(b"\n", MOST_TITLE_LINES)
    heading = re.compile(rf"(?:^|[,;\t])[\s\"]*{name}\b".encode(), re.IGNORECASE)
    return any(map(heading.search, lines[:MOST_TITLE_LINES]))


def _steps(data: bytes, file: str) -> UnitTable:
    what = "steps of a driving cycle: duration, gear, speed, torque"
    columns = [
        column._replace(aliases={}) if _has(data, column.name) else column
        for column in _STEP_COLUMNS
    ]
    table = read_unit_table(data, file, what, columns, "E121", skips=True)
    numbers = {**table.numbers, "time": table.numbers["duration"]}
    texts = {name: list(map(unguarded, words)) for name, words in table.texts.items()}
    return table._replace(numbers=numbers, texts=texts)


def duty_points(data: bytes, file: str) -> list[tuple[str, float, float]]:
    r"""Read operating points with speeds other than 0: gear, speed [rad/s], torque [N*m].

    Raises
    ------
    ReadError
        If the file has errors, with every problem and its position.

    Examples
    --------
    >>> duty_points(b"share,gear,speed [rad/s],torque [N*m]\n1,low,200,0\n1,,0,0\n", "duty.csv")
    [('low', 200.0, 0.0)]
    """
    table = read_duty_table(data, file).table
    if problems := wrong_numbers(table.numbers):
        raise _at_rows(problems, table)
    columns = _gears(table), table.numbers["speed"], table.numbers["torque"]
    return [point for point in zip(*columns, strict=True) if point[1]]


def read_duty(data: bytes, file: str) -> DutyFile:
    """Read a duty cycle of shares by gear.

    Parameters
    ----------
    data : bytes
    file : str
        Name of the file, for messages.

    Raises
    ------
    ReadError
        If the file has errors, with every problem and its position.

    Examples
    --------
    >>> read_duty(b'energy: {"1": 1, "2": 3/2}', "duty.yaml").duty
    Duty(kind='energy', shares={'1': 1.0, '2': 1.5})
    """
    for kind in KEYS:
        if is_of_kind(kind, data, file):
            raise ReadError([of_file("E108", file, f"this is a {kind}, expected {EXPECTED}")])
    values, spots = read_document(data, file, DUTY, EXPECTED)
    if len(values) != 1:
        root = spots.place(())
        spots.document.stop(f"expected {EXPECTED}, and nothing else", root.line, root.column)
    [(kind, shares)] = values.items()
    return DutyFile(Duty(kind, shares), spots)
