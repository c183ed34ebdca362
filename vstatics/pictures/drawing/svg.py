"""Reduction of SVG from matplotlib: texts stay texts, and nodes have classes and titles.

The ``gid`` of an artist, created by `told`, contains additional data for SVG:

>>> from matplotlib.figure import Figure
>>> from vstatics.pictures.drawing.files import settings_of
>>> from vstatics.pictures.drawing.style import Style
>>> figure = Figure(figsize=(1, 1))
>>> with settings_of(Style()):
...     _ = figure.text(0.5, 0.5, "P1", gid=told("P1: planetary, ratio −2.5"))
>>> b"<title>P1: planetary" in written_as_svg(figure, "", Style())
True
"""

from __future__ import annotations

import io
import json
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple
from xml.etree import ElementTree as ET

from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.text import Text

from vstatics.core.jobs.page_files import PAGE_KEY
from vstatics.pictures.drawing.style import FAMILIES, SIZE, Style

SVG = "http://www.w3.org/2000/svg"
_GROUP, _TITLE = f"{{{SVG}}}g", f"{{{SVG}}}title"
XLINK = "http://www.w3.org/1999/xlink"
HALO = 2.0
"""Width of the border in the colour of paper around letters that are written over lines. [pt]"""
_SIZE = f"{SIZE:g}px"
_DECIMAL = re.compile(r"-?\d+\.\d+")
_BESIDE_LETTER = re.compile(r"(?<=[A-Za-z]) (?=[-\d])|(?<=\d) (?=[A-Za-z])")
_USUAL = {
    ("font-size", _SIZE),
    ("stroke-linejoin", "round"),
    ("stroke-dashoffset", "0"),
    ("text-anchor", "start"),
}
_MEASURES = {"d", "x", "y", "x1", "x2", "y1", "y2", "width", "height", "points", "transform"}


