"""A table of the torque that excites: orders with amplitudes and phases, as CSV."""

from __future__ import annotations

import csv
import math

from vstatics.errors import Problem, ReadError, listed
from vstatics.readers.named.nodes import decode
from vstatics.readers.reading import Source
from vstatics.torsion.forced.harmonic_torques import Harmonic

_HEADINGS = {
    "order": ("order", 1.0),
    "amplitude": ("amplitude", 1.0),
    "amplitude [N*m]": ("amplitude", 1.0),
    "phase": ("phase", 1.0),
    "phase [rad]": ("phase", 1.0),
    "phase [deg]": ("phase", math.pi / 180),
}
"""What a column has, and its unit in SI."""
MOST_ORDERS = 1000


def read_torque_table(data: bytes, file: str) -> list[Harmonic]:
    """The harmonics of a torque.

    Parameters
    ----------
    data : bytes
        A line of headings, `order`, `amplitude` and perhaps `phase` [rad] or `phase [deg]`,
        then a line for each order.
    file : str
        Its name, for messages.

    Raises
    ------
    ReadError
        With every problem and its place.

    Examples
    --------
    >>> read_torque_table(b"order,amplitude\\n2,80\\n4,25\\n", "engine.csv")
    [Harmonic(order=2.0, amplitude=80.0, phase=0.0), Harmonic(order=4.0, amplitude=25.0, phase=0.0)]
    """
    source = decode(data, file, "a table of orders").source
    lines = [(number, line) for number, line in enumerate(source.lines, 1) if line.strip()]
    rows = [(number, _cells(line, number, source)) for number, line in lines]
    (first, headings), *others = rows
    columns = _columns(headings, first, source)
    problems: list[Problem] = []
    found: dict[float, Harmonic] = {}
    for number, cells in others[: MOST_ORDERS + 1]:
        try:
            one = _harmonic(cells, columns)
        except ValueError as error:
            problems.append(_at(source, number, str(error)))
            continue
        if one.order in found:
            problems.append(_at(source, number, f"order {one.order:g} is given twice"))
        found[one.order] = one
    if len(others) > MOST_ORDERS:
        problems.append(_at(source, 0, f"more than {MOST_ORDERS} orders, expected at most so many"))
    if not others:
        problems.append(_at(source, first, "there is no order below the headings"))
    if problems:
        raise ReadError(problems)
    return list(found.values())


def _cells(line: str, number: int, source: Source) -> list[str]:
    """The cells of a line."""
    try:
        return next(csv.reader([line]), [])
    except csv.Error as error:
        raise ReadError([_at(source, number, f"no CSV: {error}")]) from None


def _columns(headings: list[str], number: int, source: Source) -> list[tuple[str, float]]:
    """What each column has."""
    names = [name.strip() for name in headings]
    unknown = [name for name in names if name not in _HEADINGS]
    columns = [_HEADINGS[name] for name in names if name in _HEADINGS]
    parts = [part for part, _ in columns]
    if unknown or len(set(parts)) < len(parts) or not {"order", "amplitude"} <= set(parts):
        read = listed(names, 6)
        message = f"read the headings {read}, expected `order`, `amplitude` and perhaps `phase`"
        raise ReadError([_at(source, number, f"{message} or `phase [deg]`")])
    return columns


def _harmonic(cells: list[str], columns: list[tuple[str, float]]) -> Harmonic:
    """The numbers of a line, in SI; a ValueError says which can't be read."""
    if len(cells) != len(columns):
        raise ValueError(f"read {len(cells)} cells, expected {len(columns)}, as the headings")
    values = {}
    for cell, (part, unit) in zip(cells, columns, strict=True):
        try:
            value = float(cell) * unit
        except ValueError:
            value = math.nan
        if not math.isfinite(value) or (part == "order" and value <= 0):
            above = " above 0" * (part == "order")
            message = f"{part}: read '{cell.strip()[:40]}', expected a number{above}"
            raise ValueError(message)
        values[part] = value
    return Harmonic(**values)


def _at(source: Source, line: int, message: str) -> Problem:
    return Problem("E505", message, (), source.place(line))
