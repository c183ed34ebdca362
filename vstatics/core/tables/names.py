"""Names of quantities and rows: as the program writes them and as users type them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, cast

from vstatics.core.arguments import type_and_value
from vstatics.core.errors import ReadError, listed, quoted, typed_number
from vstatics.core.model.paths import in_quotes
from vstatics.core.model.transmission import Transmission
from vstatics.core.start import NamedTuple
from vstatics.core.statics.matrix import structural_matrix
from vstatics.core.statics.result_arrays import Rows, row_names
from vstatics.core.statics.results import Results
from vstatics.core.suggestions import nearest
from vstatics.core.tables.quantities import BY_NAME, Quantity


def quantity_named(name: str) -> Quantity:
    """Return the quantity that a name or deck name means.

    Parameters
    ----------
    name : str
        Name or deck name, in which upper and lower case matter.

    Raises
    ------
    ReadError
        If no quantity has the name; the message suggests the nearest name.

    Examples
    --------
    >>> quantity_named("ETA") is quantity_named("efficiency")
    True
    >>> quantity_named("AMLGP_Nm").name, quantity_named("Mx").name
    ('lossy_torques_Nm', 'output_torque')
    >>> quantity_named("ETa")
    Traceback (most recent call last):
    vstatics.core.errors.ReadError: there is no table `ETa`; did you mean `ETA`? [E113]
    """
    if name in BY_NAME:
        return BY_NAME[name]
    raise ReadError("E113", f"there is no table {quoted(name)}{nearest_quantity(name)}")


def plain_name(name: str) -> str:
    """Return the output name of a quantity for a name or deck name; other texts do not change.

    >>> plain_name("ETA"), plain_name("efficiency"), plain_name("eta")
    ('efficiency', 'efficiency', 'eta')
    """
    return BY_NAME[name].name if name in BY_NAME else name


def plain_names(text: str) -> str:
    """Return a formula or heading with output names of quantities instead of deck names.

    Texts in quotes or brackets, and names with a point, do not change.

    >>> plain_names("ETA[low]"), plain_names('max(W["ETA",:]) - W.ratio')
    ('efficiency[low]', 'max(speeds["ETA",:]) - W.ratio')
    """
    return re.sub(_IN_FORMULA, lambda match: plain_name(match[0]), text)


def nearest_quantity(name: str, others: Iterable[str] = ()) -> str:
    """Return a hint with the most similar quantity or other name; empty if no name is similar.

    Deck names, which are in upper case, are only suggested for names with upper-case letters.

    >>> nearest_quantity("slips")
    '; did you mean `slip_speeds`?'
    >>> nearest_quantity("W_Nm"), nearest_quantity("ETA_kW"), nearest_quantity("speed")
    ('; did you mean `W_rpm`?', '; did you mean `ETA`?', '; did you mean `speeds`?')
    """
    relative = name.rpartition("_")[0]
    if relative not in BY_NAME:
        known = [*BY_NAME, *others]
        in_lower_case = nearest(name, filter(str.islower, known)) if name.islower() else ""
        return in_lower_case or nearest(name, known)
    unit = BY_NAME[relative].with_load
    return f"; did you mean `{relative}_{unit}`?" if unit else f"; did you mean `{relative}`?"


def row_named(name: str, kind: Rows, case: Transmission) -> int:
    """Return the index of the row that a name such as `P1.ring` means.

    Parameters
    ----------
    name : str
        Name of the row, or its number from 1, also as ``#1``. If a mechanism or drawn gear set has
        only one row, its name is sufficient.
    kind : str
        Kind of the rows, `Quantity.rows`.
    case : Transmission

    Raises
    ------
    ReadError
        If no row or several rows have the name; the message lists the possible names.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> row_named("D1", "torques", case), row_named("Mx", "torques", case)
    (0, 1)
    >>> row_named("qq", "torques", case)
    Traceback (most recent call last):
    vstatics.core.errors.ReadError: there is no component `qq`, expected one of D1, Mx [E114]
    """
    indices = rows_called(name, kind, case)
    if len(indices) == 1:
        return indices[0]
    names = row_names(case, kind)
    number = None if indices else typed_number(name.removeprefix("#"), len(names))
    if number is not None:
        return number - 1
    message = several(name, indices, names) if indices else no_row(name, kind, names)
    raise ReadError("E114", message)


def rows_called(name: str, kind: Rows, case: Transmission) -> list[int]:
    """Return the indices of the rows called `name`; if none, of the rows of the gear set `name`."""
    indices = [index for index, row in enumerate(row_names(case, kind)) if row == name]
    return indices or [index for index, owner in enumerate(_owners(kind, case)) if owner == name]


def _owners(kind: Rows, case: Transmission) -> list[str]:
    """Return for each row the name of its drawn gear set, or ""; empty if not needed."""
    devices = case.own_devices
    if case.drawing is None:
        return []  # rows are mechanisms with their own names
    if kind == "planets":
        return [device.name for device in devices for _ in device.planets]
    if kind == "torques":
        members = [device.name for device in devices for _ in device.members]
        return [*("" for _ in case.shift_elements), *members, ""]
    if kind == "meshes":
        return [device.name for device in devices for _ in device.meshes_by_index]
    if kind == "mechanisms":
        return [device.name for device in devices for _ in device.mechanisms]
    return []


def several(name: str, indices: Sequence[int], names: Sequence[str], what: str = "rows") -> str:
    """Return the message that several rows have the same name.

    >>> several("C1", [0, 2], ["C1", "B", "C1"])
    'there are two rows `C1`, expected #1 or #3'
    >>> several("P1", [0, 1], ["P1.sun", "P1.carrier"])
    '`P1` has the rows P1.sun, P1.carrier; expected one of them'
    """
    rows = [names[index] for index in indices]
    if name in rows:
        numbers = " or ".join(f"#{index + 1}" for index in indices)
        return f"there are two rows {quoted(name)}, expected {numbers}"
    return f"{quoted(name)} has the {what} {listed(rows, 20)}; expected one of them"


def no_row(name: str, kind: Rows, names: Sequence[str], hint: str = "") -> str:
    """Return the message that no row has a name, with `hint` or the most similar name."""
    known = f"there is no {ROWS[kind].singular} {quoted(name)}, expected one of {listed(names)}"
    return known + (hint or nearest(name, names))


NAME = re.compile(r"[^\W\d]\w*")
"""Pattern of a name that is a plain word."""
DOTTED = rf"{NAME.pattern}(?:\.\w+)*"
"""Pattern of a name that needs no quotes in brackets, such as `P1.ring`."""
_QUOTED = r"\"[^\"]*\"|'[^']*'"
_IN_FORMULA = rf"{_QUOTED}|\[(?:{_QUOTED}|[^\]\"'])*\]|[\w.]+"
"""Pattern of an item in a formula: text in quotes or brackets, or name or number with points."""
BEFORE_NAME = "|"
"""Character that precedes the name of a row in a listing."""


class RowWords(NamedTuple):
    """Words for a kind of row, for headings and messages."""

    singular: str
    all: str
    size: str
    """Field of a deck that contains the number of rows."""


ROWS: Mapping[Rows, RowWords] = {
    "links": RowWords("link", "links", "KJG"),
    "planets": RowWords("planet", "mechanisms", "KG"),
    "elements": RowWords("shift element", "shift elements", "KL"),
    "devices": RowWords("mechanism", "mechanisms", "KG"),
    "mechanisms": RowWords("mechanism", "mechanisms", "KG"),
    "torques": RowWords("component", "shift elements, then mechanisms, then the output", "KLG1"),
    "meshes": RowWords("mesh", "meshes", "KM"),
    "converters": RowWords("converter", "converters", "KT"),
    "one": RowWords("gear", "gears", "NP"),
}
"""Words for each kind of row."""


def table_rows(name: str, case: Transmission) -> Sequence[str]:
    """Return the names of the rows of a table; empty for a table with a value per gear.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism, Transmission
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> list(table_rows("torques", case)), list(table_rows("ratio", case))
    (['D1', 'Mx'], [])
    """
    return row_names(case, BY_NAME[name].rows)


def written(index: int, names: Sequence[str]) -> str:
    """Return an unambiguous text by which users select a row or gear in brackets.

    >>> [written(index, ["C1", "4-5", "C1"]) for index in range(3)]
    ['#1', '"4-5"', '#3']
    """
    name = names[index]
    if names.count(name) > 1 or ('"' in name and "'" in name):
        return f"#{index + 1}"
    return name if is_bare(name) else in_quotes(name)


def is_bare(name: str) -> bool:
    """Return whether a name needs no quotes in brackets.

    >>> is_bare("вал"), is_bare("P1.ring"), is_bare("2"), is_bare("1R"), is_bare("4-5")
    (True, True, True, False, False)
    """
    return bool(re.fullmatch(rf"{DOTTED}|[0-9]+", name))


ALL = slice(None)
"""Selection of all rows or gears, as in ``results["speeds", :, "low"]``."""


def by_name(results: Results, key: Any) -> Any:
    """Return ``results[key]``, the values selected by names.

    Parameters
    ----------
    results : Results
    key : str or tuple
        Name or deck name of a table, then a row (if the table has rows), then the name or number of
        a gear: ``"ratio"``, ``("ratio", "low")``, ``("speeds", "ring")``, ``("speeds", "ring",
        "low")``. ``:`` selects all rows or gears.

    Returns
    -------
    ndarray or float
        Values with the axes of variants, gears and rows, without axes of a selected gear or row.

    Raises
    ------
    ValueError
        If the table, row or gear does not exist; the message suggests the nearest name.
    TypeError
        If the first part of the key is not a name.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])],
    ...                     link_names=["sun", "ring", "carrier"])
    >>> results = solve(case)
    >>> by_name(results, "W").tolist(), by_name(results, ("W", "ring")).tolist()
    ([[1.0, 0.0, 0.2857142857142857]], [0.0])
    >>> by_name(results, ("ratio", 1)), by_name(results, ("speeds", "carrier", "1"))
    (3.5, 0.2857142857142857)
    """
    name, *selection = key if isinstance(key, tuple) else (key,)
    if isinstance(key, int | slice):
        return tuple.__getitem__(cast("tuple[Any, ...]", results), key)
    if not isinstance(name, str):
        expected = "expected the name of a table, then perhaps of a row and of a gear"
        raise TypeError(f"results of {type_and_value(name)}: {expected}")
    try:
        return _selected(results, name, selection)
    except ReadError as error:  # names in Python code do not have a place in a file
        raise ValueError(str(error)) from None


def _selected(results: Results, name: str, selection: list[Any]) -> Any:
    """Return a table, or the values selected by the names of row and gear."""
    quantity = quantity_named(name)
    if quantity.columns == "devices":
        array, wanted = structural_matrix(results.case), "its name, because it has no gears"
    else:
        array, wanted = results.existing(quantity.name), "(table, gear)"
        indices: list[Any] = []
        if quantity.rows != "one":
            wanted = "(table, row, gear)"
            row = selection.pop(0) if selection else ALL
            is_name = row not in (ALL, ":")
            indices = [row_named(str(row), quantity.rows, results.case) if is_name else ALL]
        gear: Any = selection.pop(0) if selection else ALL
        indices.insert(0, ALL if gear in (ALL, ":") else results.case.gear_number(gear) - 1)
        array = array[(..., *indices)]
    if selection:
        raise ValueError(f"read {selection[0]!r} too many, expected no more than {wanted}")
    return array if getattr(array, "ndim", 0) else array.item()
