"""Tables of the results by name, and their rows and gears by name or number."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from vstatics.errors import ReadError, nearest
from vstatics.model.transmission import Transmission
from vstatics.statics.results import ARRAYS, Rows
from vstatics.sweep.expressions.evaluation import Selection
from vstatics.sweep.expressions.operands import FUNCTIONS, Key, Table
from vstatics.sweep.expressions.source import Source, quoted
from vstatics.tables.rows import table_rows

ROW: Mapping[Rows, str] = {
    "links": "link",
    "elements": "shift element",
    "mechanisms": "mechanism",
    "torques": "device",
    "one": "gear",
}
"""What one row is called."""

_TOLD = 8


def select(table: Table, case: Transmission, source: Source) -> Selection:
    """Find the table, the row and the gear.

    Parameters
    ----------
    table : Table
        As it was read.
    case : Transmission
    source : Source
        The text, for messages.

    Raises
    ------
    ReadError
        If the case has no such thing; it names the nearest.

    Examples
    --------
    >>> from vstatics.model.transmission import Gear, Mechanism, Transmission
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear(), Gear()])
    >>> table = Table("losses", (Key("bare", "D1", 7), Key("all", ":", 11)), 0)
    >>> select(table, case, Source("losses[D1, :]", "--out"))
    Selection(table='losses', gear=None, row=0, has_rows=True)
    """
    if table.name not in ARRAYS:
        raise source.error(_no_table(table.name, case), table.at)
    kind, keys = ARRAYS[table.name].rows, list(table.keys or ())
    gears = [gear.name for gear in case.gears]
    row = None
    if kind != "one":
        rows = table_rows(table.name, case)
        if not rows:
            message = f"the case has no {ROW[kind]}s, so `{table.name}` is empty"
            raise source.error(message, table.at)
        if keys:
            row = _index(keys.pop(0), rows, kind, case, source)
    gear = _index(keys.pop(0), gears, "one", case, source) if keys else None
    if keys:
        parts = "[gear]" if kind == "one" else f"[{ROW[kind]}, gear]"
        message = f"read one part too many, expected {table.name}{parts}"
        raise source.error(message, keys[0].at)
    return Selection(table.name, gear, row, kind != "one")


def _index(
    key: Key, names: Sequence[str], kind: Rows, case: Transmission, source: Source
) -> int | None:
    """The index that a key stands for: by its name first, then by its number; None for all."""
    if key.kind == "all":
        return None
    if key.kind != "number" and key.text in names:
        if names.count(key.text) > 1:
            numbers = [f"#{n}" for n, name in enumerate(names, 1) if name == key.text]
            message = f"there are two rows {quoted(key.text)}, expected {' or '.join(numbers)}"
            raise source.error(message, key.at)
        return names.index(key.text)
    digits = key.text.lstrip("0")
    number = int(digits) if key.kind != "quoted" and digits.isdigit() and len(digits) < 9 else 0
    if key.kind != "quoted" and key.text.isascii() and 0 < number <= len(names):
        return number - 1
    raise _unknown(key, names, kind, case, source)


def _unknown(
    key: Key, names: Sequence[str], kind: Rows, case: Transmission, source: Source
) -> ReadError:
    """An error about a row or gear that there is not."""
    what = ROW[kind]
    if key.kind == "number":
        message = f"read `#{key.text}`, expected the number of a {what}, #1 to #{len(names)}"
        return source.error(message, key.at)
    hint = nearest(key.text, names)
    if kind != "one" and key.text in [gear.name for gear in case.gears]:
        hint = f"; a gear goes in the second place: [:,{source.text[key.at :][: len(key.text)]}]"
    known = ", ".join(names[:_TOLD]) + (", ..." if len(names) > _TOLD else "")
    message = f"there is no {what} {quoted(key.text)}, expected one of {known}{hint}"
    return source.error(message, key.at)


def _no_table(name: str, case: Transmission) -> str:
    """What to say of a name that is no table."""
    if name in [mechanism.name for mechanism in case.mechanisms]:
        hint = f"; `{name}` is a mechanism: {name}.ratio, or in brackets as in losses[{name}]"
    elif name in case.link_names:
        hint = f"; `{name}` is a link: in brackets, as in speeds[{name}]"
    elif name in [element.name for element in case.shift_elements]:
        hint = f"; `{name}` is a shift element: in brackets, as in torques[{name}]"
    else:
        hint = nearest(name, [*ARRAYS, *FUNCTIONS]) or "; such as ratio, efficiency, speeds[C1]"
    return f"there is no table {quoted(name)}{hint}"
