"""The pictures that README.md and docs/ show are those that the program draws."""

import re
from collections.abc import Iterator
from xml.etree import ElementTree as ET

import matplotlib as mpl
import numpy as np
import pytest
from numpy.typing import NDArray

from tests.commands import ROOT
from tests.documented_pictures import DocumentedPicture, documented
from tests.installed import ANNEXES, missing
from vstatics.core.annexes import picture_kinds

PICTURES_THERE = list(documented())
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
LINE = re.compile(r"M[-\d. ]+(L[-\d. ]+){3,}")
"""Path of a line of at least four points."""
NEAR = 0.1
"""So far may places be from one another where letters or processors differ. [pt]"""
MOST_BETWEEN = 0.4
"""Largest distance between two lines that keep different points of the same curve. [pt]"""
DRAWN_WITH = "3.11."
"""The version of matplotlib with which `make pictures` drew them; others write other SVG."""


def marks(svg: bytes) -> Iterator[tuple[str, list[float], NDArray[np.float64]]]:
    """Yield the text of each element without numbers, its numbers, and the points of a line."""
    for element in ET.fromstring(svg).iter():  # noqa: S314 - our own
        course = element.attrib.get("d", "")
        is_line = LINE.fullmatch(course) is not None
        points = np.array(NUMBER.findall(course) if is_line else [], float).reshape(-1, 2)
        attributes = element.attrib | ({"d": "line"} if is_line else {})
        said = " ".join([element.tag, *map(" ".join, attributes.items()), element.text or ""])
        yield NUMBER.sub("#", said), [float(one) for one in NUMBER.findall(said)], points


def farthest(points: NDArray[np.float64], line: NDArray[np.float64]) -> float:
    """Return the largest distance of points from a line of straight pieces."""
    starts, along = line[:-1], np.diff(line, axis=0)
    from_starts = points[:, None] - starts
    squares = (along**2).sum(axis=1) + 1e-300
    parts = np.clip((from_starts * along).sum(axis=2) / squares, 0, 1)
    return float(np.linalg.norm(from_starts - parts[..., None] * along, axis=2).min(axis=1).max())


@pytest.mark.skipif(
    not mpl.__version__.startswith(DRAWN_WITH), reason="another matplotlib writes other SVG"
)
@pytest.mark.parametrize("one", PICTURES_THERE, ids=lambda one: one.file.stem)
def test_a_picture_is_as_it_is_drawn(one: DocumentedPicture) -> None:
    if missing(ANNEXES) and one.kind not in picture_kinds():
        pytest.skip(f"the kind {one.kind} is of an annex that is not installed")
    shown, drawn = list(marks(one.file.read_bytes())), list(marks(one.drawn()))
    advice = "make pictures draws it anew"
    assert [said for said, *_ in shown] == [said for said, *_ in drawn], advice
    for (said, there, line), (_, here, other_line) in zip(shown, drawn, strict=True):
        assert there == pytest.approx(here, abs=NEAR), f"{said}: {advice}"
        if len(line):  # rounding can decide which points of a curve a line keeps
            both = farthest(line, other_line), farthest(other_line, line)
            assert max(both) <= MOST_BETWEEN, f"{said}: {advice}"


def test_the_first_page_shows_recirculating_power() -> None:
    asked = [one.asked for one in PICTURES_THERE if one.document == ROOT / "README.md"]
    assert asked == ["cases/zf-8hp70.yaml --kind flow --gear R"]


def test_each_kind_of_picture_is_shown() -> None:
    assert {one.kind for one in PICTURES_THERE} >= {
        kind for kind, own in picture_kinds().items() if not own.plots
    }
