"""What the page on found boxes shows: tables, and of each box its diagram and its gears."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from vstatics.report.overview import line_of
from vstatics.report.page_pictures import inline
from vstatics.report.parts import figure
from vstatics.synthesis.boxes.listing import BoxListing, ListedBox
from vstatics.tables.grid import Cell, Column, Grid, Values, exact, grid_of, sign
from vstatics.tables.html import Markup, tables, tag
from vstatics.texts import heading, tr


def box_link(box: ListedBox) -> Markup:
    """A link to the diagram of a box."""
    return tag("a", tr("box {number}", number=box.number), href=f"#box-{box.number}")


def all_grid(listing: BoxListing, most: int, drawn: Collection[int]) -> Grid:
    """Boxes with their figures, in the order of the document, up to so many.

    Parameters
    ----------
    drawn : collection of int
        The numbers of those with a diagram, to which the table links.
    """
    numbers = ("family", "loss [%]", "torque", "planet speed", "slip", "error [%]")
    signs = (Column(one, is_sign=True) for one in ("Pareto", "single", "planar"))
    front = ("box", *numbers, "brakes", "clutches")
    rows: list[Values] = [
        (
            box_link(box) if box.number in drawn else tr("box {number}", number=box.number),
            box.family,
            100 * box.loss,
            *(box.torque, box.planet_speed, box.slip, 100 * box.error),
            *(box.brakes, box.clutches),
            *map(_mark, (box.pareto, box.single, box.planar)),
            *(box.code, " ".join(box.elements)),
        )
        for box in listing.boxes[:most]
    ]
    return grid_of("Boxes in their order", [*front, *signs, "code", "elements"], rows)


def family_grid(listing: BoxListing) -> Grid:
    """Families with the ratios of their gears."""
    names = list(dict.fromkeys(name for box in listing.boxes for name in box.gears))
    rows: list[Values] = []
    for family, boxes in list(listing.families.items())[:MOST_FAMILIES]:
        own = {name: gear.ratio for name, gear in boxes[0].gears.items()}
        rows.append((family, len(boxes), _numbers(boxes), *map(own.get, names)))
    columns = (Column(one, is_name=True) for one in names)
    headings: list[str | Column] = ["family", "boxes", "its boxes", *columns]
    return grid_of("Families: boxes with equal ratios in all gears", headings, rows)


MOST_FAMILIES = 1000
"""So many families are listed."""
MOST_NAMED = 12
"""So many boxes of a family are named."""


def _numbers(boxes: Sequence[ListedBox]) -> str:
    shown = " ".join(str(box.number) for box in boxes[:MOST_NAMED])
    return f"{shown} ..." if len(boxes) > MOST_NAMED else shown


def gear_grid(box: ListedBox) -> Grid:
    """Which elements are engaged in each gear, what its ratio is and should be."""
    signs = (Column(name, is_sign=True, is_name=True) for name in box.elements)
    rows: list[Values] = [
        (
            name,
            *(_mark(element in gear.engaged) for element in box.elements),
            gear.ratio,
            gear.target,
            100 * (gear.ratio / gear.target - 1) if gear.target else None,
        )
        for name, gear in box.gears.items()
    ]
    return grid_of("Gears", ["gear", *signs, "ratio", "target", "off [%]"], rows)


def _mark(holds: bool) -> Cell:  # noqa: FBT001 - what the cell says
    """A dot for what is so, else blank."""
    return sign(holds) if holds else sign(holds)._replace(text="")


def shown_box(box: ListedBox, svg: bytes | None, digits: int | None) -> Iterator[Markup]:
    """A box: its figures, its diagram, its gears and its sets side by side."""
    title = tr("Box {number}, family {family}", number=box.number, family=box.family)
    yield tag("h3", title, id=f"box-{box.number}")
    yield line_of(_figures(box, digits))
    if svg is not None:
        name = tr("Stick diagram of box {number}", number=box.number)
        yield figure(name, inline(svg, f"b{box.number}", name), captioned=False)
    ratios = grid_of("Sets", ["set", "ratio"], box.ratios.items())
    yield from tables(one.with_digits(digits) for one in (gear_grid(box), ratios))


def _figures(box: ListedBox, digits: int | None) -> Iterator[tuple[str, str]]:
    named = {
        "mean loss [%]": 100 * box.loss,
        "largest torque": box.torque,
        "planet speed": box.planet_speed,
        "slip": box.slip,
    }
    for name, value in named.items():
        yield heading(name), exact(value, digits=digits).text
    marks = {"in the Pareto list": box.pareto, "single": box.single, "planar": box.planar}
    yield tr("it is"), ", ".join(tr(name) for name, holds in marks.items() if holds) or "-"
    yield tr("scheme"), box.code
