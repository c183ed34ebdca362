"""Tables as HTML, and functions that build HTML and escape plain text."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from html import escape
from itertools import groupby

from vstatics.core.tables.grid import NOTHING, Cell, Column, Grid
from vstatics.core.tables.numbers import typeset


class Markup(str):
    """HTML text, which is not escaped again."""

    __slots__ = ()


VOID = {"input", "meta"}
"""HTML elements without an end tag."""


def tag(name: str, /, *children: str, **attributes: object) -> Markup:
    """Return an HTML element; children other than `Markup` are escaped.

    Parameters
    ----------
    name : str
        Name of the HTML element.
    *children : str
    **attributes
        Attributes. False omits an attribute, and True writes only its name. ``class_`` becomes
        ``class``, and other underscores become hyphens.

    Examples
    --------
    >>> tag("td", "a < b", class_="name", data_value=0.5, hidden=True, id=False)
    '<td class="name" data-value="0.5" hidden>a &lt; b</td>'
    >>> tag("p", tag("b", "&"))
    '<p><b>&amp;</b></p>'
    """
    written = "".join(_attribute(key, value) for key, value in attributes.items())
    start = f"<{name}{written}>"
    return Markup(start) if name in VOID else Markup(f"{start}{joined(*children)}</{name}>")


def _attribute(key: str, value: object) -> str:
    if value is False:
        return ""
    name = key.removesuffix("_").replace("_", "-")
    return f" {name}" if value is True else f' {name}="{escape(str(value))}"'


def joined(*parts: str) -> Markup:
    """Join parts of HTML, and escape plain text.

    >>> joined(tag("b", "1"), " < 2")
    '<b>1</b> &lt; 2'
    """
    return Markup("".join(part if isinstance(part, Markup) else escape(part) for part in parts))


def filled(text: str, **places: str) -> Markup:
    """Return a text in which texts or HTML replace the placeholders.

    >>> filled("{spread} > {first}", spread="7 < 8", first=tag("b", "1"))
    '7 &lt; 8 &gt; <b>1</b>'
    """
    return Markup(escape(text).format(**{place: joined(name) for place, name in places.items()}))


_SHOWN = re.compile(r"<svg\b.*?</svg(?=>)|(>)([^<>]+)(?=<)|( aria-label=\")([^\"]+)", re.DOTALL)
_LONE_MINUS = re.compile(r"(?<=\s)-(?=\s)")


def printed(shown: Markup, names: Iterable[str] = ()) -> Markup:
    """Return HTML with typographic minus signs and dashes in the visible texts.

    Pictures do not change, because they already have minus signs.

    Parameters
    ----------
    shown : Markup
    names : iterable of str
        Names that do not change, even if they look like numbers.

    Examples
    --------
    >>> printed(joined(tag("td", "-3"), tag("p", "-3, -0.5 - w")), ["-3", "8-1"])
    '<td>-3</td><p>-3, −0.5 − w</p>'
    >>> printed(tag("td", "-"))
    '<td>–</td>'
    """
    unchanged = {escaped for name in {*names} if _in_print(escaped := escape(name)) != escaped}
    words = "|".join(map(re.escape, sorted(unchanged, key=len, reverse=True)))
    split = re.compile(rf"((?<![\w.])(?:{words})(?!\w|\.\d))") if unchanged else None

    def typeset_match(match: re.Match[str]) -> str:
        before, text = match[1] or match[3], match[2] or match[4]
        if text is None or "-" not in text or text in unchanged:
            return match[0]
        if text == NOTHING:
            return f"{before}\N{EN DASH}"
        parts = split.split(text) if split else [text]
        return before + "".join(part if part in unchanged else _in_print(part) for part in parts)

    return Markup(_SHOWN.sub(typeset_match, shown))


def _in_print(text: str) -> str:
    return _LONE_MINUS.sub("\N{MINUS SIGN}", typeset(text))


def terms(entries: Iterable[tuple[str, str]]) -> Markup:
    """Return an HTML list of terms with descriptions.

    >>> terms([("input", "sun")])
    '<dl><dt>input</dt><dd>sun</dd></dl>'
    """
    return tag("dl", *(joined(tag("dt", term), tag("dd", text)) for term, text in entries))


def table(grid: Grid, *, headed: bool = True, level: int = 3) -> Markup:
    """Return a scrollable HTML table with a title. A table without rows is only a title.

    The attribute ``data-value`` contains all digits of a number.

    Parameters
    ----------
    grid : Grid
    headed : bool
        True to show the title; False if the text above the table already states it.
    level : int
        Level of the HTML heading; 4 below the heading of a gear.
    """
    grid = grid.spoken
    if not grid.rows:
        return tag("p", grid.title)
    heading = [tag(f"h{level}", grid.title)] * headed
    return tag("section", *heading, scrolled(bare(grid), grid.title), class_="table")


def bare(grid: Grid) -> Markup:
    """Return an HTML table without a title."""
    heads = (tag("th", item.heading, class_=_kind(item)) for item in grid.columns)
    rows = [*_over(grid), tag("tr", *heads)]
    levels = grid.levels or [0] * len(grid.rows)
    body = (_row(grid, row, level) for row, level in zip(grid.cells, levels, strict=True))
    return tag("table", tag("thead", *rows), tag("tbody", *body))


def _over(grid: Grid) -> Iterator[Markup]:
    """Yield a row with the common headings of adjacent columns (`Column.over`), if any."""
    if any(column.over for column in grid.columns):
        heads = []
        for over, columns in groupby(grid.columns, lambda column: column.over):
            count = len([*columns])
            spans = {"colspan": count} if count > 1 else {}
            heads.append(tag("th", over, scope="colgroup" if over else False, **spans))
        yield tag("tr", *heads, class_="over")


NARROW_TABLE = 72
"""Largest width of tables that can be side by side, in characters."""


def tables(grids: Iterable[Grid], level: int = 3) -> Iterator[Markup]:
    """Yield HTML tables with titles of a heading level; narrow tables are side by side."""
    for narrow, group in groupby(grids, _is_narrow):
        shown = (table(grid, level=level) for grid in group)
        yield from [tag("div", *shown, class_="side")] if narrow else shown


MOST_SHOWN = 50
"""Largest number of rows of a table shown in a notebook."""


def shown(grids: Iterable[Grid]) -> Markup:
    """Return tables for a notebook. A long table is cut, with a count of the hidden rows.

    >>> from vstatics.core.tables.grid import grid_of
    >>> numbers = grid_of("Numbers < 60", ["number"], [[n] for n in range(60)])
    >>> shown([numbers]).count("<tr>"), shown([numbers])[-46:]
    (51, '<p>Numbers &lt; 60: 10 more rows</p></section>')
    """

    def short(grid: Grid) -> Markup:
        grid, more = grid.spoken, len(grid.rows) - MOST_SHOWN
        levels = grid.levels or [1] * len(grid.rows)
        rows = [
            [first._replace(text="\N{EM SPACE}" * (level - 1) + first.text), *others]
            for level, (first, *others) in zip(levels, grid.cells, strict=True)
        ]  # a notebook has no style sheet for indented rows
        first = table(grid._replace(rows=rows[:MOST_SHOWN], levels=()))
        if more <= 0:
            return first
        return tag("section", first, tag("p", f"{grid.title}: {more} more rows"))

    return joined(*map(short, grids))


def _is_narrow(grid: Grid) -> bool:
    grid = grid.spoken
    lines = [[column.heading for column in grid.columns], *grid.texts]
    widths = (max(map(len, texts)) + 2 for texts in zip(*lines, strict=True))
    return bool(grid.rows) and sum(widths) <= NARROW_TABLE


def scrolled(inner: Markup, label: str) -> Markup:
    """Return a scrollable container for content that can be wider than the screen."""
    return tag("div", inner, class_="scroll", tabindex=0, role="group", aria_label=label)


def _row(grid: Grid, row: list[Cell], level: int) -> Markup:
    name = f"<th{_marks(row[0])}>{_text(row[0])}</th>"
    cells = "".join(_cell(*pair) for pair in zip(grid.columns[1:], row[1:], strict=True))
    return Markup(f"<tr{_attribute('data_level', level or False)}>{name}{cells}</tr>")


def _cell(column: Column, cell: Cell) -> str:
    """Return a table cell like `tag`, but in a third of the time, because pages have many cells."""
    look = "sign" if cell.says else _kind(column) or ""
    if cell.look:
        look = f"{look} {cell.look}".lstrip()
    start = f'<td class="{look}"' if look else "<td"
    if cell.value is not None:
        value = "" if math.isnan(cell.value) else repr(float(cell.value)).removesuffix(".0")
        start += f' data-value="{value}"'
    return f"{start}{_marks(cell)}>{_text(cell)}</td>"


def _marks(cell: Cell) -> str:
    return "".join([f' data-{key}="{escape(value)}"' for key, value in cell.marks.items()])


def _text(cell: Cell) -> str:
    if cell.says and cell.text:
        return tag("span", cell.text, role="img", aria_label=cell.says)
    return joined(cell.text if cell.value is None else typeset(cell.text))


def _kind(column: Column) -> str | bool:
    """Return the HTML class of the cells of a column; False for numbers, the usual content."""
    return "words" if not column.is_number else "sign" if column.is_sign else False
