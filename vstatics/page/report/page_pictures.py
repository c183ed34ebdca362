"""Pictures as SVG that stands within a page: own ids, colours that follow the screen.

What their parts look like is said once for a page in place of once for each part.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import NamedTuple
from xml.etree import ElementTree as ET

from vstatics.core.errors import CaseError
from vstatics.core.extras import require
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.results import Results
from vstatics.core.tables.html import Markup
from vstatics.core.texts import spoken, tr
from vstatics.page.report.asked import EVERYTHING, AskedPage
from vstatics.pictures import of_each_gear, pages
from vstatics.pictures.drawing.style import PAGE_HEIGHT, POINTS_PER_MILLIMETRE, Style
from vstatics.pictures.drawing.words import KINDS
from vstatics.simulation.record.motion import Motion

_LIGHT, _DARK = Style(), Style(dark=True)
_NAMES = ("paper", "ink", "soft", "faint", "engaged", "lost", "circulating", "power")
_PAIRS = {name: (getattr(_LIGHT, name), getattr(_DARK, name)) for name in _NAMES} | {
    f"colour{number}": pair
    for number, pair in enumerate(zip(_LIGHT.colours, _DARK.colours, strict=True))
}
"""Colours of pictures on paper and on a dark screen, by the name of their variable."""
_COLOUR_NAMES = {light: name for name, (light, _) in _PAIRS.items()}
_REFERENCE = re.compile(r"url\(#([^)]+)\)")
_COLOUR = re.compile("#[0-9a-f]{6}")
_COLOURED = ("style", "fill", "stroke")


NAMES = KINDS
"""What a kind of picture is called."""
OF_ALL_GEARS = ("efficiency", "plan")
OF_A_VEHICLE = ("traction", "sawtooth")
"""Of a case whose vehicle has an engine."""


def of_all_gears(case: Transmission) -> tuple[str, ...]:
    """The pictures of all gears that the page of a case has."""
    return (*OF_ALL_GEARS, *(OF_A_VEHICLE if getattr(case.vehicle, "engine", ()) else ()))


PRINTED_WIDTH = 182.0
"""Between the margins of A4, as the style sheet has them. [mm]"""
COLUMN_GAP = 4.0
"""Between two pictures side by side. [mm]"""
PAGE = Style(titled=False, width=PRINTED_WIDTH * POINTS_PER_MILLIMETRE, height=PAGE_HEIGHT)
HALF = PAGE._replace(width=(PRINTED_WIDTH - COLUMN_GAP) / 2 * POINTS_PER_MILLIMETRE)


class Drawn(NamedTuple):
    """A picture, or why there is none."""

    kind: str
    sheets: Sequence[Markup]
    """It may be too long for one."""
    why: str = ""


class Pictures(NamedTuple):
    """Those of a case but for vibration and motion, by their kind."""

    of_gears: Mapping[str, Sequence[Drawn]] = {}
    """One of each gear that is shown."""
    of_all: Mapping[str, Drawn] = {}
    small_sticks: Sequence[Drawn] = ()
    """One of each gear that is shown, for print."""
    bare_stick: Drawn | None = None
    """Of no gear, for print."""
    flows: Drawn | None = None
    """Of all gears that are shown, for print."""


def pictures(results: Results, asked: AskedPage = EVERYTHING) -> Pictures:
    """All pictures of a case that its page has, but those of vibration and motion.

    Where no stick diagram can be drawn, the structure of each gear stands for it.

    Raises
    ------
    CaseError
        If matplotlib is not installed.
    """
    require("plot", "a picture")
    gears = [n for n, gear in enumerate(results.case.gears, 1) if asked.shows(gear.name)]
    chosen = gears if asked.gears else ()
    sticks, small, bare = _sticks(results, asked, gears)
    of_gears = {
        kind: of_each(results, kind, gears, PAGE) for kind in ("flow", "lever") if asked.has(kind)
    }
    of_all = {
        kind: picture_of(results, kind, chosen)
        for kind in of_all_gears(results.case)
        if asked.has("vehicle" if kind in OF_A_VEHICLE else kind)
    }
    has_flows = asked.has("flow") and not asked.in_full("flow") and len(gears) > 1
    flows = picture_of(results, "flow", chosen) if has_flows else None
    return Pictures({"stick": sticks, **of_gears}, of_all, small, bare, flows)


def _sticks(
    results: Results, asked: AskedPage, gears: Sequence[int]
) -> tuple[Sequence[Drawn], Sequence[Drawn], Drawn | None]:
    """Stick diagrams of gears, small ones for print, and that of none; or structures.

    Beside the section of gears, which prints small ones, large ones are printed on demand only.
    """
    in_full = asked.in_full("overview") and (asked.prints_all or not asked.has("gears"))
    for kind in ("stick", "structure"):
        sticks = of_each(results, kind, gears) if asked.has("overview") else []
        has_small = asked.has("gears") and not in_full and len(gears) > 1
        small = of_each(results, kind, gears, HALF) if has_small else []
        bare = picture_of(results, kind) if asked.has("overview") and not in_full else None
        if any(one.sheets for one in (*sticks, *small)):
            break
    return sticks, small, bare


def of_each(results: Results, kind: str, gears: Sequence[int], style: Style = PAGE) -> list[Drawn]:
    """A picture of each of some gears, or why one has none."""
    try:
        made = of_each_gear(results, kind, in_spoken(style), gears)
    except CaseError:  # of one of them, perhaps
        return [picture_of(results, kind, [number], style=style) for number in gears]
    end = tr(", small") * (style is HALF)
    labels = (f"{_label(results, kind, [number])}{end}" for number in gears)
    return [
        Drawn(kind, _inlined(svgs, _own(kind, [number], style), label))
        for number, svgs, label in zip(gears, made, labels, strict=True)
    ]


def in_spoken(style: Style) -> Style:
    """The same in the language of the page."""
    return style._replace(language=spoken())


def _own(kind: str, gears: Sequence[int], style: Style) -> str:
    """What ids of a picture begin with, unlike those of the others of a page."""
    return ".".join(["small"] * (style is HALF) + [kind, *map(str, gears)])


def _label(results: Results, kind: str, gears: Sequence[int]) -> str:
    names = [results.case.gears[number - 1].name for number in gears]
    if not names:
        return tr(NAMES[kind])
    return tr(
        "{picture}, gear {gears}|{picture}, gears {gears}",
        picture=tr(NAMES[kind]),
        gears=", ".join(names),
        count=len(names),
    )


def picture_of(
    results: Results,
    kind: str,
    gears: Sequence[int] = (),
    motion: Motion | None = None,
    style: Style = PAGE,
) -> Drawn:
    """A picture of a case, of some of its gears by their numbers from 1, or of a run."""
    try:
        made = pages(results, kind, "svg", in_spoken(style), gears, motion=motion)
    except CaseError as error:
        return Drawn(kind, [], " ".join(str(error).split()))
    own, label = _own(kind, gears, style), _label(results, kind, gears)
    if motion is not None:
        own, label = f"run-{own}", tr("{picture}, run", picture=label)
    return Drawn(kind, _inlined(made, own, label))


def _inlined(svgs: Sequence[bytes], own: str, label: str) -> list[Markup]:
    """Pages within HTML; the first has its own prefix, further ones have their numbers."""
    return [inline(svg, f"{own}-{n}" if n else own, label) for n, svg in enumerate(svgs)]


def palette(*, dark: bool) -> str:
    """The variables of the colours, for a style sheet."""
    return " ".join(f"--{name}: {pair[dark]};" for name, pair in _PAIRS.items())


def inline(svg: bytes, prefix: str, label: str) -> Markup:
    """An SVG as it stands within HTML.

    Two pictures of matplotlib have the same ids: here they get a prefix. Colours become the
    variables of the page. Its parts can be read, too, each by its title.

    Examples
    --------
    >>> svg = b'<svg xmlns="http://www.w3.org/2000/svg"><g id="a" fill="#1a1a1a"/></svg>'
    >>> inline(svg, "plan", "plan").partition(">")[2]
    '<g id="plan-a" fill="var(--ink)" /></svg>'
    """
    root = ET.fromstring(svg)  # noqa: S314 - our own, not from anywhere else
    if len(root) and root[0].tag.endswith("}title"):  # the page says it beside the picture
        del root[0]
    for element in root.iter():
        element.tag = _local(element.tag)
        kept = sorted(element.attrib.items(), key=lambda one: (is_look(one[0]), one[0]))
        element.attrib = {
            _local(key): _rewritten(_local(key), value, prefix) for key, value in kept
        }
    style = f"--width: {root.attrib.get('width', '100%')}"
    for key in ("width", "height", "version", "font-family"):
        root.attrib.pop(key, None)
    root.attrib |= {"role": "graphics-document", "aria-label": label, "style": style}
    return Markup(ET.tostring(root, encoding="unicode"))


def _local(name: str) -> str:
    """A name without its namespace, as HTML has it."""
    return name.rpartition("}")[2]


def _rewritten(key: str, value: str, prefix: str) -> str:
    if key == "id":
        return f"{prefix}-{value}"
    if key == "href" and value.startswith("#"):
        return f"#{prefix}-{value[1:]}"
    if key in _COLOURED:
        value = _COLOUR.sub(_variable, value)
    return _REFERENCE.sub(rf"url(#{prefix}-\1)", value)


def _variable(found: re.Match[str]) -> str:
    name = _COLOUR_NAMES.get(found[0])
    return f"var(--{name})" if name else found[0]


def colour_name(colour: str) -> str:
    """The name of the variable that has a colour of pictures.

    >>> colour_name(Style().colour(3)), colour_name(Style().ink)
    ('colour3', 'ink')
    """
    return _COLOUR_NAMES[colour]


_TAG = re.compile(r"<(?:path|text|use|g)\b[^<>]*>")
_KEY = r"(?:fill|stroke|opacity|font|text-anchor|paint-order)[-a-z]*"
_CLASS = re.compile(' class="([^"<>]*)"')
_LOOK = re.compile(f'(?: {_KEY}="[^"<>]*")+(?=[ />])')


def shared(page: Markup) -> tuple[Markup, Markup]:
    """A page whose pictures share their looks, and the rules of a style sheet for these.

    Examples
    --------
    >>> shown = Markup('<text x="1" fill="red">a</text><text x="2" fill="red">b</text>')
    >>> for part in shared(shown):
    ...     print(part)
    <text x="1" class="l0">a</text><text x="2" class="l0">b</text>
    .l0{fill:red}

    A class of its own stays beside it.

    >>> print(shared(Markup('<path fill="red" class="wire"/><path fill="red"/>'))[0])
    <path class="l0 wire"/><path class="l0"/>
    """
    looks = Counter(look for part in _TAG.findall(page) for look in _LOOK.findall(part))
    often = [look for look, count in looks.most_common() if count > 1]
    names = {look: f' class="l{number}"' for number, look in enumerate(often)}

    def short(part: re.Match[str]) -> str:
        made = _LOOK.sub(lambda look: names.get(look[0], look[0]), part[0], count=1)
        classes = _CLASS.findall(made)
        if len(classes) < 2:
            return made
        first = made.index(' class="')
        return f'{made[:first]} class="{" ".join(classes)}"{_CLASS.sub("", made[first:])}'

    rules = []
    for number, look in enumerate(often):  # ``fill="none"`` is ``fill:none``
        said = re.findall(r'([-a-z]+)="([^"]*)"', look)
        rules.append(f".l{number}{{{';'.join(f'{key}:{value}' for key, value in said)}}}")
    return Markup(_TAG.sub(short, page)), Markup("\n".join(rules))


def is_look(key: str) -> bool:
    """Whether an attribute of a part says what it looks like.

    >>> is_look("stroke-width"), is_look("d")
    (True, False)
    """
    return re.fullmatch(_KEY, key) is not None
