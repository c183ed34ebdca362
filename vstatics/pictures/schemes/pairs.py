"""Elements without planets as they are drawn: pairs of wheels, chains, bevel gears, worms."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import permutations, product

from vstatics.elements.element import Element
from vstatics.pictures.schemes.channels import ABOVE, BELOW
from vstatics.pictures.schemes.glyphs import (
    FACE,
    MESH,
    TOOTH,
    Glyph,
    Stroke,
    member_tap,
    teeth,
    wheel,
)
from vstatics.pictures.schemes.sets import NO_NAMES

PAIR_WIDTH = 50.0
"""Of a pair of wheels with its shafts. [pt]"""
LARGE, SMALL, MIDDLE = 17.0, 11.0, 14.0
"""Radii of the wheel with more teeth, with fewer, and of any other. [pt]"""

Wheel = tuple[str, float]
"""A member and the height of its shaft."""


def pair_glyphs(element: Element, names: Mapping[str, str] = NO_NAMES) -> list[Glyph]:
    """All ways to draw an element that is no set of planets.

    Parameters
    ----------
    names : mapping of str to str, optional
        What is written beside wheels; differentials and shafts have none.
    """
    return [
        glyph._replace(
            texts=[  # beside the planes of wheels, over their shafts
                ((glyph.width / 2 + 3, tap.side * tap.depth + 1.5), "bottom", names[tap.label])
                for tap in glyph.taps
                if tap.label in names
            ]
        )
        for glyph in DRAWN[element.kind](element)
    ]


def _shafts(
    element: Element, strokes: Sequence[Stroke], wheels: Sequence[Wheel]
) -> Iterator[Glyph]:
    """Two wheels in a plane; their shafts leave to either side, then up or down."""
    middle = PAIR_WIDTH / 2
    (low, low_y), (high, high_y) = sorted(wheels, key=lambda wheel: wheel[1])
    for low_x, high_x in product((0.0, PAIR_WIDTH), repeat=2):
        for low_side, high_side in product((ABOVE, BELOW), repeat=2):
            if low_x == high_x and (low_side, high_side) != (BELOW, ABOVE):
                continue  # one would run along the other
            shafts = [
                Stroke(((x, y), (middle + (6 if x < middle else -6), y)))
                for x, y in ((low_x, low_y), (high_x, high_y))
            ]
            taps = [
                member_tap(low, element.link(low), low_side, low_x, low_y),
                member_tap(high, element.link(high), high_side, high_x, high_y),
            ]
            yield Glyph(PAIR_WIDTH, [*strokes, *shafts], taps)


def _radii(element: Element) -> dict[str, float]:
    """By the numbers of teeth."""
    first, second = (element.teeth.get(member, 1) for member in ("first", "second"))
    if first == second:
        return {"first": MIDDLE, "second": MIDDLE}
    small, large = ("first", "second") if first < second else ("second", "first")
    return {small: SMALL, large: LARGE}


def _stacked(
    element: Element, between: float = MESH, extra: Callable[[float], list[Stroke]] = lambda _: []
) -> Iterator[Glyph]:
    """A wheel above another, either of them below."""
    radii = _radii(element)
    for low, high in permutations(("first", "second")):
        height = 2 * radii[low] + 2 * radii[high] + between
        low_y, high_y = radii[low] - height / 2, height / 2 - radii[high]
        strokes = [
            *wheel(PAIR_WIDTH / 2, low_y, radii[low]),
            *wheel(PAIR_WIDTH / 2, high_y, radii[high]),
            *extra(2 * radii[low] - height / 2),
        ]
        yield from _shafts(element, strokes, [(low, low_y), (high, high_y)])


def _idler(element: Element) -> Iterator[Glyph]:
    radius = SMALL

    def idler(y: float) -> list[Stroke]:
        middle = y + MESH + radius
        pin = Stroke(((PAIR_WIDTH / 2 - 5, middle), (PAIR_WIDTH / 2 + 5, middle)))
        return [*wheel(PAIR_WIDTH / 2, middle, radius), pin]

    return _stacked(element, 2 * MESH + 2 * radius, idler)


def _flexible(element: Element) -> Iterator[Glyph]:
    """A chain or a belt."""
    gap = 14.0

    def strands(y: float) -> list[Stroke]:
        xs = (PAIR_WIDTH / 2 - FACE + 2, PAIR_WIDTH / 2 + FACE - 2)
        return [Stroke(((x, y), (x, y + gap)), dashed=True) for x in xs]

    return _stacked(element, gap, strands)


def _internal(element: Element) -> Iterator[Glyph]:
    """The smaller wheel inside the larger one, which is drawn as a ring."""
    radii = _radii(element)
    inner, outer = sorted(("first", "second"), key=radii.__getitem__)
    x, y, radius = PAIR_WIDTH / 2, -4.0, SMALL
    top = y + radius + MESH
    fixed = [*wheel(x, y, radius), teeth(x, top)]
    ring = member_tap(outer, element.link(outer), ABOVE, x, top)
    for at, side in product((0.0, PAIR_WIDTH), (ABOVE, BELOW)):
        shaft = Stroke(((at, y), (x, y)))
        tap = member_tap(inner, element.link(inner), side, at, y)
        yield Glyph(PAIR_WIDTH, [*fixed, shaft], [tap, ring])


def _worm(element: Element) -> Iterator[Glyph]:
    """A worm below its wheel."""
    x, y, radius = PAIR_WIDTH / 2, -14.0, 8.0
    box = Stroke(((x - 12, y - radius), (x + 12, y - radius), (x + 12, y + radius)))
    rest = Stroke(((x + 12, y + radius), (x - 12, y + radius), (x - 12, y - radius)))
    threads = [Stroke(((x + d - 4, y - radius), (x + d + 4, y + radius))) for d in (-8, 0, 8)]
    upper = y + radius + MESH + MIDDLE
    strokes = [box, rest, *threads, *wheel(x, upper, MIDDLE)]
    return _shafts(element, strokes, [("worm", y), ("wheel", upper)])


def _mirrored(strokes: Sequence[Stroke], width: float) -> list[Stroke]:
    return [s._replace(points=tuple((width - x, y) for x, y in s.points)) for s in strokes]


def _bevel_pair(element: Element) -> Iterator[Glyph]:
    """A wheel on a level shaft, the other on one across it, which is drawn upright."""
    strokes = [
        Stroke(((0, -12), (18, -12))),
        Stroke(((18, -26), (18, 2))),
        Stroke(((14, 6), (22, -2)), TOOTH),
        Stroke(((14, -30), (22, -22)), TOOTH),
        Stroke(((17, 10), (26, 1)), TOOTH),
        Stroke(((21.5, 5.5), (42.5, 5.5))),
        Stroke(((38, 1), (47, 10)), TOOTH),
    ]
    first, second = element.link("first"), element.link("second")
    for x, middle, drawn in (
        (0.0, 32.0, strokes),
        (PAIR_WIDTH, 18.0, _mirrored(strokes, PAIR_WIDTH)),
    ):
        for side in (ABOVE, BELOW):
            across = member_tap("second", second, ABOVE, middle, 5.5)
            yield Glyph(PAIR_WIDTH, drawn, [member_tap("first", first, side, x, -12.0), across])


def _bevel(element: Element) -> Iterator[Glyph]:
    """A bevel differential: a planet on its pin in the cage, side wheels on half-shafts."""
    width = 96.0
    middle, shaft, cage = width / 2, -12.0, 28.0
    half = [
        Stroke(((0, shaft), (middle - 21.5, shaft))),
        Stroke(((middle - 21.5, shaft), (middle - 21.5, 6.5))),
        Stroke(((middle - 17.5, 2.5), (middle - 25.5, 10.5)), TOOTH),
        Stroke(((middle - 14.5, 5.5), (middle - 22.5, 13.5)), TOOTH),
        Stroke(((middle - 18.5, 9.5), (middle, 9.5))),
        Stroke(((middle, cage), (middle - 36, cage), (middle - 36, shaft + 5))),
        Stroke(((middle, 2), (middle, cage))),
    ]
    strokes = [*half, *_mirrored(half, width)]
    carrier = member_tap("carrier", element.link("carrier"), ABOVE, middle, cage)
    return _in_line(element, Glyph(width, strokes, [carrier]), ("left", "right"), shaft)


def _shaft(element: Element) -> Iterator[Glyph]:
    """A shaft in a bearing."""
    strokes = [Stroke(((0, 0), (PAIR_WIDTH, 0)))]
    strokes += [teeth(PAIR_WIDTH / 2, y, 7.0) for y in (-4.0, 4.0)]
    return _in_line(element, Glyph(PAIR_WIDTH, strokes, []), ("first", "second"), 0.0)


def _in_line(element: Element, bare: Glyph, members: tuple[str, str], y: float) -> Iterator[Glyph]:
    """A glyph with two shafts on a level, each at either end; they leave up or down."""
    for left, right in permutations(members):
        for left_side, right_side in product((ABOVE, BELOW), repeat=2):
            taps = [
                member_tap(left, element.link(left), left_side, 0.0, y),
                member_tap(right, element.link(right), right_side, bare.width, y),
            ]
            yield bare._replace(taps=[*taps, *bare.taps])


DRAWN: Mapping[str, Callable[[Element], Iterator[Glyph]]] = {
    "gear_pair": _stacked,
    "idler": _idler,
    "chain": _flexible,
    "belt": _flexible,
    "internal_pair": _internal,
    "worm": _worm,
    "bevel_pair": _bevel_pair,
    "bevel": _bevel,
    "shaft": _shaft,
}
"""How each kind of `vstatics.elements.kinds.Simple` is drawn; `held` is a support."""
