"""What the page on found boxes shows: tables, and of each box its diagram and its gears."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from vstatics.report.drawn import inline
from vstatics.report.parts import figure
from vstatics.synthesis.box_listing import BoxListing, ListedBox
from vstatics.tables.grid import NO, YES, Cell, Column, Grid, Row, exact, sign, text, whole
from vstatics.tables.html import Markup, table, tag


def all_grid(listing: BoxListing, most: int) -> Grid:
    """Boxes with their figures, in the order of the document, up to so many."""
    numbers = ("box", "family", "loss [%]", "torque", "planet speed", "slip", "error [%]")
    columns = [
        *map(Column, (*numbers, "brakes", "clutches")),
        *(Column(one, is_sign=True) for one in ("Pareto", "single", "planar")),
        *map(text, ("code", "elements")),
    ]
    rows: list[Row] = [
        [
            whole(box.number),
            whole(box.family),
            exact(100 * box.loss),
            exact(box.torque),
            exact(box.planet_speed),
            exact(box.slip),
            exact(100 * box.error),
            *map(whole, (box.brakes, box.clutches)),
            *map(sign, (box.pareto, box.single, box.planar)),
            box.code,
            " ".join(box.elements),
        ]
        for box in listing.boxes[:most]
    ]
    return Grid("Boxes in their order", columns, rows)


def family_grid(listing: BoxListing) -> Grid:
    """Families with the ratios of their gears."""
    names = list(dict.fromkeys(name for box in listing.boxes for name in box.gears))
    columns = [Column("family"), Column("boxes"), text("its boxes"), *map(Column, names)]
    rows: list[Row] = []
    for family, boxes in list(listing.families.items())[:MOST_FAMILIES]:
        own = {name: gear.ratio for name, gear in boxes[0].gears.items()}
        ratios = [exact(own.get(name)) for name in names]
        rows.append([whole(family), whole(len(boxes)), _numbers(boxes), *ratios])
    return Grid("Families: boxes with equal ratios in all gears", columns, rows)


MOST_FAMILIES = 1000
"""So many families are listed."""
MOST_NAMED = 12
"""So many boxes of a family are named."""


def _numbers(boxes: Sequence[ListedBox]) -> str:
    shown = " ".join(str(box.number) for box in boxes[:MOST_NAMED])
    return f"{shown} ..." if len(boxes) > MOST_NAMED else shown


def gear_grid(box: ListedBox) -> Grid:
    """Which elements are engaged in each gear, what its ratio is and should be."""
    columns = [
        text("gear"),
        *(Column(name, is_sign=True) for name in box.elements),
        *map(Column, ("ratio", "target", "off [%]")),
    ]
    rows: list[Row] = [
        [
            name,
            *(_engaged(element in gear.engaged) for element in box.elements),
            exact(gear.ratio),
            exact(gear.target),
            exact(100 * (gear.ratio / gear.target - 1) if gear.target else None),
        ]
        for name, gear in box.gears.items()
    ]
    return Grid("Gears", columns, rows)


def _engaged(engaged: bool) -> Cell:  # noqa: FBT001 - what the cell says
    says = "engaged" if engaged else "no"
    return Cell(YES if engaged else NO, float(engaged), says, kind=bool)


def ratio_grid(box: ListedBox) -> Grid:
    """The internal ratios of its sets."""
    rows: list[Row] = [[name, exact(ratio)] for name, ratio in box.ratios.items()]
    return Grid("Sets", [text("set"), Column("ratio")], rows)


def shown_box(box: ListedBox, svg: bytes | None) -> Iterator[Markup]:
    """A box: its diagram, its gears, its sets."""
    title = f"Box {box.number}, family {box.family}"
    yield tag("h3", title, id=f"box-{box.number}")
    yield tag("p", _figures(box))
    if svg is not None:
        yield figure(f"Stick diagram of box {box.number}", inline(svg, f"b{box.number}", title))
    yield table(gear_grid(box))
    yield table(ratio_grid(box))


def _figures(box: ListedBox) -> str:
    """The figures of a box as a sentence."""
    named = {
        "mean loss of the forward gears [%]": exact(100 * box.loss),
        "largest torque": exact(box.torque),
        "planet speed": exact(box.planet_speed),
        "slip": exact(box.slip),
    }
    texts = [f"{name} {cell.text}" for name, cell in named.items()]
    marks = {"Pareto list": box.pareto, "single": box.single, "planar": box.planar}
    texts += [name for name, holds in marks.items() if holds]
    return f"{box.code}: {'; '.join(texts)}."
