"""What the page on found boxes shows: tables, and of each box its diagram and its gears."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence

from vstatics.core.tables.grid import Cell, Column, Grid, Value, Values, exact, grid_of, sign
from vstatics.core.tables.html import Markup, table, tables, tag
from vstatics.core.texts import heading, tr
from vstatics.pictures.paged.inline import inline
from vstatics.pictures.paged.parts import figure, line_of
from vstatics.synthesis.boxes.listing import BoxListing, ListedBox, ListedGear, Range, WantedOfBoxes


def box_link(box: ListedBox) -> Markup:
    """A link to the diagram of a box."""
    return tag("a", tr("box {number}", number=box.number), href=f"#box-{box.number}")


def all_grid(listing: BoxListing, most: int, drawn: Collection[int]) -> Grid:
    """Boxes with their figures, in the order of the document, up to so many.

    Those of one core have one row, that of the first of them, which unfolds.

    Parameters
    ----------
    drawn : collection of int
        The numbers of those with a diagram, to which the table links.
    """
    cores: dict[int, list[ListedBox]] = {}
    for box in listing.boxes[:most]:
        cores.setdefault(box.core, []).append(box)
    numbers = ("family", "loss [%]", "torque", "drag", "planet speed", "slip", "error [%]")
    front = (*numbers, "brakes", "clutches")
    signs = (Column(one, is_sign=True) for one in ("Pareto", "single", "planar"))
    names = ("locked otherwise", "known as")
    rows: list[Values] = [
        (
            *(_named(box, drawn), _variants(others, drawn), box.known or ""),
            box.family,
            100 * box.loss,
            *(box.torque, box.drag, box.planet_speed, box.slip, 100 * box.error),
            *(box.brakes, box.clutches),
            *map(_mark, (box.pareto, box.single, box.planar)),
            *(box.code, " ".join(box.elements)),
        )
        for box, *others in cores.values()
    ]
    headings: list[str | Column] = ["box", *names, *front, *signs, "code", "elements"]
    return grid_of("Boxes in their order", headings, rows, optional=names)


def _named(box: ListedBox, drawn: Collection[int]) -> str:
    return box_link(box) if box.number in drawn else tr("box {number}", number=box.number)


def _variants(boxes: Sequence[ListedBox], drawn: Collection[int]) -> Cell:
    """Boxes of one core, folded: what makes them differ, and the most important figures."""
    if not boxes:
        return Cell("")
    lines = [
        tag(
            "div",
            _named(box, drawn),
            f": {' '.join(list(box.elements)[box.brakes :])}, ",
            ", ".join(f"{tr(name)} {figure}" for name, figure in _important(box)),
        )
        for box in boxes
    ]
    return Cell(tag("details", tag("summary", str(len(boxes))), *lines))


def _important(box: ListedBox) -> Iterator[tuple[str, str]]:
    yield "loss", f"{exact(100 * box.loss).text} %"
    yield "torque", exact(box.torque).text
    yield "drag", exact(box.drag).text


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


def middle(ends: Range) -> float:
    """The number in the middle of a wanted range [-]."""
    low, high = ends
    return math.copysign(math.sqrt(low * high), low)


def asked_ratio(ends: Range, tolerance: float) -> str:
    """A wanted ratio: a range, or a number where it is one within the tolerance."""
    return f"{middle(ends):g}" if _is_number(ends, tolerance) else asked_range(ends)


def asked_range(ends: Range) -> str:
    """A range in words."""
    low, high = ends
    return tr("{low} to {high}", low=f"{low:g}", high=f"{high:g}")


def _is_number(ends: Range, tolerance: float) -> bool:
    low, high = ends
    return math.isclose(abs(math.log(high / low)), 2 * tolerance, rel_tol=1e-6)


def gear_grid(box: ListedBox, wanted: WantedOfBoxes | None) -> Grid:
    """Which elements are engaged in each gear, what its ratio is and should be."""
    signs = (Column(name, is_sign=True, is_name=True) for name in box.elements)
    rows: list[Values] = [
        (
            name,
            *(_mark(element in gear.engaged) for element in box.elements),
            gear.ratio,
            *_target(gear, wanted),
        )
        for name, gear in box.gears.items()
    ]
    return grid_of("Gears", ["gear", *signs, "ratio", "target", "off [%]"], rows)


def _target(gear: ListedGear, wanted: WantedOfBoxes | None) -> tuple[Value, Value]:
    """What the ratio of a gear should be, and how far it is from that; nothing is within a range.

    Of one of the gears whose ratios nobody told there is nothing.
    """
    if wanted is not None:
        own = (ends for ends in wanted.ratios if math.isclose(middle(ends), gear.target))
        ends = next(own, None)
        if ends is None or not _is_number(ends, wanted.tolerance):
            return Cell("" if ends is None else asked_range(ends), math.nan, kind=float), BLANK
    return gear.target, 100 * (gear.ratio / gear.target - 1) if gear.target else None


BLANK = Cell("", math.nan, kind=float)
"""In place of a number where there is none."""


def _mark(holds: bool) -> Cell:  # noqa: FBT001 - what the cell says
    """A dot for what is so, else blank."""
    return sign(holds) if holds else sign(holds)._replace(text="")


def shown_box(
    box: ListedBox, svg: bytes | None, digits: int | None, wanted: WantedOfBoxes | None
) -> Iterator[Markup]:
    """A box: its figures, its diagram, its gears and its sets side by side; the rest unfolds."""
    title = tr(
        "Box {number}, family {family}, core {core}",
        number=box.number,
        family=box.family,
        core=box.core,
    )
    yield tag("h3", title, id=f"box-{box.number}")
    yield line_of(_figures(box, digits))
    if svg is not None:
        name = tr("Stick diagram of box {number}", number=box.number)
        yield figure(name, inline(svg, f"b{box.number}", name), captioned=False)
    ratios = grid_of("Sets", ["set", "ratio"], box.ratios.items())
    yield from tables(one.with_digits(digits) for one in (gear_grid(box, wanted), ratios))
    more = (one.with_digits(digits) for one in (element_grid(box), set_grid(box)))
    said = tr("Torques, slips, speeds, losses and drag by gear")
    yield tag("details", tag("summary", said), line_of(_facts(box)), *map(table, more))


def element_grid(box: ListedBox) -> Grid:
    """Of each gear the torques of engaged elements and the slips of open ones."""
    kinds = {"torque": "torques", "slip": "slips"}
    columns = [Column(name, over=over) for over in kinds for name in box.elements]
    rows: list[Values] = [
        (name, *(_of(getattr(gear, of), one) for of in kinds.values() for one in box.elements))
        for name, gear in box.gears.items()
    ]
    return grid_of("Torques of engaged elements, slips of open ones", ["gear", *columns], rows)


def set_grid(box: ListedBox) -> Grid:
    """Of each gear the speeds of carriers and planets, losses, power that goes round, drag."""
    columns = [
        Column(one, over=over) for over in ("carrier", "planets", "loss [%]") for one in box.ratios
    ]
    rows: list[Values] = []
    for name, gear in box.gears.items():
        speeds = [_of(own, one) for own in (gear.carriers, gear.planets) for one in box.ratios]
        losses = [exact(100 * gear.losses.get(one, math.nan)) for one in box.ratios]
        rows.append((name, *speeds, *losses, gear.circulating, gear.drag))
    title = "Speeds and losses of sets, power that circulates, drag"
    return grid_of(title, ["gear", *columns, "circulating", "drag"], rows)


def _of(values: Mapping[str, float], name: str) -> Cell:
    """A number; blank where there is none of the name."""
    return exact(values[name]) if name in values else BLANK


def _facts(box: ListedBox) -> Iterator[tuple[str, str]]:
    """What is told of the box as a whole besides."""
    none = tr("none")
    yield tr("skip shifts"), str(box.skip_shifts)
    yield tr("torque of both signs"), ", ".join(box.reversing) or none
    yield tr("may be one-way"), ", ".join(box.one_way) or none
    yield tr("ratios beyond"), ", ".join(exact(one).text for one in box.beyond) or none


def _figures(box: ListedBox, digits: int | None) -> Iterator[tuple[str, str]]:
    if box.known:
        yield tr("known as"), box.known
    named = {
        "mean loss [%]": 100 * box.loss,
        "largest torque": box.torque,
        "mean drag": box.drag,
        "planet speed": box.planet_speed,
        "slip": box.slip,
    }
    for name, value in named.items():
        yield heading(name), exact(value, digits=digits).text
    marks = {"in the Pareto list": box.pareto, "single": box.single, "planar": box.planar}
    yield tr("it is"), ", ".join(tr(name) for name, holds in marks.items() if holds) or "-"
    yield tr("scheme"), box.code
    for sets in box.ravigneaux.values():
        yield tr("Ravigneaux"), ", ".join(sets)
