"""Results by names: an array, its row, its number in a gear."""

from __future__ import annotations

from typing import Any

from vstatics.errors import ReadError
from vstatics.statics.matrix import distribution_matrix
from vstatics.statics.results import Results
from vstatics.tables.names import quantity_named, row_named

ALL = slice(None)
"""As in ``results["speeds", :, "low"]``."""


def by_name(results: Results, key: Any) -> Any:
    """What ``results[key]`` is: by names, else what a tuple has there.

    Parameters
    ----------
    key : str or tuple
        The name of a table, or its alias; then a row, where the table has rows; then a gear
        by its name or number: ``"ratio"``, ``("ratio", "low")``, ``("speeds", "ring")``,
        ``("speeds", "ring", "low")``; ``:`` stands for all rows or gears.

    Returns
    -------
    ndarray or float
        Leading axes are variants, then gears and rows, as far as no name chooses one.

    Raises
    ------
    ValueError
        If there is no such table, row or gear, with the nearest.

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
    name, *chosen = key if isinstance(key, tuple) else (key,)
    if not isinstance(name, str):
        return tuple.__getitem__(results, key)
    try:
        return _chosen(results, name, chosen)
    except ReadError as error:  # nothing was read from a file
        raise ValueError(str(error)) from None


def _chosen(results: Results, name: str, chosen: list[Any]) -> Any:
    """A table, of which a row and a gear may be chosen."""
    quantity = quantity_named(name)
    if quantity.columns == "devices":
        array, wanted = distribution_matrix(results.case), "its name: it is of no gear"
    elif quantity.rows == "one":
        array, wanted = results.existing(quantity.name), "(table, gear)"
    else:
        array, wanted = results.existing(quantity.name), "(table, row, gear)"
        row = chosen.pop(0) if chosen else ALL
        if row in (ALL, ":"):
            gear = chosen.pop(0) if chosen else ALL
            array = array if gear in (ALL, ":") else array[..., _gear(results, gear), :]
        else:
            array = array[..., row_named(str(row), quantity.rows, results.case)]
    if chosen and quantity.columns == "gears":
        gear = chosen.pop(0)
        array = array if gear in (ALL, ":") else array[..., _gear(results, gear)]
    if chosen:
        raise ValueError(f"read {chosen[0]!r} too many, expected no more than {wanted}")
    return array if getattr(array, "ndim", 0) else array.item()


def _gear(results: Results, gear: Any) -> int:
    return results.case.gear_number(gear) - 1
