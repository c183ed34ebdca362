"""Marks of the speeds at which the input runs, in a panel over the speed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from vstatics.pictures.drawing.canvas import Look
from vstatics.pictures.drawing.head import Meaning
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import Style


def running_sign(speeds: Sequence[float], style: Style) -> Iterator[Meaning]:
    """Yield the legend entry of running speeds [rpm], given in ascending order.

    >>> [sign[1] for sign in running_sign([800.0, 6500.0], Style())]
    ['the input runs, 800 to 6500 rpm']
    """
    if speeds:
        low, high = (f"{speeds[place]:.0f}" for place in (0, -1))
        text = style.text("the input runs, {low} to {high} rpm", low=low, high=high)
        if len(speeds) == 1:
            text = style.text("the input runs at {at} rpm", at=low)
        yield (True, text, _look(speeds, style))


def draw_running(pen: Pen, speeds: Sequence[float], style: Style) -> None:
    """Draw a band from the lowest to the highest running speed, or a line at a single speed."""
    if not speeds:
        return
    wide, high = pen.size
    left, right = (pen.across(speeds[place]) for place in (0, -1))
    left, right, group = max(left, 0.0), min(right, wide), pen.within("range")
    look = {"zorder": 0.3, **_look(speeds, style)}
    if len(speeds) == 1:
        group.line((left, 0.0), (left, high), **look)
    else:
        group.box((left, 0.0), (right - left, high), **look)


def _look(speeds: Sequence[float], style: Style) -> Look:
    """Return the style of a line at a single speed, or of a band."""
    if len(speeds) == 1:
        return {"color": style.power, "width": 2.4}
    return {"facecolor": style.power, "alpha": 0.25}
