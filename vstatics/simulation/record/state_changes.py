"""Events of a record: contacts, mechanisms and springs that begin or cease to slip."""

from __future__ import annotations

from collections.abc import Collection
from typing import NamedTuple

from vstatics.simulation.events.selection import ModeSelection
from vstatics.simulation.record.motion import EventKind
from vstatics.simulation.record.record import Record
from vstatics.simulation.record.words import event_of
from vstatics.simulation.system.matrices import SIGNS, Contact, Elastic
from vstatics.simulation.system.ports import SIGNS_OF_MESHES, States
from vstatics.simulation.system.structure import moves
from vstatics.simulation.tolerances import SIGHT


class StateChanges(NamedTuple):
    """Recorder of the changes of states at an instant."""

    record: Record
    selection: ModeSelection
    time: float
    """The instant. [s]"""
    standing: float
    """Largest slip of a contact or spring that counts as sticking. [rad/s]"""

    def add(self, before: States, states: States, joined: Collection[int]) -> None:
        """Record the changes of states.

        Parameters
        ----------
        before, states : States
            States before and after the instant.
        joined : collection of int
            Indices of the contacts that have closed in an impact, which is recorded already.
        """
        system = self.selection.system
        for index, contact in enumerate(system.contacts):
            if not (contact.is_drag or index in joined):
                self._add(contact, before.contacts[index], states.contacts[index])
        for index, spring in enumerate(system.springs):
            self._add(spring, before.springs[index], states.springs[index])
        self._add_meshes(before, states)

    def _add_meshes(self, before: States, states: States) -> None:
        """Record the mechanisms that begin or cease to stick, if only friction holds them."""
        changes = zip(self.selection.system.meshes, before.meshes, states.meshes, strict=True)
        for mesh, earlier, later in changes:
            locks = earlier in SIGNS_OF_MESHES and later == "stick"
            if locks or (earlier == "stick" and later in SIGNS_OF_MESHES):
                held = (states if locks else before).held
                loose = self.selection.structure(held, ("",) * len(states.meshes))
                if moves(mesh.slip, loose.free, loose.light):
                    kind: EventKind = "locks" if locks else "slips"
                    self.record.events.append(event_of(self.time, mesh, kind))

    def _add(self, device: Contact | Elastic, before: str, after: str) -> None:
        sticks = ("stick", "rigid", "parted")  # a spring that parts within its play is not slipping
        kind: EventKind | None = None
        if before in sticks and after not in sticks:
            kind = "slips"
        elif (before in SIGNS and after in sticks) or (before == "open" and after == "rigid"):
            kind = "locks"
        elif {before, after} == {*SIGNS}:
            # A contact without capacity can be at rest. Then it begins to slip instead of
            # reversing.
            slips = self.record.largest_slip(device.row) > self.standing
            kind = "reverses" if slips else "slips"
            if kind == "slips" and self._is_slipping(device):
                return
        if kind is not None:
            self.record.events.append(event_of(self.time, device, kind, after=after))

    def _is_slipping(self, device: Contact | Elastic) -> bool:
        """Return whether a contact or spring began to slip right before the instant.

        The direction of such a slip can be wrong, if the slip was too small for the look-ahead.
        """
        near = SIGHT * self.record.system.scenario.span
        events = reversed(self.record.events)
        last = next((event for event in events if event.element == device.name), None)
        if last is None:
            return self.time <= near
        return last.event == "slips" and self.time - last.time <= near
