"""The links of a vibrating gear in a row, and the devices between them."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from collections.abc import Set as AbstractSet
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.gear_state import state_of
from vstatics.pictures.drawing.tolerances import STANDS_IN_ALL_MODES

if TYPE_CHECKING:
    from vstatics.torsion.vibration.gear_modes import GearModes


class ModeDevice(NamedTuple):
    """A device that takes part in a vibration."""

    name: str
    members: tuple[int, ...]
    """Places of its links in the row, ascending."""
    elastic: bool
    level: int = 0
    """0: on the line from one link to the next, else so far below it; of those at the housing
    how many of the same link stand before it."""

    @property
    def is_grounded(self) -> bool:
        """Whether it joins a link to the housing."""
        return len(self.members) == 1

    @property
    def kind(self) -> int:
        """0 of what is rigid, 1 of a shaft, 2 of what has a twist of more than two links."""
        return self.elastic * (1 if len(self.members) == 2 else 2)


class ModeLinks(NamedTuple):
    """The links of a gear that vibrate, from the input on."""

    numbers: tuple[int, ...]
    names: tuple[str, ...]
    heavy: tuple[bool, ...]
    """Which of them have an inertia."""
    devices: tuple[ModeDevice, ...]
    """Elastic ones first, from the input on."""
    resting: tuple[str, ...]
    """Links that stand, also in all modes."""
    idle: tuple[str, ...]
    """Links without inertia at the end of a single device, which nothing loads."""


def mode_links(results: Results, number: int, modes: GearModes) -> ModeLinks:
    """The links of a gear that has modes in the order in which power comes to them.

    That is by the least number of devices between a link and the input; as in the case where it
    is the same.

    Examples
    --------
    >>> from vstatics import Spring, Transmission, solve
    >>> from vstatics.torsion.vibration.gear_modes import modes
    >>> springs = [Spring({1: 1, 3: -1}, stiffness=9.0, name="shaft"),
    ...            Spring({2: 1, 3: 2}, stiffness=9.0, name="wheel")]
    >>> case = Transmission(3, [], [], [], springs=springs, inertias={1: 1.0, 2: 1.0}, output=2)
    >>> row = mode_links(solve(case), 1, modes(case)[0])
    >>> row.names, [(one.name, one.members) for one in row.devices]
    (('1', '3', '2'), [('shaft', (0, 1)), ('wheel', (1, 2))])
    """
    case = results.case
    names = case.link_names[: case.own_links]
    state = state_of(results, number)
    moving = {
        link
        for link, name in enumerate(names, 1)
        if _moves([mode.shape[name] for mode in modes.modes], state.speeds[link])
    }
    joined = [
        (name, [link for link in dict.fromkeys(links) if link in moving])
        for name, links in _joined(case, state.gear)
    ]
    with_planets = {part.rpartition(".")[0] for part in modes.modes[0].kinetic} - {""}
    kept = {link for link in moving if case.heavy.get(link)} | {state.input, state.output}
    kept.update(*(links for name, links in joined if name in with_planets))
    joined = _loaded(moving - kept, joined)
    idle = moving - kept - {link for _, links in joined for link in links}
    row = _row(moving - idle, state.input, [links for _, links in joined])
    place = {link: at for at, link in enumerate(row)}
    elastic = modes.modes[0].elastic
    devices = [
        ModeDevice(name, tuple(sorted(place[link] for link in links)), name in elastic)
        for name, links in joined
        if len(links) > 1 or (links and name in elastic)
    ]
    return ModeLinks(
        tuple(row),
        tuple(names[link - 1] for link in row),
        tuple(case.heavy.get(link, 0.0) > 0 for link in row),
        tuple(_levelled(devices)),
        tuple(name for link, name in enumerate(names, 1) if link not in moving),
        tuple(names[link - 1] for link in sorted(idle)),
    )


def _moves(amplitudes: Sequence[float], speed: float) -> bool:
    """Whether a link vibrates, or turns at least; it may be a node of all modes."""
    known = not any(map(math.isnan, amplitudes))
    return known and (
        any(abs(one) > STANDS_IN_ALL_MODES for one in amplitudes)
        or abs(speed) > STANDS_IN_ALL_MODES
    )


def _joined(case: Transmission, gear: Gear) -> Iterator[tuple[str, Iterable[int]]]:
    """Each device that takes part in a gear, and the links that it joins."""
    for number in gear.engaged:
        element = case.shift_elements[number - 1]
        yield element.name, element.links
    for device in case.own_devices:
        yield device.name, [member.link for member in device.members]
    for spring in case.springs:
        yield spring.name, spring.form


def _loaded(
    light: AbstractSet[int], joined: list[tuple[str, list[int]]]
) -> list[tuple[str, list[int]]]:
    """Devices that bear anything, with their links: none of these is light and theirs alone."""
    while True:
        count = Counter(link for _, links in joined for link in links)
        loose = {link for link in light if count[link] == 1}
        left = [one for one in joined if loose.isdisjoint(one[1])]
        if len(left) == len(joined):
            return joined
        joined = left


def _row(links: AbstractSet[int], first: int, joined: Sequence[Sequence[int]]) -> list[int]:
    """Links by their distance from the first one, then in their own order."""
    distance: dict[int, int] = {}
    reached = links & {first}
    for level in range(len(links)):
        distance |= dict.fromkeys(reached, level)
        groups = [group for group in joined if not reached.isdisjoint(group)]
        reached = set().union(*groups) - distance.keys()
    return sorted(links, key=lambda link: (distance.get(link, math.inf), link))


def _levelled(devices: Sequence[ModeDevice]) -> Iterator[ModeDevice]:
    """Devices at levels where none covers another: what is elastic, and short, comes first."""
    order = sorted(devices, key=lambda one: (not one.elastic, one.members[-1] - one.members[0]))
    taken: list[ModeDevice] = []
    for device in order:
        on_line = device.is_grounded or device.members[1:] == (device.members[0] + 1,)
        placed = device._replace(level=0 if on_line else 1)
        while any(_cover(other, placed) for other in taken):
            placed = placed._replace(level=placed.level + 1)
        taken.append(placed)
    yield from sorted(taken, key=lambda one: (not one.elastic, one.members, one.level))


def _cover(one: ModeDevice, other: ModeDevice) -> bool:
    """Whether two devices would touch on one level; on the line only those of the same links."""
    if one.is_grounded or other.is_grounded or one.level == 0:
        return (one.level, one.members) == (other.level, other.members)
    apart = one.members[-1] < other.members[0] or other.members[-1] < one.members[0]
    return one.level == other.level and not apart
