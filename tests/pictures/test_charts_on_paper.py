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
from tests.installed import HERE, needs
from vstatics import CaseError, Transmission, load, solve
from vstatics.pictures import drawn_pages
from vstatics.pictures.drawing.files import settings_of
from vstatics.pictures.drawing.style import PAGE_HEIGHT, PAGE_WIDTH, Style

KINDS = (
    *("flow", "efficiency"),
    *(pytest.param(kind, marks=needs("vehicle")) for kind in ("traction", "sawtooth", "steps")),
)
QUICK = ("zf-8hp70.yaml", "ravigneaux-gf4a.yaml")
ROUNDED = 1e-6
LETTERS = 7.0
"""At least [pt]."""


def in_van(case: Transmission) -> Transmission:
    """Return a case in a van: shipped cases have no vehicle. Without its annex, the case alone."""
    if "vehicle" not in HERE:
        return case
    from tests.vehicle.pictures.cars import VAN

    return case.replace(vehicle=VAN)


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
    results, style = solve(in_van(load(path))), Style(height=PAGE_HEIGHT)
    with contextlib.suppress(CaseError), settings_of(style):  # some have no steps
        [figures] = drawn_pages(results, kind, style, [()])
        assert [faults(figure) for figure in figures] == [[]] * len(figures)
