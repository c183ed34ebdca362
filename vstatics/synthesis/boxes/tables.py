"""Tables of found gearboxes: the Pareto list, and the families."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

from vstatics.core.tables.grid import Grid, Value, Values, exact, grid_of
from vstatics.synthesis.boxes.choice import RankedBox, family_count
from vstatics.synthesis.boxes.figures.by_gear import BoxGear, GearFigures


def box_grids(searched: int, boxes: Sequence[RankedBox], given_up: int) -> Iterator[Grid]:
    """Yield the tables of found gearboxes.

    Parameters
    ----------
    searched : int
        Number of examined gearboxes.
    boxes : sequence of RankedBox
        Found gearboxes in order.
    given_up : int
        Number of sets of shift elements that were not examined completely, but could give
        gearboxes.
    """
    best = sum(box.pareto for box in boxes)
    counts = {"searched": searched, "given up": given_up, "found": len(boxes)}
    counts |= {"families": family_count(boxes), "Pareto list": best}
    yield grid_of("Boxes", ["what", "boxes"], counts.items())
    if boxes:
        listed = [(place, box) for place, box in enumerate(boxes, 1) if box.pareto]
        figures = ((place, *_figures(box)) for place, box in listed)
        yield grid_of(
            "Pareto list", ["box", *FIGURES, *_set_headings(boxes)], figures, key="pareto"
        )
        schemes: list[Values] = [
            (place, *_scheme(box), box.found.known or "", " ".join(box.found.ravigneaux))
            for place, box in listed
        ]
        names = ("known", "Ravigneaux")
        yield grid_of(
            "Schemes of the Pareto list",
            ["box", *_scheme_headings(boxes), *names],
            schemes,
            key="schemes",
            optional=names,
        )
        yield _families_table(boxes)


FIGURES = (
    *("family", "core", "loss [%]", "planet speed", "slip", "torque", "drag"),
    *("brakes", "clutches", "single", "planar"),
)
"""Headings of the figures in the Pareto list."""
MORE_FIGURES = ("error [%]", "skip shifts", "reversing", "one-way", "beyond", "known", "Ravigneaux")
"""Headings of further figures in the table of all gearboxes."""


def all_boxes(boxes: Sequence[RankedBox]) -> Grid:
    """Return a table with all figures and gears, and a row for each gearbox in order."""
    names = [*dict.fromkeys(gear.name for box in boxes for gear in box.found.gears)]
    # The fields ratio, engaged, torques, and so on.
    columns = [*BoxGear._fields[2:0:-1], *GearFigures._fields]
    rows = [
        (place, *_figures(box), *_more(box), *_scheme(box), *_of_gears(box, names))
        for place, box in enumerate(boxes, 1)
    ]
    by_gear = [f"{figure} {name}" for name in names for figure in columns]
    return grid_of(
        "Found boxes",
        ["box", *FIGURES, *_set_headings(boxes), *MORE_FIGURES, *_scheme_headings(boxes), *by_gear],
        rows,
        key="boxes",
    )


def _more(box: RankedBox) -> Values:
    figures, measured_box = box.found.figures, box.found
    beyond = " ".join(f"{ratio:.6g}" for ratio in figures.beyond)
    names = [" ".join(links) for links in (figures.reversing, figures.one_way)]
    known = measured_box.known or ""
    return [
        100 * figures.error,
        figures.skip_shifts,
        *names,
        beyond,
        known,
        " ".join(measured_box.ravigneaux),
    ]


def _of_gears(box: RankedBox, names: Sequence[str]) -> Iterator[Value]:
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
    return " ".join(f"{name}={value:.6g}" for name, value in values.items())


def _set_headings(boxes: Sequence[RankedBox]) -> Iterable[str]:
    return boxes[0].found.ratios if boxes else ()


def _scheme_headings(boxes: Sequence[RankedBox]) -> list[str]:
    has_held = bool(boxes) and boxes[0].found.box.held is not None
    return ["code", "input", "output", *["held"] * has_held, "shift elements"]


def _figures(box: RankedBox) -> Values:
    figures = box.found.figures
    numbers = (
        figures.planet_speed,
        figures.slip,
        figures.torque,
        figures.drag,
        figures.brakes,
        figures.clutches,
    )
    loss, signs = exact(100 * figures.loss, 2), (figures.single, figures.planar)
    return [box.family, box.core, loss, *numbers, *signs, *box.found.box.ratios]


def _scheme(box: RankedBox) -> list[str]:
    gearbox = box.found.box
    ports = (
        str(link) for link in (gearbox.input, gearbox.output, gearbox.held) if link is not None
    )
    return [gearbox.scheme.code, *ports, " ".join(box.found.elements)]


def _families_table(boxes: Sequence[RankedBox]) -> Grid:
    members: dict[int, list[RankedBox]] = {}
    for box in boxes:
        members.setdefault(box.family, []).append(box)
    longest = max(boxes, key=lambda box: len(box.found.gears))
    names = [gear.name for gear in longest.found.gears]
    rows: list[Values] = []
    for family, family_boxes in members.items():
        first = family_boxes[0].found
        ratios = {gear.name: gear.ratio for gear in first.gears}
        losses = [100 * box.found.figures.loss for box in family_boxes]
        ends = (exact(min(losses), 2), exact(max(losses), 2), 100 * first.figures.error)
        rows.append(
            (family, len(family_boxes), *ends, *(ratios.get(name, math.nan) for name in names))
        )
    columns = ("family", "boxes", "loss from [%]", "to [%]", "error [%]")
    return grid_of("Families", [*columns, *names], rows)
