"""Parts of the page of found gearboxes: tables, and figures and gears of each gearbox."""

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
    """Return a link to the stick diagram of a gearbox."""
    return tag("a", tr("box {number}", number=box.number), href=f"#box-{box.number}")


def all_grid(listing: BoxListing, most: int, drawn: Collection[int]) -> Grid:
    """Return the table of gearboxes with figures, at most `most` gearboxes.

    Gearboxes of a core differ only in clutches. They share the row of the first gearbox, which
    unfolds to the others.

    Parameters
    ----------
    drawn : collection of int
        Numbers of gearboxes with a stick diagram, to which the table links.
    """
    cores: dict[int, list[ListedBox]] = {}
    for box in listing.boxes[:most]:
        cores.setdefault(box.core, []).append(box)
    numbers = ("family", "loss [%]", "torque", "drag", "planet speed", "slip", "error [%]")
    front = (*numbers, "brakes", "clutches")
    signs = (Column(name, is_sign=True) for name in ("Pareto", "single", "planar"))
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
    headings: list[str | Column] = ["box", *names, *front, *signs, "code", "shift elements"]
    return grid_of("Boxes in their order", headings, rows, optional=names)


def _named(box: ListedBox, drawn: Collection[int]) -> str:
    return box_link(box) if box.number in drawn else tr("box {number}", number=box.number)


def _variants(boxes: Sequence[ListedBox], drawn: Collection[int]) -> Cell:
    """Return a cell that unfolds to the gearboxes of a core, with differences and main figures."""
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
    """Return the table of families of gearboxes with the gear ratios."""
    names = list(dict.fromkeys(name for box in listing.boxes for name in box.gears))
    rows: list[Values] = []
    for family, boxes in list(listing.families.items())[:MOST_FAMILIES]:
        ratios = {name: gear.ratio for name, gear in boxes[0].gears.items()}
        rows.append((family, len(boxes), _numbers(boxes), *map(ratios.get, names)))
    columns = (Column(name, is_name=True) for name in names)
    headings: list[str | Column] = ["family", "boxes", "its boxes", *columns]
    return grid_of("Families: boxes with equal ratios in all gears", headings, rows)


MOST_FAMILIES = 1000
"""Largest number of families in the table."""
MOST_NAMED = 12
"""Largest number of gearboxes of a family whose numbers are listed."""


def _numbers(boxes: Sequence[ListedBox]) -> str:
    shown = " ".join(str(box.number) for box in boxes[:MOST_NAMED])
    return f"{shown} ..." if len(boxes) > MOST_NAMED else shown


def middle(ends: Range) -> float:
    """Return the geometric mean of the ends of a wanted range [-]."""
    low, high = ends
    return math.copysign(math.sqrt(low * high), low)


def asked_ratio(ends: Range, tolerance: float) -> str:
    """Return a wanted ratio as text: a number if `tolerance` gives the range, or else the range."""
    return f"{middle(ends):g}" if _is_number(ends, tolerance) else asked_range(ends)


def asked_range(ends: Range) -> str:
    """Return a range as text."""
    low, high = ends
    return tr("{low} to {high}", low=f"{low:g}", high=f"{high:g}")


def _is_number(ends: Range, tolerance: float) -> bool:
    low, high = ends
    return math.isclose(abs(math.log(high / low)), 2 * tolerance, rel_tol=1e-6)


def gear_grid(box: ListedBox, wanted: WantedOfBoxes | None) -> Grid:
    """Return the table of gears with engaged shift elements, ratio and wanted ratio."""
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
    """Return the wanted ratio of a gear, and the deviation unless the wanted ratio is a range.

    The cells are blank for a gear without a wanted ratio.
    """
    if wanted is not None:
        ranges = (ends for ends in wanted.ratios if math.isclose(middle(ends), gear.target))
        ends = next(ranges, None)
        if ends is None or not _is_number(ends, wanted.tolerance):
            return Cell("" if ends is None else asked_range(ends), math.nan, kind=float), BLANK
    return gear.target, 100 * (gear.ratio / gear.target - 1) if gear.target else None


BLANK = Cell("", math.nan, kind=float)
"""Empty cell in a column of numbers."""


def _mark(holds: bool) -> Cell:  # noqa: FBT001 - content of the cell
    """Return a dot if a property holds, else a blank."""
    return sign(holds) if holds else sign(holds)._replace(text="")


def shown_box(
    box: ListedBox, svg: bytes | None, digits: int | None, wanted: WantedOfBoxes | None
) -> Iterator[Markup]:
    """Yield figures, diagram, gears and gear sets of a gearbox, with further tables folded."""
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
    yield from tables(grid.with_digits(digits) for grid in (gear_grid(box, wanted), ratios))
    more = (grid.with_digits(digits) for grid in (element_grid(box), set_grid(box)))
    summary = tr("Torques, slips, speeds, losses and drag by gear")
    yield tag("details", tag("summary", summary), line_of(_further_facts(box)), *map(table, more))


def element_grid(box: ListedBox) -> Grid:
    """Return the table of torques of engaged, and slips of open, shift elements by gear."""
    kinds = {"torque": "torques", "slip": "slips"}
    columns = [Column(name, over=over) for over in kinds for name in box.elements]
    rows: list[Values] = [
        (
            name,
            *(
                _cell_of(getattr(gear, field), element)
                for field in kinds.values()
                for element in box.elements
            ),
        )
        for name, gear in box.gears.items()
    ]
    return grid_of("Torques and slips of shift elements", ["gear", *columns], rows)


def set_grid(box: ListedBox) -> Grid:
    """Return the table of carrier and planet speeds, losses and drag by gear."""
    columns = [
        Column(set_name, over=over)
        for over in ("carrier", "planets", "loss [%]")
        for set_name in box.ratios
    ]
    rows: list[Values] = []
    for name, gear in box.gears.items():
        speeds = [
            _cell_of(set_speeds, set_name)
            for set_speeds in (gear.carriers, gear.planets)
            for set_name in box.ratios
        ]
        losses = [exact(100 * gear.losses.get(set_name, math.nan)) for set_name in box.ratios]
        rows.append((name, *speeds, *losses, gear.circulating, gear.drag))
    title = "Speeds and losses of sets, recirculating power, drag"
    return grid_of(title, ["gear", *columns, "recirculating", "drag"], rows)


def _cell_of(values: Mapping[str, float], name: str) -> Cell:
    return exact(values[name]) if name in values else BLANK


def _further_facts(box: ListedBox) -> Iterator[tuple[str, str]]:
    none = tr("none")
    yield tr("skip shifts"), str(box.skip_shifts)
    yield tr("torque of both signs"), ", ".join(box.reversing) or none
    yield tr("may be one-way"), ", ".join(box.one_way) or none
    yield tr("ratios beyond"), ", ".join(exact(ratio).text for ratio in box.beyond) or none


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
