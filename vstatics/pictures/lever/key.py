"""Key of lever diagrams for the symbols that occur; lengths in points."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.core.groups import filled
from vstatics.core.model.transmission import HOUSING, Transmission
from vstatics.core.tables.numbers import certain
from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.labels import width
from vstatics.pictures.drawing.style import WIDE_MARGIN, Style, number
from vstatics.pictures.lever.gear import LeverGear
from vstatics.pictures.lever.marks import (
    MARKS,
    SIGNS,
    LeverSheet,
    arrow,
    box,
    ground,
    kind_of,
    mark_of,
)
from vstatics.pictures.lever.places import LeverPage, any_freewheel

KEY_ROW_HEIGHT = 13.0
"""Height of a row of the key. [pt]"""
KEY_SIGN_WIDTH = 24.0
"""Width of the symbol before the explanation. [pt]"""


class LeverKey(NamedTuple):
    """Key of a page."""

    rows: Sequence[Sequence[tuple[str, str, float]]]
    """Kind and explanation of each symbol, with the distance between them [pt], in rows."""
    arrow: float
    """Length of the arrow that shows the scale of torques. [pt]"""

    @property
    def height(self) -> float:
        """Height of all rows [pt]."""
        return KEY_ROW_HEIGHT * len(self.rows)

    def put(self, sheet: LeverSheet) -> None:
        """Draw the key at the lower edge of the page."""
        y = WIDE_MARGIN + self.height - KEY_ROW_HEIGHT / 2
        for row in self.rows:
            x = WIDE_MARGIN
            for kind, text, room in row:
                self._sample(sheet, kind, (x, y))
                sheet.pen.text(x + room, y, text, va="center")
                x += room + width(text) + WIDE_MARGIN
            y -= KEY_ROW_HEIGHT

    def _sample(self, sheet: LeverSheet, kind: str, place: Point) -> None:
        (x, y), style = place, sheet.pen.style
        at = x + KEY_SIGN_WIDTH / 2 - 4, y
        if kind in MARKS:
            sheet.point(at, kind, style.ink)
        elif kind in ("brake", "housing"):
            ground(sheet, at, style.engaged if kind == "brake" else style.ink)
        elif kind in SIGNS:
            lines = {"slack": style.faint, "spring": style.soft}
            sheet.line((at[0] - 8, y), (at[0] + 8, y), colour=lines.get(kind, style.engaged))
            SIGNS[kind](sheet, at)
        elif kind == "torque":
            arrow(sheet, (x + self.arrow, y), self.arrow)
        elif kind in ("pair", "varied"):
            box(sheet, at, (10, 8), style.ink)
        else:
            colour, thick = (style.soft, 3.0) if kind == "speed" else (style.faint, 2.0)
            sheet.line((x, y), (x + KEY_SIGN_WIDTH - 6, y), colour=colour, width=thick)


def key_of(
    page: LeverPage, gears: Sequence[LeverGear], style: Style, wide: float, per_torque: float
) -> LeverKey:
    """Return the key of a page. An arrow for a round torque shows the scale of torques."""
    length, unit = _unit(certain(per_torque))
    text = style.text
    meanings = {
        "in": text("input and links joined to it"),
        "out": text("output and links joined to it"),
        "port": text("speed or torque given"),
        "stands": text("at rest"),
        "brake": text("held by a brake"),
        "freewheel": text("freewheel that holds"),
        "housing": text("housing"),
        "clutch": text("clutch"),
        "slack": text("engaged, without torque"),
        "spring": text("spring as shaft"),
        "pair": text("gear pair, its ratio"),
        "varied": text("variator or converter, its speed ratio x"),
        "torque": text("{unit} × input torque, without losses", unit=unit),
        "speed": text("speed; dotted: that of the input"),
        "pale": text("carries no torque"),
    }
    signs = {sign for gear in gears for sign in _signs(page, gear)}
    rooms = {"torque": max(KEY_SIGN_WIDTH, length + 6)}
    entries = [
        (kind, said, rooms.get(kind, KEY_SIGN_WIDTH))
        for kind, said in meanings.items()
        if kind in signs
    ]
    room = wide - 2 * WIDE_MARGIN
    rows = filled(entries, room, lambda entry: entry[2] + width(entry[1]), WIDE_MARGIN)
    return LeverKey([*rows], length)


def _unit(per_torque: float) -> tuple[float, str]:
    """Return the length of an arrow for a round torque, 10 to 25 pt, and the torque as text.

    >>> _unit(20.0), _unit(3.0)
    ((10.0, '0.5'), (15.0, '5'))
    """
    power = 10.0 ** math.floor(math.log10(10 / per_torque))
    steps = (step * power for step in (1, 2, 5, 10))
    torque = next(candidate for candidate in steps if candidate * per_torque >= 10)
    return torque * per_torque, number(torque).rstrip("0").rstrip(".")


def _signs(page: LeverPage, gear: LeverGear) -> Iterator[str]:
    yield "speed"
    for place, lever in enumerate(page.levers):
        for link in (node.link for node in lever.nodes if node.link != HOUSING):
            yield mark_of(link, gear.state, stands=gear.stands(link))
        if lever.ratio is not None:
            yield "varied" if math.isnan(lever.ratio) else "pair"
        if any(torque != 0 for torque in gear.torques[place]):
            yield "torque"
        if not gear.is_loaded(place):
            yield "pale"
    for names in gear.grounds.values():
        yield from _held_by(page.case, names)
    for tie in gear.ties:
        if tie.name:
            is_slack = not tie.is_spring and gear.is_slack(tie.name)
            yield "slack" if is_slack else kind_of(page.case, tie)


def _held_by(case: Transmission, names: Sequence[str]) -> Iterator[str]:
    """Yield the kinds of symbols at a held point: the housing, or each brake in `names`."""
    if not names:
        yield "housing"
    for name in names:
        yield "freewheel" if any_freewheel(case, [name]) else "brake"
