"""The power of each gear, of which the page shows one that is chosen."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from urllib.parse import quote

from vstatics.flow.power import GearFlow
from vstatics.flow.text import Row, remarks, sections
from vstatics.report.cells import Cell, numeric, table
from vstatics.report.markup import Markup, figure, tag
from vstatics.tables.grid import Column, text


def flow_by_gear(found: Sequence[GearFlow], drawn: Sequence[Markup]) -> Iterator[Markup]:
    """Links to choose a gear by, then the gears; without a script all of them show.

    Parameters
    ----------
    drawn : sequence of Markup
        The picture of each gear, or none at all.
    """
    links = (
        tag("a", flow.gear, href=f"#{_id(flow.gear)}", data_choose=flow.gear) for flow in found
    )
    yield tag("nav", "Gear: ", *links, class_="chooser", aria_label="Gear")
    for number, flow in enumerate(found):
        shown = [*_parts(flow)]
        if drawn and flow.ideal is not None:
            shown.insert(0, figure(f"Power flow in gear {flow.gear}", drawn[number]))
        yield tag("div", *shown, id=_id(flow.gear), data_gear=flow.gear)


def _id(gear: str) -> str:
    """The name of a gear as the end of an address, which has no blanks."""
    return f"gear={quote(gear, safe='')}"


def _parts(flow: GearFlow) -> Iterator[Markup]:
    title = f"Gear {flow.gear}"
    if flow.ideal is None:
        yield tag("h3", title)
        yield tag("p", f"{flow.note}, so there is no power to show".capitalize())
        return
    load = not math.isnan(flow.kilowatts)
    columns = [text("power through"), Column("ideal"), Column("with losses")]
    columns += [Column("kW")] * load + [Column("loss")] + [Column("loss, kW")] * load
    columns.append(Column("share, %"))
    rows: list[list[Cell | str]] = []
    levels = []
    for heading, lines in sections(flow):
        rows.append([heading, *[""] * (len(columns) - 1)])
        levels.append(1)
        for row, level in lines:
            rows.append(_row(row, flow.kilowatts))
            levels.append(level + 1)
    yield table(title, columns, rows, levels)
    yield tag("ul", *(tag("li", line.strip()) for line in remarks(flow)))


def _row(row: Row, unit: float) -> list[Cell | str]:
    """A line, in kW too where the load tells the unit."""
    load = not math.isnan(unit)
    cells: list[Cell | str] = [row.name, _cell(row.ideal), _cell(row.lossy)]
    cells += [_cell(None if row.lossy is None else row.lossy * unit)] * load
    cells.append(_cell(row.loss, 4))
    cells += [_cell(None if row.loss is None else row.loss * unit)] * load
    has_share = row.share is not None and not math.isnan(row.share)
    cells.append(_cell(100 * (row.share or 0.0) if has_share else None, 1))
    return cells


def _cell(value: float | None, decimals: int = 3) -> Cell | str:
    """A number, or an empty field."""
    return "" if value is None else numeric(value, decimals)
