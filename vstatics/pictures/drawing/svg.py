"""SVG of matplotlib made small and readable: texts stay texts, nodes say what they are.

An artist carries what its picture in SVG shall have besides as its ``gid``, made by `told`:

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
from collections.abc import Iterator, Mapping, Sequence
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
"""Width of the paper around a text that stands over lines. [pt]"""
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
    """A group of what belongs together in SVG: ``<g class="link" data-name="sun">``."""

    kind: str
    """Its class."""
    data: tuple[tuple[str, str], ...] = ()
    """Attributes ``data-...``."""

    @property
    def attributes(self) -> dict[str, str]:
        """Of its element."""
        return {"class": self.kind} | {f"data-{key}": value for key, value in self.data}


def told(
    title: str = "",
    *,
    halo: bool = False,
    kind: str = "",
    groups: Sequence[MarkGroup] = (),
    **data: str,
) -> str:
    """What an artist says in SVG, as its ``gid``.

    Parameters
    ----------
    title : str
        Shown while a pointer rests on it; it is the alternative text, too.
    halo : bool
        A text with paper around its letters, as of `halo`.
    kind : str
        The class of its own path or text.
    groups : sequence of MarkGroup
        In which it is, the outermost first; all of a group stands where its first part stood.
    **data
        Attributes ``data-...`` of its path or text where that has a class, else of its group.
    """
    mark = {"title": title, "halo": halo, "kind": kind, "groups": groups, "data": data}
    return json.dumps(mark, ensure_ascii=False)


def told_of_whole(data: Mapping[str, str]) -> str:
    """What a figure says at the root of its SVG, as its ``gid``: attributes ``data-...``.

    >>> from vstatics.pictures.drawing.pen import blank
    >>> pen = blank(9.0, 9.0, Style())
    >>> pen.tell(left_out="[]")
    >>> b'data-left-out="[]"' in written_as_svg(pen.figure, "", Style())
    True
    """
    return json.dumps({"title": "", "data": dict(data)}, ensure_ascii=False)


def halo(style: Style) -> dict[str, Any]:
    """How a text is written that stands over lines: with paper around its letters.

    >>> list(halo(Style()))
    ['path_effects']
    """
    return {"path_effects": [withStroke(linewidth=HALO, foreground=style.paper)]}


def written_as_svg(figure: Figure, title: str, style: Style, number: int = 1) -> bytes:
    """A figure as SVG; the same figure gives the same bytes.

    Parameters
    ----------
    title : str
        Of the whole picture, its alternative text.
    number : int, optional
        Of the page; further ones have a mark.
    """
    file = io.BytesIO()
    with _letters_kept(figure):
        figure.savefig(file, format="svg", metadata={"Date": None, "Creator": None})
    root = ET.fromstring(file.getvalue())  # noqa: S314 - our own, not from anywhere else
    _strip(root)
    _say_of_whole(root)
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
    """No effects of paths for a while: with them texts would become outlines."""
    texts: list[Any] = figure.findobj(Text)
    effects = [(text, text.get_path_effects()) for text in texts if text.get_path_effects()]
    for text, _ in effects:
        text.set_path_effects([])
    yield
    for text, kept in effects:
        text.set_path_effects(kept)


def _strip(root: ET.Element) -> None:
    """Take out what says nothing: metadata, the style for all elements, blanks."""
    for parent in reversed(list(root.iter())):
        for child in list(parent):
            name = child.tag.rpartition("}")[2]
            if name in ("metadata", "style") or (name == "defs" and not len(child)):
                parent.remove(child)
            child.tail = None
        if not parent.tag.endswith("}text"):
            parent.text = None


def _say_of_whole(root: ET.Element) -> None:
    """What the figure says stands at the root: ``data-left-out="[]"``."""
    for child in root:
        if child.get("id", "").startswith("{"):
            data = json.loads(child.attrib.pop("id"))["data"]
            root.attrib |= {f"data-{key}": value for key, value in data.items()}


def _gather(root: ET.Element) -> None:
    """Put the parts of each group into one element."""
    groups: dict[str, ET.Element] = {}
    for parent in list(root.iter()):
        for child in list(parent):
            said = child.get("id", "") if child.tag == _GROUP else ""
            into = parent
            own = json.loads(said)["groups"] if said.startswith("{") else []
            for depth, group in enumerate(own, 1):
                key = json.dumps(own[:depth])
                if key not in groups:
                    groups[key] = ET.Element(_GROUP, MarkGroup(*group).attributes)
                    place = list(into).index(child) if into is parent else len(into)
                    into.insert(place, groups[key])
                into = groups[key]
            if into is not parent:
                parent.remove(child)
                into.append(child)


def _say(element: ET.Element, style: Style) -> None:
    """Give a group its title, halo and data, and take the names that nobody refers to."""
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
    """Two decimals of a point are enough to see, and attributes shorter than a style."""
    for key in element.attrib.keys() & _MEASURES:
        element.set(key, _BESIDE_LETTER.sub("", _plain(" ".join(element.attrib[key].split()))))
    if element.get("transform", "").startswith("rotate(-0 "):
        del element.attrib["transform"]
    declared = element.attrib.pop("style", "")
    for key, _, value in (one.partition(":") for one in declared.split(";") if one.strip()):
        name, given = key.strip(), _plain(value.strip())
        if name == "font":
            _set_font(element, given)
        elif name != "font-family" and (name, given) not in _USUAL:
            element.set(name, given)


def _plain(value: str) -> str:
    return _DECIMAL.sub(lambda found: f"{float(found[0]):.2f}".rstrip("0").rstrip("."), value)


def _set_font(element: ET.Element, font: str) -> None:
    """Size and weight of a font given in one: ``bold 10px 'DejaVu Sans'``."""
    words = font.split("'", maxsplit=1)[0].split()
    for word in words:
        if word.endswith("px") and word != _SIZE:
            element.set("font-size", word)
        elif word in ("bold", "600", "700"):
            element.set("font-weight", word)


def _unwrap(parent: ET.Element) -> None:
    """Take away groups that say nothing themselves; adjacent lines of one look are one path."""
    children: list[ET.Element] = []
    for child in parent:
        _unwrap(child)
        bare = child.tag == _GROUP and not child.attrib and child.find(_TITLE) is None
        for one in list(child) if bare else [child]:
            if not (children and _joins(children[-1], one)):
                children.append(one)
    parent[:] = children


def _joins(line: ET.Element, other: ET.Element) -> bool:
    """Add a line to one that looks like it, if it does."""
    lines = line.tag == other.tag == f"{{{SVG}}}path" and other.get("fill") == "none"
    looks = [{**one.attrib, "d": ""} for one in (line, other)]
    if not lines or looks[0] != looks[1] or looks[0].keys() & {"opacity", "class"}:
        return False
    line.set("d", line.attrib["d"] + other.attrib["d"])
    return True
