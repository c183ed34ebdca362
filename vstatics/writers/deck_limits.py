"""What a case has that a deck has no field for, and would not be the same case without."""

from __future__ import annotations

from collections.abc import Iterator

from vstatics.elements.drawing import drawing_of
from vstatics.errors import CaseError, listed
from vstatics.model.parts import Law
from vstatics.model.transmission import Mechanism, ShiftElement, Transmission

SHOWN = 20
"""Names of a kind that are told."""


def check_deck(case: Transmission) -> None:
    """Refuse a case of which a deck would tell another.

    Raises
    ------
    CaseError
        With everything that a deck can't hold, in one message.

    Examples
    --------
    >>> from vstatics.model.transmission import Gear, Mechanism
    >>> pair = Mechanism(1, 2, 0, -2.5, stiffness=9e4, name="pair")
    >>> check_deck(Transmission(2, [], [pair], [Gear()], inertias={1: 0.1}))
    Traceback (most recent call last):
        ...
    vstatics.errors.CaseError: a deck can't hold the inertia of 1, the stiffness of pair; ...
    """
    found = [f"the {what} of {listed(names, SHOWN)}" for what, names in _unheld(case) if names]
    springs = [spring.name for spring in case.springs]
    if springs:
        plural = "s" if springs[1:] else ""
        found.insert(0, f"the spring{plural} {listed(springs, SHOWN)}")
    if found:
        message = f"a deck can't hold {', '.join(found)}; expected YAML or JSON, which hold them"
        raise CaseError("E116", message)


def _unheld(case: Transmission) -> Iterator[tuple[str, list[str]]]:
    """What is left of a case for vibration and motion, and of which parts."""
    parts: list[ShiftElement | Mechanism] = [*case.shift_elements, *case.mechanisms]
    drawing = drawing_of(case)
    elements = drawing.elements if drawing else ()
    yield "converter", [one.name for one in case.converters]
    yield "speed ratio", [one.name for one in case.mechanisms if one.kind]
    yield "inertia", [case.link_name(link) for link, one in case.heavy.items() if one]
    yield "stiffness", [part.name for part in parts if part.stiffness is not None]
    yield "damping", [part.name for part in parts if part.damping]
    yield "static friction", [one.name for one in case.shift_elements if one.static != 1]
    yield "friction", [one.name for one in case.shift_elements if one.friction is not None]
    laws = [one.name for one in case.mechanisms if isinstance(one.efficiency, Law)]
    laws += [one.name for one in case.mechanisms if isinstance(one.back_efficiency, Law)]
    yield "efficiency over speed or torque", [*dict.fromkeys(laws)]
    yield "fatigue strength", [*case.fatigue]
    yield "balance of gear", [gear.name for gear in case.gears if gear.balance]
    yield "planet masses", [element.name for element in elements if element.planet_masses]
