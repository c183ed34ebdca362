"""Results by names: an array, its row, its number in a gear."""

from __future__ import annotations

from typing import Any

from vstatics.statics.matrix import distribution_matrix
from vstatics.statics.results import Results
from vstatics.tables.names import quantity_named, row_named


def part(results: Results, key: Any) -> Any:
    """What ``results[key]`` is: by names, else what a tuple has there.

    Parameters
    ----------
    key : str or tuple
        The name of a table, or its alias; then a row, where the table has rows; then a gear
        by its name or number: ``"ratio"``, ``("ratio", "low")``, ``("speeds", "ring")``,
        ``("speeds", "ring", "low")``.

    Returns
    -------
    ndarray or float
        Leading axes are variants, then gears and rows, as far as no name chooses one.

    Raises
    ------
    ReadError
        If there is no such table or row, with the nearest.
    ValueError
        If there is no such gear.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])],
    ...                     link_names=["sun", "ring", "carrier"])
    >>> results = solve(case)
    >>> part(results, "W").tolist(), part(results, ("W", "ring")).tolist()
    ([[1.0, 0.0, 0.2857142857142857]], [0.0])
    >>> part(results, ("ratio", 1)), part(results, ("speeds", "carrier", "1"))
    (3.5, 0.2857142857142857)
    """
    name, *chosen = key if isinstance(key, tuple) else (key,)
    if not isinstance(name, str):
        return tuple.__getitem__(results, key)
    quantity = quantity_named(name)
    if quantity.columns == "devices":
        array, wanted = distribution_matrix(results.case), "its name: it is of no gear"
    elif quantity.rows == "one":
        array, wanted = getattr(results, quantity.name), "(table, gear)"
    else:
        array, wanted = getattr(results, quantity.name), "(table, row, gear)"
        if chosen:
            array = array[..., row_named(str(chosen.pop(0)), quantity.rows, results.case)]
    if chosen and quantity.columns == "gears":
        array = array[..., results.case.gear_number(chosen.pop(0)) - 1]
    if chosen:
        raise ValueError(f"read {key!r}, expected no more than {wanted}")
    return array if getattr(array, "ndim", 0) else array.item()
