"""Conversion of a canvas to SVG, with texts as letters, classes for CSS, and tooltips.

>>> from vstatics.pictures.drawing.pen import blank
>>> from vstatics.pictures.drawing.style import Style
>>> pen = blank(72.0, 72.0, Style())
>>> pen.text(36.0, 36.0, "P1", title="P1: planetary, ratio −2.5")
>>> b"<title>P1: planetary" in written_as_svg(pen.canvas, "")
True
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Any, NamedTuple
from xml.etree import ElementTree as ET

import numpy as np

from vstatics.core.jobs.page_files import PAGE_KEY
from vstatics.pictures.drawing.canvas import (
    Canvas,
    CanvasArea,
    CanvasLine,
    CanvasPart,
    CanvasPlace,
    CanvasText,
    Look,
    MarkGroup,
    Outline,
    Point,
    as_attributes,
)
from vstatics.pictures.drawing.lettering import placed_lines
from vstatics.pictures.drawing.style import FAMILIES, SIZE

SVG = "http://www.w3.org/2000/svg"
HALO = 2.0
"""Width of the border in the colour of paper around letters that are written over lines. [pt]"""
LONG_LINE = 128
"""Number of points above which a line is drawn without invisible detail."""
HATCH_TILE = 12.0
"""Width and height of the tile that repeats in a hatched area. [pt]

