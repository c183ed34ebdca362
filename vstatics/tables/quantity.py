"""What is declared of a quantity of the results, and its table; all are in `quantities`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal, NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.statics.arrays import ARRAYS, Rows
from vstatics.statics.results import Language, Results

KINDS: dict[type, type] = {np.float64: float, np.int16: int, np.bool_: bool}
"""How the numbers of an array are written."""


class Phrase(NamedTuple):
    """A text in the languages of a listing; headings are without their colon."""

    en: str
    ru: str

    def text(self, lang: Language) -> str:
        """The text in one of them."""
        return self.ru if lang == "ru" else self.en


class Quantity(NamedTuple):
    """A quantity as every format shows it."""

    name: str
    """In the library: that of an array or another attribute of `Results`, if it is one."""
    key: str
    """In JSON and CSV, one of the other two: the deck's, or that of the library."""
    alias: str
    """The deck's name, or one of its kind where the deck has none."""
    heading: Phrase
    """In a listing."""
    own_title: str = ""
    """In a report, where it is not the English heading."""
    members: tuple[Phrase, Phrase] | None = None
    """Over the second part of a printed table of torques: of mechanisms and the output, and
    of what a drawn case has in place of them. None: the table has one part."""
    own_rows: Rows | None = None
    """Where it is no array of `Results`."""
    is_sign: bool = False
    """Whether it is +1, 0 or -1; its array is one of floats, for what does not exist."""
    columns: Literal["gears", "devices"] = "gears"
    published: bool = False
    """Whether the report of the source has it."""
    exists: Callable[[Results], bool] | None = None
    """Whether a case has what it speaks of; None: every case has."""
    decimals: int = 3
    """In a report."""
    with_load: str = ""
    """The unit in which it is shown, too, where the case has a load."""
    brief: Phrase | None = None
    """Over the table in that unit, instead of the heading."""
    unit: str = ""
    """Of its numbers; empty: relative to the input."""
    of: str = ""
    """The relative quantity that this one is in `unit`."""

    @property
    def printed(self) -> str:
        """The name in a listing."""
        return self.alias.replace("_", "").upper()

    @property
    def title(self) -> str:
        """In a report."""
        return self.own_title or self.heading.en

    @property
    def rows(self) -> Rows:
        """What a row of its table stands for; `one` is a list over the gears."""
        return self.own_rows or ARRAYS[self.name].rows

    @property
    def kind(self) -> type:
        """How a number is written: float, int or bool."""
        if self.is_sign:
            return int
        return KINDS[ARRAYS[self.name].dtype] if self.name in ARRAYS else float

    @property
    def always(self) -> bool:
        """Whether every result has it."""
        return self.exists is None and not self.unit


class Table(NamedTuple):
    """A quantity of a case: rows are links, devices or mechanisms, columns are gears.

    Columns of the distribution matrix are devices. A list over gears is a table of one row.
    """

    quantity: Quantity
    rows: Sequence[str]
    columns: Sequence[str]
    values: Floats
    """(rows, columns), NaN for what does not exist."""


class _Unit(NamedTuple):
    """A unit as headings write it, and the decimals of a report."""

    en: str
    ru: str
    decimals: int


UNITS = {
    "rpm": _Unit("rpm", "об/мин", 1),
    "Nm": _Unit("N*m", "Н*м", 1),
    "kW": _Unit("kW", "кВт", 3),
}
"""What numbers have with a load, as it stands at the end of a key."""


def headed(name: str, unit: str) -> str:
    """What heads a column of numbers in a unit; an empty one: relative to the input.

    >>> headed("slip", "rpm"), headed("torque", "Nm"), headed("slip", "")
    ('slip, rpm', 'torque, N*m', 'slip')
    """
    return f"{name}, {UNITS[unit].en}" if unit else name


def in_unit(quantity: Quantity) -> Quantity:
    """A relative quantity in the unit that it has with a load.

    Examples
    --------
    >>> from vstatics.tables.quantities import BY_NAME
    >>> slip = in_unit(BY_NAME["slip_speeds"])
    >>> slip.name, slip.alias, slip.printed, slip.heading.en
    ('slip_speeds_rpm', 'WFRI_rpm', 'WFRIRPM', 'Slip speeds of clutches and brakes, rpm')
    """
    unit = quantity.with_load
    written = UNITS[unit]
    heading = quantity.brief or quantity.heading
    return Quantity(
        f"{quantity.name}_{unit}",
        f"{quantity.key}_{unit}",
        f"{quantity.alias}_{unit}",
        Phrase(f"{heading.en}, {written.en}", f"{heading.ru}, {written.ru}"),
        own_rows=quantity.rows,
        exists=quantity.exists,
        decimals=written.decimals,
        unit=unit,
        of=quantity.name,
    )
