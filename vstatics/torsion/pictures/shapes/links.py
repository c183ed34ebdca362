"""Arrangement of the links of a vibrating gear in a row, with the components between them."""

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
    """Component of a vibrating gear, in a row of links."""

    name: str
    members: tuple[int, ...]
    """Indices of the links in the row, ascending."""
    elastic: bool
    level: int = 0
    """Number of levels below the row; 0 is on the row.

    For a component at the housing, this is the number of preceding components at its link.
    """

    @property
    def is_grounded(self) -> bool:
        """True if the component connects a link to the housing."""
        return len(self.members) == 1

    @property
    def kind(self) -> int:
        """Kind of the component: 0 rigid, 1 shaft, 2 elastic with one or more than two links."""
        return self.elastic * (1 if len(self.members) == 2 else 2)


class ModeLinks(NamedTuple):
    """Vibrating links of a gear in a row, beginning with the input."""

    numbers: tuple[int, ...]
    names: tuple[str, ...]
    heavy: tuple[bool, ...]
    """Flag for each link, True for a link with inertia."""
    devices: tuple[ModeDevice, ...]
    """Components: elastic components first, each group beginning at the input."""
    resting: tuple[str, ...]
    """Links that neither rotate nor vibrate."""
    idle: tuple[str, ...]
    """Links without inertia that belong to a single component, so they carry no torque."""


def mode_links(results: Results, number: int, modes: GearModes) -> ModeLinks:
    """Arrange the vibrating links of a gear in a row that begins at the input.

    Links are sorted by the smallest number of components between link and input, then by number.

    Examples
    --------
    >>> from vstatics import Spring, Transmission, solve
    >>> from vstatics.torsion.vibration.gear_modes import modes
    >>> springs = [Spring({1: 1, 3: -1}, stiffness=9.0, name="shaft"),
    ...            Spring({2: 1, 3: 2}, stiffness=9.0, name="wheel")]
    >>> case = Transmission(3, [], [], [], springs=springs, inertias={1: 1.0, 2: 1.0}, output=2)
    >>> row = mode_links(solve(case), 1, modes(case)[0])
    >>> row.names, [(device.name, device.members) for device in row.devices]
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
        for name, links in _links_of_components(case, state.gear)
    ]
    with_planets = {part.rpartition(".")[0] for part in modes.modes[0].kinetic} - {""}
    loaded = {link for link in moving if case.heavy.get(link)} | {state.input, state.output}
    loaded.update(*(links for name, links in joined if name in with_planets))
    joined = _loaded(moving - loaded, joined)
    idle = moving - loaded - {link for _, links in joined for link in links}
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
    """Return whether a link vibrates or rotates; a rotating link can be at rest in all modes."""
    known = not any(map(math.isnan, amplitudes))
    return known and any(abs(motion) > STANDS_IN_ALL_MODES for motion in (*amplitudes, speed))


def _links_of_components(case: Transmission, gear: Gear) -> Iterator[tuple[str, Iterable[int]]]:
    for element in case.elements_at(gear.joining):
        yield element.name, element.links
    for device in case.own_devices:
        yield device.name, [member.link for member in device.members]
    for spring in case.springs:
        yield spring.name, spring.form


def _loaded(
    light: AbstractSet[int], joined: list[tuple[str, list[int]]]
) -> list[tuple[str, list[int]]]:
    """Remove, repeatedly, components with a massless link that belongs to no other component."""
    while True:
        count = Counter(link for _, links in joined for link in links)
        loose = {link for link in light if count[link] == 1}
        remaining = [device for device in joined if loose.isdisjoint(device[1])]
        if len(remaining) == len(joined):
            return joined
        joined = remaining


def _row(links: AbstractSet[int], first: int, joined: Sequence[Sequence[int]]) -> list[int]:
    """Sort links by the number of components from the first link, then by number."""
    distance: dict[int, int] = {}
    reached = links & {first}
    for level in range(len(links)):
        distance |= dict.fromkeys(reached, level)
        groups = [group for group in joined if not reached.isdisjoint(group)]
        reached = set().union(*groups) - distance.keys()
    return sorted(links, key=lambda link: (distance.get(link, math.inf), link))


def _levelled(devices: Sequence[ModeDevice]) -> Iterator[ModeDevice]:
    """Put components at levels without overlap, elastic and short components first."""
    order = sorted(devices, key=lambda d: (not d.elastic, d.members[-1] - d.members[0]))
    taken: list[ModeDevice] = []
    for device in order:
        on_line = device.is_grounded or device.members[1:] == (device.members[0] + 1,)
        placed = device._replace(level=0 if on_line else 1)
        while any(_would_overlap(other, placed) for other in taken):
            placed = placed._replace(level=placed.level + 1)
        taken.append(placed)
    yield from sorted(taken, key=lambda d: (not d.elastic, d.members, d.level))


def _would_overlap(device: ModeDevice, other: ModeDevice) -> bool:
    if device.is_grounded or other.is_grounded or device.level == 0:
        return (device.level, device.members) == (other.level, other.members)
    apart = device.members[-1] < other.members[0] or other.members[-1] < device.members[0]
    return device.level == other.level and not apart
