"""The sections of the page of a case, in their order."""

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

ALREADY = ("ETA", "ratio")
"""Columns of the results by gear that the table of gears has."""
WELL = {
    "power balance": (0.0, "power balance 0"),
    "consistent": (1.0, "directions of power agree with the losses"),
    "locked": (0.0, "none locked by friction"),
}
"""Of columns of the results by gear: the number that says that all is well, and it in words."""
PORTS, LARGEST = "ports", ("planets", "shift elements")
"""Tables of ports, and of largest values; these have a key in units, too."""
MARKS = Marks(holds="○", open="")
SPREAD = "spread"
"""The table that the overview says in words."""
SHIFTS = ("transitions", "margins", "margins by gear")
"""Tables that are about what shifts, and what it can carry."""
VEHICLE = ("vehicle gears", "vehicle")
"""Tables of what a vehicle does."""
DUTY = ("duty", "duty members", "damage")
"""Tables of a duty cycle."""


def sections(material: Material) -> Iterator[Part]:
    """Each section with its name; those that would be empty are left out."""
    asked, pictures = material.asked, material.pictures.of_all
    told = summary_grids(material.summary, [one.ports for one in material.flows])
    gears, *others = (asked.cut(one).with_digits(material.digits) for one in told)
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
        "duty": tables(one for one in others if one.key in DUTY),
        "largest": _largest(others),
        "shifts": tables(without_missing(one) for one in others if one.key in SHIFTS),
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
    """What a designer asks first, the scheme, then what there is to watch."""
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
    """The table of gears, with a dot for each shift element that is engaged or holds.

    The name of a gear chooses it for all that is shown of one.
    """
    results = material.results
    made = gears_grid(material, grid)
    rows = [[Cell(gear_link(first.text)), *others] for first, *others in made.cells]
    yield table(made._replace(rows=rows), headed=False)
    if results.case.freewheels:
        yield tag(
            "p",
            f"{MARKS.engaged} {tr('engaged')}, {MARKS.holds} {tr('freewheel that holds')}",
            class_="note",
        )
    small = material.pictures.small_sticks
    if any(one.sheets for one in small):
        yield side_by_side([flow.gear for flow in material.shown_flows], small)


def gears_grid(material: Material, grid: Grid) -> Grid:
    """The gears of a summary with a sign for each shift element, and with marks."""
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
        yield from figures(drawn[0], name_of(drawn[0].kind))
        return
    names = [flow.gear for flow in material.shown_flows]
    for name, one in zip(names, drawn, strict=bool(drawn)):
        section = "gear" if kind == "stick" else kind
        shown = figures(one, in_gear(one.kind, name), captioned=False)
        yield of_gear(section, name, list(shown))


def _differ(drawn: Sequence[Drawn]) -> bool:
    """Whether gears have pictures, or reasons of their own why they have none."""
    return any(one.sheets for one in drawn) or len({one.why for one in drawn}) > 1


def _flows(material: Material) -> Iterator[Markup]:
    """Of each gear the picture of its power, and the numbers."""
    drawn = material.pictures.of_gears.get("flow", ())
    has_stick = _differ(material.pictures.of_gears.get("stick", ()))
    section = "flow" if has_stick else "gear"  # where the links to a gear lead
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
        yield tag("p", _no_power(flow))
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


def _no_power(flow: GearFlow) -> str:
    """Why a gear has no flow of power."""
    return tr("{Why}, so there is no power to show", Why=tr(flow.note).capitalize())


def _equations(material: Material) -> Iterator[Markup]:
    """Of each gear its ratio, why it is so, and the equations behind all its numbers."""
    without = no_formula()
    if without:
        yield tag("p", tr("There are no formulas: {why}", why=without))
    for flow, shown in zip(material.shown_flows, explained(material), strict=True):
        yield of_gear("equations", flow.gear, shown)


def _largest(summary: Sequence[Grid]) -> Iterator[Markup]:
    """The largest speeds and torques; those in units are printed, if there are such."""
    own = [one for one in summary if one.key.removesuffix(WITH_LOAD) in LARGEST]
    loaded = [one for one in own if one.key.endswith(WITH_LOAD)]
    if loaded:
        yield on_screen(tables(one for one in own if one not in loaded))
    yield from tables(loaded or own)


def _vehicle(material: Material, summary: Sequence[Grid]) -> Iterator[Markup]:
    """What the vehicle does in each gear: numbers, its wheel force, the speeds of its engine."""
    yield from tables(one for one in summary if one.key in VEHICLE)
    drawn = material.pictures.of_all
    for kind in (kind for kind in OF_A_VEHICLE if kind in drawn):
        yield from figures(drawn[kind], name_of(kind))


def _tables(material: Material, summary: Sequence[Grid]) -> Iterator[Markup]:
    """What the summary has besides the gears, then all results, each number once."""
    asked = material.asked
    results = map(asked.cut, of_results(material.results, blanks=True))
    by_gear, *others = (one.with_digits(material.digits) for one in results)
    elsewhere = {
        SPREAD,
        *SHIFTS,
        *VEHICLE,
        *DUTY,
        *LARGEST,
        *(f"{one}{WITH_LOAD}" for one in LARGEST),
    }
    if not _has_further_ports(material):
        elsewhere.add(PORTS)
    told = (one for one in summary if one.key not in elsewhere)
    well = _well(by_gear)
    if well:
        yield tag(
            "p", tr("In all gears: {what}.", what=", ".join(tr(WELL[one][1]) for one in well))
        )
    told_of = (*ALREADY, *well)
    besides = by_gear.with_columns(
        [n for n, one in enumerate(by_gear.columns) if one.heading not in told_of]
    )
    with_columns = [besides] * (len(besides.columns) > 1)
    told = (without_zeros(one) if one.key == "sensitivity" else one for one in told)
    yield from tables([*told, *material.marked([*with_columns, *others])])


def _has_further_ports(material: Material) -> bool:
    """Whether a gear has more than an input and an output, which ratio and efficiency tell."""
    return any(len(one.ports.rows) > INPUT_AND_OUTPUT for one in material.flows)


INPUT_AND_OUTPUT = 2


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
