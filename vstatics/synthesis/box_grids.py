"""Found boxes as tables: the Pareto list, and the families."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from vstatics.synthesis.box_choice import RankedBox, family_count
from vstatics.tables.grid import Column, Grid, Row, exact, sign, text, whole


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
        yield _pareto(boxes)
        yield _of_families(boxes)


def _counts(searched: int, boxes: Sequence[RankedBox]) -> Grid:
    best = sum(box.pareto for box in boxes)
    counts = {"searched": searched, "found": len(boxes)}
    counts |= {"families": family_count(boxes), "Pareto list": best}
    rows: list[Row] = [[name, whole(count)] for name, count in counts.items()]
    return Grid("Boxes", [text("what"), Column("boxes")], rows)


def all_boxes(boxes: Sequence[RankedBox]) -> Grid:
    """A row for each found box, in their order."""
    return _listed("Found boxes", "boxes", list(enumerate(boxes, 1)))


def _pareto(boxes: Sequence[RankedBox]) -> Grid:
    """Those of the Pareto list, with their places among all."""
    own = [(place, box) for place, box in enumerate(boxes, 1) if box.pareto]
    return _listed("Pareto list", "pareto", own)


def _listed(title: str, key: str, boxes: Sequence[tuple[int, RankedBox]]) -> Grid:
    """Boxes with their places among all; their sets are the same ones, and so is what is held."""
    first = boxes[0][1].found if boxes else None
    sets = list(first.ratios) if first else []
    ports = ("input", "output", *(["held"] if first and first.box.held is not None else []))
    columns = [
        *map(Column, ("box", "family", "loss [%]", "planet speed", "slip", "torque")),
        *map(Column, ("brakes", "clutches", "single", "planar")),
        *map(Column, sets),
        *map(text, ("code", *ports, "elements")),
    ]
    rows: list[Row] = [
        [whole(place), whole(box.family), *_figures(box), *_structure(box)] for place, box in boxes
    ]
    return Grid(title, columns, rows, key=key)


def _figures(box: RankedBox) -> Row:
    own = box.found.figures
    numbers = (own.planet_speed, own.slip, own.torque)
    return [
        exact(100 * own.loss, 2),
        *(exact(number) for number in numbers),
        *(whole(count) for count in (own.brakes, own.clutches)),
        *(sign(one) for one in (own.single, own.planar)),
    ]


def _structure(box: RankedBox) -> Row:
    """The ratios of its sets, its code, ports and elements."""
    own = box.found.box
    ratios = (exact(ratio) for ratio in own.ratios)
    ports = (str(link) for link in (own.input, own.output, own.held) if link is not None)
    return [*ratios, own.scheme.code, *ports, " ".join(box.found.elements)]


def _of_families(boxes: Sequence[RankedBox]) -> Grid:
    """The families: how many boxes have these ratios in all gears."""
    members: dict[int, list[RankedBox]] = {}
    for box in boxes:
        members.setdefault(box.family, []).append(box)
    gears = boxes[0].found.gears
    rows: list[Row] = []
    for family, own in members.items():
        first = own[0].found
        losses = [100 * box.found.figures.loss for box in own]
        rows.append(
            [
                whole(family),
                whole(len(own)),
                exact(min(losses), 2),
                exact(max(losses), 2),
                exact(100 * first.figures.error),
                *(exact(gear.ratio) for gear in first.gears),
            ]
        )
    columns = ("family", "boxes", "loss from [%]", "to [%]", "error [%]")
    names = [gear.name for gear in gears]
    return Grid("Families", [*map(Column, columns), *map(Column, names)], rows)
