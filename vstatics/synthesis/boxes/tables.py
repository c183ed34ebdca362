"""Found boxes as tables: the Pareto list, and the families."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

from vstatics.core.tables.grid import Grid, Value, Values, exact, grid_of
from vstatics.synthesis.boxes.choice import RankedBox, family_count
from vstatics.synthesis.boxes.figures.by_gear import BoxGear, GearFigures


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
    *("family", "core", "loss [%]", "planet speed", "slip", "torque", "drag"),
    *("brakes", "clutches", "single", "planar"),
)
"""Headings of figures that are shown."""
MORE_FIGURES = ("error [%]", "skip shifts", "reversing", "one-way", "beyond", "known", "Ravigneaux")
"""Of those that a table of all boxes has besides."""


def all_boxes(boxes: Sequence[RankedBox]) -> Grid:
    """A row for each found box, in their order, with all that is told of it and of its gears."""
    names = [*dict.fromkeys(gear.name for box in boxes for gear in box.found.gears)]
    own = [*BoxGear._fields[2:0:-1], *GearFigures._fields]  # ratio, engaged, torques, ...
    rows = [
        (place, *_figures(box), *_more(box), *_scheme(box), *_of_gears(box, names))
        for place, box in enumerate(boxes, 1)
    ]
    by_gear = [f"{figure} {name}" for name in names for figure in own]
    headings = ["box", *FIGURES, *_sets(boxes), *MORE_FIGURES, *_of_scheme(boxes), *by_gear]
    return grid_of("Found boxes", headings, rows, key="boxes")


def _more(box: RankedBox) -> Values:
    own, found = box.found.figures, box.found
    beyond = " ".join(f"{ratio:.6g}" for ratio in own.beyond)
    names = [" ".join(one) for one in (own.reversing, own.one_way)]
    known = found.known or ""
    return [100 * own.error, own.skip_shifts, *names, beyond, known, " ".join(found.ravigneaux)]


def _of_gears(box: RankedBox, names: Sequence[str]) -> Iterator[Value]:
    """The cells of all gears; nothing where a box has none of a name."""
    gears = {gear.name: gear for gear in box.found.gears}
    for name in names:
        if name not in gears:
            yield from [""] * (2 + len(GearFigures._fields))
            continue
        gear = gears[name]
        yield from (gear.ratio, " ".join(gear.engaged))
        for value in gear.figures:
            yield value if isinstance(value, float) else _by_name(value)


def _by_name(values: Mapping[str, float]) -> str:
    """Numbers with their names in one cell."""
    return " ".join(f"{name}={value:.6g}" for name, value in values.items())


def _pareto(boxes: Sequence[RankedBox]) -> Iterator[Grid]:
    """Those of the Pareto list, with their places among all: figures, then what they are."""
    own = [(place, box) for place, box in enumerate(boxes, 1) if box.pareto]
    figures = ((place, *_figures(box)) for place, box in own)
    yield grid_of("Pareto list", ["box", *FIGURES, *_sets(boxes)], figures, key="pareto")
    schemes: list[Values] = [
        (place, *_scheme(box), box.found.known or "", " ".join(box.found.ravigneaux))
        for place, box in own
    ]
    names = ("known", "Ravigneaux")
    headings = ["box", *_of_scheme(boxes), *names]
    title = "Schemes of the Pareto list"
    yield grid_of(title, headings, schemes, key="schemes", optional=names)


def _sets(boxes: Sequence[RankedBox]) -> Iterable[str]:
    """Headings of the ratios of the sets, which all boxes have."""
    return boxes[0].found.ratios if boxes else ()


def _of_scheme(boxes: Sequence[RankedBox]) -> list[str]:
    """Headings of code, ports and elements; of what is held, if it is in any."""
    has_held = bool(boxes) and boxes[0].found.box.held is not None
    return ["code", "input", "output", *["held"] * has_held, "elements"]


def _figures(box: RankedBox) -> Values:
    own = box.found.figures
    numbers = own.planet_speed, own.slip, own.torque, own.drag, own.brakes, own.clutches
    loss, signs = exact(100 * own.loss, 2), (own.single, own.planar)
    return [box.family, box.core, loss, *numbers, *signs, *box.found.box.ratios]


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
