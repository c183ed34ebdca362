"""Words for events, such as `overruns` for a freewheel that begins to slip."""

from __future__ import annotations

from vstatics.simulation.record.motion import Event, EventKind
from vstatics.simulation.system.matrices import Contact, Elastic, RigidMechanism

Device = Contact | Elastic | RigidMechanism


def event_of(time: float, device: Device, kind: EventKind, energy: float = 0.0) -> Event:
    """Return an event of a component, with the word for its kind.

    Parameters
    ----------
    time : float
        Time of the event. [s]
    energy : float
        Energy lost in an impact. [J]
    """
    return Event(time, device.name, kind, energy, _word(device, kind))


def slid_back(event: Event) -> Event:
    """Return the event of a freewheel with the word `slips` instead of `overruns`.

    The freewheel slips in the locking direction because its capacity is exceeded.
    """
    return event._replace(word="slips") if event.word == "overruns" else event


def released(event: Event) -> Event:
    """Return an event of a shift element with the word for opening by control."""
    return event._replace(word="opens") if event.word == "slips" else event


def _word(device: Device, kind: EventKind) -> str:
    if isinstance(device, RigidMechanism):
        return "sticks" if kind == "locks" else "moves"
    if isinstance(device, Contact) and kind == "slips":
        if device.one_way:
            return "overruns"
        if device.element is None:  # the device is the dry friction of a load
            return "starts"
    if device.programme.is_dog and kind != "reverses":
        return "opens" if kind == "slips" else "closes"
    return kind
