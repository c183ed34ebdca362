"""Structure of a transmission: components are boxes, and shift elements connect their links.

The picture follows figure 5b of V. B. Algin, Visual-Statics. Every case can be drawn, also a case
without a stick diagram.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Canvas
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.schemes.boxes import boxes_of
from vstatics.pictures.schemes.coaxial.picture import coaxial_sheet, figures
from vstatics.pictures.schemes.scheme import scheme_of


def each(results: Results, style: Style, shown: Iterable[Sequence[int]]) -> Iterator[list[Canvas]]:
    """Yield the pages of the structure, without a gear or in a single gear, in a fixed layout.

    In the picture of a gear, engaged shift elements and locked-up components are marked, and lines
    without torque are pale.

    Source: V. B. Algin, Visual-Statics, figure 5b.

    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2)], [Gear([1])])
    >>> [[page]] = each(solve(case), Style(), [()])
    >>> sorted(page.texts)
    ['1', '2', '3', 'D1', 'Structure', 'T1', 'first', 'second', 'third', 'u = −2']
    """
    scheme = scheme_of(results.case)
    sections, texts = boxes_of(scheme, style)
    sheet = coaxial_sheet(scheme, sections, style, texts)
    if sheet is None:
        raise TypeError(results.case)  # cannot occur, because any component can be drawn as a box
    yield from figures(results, scheme, sheet, style, shown, style.text("structure"))
