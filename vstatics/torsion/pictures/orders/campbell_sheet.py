"""What a Campbell diagram shows: modes of gears, orders, speeds, and words about them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.ends import LineEnd
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.style import Style, number
from vstatics.pictures.drawing.words import gear_title
from vstatics.torsion.pictures.orders.excited import Order, excited_speeds
from vstatics.torsion.pictures.orders.resonances import (
    GearMode,
    Meeting,
    SharedMode,
    gear_modes,
    meetings,
    shared_modes,
)
from vstatics.torsion.pictures.shown_modes import modes_of, why_none

MOST_NAMED = 4
"""So many modes without resonances are named."""


class CampbellSheet(NamedTuple):
    """What is drawn."""

    case: Transmission
    gears: Sequence[str]
    """Names of those that have modes."""
    said: Sequence[str]
    """Why others have none."""
    input: str
    """The link whose speed is across; nothing where gears have their own."""
    modes: Sequence[GearMode]
    orders: Sequence[Order]
    running: Sequence[float]
    """Speeds of the input, ascending. [rpm]"""
    fastest: float
    """Up to which the diagram goes. [rpm]"""
    slowest: float
    """From which the diagram goes. [rpm]"""
    style: Style

    @property
    def top(self) -> float:
        """Where the highest order ends [Hz]."""
        return self.orders[-1].frequency(self.fastest)

    @property
    def shared(self) -> list[SharedMode]:
        """Modes, those of gears that are alike as one."""
        return shared_modes(self.modes)

    @property
    def meetings(self) -> list[Meeting]:
        """All resonances."""
        return list(meetings(self.modes, self.orders, self.fastest, self.slowest))

    def hertz(self, frequency: float) -> str:
        """A frequency with its unit."""
        return f"{number(frequency)} {self.style.text('Hz')}"

    @property
    def order_ends(self) -> list[LineEnd]:
        """The names of orders, each behind a piece of its line."""
        look = {one: order_look(one, self.style) for one in self.orders}
        top = self.orders[-1].number
        return [LineEnd(one.number / top, (one.name,), (look[one],)) for one in self.orders]

    @property
    def note(self) -> str:
        """What the panel does not show."""
        style, notes = self.style, []
        met = {one.mode.number for one in self.meetings}
        excited = {one.number for one in self.modes if one.is_excited}
        every = sorted({one.number for one in self.modes})
        for numbers, english in (
            (
                [n for n in every if n not in excited],
                "the input stands in mode",
            ),
            (
                [n for n in every if n in excited - met],
                "no order meets mode",
            ),
        ):
            if numbers:
                lowest = [min(m.frequency for m in self.modes if m.number == n) for n in numbers]
                shown = [f"{n} ({self.hertz(hz)})" for n, hz in zip(numbers, lowest, strict=True)]
                if len(shown) > MOST_NAMED:
                    shown = [shown[0], "…", shown[-1]]
                notes.append(f"{style.text(english)} {', '.join(shown)}")
        if len(self.gears) > 1:
            english = "gears whose frequencies differ by less than 0.5 % are drawn as one"
            notes.append(style.text(english))
        return "; ".join([*self.said, *notes])


def campbell_sheet(results: Results, style: Style, gears: Sequence[int]) -> CampbellSheet:
    """What is shown of all gears of a case, or of some; errors as of `modes_of`."""
    case = results.case
    numbers = list(gears) or list(range(1, len(case.gears) + 1))
    own = [case.gears[one - 1] for one in numbers]
    found = modes_of(results, numbers)
    said = [
        f"{gear_title(one.name, style)}: {why_none(one, style)}" for one in found if not one.modes
    ]
    shown = [pair for pair in zip(own, found, strict=True) if pair[1].modes]
    inputs = [case.link_name(case.gear_input(gear)) for gear, _ in shown]
    modes = gear_modes([one for _, one in shown], inputs)
    excited = excited_speeds(case, own, [one.frequency for one in modes], style.excited)
    names = [gear.name for gear, _ in shown]
    link = inputs[0] if len({*inputs}) == 1 else ""
    return CampbellSheet(case, names, said, link, modes, *excited, style)


def order_look(order: Order, style: Style) -> Look:
    """The line of an order: those that fire are apart from others."""
    if order.fires:
        return {"color": style.engaged, "width": 1.6}
    return {"color": style.soft, "width": 0.7}
