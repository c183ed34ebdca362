"""Engaged gears of a run over time, and the shift phases between gears."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, NamedTuple

import numpy as np

from vstatics.core.model.open_converters import with_mechanisms
from vstatics.core.model.parts import Load, Mechanism
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.pictures.drawing.labels import Span
from vstatics.pictures.drawing.tolerances import SHORTEST_GEAR
from vstatics.simulation.pictures.elements import ElementStates, spans
from vstatics.simulation.record.motion import Motion

Phase = Literal["torque", "inertia", "slip", "part"]
"""Kinds of shift phases.

`torque`: a gear is engaged while a shift element of another gear takes over torque. `inertia`: no
gear is engaged, and speeds change from one gear to another. `slip`: shift elements slip, but the
gear is the same before and after. `part`: all shift elements of a gear stick except elements common
to all gears, such as a lock-up clutch.
"""


class GearElements(NamedTuple):
    """Names of the shift elements of a gear."""

    sticking: frozenset[str]
    """Engaged shift elements, and freewheels that hold when the gear drives."""
    slipping: frozenset[str] = frozenset()
    """Shift elements that slip under torque."""
    released: frozenset[str] = frozenset()
    """Shift elements that must be released if the gear engages nothing."""

    def is_part_of(self, other: GearElements) -> bool:
        """Return whether the other gear has these shift elements and more."""
        return self != other and all(map(frozenset.issubset, self, other))


class GearPiece(NamedTuple):
    """Period during which a gear is engaged: its shift elements stick, or slip as given."""

    gear: str
    """Name of the gear, or names of all gears that are engaged at the same time."""
    start: float
    """Start of the period. [s]"""
    end: float
    """End of the period. [s]"""
    elements: frozenset[str]
    """Names of the shift elements of these gears."""


class ShiftPhase(NamedTuple):
    """Phase of a shift, or of slip during a gear."""

    phase: Phase
    start: float
    """Start of the phase. [s]"""
    end: float
    """End of the phase. [s]"""
    gear: str = ""
    """Name of the gear in a phase `part`; empty for other phases."""


GearSets = Mapping[str, GearElements]
"""Shift elements of each gear, by name of the gear."""


def element_sets(results: Results) -> GearSets:
    """Return the shift elements of each gear, including locked freewheels."""
    case = results.case
    names = [element.name for element in case.shift_elements]
    gripping = [element.name for element in case.shift_elements if not element.is_freewheel]
    released = frozenset(gripping if len(case.gears) > 1 else ())
    holds = solve(_driving(case)).holds if case.freewheels else results.holds
    sets = {}
    for gear, held in zip(case.gears, holds.tolist(), strict=True):
        locked = [number for number in case.freewheels if held[number - 1]]
        sticking, slipping = (
            frozenset(names[number - 1] for number in numbers)
            for numbers in ((*gear.joining, *locked), gear.slipping)
        )
        is_neutral = not (sticking or slipping)
        elements = GearElements(sticking, slipping, released if is_neutral else frozenset())
        if any(elements):
            sets[gear.name] = elements
    return sets


def _driving(case: Transmission) -> Transmission:
    """Return a case whose gears drive, with converters and slipping shift elements locked up.

    The freewheels that hold depend on neither speed ratios nor slips.
    """
    own = case.mechanisms[case.own_mechanisms]
    pairs = [Mechanism(part.pump, part.turbine, 0, 1.0, name=part.name) for part in case.converters]
    gears = [
        gear._replace(
            engaged=gear.carrying,
            slip={},
            open=(),
            coast=None,
            load=_driving_load(gear.load),
            speed_ratios={n: i for n, i in gear.speed_ratios.items() if n <= len(own)},
        )
        for gear in case.gears
    ]
    changes = {"converters": (), "gears": gears, "coast": None, "load": _driving_load(case.load)}
    return with_mechanisms(case, [*own, *pairs], **changes)


def _driving_load(load: Load | None) -> Load | None:
    return load and Load(*(None if number is None else abs(number) for number in load))


def common(sets: GearSets, motion: Motion) -> list[str]:
    """Return the shift elements that belong to all gears but do not always stick.

    A lock-up clutch is an example.
    """
    sticks = motion.beside.get("sticks", {})
    sticking = [elements.sticking for elements in sets.values() if not elements.released]
    every = frozenset.intersection(*sticking) if len(sticking) > 1 else frozenset()
    return [name for name in motion.elements if name in every and not np.all(sticks.get(name, 1))]


def gear_pieces(sets: GearSets, motion: Motion, rows: Sequence[ElementStates]) -> list[GearPiece]:
    """Return the periods of engaged gears, sorted by time.

    Gears with identical shift elements are engaged at the same time, and share a period. An engaged
    gear does not count if another engaged gear has all its shift elements and more.

    Parameters
    ----------
    rows : sequence of ElementStates
        Times at which shift elements slip under torque.
    """
    sticks = motion.beside.get("sticks")
    if sticks is None or not sets:
        return []
    middle = (motion.time[:-1] + motion.time[1:]) / 2
    slips = {row.name: _inside(middle, row.slips) for row in rows}
    never = np.zeros(len(middle), dtype=bool)
    holds = {  # the state at an instant holds since the preceding instant
        gear: np.logical_and.reduce(
            [sticks[name][1:] > 0 for name in elements.sticking]
            + [slips.get(name, never) for name in elements.slipping]
            + [(sticks[name][1:] == 0) & ~slips.get(name, never) for name in elements.released]
        )
        for gear, elements in sets.items()
    }
    engaged = np.array(
        [
            np.logical_and.reduce(
                [holds[gear], *(~holds[name] for name in sets if part.is_part_of(sets[name]))]
            )
            for gear, part in sets.items()
        ]
    )
    pieces, shortest = [], SHORTEST_GEAR * float(np.ptp(motion.time))
    for state in np.unique(engaged, axis=1).T:
        names = [name for name, is_engaged in zip(sets, state, strict=True) if is_engaged]
        elements = frozenset().union(*(part for name in names for part in sets[name][:2]))
        during = spans(motion.time, (state == engaged.T).all(axis=1))
        pieces += [
            GearPiece(", ".join(names), start, end, elements)
            for start, end in during
            if names and end - start > shortest
        ]
    return sorted(pieces, key=lambda piece: (piece.start, piece.end))


def phases(
    sets: GearSets, motion: Motion, pieces: Sequence[GearPiece], rows: Sequence[ElementStates]
) -> list[ShiftPhase]:
    """Return the shift phases, sorted by time.

    Parameters
    ----------
    rows : sequence of ElementStates
        Times at which shift elements slip under torque.
    """
    time, common_names = motion.time, {*common(sets, motion)}
    middle = (time[:-1] + time[1:]) / 2
    slips = {
        row.name: _inside(middle, row.slips)
        for row in rows
        if row.name not in common_names
        and any(row.name in names for elements in sets.values() for names in elements[:2])
    }
    in_gear, takes_over = np.zeros((2, len(middle)), dtype=bool)
    for piece in pieces:
        holds = _inside(middle, [(piece.start, piece.end)])
        in_gear |= holds
        for name, slipping in slips.items():
            if name not in piece.elements:
                takes_over |= holds & slipping
    found_phases = [ShiftPhase("torque", *span) for span in spans(time, takes_over)]
    reduced = {
        gear: elements._replace(sticking=elements.sticking - common_names)
        for gear, elements in sets.items()
        if common_names and elements.sticking - common_names
    }
    parts = gear_pieces(reduced, motion, rows)
    for part in parts:
        holds = _inside(middle, [(part.start, part.end)]) & ~in_gear
        found_phases += [ShiftPhase("part", *span, part.gear) for span in spans(time, holds)]
        in_gear |= holds
    held = sorted([*pieces, *parts], key=lambda piece: piece.start)
    slipping = np.logical_or.reduce([np.zeros_like(in_gear), *slips.values()]) & ~in_gear
    for start, end in spans(time, slipping):
        before = [piece.gear for piece in held if piece.end <= start]
        after = [piece.gear for piece in held if piece.start >= end]
        changes = before and after and before[-1] != after[0]
        found_phases.append(ShiftPhase("inertia" if changes else "slip", start, end))
    return sorted(found_phases, key=lambda phase: phase.start)


def _inside(times: Floats, pieces: Sequence[Span]) -> Booleans:
    inside = np.zeros(len(times), dtype=bool)
    for low, high in pieces:
        inside |= (times > low) & (times < high)
    return inside
