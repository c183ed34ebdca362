"""The page of a case that calculates by itself: sliders, and scripts that follow them.

`core.js` is the calculation of a gear, `results.js` gives it numbers and makes rows of tables,
`drawn.js` moves pictures, with a script for each kind that follows, `live.js` takes numbers from
sliders and brings results to the page.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from html import unescape
from importlib.resources import files
from typing import Any

from vstatics.model.parts import OfLoad
from vstatics.model.transmission import Transmission
from vstatics.report.html_page import PageFrame, about, choice, framed, in_language
from vstatics.report.live.fields import SCRIPT, STYLE, PageField, case_fields, shown_fields
from vstatics.report.live.lowered import lowered
from vstatics.report.live.packed import packed
from vstatics.report.material import Material
from vstatics.report.parts import SCREEN
from vstatics.report.runs import scripts as runs
from vstatics.report.sections import Part, sections
from vstatics.report.tools import toolbar
from vstatics.report.tools.toolbar import compact
from vstatics.tables.html import Markup, joined, tag
from vstatics.texts import tr

_MARKS = re.compile(
    r'(?: data-value="[^"]*")? data-result="([^"]*)"(?: data-row="([^"]*)")?'
    r' data-gear="([^"]*)" data-number="([^"]*)"'
)
_UNPACKED = frozenset({"change", "gears"})
"""Sections that are there before a script has run."""
_SCRIPTS = ("results.js", "drawn.js", "lever.js", "flow.js", "live.js")
OUTSIDE = "outside: run the program"
"""Where the page does not calculate."""


def live_page(material: Material) -> str:
    """The page of a case with sliders for its numbers, which its results follow.

    Parameters
    ----------
    material : Material
        With marks on its numbers; see `vstatics.report.gather`.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.report import gather
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -4.0, name="pair")], [Gear()])
    >>> made = live_page(gather(solve(case), has_marks=True))
    >>> made.count('class="slider"'), made.count('<script id="core">')
    (2, 1)
    """
    case = material.results.case
    known = lowered(case) | {"digits": material.digits, "words": {"idle": tr("idle")}}
    fields = [*live_fields(case, known["numbers"])]
    revert = tag("button", tr("Revert"), id="revert", type="button", hidden=True)
    told = toolbar.tools_of(case, digits=material.digits)
    change = Part("Change", [tag("div", *shown_fields(fields), class_="fields"), revert, told])
    texts: dict[str, int] = {}
    shown = (
        one._replace(shown=[_shortened(each, texts) for each in one.shown])
        for one in sections(material)
    )
    parts = [change._replace(is_printed=False), *shown]
    known["texts"] = [*texts]
    moves = material.run is not None and bool(material.run.moves)
    frame = PageFrame(
        choice=choice(material),
        panel=joined(
            toolbar.toolbar(),
            tag("p", tr(OUTSIDE), id="outside", class_=SCREEN, role="status", hidden=True),
            tag("p", id="why-outside", class_=SCREEN, hidden=True),
        ),
        scripts=[toolbar.SCRIPT, *(runs.SCRIPTS if moves else ())],
        end=joined(
            tag("script", _data(known), type="application/json", id="lowered"),
            tag("script", in_language(_resource("core.js")), id="core"),
            *(tag("script", in_language(one)) for one in (SCRIPT, *map(_resource, _SCRIPTS))),
        ),
        style=joined(toolbar.STYLE, STYLE, _resource("live.css"), runs.STYLE if moves else ""),
    )
    title = material.naming.title(case.name, runs=material.run is not None)
    page = framed(title, about(material), parts, material.document, frame)
    return packed(page, _UNPACKED)


def _shortened(shown: Markup, texts: dict[str, int]) -> Markup:
    """The marks of numbers as one attribute, which its script spells out: they are many.

    >>> texts = {}
    >>> shown = ' data-value="1.5" data-result="W" data-row="a b" data-gear="1" data-number="1.5"'
    >>> _shortened(Markup(f"<td{shown}>"), texts), [*texts]
    ('<td data-marks="0 1 2 1.5">', ['W', 'a b', '1'])
    """

    def short(found: re.Match[str]) -> str:
        *marks, number = found.groups()
        places = [
            "" if one is None else texts.setdefault(unescape(one), len(texts)) for one in marks
        ]
        return f' data-marks="{" ".join(map(str, [*places, number]))}"'

    return Markup(_MARKS.sub(short, shown))


def live_fields(case: Transmission, numbers: Mapping[str, float]) -> Iterator[PageField]:
    """The fields of the numbers that a page calculates with, those of a part together."""
    told = {one.path: one for one in case_fields(case)}
    units = {path: unit for gear in case.gears for path, unit in _units(case, gear)}
    found = [
        told.get(path, PageField(path, value))._replace(value=value, unit=units.get(path, ""))
        for path, value in numbers.items()
    ]
    order = dict.fromkeys(one.owner for one in found)
    for owner in order:
        yield from (one for one in found if one.owner == owner)


def _units(case: Transmission, gear: Any) -> Iterator[tuple[str, str]]:
    """Of given speeds and torques those that have a unit."""
    for kind, unit in (("speeds", "rpm"), ("torques", "N*m")):
        for link, value in getattr(gear, kind).items():
            if isinstance(value, OfLoad):
                yield f"gears.{gear.name}.{kind}.{case.link_name(link)}", unit


def _data(known: Mapping[str, Any]) -> Markup:
    """Plain data within a script; no text of the case ends it, and NaN is null."""
    return compact(_finite(known))


def _finite(data: Any) -> Any:
    if isinstance(data, Mapping):
        return {key: _finite(value) for key, value in data.items()}
    if isinstance(data, Sequence) and not isinstance(data, str):
        return [*map(_finite, data)]
    return None if isinstance(data, float) and not math.isfinite(data) else data


def _resource(name: str) -> Markup:
    return Markup((files(__package__) / name).read_text(encoding="utf-8"))
