"""What the published method does not know."""

from __future__ import annotations

from collections.abc import Iterator

from vstatics.errors import Problem
from vstatics.simulation.laws import Points
from vstatics.simulation.scenario import Dog
from vstatics.simulation.system import Contact, MotionSystem

_INSTEAD = "take the events, the method by default"


def refusals(system: MotionSystem) -> Iterator[Problem]:
    """All that (12) to (15) have no place for, each where it stands in the scenario."""
    numbers = {spring.name: k for k, spring in enumerate(system.scenario.case.springs, 1)}
    for spring in system.springs:
        text = f"{spring.name} bends, but (12) is of a rigid box: {_INSTEAD}"
        yield Problem(text, ("case", "springs", numbers.get(spring.name, spring.name)))
    for converter in system.converters:
        text = f"(12) has no converter: {_INSTEAD}"
        yield Problem(text, ("converters", converter.name))
    controls = system.scenario.controls or {}
    for contact in system.contacts:
        if contact.element is not None and isinstance(controls.get(contact.element + 1), Dog):
            text = f"a dog clutch joins at once, which (12) does not know: {_INSTEAD}"
            yield Problem(text, ("controls", contact.name))
        else:
            yield from _of_contact(contact)


def _of_contact(contact: Contact) -> Iterator[Problem]:
    if contact.element is None and not contact.is_drag:
        text = (
            f"the load of {contact.name} holds at rest, which (12) does not know: "
            "take a formula such as -300*tanh(speed/0.05)"
        )
        yield Problem(text, ("torques", contact.name))
    elif contact.is_drag:
        text = f"{contact.name} drags, which (12) does not know: {_INSTEAD}"
        yield Problem(text, ("case",))
    elif contact.one_way and contact.element is not None:
        text = f"{contact.name} is a freewheel, which (14) does not know: {_INSTEAD}"
        yield Problem(text, ("case", "shift_elements", contact.element + 1))
    elif contact.programme.is_dog and _changes(contact):
        text = (
            f"{contact.name} has no capacity in the case, so it joins at once, which (12) does "
            "not know: give it a `capacity` there"
        )
        yield Problem(text, ("shifts",))


def _changes(contact: Contact) -> bool:
    curve = contact.programme.curve
    return isinstance(curve, Points) and len(set(curve.y)) > 1