Matplotlib repeats a tile of 72 pt with six times as many lines, which gives the same hatch if each
letter of the hatch occurs an even number of times.
"""
MARKER_EDGE = 1.0
"""Default width of the outline of a marker. [pt]"""
_DIAGONAL = math.sqrt(2)
_SIZE = f"{SIZE:g}px"
_CAPS = {"projecting": "square", "round": "round"}
_ANCHORS = {"center": "middle", "right": "end"}


_MARKERS: Mapping[str, Sequence[Point]] = {
    "s": [(-1, 1), (1, 1), (1, -1), (-1, -1)],
    "^": [(0, -1), (-1, 1), (1, 1)],
    "v": [(0, 1), (1, -1), (-1, -1)],
    "D": [(0, _DIAGONAL), (_DIAGONAL, 0), (0, -_DIAGONAL), (-_DIAGONAL, 0)],
}
"""Corners of each marker relative to half the size, by the marker code of matplotlib. [-]"""


@lru_cache(maxsize=4096)
def _number(value: float) -> str:
    """Return a length with at most two decimals, equal for values that differ by rounding noise.

    >>> _number(0.0), _number(-0.0), _number(-0.5)
    ('0', '0', '-0.5')
    """
    return f"{round(value, 6):z.2f}".rstrip("0").rstrip(".")


def written_as_svg(canvas: Canvas, title: str, number: int = 1) -> bytes:
    """Return a canvas as SVG; parameters as in `svg_of`. Equal canvases give equal bytes."""
    text = ET.tostring(svg_of(canvas, title, number), encoding="unicode")
    return f'<?xml version="1.0" encoding="utf-8"?>\n{text}\n'.encode()


def svg_of(canvas: Canvas, title: str, number: int = 1) -> ET.Element:
    """Return a canvas as an SVG element.

    Parameters
    ----------
    title : str
        Title and alternative text of the picture.
    number : int, optional
        Number of the page, from 1; later pages have an attribute with the number.
    """
    wide, high = map(_number, canvas.size)
    root = ET.Element(
        "svg",
        {
            "xmlns": SVG,
            "width": f"{wide}pt",
            "height": f"{high}pt",
            "viewBox": f"0 0 {wide} {high}",
            **as_attributes(canvas.data),
            "font-family": FAMILIES,
            "font-size": _SIZE,
            "stroke-linejoin": "round",
            "role": "img",
            **({PAGE_KEY: str(number)} if number > 1 else {}),
        },
    )
    _add_title(root, title)
    paper = f"M0 {high}L{wide} {high}L{wide} 0L0 0z"
    ET.SubElement(root, "path", {"d": paper, "fill": canvas.style.paper})
    SvgWriter(canvas, root, {}, {}, {}).write()
    return root


class SvgWriter(NamedTuple):
    """Writer that converts the lines, areas and texts of a canvas to SVG elements."""

    canvas: Canvas
    root: ET.Element
    groups: dict[tuple[MarkGroup, ...], ET.Element]
    hatches: dict[tuple[Any, ...], str]
    """Ids of the SVG patterns of hatched areas, by hatch and colours."""
    clips: dict[tuple[str, ...], str]
    """Ids of the SVG rectangles that clip lines, by position and size."""

    def write(self) -> None:
        """Add the SVG elements of the canvas, then the hatches and clip rectangles in use."""
        for part in self.canvas.ordered:
            self._add(part)
        hatches = [_hatch_pattern(name, *key) for key, name in self.hatches.items()]
        clips = [_clip(name, key) for key, name in self.clips.items()]
        for definitions in (hatches, clips):
            if definitions:
                ET.SubElement(self.root, "defs").extend(definitions)

    def _add(self, part: CanvasPart) -> None:
        mark, parent = part.mark, self._group(part.mark.groups)
        elements = [*self._elements(part)]
        attributes = as_attributes(mark.data) if mark.data else {}
        if mark.kind:
            for element in elements:
                _insert(element, {"class": mark.kind, **attributes})
            attributes = {}
        if isinstance(part.shape, CanvasText) and part.shape.has_halo:
            halo = {"stroke": self.canvas.style.paper, "stroke-width": f"{HALO:g}px"}
            attributes |= {"paint-order": "stroke", **halo}
        if attributes or mark.title:
            parent = _titled(parent, mark.title, attributes)
        for element in elements:
            if not (len(parent) and _joins(parent[-1], element)):
                parent.append(element)

    def _group(self, groups: tuple[MarkGroup, ...]) -> ET.Element:
        """Return the SVG element of the innermost group, created at the first use."""
        if not groups:
            return self.root
        if groups not in self.groups:
            outer = self._group(groups[:-1])
            self.groups[groups] = ET.SubElement(outer, "g", groups[-1].attributes)
        return self.groups[groups]

    def _elements(self, part: CanvasPart) -> Iterator[ET.Element]:
        match part.shape:
            case CanvasLine() as stroke:
                yield from self._stroke(stroke, part.place)
            case CanvasArea(outline, look):
                data = _outline_data(outline, part.place, self.canvas.size[1])
                yield ET.Element("path", {"d": data, **self._area_look(look)})
            case CanvasText() as letters:
                yield from _text_lines(letters, part.place, self.canvas)

    def _stroke(self, stroke: CanvasLine, place: CanvasPlace) -> Iterator[ET.Element]:
        look, clip = stroke.look, self._clip_of(stroke, place)
        data = _line_data(stroke, place, self.canvas.size)
        if "L" in data and look.get("linestyle", "solid") not in ("none", ""):
            if "gapcolor" in look:
                offset, (dash, gap) = look["linestyle"]
                gaps = {"color": look["gapcolor"], "linestyle": (offset + gap, (gap, dash))}
                yield ET.Element("path", {"d": data, **clip, **_line_look({**look, **gaps})})
            yield ET.Element("path", {"d": data, **clip, **_line_look(look)})
        for point in look.get("markevery", range(len(stroke.xs))) if "marker" in look else ():
            across, up = place.of(stroke.xs[point], stroke.ys[point])
            if not math.isnan(across + up):
                yield _marker(across, self.canvas.size[1] - up, look, clip)

    def _clip_of(self, stroke: CanvasLine, place: CanvasPlace) -> dict[str, str]:
        if stroke.clip is None:
            return {}
        corner, size = stroke.clip
        left, low = place.of(*corner)
        wide, high = (place.part * length for length in size)
        key = tuple(map(_number, (left, self.canvas.size[1] - low - high, wide, high)))
        return {"clip-path": f"url(#{self.clips.setdefault(key, f'c{len(self.clips)}')})"}

    def _area_look(self, look: Look) -> dict[str, str]:
        colour: str = look.get("color", "none")
        face: str = look.get("facecolor", colour)
        edge: str = look.get("edgecolor", colour)
        width: float = look["linewidth"]
        attributes = {"fill": face}
        if look.get("hatch"):
            key = look["hatch"], face, edge
            name = self.hatches.setdefault(key, f"h{len(self.hatches)}")
            attributes = {"fill": f"url(#{name})"}
        if look.get("alpha", 1.0) != 1.0:
            attributes["opacity"] = _number(look["alpha"])
        if edge != "none" and width:
            style = look.get("linestyle", "solid")
            attributes |= _stroke_look(edge, width, style, look.get("capstyle", "butt"))
            if look.get("joinstyle", "miter") != "round":
                attributes["stroke-linejoin"] = look.get("joinstyle", "miter")
        return attributes


def _add_title(element: ET.Element, text: str) -> None:
    if text:
        ET.SubElement(element, "title").text = text


def _titled(parent: ET.Element, title: str, attributes: dict[str, str]) -> ET.Element:
    """Return the last group of an element if the title and attributes agree, or a new group."""
    last = parent[-1] if len(parent) else parent
    if last.tag == "g" and last.attrib == attributes and last.findtext("title", "") == title:
        return last
    group = ET.SubElement(parent, "g", attributes)
    _add_title(group, title)
    return group


def _insert(element: ET.Element, attributes: dict[str, str]) -> None:
    """Insert attributes after the position attributes of an SVG element."""
    places: list[str] = [key for key in ("d", "x", "y") if key in element.attrib]
    first = {key: element.attrib.pop(key) for key in places}
    element.attrib = {**first, **attributes, **element.attrib}


def _joins(line: ET.Element, other: ET.Element) -> bool:
    """Append a line to a line of equal style and return True; otherwise return False."""
    if line.tag != "path" or other.tag != "path" or other.get("fill") != "none":
        return False
    looks = [{**path.attrib, "d": ""} for path in (line, other)]
    if looks[0] != looks[1] or looks[0].keys() & {"opacity", "class"}:
        return False
    line.set("d", line.attrib["d"] + other.attrib["d"])
    return True


def _line_data(stroke: CanvasLine, place: CanvasPlace, size: Point) -> str:
    if len(stroke.xs) >= LONG_LINE:
        from matplotlib.path import Path

        xs = place.left + place.part * np.asarray(stroke.xs)
        ys = place.low + place.part * np.asarray(stroke.ys)
        path: Any = Path(np.column_stack([xs, ys])).cleaned(
            remove_nans=True, clip=(0.0, 0.0, *size), simplify=True
        )
        return _outline_data(_outline_of(path), CanvasPlace(), size[1])
    places = [*zip(stroke.xs, stroke.ys, strict=True)]
    is_gap = [True, *(math.isnan(x + y) for x, y in places)]
    steps = ["-" if after else "M" if before else "L" for before, after in pairwise(is_gap)]
    return _outline_data(Outline(places, "".join(steps)), place, size[1])


def _outline_of(path: Any) -> Outline:
    """Return the outline of a path of matplotlib."""
    from matplotlib.path import Path

    letters = {Path.MOVETO: "M", Path.LINETO: "L", Path.CURVE4: "C", Path.CLOSEPOLY: "z"}
    steps = [letters.get(code, "-") for code in path.codes.tolist()]
    return Outline(path.vertices, "".join(steps))


def _outline_data(outline: Outline, place: CanvasPlace, high: float) -> str:
    """Return the path of an outline in SVG; points with the step ``-`` are left out."""
    part, left, top = place.part, place.left, high - place.low
    letters = outline.steps.replace("CCC", "C  ").replace("QQ", "Q ")
    return "".join(
        "z" if letter == "z" else f"{letter}{_number(left + part * x)} {_number(top - part * y)}"
        for (x, y), letter in zip(outline.points, letters, strict=True)
        if letter != "-"
    )


def _stroke_look(colour: str, width: float, dashes: Any, cap: str) -> dict[str, str]:
    """Return the SVG attributes of a line. The lengths of dashes are relative to the width."""
    attributes = {}
    if dashes != "solid":
        offset, lengths = dashes
        attributes["stroke-dasharray"] = ",".join(_number(width * length) for length in lengths)
        if offset:
            attributes["stroke-dashoffset"] = _number(width * offset)
    attributes["stroke"] = colour
    if width != 1.0:
        attributes["stroke-width"] = _number(width)
    if cap in _CAPS:
        attributes["stroke-linecap"] = _CAPS[cap]
    return attributes


def _line_look(look: Look) -> dict[str, str]:
    dashes = look.get("linestyle", "solid")
    cap = look.get("solid_capstyle" if dashes == "solid" else "dash_capstyle", "butt")
    attributes = {"fill": "none", **_stroke_look(look["color"], look["linewidth"], dashes, cap)}
    if look.get("alpha", 1.0) != 1.0:
        attributes["stroke-opacity"] = _number(look["alpha"])
    return attributes


def _marker(x: float, y: float, look: Look, clip: dict[str, str]) -> ET.Element:
    """Return the SVG element of a circle, square, triangle or rhombus centred at a point."""
    colour: str = look.get("color", "none")
    edge: str = look.get("markeredgecolor", colour)
    half = look["markersize"] / 2
    fill: str = look.get("markerfacecolor", colour)
    attributes = {
        **clip,
        "fill": fill,
        **_stroke_look(edge, look.get("markeredgewidth", MARKER_EDGE), "solid", "butt"),
    }
    if look["marker"] == "o":
        circle = {"cx": _number(x), "cy": _number(y), "r": _number(half)}
        return ET.Element("circle", circle | attributes)
    corners = _MARKERS[look["marker"]]
    places = (f"{_number(x + half * a)} {_number(y + half * b)}" for a, b in corners)
    return ET.Element(
        "path", {"d": f"M{'L'.join(places)}z", **attributes, "stroke-linejoin": "miter"}
    )


def _text_lines(letters: CanvasText, place: CanvasPlace, canvas: Canvas) -> Iterator[ET.Element]:
    attributes = {}
    if letters.is_bold:
        attributes["font-weight"] = "700"
    if _number(letters.size) != _number(SIZE):
        attributes["font-size"] = f"{_number(letters.size)}px"
    anchor = _ANCHORS.get(letters.look.get("ha", "left"))
    colour = {"fill": letters.look.get("color") or canvas.style.ink}
    lines = placed_lines(letters, place)
    for x, y, text in lines:
        down = canvas.size[1] - y
        if len(lines) == 1 and not letters.look.get("rotation"):
            at = {"x": _number(place.left + place.part * letters.at[0]), "y": _number(down)}
            look = {**attributes, **({"text-anchor": anchor} if anchor else {})}
        else:
            turn = letters.look.get("rotation", 0.0)
            turned = f" rotate({_number(-turn)})" if turn else ""
            at = {"transform": f"translate({_number(x)} {_number(down)}){turned}"}
            look = attributes
        element = ET.Element("text", {**at, **look, **colour})
        element.text = text
        if "  " in text:
            element.set("xml:space", "preserve")
        yield element


def _clip(name: str, key: tuple[str, ...]) -> ET.Element:
    clip = ET.Element("clipPath", {"id": name})
    ET.SubElement(clip, "rect", dict(zip(("x", "y", "width", "height"), key, strict=True)))
    return clip


def _hatch_pattern(name: str, hatch: str, face: str, edge: str) -> ET.Element:
    from matplotlib.hatch import get_path

    data = _outline_data(_outline_of(get_path(hatch, 1)), CanvasPlace(HATCH_TILE), HATCH_TILE)
    tile = f"{HATCH_TILE:g}"
    pattern = ET.Element(
        "pattern",
        {"id": name, "patternUnits": "userSpaceOnUse", "x": "0", "y": "0"}
        | {"width": tile, "height": tile},
    )
    whole = f"{HATCH_TILE + 1:g}"
    area = {"x": "0", "y": "0", "width": whole, "height": whole, "fill": face}
    ET.SubElement(pattern, "rect", area)
    lines = {"d": data, "fill": edge, "stroke": edge, "stroke-width": "1"}
    ET.SubElement(pattern, "path", lines | {"stroke-linejoin": "miter"})
    return pattern