class MarkGroup(NamedTuple):
    """Group of related parts in SVG: ``<g class="link" data-name="sun">``."""

    kind: str
    """Class of the group."""
    data: tuple[tuple[str, str], ...] = ()
    """Attributes ``data-...``."""

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes of the SVG element."""
        return {"class": self.kind} | {f"data-{key}": value for key, value in self.data}


def told(
    title: str = "",
    *,
    halo: bool = False,
    kind: str = "",
    groups: Sequence[MarkGroup] = (),
    **data: str,
) -> str:
    """Return the data of an artist, or of the whole figure, for SVG, as the ``gid``.

    Parameters
    ----------
    title : str
        Text that appears under the pointer, and is the alternative text.
    halo : bool
        True for a text with paper around its letters, see `halo`.
    kind : str
        Class of the path or text.
    groups : sequence of MarkGroup
        Groups of the artist, the outermost first; a group is at the place of its first part.
    **data
        Attributes ``data-...`` of the path or text if it has a class, otherwise of its group. Data
        of a figure become attributes of the root.

    Examples
    --------
    >>> from vstatics.pictures.drawing.pen import blank
    >>> pen = blank(9.0, 9.0, Style())
    >>> pen.tell(left_out="[]")
    >>> b'data-left-out="[]"' in written_as_svg(pen.figure, "", Style())
    True
    """
    mark = {"title": title, "halo": halo, "kind": kind, "groups": groups, "data": data}
    return json.dumps(mark, ensure_ascii=False)


def halo(style: Style) -> dict[str, Any]:
    """Return the style of a text over lines, with paper around the letters.

    >>> list(halo(Style()))
    ['path_effects']
    """
    return {"path_effects": [withStroke(linewidth=HALO, foreground=style.paper)]}


def written_as_svg(figure: Figure, title: str, style: Style, number: int = 1) -> bytes:
    """Return a figure as SVG; equal figures give equal bytes.

    Parameters
    ----------
    title : str
        Title and alternative text of the picture.
    number : int, optional
        Number of the page; further pages have a mark.
    """
    file = io.BytesIO()
    with _letters_kept(figure):
        figure.savefig(file, format="svg", metadata={"Date": None, "Creator": None})
    root = ET.fromstring(file.getvalue())  # noqa: S314 - written above
    _strip(root)
    for child in root:  # data of the whole figure become attributes of the root
        if child.get("id", "").startswith("{"):
            data = json.loads(child.attrib.pop("id"))["data"]
            root.attrib |= {f"data-{key}": value for key, value in data.items()}
    _gather(root)
    for element in list(root.iter()):
        _say(element, style)
        _shorten(element)
    _unwrap(root)
    root.set("viewBox", _plain(root.get("viewBox", "")))
    root.attrib |= {
        "font-family": FAMILIES,
        "font-size": _SIZE,
        "stroke-linejoin": "round",
        "role": "img",
    }
    if number > 1:
        root.set(PAGE_KEY, str(number))
    del root.attrib["version"]
    _add_title(root, title)
    ET.register_namespace("", SVG)
    ET.register_namespace("xlink", XLINK)
    text = ET.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="utf-8"?>\n{text}\n'.encode()


@contextmanager
def _letters_kept(figure: Figure) -> Iterator[None]:
    """Remove path effects temporarily, which would convert texts to outlines."""
    texts: list[Any] = figure.findobj(Text)
    effects = [(text, text.get_path_effects()) for text in texts if text.get_path_effects()]
    for text, _ in effects:
        text.set_path_effects([])
    yield
    for text, path_effects in effects:
        text.set_path_effects(path_effects)


def _strip(root: ET.Element) -> None:
    """Remove metadata, the style for all elements, and blanks."""
    for parent in reversed(list(root.iter())):
        for child in list(parent):
            name = child.tag.rpartition("}")[2]
            if name in ("metadata", "style") or (name == "defs" and not len(child)):
                parent.remove(child)
            child.tail = None
        if not parent.tag.endswith("}text"):
            parent.text = None


def _gather(root: ET.Element) -> None:
    """Collect the parts of each group in a single element."""
    groups: dict[str, ET.Element] = {}
    for parent in list(root.iter()):
        for child in list(parent):
            said = child.get("id", "") if child.tag == _GROUP else ""
            into = parent
            of_child = json.loads(said)["groups"] if said.startswith("{") else []
            for depth, group in enumerate(of_child, 1):
                key = json.dumps(of_child[:depth])
                if key not in groups:
                    groups[key] = ET.Element(_GROUP, MarkGroup(*group).attributes)
                    place = list(into).index(child) if into is parent else len(into)
                    into.insert(place, groups[key])
                into = groups[key]
            if into is not parent:
                parent.remove(child)
                into.append(child)


def _say(element: ET.Element, style: Style) -> None:
    """Set title, halo and data of a group, and remove unused names."""
    said = element.attrib.pop("id", "") if element.tag == _GROUP else ""
    if not said.startswith("{"):
        return
    mark = json.loads(said)
    data = {f"data-{key}": value for key, value in mark["data"].items()}
    for part in element if mark["kind"] else ():
        part.attrib |= {"class": mark["kind"], **data}
    element.attrib |= {} if mark["kind"] else data
    if mark["halo"]:
        element.attrib |= {
            "paint-order": "stroke",
            "stroke": style.paper,
            "stroke-width": f"{HALO:g}px",
        }
    _add_title(element, mark["title"])


def _add_title(element: ET.Element, text: str) -> None:
    if text:
        element.insert(0, ET.Element(_TITLE))
        element[0].text = text


def _shorten(element: ET.Element) -> None:
    """Round to two decimals of a point, and replace styles by attributes."""
    for key in element.attrib.keys() & _MEASURES:
        element.set(key, _BESIDE_LETTER.sub("", _plain(" ".join(element.attrib[key].split()))))
    if element.get("transform", "").startswith("rotate(-0 "):
        del element.attrib["transform"]
    declared = element.attrib.pop("style", "")
    for key, _, value in (part.partition(":") for part in declared.split(";") if part.strip()):
        name, given = key.strip(), _plain(value.strip())
        if name == "font":
            _set_font(element, given)
        elif name != "font-family" and (name, given) not in _USUAL:
            element.set(name, given)


def _plain(value: str) -> str:
    return _DECIMAL.sub(lambda match: f"{float(match[0]):.2f}".rstrip("0").rstrip("."), value)


def _set_font(element: ET.Element, font: str) -> None:
    """Set size and weight from a combined font: ``bold 10px 'DejaVu Sans'``."""
    words = font.split("'", maxsplit=1)[0].split()
    for word in words:
        if word.endswith("px") and word != _SIZE:
            element.set("font-size", word)
        elif word in ("bold", "600", "700"):
            element.set("font-weight", word)


def _unwrap(parent: ET.Element) -> None:
    """Remove groups without data, and join adjacent lines of equal style."""
    children: list[ET.Element] = []
    for child in parent:
        _unwrap(child)
        bare = child.tag == _GROUP and not child.attrib and child.find(_TITLE) is None
        for element in list(child) if bare else [child]:
            if not (children and _joins(children[-1], element)):
                children.append(element)
    parent[:] = children


def _joins(line: ET.Element, other: ET.Element) -> bool:
    """Append a line to a line of equal style; return False for different styles."""
    lines = line.tag == other.tag == f"{{{SVG}}}path" and other.get("fill") == "none"
    looks = [{**path.attrib, "d": ""} for path in (line, other)]
    if not lines or looks[0] != looks[1] or looks[0].keys() & {"opacity", "class"}:
        return False
    line.set("d", line.attrib["d"] + other.attrib["d"])
    return True
