"""Bands of a power flow that return to the left below all other bands, each in its own row."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.labels import Span, height, width
from vstatics.pictures.flow.columns import BAND_CLEARANCE, SPACE, Across, FlowCell, length
from vstatics.pictures.flow.graph import Band, Graph
from vstatics.pictures.flow.places import Box, Line, Note
from vstatics.pictures.flow.texts import FlowTexts

UNDER = 3.0
"""Distance between a band and the text under the band. [pt]"""


class BackRow(NamedTuple):
    """Row below the picture for a band that returns to the left, with its nodes and text."""

    number: int
    """Index of the band in the graph."""
    band: Band
    width: float
    """Width of the band. [pt]"""
    cell: FlowCell | None
    """Nodes along the returning band, if any."""
    text: str
    """Text below the band, written once for each loop."""

    @property
    def needed(self) -> float:
        """Length that the nodes need along the returning band; 0 without nodes [pt]."""
        return self.cell.wide + SPACE if self.cell else 0.0


def back_rows(graph: Graph, scale: float, texts: FlowTexts) -> list[BackRow]:
    """Return the rows of returning bands from top to bottom. The shortest band is at the top."""

    def reach(number: int) -> int:
        source, target = graph.ends(graph.bands[number])
        return graph.layers[source] - graph.layers[target]

    all_rows: list[BackRow] = []
    named: set[int | None] = {None}
    back = [number for number, band in enumerate(graph.bands) if band.back]
    for number in sorted(back, key=reach):
        band = graph.bands[number]
        thick, cell = band.power * scale, None
        if run := band.between:
            said = texts.run(run, band.power, length(run), back=True)
            cell = FlowCell(-1, run[::-1], said, thick=thick)
        text = "" if band.loop is None or band.loop in named else texts.loop(band.loop)
        named.add(band.loop)
        all_rows.append(BackRow(number, band, thick, cell, text))
    return all_rows


def free(rows: Sequence[BackRow], place: int, spaced: Across) -> Iterator[Span]:
    """Yield the intervals of a row that no band of a lower row crosses, from left to right [pt]."""
    taken = sorted(
        (x - row.width / 2 - BAND_CLEARANCE, x + row.width / 2 + BAND_CLEARANCE)
        for row in rows[place + 1 :]
        for x in (spaced.leaving[row.number], spaced.arriving[row.number])
    )
    low = 0.0
    for left, right in taken:
        yield low, left
        low = max(low, right)
    yield low, float("inf")


def nearest(wanted: float, wide: float, places: Iterator[Span]) -> float | None:
    """Return the position nearest to the wanted one in an interval that is at least `wide` long."""
    half = wide / 2
    candidates = [
        min(max(wanted, low + half), high - half) for low, high in places if high - low >= wide
    ]
    return min(candidates, key=lambda x: abs(x - wanted), default=None)


def _middle_of_cell(rows: Sequence[BackRow], place: int, spaced: Across) -> float | None:
    row = rows[place]
    if row.cell is None:
        return None
    left, right = spaced.arriving[row.number], spaced.leaving[row.number]
    low, high = (x + way * (row.width / 2 + BAND_CLEARANCE) for x, way in ((left, 1), (right, -1)))
    within = ((max(low, start), min(high, end)) for start, end in free(rows, place, spaced))
    return nearest((left + right) / 2, row.cell.wide, within)


def placed_rows(
    rows: Sequence[BackRow],
    spaced: Across,
    ends: Mapping[int, tuple[Point, Point]],
    low: float,
) -> Iterator[tuple[Line, list[Box], list[Note]]]:
    """Yield each returning band with the nodes and text, placed below the depth `low` [pt].

    Parameters
    ----------
    ends : mapping
        Points where each band leaves its source and reaches its target. [pt]
    """
    for place, row in enumerate(rows):
        top = low + SPACE / 2 + (row.cell.above if row.cell else 0.0)
        deep = top + row.width / 2
        right, left = spaced.leaving[row.number], spaced.arriving[row.number]
        start, end = ends[row.number]
        turns = ((right, start[1]), (right, deep), (left, deep), (left, end[1]))
        low = top + row.width
        middle = _middle_of_cell(rows, place, spaced)
        centre = (left + right) / 2
        boxes = [Box(row.cell, centre if middle is None else middle, top)] if row.cell else []
        notes = []
        if row.text:
            x = nearest(centre, width(row.text), free(rows, place, spaced))
            low += height(row.text) + UNDER
            notes.append(Note(x or centre, low - height(row.text) / 2, row.text, row.band))
        yield Line(row.band, row.width, (start, *turns, end)), boxes, notes
