"""Letters of stick diagrams with several axes, as a browser shows them."""

from itertools import product
from typing import Any
from xml.etree import ElementTree as ET

import pytest

import vstatics
from tests.commands import CASES
from tests.pictures.schemes.axes.boxes import PAIRS, one_pair, six_speed
from tests.pictures.schemes.axes.letters import under_letters
from vstatics.core.model.transmission import Transmission
from vstatics.core.texts import Language
from vstatics.pictures import render
from vstatics.pictures.drawing.style import PAGE_WIDTH, Style

NAMES = ("toyota-p410", "dual-clutch-wheels", "power-split", "two-stage", "moskvich412")
QUICK = [(name, True, "en", (1,)) for name in NAMES[:3]]


def load(name: str) -> Transmission:
    return vstatics.load(CASES / f"{name}.yaml")


LEAST = 7 - 1e-6
"""The size of the least letters. [pt]"""
NARROW = 100 / 25.4 * 72
"""A page of 100 mm. [pt]"""


def check(browser: Any, case: Transmission, style: Style, gears: tuple[int, ...] = ()) -> None:
    """No letters over others, none over a line of a link or of a device."""
    svg = render(vstatics.solve(case), "stick", "svg", style, gears).decode()
    assert float(ET.fromstring(svg).attrib["width"].removesuffix("pt")) <= style.width + 0.01  # noqa: S314
    letters, lines, least = under_letters(browser, svg)
    assert letters == []
    assert lines == []
    assert least >= LEAST


@pytest.mark.parametrize(
    ("name", "wheels", "language", "gears"),
    [
        pytest.param(*one, marks=() if one in QUICK else pytest.mark.slow)
        for one in product((*NAMES, "driveline-8hp70"), (False, True), ("en", "ru"), ((), (1,)))
    ],
)
def test_letters_stand_clear_of_letters_and_lines(
    browser: Any, name: str, wheels: bool, language: Language, gears: tuple[int, ...]
) -> None:
    check(browser, load(name), Style(wheels=wheels, language=language), gears)


@pytest.mark.slow
@pytest.mark.parametrize("wheels", [False, True])
@pytest.mark.parametrize("width", [NARROW, PAGE_WIDTH])
def test_a_manual_box_of_nine_pairs_fits_into_a_narrow_page(
    browser: Any, width: float, wheels: bool
) -> None:
    case = six_speed()
    check(browser, case, Style(width=width, wheels=wheels))
    check(browser, case, Style(width=width, wheels=wheels), (7,))


@pytest.mark.parametrize("kind", PAIRS)
def test_letters_stand_clear_of_pairs_of_every_kind(browser: Any, kind: str) -> None:
    check(browser, one_pair(kind), Style(wheels=True, language="ru"), (1,))


@pytest.mark.slow
def test_a_driveline_fits_into_a_narrow_page(browser: Any) -> None:
    check(browser, load("driveline-8hp70"), Style(width=NARROW))


HOLLOW = """
input: engine
output: out
elements:
  g1: {kind: gear_pair, first: odd, second: w1, teeth: {first: 13, second: 46}}
  g3: {kind: gear_pair, first: odd, second: w3, teeth: {first: 26, second: 37}}
  g2: {kind: gear_pair, first: even, second: w2, teeth: {first: 19, second: 42}}
  g4: {kind: gear_pair, first: even, second: w4, teeth: {first: 31, second: 32}}
shift_elements:
  C1: [engine, odd]
  C2: [engine, even]
  S1: {kind: dog_clutch, links: [w1, out]}
  S2: {kind: dog_clutch, links: [w2, out]}
  S3: {kind: dog_clutch, links: [w3, out]}
  S4: {kind: dog_clutch, links: [w4, out]}
gears: {"1": [C1, S1], "2": [C2, S2], "3": [C1, S3], "4": [C2, S4]}
"""


def test_the_name_of_an_inner_shaft_is_not_under_the_hollow_shaft() -> None:
    svg = render(vstatics.solve(vstatics.loads(HOLLOW)), "stick", "svg", Style()).decode()
    texts = [item for item in ET.fromstring(svg).iter() if item.tag.endswith("text")]  # noqa: S314
    at = {str(item.text): float(item.attrib["x"]) for item in texts}
    assert {"odd", "even"} <= {*at}
    assert at["C1"] < at["odd"] < at["g3"] < at["even"]
