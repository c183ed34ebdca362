"""Pictures as SVG that stands within a page: own ids, colours that follow the screen."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple
from xml.etree import ElementTree as ET

from vstatics.errors import CaseError
from vstatics.extras import require
from vstatics.pictures import PICTURES, sheets
from vstatics.pictures.style import Style
from vstatics.simulation.motion import Motion
from vstatics.statics.results import Results
from vstatics.tables.html import Markup

_LIGHT, _DARK = Style(), Style(dark=True)
_NAMES = ("paper", "ink", "soft", "faint", "engaged", "lost", "circulating", "power")
_PAIRS = {name: (getattr(_LIGHT, name), getattr(_DARK, name)) for name in _NAMES} | {
    f"colour{number}": pair
    for number, pair in enumerate(zip(_LIGHT.colours, _DARK.colours, strict=True))
}
"""Colours of pictures on paper and on a dark screen, by the name of their variable."""
_VARIABLES = {light: f"var(--{name})" for name, (light, _) in _PAIRS.items()}
_REFERENCE = re.compile(r"url\(#([^)]+)\)")
_COLOUR = re.compile("#[0-9a-f]{6}")
_COLOURED = ("style", "fill", "stroke")


class Drawn(NamedTuple):
    """A picture, or why there is none."""

    kind: str
    sheets: Sequence[Markup]
    """It may be too long for one."""
    why: str = ""


ELSEWHERE = ("modes", "campbell", "shift")
"""Pictures of sections of their own."""


def pictures(results: Results) -> list[Drawn]:
    """All pictures of a case but those of vibration and motion, in the order of `PICTURES`.

    Raises
    ------
    CaseError
        If matplotlib is not installed.
    """
    require("plot", "a picture")
    return [picture_of(results, kind) for kind in PICTURES if kind not in ELSEWHERE]


def picture_of(
    results: Results, kind: str, gear: int | None = None, motion: Motion | None = None
) -> Drawn:
    """A picture of a case, of one gear by its number from 1, or of a run."""
    try:
        made = sheets(results, kind, Style(), () if gear is None else (gear,), motion=motion)
    except CaseError as error:
        return Drawn(kind, [], " ".join(str(error).split()))
    own = kind if gear is None else f"{kind}-{gear}-"
    if motion is not None:
        own = f"run-{own}"
    return Drawn(kind, [inline(svg, f"{own}{n or ''}", kind) for n, svg in enumerate(made)])


def palette(*, dark: bool) -> str:
    """The variables of the colours, for a style sheet."""
    return " ".join(f"--{name}: {pair[dark]};" for name, pair in _PAIRS.items())


def inline(svg: bytes, prefix: str, label: str) -> Markup:
    """An SVG as it stands within HTML.

    Two pictures of matplotlib have the same ids, and a style for all elements: here ids
    get a prefix, and the style is left to the page, as are comments and metadata. Colours
    become the variables of the page.

    Examples
    --------
    >>> svg = b'<svg xmlns="http://www.w3.org/2000/svg"><g id="a" fill="#1a1a1a"/></svg>'
    >>> inline(svg, "plan", "plan").partition(">")[2]
    '<g id="plan-a" fill="var(--ink)" /></svg>'
    """
    root = ET.fromstring(svg)  # noqa: S314 - our own, not from anywhere else
    for parent in list(root.iter()):
        for child in list(parent):
            if child.tag.endswith(("}metadata", "}style")):
                parent.remove(child)
    for element in root.iter():
        element.tag = _local(element.tag)
        element.attrib = {
            _local(key): _rewritten(_local(key), value, prefix)
            for key, value in element.attrib.items()
        }
        element.tail = None if element.tail is None or not element.tail.strip() else element.tail
    kept = {k: v for k, v in root.attrib.items() if k not in ("width", "height", "version")}
    width = root.attrib.get("width", "100%")
    root.attrib = {"role": "img", "aria-label": label, **kept, "style": f"--width: {width}"}
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
        value = _COLOUR.sub(lambda found: _VARIABLES.get(found[0], found[0]), value)
    return _REFERENCE.sub(rf"url(#{prefix}-\1)", value)
