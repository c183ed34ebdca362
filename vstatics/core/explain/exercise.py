"""A gear as an exercise: its numbers left blank, and the same with numbers."""

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

ASKED = ("W", "WSAT", "WFRI", "ratio", "AMLG", "IX", "AMLGP", "losses", "ETA")
"""Tables whose numbers are asked for, in the order in which they are calculated."""
IN_UNITS = {"AMLG": "AMLG_Nm", "AMLGP": "AMLGP_Nm", "losses": "losses_kW"}
"""Tables that have numbers where torques and powers relate to nothing."""
MORE = ("power_balance",)
"""One that is asked for, too, where these have less than `LEAST` numbers."""
LEAST = 10
NAMES = {"ratio": "ratio", "ETA": "efficiency", "power_balance": "power balance"}
"""What the only number of a table is called."""
LINE = "____"
SheetForm = Literal["text", "markdown", "latex"]


class Blank(NamedTuple):
    """A number that is asked for."""

    number: int
    """From 1."""
    table: str
    """Its key in the JSON of a result."""
    row: str | None
    """Of the table; None where it has one number for each gear."""
    value: Known
    """As it is there."""


class SolvedExercise(NamedTuple):
    """What an exercise has been solved to."""

    case: Mapping[str, Any]
    """As a file has it, so that it can be run."""
    gear: str
    seed: int | None
    blanks: Sequence[Blank]


