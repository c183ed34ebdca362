"""A drawing -> the transmission that the solver knows: mechanisms, and planets as links."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from vstatics.elements.drawing import Drawing
from vstatics.elements.lower import parts
from vstatics.model.transmission import Transmission


def lowered(drawing: Drawing, link_names: Sequence[str]) -> dict[str, Any]:
    """The arguments of `Transmission` that follow from a drawing.

    Parameters
    ----------
    drawing : Drawing
    link_names : sequence of str
        Of the case's own links; their numbers when empty.
    """
    drawn = parts(drawing)
    names = list(link_names) or [str(number) for number in range(1, drawing.links + 1)]
    names += [f"{part.name}.{planet}" for part in drawn for planet in part.planet_links]
    return {
        "links": len(names),
        "link_names": names,
        "mechanisms": [lowered.mechanism for part in drawn for lowered in part.lowered],
        "drawing": drawing,
    }


def transmission(
    drawing: Drawing, *, link_names: Sequence[str] = (), **others: Any
) -> Transmission:
    """The transmission of a drawing.

    Parameters
    ----------
    drawing : Drawing
    link_names : sequence of str, optional
        Of the case's own links.
    **others
        Further arguments of `Transmission`: shift elements, gears, input, output, ...

    Raises
    ------
    CaseError
        With everything that is wrong with the elements or with the rest.

    Examples
    --------
    >>> from vstatics.elements import Element
    >>> from vstatics.model.transmission import Gear, ShiftElement
    >>> from vstatics.statics.solve import solve
    >>> sets = Element("P", "planetary", {"sun": 1, "ring": 2, "carrier": 3},
    ...                {"sun": 30, "ring": 75})
    >>> case = transmission(Drawing(3, [sets]), shift_elements=[ShiftElement(2)],
    ...                     gears=[Gear([1])])
    >>> solve(case).ratio
    array([3.5])
    """
    from vstatics.elements.checks import problems
    from vstatics.errors import CaseError

    errors = list(problems(drawing))
    if errors:
        raise CaseError(errors)
    output = others.pop("output", 0) or drawing.links
    return Transmission(output=output, **lowered(drawing, link_names), **others)
