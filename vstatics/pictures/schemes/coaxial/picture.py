"""Pages of a half-section with heading and rows; the title mentions crossings."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import NamedTuple

from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Canvas, Look, Point
from vstatics.pictures.drawing.head import sheet_head
from vstatics.pictures.drawing.labels import title_width
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import WIDE_MARGIN, Style
from vstatics.pictures.schemes.boxes import BoxText
from vstatics.pictures.schemes.captions import told_of
from vstatics.pictures.schemes.coaxial.chains import CoaxialChain, chained_state, unchained
from vstatics.pictures.schemes.coaxial.drawn.chain import chain_extent, draw_chain
from vstatics.pictures.schemes.coaxial.drawn.devices import draw_devices
from vstatics.pictures.schemes.coaxial.drawn.lines import Wires, wires_of
from vstatics.pictures.schemes.coaxial.drawn.links import draw_link_names, draw_links
from vstatics.pictures.schemes.coaxial.drawn.ports import draw_end
from vstatics.pictures.schemes.coaxial.fitting import fits, laid_out
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.rooms import extent
from vstatics.pictures.schemes.coaxial.section import NO_TEXTS, coaxial_scheme
from vstatics.pictures.schemes.ink import ARROW, AXIS_DASHES, FURTHER, SchemeInk
from vstatics.pictures.schemes.scheme import Scheme, SchemeState
from vstatics.pictures.schemes.sets import HalfSection
from vstatics.pictures.schemes.shift_element_symbols import meanings
from vstatics.pictures.schemes.titles import Titles


@dataclass(frozen=True)
class CoaxialSheet:
    """Half-section, with separate rows for chains before and after the gearbox."""

    layout: CoaxialLayout
    chains: Sequence[CoaxialChain] = ()

    @cached_property
    def wires(self) -> Wires:
        """Lines of links."""
        return wires_of(self.layout)

    def remarks(self, style: Style) -> list[str]:
        """Return remarks for the title, such as crossings or a different order of gear sets."""
        remarks = crossings_told(len(self.wires.crossings), style)
        if not self.layout.coaxial.train.end:
            remarks.append(style.text("output through the housing"))
        return remarks + order_told(self.layout, style)

    def rows(self, room: float) -> Iterator[CoaxialRow]:
        """Yield the rows from top to bottom, for a width [pt]."""
        scheme, texts = self.layout.coaxial.scheme, self.layout.coaxial.texts
        before, behind = (
            [
                CoaxialRow(chain_extent(scheme, part, texts), part)
                for chain in self.chains
                if chain.is_before == is_before
                for part in chain.broken(partial(_chain_width, scheme, texts=texts), room)
            ]
            for is_before in (True, False)
        )
        least = 1 / self.layout.letters
        section = [CoaxialRow(extent(self.layout), least=least)] * bool(self.layout.coaxial.devices)
        yield from (*before, *section, *behind)


class CoaxialRow(NamedTuple):
    """Row of a picture: a half-section, or a chain of components in series."""

    ends: tuple[Point, Point]
    """Lower left and upper right corner before scaling. [pt]"""
    chain: CoaxialChain | None = None
    least: float = 0.0
    """Smallest scale of lengths at which the letters of a half-section are readable. [-]"""

    def size(self, width: float) -> Point:
        """Return the size of the row scaled to a width, but not below the smallest scale [pt]."""
        (left, low), (right, high) = self.ends
        part = min(1.0, max(width / (right - left), self.least))
        return part * (right - left), part * (high - low)


def coaxial_sheet(
    scheme: Scheme,
    sections: Mapping[int, HalfSection],
    style: Style,
    texts: Mapping[int, BoxText] = NO_TEXTS,
) -> CoaxialSheet | None:
    """Return the half-section of a scheme, unless a component at three links has no symbol.

    On a narrow page, chains before and after the gearbox have separate rows.
    """
    whole, parts = coaxial_scheme(scheme, sections, texts=texts), unchained(scheme, sections)
    box = coaxial_scheme(parts.scheme, sections, parts.left_out, texts)
    if whole is None or box is None:
        return None
    if box.devices or not parts.chains:
        layout = laid_out(whole, style.width, is_ordered=style.ordered)
        if fits(layout, style.width) or not parts.chains:
            return CoaxialSheet(layout)
    return CoaxialSheet(laid_out(box, style.width, is_ordered=style.ordered), parts.chains)


def figures(  # noqa: PLR0913, PLR0917 - arguments of a picture
    results: Results,
    scheme: Scheme,
    sheet: CoaxialSheet,
    style: Style,
    shown: Iterable[Sequence[int]],
    subject: str,
    note: str = "",
) -> Iterator[list[Canvas]]:
    """Yield a page for each item of `shown`: no gear, or the number of a gear from 1.

    All pages have the same layout.
    """
    for gears in shown:
        caption = told_of(results, scheme, style, gears, subject=subject)
        yield [painted(sheet, style, *caption, note).canvas]


def crossings_told(count: int, style: Style) -> list[str]:
    """Return the remark on the number of crossings, in a list that is empty for 0.

    >>> crossings_told(2, Style()), crossings_told(0, Style())
    (['2 crossings'], [])
    """
    return [style.text("{count} crossing|{count} crossings", count=count)] if count else []


def order_told(layout: CoaxialLayout, style: Style) -> list[str]:
    """Return the remark, if gear sets are not in the order of the case, as a list."""
    if layout.is_ordered:
        return []
    return [style.text("sets in another order: no layout in that of the case was found")]


def _chain_width(scheme: Scheme, chain: CoaxialChain, *, texts: Mapping[int, BoxText]) -> float:
    low, high = chain_extent(scheme, chain, texts)
    return high[0] - low[0]


def draw_half_section(ink: SchemeInk, layout: CoaxialLayout, wires: Wires) -> None:
    """Draw a half-section with the axis, links, components and ports."""
    if not layout.coaxial.has_boxes:
        look: Look = {"linestyle": AXIS_DASHES, "kind": "axis", "data": {"axis": "1"}}
        ends = [(x + way * ARROW, y) for _, (x, y), way in wires.ends]
        ink.pen.line(*ends, color=ink.pen.style.faint, width=0.8, **look)
    draw_parts(ink, layout, wires)
    for link, at, way in wires.ends:
        if link:
            draw_end(ink, link, at, way)


def draw_parts(ink: SchemeInk, layout: CoaxialLayout, wires: Wires) -> None:
    """Draw links and components, without the lines along the axis."""
    draw_links(ink, layout, wires)
    draw_link_names(ink, layout)
    draw_devices(ink, layout)


def painted(  # noqa: PLR0913, PLR0917 - arguments of a picture
    sheet: CoaxialSheet,
    style: Style,
    state: SchemeState,
    titles: Titles,
    name: str,
    note: str = "",
) -> Pen:
    """Draw a half-section with the heading. Letters have a fixed size."""
    named = ", ".join([name, *sheet.remarks(style)])
    rows = list(sheet.rows(style.width))
    sizes = [row.size(style.width) for row in rows]
    least = title_width(named) + 2 * WIDE_MARGIN if style.titled else 0.0
    wide = max(*(wide for wide, _ in sizes), min(least, style.width))
    look: Look = {"color": style.ink, "linestyle": FURTHER}
    further = len(rows) > 1, "goes on in another row", look
    signs = [*meanings(state, style), further]
    head = sheet_head(named, note, signs, wide - 2 * WIDE_MARGIN, style)
    top = sum(high for _, high in sizes)
    page = head.over((wide, top), WIDE_MARGIN * bool(head.high), style)
    chains = [row.chain for row in rows if row.chain is not None]
    state_of_rows = chained_state(state, chains)
    for row, (_, high) in zip(rows, sizes, strict=True):
        top -= high
        pen = page.panel((0.0, top), (wide, high)).fitted(*row.ends)
        ink = SchemeInk(
            pen._replace(letters=1 / pen.part), sheet.layout.coaxial.scheme, state_of_rows, titles
        )
        if row.chain is None:
            draw_half_section(ink, sheet.layout, sheet.wires)
        else:
            scheme = replace(ink.scheme, ports=row.chain.ports)
            draw_chain(replace(ink, scheme=scheme), row.chain, sheet.layout.coaxial.texts)
    return page
