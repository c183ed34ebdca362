"""The page of two cases: what is other in them, and what differs by that."""

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
"""Pictures of both that have a scale in common."""
OF_SHIFTS = ("transitions", "margins", "margins by gear", "needed capacity")
LARGEST = ("planets", "shift elements", "planets with load", "shift elements with load")
SIGN = "Changes are by the size of A: below 0 where a number falls, so where a negative one grows."
"""What the sign of a change means, as in `compare`."""


def pair_page(both: Sequence[PagedCase], stamp: Mapping[str, str] | None = None) -> str:
    """The page of two cases, each number of one beside that of the other.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.page.report.pair.paged import paged
    >>> cases = [Transmission(2, [], [Mechanism(1, 2, 0, u)], [Gear()]) for u in (-2.5, -3.0)]
    >>> made = pair_page([paged(*one) for one in zip("AB", map(solve, cases), ["a", "b"])])
    >>> made.count('<td class="differs" data-value="-2.5" data-number="-2.5" data-result="ratio"')
    2
    """
    first, second = both
    [verdict] = compare(second.material.results, first.material.results).cases
    parts = [
        Part(name, shown) for name, one in _sections(both, verdict).items() if (shown := [*one])
    ]
    title = tr("{first} and {second}", first=first.title, second=second.title)
    if first.title == second.title:
        both_files = tr("{first} and {second}", first=first.file, second=second.file)
        title = f"{first.title}: {both_files}"
    document = {one.label: {"file": one.file, **one.material.document} for one in both}
    frame = PageFrame(
        panel=toolbar.toolbar(),
        scripts=[toolbar.SCRIPT],
        style=joined(toolbar.STYLE, Markup(_style())),
        named=[one.material.document["case"] for one in both],
    )
    return framed(title, _told(both, stamp or {}), parts, document, frame)


def _style() -> str:
    return (files(__package__) / "pair.css").read_text(encoding="utf-8")


def _told(both: Sequence[PagedCase], stamp: Mapping[str, str]) -> Iterator[Markup]:
    yield from stamped(stamp)
    yield terms((one.label, f"{one.title}, {one.file}") for one in both)


def _sections(both: Sequence[PagedCase], verdict: CaseVerdict) -> dict[str, Iterable[Markup]]:
    summaries = [_summary(one) for one in both]
    own = zip(both, summaries, strict=True)
    gears = merged_tables(both, [gears_grid(one.material, grids["gears"]) for one, grids in own])
    keys = dict.fromkeys((*summaries[0], *summaries[1]))

    def of(chosen: Iterable[str]) -> Iterator[Grid]:
        for key in chosen:
            if key in keys:
                yield merged_tables(both, [one.get(key) for one in summaries])

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
    """The runs of two scenarios, and their tables as one."""
    if any(one.motion for one in both):
        shown, grids = higher("paired_runs")(
            [(one.label, one.material.results, one.motion) for one in both]
        )
        yield from shown
        yield from tables(merged_tables(both, pair) for pair in grids)


def _summary(one: PagedCase) -> dict[str, Grid]:
    """Tables of the summary by their keys, with marks."""
    made = summary_grids(one.material.summary)
    first, *others = (grid.with_digits(one.material.digits) for grid in made)
    return {grid.key: grid for grid in [first, *one.material.marked(others)]}


def _results(both: Sequence[PagedCase]) -> Iterator[Grid]:
    """All tables of the results that one of both has."""
    own = [
        {
            grid.key: grid
            for grid in one.material.marked(
                made.with_digits(one.material.digits)
                for made in of_results(one.material.results, blanks=True)
            )
        }
        for one in both
    ]
    return (merged_tables(both, [one.get(key) for one in own]) for key in {**own[0], **own[1]})


