"""Texts and lines of pictures: measured, shortened, placed and written as matplotlib does."""

from __future__ import annotations

import io
import math
import re
import warnings
from itertools import pairwise
from pathlib import Path
from random import Random
from xml.etree import ElementTree as ET

import matplotlib as mpl
import pytest
from matplotlib.font_manager import get_font
from matplotlib.ft2font import LoadFlags
from matplotlib.ticker import MaxNLocator

from vstatics.pictures.drawing.canvas import Canvas, Look
from vstatics.pictures.drawing.figures import figure_of
from vstatics.pictures.drawing.files import settings_of
from vstatics.pictures.drawing.labels import shortened, spread, ticks, width
from vstatics.pictures.drawing.metrics import line_extent, line_width
from vstatics.pictures.drawing.pen import blank
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.drawing.svg import written_as_svg


@pytest.mark.parametrize("bold", [False, True])
def test_a_text_is_as_large_as_matplotlib_draws_it(bold: bool) -> None:
    """Letters that the font lacks (齿 and 輪) are boxes."""
    font = get_font(Path(mpl.get_data_path(), "fonts", "ttf", f"DejaVuSans{'-Bold' * bold}.ttf"))
    for text in ("carrier 1", "−0.430 · AV fi", "водило 2", "齿輪 P1", " "):
        for size, measured in (
            (8.0, line_width(text, 8.0, bold=bold)),
            (100.0, line_extent(text, 100.0, bold=bold)),
        ):
            font.set_size(size, 72.0)
            with warnings.catch_warnings(action="ignore"):
                font.set_text(text, 0.0, flags=LoadFlags.NO_HINTING)
            wide, high = font.get_width_height()
            assert measured in (wide / 64, (wide / 64, high / 64, font.get_descent() / 64))


def test_labels_move_as_little_as_they_can() -> None:
    """Two labels of size 2 wanted at one place go one to each side; a third, far off, stays."""
    assert spread([4, 4, 20], [2, 2, 2]) == pytest.approx([3, 5, 20])
    assert spread([0, 0], [2, 2], low=0, high=10) == pytest.approx([1, 3])
    assert spread([10, 10], [2, 2], low=0, high=10) == pytest.approx([7, 9])
    assert spread([], []) == []


def test_labels_keep_their_order_and_their_distance() -> None:
    wanted, sizes = [3.0, 1.0, 2.9, 9.0, 3.1], [1.0, 4.0, 2.0, 1.0, 3.0]
    places = spread(wanted, sizes)
    order = sorted(range(5), key=wanted.__getitem__)
    for one, other in pairwise(order):
        assert places[other] - places[one] >= (sizes[one] + sizes[other]) / 2 - 1e-9


def test_a_text_is_cut_where_one_more_letter_would_not_fit() -> None:
    """Even a name of 15,000 letters is cut at once."""
    for text in ("low and reverse brake", "a b  c d e f g h i j k l m n", "ab " * 5000):
        for room in (3, 20, 45.5, 70):
            end = next(
                end for end in range(len(text)) if width(f"{text[: end + 1].rstrip()}…") > room
            )
            assert shortened(text, room) == f"{text[:end].rstrip()}…"


def test_a_text_is_as_wide_under_any_settings_of_the_user() -> None:
    texts = ["input", "carrier and second ring", "E"]
    widths = [width(text) for text in texts]
    width.cache_clear()
    with mpl.rc_context({"text.hinting": "force_autohint"}):
        assert [width(text) for text in texts] == widths


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
