"""HTML page and picture of found gearboxes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from vstatics.core.annexes import module_of_method
from vstatics.core.errors import CaseError
from vstatics.core.extras import higher, missing
from vstatics.core.tables.answer import plain_data
from vstatics.core.tables.html import Markup, joined, table, tag
from vstatics.core.tables.numbers import typeset
from vstatics.core.texts import spoken, tr
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.paged.inline import inline
from vstatics.pictures.paged.parts import Part, figure, line_of
from vstatics.synthesis.boxes.listing import BoxListing, WantedOfBoxes, drawn_boxes
from vstatics.synthesis.gears.names import in_order, names_of_gears
from vstatics.synthesis.report.box_parts import (
    all_grid,
    asked_range,
    asked_ratio,
    box_link,
    family_grid,
    middle,
    shown_box,
)

MOST_SHOWN_BOXES = 40
"""Largest number of gearboxes with a stick diagram on the page."""
MOST_LISTED = 1000
"""Largest number of gearboxes in the table."""


def box_pages(listing: BoxListing) -> dict[str, bytes]:
    """Return the page and the picture of found gearboxes, by file name.

    The page needs the annex `vstatics.page`, and the picture the extra `plot`; files that cannot be
    written are missing.

    Parameters
    ----------
    listing : BoxListing
        Found gearboxes; at least one.

    Raises
    ------
    CaseError
        If the list is empty.
    """
    pages = {}
    if module_of_method("stamped_page"):
        pages["boxes.html"] = boxes_page(listing).encode(errors="backslashreplace")
    if not missing("plot", "a picture"):
        from vstatics.synthesis.pictures.picture import render_boxes

        [pages["boxes.svg"]] = render_boxes(listing, "svg", Style())
    return pages


def boxes_page(
    listing: BoxListing,
    document: Mapping[str, Any] | None = None,
    digits: int | None = None,
    stamp: Mapping[str, str] | None = None,
) -> str:
    """Return the HTML page of found gearboxes, without pictures if matplotlib is missing.

    Parameters
    ----------
    document : mapping, optional
        Document of the listing, which the page contains as JSON with the listed gearboxes.
    digits : int, optional
        Number of decimals; by default a number that suits each quantity.
    stamp : mapping of str to str, optional
        Entries of the stamp, such as author, project and date.

    Raises
    ------
    CaseError
        If the list is empty.
    ReadError
        If the case of a drawn gearbox is not valid.
    """
    if not listing.boxes:
        raise CaseError("E009", "no gearbox was found, so there is nothing to show")
    without = missing("plot", "a picture")
    parts = [
        Part("Overview", list(_overview(listing, without))),
        Part("Boxes", list(_tables(listing, digits))),
        Part("Diagrams", list(_diagrams(listing, without, digits))),
    ]
    count = len(listing.boxes)
    title = tr("{count} found box|{count} found boxes", count=count)
    data = document or plain_data(listing._replace(boxes=()))
    boxes = document["boxes"] if document else map(plain_data, listing.boxes[:MOST_LISTED])
    listed = {**data, "boxes": [*boxes][:MOST_LISTED]}
    page: str = higher("stamped_page")(title, stamp or {}, _about(listing), parts, listed)
    return page


def _tables(listing: BoxListing, digits: int | None) -> Iterator[Markup]:
    drawn = {box.number for box in drawn_boxes(listing, MOST_SHOWN_BOXES)}
    yield table(all_grid(listing, MOST_LISTED, drawn).with_digits(digits))
    if len(listing.boxes) > MOST_LISTED:
        yield tag(
            "p",
            tr("These are the first {some} of {all}.", some=MOST_LISTED, all=len(listing.boxes)),
        )
    yield table(family_grid(listing).with_digits(digits))


def _about(listing: BoxListing) -> Iterator[Markup]:
    if listing.wanted:
        targets = "; ".join(_asked(listing.wanted))
        yield tag("p", typeset(tr("Wanted: {targets}.", targets=targets)), class_="told")


def _asked(wanted: WantedOfBoxes) -> Iterator[str]:
    ratios = [asked_ratio(ends, wanted.tolerance) for ends in wanted.ratios]
    if not wanted.gears:
        middles = [middle(ends) for ends in wanted.ratios]
        names = names_of_gears(middles)
        yield ", ".join(f"{names[place]}: {ratios[place]}" for place in in_order(middles))
        return
    least, most = wanted.gears
    count = str(most) if least == most else asked_range((least, most))
    yield tr("forward gears: {number}", number=count)
    for text, ends in (("spread {range}", wanted.spread), ("steps {range}", wanted.steps)):
        if ends:
            yield tr(text, range=asked_range(ends))
    if wanted.falling:
        yield tr("no step larger than the one below it")
    if ratios:
        yield tr("further ratios: {ratios}", ratios=", ".join(ratios))


def _line(listing: BoxListing) -> Markup:
    """Return the line of counts, with the gearboxes of smallest loss and of smallest torque."""
    facts: list[tuple[str, str]] = [
        (tr("looked at"), str(listing.searched)),
        (tr("choices of shift elements given up"), str(listing.given_up)),
        (tr("families, of equal ratios"), str(len(listing.families))),
        (tr("in the Pareto list"), str(sum(box.pareto for box in listing.boxes))),
    ]
    known = [box for box in listing.boxes if math.isfinite(box.loss)]
    if known:
        # Of gearboxes with equal loss, the first counts.
        least = min(known, key=lambda box: round(box.loss, 9))
        facts.append(
            (tr("least mean loss"), joined(f"{100 * least.loss:.3f} %, ", box_link(least)))
        )
    known = [box for box in listing.boxes if math.isfinite(box.torque)]
    if known:
        least = min(known, key=lambda box: round(box.torque, 9))
        value = f"{least.torque:.3f} {tr('× input')}, "
        facts.append((tr("least torque"), joined(value, box_link(least))))
    return line_of(facts)


def _overview(listing: BoxListing, without: str) -> Iterator[Markup]:
    yield _line(listing)
    if without:
        yield tag("p", tr("There are no pictures: {why}", why=without))
        return
    from vstatics.synthesis.pictures.picture import render_points

    svg = render_points(listing, drawn_boxes(listing, MOST_SHOWN_BOXES), spoken())
    name = tr("Mean loss over the largest torque")
    yield figure(name, inline(svg, "boxes", name))
    yield tag("p", tr("Boxes with a number have a diagram; each family has one colour."))


def _diagrams(listing: BoxListing, without: str, digits: int | None) -> Iterator[Markup]:
    shown = drawn_boxes(listing, MOST_SHOWN_BOXES)
    omitted = len(listing.boxes) - len(shown)
    if omitted:
        note = tr("Here are boxes of the Pareto list and the first of each family")
        more = tr(
            "{count} more is in the table only.|{count} more are in the table only.", count=omitted
        )
        yield tag("p", f"{note}; {more}")
    for box in shown:
        case = box.transmission()
        svg = None
        if not without:
            from vstatics.synthesis.pictures.stick import stick_diagram

            svg = stick_diagram(case, "")
        yield from shown_box(box, svg, digits, listing.wanted)
