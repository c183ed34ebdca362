"""Page of two cases: changes of their input and of their results."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib.resources import files

from vstatics.core.annexes import picture_kinds
from vstatics.core.comparison.compare import compare
from vstatics.core.comparison.layout import shown_values
from vstatics.core.comparison.verdicts import CaseVerdict
from vstatics.core.errors import CaseError
from vstatics.core.extras import higher, require
from vstatics.core.summary.extremes import LOSSY_TORQUES, TORQUES, overall
from vstatics.core.summary.tables import summary_grids
from vstatics.core.tables.grid import Cell, Grid, grid_of, text
from vstatics.core.tables.html import Markup, joined, table, tables, tag, terms
from vstatics.core.tables.result_tables import of_results
from vstatics.core.texts import heading, tr
from vstatics.page.report.asked import SECTIONS
from vstatics.page.report.html_page import PageFrame, framed, stamped
from vstatics.page.report.material import Material
from vstatics.page.report.overview import alerts
from vstatics.page.report.pair.paged import PagedCase, merged_tables
from vstatics.page.report.parts import conventions
from vstatics.page.report.sections import gears_grid
from vstatics.page.report.tools import toolbar
from vstatics.page.report.tools.marks import RELATIVE
from vstatics.pictures import pages
from vstatics.pictures.paged.drawn import PAGE, Drawn, in_spoken, name_of
from vstatics.pictures.paged.inline import inline
from vstatics.pictures.paged.parts import Part, figures
from vstatics.pictures.pair import PairedCase, pair_pages

ON_ONE_SCALE = ("steps", "efficiency")
"""Kinds of pictures in which both cases have a common scale."""
OF_SHIFTS = ("transitions", "margins", "margins by gear", "needed capacity")
LARGEST = ("planets", "shift elements", "planets with load", "shift elements with load")
SIGN = "Changes are relative to the magnitude of A; they are negative where a number decreases."
"""Text on the page about the sign of changes, which is the sign in `compare`."""


def pair_page(both: Sequence[PagedCase], stamp: Mapping[str, str] | None = None) -> str:
    """Return the page of two cases, whose corresponding numbers are in successive rows.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.page.report.pair.paged import paged
    >>> cases = [Transmission(2, [], [Mechanism(1, 2, 0, u)], [Gear()]) for u in (-2.5, -3.0)]
    >>> page = pair_page([paged(*case) for case in zip("AB", map(solve, cases), ["a", "b"])])
    >>> page.count('<td class="differs" data-value="-2.5" data-number="-2.5" data-result="ratio"')
    2
    """
    first, second = both
    [verdict] = compare(second.material.results, first.material.results).cases
    parts = [
        Part(name, shown) for name, inner in _sections(both, verdict).items() if (shown := [*inner])
    ]
    title = tr("{first} and {second}", first=first.title, second=second.title)
    if first.title == second.title:
        both_files = tr("{first} and {second}", first=first.file, second=second.file)
        title = f"{first.title}: {both_files}"
    document = {case.label: {"file": case.file, **case.material.document} for case in both}
    frame = PageFrame(
        panel=toolbar.toolbar(),
        scripts=[toolbar.SCRIPT],
        style=joined(toolbar.STYLE, Markup(_style())),
        named=[case.material.document["case"] for case in both],
    )
    return framed(title, _about(both, stamp or {}), parts, document, frame)


def _style() -> str:
    return (files(__package__) / "pair.css").read_text(encoding="utf-8")


def _about(both: Sequence[PagedCase], stamp: Mapping[str, str]) -> Iterator[Markup]:
    yield from stamped(stamp)
    yield terms((case.label, f"{case.title}, {case.file}") for case in both)


def _sections(both: Sequence[PagedCase], verdict: CaseVerdict) -> dict[str, Iterable[Markup]]:
    summaries = [_summary(case) for case in both]
    cases_and_grids = zip(both, summaries, strict=True)
    gears = merged_tables(
        both,
        [gears_grid(case.material, grids["gears"]) for case, grids in cases_and_grids],
    )
    keys = dict.fromkeys((*summaries[0], *summaries[1]))

    def of(chosen: Iterable[str]) -> Iterator[Grid]:
        for key in chosen:
            if key in keys:
                yield merged_tables(both, [case.get(key) for case in summaries])

    elsewhere = ("gears", "spread", *LARGEST, *OF_SHIFTS)
    others = (key for key in keys if key not in elsewhere)
    return {
        SECTIONS["overview"]: _overview(both, verdict),
        "Changes": _changes(both, verdict),
        SECTIONS.get("run", ""): _runs(both),
        SECTIONS["gears"]: [*_gears_of_one(both), table(gears, headed=False)],
        "Pictures": _pictures(both),
        SECTIONS["largest"]: tables(of(LARGEST)),
        SECTIONS["shifts"]: tables(of(OF_SHIFTS)),
        SECTIONS["tables"]: tables([*of(others), *_results(both)]),
        SECTIONS["conventions"]: [conventions(both[0].material.document["conventions"])],
    }


def _runs(both: Sequence[PagedCase]) -> Iterator[Markup]:
    if any(case.motion for case in both):
        shown, grids = higher("paired_runs")(
            [(case.label, case.material.results, case.motion) for case in both]
        )
        yield from shown
        yield from tables(merged_tables(both, pair) for pair in grids)


def _summary(case: PagedCase) -> dict[str, Grid]:
    grids = summary_grids(case.material.summary)
    first, *others = (grid.with_digits(case.material.digits) for grid in grids)
    return {grid.key: grid for grid in [first, *case.material.marked(others)]}


def _results(both: Sequence[PagedCase]) -> Iterator[Grid]:
    by_key = [
        {
            grid.key: grid
            for grid in case.material.marked(
                result_grid.with_digits(case.material.digits)
                for result_grid in of_results(case.material.results, blanks=True)
            )
        }
        for case in both
    ]
    return (
        merged_tables(both, [case.get(key) for case in by_key])
        for key in {**by_key[0], **by_key[1]}
    )


def _overview(both: Sequence[PagedCase], verdict: CaseVerdict) -> Iterator[Markup]:
    """Yield the verdict of the comparison, and the main figures and messages of each case."""
    headline = verdict.headline.removeprefix(f"{verdict.name}: ")
    yield tag("p", f"{headline[:1].upper()}{headline[1:]}.", class_="verdict")
    yield table(merged_tables(both, [_figures(case.material) for case in both]), headed=False)
    yield tag("p", tr(SIGN), class_="note")
    for case in both:
        if case.material.messages:
            yield tag("h3", tr("Messages of {case}", case=case.label))
            yield from (tag("div", shown) for shown in alerts(case.material.messages))
        material = case.material
        yield toolbar.tools_of(material.results.case, case.label, material.digits)


def _figures(material: Material) -> Grid:
    design, largest = material.summary.design, material.summary.largest
    known = [gear.efficiency for gear in design.gears if not math.isnan(gear.efficiency)]
    gear_powers = [gear.shown for gear in material.flows if gear.shown]
    shares = [
        gear.circulating_share for gear in gear_powers if not math.isnan(gear.circulating_share)
    ]
    extremes = [overall(largest.get(key, ())) for key in (LOSSY_TORQUES, TORQUES)]
    torques = [abs(gear.value) for gear in extremes if gear is not None and gear.gear]
    rows = [
        ("gears", len(design.gears)),
        ("spread", design.spread),
        ("lowest efficiency", min(known, default=math.nan)),
        (f"largest torque of a shift element, {RELATIVE}", [*torques, math.nan][0]),
        ("largest recirculating power, % of the input power", 100 * max(shares, default=math.nan)),
    ]
    figure_rows = ((Cell(heading(name)), value) for name, value in rows)
    return grid_of("Figures", ["figure", "value"], figure_rows).with_digits(material.digits)


def _changes(both: Sequence[PagedCase], verdict: CaseVerdict) -> Iterator[Markup]:
    """Yield the changes of input data, named by paths as in a sweep."""
    if not verdict.case:
        yield tag("p", tr("The cases are the same, but perhaps for names and descriptions."))
        return
    rows = [[path, *shown_values(old, new)] for path, old, new in verdict.case]
    rows = [["\N{EN DASH}" if case == "null" else case for case in row] for row in rows]
    columns = [text("path"), *(text(case.label) for case in both)]
    yield table(Grid("Changes of the case", columns, rows), headed=False)


def _gears_of_one(both: Sequence[PagedCase]) -> Iterator[Markup]:
    """Yield notes about gears that either case lacks."""
    names = [[gear.name for gear in case.material.results.case.gears] for case in both]
    for case, gears, others in zip(both, names, reversed(names), strict=True):
        alone = [name for name in gears if name not in others]
        if alone:
            note = tr(
                "Only {case} has gear {names}.|Only {case} has gears {names}.",
                case=case.label,
                names=", ".join(alone),
                count=len(alone),
            )
            yield tag("p", note, class_="note")


def _pictures(both: Sequence[PagedCase]) -> Iterator[Markup]:
    """Yield stick diagrams of both cases side by side, and charts on common scales."""
    try:
        require("plot", "a picture")
    except CaseError as error:
        yield tag("p", tr("There are no pictures: {why}", why=error))
        return
    yield tag("div", *(_stick(case) for case in both), class_="two wide")
    pair = [PairedCase(f"{case.title}, {case.file}", case.material.results) for case in both]
    for kind in filter(picture_kinds().get, ON_ONE_SCALE):
        try:
            svg_texts = pair_pages(pair, kind, "svg", in_spoken(PAGE))
        except CaseError as error:
            yield from figures(Drawn(kind, [], " ".join(str(error).split())), name_of(kind))
            continue
        sheets = [inline(svg, f"{kind}-{n}", name_of(kind)) for n, svg in enumerate(svg_texts)]
        yield from figures(Drawn(kind, sheets), name_of(kind))


def _stick(case: PagedCase) -> Markup:
    try:
        kind, svg_texts = (
            "stick",
            pages(case.material.results, "stick", "svg", in_spoken(PAGE)),
        )
    except CaseError:
        kind, svg_texts = (
            "structure",
            pages(case.material.results, "structure", "svg", in_spoken(PAGE)),
        )
    name = f"{case.label}: {name_of(kind)}"
    sheets = [inline(svg, f"{case.label}-{kind}-{n}", name) for n, svg in enumerate(svg_texts)]
    return tag("div", *figures(Drawn(kind, sheets), name), data_case=case.label)
