"""Flows, efficiencies and charts of every shipped case on paper: letters, widths, overlaps."""

from __future__ import annotations

import contextlib
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text

from tests.commands import SHIPPED
from vstatics import CaseError, load, solve
from vstatics.pictures import drawn_pages
from vstatics.pictures.drawing.files import settings_of
from vstatics.pictures.drawing.style import PAGE_HEIGHT, PAGE_WIDTH, Style
from vstatics.vehicle.case.vehicle import Vehicle

KINDS = ("flow", "efficiency", "traction", "sawtooth", "steps")
VAN = Vehicle(1750, 0.32, 0.012, 0.9, 3.7, engine=[(100.0, 150.0), (400.0, 225.0), (600.0, 180.0)])
"""Shipped cases have no vehicle: they are put into this one."""
QUICK = ("zf-8hp70.yaml", "ravigneaux-gf4a.yaml")
ROUNDED = 1e-6
LETTERS = 7.0
"""At least [pt]."""


def faults(figure: Figure) -> list[object]:
    """What is too large, too small, or stands over another text."""
    wide, high = figure.get_size_inches() * 72
    found: list[object] = []
    if wide > PAGE_WIDTH + ROUNDED or high > PAGE_HEIGHT + ROUNDED:
        found.append((wide, high))
    figure.set_dpi(150)
    canvas: Any = FigureCanvasAgg(figure)
    renderer = canvas.get_renderer()
    every: list[Any] = figure.findobj(Text)
    texts = [one for one in every if one.get_text().strip()]
    found += [one.get_text() for one in texts if one.get_fontsize() < LETTERS]
    boxes = [(one.get_text(), one.get_window_extent(renderer)) for one in texts]
    for (name, one), (other, another) in combinations(boxes, 2):
        across = min(one.x1, another.x1) - max(one.x0, another.x0)
        up = min(one.y1, another.y1) - max(one.y0, another.y0)
        if min(across, up) > 1.5:  # pixels, of rounded letters
            found.append((name, other))
    edge = figure.bbox
    found += [name for name, box in boxes if box.x0 < 0 or box.y0 < 0 or box.x1 > edge.x1]
    return found


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    "path",
    [
        pytest.param(path, id=path.name, marks=() if path.name in QUICK else pytest.mark.slow)
        for path in SHIPPED
    ],
)
def test_pages_are_readable_and_fit_the_paper(path: Path, kind: str) -> None:
    results, style = solve(load(path).replace(vehicle=VAN)), Style(height=PAGE_HEIGHT)
    with contextlib.suppress(CaseError), settings_of(style):  # some have no steps
        [figures] = drawn_pages(results, kind, style, [()])
        assert [faults(figure) for figure in figures] == [[]] * len(figures)
