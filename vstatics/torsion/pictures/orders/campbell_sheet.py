"""Content of a Campbell diagram: modes of gears, orders, speeds and texts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Look
from vstatics.pictures.drawing.ends import LineEnd
from vstatics.pictures.drawing.style import Style, number
from vstatics.pictures.drawing.words import gear_title
from vstatics.torsion.pictures.orders.orders_and_speeds import Order, excited_speeds
from vstatics.torsion.pictures.orders.resonances import (
    GearMode,
    Meeting,
    SharedMode,
    gear_modes,
    meetings,
    shared_modes,
)
from vstatics.torsion.pictures.shown_modes import gear_names, modes_of, why_none
from vstatics.torsion.system.state import asked_gears

MOST_NAMED = 4
"""Largest number of modes without resonances that a note names."""
ABOVE_MODES = 1.5
"""Largest ratio of the upper end of the scale of frequencies to the highest mode below it."""


class CampbellSheet(NamedTuple):
    """Content of a Campbell diagram."""

    case: Transmission
    gears: Sequence[str]
    """Names of gears with modes."""
    said: Sequence[str]
    """Texts about gears without modes, with the reasons."""
    input: str
    """Name of the input, whose speed is the abscissa; empty if gears have different inputs."""
    modes: Sequence[GearMode]
    orders: Sequence[Order]
    running: Sequence[float]
    """Speeds at which the input runs, ascending. [rpm]"""
    fastest: float
    """Highest speed of the diagram. [rpm]"""
    slowest: float
    """Lowest speed of the diagram. [rpm]"""
    style: Style

    @property
    def top(self) -> float:
        """Highest frequency of the diagram [Hz].

        It is the highest order at the highest speed, or less if all modes are much lower.
        """
        top = self.orders[-1].frequency(self.fastest)
        met = (mode.frequency for mode in self.modes if mode.frequency <= top)
        return top if self.slowest else min(top, ABOVE_MODES * max(met, default=top))

    @property
    def shared(self) -> list[SharedMode]:
        """Modes, with nearly equal modes of several gears combined."""
        return shared_modes(self.modes)

    @property
    def meetings(self) -> list[Meeting]:
        """All resonances in the diagram."""
        return list(meetings(self.modes, self.orders, self.fastest, self.slowest))

    def hertz(self, frequency: float) -> str:
        """Return a frequency [Hz] as text with its unit."""
        return f"{number(frequency)} {self.style.text('Hz')}"

    @property
    def order_ends(self) -> list[LineEnd]:
        """Names of orders at the right edge, each with a sample of its line."""
        return [
            LineEnd(part, (order.name,), (order_look(order, self.style),))
            for order in self.orders
            if (part := order.frequency(self.fastest) / self.top) <= 1
        ]

    @property
    def note(self) -> str:
        """Note on modes and gears that the panel does not show."""
        style, notes = self.style, []
        met = {meeting.mode.number for meeting in self.meetings}
        moving = [mode for mode in self.modes if mode.is_excited]
        excited = {mode.number for mode in moving}
        every = sorted({mode.number for mode in self.modes})
        for numbers, english in (
            (
                [n for n in every if n not in excited],
                "the input is at rest in mode",
            ),
            (
                [n for n in every if n in excited - met],
                "no order meets mode",
            ),
        ):
            if numbers:
                lowest = {n: min(m.frequency for m in self.modes if m.number == n) for n in numbers}
                shown = [f"{n} ({self.hertz(hz)})" for n, hz in lowest.items()]
                if len(shown) > MOST_NAMED:
                    shown = [shown[0], "…", shown[-1]]
                notes.append(f"{style.text(english)} {', '.join(shown)}")
        moved = {mode.gear for mode in moving}
        if excited and (at_rest := [gear for gear in self.gears if gear not in moved]):
            still = style.text("the input is at rest in all modes of")
            notes.append(f"{still} {gear_title(', '.join(at_rest), style)}")
        if len(self.gears) > 1:
            english = "gears whose frequencies differ by less than 0.5 % are drawn as one"
            notes.append(style.text(english))
        return "; ".join([*self.said, *notes])


def campbell_sheet(results: Results, style: Style, gears: Sequence[int]) -> CampbellSheet:
    """Return the content of the diagram, for some or all gears of a case.

    Raises
    ------
    CaseError
        If scipy is not installed, or no gear has a mode.
    """
    case, by_gear = results.case, modes_of(results, gears)
    chosen = asked_gears(case, gear_names(case, gears))
    reasons = [
        f"{gear_title(gear.name, style)}: {why_none(gear, style)}"
        for gear in by_gear
        if not gear.modes
    ]
    shown = [pair for pair in zip(chosen, by_gear, strict=True) if pair[1].modes]
    inputs = [case.link_name(case.gear_input(gear)) for gear, _ in shown]
    modes = gear_modes([gear for _, gear in shown], inputs)
    excited = excited_speeds(case, chosen, [mode.frequency for mode in modes], style.excited)
    names = [gear.name for gear, _ in shown]
    link = inputs[0] if len({*inputs}) == 1 else ""
    return CampbellSheet(case, names, reasons, link, modes, *excited, style)


def order_look(order: Order, style: Style) -> Look:
    """Return the line style of an order, with a colour for firing orders."""
    if order.fires:
        return {"color": style.engaged, "width": 1.6}
    return {"color": style.soft, "width": 0.7, "linestyle": (0, (4, 2))}
