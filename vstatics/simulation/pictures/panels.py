"""Which panels a picture of a run has: speeds, slips, torques, output or vehicle, heat, columns."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

import numpy as np

from vstatics.core.errors import printable
from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.pictures.drawing.tolerances import SAME_RUN_SPEED
from vstatics.simulation.pictures.elements import carrying, loaded
from vstatics.simulation.pictures.lines import MotionLine, MotionPanel, panels_of
from vstatics.simulation.record.motion import Motion

LEAST_HEAT_SHARE = 0.01
"""Less heat, as part of the largest, has no line. [-]"""

_ASKED = {
    "accelerations": ("acceleration, rad/s²", 1.0),
    "jerks": ("jerk, rad/s³", 1.0),
    "powers": ("power, kW", 1e3),
    "heat": ("heat, kJ", 1e3),
    "slip_power": ("slip power, kW", 1e3),
    "heat_per_area": ("heat per area, kJ/m²", 1e3),
    "slip_power_per_area": ("slip power per area, kW/m²", 1e3),
    "temperatures": ("temperature, °C", 1.0),
    "states": ("states", 1.0),
    "vehicle_speed": ("speed of vehicle, m/s", 1.0),
    "vehicle_acceleration": ("acceleration of vehicle, m/s²", 1.0),
    "vehicle_jerk": ("jerk of vehicle, m/s³", 1.0),
    "ratio": ("speed ratio", 1.0),
    "efficiency": ("efficiency", 1.0),
    "reduced_inertia": ("reduced inertia, kg·m²", 1.0),
}
"""Tables that somebody may ask for: their text, by what their values are divided."""


def panels(case: Transmission, motion: Motion) -> list[MotionPanel]:
    """The panels of a run, but those in which nothing happens.

    Links and springs that are many stand behind what every shift is judged by.
    """
    speeds = panels_of("speed", "speed, rpm", RAD_PER_RPM, _speeds(case, motion), by_size=True)
    main = [
        *speeds[:1],
        *panels_of("slip", "slip, rpm", RAD_PER_RPM, _slips(motion)),
        *_carried(motion),
        *_output(case, motion),
        *_heat(motion),
    ]
    found = [*main, *_asked(case, motion, main), *speeds[1:], *_elastic_torques(case, motion)]
    kinds = [panel.kind for panel in found]
    return [one._replace(part=kinds[: n + 1].count(one.kind)) for n, one in enumerate(found)]


def _speeds(case: Transmission, motion: Motion) -> list[MotionLine]:
    """Links that move: input and output, those of elements with events, the fastest others."""
    largest = np.abs(motion.speeds).max(initial=0.0)
    near = SAME_RUN_SPEED * largest
    groups: list[list[int]] = []
    for link in range(len(motion.links)):
        speeds = motion.speeds[:, link]
        if np.abs(speeds).max(initial=0.0) <= near:
            continue
        for group in groups:
            if np.abs(speeds - motion.speeds[:, group[0]]).max() <= near:
                group.append(link)
                break
        else:
            groups.append([link])
    wanted = _wanted(case, motion)

    def rank(group: list[int]) -> tuple[float, float]:
        peak = float(np.abs(motion.speeds[:, group[0]]).max())
        return min(wanted.get(link + 1, len(wanted)) for link in group), -peak

    groups.sort(key=rank)
    return [
        MotionLine(
            tuple(motion.links[link] for link in group),
            motion.speeds[:, group[0]],
            links=tuple(link + 1 for link in group),
        )
        for group in groups
    ]


def _wanted(case: Transmission, motion: Motion) -> dict[int, int]:
    """Links that are to be seen, by their numbers, each with its rank."""
    happens = {event.element for event in motion.events}
    links = [case.input, case.output]
    for element in case.shift_elements:
        if element.name in happens:
            links += element.links
    return {link: rank for rank, link in reversed(list(enumerate(links)))}


def _slips(motion: Motion) -> Iterator[MotionLine]:
    """Of elements that carry torque and slip at any time."""
    near = SAME_RUN_SPEED * np.abs(motion.speeds).max(initial=0.0)
    for place, name in loaded(motion):
        if np.abs(motion.slips[:, place]).max(initial=0.0) > near:
            yield MotionLine((name,), motion.slips[:, place])


def _carried(motion: Motion) -> list[MotionPanel]:
    """Torques of elements with what they can carry."""
    capacities = motion.beside.get("capacities", {})
    lines = [
        MotionLine((name,), motion.torques[:, place], capacity=_finite(capacities.get(name)))
        for place, name in loaded(motion)
    ]
    return panels_of("torque", "torque of elements, N·m", 1.0, lines, by_size=True)


def _elastic_torques(case: Transmission, motion: Motion) -> list[MotionPanel]:
    """Torques of springs and converters."""
    lines = [MotionLine((name,), motion.torques[:, k]) for k, name in _elastic(case, motion)]
    springs = {spring.name for spring in case.springs}
    words = _kinds(springs, [line.names[0] for line in lines])
    return panels_of("torque", words, 1.0, lines, by_size=True)


def _finite(capacity: Floats | None) -> Floats | None:
    """A capacity, if it has a limit at any time."""
    return capacity if capacity is not None and np.isfinite(capacity).any() else None


def _elastic(case: Transmission, motion: Motion) -> Iterator[tuple[int, str]]:
    """Springs and converters that carry torque; mechanisms have no slip and no twist."""
    rigid = {*case.devices} - {spring.name for spring in case.springs}
    carries = carrying(motion)
    for place in range(len(motion.elements), len(motion.devices)):
        name = motion.devices[place]
        if name not in rigid and carries[place]:
            yield place, name


def _kinds(springs: Collection[str], names: Sequence[str]) -> str:
    """What these are together.

    >>> _kinds((), ["TC"])
    'torque of converters, N·m'
    """
    of = [name in springs for name in names]
    if all(of):
        return "torque of springs, N·m"
    if not any(of):
        return "torque of converters, N·m"
    return "torque of springs, converters, N·m"


def _output(case: Transmission, motion: Motion) -> list[MotionPanel]:
    """The acceleration of what has a road; without one the torque of the output."""
    roads = motion.beside.get("vehicle_acceleration", {})
    if roads:
        lines = [MotionLine((name,), one, _links(case, name)) for name, one in roads.items()]
        return panels_of("acceleration", *_ASKED["vehicle_acceleration"], lines)
    torques = motion.beside.get("output_torque", {}).values()
    name = case.link_name(case.output)
    lines = [MotionLine((name,), one, (case.output,)) for one in torques]
    acting = [one for one in lines if one.peak > 0]
    return panels_of("output", "output torque, N·m", 1.0, acting)


def _heat(motion: Motion) -> list[MotionPanel]:
    """All that heats, the most first; what is small beside it is named."""
    over_time = motion.beside or {
        "heat": dict(zip(motion.elements, motion.heat.T, strict=True)),
        "losses": {},
    }
    ends = {
        (table, name): abs(total)
        for table in ("heat", "losses")
        for name, total in getattr(motion.energy, table).items()
        if name in over_time[table]
    }
    least = LEAST_HEAT_SHARE * max(ends.values(), default=0.0)
    order = sorted(ends, key=lambda one: -ends[one])

    def beside(table: str, name: str) -> str:
        return "losses" if table == "losses" and ("heat", name) in ends else ""

    lines = [
        MotionLine((name,), over_time[table][name], beside=beside(table, name))
        for table, name in order
        if ends[table, name] > least
    ]
    small = [
        line
        for table, name in order
        if ends[table, name] <= least
        for line in MotionLine((name,), np.zeros(0), beside=beside(table, name)).labels
    ]
    made = panels_of("heat", "heat, kJ", 1e3, lines, by_size=True)
    if made:
        made[0] = made[0]._replace(left_out=tuple(map(printable, small)))
    return made


def _asked(
    case: Transmission, motion: Motion, shown: Sequence[MotionPanel]
) -> Iterator[MotionPanel]:
    """Columns that somebody asks for, but those that are there."""
    known = {"heat": "heat", "acceleration": "vehicle_acceleration"}
    there = {
        (known[panel.kind], name)
        for panel in shown
        if panel.kind in known
        for line in panel.lines
        if not line.beside
        for name in line.names
    }
    for table, rows in motion.asked.items():
        lines = [
            MotionLine((name,), values, _links(case, name))
            for name, values in rows.items()
            if (table, name) not in there
        ]
        yield from panels_of(table, *_ASKED[table], lines)


def _links(case: Transmission, name: str) -> tuple[int, ...]:
    """The number of a link."""
    return tuple(number for number, one in enumerate(case.link_names, 1) if one == name)
