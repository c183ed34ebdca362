"""Letters of pictures of runs in a browser: none over another, none too small to be read."""

from __future__ import annotations

from itertools import combinations, pairwise
from typing import Any

import numpy as np
import pytest

from tests.commands import CASES
from vstatics import Results, load_scenario, solve
from vstatics.pictures import pages
from vstatics.pictures.drawing.labels import width
from vstatics.pictures.drawing.style import PAGE_HEIGHT, POINTS_PER_MILLIMETRE, Style
from vstatics.simulation import Motion, simulate
from vstatics.simulation.pictures.events import placed_words
from vstatics.simulation.record.motion import Event

CAPITALS = 0.73
"""Height of capitals over the size of letters, of DejaVu Sans."""
BOXES = """() => [...document.querySelectorAll("svg text")].map((text) => {
  const box = text.getBoundingClientRect(), size = parseFloat(getComputedStyle(text).fontSize);
  const turned = box.height > box.width && text.textContent.length > 2;
  return [text.textContent, size, turned, box.left, box.top, box.right, box.bottom];
})"""
COLUMN = 85 * POINTS_PER_MILLIMETRE
"""Of a journal."""
STYLES = (
    Style(height=PAGE_HEIGHT),
    Style("ru", dark=True, height=PAGE_HEIGHT),
    Style(height=PAGE_HEIGHT, width=COLUMN),
)


def wrong(browser: Any, results: Results, motion: Motion, style: Style) -> list[str]:
    """Letters that cover others or the edge, or are below 7 pt."""
    found = []
    for page in pages(results, "shift", "svg", style, motion=motion):
        window = browser.new_page()
        window.set_content(f"<body style='margin:0'>{page.decode().partition('?>')[2]}</body>")
        scale = 96 / 72
        boxes = []
        for text, size, turned, *edges in window.evaluate(BOXES):
            left, top, right, bottom = edges
            if size < 7 - 1e-6:
                found.append(f"{text} has {size} pt")
            if turned:  # capitals stand along the other edge
                middle = (left + right) / 2
                left, right = middle - CAPITALS * size / 2 * scale, middle + CAPITALS * size / 2
            else:
                middle, half = (top + bottom) / 2, CAPITALS * size / 2 * scale
                top, bottom = middle - half, middle + half
            boxes.append((text, left, top, right, bottom))
            if left < 0 or top < 0 or right > style.width * scale or bottom > PAGE_HEIGHT * scale:
                found.append(f"{text} leaves the page")
        window.close()
        for one, two in combinations(boxes, 2):
            across = min(one[3], two[3]) - max(one[1], two[1])
            if across > 0.3 and min(one[4], two[4]) - max(one[2], two[2]) > 0.3:
                found.append(f"{one[0]} / {two[0]}")
    return found


@pytest.mark.slow
@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("file", sorted(path.name for path in (CASES / "scenarios").glob("*.yaml")))
def test_no_letters_cover_others(browser: Any, file: str, style: Style) -> None:
    scenario = load_scenario(CASES / "scenarios" / file)
    assert wrong(browser, solve(scenario.case), simulate(scenario), style) == []


@pytest.mark.parametrize("seed", range(20))
def test_words_of_a_row_stand_apart_and_near_their_events(seed: int) -> None:
    rng = np.random.default_rng(seed)
    room = float(rng.uniform(100.0, 400.0))
    places = np.sort(rng.uniform(0.0, room, int(rng.integers(1, 40))))
    kinds = rng.choice(["locks", "slips", "reverses", "impact"], len(places))
    events = [
        (Event(n, "C", kind), float(at))
        for n, (kind, at) in enumerate(zip(kinds, places, strict=True))
    ]
    words = placed_words(events, room, Style())
    assert words
    edges = [(one.middle - width(one.text) / 2, one.middle + width(one.text) / 2) for one in words]
    assert all(left[1] < right[0] for left, right in pairwise(edges))
    assert all(abs(one.middle - one.at) < 80.0 for one in words)
    kept = [one.event for one in words]
    if len(words) < len(events):  # what matters most is named first
        assert any(one.event == "impact" for one in kept) or "impact" not in kinds
