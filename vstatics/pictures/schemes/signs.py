"""The usual signs: packs of plates, dogs, freewheels, springs, the housing; and their key."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from vstatics.core.model.parts import ELEMENT_KINDS
from vstatics.pictures.drawing.head import Meaning
from vstatics.pictures.drawing.labels import Point
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.pen import LINE_WIDTH, Pen, zigzag
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.schemes.glyphs import ground
from vstatics.pictures.schemes.scheme import SchemeState

HALF_SIGN = {"freewheel": 6.0, "dog_clutch": 4.0, "spring": 9.0, "play": 9.0}
"""Half the length along the line, where it is not that of plates. [pt]"""
PACK = 6.5
"""Half the length of a pack of plates. [pt]"""
HALF_BOX_SIGN = 8.0
"""Half the length of the box of what has no sign. [pt]"""
PLATES, BETWEEN = (-7.0, 0.0, 7.0), (-3.5, 3.5)
"""Where plates of the one side stand across the line, and those between them. [pt]"""
GAP_IN_LINE = 5.0
"""From a spring with play to the end of its sign. [pt]"""
PLATE_CLEARANCE = 2.5
"""From a plate to the drum of the others. [pt]"""
Place = Callable[[float, float], Point]
"""From places along and across a line to those of the picture."""


class Coupled(NamedTuple):
    """A shift element, a spring, a support or a box on a level or upright line."""

    kind: str
    start: Point
    """At its first link."""
    end: Point
    color: str
    is_closed: bool = False
    rod: str = ""
    """The colour of what leads to its sign, if it is another."""
    housing: int = 0
    """Toward which side the housing is at its end; 0 where there is none."""
    title: str = ""
    is_backward: bool = False
    """A freewheel whose first link is the housing."""


def half_of(kind: str) -> float:
    """Half the length of the sign of a kind along its line [pt]."""
    own = PACK if kind in (*ELEMENT_KINDS, "held") else HALF_BOX_SIGN
    return HALF_SIGN.get(kind, own)


def draw_coupled(pen: Pen, one: Coupled) -> None:
    """A sign on its line; plates at the housing stand at its wall.

    >>> from vstatics.pictures.drawing.pen import blank
    >>> from vstatics.pictures.drawing.style import Style
    >>> pen = blank(50.0, 50.0, Style())
    >>> draw_coupled(pen, Coupled("brake", (20, 0), (20, 30), "#000000", housing=1))
    >>> len(pen.figure.artists)
    1
    """
    (x, y), (x2, y2) = one.start, one.end
    length = abs(x2 - x) + abs(y2 - y)
    dx, dy = (x2 - x) / length, (y2 - y) / length
    half = half_of(one.kind)
    is_at_wall = one.housing and one.kind not in ("freewheel", "spring", "play")
    center = length - half if is_at_wall else length / 2

    def at(forward: float, across: float) -> Point:
        along = center + forward
        return x + along * dx - across * dy, y + along * dy + across * dx

    rods = [(one.start, at(-half, 0)), (at(half, 0), one.end)]
    lines: list[Sequence[Point]] = [line for line in rods if line[0] != line[1]]
    if one.housing:
        lines += ground(one.end, one.housing)
    if one.rod and one.rod != one.color:
        pen.lines(lines, color=one.rod, title=one.title, zorder=4.5)
        lines = []
    draw = {
        "spring": _spring,
        "play": _play,
        "freewheel": _freewheel,
        "dog_clutch": _dogs,
        "held": _support,
    }
    usual = _plates if one.kind in ELEMENT_KINDS else _box
    lines += draw.get(one.kind, usual)(pen, at, half, one)
    pen.lines(lines, color=one.color, title=one.title, zorder=4.5)


def _sign(pen: Pen, corners: Sequence[Point], one: Coupled, fill: str) -> None:
    look: Look = {"facecolor": fill, "edgecolor": one.color, "title": one.title}
    pen.area(*corners, width=LINE_WIDTH, joinstyle="round", zorder=4, **look)


def _closed(pen: Pen, at: Place, half: float, edge: float, one: Coupled) -> None:
    """What is pressed together is one block."""
    corners = [at(-half, edge), at(half, edge), at(half, -edge), at(-half, -edge)]
    _sign(pen, corners, one, one.color)


def _plates(pen: Pen, at: Place, half: float, one: Coupled) -> list[Sequence[Point]]:
    """Plates of the one side between those of the other; pressed together they are one block."""
    edge = PLATES[-1] + 1.5
    if one.is_closed:
        _closed(pen, at, half, edge, one)
        inner = [(at(PLATE_CLEARANCE - half, across), at(half, across)) for across in PLATES]
        pen.lines(inner, color=pen.style.paper, width=0.7, zorder=5)
        return []
    return [
        (at(half, -PLATES[-1]), at(half, PLATES[-1])),
        *((at(half, across), at(PLATE_CLEARANCE - half, across)) for across in PLATES),
        (at(-half, BETWEEN[0]), at(-half, BETWEEN[1])),
        *((at(-half, across), at(half - PLATE_CLEARANCE, across)) for across in BETWEEN),
    ]


def _spring(_pen: Pen, at: Place, half: float, _one: Coupled) -> list[Sequence[Point]]:
    return [[at(*turn) for turn in zigzag(0.0, 0.0, half, 6.0)]]


def _play(pen: Pen, at: Place, half: float, one: Coupled) -> list[Sequence[Point]]:
    """A spring with a gap behind it, which a dog clutch closes."""
    near, far = half - GAP_IN_LINE, half - 1.0
    if one.is_closed:
        _sign(pen, [at(near, 6), at(far, 6), at(far, -6), at(near, -6)], one, one.color)
    coil = (near - half) / 2
    return [
        [at(*turn) for turn in zigzag(coil, 0.0, near - coil, 6.0)],
        *((at(x, 6), at(x, -6)) for x in (near, far)),
        (at(far, 0), at(half, 0)),
    ]


def _freewheel(pen: Pen, at: Place, half: float, one: Coupled) -> list[Sequence[Point]]:
    """Its point is where its first link cannot go on."""
    fill = one.color if one.is_closed else pen.style.paper
    tip = -half if one.is_backward else half
    _sign(pen, [at(-tip, 6), at(-tip, -6), at(tip, 0)], one, fill)
    return [(at(tip, 7), at(tip, -7))]


def _dogs(pen: Pen, at: Place, half: float, one: Coupled) -> list[Sequence[Point]]:
    """Teeth of the one between teeth of the other."""
    if one.is_closed:
        _closed(pen, at, half, 9, one)
        joint = [at(half / 2 * (1, -1)[step % 2], 3.5 * step - 8.75) for step in range(6)]
        pen.line(*joint, color=pen.style.paper, width=0.9, zorder=5)
        return []
    lines: list[Sequence[Point]] = [(at(side, 9), at(side, -9)) for side in (-half, half)]
    for side, places in ((-half, (-7.0, 0.0, 7.0)), (half, (-3.5, 3.5))):
        lines += [(at(side, across), at(-side / 3, across)) for across in places]
    return lines


def _box(pen: Pen, at: Place, half: float, one: Coupled) -> list[Sequence[Point]]:
    """A reduction, a converter: what stands in it is not known."""
    across = HALF_BOX_SIGN
    corners = [at(-half, across), at(half, across), at(half, -across), at(-half, -across)]
    _sign(pen, corners, one, pen.style.paper)
    return []


def _support(_pen: Pen, at: Place, half: float, _one: Coupled) -> list[Sequence[Point]]:
    return [(at(-half, 0), at(half, 0))]


def meanings(state: SchemeState, style: Style) -> list[Meaning]:
    """Signs of the picture of a gear, and what they say.

    >>> [said for occurs, said, *_ in meanings(SchemeState(engaged=frozenset({1})), Style())
    ...  if occurs]
    ['engaged']
    """
    piece = {"facecolor": style.paper, "edgecolor": style.soft, "hatch": "////"}
    is_pale, pale = state.idle or state.idle_links, {"color": style.faint}
    return [
        (state.engaged, "engaged", {"facecolor": style.engaged}),
        (state.pieces, "turns as one piece", piece),
        (is_pale, "carries no torque", pale),
    ]
