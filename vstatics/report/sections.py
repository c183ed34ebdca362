"""The sections of the page of a case, in their order."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from vstatics.flow.grids import power_grid, remarks
from vstatics.flow.power_flow import GearFlow
from vstatics.report.explained import explained, no_formula
from vstatics.report.given import given
from vstatics.report.material import Material
from vstatics.report.motion import shown_run
from vstatics.report.overview import alerts, overview
from vstatics.report.page_pictures import NAMES, Drawn
from vstatics.report.parts import figures, gear_link, of_gear
from vstatics.report.vibration import shown_vibration
from vstatics.summary.grids import Marks, element_signs
from vstatics.summary.grids import grids as summary_grids
from vstatics.tables.grid import Cell, Column, Grid
from vstatics.tables.grids import of_results, without_missing, without_zeros
from vstatics.tables.html import Markup, table, tables, tag, terms
from vstatics.tables.numbers import ROUNDED_NUMBER

Part = tuple[str, Sequence[Markup]]
"""The name of a section, and what it shows."""
RUN = "Run"
"""The section on the run of a scenario."""
ALREADY = ("ETA", "ratio")
"""Columns of the results by gear that the table of gears has."""
WELL = {
    "power balance": (0.0, "power balance 0"),
    "consistent": (1.0, "directions of power agree with the losses"),
    "locked": (0.0, "none locked by friction"),
}
"""Of columns of the results by gear: the number that says that all is well, and it in words."""
MATRIX = "AJK"
"""The table that the equations of each gear have."""
MARKS = Marks(holds="○", open="")
SPREAD = "spread"
"""The table that the overview says in words."""
SHIFTS = ("transitions", "margins", "margins by gear")
"""Tables that are about what shifts, and what it can carry."""


def sections(material: Material) -> Iterator[Part]:
    """Each section with its name; those that would be empty are left out."""
    pictures = material.pictures.of_all
    gears, *others = (one.with_digits(material.digits) for one in summary_grids(material.summary))
    conventions = material.document["conventions"]
    every: dict[str, Iterable[Markup]] = {
        "Overview": _overview(material),
        RUN: shown_run(material.run, material.digits) if material.run else (),
        "Gears": _gears(material, gears),
        NAMES["flow"]: _flows(material),
        NAMES["lever"]: _of_gears(material, "lever"),
        "Equations": _equations(material),
        **{
            NAMES[kind]: figures(pictures[kind], NAMES[kind], captioned=False)
            for kind in ("efficiency", "plan")
            if kind in pictures
        },
        "Vibration": (
            shown_vibration(material.vibration, material.digits) if material.vibration else ()
        ),
        "Shifts": tables(without_missing(one) for one in others if one.key in SHIFTS),
        "Input": given(material.results.case, material.document["case"], material.digits),
        "Tables": _tables(material, others),
        "Conventions": [
            terms((name.replace("_", " "), text) for name, text in conventions.items())
        ],
    }
    for name, parts in every.items():
        inner = list(parts)
        if inner:
            yield name, inner


def _overview(material: Material) -> Iterator[Markup]:
    """What a designer asks first, the scheme, then what there is to watch."""
    yield from overview(material)
    if material.without:
        yield tag("p", f"There are no pictures: {material.without}")
    yield from _of_gears(material, "stick")
    yield from alerts(material.messages)


def _gears(material: Material, grid: Grid) -> Iterator[Markup]:
    """The table of gears, with a dot for each shift element that is engaged or holds.

    The name of a gear chooses it for all that is shown of one.
    """
    results = material.results
    signs = [Column(element.name, is_sign=True) for element in results.case.shift_elements]
    columns = [grid.columns[0], *signs, *grid.columns[1:]]
    grid = _without_last_step(grid)
    rows = [
        [Cell(gear_link(gear.name)), *element_signs(results, index, MARKS), *row[1:]]
        for index, (gear, row) in enumerate(zip(results.case.gears, grid.rows, strict=True))
    ]
    yield table(Grid("Ratios, steps, efficiencies", columns, rows), headed=False)
    if results.case.freewheels:
        yield tag(
            "p", f"{MARKS.engaged} engaged, {MARKS.holds} freewheel that holds", class_="note"
        )


def _without_last_step(grid: Grid) -> Grid:
    """A gear without a next one has no step."""
    step = [column.heading for column in grid.columns].index("step")
    blank = Cell("", math.nan, kind=float)
    rows = [
        [*row[:step], row[step] if row[step - 1].text else blank, *row[step + 1 :]]
        for row in grid.cells
    ]
    return grid._replace(rows=rows)


def _of_gears(material: Material, kind: str) -> Iterator[Markup]:
    """A picture of each gear, or why there is none."""
    drawn = material.pictures.of_gears.get(kind, ())
    if drawn and not _differ(drawn):
        yield from figures(drawn[0], NAMES[drawn[0].kind])
        return
    names = [flow.gear for flow in material.flows]
    for name, one in zip(names, drawn, strict=bool(drawn)):
        section = "gear" if kind == "stick" else kind
        shown = figures(one, f"{NAMES[one.kind]}, gear {name}", captioned=False)
        yield of_gear(section, name, list(shown))


def _differ(drawn: Sequence[Drawn]) -> bool:
    """Whether gears have pictures, or reasons of their own why they have none."""
    return any(one.sheets for one in drawn) or len({one.why for one in drawn}) > 1


def _flows(material: Material) -> Iterator[Markup]:
    """Of each gear the picture of its power, and the numbers."""
    drawn = material.pictures.of_gears.get("flow", ())
    has_stick = _differ(material.pictures.of_gears.get("stick", ()))
    section = "flow" if has_stick else "gear"  # where the links to a gear lead
    for number, flow in enumerate(material.flows):
        shown = list(_power(flow, material.digits))
        if drawn and flow.ideal is not None:
            name = f"{NAMES['flow']}, gear {flow.gear}"
            shown = [*figures(drawn[number], name, captioned=False), *shown]
        yield of_gear(section, flow.gear, shown)


def _power(flow: GearFlow, digits: int | None) -> Iterator[Markup]:
    if flow.ideal is None:
        yield tag("p", f"{flow.note}, so there is no power to show".capitalize())
        return
    powers = without_zeros(power_grid(flow))._replace(title=f"Power in gear {flow.gear}")
    lines = (tag("li", line.strip()) for line in remarks(flow, digits, balanced=False))
    numbers = table(powers.with_digits(digits), headed=False)
    yield tag("div", numbers, tag("ul", *lines), class_="power")


def _equations(material: Material) -> Iterator[Markup]:
    """Of each gear its ratio, why it is so, and the equations behind all its numbers."""
    without = no_formula()
    if without:
        yield tag("p", f"There are no formulas: {without}")
    for flow, shown in zip(material.flows, explained(material), strict=True):
        yield of_gear("equations", flow.gear, shown)


def _tables(material: Material, summary: Sequence[Grid]) -> Iterator[Markup]:
    """What the summary has besides the gears, then all results, each number once."""
    results = of_results(material.results, blanks=True)
    by_gear, *others = (one.with_digits(material.digits) for one in results)
    told = (one for one in summary if one.key not in (SPREAD, *SHIFTS))
    rest = (one for one in others if one.key != MATRIX or not material.flows)
    well = _well(by_gear)
    if well:
        yield tag("p", f"In all gears: {', '.join(WELL[one][1] for one in well)}.")
    told_of = (*ALREADY, *well)
    besides = by_gear.with_columns(
        [n for n, one in enumerate(by_gear.columns) if one.heading not in told_of]
    )
    with_columns = [besides] * (len(besides.columns) > 1)
    told = (without_zeros(one) if one.key == "sensitivity" else one for one in told)
    yield from tables([*told, *with_columns, *rest])


def _well(by_gear: Grid) -> list[str]:
    """The columns that say of all gears that all is well."""
    found = zip(by_gear.columns, zip(*by_gear.cells, strict=True), strict=True)
    return [
        column.heading
        for column, cells in found
        if column.heading in WELL
        and all(
            cell.value is not None and abs(cell.value - WELL[column.heading][0]) < ROUNDED_NUMBER
            for cell in cells
        )
    ]