def _overview(both: Sequence[PagedCase], verdict: CaseVerdict) -> Iterator[Markup]:
    """What is other in a line, then what there is to watch in each."""
    said = verdict.headline.removeprefix(f"{verdict.name}: ")
    yield tag("p", f"{said[:1].upper()}{said[1:]}.", class_="verdict")
    yield table(merged_tables(both, [_figures(one.material) for one in both]), headed=False)
    yield tag("p", tr(SIGN), class_="note")
    for one in both:
        if one.material.messages:
            yield tag("h3", tr("Messages of {case}", case=one.label))
            yield from (tag("div", shown) for shown in alerts(one.material.messages))
        case, own = one.material.results.case, one.material
        yield toolbar.tools_of(case, one.label, own.digits)


def _figures(material: Material) -> Grid:
    """What a designer asks first."""
    made, largest = material.summary.design, material.summary.largest
    known = [one.efficiency for one in made.gears if not math.isnan(one.efficiency)]
    shown = [one.shown for one in material.flows if one.shown]
    shares = [one.circulating_share for one in shown if not math.isnan(one.circulating_share)]
    found = [overall(largest.get(key, ())) for key in (LOSSY_TORQUES, TORQUES)]
    torques = [abs(one.value) for one in found if one is not None and one.gear]
    rows = [
        ("gears", len(made.gears)),
        ("spread", made.spread),
        ("lowest efficiency", min(known, default=math.nan)),
        (f"largest element torque, {RELATIVE}", [*torques, math.nan][0]),
        ("largest circulation, % of the input power", 100 * max(shares, default=math.nan)),
    ]
    said = ((Cell(heading(name)), value) for name, value in rows)
    return grid_of("Figures", ["figure", "value"], said).with_digits(material.digits)


def _changes(both: Sequence[PagedCase], verdict: CaseVerdict) -> Iterator[Markup]:
    """What is other in the cases, by paths as of a sweep."""
    if not verdict.case:
        yield tag("p", tr("The cases are the same, but perhaps for names and descriptions."))
        return
    rows = [[path, *shown_values(old, new)] for path, old, new in verdict.case]
    rows = [["\N{EN DASH}" if one == "null" else one for one in row] for row in rows]
    columns = [text("path"), *(text(one.label) for one in both)]
    yield table(Grid("Changes of the case", columns, rows), headed=False)


def _gears_of_one(both: Sequence[PagedCase]) -> Iterator[Markup]:
    """Gears without one of their name in the other case."""
    names = [[gear.name for gear in one.material.results.case.gears] for one in both]
    for one, own, others in zip(both, names, reversed(names), strict=True):
        alone = [name for name in own if name not in others]
        if alone:
            said = tr(
                "Only {case} has gear {names}.|Only {case} has gears {names}.",
                case=one.label,
                names=", ".join(alone),
                count=len(alone),
            )
            yield tag("p", said, class_="note")


def _pictures(both: Sequence[PagedCase]) -> Iterator[Markup]:
    """Stick diagrams, side by side on a screen; steps and efficiencies on a common scale."""
    try:
        require("plot", "a picture")
    except CaseError as error:
        yield tag("p", tr("There are no pictures: {why}", why=error))
        return
    yield tag("div", *(_stick(one) for one in both), class_="two wide")
    pair = [PairedCase(f"{one.title}, {one.file}", one.material.results) for one in both]
    for kind in filter(picture_kinds().get, ON_ONE_SCALE):
        try:
            made = pair_pages(pair, kind, "svg", in_spoken(PAGE))
        except CaseError as error:
            yield from figures(Drawn(kind, [], " ".join(str(error).split())), name_of(kind))
            continue
        sheets = [inline(svg, f"{kind}-{n}", name_of(kind)) for n, svg in enumerate(made)]
        yield from figures(Drawn(kind, sheets), name_of(kind))


def _stick(one: PagedCase) -> Markup:
    """The stick diagram of no gear, or its structure."""
    try:
        kind, made = "stick", pages(one.material.results, "stick", "svg", in_spoken(PAGE))
    except CaseError:
        kind, made = "structure", pages(one.material.results, "structure", "svg", in_spoken(PAGE))
    name = f"{one.label}: {name_of(kind)}"
    sheets = [inline(svg, f"{one.label}-{kind}-{n}", name) for n, svg in enumerate(made)]
    return tag("div", *figures(Drawn(kind, sheets), name), data_case=one.label)
