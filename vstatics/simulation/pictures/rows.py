"""The rows over the panels of a run: the gear with its phases, elements, what else has events."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from vstatics.pictures.drawing.head import Meaning
from vstatics.pictures.drawing.labels import LINE_HEIGHT, Span, height, width, wrapped
from vstatics.pictures.drawing.line_styles import Look, mixed, thing_look
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import LEADER_WIDTH, SIZE, Style, number
from vstatics.pictures.runs import event_text, short
from vstatics.simulation.pictures.elements import ElementStates
from vstatics.simulation.pictures.events import EventWord, placed_words
from vstatics.simulation.pictures.gears import GearPiece, Phase, ShiftPhase
from vstatics.simulation.record.motion import Event

GEAR_ROW_HEIGHT, GEAR_BAR_HEIGHT = 17.0, 12.0
"""[pt]"""
BAR_ROW_HEIGHT, BAR_HEIGHT = 11.0, 6.0
"""Of an element without events. [pt]"""
WORD_HEIGHT = 11.0
"""That words over a bar need. [pt]"""
ROW_NAME_WIDTH = 76.0
"""Names of rows are wrapped to this width. [pt]"""
BEFORE_ROW = 5.0
"""From a name to its row. [pt]"""

PHASES: Mapping[Phase, str] = {
    "torque": "torque phase",
    "inertia": "inertia phase",
    "slip": "other slip",
    "part": "(gear): without",
}
"""What they are called."""


class RunRow(NamedTuple):
    """A row of what sticks, slips, or has events."""

    name: str
    label: str
    """Its name as it is written."""
    states: ElementStates | None
    words: Sequence[EventWord]

    @property
    def high(self) -> float:
        """Of the row [pt]."""
        return max(BAR_ROW_HEIGHT + WORD_HEIGHT * bool(self.words), height(self.label) + 1.0)


class RunRows(NamedTuple):
    """All rows over the panels."""

    gears: Sequence[GearPiece]
    phases: Sequence[ShiftPhase]
    rows: Sequence[RunRow]
    common: Sequence[str]
    """Elements of all gears that do not always stick."""

    @property
    def has_gears(self) -> bool:
        """Whether there is a bar of gears."""
        return bool(self.gears or any(one.phase == "part" for one in self.phases))

    @property
    def high(self) -> float:
        """Of all rows [pt]."""
        return GEAR_ROW_HEIGHT * self.has_gears + sum(row.high for row in self.rows)

    def meanings(self, style: Style) -> list[Meaning]:
        """The signs of the key."""
        shown = [row.states for row in self.rows if row.states]
        found = {one.phase for one in self.phases} if self.has_gears else set()
        ink, aside = style.ink, ", ".join(map(short, self.common))
        sticks, slips = (_bar(ink, style, sticks=one) for one in (True, False))
        signs: list[Meaning] = [
            (any(row.sticks for row in shown), "sticks", sticks),
            (any(row.slips for row in shown), "slips under torque", slips),
        ]
        for phase, name in PHASES.items():
            said = f"{style.text(name)} {aside}" if phase == "part" else name
            signs.append((phase in found, said, _phase_look(phase, style)))
        return signs


def name_width(names: Sequence[str], style: Style) -> float:
    """That names of rows need [pt]."""
    labels = [*(_label(name) for name in names), style.text("gear")]
    return max(map(width, labels)) + BEFORE_ROW


def _label(name: str) -> str:
    return wrapped(short(name), ROW_NAME_WIDTH)


def run_rows(
    shown: Sequence[ElementStates],
    others: Sequence[str],
    events: Sequence[Event],
    pen: Pen,
) -> list[RunRow]:
    """The rows of elements, then of what else has events; `pen` has their length and time."""
    style = pen.style
    found = []
    for name, of in [*((row.name, row) for row in shown), *((name, None) for name in others)]:
        own = [(event, pen.across(event.time)) for event in events if event.element == name]
        found.append(RunRow(name, _label(name), of, placed_words(own, pen.size[0], style)))
    return found


def draw_rows(pen: Pen, shown: RunRows, numbers: Mapping[str, int]) -> None:
    """All rows, in a panel of their height with the time across."""
    top = pen.size[1]
    if shown.has_gears:
        _draw_gears(pen.within("panel", panel="gear"), top - GEAR_ROW_HEIGHT, shown)
        top -= GEAR_ROW_HEIGHT
    inner = pen.within("panel", panel="elements")
    for row in shown.rows:
        top -= row.high
        _draw_row(inner.within("element", name=row.name), top, row, numbers)


def _name(pen: Pen, middle: float, label: str) -> None:
    pen.text(-BEFORE_ROW, middle, label, ha="right", va="center", linespacing=LINE_HEIGHT)


def _draw_gears(pen: Pen, low: float, shown: RunRows) -> None:
    """The bar of gears; what happens between them, and beside them."""
    style = pen.style
    low += (GEAR_ROW_HEIGHT - GEAR_BAR_HEIGHT) / 2
    _name(pen, low + GEAR_BAR_HEIGHT / 2, style.text("gear"))
    look = {"facecolor": mixed(style.ink, style.paper, 0.1), "edgecolor": style.ink, "width": 0.6}
    for piece in shown.gears:
        said = {"gear": piece.gear, "from": repr(piece.start), "to": repr(piece.end)}
        own = pen.within("piece", **said)
        _box(own, (piece.start, piece.end), (low, GEAR_BAR_HEIGHT), piece.gear, look)
    for phase in shown.phases:
        said = {"phase": phase.phase, "from": repr(phase.start), "to": repr(phase.end)}
        own = pen.within("phase", **said)
        high = GEAR_BAR_HEIGHT / 3 if phase.phase == "torque" else GEAR_BAR_HEIGHT
        name = f"{style.text(PHASES[phase.phase])} {phase.gear}".strip()
        _box(own, (phase.start, phase.end), (low, high), name, _phase_look(phase.phase, style))
    labels = [(piece.gear, piece.start, piece.end) for piece in shown.gears]
    labels += [(f"({one.gear})", one.start, one.end) for one in shown.phases if one.gear]
    for gear, start, end in labels:
        text, left, right = short(gear), pen.across(start), pen.across(end)
        if width(text, bold=True) + 2 < right - left:
            middle = (left + right) / 2, low + GEAR_BAR_HEIGHT / 2
            pen.text(*middle, text, bold=True, over=True, ha="center", va="center_baseline")


def _box(pen: Pen, span: Span, upright: Span, name: str, look: Look) -> None:
    """A piece of a bar, from its lower edge so high, that says from when till when it is."""
    (low, high), (left, right) = upright, map(pen.across, span)
    start, end = map(number, span)
    said = f"{name}, {start}–{end} {pen.style.text('s')}"
    pen.box((left, low), (right - left, high), title=said, **look)


def _draw_row(pen: Pen, low: float, row: RunRow, numbers: Mapping[str, int]) -> None:
    """A bar with words over it."""
    style, colour = pen.style, pen.style.ink
    bar = low + (BAR_ROW_HEIGHT - BAR_HEIGHT) / 2
    words = WORD_HEIGHT * bool(row.words)
    bar += (row.high - BAR_ROW_HEIGHT - words) / 2
    top = bar + BAR_HEIGHT
    _name(pen, bar + BAR_HEIGHT / 2, row.label)
    rest = bar + BAR_HEIGHT / 2
    pen.line((0, rest), (pen.size[0], rest), color=style.faint, width=LEADER_WIDTH, zorder=0.4)
    if row.states:
        colour = thing_look(numbers[row.name], style)["color"]
        for spans, does, sticks in (
            (row.states.sticks, style.text("sticks"), True),
            (row.states.slips, style.text("slips"), False),
        ):
            for span in spans:
                said = f"{short(row.name)} {does}"
                _box(pen, span, (bar, BAR_HEIGHT), said, _bar(colour, style, sticks=sticks))
    leaders = []
    for word in row.words:
        said = f"{event_text(word.event, style)}, {number(word.event.time)}"
        said = f"{said} {style.text('s')}"
        leaders.append(((word.at, rest if row.states is None else top), (word.at, top + 1.0)))
        leaders.append(((word.at, top + 1.0), (word.middle, top + 3.0)))
        pen.text(
            word.middle,
            top + 4.0,
            word.text,
            size=SIZE,
            ha="center",
            va="baseline",
            over=True,
            title=said,
        )
    pen.lines(leaders, color=style.ink, width=LEADER_WIDTH)


def _bar(colour: str, style: Style, *, sticks: bool) -> Look:
    """Of a bar while an element sticks, or slips under torque."""
    inside = {"facecolor": colour} if sticks else {"facecolor": style.paper, "hatch": "//////"}
    return {"edgecolor": colour, "width": 0.5, **inside}


def _phase_look(phase: Phase, style: Style) -> Look:
    """Of what happens between gears, or beside one."""
    if phase == "part":
        return {"facecolor": style.paper, "edgecolor": style.faint, "width": 0.8}
    inside: Look = {
        "torque": {"facecolor": style.soft},
        "inertia": {"facecolor": style.power},
        "slip": {"facecolor": style.paper, "hatch": "////"},
    }[phase]
    return {"edgecolor": style.power if phase == "inertia" else style.soft, "width": 0.4, **inside}
