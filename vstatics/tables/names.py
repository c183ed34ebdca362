"""Names that a person types: of a quantity, and of a row of its table."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from vstatics.errors import Place, Problem, ReadError, listed, nearest, quoted, typed_number
from vstatics.model.transmission import Transmission
from vstatics.statics.arrays import Rows, row_names
from vstatics.tables.quantities import BY_NAME
from vstatics.tables.quantity import Quantity
from vstatics.tables.rows import ROWS


def quantity_named(name: str, place: Place | None = None) -> Quantity:
    """The quantity of a name that was typed: that of the library, or its alias.

    Parameters
    ----------
    name : str
        Letter by letter.
    place : Place, optional
        Where it was typed, for the message.

    Raises
    ------
    ReadError
        If there is none; it names the nearest.

    Examples
    --------
    >>> quantity_named("ETA") is quantity_named("efficiency")
    True
    >>> quantity_named("AMLGP_Nm").name, quantity_named("Mx").name
    ('lossy_torques_Nm', 'output_torque')
    >>> quantity_named("ETa")
    Traceback (most recent call last):
    vstatics.errors.ReadError: there is no table `ETa`; did you mean `ETA`?
    """
    if name in BY_NAME:
        return BY_NAME[name]
    message = f"there is no table {quoted(name)}{nearest_quantity(name)}"
    raise ReadError([Problem(message, place=place)])


def nearest_quantity(name: str, others: Iterable[str] = ()) -> str:
    """A hint that names the nearest quantity, or one of other names, or nothing.

    >>> nearest_quantity("W_Nm"), nearest_quantity("ETA_kW"), nearest_quantity("speed")
    ('; did you mean `W_rpm`?', '; did you mean `ETA`?', '; did you mean `speeds`?')
    """
    relative = name.rpartition("_")[0]
    if relative not in BY_NAME:
        return nearest(name, [*BY_NAME, *others])
    unit = BY_NAME[relative].with_load
    return f"; did you mean `{relative}_{unit}`?" if unit else f"; did you mean `{relative}`?"


def row_named(name: str, kind: Rows, case: Transmission, place: Place | None = None) -> int:
    """The index of the row of a name that was typed, such as `P1.ring`.

    Parameters
    ----------
    name : str
        That of the row, or its number from 1, also as ``#1``; a mechanism or a drawn element
        alone stands for its only row.
    kind : str
        What the rows stand for: `Quantity.rows`.
    case : Transmission
    place : Place, optional
        Where it was typed, for the message.

    Raises
    ------
    ReadError
        If there is none, or more than one; it names the nearest, or all of them.

    Examples
    --------
    >>> from vstatics.model.transmission import Gear, Mechanism
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> row_named("D1", "torques", case), row_named("Mx", "torques", case)
    (0, 1)
    >>> row_named("mx", "torques", case)
    Traceback (most recent call last):
    vstatics.errors.ReadError: there is no device `mx`, expected one of D1, Mx; did you mean `Mx`?
    """
    found = rows_called(name, kind, case)
    if len(found) == 1:
        return found[0]
    names = row_names(case, kind)
    number = None if found else typed_number(name.removeprefix("#"), len(names))
    if number is not None:
        return number - 1
    message = several(name, found, names) if found else no_row(name, kind, names)
    raise ReadError([Problem(message, place=place)])


def rows_called(name: str, kind: Rows, case: Transmission) -> list[int]:
    """Indices of the rows of a name, or else of the drawn element of that name."""
    found = [index for index, row in enumerate(row_names(case, kind)) if row == name]
    return found or [index for index, owner in enumerate(_owners(kind, case)) if owner == name]


def _owners(kind: Rows, case: Transmission) -> list[str]:
    """To which drawn element each row belongs, if it has rows of this kind; "" for none."""
    own = case.own_devices
    if case.drawing is None:
        return []  # a mechanism is its own row
    if kind == "planets":
        return [device.name for device in own for _ in device.planets]
    if kind == "torques":
        members = [device.name for device in own for _ in device.members]
        return [*("" for _ in case.shift_elements), *members, ""]
    if kind == "meshes":
        return [device.name for device in own for _ in device.meshes_by_index]
    if kind == "mechanisms":
        return [device.name for device in own for _ in device.mechanisms]
    return []


def several(name: str, found: Sequence[int], names: Sequence[str], what: str = "rows") -> str:
    """What to say of a name that several rows have, or several rows of one device.

    >>> several("C1", [0, 2], ["C1", "B", "C1"])
    'there are two rows `C1`, expected #1 or #3'
    >>> several("P1", [0, 1], ["P1.sun", "P1.carrier"])
    '`P1` has the rows P1.sun, P1.carrier; expected one of them'
    """
    rows = [names[index] for index in found]
    if name in rows:
        numbers = " or ".join(f"#{index + 1}" for index in found)
        return f"there are two rows {quoted(name)}, expected {numbers}"
    return f"{quoted(name)} has the {what} {listed(rows, 20)}; expected one of them"


def no_row(name: str, kind: Rows, names: Sequence[str], hint: str = "") -> str:
    """What to say of a name that no row has; a better hint than the nearest name may be given."""
    known = f"there is no {ROWS[kind].one} {quoted(name)}, expected one of {listed(names)}"
    return known + (hint or nearest(name, names))
