"""Coloured table of all gears for a terminal, and as HTML for a notebook."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from html import escape

import numpy as np
from rich.console import Group
from rich.table import Table as RichTable
from rich.text import Text

from vstatics.core.numerics.tolerances import ROUNDED_NUMBER, SAME_RATIO
from vstatics.core.statics.result_arrays import OUTPUT, row_names
from vstatics.core.statics.results import Results
from vstatics.core.statics.roles import IDLE, MEANINGS, ONE_PIECE, Role, roles
from vstatics.core.statics.status import STATUSES
from vstatics.core.summary.design_table import GearLine, design
from vstatics.core.summary.tables import Marks, element_signs, state
from vstatics.core.tables import terminal
from vstatics.core.tables.grid import Cell, Column, Grid, exact, text
from vstatics.core.tables.html import table
from vstatics.core.tables.ports import PortTable, port_tables, ports_grid
from vstatics.core.tables.quantities import Table, headed
from vstatics.core.tables.text import broken
from vstatics.core.tables.values import tables
from vstatics.core.texts import tr

POOR, BAD = 0.95, 0.9
"""Efficiencies below which a gear is shown in yellow, or in red. [-]"""

NEEDS_DECIMALS = 10
"""Speed [rpm] or torque [N*m] below which numbers have a decimal."""

NAMES_IN_HEADS = 12
"""Largest total number of characters of shift-element names for which headings are never numbers.
"""

SPEEDS = {
    "planet_speeds": "largest planet speed",
    "slip_speeds": "largest slip",
    "speeds": "largest speed",
}
"""Heading of the column of speeds, by quantity. The first quantity that exists is shown."""

DOTS = Marks(holds="◆")
ASCII = Marks("x", "f", ".")
"""Marks of the states of shift elements, for a terminal without Unicode."""


def view(
    results: Results, marks: Marks = DOTS, digits: int | None = None, width: int = 80
) -> Group:
    """Return a table of the gears of a case, with a legend.

    If the table is wider than the terminal, numbers replace the names of shift elements, and a line
    above the table explains the numbers. If it is still too wide, the largest speeds and torques
    have a separate table. The table of ports is omitted if all its numbers follow from ratios and
    efficiencies.

    Parameters
    ----------
    marks : Marks, optional
        Marks of shift elements, such as `ASCII`.
    digits : int, optional
        Number of decimals, by default chosen for each number.
    width : int, optional
        Width of the terminal in characters.

    Returns
    -------
    rich.console.Group
        Table with the largest planet speed and torque of each gear, in rpm and N*m if the case
        has an operating point, else relative to the input [-].

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.core.statics.solve import solve
    >>> case = Transmission(3, [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
    ...                     [Mechanism(1, 2, 3, -2.5, 0.96, name="set")], [Gear([1]), Gear([2])])
    >>> len(view(solve(case), ASCII).renderables)
    6
    """
    case = results.case
    title = [Text(case.name, style="bold")] * bool(case.name)
    gears = gears_grid(results, marks, digits)
    names = [element.name for element in case.shift_elements]
    numbered = sum(map(len, names)) > NAMES_IN_HEADS and terminal.natural_width(gears) > width
    key = list[Text]()
    if numbered:
        gears = gears_grid(results, marks, digits, numbered=True)
        key = [Text(line, style="dim") for line in _numbers(names, width)]
    parts = [gears] if terminal.whole_width(gears) <= width else [*_split(gears)]
    lines = [*_legend(results, gears, marks), *_inverses(results, digits)]
    if converters := _converters(results):
        lines.append(f"{', '.join(converters)}: {tr('speed ratio of a converter')}")
    gears_ports = port_tables(results)
    others = [sum(not port.is_output for _, port in gear.rows) for gear in gears_ports]
    if any(number > 1 for number in others):
        lines.append(tr("torque of an output: on its load; of other ports: on their links"))
    legend = (Text(line, style="dim") for line in lines)
    tables = (table for part in parts for table in terminal.tables(part, width))
    return Group(*title, *key, *tables, *legend, *_ports(gears_ports, digits, width))


def gears_grid(
    results: Results, marks: Marks = DOTS, digits: int | None = None, *, numbered: bool = False
) -> Grid:
    """Return the table of gears: engaged shift elements, ratio, efficiency, largest values.

    The column of speeds contains speeds of planets, in a case without planets slip speeds, and
    without shift elements link speeds.

    Parameters
    ----------
    marks : Marks, optional
    digits : int, optional
        Number of decimals, by default chosen for each number.
    numbered : bool, optional
        True if the headings of shift elements are numbers instead of names.
    """
    names = [element.name for element in results.case.shift_elements]
    headings = list(map(str, range(1, len(names) + 1))) if numbered else names
    by_name = {table.quantity.name: table for table in tables(results)}
    rpm, torque = "speeds_rpm" in by_name, "lossy_torques_Nm" in by_name
    shown_roles = [role for role in (ONE_PIECE, IDLE) if role in _all_roles(results)]
    has_state = any(results.status(index + 1).name for index in range(len(results.case.gears)))
    speed_heading, speeds = _speed_column(by_name, rpm=rpm)
    columns = [
        text("gear"),
        *(Column(heading, is_sign=True, is_name=True) for heading in headings),
        *(Column(heading, is_name=True) for heading in _converters(results)),
        *map(Column, ("ratio", "step", "eff.")),
        text(headed(speed_heading, "rpm" if rpm else "")),
        text(headed("largest torque", "Nm" if torque else "")),
        *map(text, shown_roles),
        *[text("state")] * has_state,
    ]
    rows = [
        [
            Cell(line.gear),
            *element_signs(results, index, marks),
            *(exact(ratio, digits=digits) for ratio in _speed_ratios(results, index)),
            *_figures(line, digits),
            _largest(speeds(index), 0 if rpm else 2, digits),
            _largest(_torques(by_name, index), 0 if torque else 2, digits)
            if results.calculable[index] and not results.locked[index]
            else Cell(""),
            *_by_role(results, index, shown_roles),
            *[_state(results, index)] * has_state,
        ]
        for index, line in enumerate(design(results).gears)
    ]
    return Grid(results.case.name, columns, rows)


def _converters(results: Results) -> list[str]:
    """Return headings for speed ratios of converters, if the load determines any of these."""
    case = results.case
    if not any(map(case.sought_converters, case.gears)):
        return []
    return [f"i {name}" for name in row_names(case, "converters")]


def _speed_ratios(results: Results, number: int) -> list[float]:
    return results.speed_ratio[number].tolist() if _converters(results) else []


def _ports(gears: Sequence[PortTable], digits: int | None, width: int) -> list[RichTable]:
    """Return the table of ports; empty if all its numbers follow from ratios and efficiencies.

    Gears without torques are omitted, because the table of gears states why they have none.
    """
    gears = [gear for gear in gears if not all(math.isnan(port.torque) for _, port in gear.rows)]
    if not any(gear.has_more_than_ratios for gear in gears):
        return []
    grid = ports_grid(gears)
    names = [row[0].text for row in grid.cells]
    rows = [
        [Cell("" if place and name == names[place - 1] else name), *row[1:]]
        for place, (name, row) in enumerate(zip(names, grid.cells, strict=True))
    ]
    return terminal.tables(grid._replace(rows=rows).with_digits(digits), width, keys=2)


def _figures(line: GearLine, digits: int | None) -> list[Cell]:
    good = line.efficiency
    colour = "red" if good < BAD else "yellow" if good < POOR else "green"
    return [
        exact(line.ratio, digits=digits)._replace(style="magenta" if line.ratio < 0 else ""),
        exact(line.step, digits=digits),
        exact(good, digits=digits)._replace(style=colour),
    ]


def _speed_column(
    by_name: dict[str, Table], *, rpm: bool
) -> tuple[str, Callable[[int], list[tuple[str, float]]]]:
    """Return the heading of the largest speeds, and a function from gear index to (name, speed)."""
    unit = "_rpm" if rpm else ""
    existing = (
        (heading, by_name[name + unit])
        for name, heading in SPEEDS.items()
        if name + unit in by_name and not np.isnan(by_name[name + unit].values).all()
    )
    heading, shown = next(existing, ("largest speed", by_name[f"speeds{unit}"]))

    def speeds(number: int) -> list[tuple[str, float]]:
        return [(row.removesuffix(".planet"), value) for row, value in _column(shown, number)]

    return heading, speeds


def _torques(by_name: dict[str, Table], number: int) -> list[tuple[str, float]]:
    """Return the torques on shift elements, mechanisms and members, with losses if possible.

    The list is empty if any torque is indeterminate, because the largest torque is then unknown.
    """
    unit = "_Nm" if "lossy_torques_Nm" in by_name else ""
    for name in ("lossy_torques", "torques"):
        table = by_name[name + unit]
        column = [torque for torque in _column(table, number) if torque[0] != OUTPUT]
        if not any(math.isnan(value) for _, value in column):
            return column
    return []


def _column(table: Table, number: int) -> Iterator[tuple[str, float]]:
    yield from zip(table.rows, table.values[:, number].tolist(), strict=True)


def _largest(values: Iterable[tuple[str, float]], decimals: int, digits: int | None) -> Cell:
    """Return a cell with the value of largest magnitude and its name; empty without values."""
    known = [(abs(value), name) for name, value in values if not math.isnan(value)]
    if not known:
        return Cell("")
    value, name = max(known, key=lambda pair: pair[0])
    if value < ROUNDED_NUMBER:
        return Cell("0", 0.0)
    decimals = decimals or int(value < NEEDS_DECIMALS)
    return Cell(f"{exact(value, decimals, digits=digits).text} {name}", value)


def _by_role(results: Results, number: int, shown: Sequence[Role]) -> Iterator[Cell]:
    """Yield for each role a cell with the names of gear sets that have the role in a gear."""
    names = [device.name for device in results.case.own_devices]
    by_name = [*zip(names, roles(results, number), strict=True)]
    for wanted in shown:
        yield Cell(" ".join(name for name, role in by_name if role == wanted))


def _state(results: Results, number: int) -> Cell:
    """Return a cell with the state of a gear; empty for a regular gear."""
    status = results.status(number + 1)
    return state(status.name)._replace(style="red" if status.is_fault else "yellow")


def _split(gears: Grid) -> Iterator[Grid]:
    """Yield the table of gears without the largest values, then a table of the largest values."""
    columns = [*enumerate(gears.columns)]
    largest = [
        n for n, column in columns if column.heading.startswith("largest") and not column.is_name
    ]
    yield gears.with_columns([n for n, _ in columns if n not in largest])
    yield gears.with_columns([0, *largest])


def _all_roles(results: Results) -> set[Role]:
    gears = range(len(results.case.gears))
    return {role for gear in gears for role in roles(results, gear)}


def _numbers(names: Sequence[str], width: int) -> list[str]:
    """Return lines that explain the numbers of shift elements."""
    *first, last = (f"{number} {name}" for number, name in enumerate(names, 1))
    return broken([f"{tr('shift elements')}:", *(f"{text}," for text in first), last], width)


def _legend(results: Results, gears: Grid, marks: Marks) -> Iterator[str]:
    """Yield lines that explain the marks in the table."""
    case = results.case
    if case.shift_elements:
        signs = [f"{marks.engaged} {tr('engaged')}", f"{marks.open} {tr('disengaged')}"]
        signs += [f"{marks.holds} {tr('freewheel that holds')}"] * bool(case.freewheels)
        signs += [f"{marks.slips} {tr('slips')}"] * any(gear.slipping for gear in case.gears)
        yield "; ".join(signs)
    step = [tr("step: ratio divided by the next smaller ratio")]
    step *= any(line.next for line in design(results).gears)
    yield "; ".join([*step, tr("eff.: efficiency")])
    headings = [column.heading for column in gears.columns]
    about = [tr("planet speed: relative to its carrier")]
    about *= any(heading.startswith(SPEEDS["planet_speeds"]) for heading in headings)
    if about and (planets := _planets_without_speed(results)):
        about.append(f"{tr('not determined')}: {', '.join(planets)}")
    if "largest torque" in headings:
        if any(heading in headings for heading in SPEEDS.values()):
            about.append(tr("1.00 is the input speed or torque"))
        else:
            about.append(tr("1.00 is the input torque"))
    if about:
        yield "; ".join(about)
    if case.drawing is None and case.mechanisms:
        yield tr("torque of a mechanism: on its first link")
    occurring = _all_roles(results)
    said = [f"{tr(role)}: {tr(meaning)}" for role, meaning in MEANINGS.items() if role in occurring]
    if said:
        yield "; ".join(said)
    states = {results.status(number + 1) for number in range(len(case.gears))}
    for status in STATUSES:
        if status in states:
            yield f"{state(status.name).spoken.text}: {tr(status.meaning)}"


def _planets_without_speed(results: Results) -> list[str]:
    """Return the planets without a speed in any gear, usually because teeth are missing."""
    if results.case.drawing is None:
        return []
    [planets] = [table for table in tables(results) if table.quantity.name == "planet_speeds"]
    return [
        row.removesuffix(".planet")
        for row, values in zip(planets.rows, planets.values, strict=True)
        if np.isnan(values).all()
    ]


def _inverses(results: Results, digits: int | None) -> Iterator[str]:
    """Yield a line with 1/i if an output is faster than the input, as usual for bicycle hubs."""
    fast = [line for line in design(results).gears if 0 < abs(line.ratio) < 1 - SAME_RATIO]
    if fast:
        words = tr("1/i = output speed / input speed")
        shown = (
            f"{tr('gear')} {line.gear}: {exact(1 / line.ratio, digits=digits).text}"
            for line in fast
        )
        yield f"{words}; {', '.join(shown)}"


def results_html(results: Results) -> str:
    """Return the gears of a case as an HTML table; for many variants, a line about the variants.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> results_html(solve(Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear()]))).count("<tr>")
    2
    """
    if results.ratio.ndim != 1:
        return f"<code>{escape(repr(results))}</code>"
    return table(gears_grid(results))
