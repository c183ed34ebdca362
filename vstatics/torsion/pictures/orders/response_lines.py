"""The response of a link to a torque of 1 N*m on it, gear by gear and order by order."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.style import Style
from vstatics.torsion.pictures.orders.excited import ExcitedSpeeds, Order, excited_speeds
from vstatics.torsion.pictures.orders.resonances import GearMode, gear_modes, meetings
from vstatics.torsion.pictures.shown_modes import modes_of

EVEN_SPEEDS = 400
"""Of a line; resonances are added, and speeds about them."""
ABOUT_PEAK = (0.3, 0.6, 1.0, 1.7, 3.0, 6.0)
"""By so many damping ratios a speed is off a resonance, as a part of it."""


class ResponseLine(NamedTuple):
    """The response to an order."""

    order: Order
    speeds: Floats
    """Of the link. [rpm]"""
    amplitudes: Floats
    """Of the link under 1 N*m, NaN where there is none. [rad]"""


class ResponsePanel(NamedTuple):
    """A gear."""

    gear: str
    link: str
    """On which the torque acts."""
    lines: Sequence[ResponseLine]
    peaks: Sequence[tuple[Order, GearMode]]
    """Resonances that are marked."""
    why: str = ""
    """It has no line."""


def response_panels(
    results: Results, style: Style, gears: Sequence[int] = ()
) -> tuple[ExcitedSpeeds, list[ResponsePanel]]:
    """The orders and speeds, and the response of each gear.

    The link is that which the style asks for, else the input of the gear.
    """
    case, asked = results.case, style.excited
    numbers = list(gears) or list(range(1, len(case.gears) + 1))
    own = [case.gears[one - 1] for one in numbers]
    found = modes_of(results, numbers)
    link = case.link_number(asked.at) if asked.at else 0
    links = [case.link_name(link or case.gear_input(gear)) for gear in own]
    every = [
        gear_modes([gear], [name]) if gear.modes else []
        for gear, name in zip(found, links, strict=True)
    ]
    excited = excited_speeds(case, own, [one.frequency for some in every for one in some], asked)
    panels = [
        _panel(results, gear.name, name, modes, excited)
        for gear, name, modes in zip(own, links, every, strict=True)
    ]
    return excited, panels


def _panel(
    results: Results, gear: str, link: str, modes: Sequence[GearMode], excited: ExcitedSpeeds
) -> ResponsePanel:
    """The response of a gear, order by order, as each has speeds of its own."""
    from vstatics.torsion.forced.harmonic_torques import Harmonic, response

    lines, (orders, _, fastest, slowest) = [], excited
    met = list(meetings(modes, orders, fastest, slowest))
    for order in orders:
        own = [one for one in met if one.order == order]
        about = [
            one.speed * (1 + sign * off * one.mode.damping_ratio)
            for one in own
            for off in ABOUT_PEAK
            for sign in (-1, 1)
        ]
        even = np.linspace(max(slowest, fastest / EVEN_SPEEDS), fastest, EVEN_SPEEDS)
        speeds = np.unique([*even, *(one for one in about if even[0] < one < fastest)])
        [made] = response(results.case, link, [Harmonic(order.number)], speeds, [gear])
        if made.error:
            return ResponsePanel(gear, link, [], [], made.error)
        amplitudes = np.abs(made.orders[0].amplitudes[link])
        lines.append(ResponseLine(order, made.speeds, amplitudes))
    peaks = [(one.order, one.mode) for one in met]
    return ResponsePanel(gear, link, lines, peaks)
