"""Rows above the panels of a run: gears with shift phases, shift elements, and other events."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import Look
from vstatics.pictures.drawing.head import Meaning
from vstatics.pictures.drawing.labels import LINE_HEIGHT, Span, height, width, wrapped
from vstatics.pictures.drawing.line_styles import mixed, thing_look
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import LEADER_WIDTH, SIZE, Style, number
from vstatics.pictures.runs import event_text, short
from vstatics.simulation.pictures.elements import ElementStates
from vstatics.simulation.pictures.events import EventWord, placed_words
from vstatics.simulation.pictures.gears import GearPiece, Phase, ShiftPhase
from vstatics.simulation.record.motion import Event

GEAR_ROW_HEIGHT, GEAR_BAR_HEIGHT = 17.0, 12.0
"""Height of the row of gears, and of its bar. [pt]"""
BAR_ROW_HEIGHT, BAR_HEIGHT = 11.0, 6.0
"""Height of the row of a shift element without events, and of its bar. [pt]"""
WORD_HEIGHT = 11.0
"""Height of the words above a bar. [pt]"""
ROW_NAME_WIDTH = 76.0
"""Width at which the names of rows are wrapped. [pt]"""
BEFORE_ROW = 5.0
"""Distance from the name of a row to the row. [pt]"""

PHASES: Mapping[Phase, str] = {
    "torque": "torque phase",
    "inertia": "inertia phase",
    "slip": "other slip",
    "part": "(gear): without",
}
"""Names of shift phases in the legend."""


class RunRow(NamedTuple):
    """Row of a shift element, or of another component or a sequence with events."""

    name: str
    label: str
    """Name as printed, wrapped into lines."""
    states: ElementStates | None
    words: Sequence[EventWord]

    @property
    def high(self) -> float:
        """Height of the row [pt]."""
        return max(BAR_ROW_HEIGHT + WORD_HEIGHT * bool(self.words), height(self.label) + 1.0)


class RunRows(NamedTuple):
    """All rows above the panels."""

    gears: Sequence[GearPiece]
    phases: Sequence[ShiftPhase]
    rows: Sequence[RunRow]
    common: Sequence[str]
    """Shift elements that belong to all gears but do not always stick."""

    @property
    def has_gears(self) -> bool:
        """True if a bar of gears is drawn."""
        return bool(self.gears or any(phase.phase == "part" for phase in self.phases))

    @property
    def high(self) -> float:
        """Height of all rows [pt]."""
        return GEAR_ROW_HEIGHT * self.has_gears + sum(row.high for row in self.rows)

    def meanings(self, style: Style) -> list[Meaning]:
        """Return the entries of the legend."""
        shown = [row.states for row in self.rows if row.states]
        phases = {phase.phase for phase in self.phases} if self.has_gears else set()
        ink, aside = style.ink, ", ".join(map(short, self.common))
        sticks, slips = (_bar(ink, style, sticks=state) for state in (True, False))
        signs: list[Meaning] = [
            (any(row.sticks for row in shown), "sticks", sticks),
            (any(row.slips for row in shown), "slips under torque", slips),
        ]
        for phase, name in PHASES.items():
            meaning = f"{style.text(name)} {aside}" if phase == "part" else name
            signs.append((phase in phases, meaning, _phase_look(phase, style)))
        return signs


def name_width(names: Sequence[str], style: Style) -> float:
    """Return the width of the names of rows, including the distance to the rows [pt]."""
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
    """Return the rows of shift elements, then of `others`; `pen` spans the time axis of a row."""
    style = pen.style
    rows = []
    for name, states in [*((row.name, row) for row in shown), *((name, None) for name in others)]:
        placed = [(event, pen.across(event.time)) for event in events if event.element == name]
        rows.append(RunRow(name, _label(name), states, placed_words(placed, pen.size[0], style)))
    return rows


def draw_rows(pen: Pen, shown: RunRows, numbers: Mapping[str, int]) -> None:
    """Draw all rows downward from the top."""
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
    style = pen.style
    low += (GEAR_ROW_HEIGHT - GEAR_BAR_HEIGHT) / 2
    _name(pen, low + GEAR_BAR_HEIGHT / 2, style.text("gear"))
    look = {"facecolor": mixed(style.ink, style.paper, 0.1), "edgecolor": style.ink, "width": 0.6}
    for piece in shown.gears:
        attributes = {"gear": piece.gear, "from": repr(piece.start), "to": repr(piece.end)}
        group = pen.within("piece", **attributes)
        _box(group, (piece.start, piece.end), (low, GEAR_BAR_HEIGHT), piece.gear, look)
    for phase in shown.phases:
        attributes = {"phase": phase.phase, "from": repr(phase.start), "to": repr(phase.end)}
        group = pen.within("phase", **attributes)
        high = GEAR_BAR_HEIGHT / 3 if phase.phase == "torque" else GEAR_BAR_HEIGHT
        name = f"{style.text(PHASES[phase.phase])} {phase.gear}".strip()
        _box(group, (phase.start, phase.end), (low, high), name, _phase_look(phase.phase, style))
    labels = [(piece.gear, piece.start, piece.end) for piece in shown.gears]
    labels += [(f"({phase.gear})", phase.start, phase.end) for phase in shown.phases if phase.gear]
    for gear, start, end in labels:
        text, left, right = short(gear), pen.across(start), pen.across(end)
        if width(text, bold=True) + 2 < right - left:
            middle = (left + right) / 2, low + GEAR_BAR_HEIGHT / 2
            pen.text(*middle, text, bold=True, over=True, ha="center", va="center_baseline")


def _box(pen: Pen, span: Span, upright: Span, name: str, look: Look) -> None:
    """Draw a box with a title of name and times; `upright` is its lower edge and height."""
    (low, high), (left, right) = upright, map(pen.across, span)
    start, end = map(number, span)
    title = f"{name}, {start}–{end} {pen.style.text('s')}"
    pen.box((left, low), (right - left, high), title=title, **look)


def _draw_row(pen: Pen, low: float, row: RunRow, numbers: Mapping[str, int]) -> None:
    style, colour = pen.style, pen.style.ink
    bar = low + (BAR_ROW_HEIGHT - BAR_HEIGHT) / 2
    words = WORD_HEIGHT * bool(row.words)
    bar += (row.high - BAR_ROW_HEIGHT - words) / 2
    top = bar + BAR_HEIGHT
    middle = bar + BAR_HEIGHT / 2
    _name(pen, middle, row.label)
    pen.line((0, middle), (pen.size[0], middle), color=style.faint, width=LEADER_WIDTH, zorder=0.4)
    if row.states:
        colour = thing_look(numbers[row.name], style)["color"]
        for spans, state, sticks in (
            (row.states.sticks, style.text("sticks"), True),
            (row.states.slips, style.text("slips"), False),
        ):
            for span in spans:
                title = f"{short(row.name)} {state}"
                _box(pen, span, (bar, BAR_HEIGHT), title, _bar(colour, style, sticks=sticks))
    leaders = []
    for word in row.words:
        text, time = event_text(word.event, style), number(word.event.time)
        title = f"{text}, {time} {style.text('s')}"
        leaders.append(((word.at, middle if row.states is None else top), (word.at, top + 1.0)))
        leaders.append(((word.at, top + 1.0), (word.middle, top + 3.0)))
        pen.text(
            word.middle,
            top + 4.0,
            word.text,
            size=SIZE,
            ha="center",
            va="baseline",
            over=True,
            title=title,
        )
    pen.lines(leaders, color=style.ink, width=LEADER_WIDTH)


def _bar(colour: str, style: Style, *, sticks: bool) -> Look:
    inside = {"facecolor": colour} if sticks else {"facecolor": style.paper, "hatch": "//////"}
    return {"edgecolor": colour, "width": 0.5, **inside}


def _phase_look(phase: Phase, style: Style) -> Look:
    if phase == "part":
        return {"facecolor": style.paper, "edgecolor": style.faint, "width": 0.8}
    inside: Look = {
        "torque": {"facecolor": style.soft},
        "inertia": {"facecolor": style.power},
        "slip": {"facecolor": style.paper, "hatch": "////"},
    }[phase]
    return {"edgecolor": style.power if phase == "inertia" else style.soft, "width": 0.4, **inside}
