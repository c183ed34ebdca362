"""Which gear a run is in, and when: pieces of time in which all elements of a gear stick."""

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
"""`torque`: a gear holds while an element of another one takes torque; `inertia`: none holds, and
the speeds go from one gear to another; `slip`: the same within a gear; `part`: all of a gear stick
but what all gears have, such as the lock-up of a converter."""


class GearPiece(NamedTuple):
    """A gear all of whose elements stick."""

    gear: str
    start: float
    """[s]"""
    end: float
    """[s]"""


class ShiftPhase(NamedTuple):
    """What happens between gears, or beside one."""

    phase: Phase
    start: float
    """[s]"""
    end: float
    """[s]"""
    gear: str = ""
    """Of a `part`."""


GearSets = Mapping[str, frozenset[str]]
"""The names of the elements of each gear."""


def element_sets(results: Results) -> GearSets:
    """The elements of each gear that has any, with the freewheels that hold in it."""
    case = results.with_freewheels_engaged
    names = [element.name for element in case.shift_elements]
    return {
        gear.name: frozenset(names[number - 1] for number in gear.engaged)
        for gear in case.gears
        if gear.engaged
    }


def common(sets: GearSets, motion: Motion) -> list[str]:
    """Elements that all gears have, and that do not always stick, as the lock-up of a converter."""
    sticks = motion.beside.get("sticks", {})
    every = frozenset.intersection(*sets.values()) if len(sets) > 1 else frozenset()
    return [name for name in motion.elements if name in every and not np.all(sticks.get(name, 1))]


def gear_pieces(sets: GearSets, motion: Motion) -> list[GearPiece]:
    """The gears that hold, in order; of gears within one another the one with more elements.

    Gears of the same elements, or of more than are needed, hold at the same time.
    """
    sticks = motion.beside.get("sticks")
    if sticks is None:
        return []
    holds = {  # what is so at the later one of two instants is so between them
        gear: np.logical_and.reduce([sticks[name][1:] > 0 for name in elements])
        for gear, elements in sets.items()
    }
    made = []
    for gear, elements in sets.items():
        larger = [~holds[other] for other, more in sets.items() if elements < more]
        alone = np.logical_and.reduce([holds[gear], *larger])
        made += [GearPiece(gear, *span) for span in spans(motion.time, alone)]
    return sorted(made, key=lambda one: (one.start, one.end))


def phases(
    sets: GearSets, motion: Motion, pieces: Sequence[GearPiece], rows: Sequence[ElementStates]
) -> list[ShiftPhase]:
    """What happens beside the gears that hold, in order.

    Parameters
    ----------
    rows : sequence of ElementStates
        When elements slip under torque.
    """
    time, aside = motion.time, {*common(sets, motion)}
    middle = (time[:-1] + time[1:]) / 2
    slips = {
        row.name: _inside(middle, row.slips)
        for row in rows
        if row.name not in aside and any(row.name in one for one in sets.values())
    }
    in_gear, takes_over = np.zeros((2, len(middle)), dtype=bool)
    for piece in pieces:
        holds = _inside(middle, [(piece.start, piece.end)])
        in_gear |= holds
        for name, slipping in slips.items():
            if name not in sets[piece.gear]:
                takes_over |= holds & slipping
    found = [ShiftPhase("torque", *span) for span in spans(time, takes_over)]
    rest = {gear: one - aside for gear, one in sets.items() if aside and one - aside}
    parts = gear_pieces(rest, motion)
    for part in parts:
        holds = _inside(middle, [(part.start, part.end)]) & ~in_gear
        found += [ShiftPhase("part", *span, part.gear) for span in spans(time, holds)]
        in_gear |= holds
    held = sorted([*pieces, *parts], key=lambda one: one.start)
    slipping = np.logical_or.reduce([np.zeros_like(in_gear), *slips.values()]) & ~in_gear
    for start, end in spans(time, slipping):
        before = [one.gear for one in held if one.end <= start]
        after = [one.gear for one in held if one.start >= end]
        changes = before and after and before[-1] != after[0]
        found.append(ShiftPhase("inertia" if changes else "slip", start, end))
    return sorted(found, key=lambda one: one.start)


def _inside(times: Floats, of: Sequence[Span]) -> Booleans:
    """Which times are in any of some pieces."""
    made = np.zeros(len(times), dtype=bool)
    for low, high in of:
        made |= (times > low) & (times < high)
    return made
