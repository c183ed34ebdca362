"""Response of a link to a harmonic torque on it, by gear and order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.style import Style
from vstatics.torsion.pictures.orders.orders_and_speeds import ExcitedSpeeds, Order, excited_speeds
from vstatics.torsion.pictures.orders.resonances import GearMode, Meeting, gear_modes, meetings
from vstatics.torsion.pictures.shown_modes import gear_names, modes_of
from vstatics.torsion.system.state import asked_gears

if TYPE_CHECKING:
    from vstatics.torsion.forced.harmonic_torques import Harmonic

EVEN_SPEEDS = 400
"""Number of evenly spaced speeds of a line; speeds at and near resonances are added."""
ABOUT_PEAK = (0.3, 0.6, 1.0, 1.7, 3.0, 6.0)
"""Distances of added speeds from a resonance, in units of resonant speed times damping ratio."""


class ResponseLine(NamedTuple):
    """Amplitudes of a link over its speed, excited by the torque of an order on this link."""

    order: Order
    speeds: Floats
    """Speeds of the link. [rpm]"""
    amplitudes: Floats
    """Amplitudes of the link, NaN if undefined. [rad]"""


class ResponsePanel(NamedTuple):
    """Response of a gear."""

    gear: str
    link: str
    """Link on which the torque acts."""
    lines: Sequence[ResponseLine]
    peaks: Sequence[Meeting]
    """Resonances to mark."""
    why: str = ""
    """Reason why the gear has no response."""


def response_panels(
    results: Results, style: Style, gears: Sequence[int] = ()
) -> tuple[ExcitedSpeeds, list[ResponsePanel]]:
    """Choose orders and speeds, and calculate the response of each gear.

    The torque acts on the link that the style names, by default on the input of the gear.
    """
    case, excitation = results.case, style.excited
    harmonics = by_order(style)
    if harmonics and not excitation.orders:
        excitation = excitation._replace(orders=tuple(harmonics))
    if unknown := [order for order in excitation.orders if harmonics and order not in harmonics]:
        known = ", ".join(f"{order:g}" for order in harmonics)
        message = f"the torque has no order {unknown[0]:g}: expected one of {known}"
        raise CaseError("E505", message)
    chosen = asked_gears(case, gear_names(case, gears))
    modes_by_gear = modes_of(results, gears)
    link = case.link_number(excitation.at) if excitation.at else 0
    links = [case.link_name(link or case.gear_input(gear)) for gear in chosen]
    by_gear = [
        gear_modes([gear], [name]) if gear.modes else []
        for gear, name in zip(modes_by_gear, links, strict=True)
    ]
    frequencies = [mode.frequency for modes in by_gear for mode in modes]
    excited = excited_speeds(case, chosen, frequencies, excitation)
    panels = [
        _panel(results, (gear.name, name), modes, excited, harmonics)
        for gear, name, modes in zip(chosen, links, by_gear, strict=True)
    ]
    return excited, panels


def by_order(style: Style) -> dict[float, Harmonic]:
    """Return the harmonics of the torque in the style, by order; empty without a torque."""
    harmonics = cast("Sequence[Harmonic]", style.data or ())
    return {harmonic.order: harmonic for harmonic in harmonics}


def _panel(
    results: Results,
    names: tuple[str, str],
    modes: Sequence[GearMode],
    excited: ExcitedSpeeds,
    harmonics: Mapping[float, Harmonic],
) -> ResponsePanel:
    from vstatics.torsion.forced.harmonic_torques import Harmonic, response

    gear, link = names
    lines, (orders, _, fastest, slowest) = [], excited
    met = list(meetings(modes, orders, fastest, slowest))
    for order in orders:
        near_peaks = [
            meeting.speed * (1 + sign * off * meeting.mode.damping_ratio)
            for meeting in met
            if meeting.order == order
            for off in ABOUT_PEAK
            for sign in (-1, 1)
        ]
        even = np.linspace(max(slowest, fastest / EVEN_SPEEDS), fastest, EVEN_SPEEDS)
        speeds = np.unique([*even, *(speed for speed in near_peaks if even[0] < speed < fastest)])
        torque = harmonics.get(order.number, Harmonic(order.number))
        [forced] = response(results.case, link, [torque], speeds, [gear])
        if forced.error:
            return ResponsePanel(gear, link, [], [], forced.error)
        amplitudes = np.abs(forced.orders[0].amplitudes[link])
        lines.append(ResponseLine(order, forced.speeds, amplitudes))
    return ResponsePanel(gear, link, lines, met)
