"""Exercise on a gear, with blanks for numbers that students calculate, and with a solution."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from importlib import import_module
from typing import Any, Literal, NamedTuple

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError
from vstatics.core.explain.drawn_numbers import drawn, unchanged
from vstatics.core.explain.given import given, told_signs
from vstatics.core.statics.results import Results, expect_one_case
from vstatics.core.tables.answer import Known, plain_data
from vstatics.core.tables.grid import Cell, Column, Grid, Values, exact, grid_of, text, whole, word
from vstatics.core.tables.html import shown
from vstatics.core.tables.names import ROWS
from vstatics.core.tables.quantities import Quantity, Table
from vstatics.core.tables.result_tables import structural_zeros
from vstatics.core.tables.values import tables
from vstatics.core.texts import Language, speaking, tr
from vstatics.core.writers import result_json

ASKED = (
    "speeds",
    "planet_speeds",
    "slip_speeds",
    "ratio",
    "torques",
    "power_sign",
    "lossy_torques",
    "losses",
    "efficiency",
)
"""Tables with blanks, in the order of calculation."""
IN_UNITS = {
    "torques": "torques_Nm",
    "lossy_torques": "lossy_torques_Nm",
    "losses": "losses_kW",
}
"""Tables with units, which replace relative tables in gears whose input torque is 0."""
MORE = ("power_balance",)
"""Table that also gets blanks if the other tables have fewer than `LEAST` blanks."""
LEAST = 10
"""Number of blanks below which the tables `MORE` get blanks, too."""
LINE = "____"
"""Text printed for a blank."""
SheetForm = Literal["text", "markdown", "latex"]


class Blank(NamedTuple):
    """Number that the exercise asks for."""

    number: int
    """Number of the blank, from 1."""
    table: str
    """Name of the table, as in the JSON of a result."""
    row: str | None
    """Row of the table; null for a table with a single number for each gear."""
    value: Known
    """Value of the blank, as in the JSON of a result."""


class SolvedExercise(NamedTuple):
    """Solution of an exercise as a record."""

    case: Mapping[str, Any]
    """Case with the keys of a case file, which can be run."""
    gear: str
    seed: int | None
    blanks: Sequence[Blank]


@refusing()
def exercise(results: Results, gear: int | str, *, seed: int | None = None) -> GearExercise:
    """Return a gear as an exercise, with blanks and with the solution.

    Parameters
    ----------
    results : Results
        Results of a single case.
    gear : int or str
        Number of the gear from 1, or its name.
    seed : int, optional
        Seed (0 or more) of random teeth that can be assembled, random ratios, and capacities with
        unchanged margins. Default: the numbers of the case.

    Returns
    -------
    GearExercise
        Exercise with the `blanks` and their values as in the JSON of a result. `worksheet` and
        `solution` write it as text, Markdown or LaTeX. `document` returns the solution as plain
        data.

    Raises
    ------
    ValueError
        If the gear does not exist, the seed is below 0, or the results are arrays of variants.
    CaseError
        If the gear has no numbers.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> made = exercise(solve(case), "1")
    >>> "[2] ____" in made.worksheet(), "[2] 0.286" in made.solution()
    (True, True)
    """
    expect_one_case(results, "exercise")
    index = results.case.gear_number(gear) - 1
    if seed is not None:
        if seed < 0:
            raise ValueError(f"seed is {seed}, expected 0 or more")
        case, results = results.case, drawn(results, seed)
        return worksheet(results, index, seed, unchanged(case, results.case))
    return worksheet(results, index)


class GearExercise(NamedTuple):
    """Gear as an exercise, with blanks and solution."""

    results: Results
    place: int
    """Index of the gear."""
    seed: int | None
    """Seed of the random numbers; None for the numbers of the case."""
    asked: Sequence[Table]
    """Tables with at least one blank."""
    blanks: Sequence[Blank]
    unchanged: Sequence[str] = ()
    """Names of parts whose numbers did not change in spite of the seed."""

    @property
    def gear(self) -> str:
        """Name of the gear."""
        return self.results.case.gears[self.place].name

    def titles(self, file: str = "") -> list[str]:
        """Return the title lines: name or file of the case, and seed of the numbers."""
        as_before = (
            tr("; as before: {names}", names=", ".join(self.unchanged)) if self.unchanged else ""
        )
        seed = "" if self.seed is None else f" (--seed {self.seed}{as_before})"
        return [f"{self.results.case.name or file}{seed}"]

    @refusing()
    def worksheet(self, form: SheetForm = "text", *, lang: Language = "en") -> str:
        """Return the exercise with blanks, as text, Markdown or LaTeX."""
        return self._written(form, lang, solved=False)

    @refusing()
    def solution(self, form: SheetForm = "text", *, lang: Language = "en") -> str:
        """Return the exercise with numbers, as text, Markdown or LaTeX."""
        return self._written(form, lang, solved=True)

    def _written(self, form: SheetForm, lang: Language, *, solved: bool) -> str:
        writer = import_module(f"vstatics.core.tables.{form}")
        with speaking(lang):
            document: str = writer.write(self.titles(), grids(self, solved=solved))
        return document

    def __repr__(self) -> str:
        """Return a short description: gear and number of blanks."""
        seed = "" if self.seed is None else f", seed {self.seed}"
        return f"<GearExercise {self.gear!r}: {len(self.blanks)} blanks{seed}>"

    def _repr_html_(self) -> str:
        return shown(grids(self, solved=False))

    def document(self) -> dict[str, Any]:
        """Return the solution as plain data, with a case that can be run under the key `case`."""
        case = result_json.document(self.results)["case"]
        solved = SolvedExercise(case, self.gear, self.seed, self.blanks)
        data: dict[str, Any] = plain_data(solved)
        return data


def worksheet(
    results: Results, index: int, seed: int | None = None, unchanged: Sequence[str] = ()
) -> GearExercise:
    """Return the exercise of a gear of a single case.

    Prescribed speeds, and signs as in `told_signs`, are not blanks. Numbers that are 0
    because of the gear-train layout are blanks only if there are few other blanks.

    Parameters
    ----------
    index : int
        Index of the gear.
    seed : int, optional
        Seed of the random numbers in the case.
    unchanged : sequence of str
        Names of parts whose numbers did not change in spite of the seed.

    Raises
    ------
    CaseError
        If the gear has no numbers.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> made = worksheet(solve(case), 0)
    >>> made.blanks[1]
    Blank(number=2, table='speeds', row='3', value=0.2857142857142857)
    """
    by_name = {item.quantity.name: item for item in tables(results)}
    case = results.case
    no_torque = not case.input_torque(case.gears[index])
    if results.locked[index]:  # a self-locking gear has no admissible signs of power
        del by_name["power_sign"]
    wanted = [by_name[name] for name in asked_names(no_torque=no_torque) if name in by_name]
    blanks = list(_blanks(results, index, wanted, telling=True))
    if len(blanks) < LEAST:
        wanted += [by_name[name] for name in MORE if not no_torque]
        blanks = list(_blanks(results, index, wanted, telling=False))
    if not blanks:
        gear = case.gears[index].name
        raise CaseError("E910", f"gear {gear} has no results for an exercise; choose another gear")
    names = {item.table for item in blanks}
    asked = [item for item in wanted if item.quantity.name in names]
    return GearExercise(results, index, seed, asked, blanks, unchanged)


def asked_names(*, no_torque: bool) -> Iterator[str]:
    """Yield the names of `ASKED`, with units if the input torque is 0."""
    for name in ASKED:
        yield IN_UNITS.get(name, name) if no_torque else name


def _blanks(
    results: Results, index: int, wanted: Sequence[Table], *, telling: bool
) -> Iterator[Blank]:
    """Yield blanks for all numbers of a gear that the worksheet does not state.

    With `telling`, numbers that are 0 because of the gear-train layout are left out.
    """
    case, number = results.case, 0
    gear, signs = case.gears[index], told_signs(results.gear_at(index))
    speeds = [case.gear_input(gear), *(n for n, v in gear.speeds.items() if isinstance(v, float))]
    given_rows = {"speeds": {case.link_name(link) for link in speeds}}
    given_rows["slip_speeds"] = {element.name for element in case.elements_at(gear.slip)}
    given_rows["power_sign"] = {
        item.name for item, is_given in zip(case.mechanisms, signs, strict=True) if is_given
    }
    for item in wanted:
        zero = structural_zeros(item, results)[:, index].tolist()
        table = item.quantity.name
        for row, value, is_zero in zip(
            item.rows, item.values[:, index].tolist(), zero, strict=True
        ):
            if math.isnan(value) or row in given_rows.get(table, ()) or (telling and is_zero):
                continue
            number += 1
            is_one = item.quantity.rows == "one"
            yield Blank(number, table, None if is_one else row, item.quantity.kind(value))


def grids(sheet: GearExercise, *, solved: bool) -> Iterator[Grid]:
    """Yield the given data of the case, then the tables with blanks.

    Parameters
    ----------
    solved : bool
        True to show the numbers instead of blanks.
    """
    yield from given(sheet.results, sheet.place)
    for table in sheet.asked:
        blanks = [blank for blank in sheet.blanks if blank.table == table.quantity.name]
        yield _asked(table.quantity, blanks, solved=solved)


def _asked(quantity: Quantity, blanks: Sequence[Blank], *, solved: bool) -> Grid:
    def cell(blank: Blank) -> Cell:
        if not solved:
            return Cell(f"[{blank.number}] {LINE}")
        value = blank.value
        number = whole(value) if isinstance(value, int) else exact(value, quantity.decimals)
        return number._replace(text=f"[{blank.number}] {number.text}")

    if quantity.rows == "one":
        name = word(quantity.name.replace("_", " "))
        rows: list[Values] = [(name, cell(blank)) for blank in blanks]
        head = "quantity"
    else:
        rows = [(blank.row, cell(blank)) for blank in blanks]
        head = "torque of" if quantity.rows == "torques" else ROWS[quantity.rows].singular
    columns = [text(head), Column("value")]
    return grid_of(f"{quantity.title} [{quantity.name}]", columns, rows, key=quantity.name)
