"""Letters of stick diagrams with several axes, as a browser shows them."""

from __future__ import annotations

from typing import Any

import pytest

import vstatics
from tests.commands import CASES
from tests.pictures.schemes.axes.letters import under_letters
from vstatics.pictures import render
from vstatics.pictures.sheet.style import Style
from vstatics.statics.results import Language

QUICK = ("toyota-p410", "dual-clutch-wheels", "power-split")
SLOW = ("two-stage", "moskvich412", "driveline-8hp70")
LEAST = 7 - 1e-6
"""The size of the least letters. [pt]"""


def check(browser: Any, name: str, style: Style, gears: tuple[int, ...]) -> None:
    """No letters over others, none over a line of a link or of a device."""
    results = vstatics.solve(vstatics.load(CASES / f"{name}.yaml"))
    svg = render(results, "stick", "svg", style, gears).decode()
    letters, lines, least = under_letters(browser, svg)
    assert letters == []
    assert lines == []
    assert least >= LEAST


@pytest.mark.parametrize("name", QUICK)
def test_letters_stand_clear_of_letters_and_lines(browser: Any, name: str) -> None:
    check(browser, name, Style(wheels=True), (1,))


@pytest.mark.slow
@pytest.mark.parametrize("gears", [(), (1,)])
@pytest.mark.parametrize("language", ["en", "ru"])
@pytest.mark.parametrize("wheels", [False, True])
@pytest.mark.parametrize("name", [*QUICK, *SLOW])
def test_letters_of_all_boxes_stand_clear(
    browser: Any, name: str, wheels: bool, language: Language, gears: tuple[int, ...]
) -> None:
    check(browser, name, Style(wheels=wheels, language=language), gears)
