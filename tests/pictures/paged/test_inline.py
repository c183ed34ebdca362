"""Styles and shapes that several pictures of a page share."""

import re
from random import Random

import pytest

from tests.shipped import shipped_results
from vstatics.core.tables.html import Markup, tag
from vstatics.pictures.paged.drawn import of_each
from vstatics.pictures.paged.inline import inline, shared, short_path

ROW = re.compile(r'transform="translate[(]([\d.]+) ([\d.]+)[)]"><g id="(row-[^"]*)" ')


def test_a_sheet_of_all_gears_uses_the_rows_of_each_gear() -> None:
    results = shipped_results("ravigneaux-gf4a.yaml")
    numbers = range(1, len(results.case.gears) + 1)
    *singles, sheet = of_each(results, "flow", [*([number] for number in numbers), []])
    defined = [name for single in singles for *_, name in ROW.findall(single.sheets[0])]
    used = re.findall('<use href="#([^"]*)"', sheet.sheets[0])
    assert used
    assert {*used} <= {*defined}
    assert len({*defined}) == len(defined) == len(numbers)


LINE = '<path d="M0 0L1 1" fill="none" stroke="var(--ink)" />'
SHORT = '<path d="M0 0L1 1" class="l0" />'


def test_a_look_of_many_is_said_once() -> None:
    page, rules = shared(Markup(f"<svg>{LINE * 3}</svg>"))
    assert page == f"<svg>{SHORT * 3}</svg>"
    assert rules == ".l0{fill:none;stroke:var(--ink)}"
    assert shared(Markup(LINE)) == (LINE, "")


def test_a_shape_of_many_pictures_is_defined_once_and_keeps_its_tooltips() -> None:
    shape = f'<path d="M0 0{"h9v9" * 9}"'
    shown = f"<svg>{shape}><title>sun</title></path></svg><svg>{shape}/></svg>"
    page, _ = shared(Markup(shown * 3))
    assert page.count(shape[7:]) == 1
    assert page.count("<use href") == 6
    assert page.count("<title>sun</title></use>") == 3


def test_equal_hatches_of_pictures_are_defined_once() -> None:
    shown = "".join(
        f'<svg><defs><pattern id="{name}-h0">{LINE}</pattern></defs>'
        f'<path fill="url(#{name}-h0)"/><path fill="url(#c)"/></svg>'
        for name in "ab"
    )
    page, rules = shared(Markup(shown))
    assert page.count("<pattern") == 1
    assert '<pattern id="h0">' in page
    assert rules == ".l0{fill:url(#h0)}\n.l1{fill:url(#c)}"


def test_texts_that_look_like_attributes_are_left_alone() -> None:
    text = tag("text", '<path fill="none" stroke="red"> fill="none"', x=1)
    page, _ = shared(Markup(text * 2 + LINE * 2))
    assert page.startswith(text * 2)
    assert len(re.findall(r"class=", page)) == 2


def test_spaces_between_parts_of_a_text_stay() -> None:
    svg = b'<svg xmlns="http://www.w3.org/2000/svg"><text xml:space="preserve">A  B</text></svg>'
    assert '<text xml:space="preserve">A  B</text>' in inline(svg, "plan", "plan")


def points_of(path: str) -> list[float]:
    """Coordinates of all points of a path in absolute or relative steps (SVG 2, 9.3)."""
    found: list[float] = []
    x = y = 0.0
    start = (0.0, 0.0)
    for letter, text in re.findall(r"([a-zA-Z])([^a-zA-Z]*)", path):
        numbers = [float(number) for number in re.findall(r"-?(?:\d+\.?\d*|\.\d+)", text)]
        if letter in "zZ":
            x, y = start
            continue
        if letter in "hv":
            numbers = [numbers[0], 0.0] if letter == "h" else [0.0, numbers[0]]
        size = {"Q": 4, "C": 6}.get(letter.upper(), 2)
        for at in range(0, len(numbers), size):  # an equal letter can be omitted
            base = (x, y) if letter.islower() else (0.0, 0.0)
            points = [n + base[place % 2] for place, n in enumerate(numbers[at : at + size])]
            found += points
            x, y = points[-2:]
        start = (x, y) if letter in "Mm" else start
    return found


def test_a_short_path_goes_through_the_same_points() -> None:
    """Two hundred random paths; rounding to tenths moves a point by 0.05 pt at most."""
    chance = Random(50)  # noqa: S311 - not a secret
    for _ in range(200):
        path = ""
        for letter in "M" + "".join(chance.choices("LLLQCM", k=20)):
            count = {"Q": 2, "C": 3}.get(letter, 1)
            places = [chance.choice((10.0, chance.uniform(-2, 99))) for _ in range(2 * count)]
            numbers = [f"{place:.2f}" for place in places]
            pairs = (" ".join(numbers[at : at + 2]) for at in range(0, 2 * count, 2))
            path += letter + " ".join(pairs) + "z" * (chance.random() < 0.1)
        assert points_of(short_path(path)) == pytest.approx(points_of(path), abs=0.0501)
