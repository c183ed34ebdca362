"""A case with the ratios that a fit has found."""

from __future__ import annotations

from collections.abc import Mapping

from vstatics.elements.drawing import drawing_of
from vstatics.errors import listed
from vstatics.explain.bodies import on_own_links
from vstatics.model.transmission import HOUSING, Mechanism, Transmission
from vstatics.summary.design_table import is_same


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


def left_out_by_fit(case: Transmission, ratios: Mapping[str, float]) -> list[str]:
    """What a fitted case can't tell of planets, in words.

    A planet ratio follows from that of the mechanism in a plain set only. Nothing is lost where
    that was so before.

    Parameters
    ----------
    case : Transmission
    ratios : mapping of str to float
        By mechanism, as a `Fit` has them. [-]

    Examples
    --------
    >>> from vstatics.model.transmission import Gear, Mechanism
    >>> meshed = Mechanism(1, 2, 3, 2.5, planet_ratio=-0.6, name="set")
    >>> case = Transmission(3, [], [meshed], [Gear()])
    >>> left_out_by_fit(case, {"set": 2.5}), left_out_by_fit(case, {"set": 2.7})
    ([], ['planet speeds of set: with these ratios no planet ratio is known'])
    """
    own = on_own_links(case)
    after = fitted_case(case, ratios).mechanisms
    unknown, plain = [], []
    for index, (old, new) in enumerate(zip(own.case.mechanisms, after, strict=True)):
        if new.third == HOUSING or own.is_fixed(index):
            continue
        if not _has_planet(new):
            if _has_planet(old) or case.drawing is not None:
                unknown.append(new.name)
        elif (
            old.planet_ratio is not None
            and new.planet_ratio is None
            and not is_same(old.planet_ratio, (old.ratio + 1) / 2)  # as it is in a plain set
        ):
            plain.append(new.name)
    found = []
    if unknown:
        reason = "with these ratios no planet ratio is known"
        found.append(f"planet speeds of {listed(unknown)}: {reason}")
    if plain:
        reason = "with these ratios planets turn as in plain sets"
        found.append(f"planet_ratio of {listed(plain)}: {reason}")
    return found


def _has_planet(mechanism: Mechanism) -> bool:
    """Whether there is a planet speed."""
    return mechanism.planet_ratio is not None or bool(mechanism.is_plain(mechanism.ratio))
