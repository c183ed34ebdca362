"""Names of links, members of gear sets, planets and shift elements that a duty cycle loads."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from vstatics.core.errors import Path, Problem, listed, quoted
from vstatics.core.model.parts import element_names
from vstatics.core.suggestions import nearest

if TYPE_CHECKING:
    from vstatics.core.model.fields import TransmissionFields


class Members(NamedTuple):
    """Names under which a duty cycle has loads.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.0, name="P")], [Gear()])
    >>> members = Members.of(case)
    >>> members.with_torque
    ['1', '2', '3', 'P.first', 'P.second', 'P.third']
    >>> members.resolved("P"), members.resolved("P", turning=True)
    ('P.first', 'P')
    """

    links: list[str]
    of_sets: list[str]
    """Names of members of gear sets, such as ``P1.sun``."""
    planets: list[str]
    elements: list[str]
    firsts: dict[str, str]
    """Full name of the first member of each gear set, by name of the set."""
    still: list[str]
    """Members on the third link of their gear set, which have no speed relative to this link."""
    contacts: dict[str, int]
    """Contacts of a tooth in a turn, by name of the member, if the number of planets is known."""

    @classmethod
    def of(cls, case: TransmissionFields) -> Members:
        """Return the names in a case."""
        devices, drawn = case.own_devices, cast("Any", case.drawing)
        planets = {
            element.name: int(element.planets)
            for element in (drawn.elements if drawn else ())
            if element.planets
        }
        members = [
            (device, member, f"{device.name}.{member.name}")
            for device in devices
            for member in device.members
        ]
        links = case.link_names[: case.own_links] or range(1, case.own_links + 1)
        return cls(
            [str(name) for name in links],
            [name for _, _, name in members],
            [planet.name for device in devices for planet in device.planets],
            element_names(case.shift_elements),
            {device.name: f"{device.name}.{device.members[0].name}" for device in devices},
            [
                name
                for device, member, name in members
                if member.link == case.mechanisms[device.mechanisms[0]].third
            ],
            {
                name: planets[device.name]
                for device, member, name in members
                if device.name in planets and member.name != "carrier"
            },
        )

    @property
    def with_torque(self) -> list[str]:
        """Names of links, members and shift elements; planets have no separate torque."""
        return [*self.links, *self.of_sets, *self.elements]

    def resolved(self, name: str, *, turning: bool = False) -> str:
        """Return the full name of a member; the name of a gear set means its first member.

        If only the speed matters (`turning`), the name can also mean a planet of the same name.
        """
        known = [*self.with_torque, *(self.planets if turning else ())]
        return name if name in known else self.firsts.get(name, name)

    def unknown(self, name: str, path: Path) -> Iterator[Problem]:
        """Yield an error if no link, member, planet, gear set or shift element has the name."""
        known = [*self.with_torque, *self.planets, *self.firsts]
        if name not in known:
            yield self.fault(name, known, "link or member", path)

    def at_rest(self, name: str, path: Path) -> Iterator[Problem]:
        """Yield an error for a member at rest relative to the third link of its gear set."""
        if name in self.still:
            message = f"{quoted(name)} does not turn against itself, expected its link"
            yield Problem("E880", f"{message}, or two links", path)

    def without_torque(self, name: str, path: Path) -> Iterator[Problem]:
        """Yield an error if the name is unknown, or is a planet, which has no separate torque."""
        known = [*self.with_torque, *self.firsts]
        if name not in known:
            yield self.fault(name, known, "link or member with a torque", path)

    @staticmethod
    def fault(name: str, known: Iterable[str], what: str, path: Path) -> Problem:
        """Return the error for an unknown name, with a hint to the most similar known name."""
        names = [*dict.fromkeys(known)]  # a gear set and its planet can have the same name
        hint = nearest(name, names) or f"; there are {listed(names, 12) or 'none'}"
        return Problem("E880", f"there is no {what} {quoted(name)}{hint}", path)
