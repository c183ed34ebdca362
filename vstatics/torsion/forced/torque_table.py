"""A table of the torque that excites: orders with amplitudes and phases, as CSV."""

from __future__ import annotations

from vstatics.core.errors import Problem, ReadError
from vstatics.core.readers.named.headings import TableColumn
from vstatics.core.readers.unit_table import read_unit_table
from vstatics.torsion.forced.harmonic_torques import Harmonic

COLUMNS = (
    TableColumn("order"),
    TableColumn("amplitude", "si_torque", may_be_bare=True),
    TableColumn("phase", "angle", optional=True, may_be_bare=True),
)
MOST_ORDERS = 1000


def read_torque_table(data: bytes, file: str) -> list[Harmonic]:
    """The harmonics of a torque.

    Parameters
    ----------
    data : bytes
        A line of headings, `order`, `amplitude` [N*m] and perhaps `phase` [rad], with other units
        in brackets behind them, then a line for each order.
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
    table = read_unit_table(data, file, "a table of orders", COLUMNS, "E505")
    orders, amplitudes = table.numbers["order"], table.numbers["amplitude"]
    phases = table.numbers.get("phase", [0.0] * len(orders))
    found: dict[float, Harmonic] = {}
    problems: list[Problem] = []
    for row, order in enumerate(orders[: MOST_ORDERS + 1]):
        told = ""
        if order <= 0:
            told = f"order: read {order:g}, expected a number above 0"
        elif order in found:
            told = f"order {order:g} is given twice"
        elif row == MOST_ORDERS:
            told = f"more than {MOST_ORDERS} orders, expected at most so many"
        if told:
            problems.append(Problem("E505", told, (), table.place(row)))
        found[order] = Harmonic(order, amplitudes[row], phases[row])
    if problems:
        raise ReadError(problems)
    return list(found.values())
