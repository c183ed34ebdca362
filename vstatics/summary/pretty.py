"""A view of the gears for a person at a terminal: one table, coloured."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from vstatics.model.transmission import Transmission
from vstatics.statics.results import Results
from vstatics.summary.design import GearLine, design
from vstatics.tables.rows import OUTPUT
from vstatics.tables.table import Table
from vstatics.tables.values import tables

if TYPE_CHECKING:
    from rich.console import Group
    from rich.table import Table as RichTable
    from rich.text import Text

POOR, BAD = 0.95, 0.9
"""An efficiency below is yellow, or red."""

WIDE = 12
"""So many characters of names of shift elements head columns; more are numbered."""


LARGE = 1e6
"""From here on numbers are written with a power of ten."""


class Marks(NamedTuple):
    """Signs of the table; others where the terminal knows ASCII only."""

    engaged: str = "●"
    holds: str = "◆"
    open: str = "·"


ASCII = Marks("x", "f", ".")


class Largest(NamedTuple):
    """The largest of some numbers, with what it belongs to."""

    value: float
    name: str

    def text(self, *, whole: bool) -> str:
        """The number and the name; nothing where there is no number."""
        if not self.name:
            return ""
        if self.value >= LARGE:
            return f"{self.value:.3g} {self.name}"
        return f"{self.value:.0f} {self.name}" if whole else f"{self.value:.2f} {self.name}"


def view(results: Results, marks: Marks = Marks()) -> Group:  # noqa: B008 - it is frozen
    """One table of the gears, and what its marks mean.

    Parameters
    ----------
    results : Results
        Of one case.
    marks : Marks, optional
        `ASCII` for a terminal that knows no others.

    Returns
    -------
    rich.console.Group
        Speeds and torques are the largest of their gear: in rpm and N*m where the case
        has a load, else relative to the input [-].

    Examples
    --------
    >>> from vstatics.model.transmission import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.statics.solve import solve
    >>> case = Transmission(3, [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
    ...                     [Mechanism(1, 2, 3, -2.5, 0.96, name="set")], [Gear([1]), Gear([2])])
    >>> len(view(solve(case), ASCII).renderables)
    4
    """
    from rich.console import Group
    from rich.text import Text

    case = results.case
    found = {table.quantity.key: table for table in tables(results)}
    parts: list[RichTable | Text] = []
    if case.name:
        parts.append(Text(case.name, style="bold"))
    parts.append(_table(results, found, marks))
    parts += [Text(line, style="dim") for line in _legend(results, found, marks)]
    return Group(*parts)


def _table(results: Results, found: dict[str, Table], marks: Marks) -> RichTable:
    from rich import box
    from rich.table import Table as RichTable
    from rich.text import Text

    case = results.case
    made = RichTable(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    made.add_column("gear", style="bold", overflow="fold")
    headings = _headings(case)
    if headings:
        made.add_column(_in_line([(heading, "") for heading in headings], headings), no_wrap=True)
    gears = range(len(case.gears))
    lines = design(results).gears
    figures = [_figures(line) for line in lines]
    for heading, column in zip(("ratio", "step", "eff."), zip(*figures, strict=True), strict=True):
        wide = max(map(len, column))  # numbers are never cut
        made.add_column(heading, justify="right", no_wrap=True, min_width=wide)
    rpm, torque = "W_rpm" in found, "AMLGP_Nm" in found
    largest = [
        (
            _fastest(found, number, rpm=rpm).text(whole=rpm),
            _strongest(found, number).text(whole=torque) if results.calculable[number] else "",
        )
        for number in gears
    ]
    titles = ("speed, rpm" if rpm else "speed", "torque, N*m" if torque else "torque")
    for heading, column in zip(titles, zip(*largest, strict=True), strict=True):
        wide = max(len(text.partition(" ")[0]) for text in column)
        made.add_column(heading, overflow="fold", min_width=wide)
    made.add_column("idle", overflow="fold")
    for number in gears:
        made.add_row(
            Text(case.gears[number].name),
            *([_in_line(_dots(results, number, marks), headings)] if headings else ()),
            *figures[number],
            *map(Text, largest[number]),
            _state(lines[number], found, number),
        )
    return made


def _headings(case: Transmission) -> list[str]:
    """Names of the shift elements, or numbers where the names are too wide."""
    names = [element.name for element in case.shift_elements]
    return names if sum(map(len, names)) <= WIDE else list(map(str, range(1, len(names) + 1)))


def _dots(results: Results, number: int, marks: Marks) -> Iterator[tuple[str, str]]:
    """Whether each element is engaged, or a freewheel that holds; with a style."""
    engaged = results.case.gears[number].engaged
    for element, holds in enumerate(results.holds[number].tolist(), 1):
        if element in engaged:
            yield marks.engaged, "green"
        else:
            yield (marks.holds, "cyan") if holds else (marks.open, "dim")


def _in_line(words: Iterable[tuple[str, str]], headings: Sequence[str]) -> Text:
    """One word under each heading, side by side where all headings are letters."""
    from rich.text import Text

    width = max(map(len, headings))
    padded = [(word.ljust(width), style) for word, style in words]
    return Text(" " if width > 1 else "").join(Text(word, style) for word, style in padded)


def _figures(line: GearLine) -> tuple[Text, Text, Text]:
    """Ratio, step to the next gear of the same direction, and efficiency."""
    from rich.text import Text

    good = line.efficiency
    colour = "red" if good < BAD else "yellow" if good < POOR else "green"
    ratio = Text(_fixed(line.ratio), "magenta" if line.ratio < 0 else "")
    return ratio, Text(_fixed(line.step)), Text(_fixed(good), colour)


def _fixed(value: float) -> str:
    if math.isnan(value):
        return ""
    return f"{value:.3f}" if abs(value) < LARGE else f"{value:.3g}"


def _fastest(found: dict[str, Table], number: int, *, rpm: bool) -> Largest:
    """The largest speed of links, planets and open elements."""
    unit = "_rpm" if rpm else ""
    kinds = (("W", ""), ("WSAT", "planet "), ("WFRI", "slip "))
    return _largest(
        # P1.planet tells by itself what it is, 1 does not
        (abs(value), name if "." in name else f"{kind or 'link ' * name.isdigit()}{name}")
        for table, kind in kinds
        if table + unit in found
        for name, value in _column(found[table + unit], number)
    )


def _strongest(found: dict[str, Table], number: int) -> Largest:
    """The largest torque of shift elements, mechanisms and members, with losses if they exist.

    None where one of them is not determined: it may be larger than all others.
    """
    names = ("AMLGP_Nm", "AMLG_Nm") if "AMLGP_Nm" in found else ("AMLGP", "AMLG")
    for name in names:
        column = [(abs(v), n) for n, v in _column(found[name], number) if n != OUTPUT]
        if not any(math.isnan(value) for value, _ in column):
            return _largest(column)
    return Largest(math.nan, "")


def _column(table: Table, number: int) -> Iterator[tuple[str, float]]:
    yield from zip(table.rows, table.values[:, number].tolist(), strict=True)


def _largest(values: Iterator[tuple[float, str]] | Sequence[tuple[float, str]]) -> Largest:
    known = [Largest(value, name) for value, name in values if not math.isnan(value)]
    return max(known, key=lambda one: one.value, default=Largest(math.nan, ""))


STATES = {
    "tied up": "what is engaged contradicts itself, the input can't turn",
    "conflict": "a freewheel can neither hold nor overrun",
    "locked": "friction holds the train, whatever the input torque",
    "output stands": "its speed is 0, so there is no ratio",
    "open": "neutral, the speed of the output is not determined",
    "no torques": "nothing holds the torque of the input",
    "undecided": "the search for directions of power was cut short",
}
"""What the states of gears mean."""

FAULTS = {"tied up", "conflict", "locked"}
"""Those that no gear should have."""


def _state(line: GearLine, found: dict[str, Table], number: int) -> Text:
    """What is idle; or why there are no numbers."""
    from rich.text import Text

    if line.state:
        return Text(line.state, "red" if line.state in FAULTS else "yellow")
    return Text(" ".join(name for name, value in _column(found["idle"], number) if value == 1))


def _legend(results: Results, found: dict[str, Table], marks: Marks) -> Iterator[str]:
    """What the marks that occur mean."""
    case = results.case
    names = [element.name for element in case.shift_elements]
    if names != _headings(case):
        yield ", ".join(f"{number} {name}" for number, name in enumerate(names, 1))
    signs = [f"{marks.engaged} engaged"] if any(gear.engaged for gear in case.gears) else []
    if case.freewheels:
        signs.append(f"{marks.holds} freewheel that holds")
    signs.append("step: to the next smaller ratio")
    yield "; ".join(signs)
    yield "speed, torque: the largest" + ("" if "W_rpm" in found else ", by the input's")
    if (found["idle"].values == 1).any():
        yield "idle: carries no torque, or turns as one piece"
    states = [line.state for line in design(results).gears]
    yield from (f"{state}: {why}" for state, why in STATES.items() if state in states)
