"""CSV table of an exciting torque: orders with amplitudes and phases."""

from __future__ import annotations

import cmath

from vstatics.core.errors import Problem, ReadError
from vstatics.core.readers.named.headings import TableColumn
from vstatics.core.readers.unit_table import read_unit_table
from vstatics.torsion.forced.harmonic_torques import Harmonic

COLUMNS = (
    TableColumn("order"),
    TableColumn("amplitude", "si_torque", may_be_bare=True),
    TableColumn("phase", "angle", optional=True, may_be_bare=True),
    TableColumn("link", is_text=True, optional=True),
)
MOST_ORDERS = 1000


def read_torque_table(data: bytes, file: str) -> list[Harmonic]:
    """Read the harmonics of a torque.

    Parameters
    ----------
    data : bytes
        CSV: a line with the headings `order`, `amplitude` [N*m] and optionally `phase` [rad], then
        a line for each order. With a column `link`, a line for each order and link. Headings can be
        followed by other units in brackets.
    file : str
        Name of the file, for messages.

    Raises
    ------
    ReadError
        If the table is not valid, with all problems and their positions.

    Examples
    --------
    >>> read_torque_table(b"order,amplitude\\n2,80\\n4,25\\n", "engine.csv")
    [Harmonic(order=2.0, amplitude=80.0, ...), Harmonic(order=4.0, amplitude=25.0, ...)]
    """
    table = read_unit_table(data, file, "a table of orders", COLUMNS, "E505")
    orders, amplitudes = table.numbers["order"], table.numbers["amplitude"]
    phases = table.numbers.get("phase", [0.0] * len(orders))
    links = table.texts.get("link", [""] * len(orders))
    harmonics: dict[float, Harmonic] = {}
    problems: list[Problem] = []
    for row, order in enumerate(orders[: MOST_ORDERS + 1]):
        fault = ""
        if order <= 0:
            fault = f"order: read {order:g}, expected a number above 0"
        elif order in harmonics and links[row] in harmonics[order].by_link:
            fault = f"order {order:g} is given twice; give the vector sum of its torques on a link"
        elif row == MOST_ORDERS:
            fault = f"read more than {MOST_ORDERS} orders, expected at most {MOST_ORDERS}"
        if fault:
            problems.append(Problem("E505", fault, (), table.place(row)))
        before = harmonics[order].by_link if order in harmonics else {}
        by_link = {**before, links[row]: cmath.rect(amplitudes[row], phases[row])}
        harmonics[order] = Harmonic(order, amplitudes[row], phases[row], by_link)
    if problems:
        raise ReadError(problems)
    if not any(links):
        return [harmonic._replace(by_link={}) for harmonic in harmonics.values()]
    return list(harmonics.values())
