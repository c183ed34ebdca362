"""Pictures of the scheme: everything that the case joins is joined, and can be read."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import pytest
from matplotlib.figure import Figure

import vstatics
from vstatics.insight.pictures import structure
from vstatics.insight.pictures.placing import Placement
from vstatics.insight.pictures.scheme import Scheme, scheme_of
from vstatics.insight.pictures.style import Style

CASES = sorted(Path(__file__).parents[1].glob("cases/*"))
FEW = {"mzkt7922.dat", "toyota-p410.yaml", "umdm.yaml"}
"""Cases of each kind for the fast tests: a deck, drawn pairs and sets, shared planets."""


def by_name(cases: list[Path]) -> list[object]:
    return [
        pytest.param(case, id=case.name, marks=[] if case.name in FEW else pytest.mark.slow)
        for case in cases
    ]


every_case = pytest.mark.parametrize("path", by_name(CASES))


def overlaps(figure: Figure) -> list[tuple[str, str]]:
    """Pairs of texts whose bounding boxes have a common area, and texts that leave the paper."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    renderer = FigureCanvasAgg(figure).get_renderer()  # type: ignore[no-untyped-call]
    texts = [text for text in figure.axes[0].texts if text.get_text()]
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in texts]
    whole = figure.bbox
    outside = [
        (name, "paper")
        for name, box in boxes
        if not (whole.x0 <= box.x0 and box.x1 <= whole.x1 and whole.y0 <= box.y0)
        or box.y1 > whole.y1
    ]
    pairs = [
        (one, other)
        for (one, a), (other, b) in combinations(boxes, 2)
        if min(a.x1, b.x1) - max(a.x0, b.x0) > 0.5 and min(a.y1, b.y1) - max(a.y0, b.y0) > 0.5
    ]
    return outside + pairs


def pieces_of(placement: Placement, wire: int) -> int:
    """In how many parts a wire falls that do not touch one another."""
    lines = [(x, x, low, high) for x, low, high, own in placement.verticals() if own == wire]
    lines += [
        (*span, placement.y(track), placement.y(track))
        for track, span in placement.row.spans.items()
        if track[0] == wire
    ]
    parts: list[list[tuple[float, float, float, float]]] = []
    for line in lines:
        touched = [part for part in parts if any(touch(line, other) for other in part)]
        merged = [line, *(other for part in touched for other in part)]
        parts = [part for part in parts if part not in touched] + [merged]
    return len(parts)


def touch(one: tuple[float, float, float, float], other: tuple[float, float, float, float]) -> bool:
    across = min(one[1], other[1]) - max(one[0], other[0])
    up = min(one[3], other[3]) - max(one[2], other[2])
    return across >= -1e-9 and up >= -1e-9


def assert_joins(scheme: Scheme, placement: Placement) -> None:
    """Each device meets the links of its members and no others; each link is of one piece."""
    for index, device in enumerate(scheme.devices):
        taps = [tap for tap in placement.row.taps if tap.item == index and tap.reach != "none"]
        assert {tap.wire for tap in taps} == device.links, device.name
        assert all(device.members[tap.label] == tap.wire for tap in taps if tap.label)
        assert index in placement.row.lefts
    for wire in range(1, len(scheme.links) + 1):
        assert pieces_of(placement, wire) == 1, scheme.name(wire)
    for port in scheme.ports:
        low, high = placement.row.spans[placement.end_of(port.link)]
        end = low if port.role == "input" else high
        assert end == (0.0 if port.role == "input" else placement.row.width)


def assert_apart(placement: Placement) -> None:
    """No wire runs along another, none ends on another."""
    lines = [(x, x, low, high, wire) for x, low, high, wire in placement.verticals()]
    lines += [
        (*span, placement.y(track), placement.y(track), track[0])
        for track, span in placement.row.spans.items()
    ]
    crossings = {(x, y) for x, y, _, _ in placement.crossings()}
    for one, other in combinations(lines, 2):
        if one[4] != other[4] and touch(one[:4], other[:4]):
            place = max(one[0], other[0]), max(one[2], other[2])
            assert place in crossings, (one, other)


@every_case
def test_structure_can_be_read_and_joins_what_the_case_joins(path: Path) -> None:
    results = vstatics.solve(vstatics.load(path))
    scheme = scheme_of(results.case)
    placement = structure.place(scheme, "en")
    assert_joins(scheme, placement)
    assert_apart(placement)
    for gear in (None, 1):
        figure = structure.draw(results, Style(lang="ru" if gear else "en"), gear)
        assert overlaps(figure) == []
        shown = " ".join(" ".join(text.get_text() for text in figure.axes[0].texts).split())
        for device in scheme.devices:
            assert device.kind == "held" or device.name in shown
        for link in scheme.links:
            assert link in shown