@refusing()
def exercise(results: Results, gear: int | str, *, seed: int | None = None) -> GearExercise:
    """A gear whose numbers are asked for: with blanks, and with its solution.

    Parameters
    ----------
    results : Results
        Of one case.
    gear : int or str
        Its number from 1, or its name.
    seed : int, optional
        With other teeth, which can be assembled, ratios, and capacities of the same margins; the
        same of the same number, which is 0 or more.

    Returns
    -------
    GearExercise
        `blanks` with their numbers as in the JSON of a result; `worksheet` and `solution` write
        it as text, Markdown or LaTeX; `document` is the solution as plain data.

    Raises
    ------
    ValueError
        If there is no such gear, the seed is below 0, or the results are of arrays of variants.
    CaseError
        If the gear has no numbers.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> made = exercise(solve(case), "1")
    >>> "[2] ____" in made.worksheet(), "[2] .286" in made.solution()
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
    """A gear whose numbers are asked for."""

    results: Results
    place: int
    """Of the gear, from 0."""
    seed: int | None
    """By which its numbers were drawn."""
    asked: Sequence[Table]
    """The tables that have a blank."""
    blanks: Sequence[Blank]
    unchanged: Sequence[str] = ()
    """What keeps its numbers, although others were drawn."""

    @property
    def gear(self) -> str:
        """Its name."""
        return self.results.case.gears[self.place].name

    def titles(self, file: str = "") -> list[str]:
        """What stands over it: the case, or its file; the seed finds sheet and solution."""
        kept = tr("; as before: {names}", names=", ".join(self.unchanged)) if self.unchanged else ""
        seed = "" if self.seed is None else f" (--seed {self.seed}{kept})"
        return [f"{self.results.case.name or file}{seed}"]

    @refusing()
    def worksheet(self, form: SheetForm = "text", *, lang: Language = "en") -> str:
        """The exercise with blanks, as text, Markdown or LaTeX."""
        return self._written(form, lang, solved=False)

    @refusing()
    def solution(self, form: SheetForm = "text", *, lang: Language = "en") -> str:
        """The same with its numbers."""
        return self._written(form, lang, solved=True)

    def _written(self, form: SheetForm, lang: Language, *, solved: bool) -> str:
        writer = import_module(f"vstatics.core.tables.{form}")
        with speaking(lang):
            made: str = writer.write(self.titles(), grids(self, solved=solved))
        return made

    def __repr__(self) -> str:
        """Of which gear, and how many blanks; not all its results."""
        seed = "" if self.seed is None else f", seed {self.seed}"
        return f"<GearExercise {self.gear!r}: {len(self.blanks)} blanks{seed}>"

    def _repr_html_(self) -> str:
        """The exercise with blanks, for a notebook."""
        return shown(grids(self, solved=False))

    def document(self) -> dict[str, Any]:
        """The solution as plain data; `case` is a case that can be run."""
        case = result_json.document(self.results)["case"]
        solved = SolvedExercise(case, self.gear, self.seed, self.blanks)
        made: dict[str, Any] = plain_data(solved)
        return made


def worksheet(
    results: Results, index: int, seed: int | None = None, unchanged: Sequence[str] = ()
) -> GearExercise:
    """The exercise of a gear of one case.

    Given speeds are not asked for, nor signs that are told; nor what the scheme makes 0, unless
    there is little else.

    Parameters
    ----------
    index : int
        Of the gear, from 0.
    seed : int, optional
        By which numbers of the case were drawn.
    unchanged : sequence of str
        What kept its numbers then.

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
    Blank(number=2, table='W', row='3', value=0.2857142857142857)
    """
    by_key = {one.quantity.key: one for one in tables(results)}
    case = results.case
    no_torque = not case.input_torque(case.gears[index])
    if results.locked[index]:  # no sign agrees with the losses
        del by_key["IX"]
    wanted = [by_key[key] for key in asked_keys(no_torque=no_torque) if key in by_key]
    found = list(_blanks(results, index, wanted, telling=True))
    if len(found) < LEAST:
        wanted += [by_key[key] for key in MORE if not no_torque]
        found = list(_blanks(results, index, wanted, telling=False))
    if not found:
        gear = case.gears[index].name
        raise CaseError("E910", f"gear {gear} has no numbers to ask for; ask for another gear")
    keys = {one.table for one in found}
    asked = [one for one in wanted if one.quantity.key in keys]
    return GearExercise(results, index, seed, asked, found, unchanged)


def asked_keys(*, no_torque: bool) -> Iterator[str]:
    """Those of `ASKED`; of a gear without torque at its input such as do not relate to it."""
    for key in ASKED:
        yield IN_UNITS.get(key, key) if no_torque else key


def _blanks(
    results: Results, index: int, wanted: Sequence[Table], *, telling: bool
) -> Iterator[Blank]:
    """The numbers of a gear that are not given; those alone that tell something, if so."""
    case, number = results.case, 0
    gear, signs = case.gears[index], told_signs(results.gear_at(index))
    speeds = [case.gear_input(gear), *(n for n, v in gear.speeds.items() if isinstance(v, float))]
    told = {"W": {case.link_name(link) for link in speeds}}
    told["IX"] = {one.name for one, is_told in zip(case.mechanisms, signs, strict=True) if is_told}
    for one in wanted:
        zero = structural_zeros(one, results)[:, index].tolist()
        key = one.quantity.key
        for row, value, is_zero in zip(one.rows, one.values[:, index].tolist(), zero, strict=True):
            if math.isnan(value) or row in told.get(key, ()) or (telling and is_zero):
                continue
            number += 1
            is_one = one.quantity.rows == "one"
            yield Blank(number, key, None if is_one else row, one.quantity.kind(value))


def grids(sheet: GearExercise, *, solved: bool) -> Iterator[Grid]:
    """What is given of the case, then the tables with their blanks.

    Parameters
    ----------
    solved : bool
        Whether the numbers stand in them.
    """
    yield from given(sheet.results, sheet.place)
    for one in sheet.asked:
        own = [blank for blank in sheet.blanks if blank.table == one.quantity.key]
        yield _asked(one.quantity, own, solved=solved)


def _asked(quantity: Quantity, blanks: Sequence[Blank], *, solved: bool) -> Grid:
    def cell(blank: Blank) -> Cell:
        if not solved:
            return Cell(f"[{blank.number}] {LINE}")
        value = blank.value
        number = whole(value) if isinstance(value, int) else exact(value, quantity.decimals)
        return number._replace(text=f"[{blank.number}] {number.text}")

    if quantity.rows == "one":
        name = word(NAMES.get(quantity.key, quantity.title))
        rows: list[Values] = [(name, cell(blank)) for blank in blanks]
        head = "quantity"
    else:
        rows = [(blank.row, cell(blank)) for blank in blanks]
        head = "torque of" if quantity.rows == "torques" else ROWS[quantity.rows].one
    columns = [text(head), Column("value")]
    return grid_of(f"{quantity.title} [{quantity.key}]", columns, rows, key=quantity.key)
