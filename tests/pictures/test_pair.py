"""Two cases on one sheet: each panel has all of its own picture, on scales that both share."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from tests.commands import CASES, vstatics
from tests.installed import needs
from vstatics import ReadError, load, solve
from vstatics.pictures import render
from vstatics.pictures.drawing.labels import title_width
from vstatics.pictures.drawing.style import PAGE_HEIGHT, PAGE_WIDTH, Style
from vstatics.pictures.pair import PairedCase, pair_pages

TEXT = "{http://www.w3.org/2000/svg}text"
ONE, OTHER = CASES / "simpson.yaml", CASES / "zf-6hp26.yaml"


def parsed(svg: bytes) -> ET.Element:
    """Our own SVG."""
    return ET.fromstring(svg)  # noqa: S314 - from nowhere else


def words(root: ET.Element) -> list[str]:
    return sorted("".join(one.itertext()) for one in root.iter(TEXT))


def panels(root: ET.Element) -> dict[str, ET.Element]:
    return {
        one.attrib["data-case"]: one
        for one in root
        if one.get("class") == "panel" and "data-case" in one.attrib
    }


KINDS = "stick", "structure", "lever", "plan", "flow", pytest.param("steps", marks=needs("vehicle"))


@pytest.mark.parametrize("kind", KINDS)
def test_each_panel_has_what_the_picture_of_its_case_has(kind: str) -> None:
    """On one page of any height; a file goes on on further pages."""
    cases = [PairedCase(path.name, solve(load(path))) for path in (ONE, OTHER)]
    [svg] = pair_pages(cases, kind, "svg", Style())
    both = panels(parsed(svg))
    assert [*both] == ["A", "B"]
    for letter, path in zip("AB", (ONE, OTHER), strict=True):
        alone = words(parsed(render(solve(load(path)), kind, "svg", Style())))
        head = f"{letter}  {path.name}"
        assert sorted([*alone, head]) == words(both[letter])


def heights(panel: ET.Element) -> list[float]:
    """Where texts stand that have a place of their own, from the top [pt]."""
    return [float(one.attrib["y"]) for one in panel.iter(TEXT) if "y" in one.attrib]


def test_sticks_stand_over_one_another() -> None:
    both = [PairedCase(path.name, solve(load(path))) for path in (ONE, OTHER)]
    [svg] = pair_pages(both, "stick", "svg", Style())
    upper, lower = panels(parsed(svg)).values()
    assert max(heights(upper)) < min(heights(lower))


@needs("vehicle")
def test_efficiencies_stand_beside_each_other_on_one_scale() -> None:
    """Three gears of .99 and of .9: the bars are ten times as long, and start at one height."""
    from tests.vehicle.pictures.cars import box

    both = [PairedCase(name, box([3, 2, 1], eta)) for name, eta in (("a", 0.99), ("b", 0.9))]
    [svg] = pair_pages(both, "efficiency", "svg", Style())
    root = parsed(svg)
    assert float(root.attrib["viewBox"].split()[2]) <= PAGE_WIDTH + 0.01
    first, second = panels(root).values()
    found = [
        {text: one for one in own.iter(TEXT) if (text := "".join(one.itertext()))}
        for own in (first, second)
    ]
    top, low, lower = (
        float(own[text].attrib["y"])
        for own, text in ((found[0], "1.000"), (found[0], "0.990"), (found[1], "0.900"))
    )
    assert top == pytest.approx(float(found[1]["1.000"].attrib["y"]))
    assert top < low < lower


@needs("vehicle")
def test_long_names_over_panels_side_by_side_stay_apart() -> None:
    from tests.vehicle.pictures.cars import box

    names = ("A gearbox of a long name, its-file.yaml", "A gearbox of a long name, other.yaml")
    both = [PairedCase(name, box([3, 2, 1])) for name in names]
    [svg] = pair_pages(both, "efficiency", "svg", Style())
    placed = {}
    for one in parsed(svg).iter(TEXT):
        left = one.get("x") or one.get("transform", "").removeprefix("translate(").split()[0]
        placed["".join(one.itertext())] = float(left)
    placed = {line: left for line, left in placed.items() if len(line) > 8}  # no names of gears
    first = [line for line in placed if line in f"A  {names[0]}"]
    second = [line for line in placed if line in f"B  {names[1]}" and line not in first]
    assert " ".join(first) == f"A  {names[0]}"
    assert max(placed[line] + title_width(line) for line in first) < placed[second[0]]
    assert max(placed[line] + title_width(line) for line in second) < PAGE_WIDTH


@needs("vehicle")
def test_charts_of_two_cases_share_their_scales() -> None:
    from tests.vehicle.pictures.cars import box

    both = [PairedCase(name, box(ratios)) for name, ratios in (("a", [3, 1]), ("b", [6, 1]))]
    for kind in ("traction", "sawtooth"):
        [svg] = pair_pages(both, kind, "svg", Style())
        numbers = [
            {text for text in words(own) if text.isdigit() and int(text) % 20 == 0}
            for own in panels(parsed(svg)).values()
        ]
        assert numbers[0] == numbers[1] != set()
    [svg] = pair_pages(both, "steps", "svg", Style())
    shared = [
        {"".join(one.itertext()): one.get("x") for one in own.iter(TEXT)}
        for own in panels(parsed(svg)).values()
    ]
    assert shared[0]["1.000"] == shared[1]["1.000"]
    assert shared[0]["3.000"] != shared[1]["6.000"]


def test_what_does_not_fit_on_a_page_goes_on_a_further_one() -> None:
    both = [PairedCase(path.name, solve(load(path))) for path in (ONE, OTHER)]
    made = pair_pages(both, "flow", "svg", Style(height=PAGE_HEIGHT))
    assert len(made) > 1
    for svg in made:
        assert float(parsed(svg).attrib["viewBox"].split()[3]) <= PAGE_HEIGHT + 0.01


def test_gears_are_those_of_each_case(tmp_path: Path) -> None:
    to = tmp_path / "both.svg"
    assert vstatics("plot", ONE, OTHER, "-k", "flow", "--gear", "R", "-o", to).status == 0
    for panel in panels(parsed(to.read_bytes())).values():
        assert any("gear R" in text for text in words(panel))


@pytest.mark.parametrize("form", ["png", "pdf"])
def test_other_formats_have_both_too(form: str, tmp_path: Path) -> None:
    to = tmp_path / f"both.{form}"
    assert vstatics("plot", ONE, OTHER, "-k", "efficiency", "-o", to).status == 0
    assert to.stat().st_size > 5000


def test_three_cases_need_a_directory_and_two_may_have_one(tmp_path: Path) -> None:
    said = vstatics("plot", ONE, OTHER, ONE, "-k", "stick", "-o", tmp_path / "a.svg")
    assert said.is_wrong_use("one case or two: expected a directory")
    assert vstatics("plot", ONE, OTHER, "-k", "efficiency", "-o", f"{tmp_path}/out/").status == 0
    assert {path.name for path in (tmp_path / "out").glob("*.svg")} == {
        "simpson.svg",
        "zf-6hp26.svg",
    }


@needs("vehicle")
def test_a_case_without_a_picture_is_named(tmp_path: Path) -> None:
    from tests.vehicle.pictures.cars import box

    said = vstatics("plot", ONE, CASES / "wheel-hub.yaml", "-k", "plan", "-o", tmp_path / "a.svg")
    assert said.fails("wheel-hub.yaml: error: a kinematic plan")
    both = [PairedCase("a", box([2.0])), PairedCase("b", box([2.0], vehicle=None))]
    with pytest.raises(ReadError, match="no `vehicle`"):
        pair_pages(both, "traction", "svg", Style())
