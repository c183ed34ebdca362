"""A case with the ratios that a fit has found."""

from __future__ import annotations

from collections.abc import Mapping

from vstatics.elements.drawing import drawing_of
from vstatics.explain.bodies import on_own_links
from vstatics.model.transmission import Transmission
from vstatics.summary.design import is_same


def fitted_case(case: Transmission, ratios: Mapping[str, float]) -> Transmission:
    """The case with other ratios of its mechanisms.

    A drawn element has teeth, and no other ratio: it becomes its mechanisms, without planets as
    links. The ratio of a planet is left out where that of its mechanism is another.

    Parameters
    ----------
    case : Transmission
    ratios : mapping of str to float
        By mechanism, as a `Fit` has them. [-]

    Examples
    --------
    >>> from vstatics.model.transmission import Gear, Mechanism
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5, name="set")], [Gear()])
    >>> fitted_case(case, {"set": -3.0}).mechanisms[0].ratio
    -3.0
    """
    plain = on_own_links(case).case
    mechanisms = [
        one
        if is_same(one.ratio, ratios[one.name])
        else one._replace(ratio=ratios[one.name], planet_ratio=None)
        for one in plain.mechanisms
    ]
    return plain.replace(mechanisms=mechanisms, description="", source="")


def lost_by_fit(case: Transmission) -> list[str]:
    """What a fitted case does not have of its case."""
    drawing = drawing_of(case)
    if drawing is None:
        return []
    masses = [element.name for element in drawing.elements if element.planet_masses]
    return [f"the masses of the planets of {name}" for name in masses]
