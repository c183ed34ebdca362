"""Engaged gears of a run over time, and the shift phases between gears."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.labels import Span
from vstatics.simulation.pictures.elements import ElementStates, spans
from vstatics.simulation.record.motion import Motion

Phase = Literal["torque", "inertia", "slip", "part"]
"""Kinds of shift phases.

`torque`: a gear is engaged while a shift element of another gear takes over torque. `inertia`: no
gear is engaged, and speeds change from one gear to another. `slip`: shift elements slip, but the
gear is the same before and after. `part`: all shift elements of a gear stick except elements common
to all gears, such as a lock-up clutch.
"""


class GearPiece(NamedTuple):
    """Period during which all shift elements of a gear stick."""

    gear: str
    start: float
    """Start of the period. [s]"""
    end: float
    """End of the period. [s]"""


class ShiftPhase(NamedTuple):
    """Phase of a shift, or of slip during a gear."""

    phase: Phase
    start: float
    """Start of the phase. [s]"""
    end: float
    """End of the phase. [s]"""
    gear: str = ""
    """Name of the gear in a phase `part`; empty for other phases."""


GearSets = Mapping[str, frozenset[str]]
"""Names of the shift elements of each gear, by name of the gear."""


def element_sets(results: Results) -> GearSets:
    """Return the shift elements of each gear, including locked freewheels."""
    case = results.with_freewheels_engaged
    names = [element.name for element in case.shift_elements]
    return {
        gear.name: frozenset(names[number - 1] for number in gear.engaged)
        for gear in case.gears
        if gear.engaged
    }


def common(sets: GearSets, motion: Motion) -> list[str]:
    """Return the shift elements that belong to all gears but do not always stick.

    A lock-up clutch is an example.
    """
    sticks = motion.beside.get("sticks", {})
    every = frozenset.intersection(*sets.values()) if len(sets) > 1 else frozenset()
    return [name for name in motion.elements if name in every and not np.all(sticks.get(name, 1))]


def gear_pieces(sets: GearSets, motion: Motion) -> list[GearPiece]:
    """Return the periods of engaged gears, sorted by time.

    Gears with identical shift elements are engaged at the same time. An engaged gear does not count
    if another engaged gear has all its shift elements and more.
    """
    sticks = motion.beside.get("sticks")
    if sticks is None:
        return []
    holds = {  # the state at an instant holds since the preceding instant
        gear: np.logical_and.reduce([sticks[name][1:] > 0 for name in elements])
        for gear, elements in sets.items()
    }
    pieces = []
    for gear, elements in sets.items():
        larger = [~holds[other] for other, more in sets.items() if elements < more]
        alone = np.logical_and.reduce([holds[gear], *larger])
        pieces += [GearPiece(gear, *span) for span in spans(motion.time, alone)]
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
        if row.name not in common_names and any(row.name in names for names in sets.values())
    }
    in_gear, takes_over = np.zeros((2, len(middle)), dtype=bool)
    for piece in pieces:
        holds = _inside(middle, [(piece.start, piece.end)])
        in_gear |= holds
        for name, slipping in slips.items():
            if name not in sets[piece.gear]:
                takes_over |= holds & slipping
    found_phases = [ShiftPhase("torque", *span) for span in spans(time, takes_over)]
    reduced = {
        gear: names - common_names
        for gear, names in sets.items()
        if common_names and names - common_names
    }
    parts = gear_pieces(reduced, motion)
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
