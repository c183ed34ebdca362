"""Found boxes as tables: the Pareto list, and the families."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from vstatics.synthesis.boxes.choice import RankedBox, family_count
from vstatics.tables.grid import Grid, Values, exact, grid_of


def box_grids(searched: int, boxes: Sequence[RankedBox], given_up: int) -> Iterator[Grid]:
    """The tables of found boxes.

    Parameters
    ----------
    searched : int
        So many boxes were looked at.
    boxes : sequence of RankedBox
        In their order.
    given_up : int
        So many sets of elements may be boxes, too.
    """
    yield _counts(searched, boxes, given_up)
    if boxes:
        yield from _pareto(boxes)
        yield _of_families(boxes)


def _counts(searched: int, boxes: Sequence[RankedBox], given_up: int) -> Grid:
    best = sum(box.pareto for box in boxes)
    counts = {"searched": searched, "given up": given_up, "found": len(boxes)}
    counts |= {"families": family_count(boxes), "Pareto list": best}
    return grid_of("Boxes", ["what", "boxes"], counts.items())


FIGURES = (
    *("family", "loss [%]", "planet speed", "slip", "torque"),
    *("brakes", "clutches", "single", "planar"),
)
"""Headings of figures."""


def all_boxes(boxes: Sequence[RankedBox]) -> Grid:
    """A row for each found box, in their order."""
    rows = [(place, *_figures(box), *_scheme(box)) for place, box in enumerate(boxes, 1)]
    headings = ["box", *FIGURES, *_sets(boxes), *_of_scheme(boxes)]
    return grid_of("Found boxes", headings, rows, key="boxes")


def _pareto(boxes: Sequence[RankedBox]) -> Iterator[Grid]:
    """Those of the Pareto list, with their places among all: figures, then what they are."""
    own = [(place, box) for place, box in enumerate(boxes, 1) if box.pareto]
    figures = ((place, *_figures(box)) for place, box in own)
    yield grid_of("Pareto list", ["box", *FIGURES, *_sets(boxes)], figures, key="pareto")
    schemes: list[Values] = [(place, *_scheme(box)) for place, box in own]
    headings = ["box", *_of_scheme(boxes)]
    yield grid_of("Schemes of the Pareto list", headings, schemes, key="schemes")


def _sets(boxes: Sequence[RankedBox]) -> Iterable[str]:
    """Headings of the ratios of the sets, which all boxes have."""
    return boxes[0].found.ratios if boxes else ()


def _of_scheme(boxes: Sequence[RankedBox]) -> list[str]:
    """Headings of code, ports and elements; of what is held, if it is in any."""
    has_held = bool(boxes) and boxes[0].found.box.held is not None
    return ["code", "input", "output", *["held"] * has_held, "elements"]


def _figures(box: RankedBox) -> Values:
    _, loss, *others = box.found.figures
    return [box.family, exact(100 * loss, 2), *others, *box.found.box.ratios]


def _scheme(box: RankedBox) -> list[str]:
    """Its code, ports and elements."""
    own = box.found.box
    ports = (str(link) for link in (own.input, own.output, own.held) if link is not None)
    return [own.scheme.code, *ports, " ".join(box.found.elements)]


def _of_families(boxes: Sequence[RankedBox]) -> Grid:
    """The families: how many boxes have these ratios in all gears."""
    members: dict[int, list[RankedBox]] = {}
    for box in boxes:
        members.setdefault(box.family, []).append(box)
    longest = max(boxes, key=lambda box: len(box.found.gears))
    names = [gear.name for gear in longest.found.gears]
    rows: list[Values] = []
    for family, own in members.items():
        first = own[0].found
        ratios = {gear.name: gear.ratio for gear in first.gears}
        losses = [100 * box.found.figures.loss for box in own]
        ends = (exact(min(losses), 2), exact(max(losses), 2), 100 * first.figures.error)
        rows.append((family, len(own), *ends, *(ratios.get(name, math.nan) for name in names)))
    columns = ("family", "boxes", "loss from [%]", "to [%]", "error [%]")
    return grid_of("Families", [*columns, *names], rows)
