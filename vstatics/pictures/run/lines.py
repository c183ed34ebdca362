"""What a picture of a run shows: which lines, and when each element sticks or slips."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vstatics.model.transmission import Transmission
from vstatics.numerics.arrays import Floats
from vstatics.pictures.run.events import short
from vstatics.pictures.sheet.labels import Span
from vstatics.pictures.sheet.style import number
from vstatics.pictures.sheet.tolerances import SAME_RUN_SPEED
from vstatics.simulation.record.motion import Motion

MOST_LINES = 8
"""Lines of a panel."""
MOST_STATE_ROWS = 14
"""Elements whose states are shown."""
LARGE_PEAK_RATIO = 20.0
"""Torques whose peaks are so far apart are drawn over their peaks."""
PARTS_OF_TIME = 1500
"""Of so many parts of the time the ends and extremes are drawn."""


_ASKED = {
    "accelerations": ("acceleration, rad/s²", "ускорение, рад/с²", 1.0),
    "jerks": ("jerk, rad/s³", "рывок, рад/с³", 1.0),
    "powers": ("power, kW", "мощность, кВт", 1e3),
    "heat": ("heat, kJ", "теплота, кДж", 1e3),
    "slip_power": ("slip power, kW", "мощность буксования, кВт", 1e3),
    "heat_per_area": ("heat per area, kJ/m²", "удельная теплота, кДж/м²", 1e3),
    "slip_power_per_area": ("slip power per area, kW/m²", "удельная мощность, кВт/м²", 1e3),
    "temperatures": ("temperature, °C", "температура, °C", 1.0),
    "states": ("states", "состояния", 1.0),
    "vehicle_speed": ("speed of vehicle, m/s", "скорость машины, м/с", 1.0),
    "vehicle_acceleration": ("acceleration of vehicle, m/s²", "ускорение машины, м/с²", 1.0),
    "vehicle_jerk": ("jerk of vehicle, m/s³", "рывок машины, м/с³", 1.0),
    "ratio": ("speed ratio", "передаточное отношение", 1.0),
    "efficiency": ("efficiency", "КПД", 1.0),
    "reduced_inertia": ("reduced inertia, kg·m²", "приведенный момент инерции, кг·м²", 1.0),
}
"""Tables that somebody may ask for: in both languages, by what their values are divided."""


class MotionLine(NamedTuple):
    """A number over the time of a run."""

    names: tuple[str, ...]
    """Of one thing, or of links that always turn together."""
    values: Floats
    links: tuple[int, ...] = ()
    """Their numbers, if they are links."""
    element: int | None = None
    """Place of the shift element."""

    @property
    def name(self) -> str:
        """All names."""
        return " = ".join(self.names)

    @property
    def each(self) -> list[MotionLine]:
        """The line of each link by itself; else this one."""
        return [self._replace(links=(link,)) for link in self.links] or [self]


class MotionPanel(NamedTuple):
    """Lines to one scale."""

    english: str
    russian: str
    lines: tuple[MotionLine, ...]
    left_out: tuple[str, ...]
    """Names of the lines beyond the first `MOST`."""


class ElementStates(NamedTuple):
    """When a shift element slips under torque, and when it sticks."""

    name: str
    element: int
    """Its place."""
    slips: tuple[Span, ...]
    """From when till when. [s]"""
    sticks: tuple[Span, ...]


def panels(case: Transmission, motion: Motion) -> list[MotionPanel]:
    """The panels of a run, but those in which nothing happens."""
    slips, heat, carried = (
        [MotionLine((short(n),), values[:, k], element=k) for k, n in loaded(motion)]
        for values in (motion.slips, motion.heat / 1e3, motion.torques)
    )
    elastic = [MotionLine((short(n),), motion.torques[:, k]) for k, n in _elastic(case, motion)]
    springs = {short(spring.name) for spring in case.springs}
    found = [
        _panel("speed, rad/s", "скорость, рад/с", _speeds(case, motion)),
        _panel("slip, rad/s", "скольжение, рад/с", slips),
        _torques("elements", "моменты элементов", carried),
        _torques(*_kinds(springs, [line.name for line in elastic]), elastic),
        _panel("heat, kJ", "теплота, кДж", [] if "heat" in motion.asked else heat),
        *_asked(case, motion),
    ]
    return [panel for panel in found if panel.lines]


def _asked(case: Transmission, motion: Motion) -> Iterator[MotionPanel]:
    """Columns that somebody asks for."""
    for table, rows in motion.asked.items():
        english, russian, unit = _ASKED[table]
        lines = [
            MotionLine(
                (short(name),),
                values / unit,
                tuple(n for n, one in enumerate(case.link_names, 1) if one == name),
                next((n for n, one in enumerate(motion.elements) if one == name), None),
            )
            for name, values in rows.items()
        ]
        yield _panel(english, russian, lines)


def loaded(motion: Motion) -> list[tuple[int, str]]:
    """Shift elements that carry torque at any time, with their places."""
    carries = np.abs(motion.torques).max(axis=0, initial=0.0) > 0
    return [(place, name) for place, name in enumerate(motion.elements) if carries[place]]


def states(motion: Motion) -> list[ElementStates]:
    """When elements slip and stick, of those that carry torque.

    An element that carries none is open; so is one that is at rest without torque.
    """
    return [_states(motion, place, name) for place, name in loaded(motion)[:MOST_STATE_ROWS]]


def thinned(time: Floats, values: Floats) -> tuple[Floats, Floats]:
    """A line that looks the same, of fewer points: in each part of the time its ends and extremes.

    >>> time = np.linspace(0.0, 1.0, 100_001)
    >>> fewer, values = thinned(time, np.sin(1e4 * time))
    >>> len(fewer) < 7000, float(round(max(values), 4))
    (True, 1.0)
    """
    if len(time) <= 4 * PARTS_OF_TIME:
        return time, values
    edges = np.searchsorted(time, np.linspace(time[0], time[-1], PARTS_OF_TIME + 1)[:-1])
    starts = np.unique(edges)
    kept = {0, len(time) - 1}
    for start, end in zip(starts, [*starts[1:], len(time)], strict=True):
        part = values[start:end]
        kept |= {start, end - 1, start + int(part.argmin()), start + int(part.argmax())}
    places = sorted(kept)
    return time[places], values[places]


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
            tuple(short(motion.links[link]) for link in group),
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


def _elastic(case: Transmission, motion: Motion) -> Iterator[tuple[int, str]]:
    """Springs and converters that carry torque; mechanisms have no slip and no twist."""
    rigid = {*case.devices} - {spring.name for spring in case.springs}
    for place in range(len(motion.elements), len(motion.devices)):
        name = motion.devices[place]
        if name not in rigid and np.abs(motion.torques[:, place]).max(initial=0.0) > 0:
            yield place, name


def _kinds(springs: Collection[str], names: Sequence[str]) -> tuple[str, str]:
    """What these are together.

    >>> _kinds((), ["TC"])
    ('converters', 'моменты гидротрансформаторов')
    """
    of = [name in springs for name in names]
    if all(of):
        return "springs", "моменты пружин"
    if not any(of):
        return "converters", "моменты гидротрансформаторов"
    return "springs, converters", "моменты пружин, ГТ"


def _panel(english: str, russian: str, lines: Sequence[MotionLine]) -> MotionPanel:
    left_out = tuple(line.name for line in lines[MOST_LINES:])
    return MotionPanel(english, russian, tuple(lines[:MOST_LINES]), left_out)


def _torques(english: str, russian: str, lines: Sequence[MotionLine]) -> MotionPanel:
    """Torques in N·m; where one would hide another, each over its peak, which is told."""
    peaks = [float(np.abs(line.values).max()) for line in lines]
    if not peaks or max(peaks) < LARGE_PEAK_RATIO * min(peaks):
        return _panel(f"torque of {english}, N·m", f"{russian}, Н·м", lines)
    scaled = [
        line._replace(names=(f"{line.name} ({number(peak)} N·m)",), values=line.values / peak)
        for line, peak in zip(lines, peaks, strict=True)
    ]
    return _panel(f"torque of {english} over peak", f"{russian} к пикам", scaled)


def _states(motion: Motion, place: int, name: str) -> ElementStates:
    """Between two instants an element slips if it does at either of them."""
    torques, slips = np.abs(motion.torques[:, place]), np.abs(motion.slips[:, place])
    carries = torques[:-1] + torques[1:] > SAME_RUN_SPEED * torques.max()
    near = SAME_RUN_SPEED * max(np.abs(motion.speeds).max(initial=0.0), slips.max())
    moves = np.maximum(slips[:-1], slips[1:]) > near
    slipping = tuple(_spans(motion.time, carries & moves))
    return ElementStates(short(name), place, slipping, tuple(_spans(motion.time, carries & ~moves)))


def _spans(time: Floats, holds: NDArray[np.bool_]) -> Iterator[Span]:
    """From when till when something holds that is known between instants."""
    edges = np.flatnonzero(np.diff(np.r_[False, holds, False]))
    for start, end in edges.reshape(-1, 2):
        if time[end] > time[start]:
            yield float(time[start]), float(time[end])
