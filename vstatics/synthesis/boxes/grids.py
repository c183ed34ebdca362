"""Found boxes as tables: the Pareto list, and the families."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from vstatics.synthesis.boxes.choice import RankedBox, family_count
from vstatics.tables.grid import Column, Grid, Row, Values, exact, grid_of, sign, text, whole


def box_grids(searched: int, boxes: Sequence[RankedBox]) -> Iterator[Grid]:
    """The tables of found boxes.

    Parameters
    ----------
    searched : int
        So many boxes were looked at.
    boxes : sequence of RankedBox
        In their order.
    """
    yield _counts(searched, boxes)
    if boxes:
        yield from _pareto(boxes)
        yield _of_families(boxes)


def _counts(searched: int, boxes: Sequence[RankedBox]) -> Grid:
    best = sum(box.pareto for box in boxes)
    counts = {"searched": searched, "found": len(boxes)}
    counts |= {"families": family_count(boxes), "Pareto list": best}
    return grid_of("Boxes", ["what", "boxes"], counts.items())


def all_boxes(boxes: Sequence[RankedBox]) -> Grid:
    """A row for each found box, in their order."""
    columns = [Column("box"), *_figure_columns(boxes), *_scheme_columns(boxes)]
    rows = [[whole(place), *_figures(box), *_scheme(box)] for place, box in enumerate(boxes, 1)]
    return Grid("Found boxes", columns, rows, key="boxes")


def _pareto(boxes: Sequence[RankedBox]) -> Iterator[Grid]:
    """Those of the Pareto list, with their places among all: figures, then what they are."""
    own = [(place, box) for place, box in enumerate(boxes, 1) if box.pareto]
    figures: list[Row] = [[whole(place), *_figures(box)] for place, box in own]
    yield Grid("Pareto list", [Column("box"), *_figure_columns(boxes)], figures, key="pareto")
    schemes: list[Row] = [[whole(place), *_scheme(box)] for place, box in own]
    columns = [Column("box"), *_scheme_columns(boxes)]
    yield Grid("Schemes of the Pareto list", columns, schemes, key="schemes")


def _figure_columns(boxes: Sequence[RankedBox]) -> list[Column]:
    """Figures, then the ratios of the sets, which all boxes have."""
    names = ("family", "loss [%]", "planet speed", "slip", "torque", "brakes", "clutches")
    sets = boxes[0].found.ratios if boxes else ()
    return [*map(Column, names), *map(Column, ("single", "planar")), *map(Column, sets)]


def _scheme_columns(boxes: Sequence[RankedBox]) -> list[Column]:
    """Code, ports and elements; what is held, if it is in any."""
    has_held = bool(boxes) and boxes[0].found.box.held is not None
    return [*map(text, ("code", "input", "output", *["held"] * has_held, "elements"))]


def _figures(box: RankedBox) -> Row:
    own = box.found.figures
    numbers = (own.planet_speed, own.slip, own.torque)
    return [
        whole(box.family),
        exact(100 * own.loss, 2),
        *(exact(number) for number in numbers),
        *(whole(count) for count in (own.brakes, own.clutches)),
        *(sign(one) for one in (own.single, own.planar)),
        *(exact(ratio) for ratio in box.found.box.ratios),
    ]


def _scheme(box: RankedBox) -> Row:
    """Its code, ports and elements."""
    own = box.found.box
    ports = (str(link) for link in (own.input, own.output, own.held) if link is not None)
    return [own.scheme.code, *ports, " ".join(box.found.elements)]


def _of_families(boxes: Sequence[RankedBox]) -> Grid:
    """The families: how many boxes have these ratios in all gears."""
    members: dict[int, list[RankedBox]] = {}
    for box in boxes:
        members.setdefault(box.family, []).append(box)
    gears = boxes[0].found.gears
    rows: list[Values] = []
    for family, own in members.items():
        first = own[0].found
        losses = [100 * box.found.figures.loss for box in own]
        rows.append(
            (
                family,
                len(own),
                exact(min(losses), 2),
                exact(max(losses), 2),
                100 * first.figures.error,
                *(gear.ratio for gear in first.gears),
            )
        )
    columns = ("family", "boxes", "loss from [%]", "to [%]", "error [%]")
    names = [gear.name for gear in gears]
    return grid_of("Families", [*columns, *names], rows)
