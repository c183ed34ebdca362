"""Pages as tests read them: their elements, tables, and the data that they carry."""

import json
import math
from html.parser import HTMLParser
from pathlib import Path
from typing import Any, NamedTuple

from tests.commands import vstatics
from vstatics.core.tables.html import VOID
from vstatics.core.tables.numbers import typeset

NASTY = "<script>alert(1)</script>"
NASTY_CASE = f"""\
name: "{NASTY}"
description: "</script><b>bold</b> & more"
source: "http://example.org/?a=1&b=2 <i>"
links: ["<b>in</b>", 'r"ing', "out'"]
load: {{speed: 2100 rpm, torque: 1200 N*m}}
shift_elements: {{"<C>": ["<b>in</b>", 'r"ing'], B: {{links: ['r"ing', housing], capacity: 9}}}}
mechanisms: {{"D&": {{first: "<b>in</b>", second: 'r"ing', third: "out'", ratio: -2.5}}}}
gears: {{"low <1>": {{engaged: [B]}}, "dir%/'ect": {{engaged: ["<C>"]}}}}
"""


class Element(NamedTuple):
    """An element of a page, with the text of all that is in it."""

    tag: str
    attributes: dict[str, str | None]
    words: list[str]
    inside: list[str]
    """Names of the elements around it."""

    @property
    def text(self) -> str:
        """Of everything in it."""
        return "".join(self.words)


class Page(HTMLParser):
    """The elements of a page in their order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[Element] = []
        self.open: list[Element] = []
        self.feed(text)
        self.close()
        assert not self.open

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Keep it, and open it."""
        assert len({name for name, _ in attrs}) == len(attrs)
        element = Element(tag, dict(attrs), [], [one.tag for one in self.open])
        self.elements.append(element)
        if tag not in VOID:
            self.open.append(element)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """One without an end, in a picture."""
        self.handle_starttag(tag, attrs)
        self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        """Close what was opened last."""
        assert self.open.pop().tag == tag

    def handle_data(self, data: str) -> None:
        """Text of all that is open."""
        for element in self.open:
            element.words.append(data)

    def all(self, tag: str) -> list[Element]:
        """Those of a name."""
        return [one for one in self.elements if one.tag == tag]

    @property
    def data(self) -> Any:
        """The result that the page carries."""
        [script] = [one for one in self.all("script") if one.attributes.get("id") == "result"]
        return json.loads(script.text)

    def table(self, title: str) -> dict[str, dict[str, Element]]:
        """The cells of a table by row and column, the first of its title."""
        start = next(
            place
            for place, one in enumerate(self.elements)
            if one.tag == "div"
            and (one.attributes.get("aria-label") or "").startswith(typeset(title))
        )
        rows: list[list[Element]] = []
        for one in self.elements[start + 1 :]:
            if one.tag in ("section", "div", "figure", "script"):
                break
            if one.tag == "tr":
                rows.append([])
            elif one.tag in ("td", "th"):
                rows[-1].append(one)
        if any("colspan" in one.attributes or one.tag == "td" for one in rows[0]):
            del rows[0]  # what stands over the columns
        heads = [one.text for one in rows[0]]
        return {row[0].text: dict(zip(heads, row, strict=True)) for row in rows[1:]}


def number(cell: Element) -> float:
    """As it is shown; NaN for what does not exist."""
    return math.nan if cell.text in ("", "\u2013") else float(cell.text.replace("\u2212", "-"))


def value(cell: Element) -> float | None:
    given = cell.attributes["data-value"]
    return float(given) if given else None


def write(folder: Path, text: str) -> Path:
    file = folder / "case.yaml"
    file.write_text(text, "utf-8")
    return file


def report(case: object, *options: object) -> str:
    said = vstatics("report", case, "-o", "-", *options)
    assert said.status == 0, said.err
    return said.out
