"""The page: its sections, and the data that it carries."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from importlib.resources import files
from typing import Any

from vstatics.flow.grids import power_grid, remarks
from vstatics.flow.power_flow import GearFlow
from vstatics.report.drawn import palette
from vstatics.report.gathering import Material
from vstatics.report.given import given
from vstatics.report.motion import shown_run
from vstatics.report.parts import chooser, figure, figures, of_gear
from vstatics.report.vibration_parts import shown_vibration
from vstatics.summary import Summary
from vstatics.summary.grids import Marks, element_signs, grids
from vstatics.tables.grid import Column, Grid
from vstatics.tables.grids import of_results
from vstatics.tables.html import Markup, joined, table, tag, terms

POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'"
"""A browser loads nothing from anywhere."""


def page(material: Material) -> str:
    """The whole page, as HTML.

    Parameters
    ----------
    material : Material
        See `gather`.
    """
    title = material.results.case.name or "Transmission"
    return framed(title, _about(material), list(_sections(material)), material.document)


Part = tuple[str, Sequence[Markup]]
"""The name of a section, and what it shows."""


def framed(
    title: str, about: Iterable[Markup], parts: Sequence[Part], document: dict[str, Any]
) -> str:
    """A page of sections with its contents, its look and the data that it carries.

    Parameters
    ----------
    about : iterable of Markup
        What stands below the title.
    document : dict
        What the page shows, as JSON.
    """
    contents = tag("nav", *(tag("a", name, href=f"#{_id(name)}") for name, _ in parts))
    body = tag(
        "body",
        tag("header", tag("h1", title), *about, contents),
        tag("main", *(_section(name, inner) for name, inner in parts)),
        _data(document),
        tag("script", _resource("script.js")),
    )
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", http_equiv="Content-Security-Policy", content=POLICY),
        tag("title", title),
        tag("style", _styles()),
    )
    return f"<!DOCTYPE html>\n{tag('html', head, body, lang='en')}\n"


def _about(material: Material) -> Iterator[Markup]:
    case = material.results.case
    if case.description:
        yield tag("p", case.description, class_="told")
    if case.source:
        yield tag("p", "Source: ", case.source, class_="told source")


def _sections(material: Material) -> Iterator[Part]:
    """Each section of the page with its name."""
    results = material.results
    gears, *others = (one.with_digits(material.digits) for one in grids(material.summary))
    yield "Messages", [_messages(material.messages)]
    yield "Gears", [_gears(material.summary, gears), *_spread(others)]
    yield "Input", list(given(results, material.document["case"], material.digits))
    yield "Pictures", list(_pictures(material))
    yield "Power flow", list(_power_flow(material))
    if material.vibration:
        yield "Vibration", list(shown_vibration(material.vibration, material.digits))
    if material.run:
        yield "Run", list(shown_run(material.run, material.digits))
    yield "Shifts and largest values", [table(one) for one in others if one.title != SPREAD]
    yield "Results", [table(one.with_digits(material.digits)) for one in of_results(results)]
    conventions = material.document["conventions"].items()
    yield "Conventions", [terms((name.replace("_", " "), text) for name, text in conventions)]


SPREAD = "Spread"


def _spread(others: Sequence[Grid]) -> Iterator[Markup]:
    """The spread in a line."""
    for grid in others:
        if grid.title == SPREAD:
            [(first, last, spread)] = grid.texts
            yield tag("p", f"Spread: {spread}, from gear {first} to gear {last}.")


def _gears(summary: Summary, grid: Grid) -> Markup:
    """The table of gears, with a dot for each shift element that is engaged or holds."""
    elements = summary.results.case.shift_elements
    columns = [
        grid.columns[0],
        *(Column(element.name, is_sign=True) for element in elements),
        *grid.columns[1:],
    ]
    rows = [
        [row[0], *element_signs(summary.results, index, Marks()), *row[1:]]
        for index, row in enumerate(grid.rows)
    ]
    return table(Grid("Ratios, steps, efficiencies", columns, rows))


def _messages(messages: Sequence[str]) -> Markup:
    if not messages:
        return tag("p", "None.")
    lines = (tag("li", one, class_=one.partition(":")[0]) for one in messages)
    return tag("ul", *lines, class_="messages")


def _pictures(material: Material) -> Iterator[Markup]:
    if material.without:
        yield tag("p", f"There are no pictures: {material.without}")
    for drawn in material.pictures:
        if drawn.kind != BY_GEAR:
            yield from figures(drawn, drawn.kind.capitalize())


def _power_flow(material: Material) -> Iterator[Markup]:
    """Links to choose a gear by, then the gears; without a script all of them show."""
    flows = material.flows
    yield chooser("gear", [flow.gear for flow in flows])
    drawn = [sheet for one in material.pictures if one.kind == BY_GEAR for sheet in one.sheets]
    for number, flow in enumerate(flows):
        shown = [*_power(flow, material.digits)]
        if drawn and flow.ideal is not None:
            shown.insert(0, figure(f"Power flow in gear {flow.gear}", drawn[number]))
        yield of_gear("gear", flow.gear, shown)


BY_GEAR = "flow"
"""The picture that stands with the numbers of each gear."""


def _power(flow: GearFlow, digits: int | None) -> Iterator[Markup]:
    if flow.ideal is None:
        yield tag("h3", f"Gear {flow.gear}")
        yield tag("p", f"{flow.note}, so there is no power to show".capitalize())
        return
    yield table(power_grid(flow).with_digits(digits))
    yield tag("ul", *(tag("li", line.strip()) for line in remarks(flow, digits)))


def _section(name: str, inner: Sequence[Markup]) -> Markup:
    return tag("section", tag("h2", name), *inner, id=_id(name))


def _id(name: str) -> str:
    return name.lower().replace(" ", "-")


def _data(document: dict[str, Any]) -> Markup:
    """The result in JSON; a text of the case cannot end the script that it stands in."""
    text = json.dumps(document, ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")
    return tag("script", Markup(text), type="application/json", id="result")


def _resource(name: str) -> Markup:
    return Markup((files(__package__) / name).read_text(encoding="utf-8"))


def _styles() -> Markup:
    """The style sheet, after the colours of pictures for paper and for a dark screen."""
    dark = f"@media screen and (prefers-color-scheme: dark) {{ :root {{ {palette(dark=True)} }} }}"
    light = f":root {{ {palette(dark=False)} }}"
    return joined(Markup(f"{light}\n{dark}\n"), _resource("style.css"))
