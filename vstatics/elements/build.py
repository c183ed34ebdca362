"""A drawing -> the transmission that the solver knows: mechanisms, and planets as links."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from vstatics.elements.drawing import Drawing
from vstatics.model.transmission import ShiftElement, Transmission


def transmission(
    drawing: Drawing,
    *,
    shift_elements: Sequence[ShiftElement] = (),
    link_names: Sequence[str] = (),
    **others: Any,
) -> Transmission:
    """The transmission of a drawing.

    Parameters
    ----------
    drawing : Drawing
    shift_elements : sequence of ShiftElement, optional
    link_names : sequence of str, optional
        Of the case's own links.
    **others
        Further arguments of `Transmission`: gears, input, output, ...

    Raises
    ------
    CaseError
        With everything that is wrong with the elements or with the rest.

    Examples
    --------
    >>> from vstatics.elements import Element
    >>> from vstatics.model.transmission import Gear
    >>> from vstatics.statics.solve import solve
    >>> sets = Element("P", "planetary", {"sun": 1, "ring": 2, "carrier": 3},
    ...                {"sun": 30, "ring": 75})
    >>> case = transmission(Drawing(3, [sets]), shift_elements=[ShiftElement(2)],
    ...                     gears=[Gear([1])])
    >>> solve(case).ratio
    array([3.5])
    """
    return Transmission(
        drawing.links, shift_elements, (), link_names=link_names, drawing=drawing, **others
    )
