"""Words for events, such as `overruns` for a freewheel that begins to slip."""

from __future__ import annotations

from vstatics.simulation.record.motion import Event, EventKind
from vstatics.simulation.system.matrices import Contact, Elastic, RigidMechanism

Device = Contact | Elastic | RigidMechanism


_BY_STATE = {("slips", "open"): "opens", ("overruns", "-"): "slips"}
"""Words that a state after the event replaces.

A shift element opens by its control, or a freewheel slips back because its capacity is exceeded.
"""


def event_of(
    time: float, device: Device, kind: EventKind, energy: float = 0.0, after: str = ""
) -> Event:
    """Return an event of a component, with the word for its kind.

    Parameters
    ----------
    time : float
        Time of the event. [s]
    energy : float
        Energy lost in an impact. [J]
    after : str
        State of the component after the event; see `States`.
    """
    word = _word(device, kind)
    return Event(time, device.name, kind, energy, _BY_STATE.get((word, after), word))


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
