"""Places of letters, lines and marks in SVG are those of matplotlib, which is not used for SVG."""

from __future__ import annotations

import io
import math
import re
from random import Random
from xml.etree import ElementTree as ET

import matplotlib as mpl
import pytest
from matplotlib.ticker import MaxNLocator

from vstatics.pictures.drawing.canvas import Canvas, Look
from vstatics.pictures.drawing.figures import figure_of
from vstatics.pictures.drawing.files import settings_of
from vstatics.pictures.drawing.labels import ticks
from vstatics.pictures.drawing.pen import blank
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.drawing.svg import written_as_svg

NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
WORDS = ("sun", "carrier 2", "Ring gear", "η = 0.98", "солнечная", "P1: 45")


def texts_and_lines(svg: bytes) -> list[tuple[str, list[float]]]:
    """Each text and path with its numbers, without the background."""
    found = []
    for element in ET.fromstring(svg).iter():  # noqa: S314 - written here
        kind = element.tag.rpartition("}")[2]
        if kind == "text":
            place = [element.get("x"), element.get("y")]
            at = " ".join(map(str, place)) if place[0] else element.get("transform", "")
            found.append((element.text or "", [float(n) for n in NUMBER.findall(at)]))
        elif kind == "path" and "stroke" in str(element.attrib):
            found.append(("", [float(n) for n in NUMBER.findall(element.get("d", ""))]))
    return found


def by_matplotlib(canvas: Canvas) -> bytes:
    file = io.BytesIO()
    with settings_of(canvas.style):
        figure_of(canvas).savefig(file, format="svg", metadata={"Date": None})
    return file.getvalue()


@pytest.mark.skipif(
    tuple(map(int, mpl.__version__.split(".")[:2])) < (3, 11),
    reason="matplotlib before 3.11 measures lines of text in another way",
)
def test_texts_and_lines_are_where_matplotlib_places_them() -> None:
    """Two hundred random texts with random alignments, and as many lines with gaps."""
    chance = Random(50)  # noqa: S311 - not a secret
    pen = blank(400.0, 300.0, Style()).panel((20.0, 30.0), (300.0, 200.0)).fitted((0, 0), (450, 90))
    for number in range(200):
        text = "\n".join(chance.choices(WORDS, k=chance.choice((1, 1, 2, 3))))
        look: Look = {
            "ha": chance.choice(("left", "center", "right")),
            "va": chance.choice(("top", "bottom", "center", "baseline", "center_baseline")),
            "rotation": chance.choice((0, 0, 90, 30)),
        }
        look |= {"linespacing": 1.25} if chance.random() < 0.5 else {}
        at = chance.uniform(50, 300), chance.uniform(50, 300)
        size, bold = chance.uniform(6, 14), chance.random() < 0.5
        pen.text(*at, f"{number} {text}", size=size, bold=bold, **look)
        places = [(chance.uniform(20, 300), chance.uniform(10, 80)) for _ in range(4)]
        places[chance.randrange(1, 3)] = (math.nan, math.nan)
        pen.line((5.0, 5.0), *places, (9.0, 9.0), color="#000000", width=chance.uniform(0.2, 3))
    drawn, expected = texts_and_lines(written_as_svg(pen.canvas, "")), by_matplotlib(pen.canvas)
    other = texts_and_lines(expected)
    assert [text for text, _ in drawn if text] == [text for text, _ in other if text]
    ours, theirs = ([n for _, numbers in found for n in numbers] for found in (drawn, other))
    assert ours == pytest.approx(theirs, abs=0.0051)


def test_ticks_are_those_of_matplotlib() -> None:
    chance = Random(51)  # noqa: S311 - not a secret
    for _ in range(300):
        low = chance.choice((0.0, chance.uniform(-1, 1) * 10 ** chance.uniform(-3, 5)))
        high, most = low + 10 ** chance.uniform(-3, 5), chance.randrange(2, 12)
        expected = MaxNLocator(most, steps=[1, 2, 5, 10]).tick_values(low, high)
        shown = [value for value in expected if low <= value <= high]
        assert ticks(low, high, most) == pytest.approx(shown, rel=1e-9, abs=1e-12), (low, high)
