"""Symbols of shift elements, springs and the housing, and the key that explains them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from vstatics.core.model.parts import ELEMENT_KINDS
from vstatics.pictures.drawing.canvas import Look, Point
from vstatics.pictures.drawing.head import Meaning
from vstatics.pictures.drawing.pen import LINE_WIDTH, Pen, zigzag
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.schemes.gear_glyphs import ground
from vstatics.pictures.schemes.scheme import SchemeState

HALF_SIGN = {"freewheel": 6.0, "dog_clutch": 4.0, "spring": 9.0, "play": 9.0}
"""Half the length along the line of symbols other than plates, by kind. [pt]"""
PACK = 6.5
"""Half the length of the symbol of a plate pack. [pt]"""
HALF_BOX_SIGN = 8.0
"""Half the length of a box, for a component without a symbol. [pt]"""
PLATES, BETWEEN = (-7.0, 0.0, 7.0), (-3.5, 3.5)
"""Positions across the line of the plates of the first and of the second link. [pt]"""
GAP_IN_LINE = 5.0
"""Gap between a spring with play and the end of the symbol. [pt]"""
PLATE_CLEARANCE = 2.5
"""Distance from a plate to the opposite plate carrier. [pt]"""
Place = Callable[[float, float], Point]
"""Conversion of distances along and across a line to a point of the picture."""
_Lines = list[Sequence[Point]]


class Coupled(NamedTuple):
    """Symbol of a component on a line: shift element, spring, support or box."""

    kind: str
    start: Point
    """End of the line at the first link. [pt]"""
    end: Point
    color: str
    is_closed: bool = False
    rod: str = ""
    """Colour of the line to the symbol; empty for the colour of the symbol."""
    housing: int = 0
    """Direction of the strokes of the housing at `end`: 1 up, -1 down, 0 without a housing."""
    title: str = ""
    is_backward: bool = False
    """True for a freewheel whose first link is the housing."""


def half_of(kind: str) -> float:
    """Return half the length of the symbol of a kind along the line [pt]."""
    usual = PACK if kind in (*ELEMENT_KINDS, "held") else HALF_BOX_SIGN
    return HALF_SIGN.get(kind, usual)


def draw_coupled(pen: Pen, coupled: Coupled) -> None:
    """Draw a symbol on a line. The plates of a brake are drawn at the housing.

    >>> from vstatics.pictures.drawing.pen import blank
    >>> from vstatics.pictures.drawing.style import Style
    >>> pen = blank(50.0, 50.0, Style())
    >>> draw_coupled(pen, Coupled("brake", (20, 0), (20, 30), "#000000", housing=1))
    >>> len(pen.canvas.parts)
    1
    """
    (x, y), (x2, y2) = coupled.start, coupled.end
    length = abs(x2 - x) + abs(y2 - y)
    dx, dy = (x2 - x) / length, (y2 - y) / length
    half = half_of(coupled.kind)
    is_at_wall = coupled.housing and coupled.kind not in ("freewheel", "spring", "play")
    center = length - half if is_at_wall else length / 2

    def at(forward: float, across: float) -> Point:
        along = center + forward
        return x + along * dx - across * dy, y + along * dy + across * dx

    rods = [(coupled.start, at(-half, 0)), (at(half, 0), coupled.end)]
    lines: _Lines = [line for line in rods if line[0] != line[1]]
    if coupled.housing:
        lines += ground(coupled.end, coupled.housing)
    if coupled.rod and coupled.rod != coupled.color:
        pen.lines(lines, color=coupled.rod, title=coupled.title, zorder=4.5)
        lines = []
    draw = {
        "spring": _spring,
        "play": _play,
        "freewheel": _freewheel,
        "dog_clutch": _dogs,
        "held": _support,
    }
    usual = _plates if coupled.kind in ELEMENT_KINDS else _box
    lines += draw.get(coupled.kind, usual)(pen, at, half, coupled)
    pen.lines(lines, color=coupled.color, title=coupled.title, zorder=4.5)


def _sign(pen: Pen, corners: Sequence[Point], coupled: Coupled, fill: str) -> None:
    look: Look = {"facecolor": fill, "edgecolor": coupled.color, "title": coupled.title}
    pen.area(*corners, width=LINE_WIDTH, joinstyle="round", zorder=4, **look)


def _block(  # noqa: PLR0913, PLR0917 - size and look of a rectangle
    pen: Pen, at: Place, start: float, end: float, edge: float, coupled: Coupled, fill: str = ""
) -> None:
    """Draw a rectangle across the line, by default filled with the colour of the symbol."""
    corners = [at(start, edge), at(end, edge), at(end, -edge), at(start, -edge)]
    _sign(pen, corners, coupled, fill or coupled.color)


def _comb(at: Place, root: float, tip: float, teeth: Sequence[float], edge: float) -> _Lines:
    """Return a line across at `root` and the plates or teeth that reach from it to `tip`."""
    return [(at(root, -edge), at(root, edge)), *((at(root, y), at(tip, y)) for y in teeth)]


def _plates(pen: Pen, at: Place, half: float, coupled: Coupled) -> _Lines:
    """Return the lines of interleaved plates. Engaged plates are drawn as a block instead."""
    edge = PLATES[-1] + 1.5
    if coupled.is_closed:
        _block(pen, at, -half, half, edge, coupled)
        inner = [(at(PLATE_CLEARANCE - half, across), at(half, across)) for across in PLATES]
        pen.lines(inner, color=pen.style.paper, width=0.7, zorder=5)
        return []
    tip = half - PLATE_CLEARANCE
    return [
        *_comb(at, half, -tip, PLATES, PLATES[-1]),
        *_comb(at, -half, tip, BETWEEN, BETWEEN[-1]),
    ]


def _spring(_pen: Pen, at: Place, half: float, _coupled: Coupled) -> _Lines:
    return [[at(*turn) for turn in zigzag(0.0, 0.0, half, 6.0)]]


def _play(pen: Pen, at: Place, half: float, coupled: Coupled) -> _Lines:
    """Return the lines of a spring followed by a gap; fill the gap of an engaged dog clutch."""
    near, far = half - GAP_IN_LINE, half - 1.0
    if coupled.is_closed:
        _block(pen, at, near, far, 6.0, coupled)
    coil = (near - half) / 2
    return [
        [at(*turn) for turn in zigzag(coil, 0.0, near - coil, 6.0)],
        *((at(x, 6), at(x, -6)) for x in (near, far)),
        (at(far, 0), at(half, 0)),
    ]


def _freewheel(pen: Pen, at: Place, half: float, coupled: Coupled) -> _Lines:
    """Return the lines of a triangle that points in the blocked direction of the first link."""
    fill = coupled.color if coupled.is_closed else pen.style.paper
    tip = -half if coupled.is_backward else half
    _sign(pen, [at(-tip, 6), at(-tip, -6), at(tip, 0)], coupled, fill)
    return [(at(tip, 7), at(tip, -7))]


def _dogs(pen: Pen, at: Place, half: float, coupled: Coupled) -> _Lines:
    if coupled.is_closed:
        _block(pen, at, -half, half, 9.0, coupled)
        joint = [at(half / 2 * (1, -1)[step % 2], 3.5 * step - 8.75) for step in range(6)]
        pen.line(*joint, color=pen.style.paper, width=0.9, zorder=5)
        return []
    tip = half / 3
    return [*_comb(at, -half, tip, PLATES, 9.0), *_comb(at, half, -tip, BETWEEN, 9.0)]


def _box(pen: Pen, at: Place, half: float, coupled: Coupled) -> _Lines:
    """Draw a box for a component without a symbol, such as a converter; return no lines."""
    _block(pen, at, -half, half, HALF_BOX_SIGN, coupled, pen.style.paper)
    return []


def _support(_pen: Pen, at: Place, half: float, _coupled: Coupled) -> _Lines:
    return [(at(-half, 0), at(half, 0))]


def meanings(state: SchemeState, style: Style) -> list[Meaning]:
    """Return the key of the picture of a gear: each style with the meaning.

    >>> [said for occurs, said, *_ in meanings(SchemeState(engaged=frozenset({1})), Style())
    ...  if occurs]
    ['engaged']
    """
    piece = {"facecolor": style.paper, "edgecolor": style.soft, "hatch": "////"}
    is_pale, pale = state.idle or state.idle_links, {"color": style.faint}
    return [
        (state.engaged - state.slipping, "engaged", {"facecolor": style.engaged}),
        (state.slipping, "slips under torque", {"color": style.engaged}),
        (state.pieces, "rotates as a block", piece),
        (is_pale, "carries no torque", pale),
    ]
