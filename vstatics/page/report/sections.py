"""Sections of the page of a case."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from vstatics.core.flow.power_flow import GearFlow
from vstatics.core.flow.tables import power_grid, remarks
from vstatics.core.numerics.tolerances import ROUNDED_NUMBER
from vstatics.core.summary.tables import WITH_LOAD, Marks, element_signs, summary_grids
from vstatics.core.tables.grid import Cell, Column, Grid
from vstatics.core.tables.html import Markup, table, tables, tag
from vstatics.core.tables.result_tables import of_results, without_missing, without_zeros
from vstatics.core.texts import tr
from vstatics.page.report.asked import SECTIONS
from vstatics.page.report.explained import explained, no_formula
from vstatics.page.report.given import given
from vstatics.page.report.marks import marked_powers
from vstatics.page.report.material import Material
from vstatics.page.report.overview import alerts, overview
from vstatics.page.report.page_pictures import OF_A_VEHICLE
from vstatics.page.report.parts import conventions, in_gear, on_paper, side_by_side
from vstatics.page.report.sheets import flow_sheets
from vstatics.page.report.tools.marks import marked_links
from vstatics.pictures.paged.drawn import Drawn, name_of
from vstatics.pictures.paged.parts import Part, figures, gear_link, of_gear, on_screen

ALREADY = ("efficiency", "ratio")
"""Headings of columns of results by gear that the table of gears already contains."""
WELL = {
    "power balance": (0.0, "power balance 0"),
    "consistent": (1.0, "directions of power agree with the losses"),
    "locked": (0.0, "no self-locking gear"),
}
"""Value of a column of results if all is well, and the sentence that replaces it, by heading."""
PORTS, LARGEST = "ports", ("planets", "shift elements")
"""Keys of the table of ports, and of the tables of largest values, which also exist with units."""
MARKS = Marks(holds="○", open="")
SPREAD = "spread"
"""Key of the table of the ratio spread, which the overview shows instead."""
SHIFTS = ("transitions", "margins", "margins by gear")
"""Keys of the tables of shifts and of torque margins of shift elements."""
VEHICLE = ("vehicle gears", "vehicle")
"""Keys of the tables of a vehicle."""
DUTY = ("duty", "duty members", "damage")
"""Keys of the tables of a duty cycle."""


def sections(material: Material) -> Iterator[Part]:
    """Yield the sections of a page in order, except empty sections."""
    asked, pictures = material.asked, material.pictures.of_all
    grids = summary_grids(material.summary, [flow.ports for flow in material.flows])
    gears, *others = (asked.cut(grid).with_digits(material.digits) for grid in grids)
    others = [*material.marked(others)]
    every: dict[str, Iterable[Markup]] = {
        "overview": _overview(material),
        "gears": _gears(material, gears),
        "flow": _flows(material),
        "lever": _of_gears(material, "lever"),
        "equations": _equations(material),
        **{
            kind: figures(pictures[kind], name_of(kind), captioned=False)
            for kind in ("efficiency", "plan")
            if kind in pictures and not any(kind in part.drawn for part in material.parts.values())
        },
        "vehicle": _vehicle(material, others),
        "duty": tables(grid for grid in others if grid.key in DUTY),
        "largest": _largest(others),
        "shifts": tables(without_missing(grid) for grid in others if grid.key in SHIFTS),
        "input": given(
            material.results.case, material.document["case"], material.digits, material.marked
        ),
        "tables": _tables(material, others),
        "conventions": [conventions(material.document["conventions"])],
        **{key: part.shown(material.digits) for key, part in material.parts.items()},
    }
    for key, name in SECTIONS.items():
        inner = list(every[key]) if asked.has(key) and key in every else []
        if inner:
            yield Part(name, inner, asked.prints(key))


def _overview(material: Material) -> Iterator[Markup]:
    yield from overview(material)
    if material.without:
        yield tag("p", tr("There are no pictures: {why}", why=material.without))
    bare = material.pictures.bare_stick
    if bare is None:
        yield from _of_gears(material, "stick")
    else:
        shown = on_paper(bare, name_of(bare.kind))
        yield tag("div", shown, class_="bare") if material.has_run else shown
        yield on_screen(_of_gears(material, "stick"))
    yield from alerts(material.messages)


def _gears(material: Material, grid: Grid) -> Iterator[Markup]:
    """Yield the table of gears, with a sign for each engaged or locked shift element.

    The name of a gear is a link that chooses the gear for all sections.
    """
    results = material.results
    grid_of_gears = gears_grid(material, grid)
    rows = [[Cell(gear_link(first.text)), *others] for first, *others in grid_of_gears.cells]
    yield table(grid_of_gears._replace(rows=rows), headed=False)
    meanings = [(MARKS.engaged, "engaged")]
    meanings += [(MARKS.holds, "freewheel that holds")] * bool(results.case.freewheels)
    meanings += [(MARKS.slips, "slips")] * any(gear.slipping for gear in results.case.gears)
    if len(meanings) > 1:
        signs = ", ".join(f"{mark} {tr(meaning)}" for mark, meaning in meanings)
        yield tag("p", signs, class_="note")
    small = material.pictures.small_sticks
    if any(picture.sheets for picture in small):
        yield side_by_side([flow.gear for flow in material.shown_flows], small)


def gears_grid(material: Material, grid: Grid) -> Grid:
    """Return the table of gears with signs for shift elements, and marks for scripts."""
    results = material.results
    signs = [
        Column(element.name, is_sign=True, is_name=True) for element in results.case.shift_elements
    ]
    [grid] = material.marked([_without_last_step(grid)])
    columns = [grid.columns[0], *signs, *grid.columns[1:]]
    rows = [
        [row[0], *element_signs(results, index, MARKS), *row[1:]]
        for row in grid.cells
        for index, gear in enumerate(results.case.gears)
        if gear.name == row[0].text
    ]
    return Grid("Ratios, steps, efficiencies", columns, rows)


def _without_last_step(grid: Grid) -> Grid:
    """Return the table of gears with an empty step ratio where the next gear is missing."""
    step = [column.heading for column in grid.columns].index("step")
    blank = Cell("", math.nan, kind=float)
    rows = [
        [*row[:step], row[step] if row[step - 1].text else blank, *row[step + 1 :]]
        for row in grid.cells
    ]
    return grid._replace(rows=rows)


def _of_gears(material: Material, kind: str) -> Iterator[Markup]:
    """Yield a picture of each gear, or the reason why it is not drawn."""
    drawn = material.pictures.of_gears.get(kind, ())
    if drawn and not _differ(drawn):
        yield from figures(drawn[0], name_of(drawn[0].kind))
        return
    names = [flow.gear for flow in material.shown_flows]
    for name, picture in zip(names, drawn, strict=bool(drawn)):
        section = "gear" if kind == "stick" else kind
        shown = figures(picture, in_gear(picture.kind, name), captioned=False)
        yield of_gear(section, name, list(shown))


def _differ(drawn: Sequence[Drawn]) -> bool:
    """Return whether gears have pictures, or different reasons for missing pictures."""
    return any(picture.sheets for picture in drawn) or len({picture.why for picture in drawn}) > 1


def _flows(material: Material) -> Iterator[Markup]:
    drawn = material.pictures.of_gears.get("flow", ())
    has_stick = _differ(material.pictures.of_gears.get("stick", ()))
    # The links that choose a gear lead to the first section about gears.
    section = "flow" if has_stick else "gear"
    whole = material.pictures.flows
    if whole is not None:
        most = flow_sheets(len(material.parts))
        yield on_paper(whole, name_of("flow"), most=most)
    for number, flow in enumerate(material.shown_flows):
        shown = list(_power(flow, material))
        if drawn and flow.ideal is not None:
            name = in_gear("flow", flow.gear)
            shown = [*figures(drawn[number], name, captioned=False), *shown]
        yield of_gear(section, flow.gear, shown, is_printed=whole is None)


def _power(flow: GearFlow, material: Material) -> Iterator[Markup]:
    if flow.ideal is None:
        why = tr(flow.note).capitalize()
        yield tag("p", tr("{Why}, so there is no power to show", Why=why))
        return
    digits = material.digits
    powers = without_zeros(power_grid(flow))._replace(
        title=tr("Power in gear {gear}", gear=flow.gear)
    )
    powers = powers.with_digits(digits)
    if material.has_marks:
        powers = marked_links(marked_powers(powers, flow.gear), material.results.case)
    lines = (tag("li", line.strip()) for line in remarks(flow, digits, balanced=False))
    numbers = table(powers, headed=False)
    yield tag("div", numbers, tag("ul", *lines), class_="power")


def _equations(material: Material) -> Iterator[Markup]:
    without = no_formula()
    if without:
        yield tag("p", tr("There are no formulas: {why}", why=without))
    for flow, shown in zip(material.shown_flows, explained(material), strict=True):
        yield of_gear("equations", flow.gear, shown)


def _largest(summary: Sequence[Grid]) -> Iterator[Markup]:
    """Yield the largest speeds and torques; in print only the tables with units, if any."""
    largest = [grid for grid in summary if grid.key.removesuffix(WITH_LOAD) in LARGEST]
    loaded = [grid for grid in largest if grid.key.endswith(WITH_LOAD)]
    if loaded:
        yield on_screen(tables(grid for grid in largest if grid not in loaded))
    yield from tables(loaded or largest)


def _vehicle(material: Material, summary: Sequence[Grid]) -> Iterator[Markup]:
    yield from tables(grid for grid in summary if grid.key in VEHICLE)
    drawn = material.pictures.of_all
    for kind in (kind for kind in OF_A_VEHICLE if kind in drawn):
        yield from figures(drawn[kind], name_of(kind))


def _tables(material: Material, summary: Sequence[Grid]) -> Iterator[Markup]:
    """Yield the other tables of the summary, and results that no section shows."""
    asked = material.asked
    results = map(asked.cut, of_results(material.results, blanks=True))
    by_gear, *others = (grid.with_digits(material.digits) for grid in results)
    elsewhere = {SPREAD, *SHIFTS, *VEHICLE, *DUTY, *LARGEST}
    if not _has_further_ports(material):
        elsewhere.add(PORTS)
    shown_tables = (
        without_zeros(grid) if grid.key == "sensitivity" else grid
        for grid in summary
        if grid.key.removesuffix(WITH_LOAD) not in elsewhere
    )
    well = _well(by_gear)
    if well:
        yield tag(
            "p",
            tr("In all gears: {what}.", what=", ".join(tr(WELL[heading][1]) for heading in well)),
        )
    shown_columns = (*ALREADY, *well)
    further = by_gear.with_columns(
        [n for n, column in enumerate(by_gear.columns) if column.heading not in shown_columns]
    )
    with_columns = [further] * (len(further.columns) > 1)
    yield from tables([*shown_tables, *material.marked([*with_columns, *others])])


def _has_further_ports(material: Material) -> bool:
    return any(len(flow.ports.rows) > INPUT_AND_OUTPUT for flow in material.flows)


INPUT_AND_OUTPUT = 2


def _well(by_gear: Grid) -> list[str]:
    """Return the headings in `WELL` of columns where every gear has the value listed there."""
    columns = zip(by_gear.columns, zip(*by_gear.cells, strict=True), strict=True)
    return [
        column.heading
        for column, cells in columns
        if column.heading in WELL
        and all(
            cell.value is not None and abs(cell.value - WELL[column.heading][0]) < ROUNDED_NUMBER
            for cell in cells
        )
    ]
