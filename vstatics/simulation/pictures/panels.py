"""Panels of a picture of a run: speeds, slips, torques, output or vehicle, heat, extra columns."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

import numpy as np

from vstatics.core.errors import printable
from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.model.transmission import Transmission
from vstatics.pictures.drawing.tolerances import SAME_RUN_SPEED
from vstatics.simulation.pictures.elements import carrying, loaded
from vstatics.simulation.pictures.lines import MotionLine, MotionPanel, panels_of
from vstatics.simulation.record.motion import Motion

LEAST_HEAT_SHARE = 0.01
"""Heat below which a line is left out, relative to the largest heat. [-]"""

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
"""Title of the scale, and divisor of SI values, for the panel of each additional table."""


def panels(case: Transmission, motion: Motion) -> list[MotionPanel]:
    """Return the panels of a run that contain lines.

    The panels that matter for every shift come first, further speeds and springs last.
    """
    speeds = panels_of("speed", "speed, rpm", RAD_PER_RPM, _speeds(case, motion), by_size=True)
    main = [
        *speeds[:1],
        *panels_of("slip", "slip, rpm", RAD_PER_RPM, _slips(motion)),
        *_carried(motion),
        *_output(case, motion),
        *_heat(motion),
    ]
    all_panels = [*main, *_asked(case, motion, main), *speeds[1:], *_elastic_torques(case, motion)]
    kinds = [panel.kind for panel in all_panels]
    return [
        panel._replace(part=kinds[: n + 1].count(panel.kind)) for n, panel in enumerate(all_panels)
    ]


def _speeds(case: Transmission, motion: Motion) -> list[MotionLine]:
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
    # Links are sorted: input, output, links of converters, links of shift elements with events,
    # then fast before slow.
    happens = {event.element for event in motion.events}
    wanted = [case.input, case.output]
    for converter in case.converters:
        wanted += [converter.pump, converter.turbine]
    for element in case.shift_elements:
        if element.name in happens:
            wanted += element.links

    ranks = {link: place for place, link in reversed([*enumerate(wanted)])}

    def rank(group: list[int]) -> tuple[float, float]:
        peak = float(np.abs(motion.speeds[:, group[0]]).max())
        return min(ranks.get(link + 1, len(wanted)) for link in group), -peak

    groups.sort(key=rank)
    return [
        MotionLine(
            tuple(motion.links[link] for link in group),
            motion.speeds[:, group[0]],
            links=tuple(link + 1 for link in group),
        )
        for group in groups
    ]


def _slips(motion: Motion) -> Iterator[MotionLine]:
    near = SAME_RUN_SPEED * np.abs(motion.speeds).max(initial=0.0)
    for place, name in loaded(motion):
        if np.abs(motion.slips[:, place]).max(initial=0.0) > near:
            yield MotionLine((name,), motion.slips[:, place])


def _carried(motion: Motion) -> list[MotionPanel]:
    # A capacity that is never finite is not drawn.
    capacities = {
        name: capacity
        for name, capacity in motion.beside.get("capacities", {}).items()
        if np.isfinite(capacity).any()
    }
    lines = [
        MotionLine((name,), motion.torques[:, place], capacity=capacities.get(name))
        for place, name in loaded(motion)
    ]
    return panels_of("torque", "torque of shift elements, N·m", 1.0, lines, by_size=True)


def _elastic_torques(case: Transmission, motion: Motion) -> list[MotionPanel]:
    springs = {spring.name for spring in case.springs}
    # Only springs and converters are drawn, not rigid mechanisms.
    rigid = {*case.devices} - springs
    carries = carrying(motion)
    lines = [
        MotionLine((name,), motion.torques[:, place])
        for place, name in enumerate(motion.devices)
        if name not in rigid and carries[place]
    ]
    words = _kinds(springs, [line.names[0] for line in lines])
    return panels_of("torque", words, 1.0, lines, by_size=True)


def _kinds(springs: Collection[str], names: Sequence[str]) -> str:
    """Return the title of the scale for torques of springs, converters, or both.

    >>> _kinds((), ["TC"])
    'torque of converters, N·m'
    """
    are_springs = [name in springs for name in names]
    if all(are_springs):
        return "torque of springs, N·m"
    if not any(are_springs):
        return "torque of converters, N·m"
    return "torque of springs, converters, N·m"


def _output(case: Transmission, motion: Motion) -> list[MotionPanel]:
    """Return panels of vehicle accelerations, or of the output torque if there is no road."""
    roads = motion.beside.get("vehicle_acceleration", {})
    if roads:
        lines = [MotionLine((name,), values, _links(case, name)) for name, values in roads.items()]
        return panels_of("acceleration", *_ASKED["vehicle_acceleration"], lines)
    torques = motion.beside.get("output_torque", {}).values()
    name = case.link_name(case.output)
    lines = [MotionLine((name,), values, (case.output,)) for values in torques]
    acting = [line for line in lines if line.peak > 0]
    return panels_of("output", "output torque, N·m", 1.0, acting)


def _heat(motion: Motion) -> list[MotionPanel]:
    """Return panels of heat and losses, largest first; negligible energies are only named."""
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
    lines: list[MotionLine] = []
    small: list[str] = []
    # Rounding noise must not order equal energies, such as heat in the left and right shafts.
    for table, name in sorted(ends, key=lambda entry: -float(f"{ends[entry]:.6g}")):
        distinction = "losses" if table == "losses" and ("heat", name) in ends else ""
        line = MotionLine((name,), over_time[table][name], distinction=distinction)
        if ends[table, name] > least:
            lines.append(line)
        elif name not in motion.asked.get(table, ()):
            small += line.labels
    heat = panels_of("heat", "heat, kJ", 1e3, lines, by_size=True)
    if heat:
        heat[0] = heat[0]._replace(left_out=tuple(map(printable, small)))
    return heat


def _asked(
    case: Transmission, motion: Motion, shown: Sequence[MotionPanel]
) -> Iterator[MotionPanel]:
    """Yield panels of the requested columns that are not among the panels `shown`."""
    tables_of_panels = {"heat": "heat", "acceleration": "vehicle_acceleration"}
    present = {
        (tables_of_panels[panel.kind], name)
        for panel in shown
        if panel.kind in tables_of_panels
        for line in panel.lines
        if not line.distinction
        for name in line.names
    }
    for table, rows in motion.asked.items():
        lines = [
            MotionLine((name,), values, _links(case, name))
            for name, values in rows.items()
            if (table, name) not in present
        ]
        yield from panels_of(table, *_ASKED[table], lines)


def _links(case: Transmission, name: str) -> tuple[int, ...]:
    return tuple(number for number, link in enumerate(case.link_names, 1) if link == name)
