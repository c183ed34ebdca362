"""Symbols for the ratios in a formula."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.elements.drawing import parts_of
from vstatics.explain.bodies import OwnLinks
from vstatics.explain.names import Names
from vstatics.model.transmission import Transmission


class Symbol(NamedTuple):
    """The ratio of a mechanism in a formula."""

    name: str
    meaning: str
    """The mechanism, or the members of an element."""
    value: float
    """[-]"""


def symbols_of(case: Transmission, names: Names, own: OwnLinks) -> list[Symbol]:
    """Symbols for the mechanisms between own links: those of the equations, or between wheels.

    Parameters
    ----------
    case : Transmission
        As it is calculated, planets among its links.
    own : OwnLinks
        The same on its own links.
    """
    given = [one.name for one in case.mechanisms]
    found: list[Symbol] = []
    number, wheels = 0, 0
    for part, reduced in zip(parts_of(case), own.parts, strict=True):
        for place, lowered in enumerate(reduced.lowered):
            if part.planet_links:
                wheels += 1
                first, second, third = lowered.members
                meaning = f"{part.name}: {first} to {second}, {third} held"
                found.append(Symbol(f"k{wheels}", meaning, lowered.mechanism.ratio))
            else:
                name = names.ratios[number + place]
                found.append(Symbol(name, given[number + place], lowered.mechanism.ratio))
        number += len(part.lowered)
    return found
