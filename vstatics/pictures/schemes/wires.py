"""The lines of links: cut where others cross them, and where their names stand."""

from __future__ import annotations

from collections.abc import Mapping

from vstatics.pictures.labels import Point
from vstatics.pictures.schemes.placing import Placement

CUT = 4.0
"""Half the gap of a wire where another crosses it. [pt]"""
BESIDE = 3.0
"""From a name to the line on which it stands. [pt]"""

Lines = dict[int, list[tuple[Point, Point]]]
"""By wire."""


def wire_lines(placement: Placement, widths: Mapping[int, float]) -> Lines:
    """All level and upright lines of each wire [pt].

    Parameters
    ----------
    widths : mapping of int to float
        Of the names that stand on their wires. [pt]
    """
    lines = _upright(placement)
    cuts: dict[tuple[int, float], list[tuple[float, float]]] = {}
    for x, y, _, wire in placement.crossings():
        cuts.setdefault((wire, y), []).append((x - CUT, x + CUT))
    for wire, (x, y) in placement.labels.items():
        half = widths[wire] / 2 + BESIDE
        cuts.setdefault((wire, y), []).append((x - half, x + half))
    for track, (left, right) in placement.row.spans.items():
        y, wire = placement.y(track), track[0]
        gaps = sorted(cuts.get((wire, y), []))
        starts, stops = [left, *(gap[1] for gap in gaps)], [*(gap[0] for gap in gaps), right]
        for start, stop in zip(starts, stops, strict=True):
            if stop > start:
                lines.setdefault(wire, []).append(((start, y), (stop, y)))
    return lines


def _upright(placement: Placement) -> Lines:
    """Those of taps; two that meet from above and below are one."""
    spans: dict[tuple[int, float], list[tuple[float, float]]] = {}
    for x, low, high, wire in placement.verticals():
        spans.setdefault((wire, x), []).append((low, high))
    lines: Lines = {}
    for (wire, x), own in spans.items():
        ends = sorted(own)
        if len(ends) > 1 and ends[0][1] >= ends[1][0]:
            ends = [(ends[0][0], ends[-1][1])]
        lines.setdefault(wire, []).extend(((x, low), (x, high)) for low, high in ends)
    return lines
