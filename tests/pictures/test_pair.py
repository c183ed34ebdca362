"""Two cases on one sheet: each panel has all of its own picture, on scales that both share."""

from collections.abc import Sequence
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


def pair(kind: str, cases: Sequence[PairedCase] = (), style: Style | None = None) -> list[bytes]:
    """The pages of two cases, by themselves the two shipped ones."""
    both = cases or [PairedCase(path.name, solve(load(path))) for path in (ONE, OTHER)]
    return [*pair_pages(both, kind, "svg", style or Style())]


@pytest.mark.parametrize("kind", KINDS)
def test_each_panel_has_what_the_picture_of_its_case_has(kind: str) -> None:
    [svg] = pair(kind)
    both = panels(parsed(svg))
    assert [*both] == ["A", "B"]
    for letter, path in zip("AB", (ONE, OTHER), strict=True):
        alone = words(parsed(render(solve(load(path)), kind, "svg", Style())))
        assert sorted([*alone, f"{letter}  {path.name}"]) == words(both[letter])
    if kind == "stick":  # one over the other
        upper, lower = (
            [float(one.attrib["y"]) for one in panel.iter(TEXT) if "y" in one.attrib]
            for panel in both.values()
        )
        assert max(upper) < min(lower)


@needs("vehicle")
def test_efficiencies_stand_beside_each_other_on_one_scale() -> None:
    """Three gears of .99 and of .9: the bars are ten times as long, and start at one height."""
    from tests.vehicle.pictures.cars import box

    cases = (PairedCase(name, box([3, 2, 1], eta)) for name, eta in (("a", 0.99), ("b", 0.9)))
    [svg] = pair("efficiency", [*cases])
    root = parsed(svg)
    assert float(root.attrib["viewBox"].split()[2]) <= PAGE_WIDTH + 0.01
    first, second = (
        {"".join(one.itertext()): one.get("y") for one in own.iter(TEXT)}
        for own in panels(root).values()
    )
    top, low, lower = (float(str(y)) for y in (first["1.000"], first["0.990"], second["0.900"]))
    assert top == pytest.approx(float(str(second["1.000"])))
    assert top < low < lower


@needs("vehicle")
def test_long_names_over_panels_side_by_side_stay_apart() -> None:
    from tests.vehicle.pictures.cars import box

    names = ("A gearbox of a long name, its-file.yaml", "A gearbox of a long name, other.yaml")
    both = [PairedCase(name, box([3, 2, 1])) for name in names]
    [svg] = pair("efficiency", both)
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
        [svg] = pair(kind, both)
        numbers = [
            {text for text in words(own) if text.isdigit() and int(text) % 20 == 0}
            for own in panels(parsed(svg)).values()
        ]
        assert numbers[0] == numbers[1] != set()
    [svg] = pair("steps", both)
    shared = [
        {"".join(one.itertext()): one.get("x") for one in own.iter(TEXT)}
        for own in panels(parsed(svg)).values()
    ]
    assert shared[0]["1.000"] == shared[1]["1.000"]
    assert shared[0]["3.000"] != shared[1]["6.000"]


def test_what_does_not_fit_on_a_page_goes_on_a_further_one() -> None:
    made = pair("flow", style=Style(height=PAGE_HEIGHT))
    assert len(made) > 1
    for svg in made:
        assert float(parsed(svg).attrib["viewBox"].split()[3]) <= PAGE_HEIGHT + 0.01


def test_files_have_both_cases_or_each_its_own(tmp_path: Path) -> None:
    both, to = ("plot", ONE, OTHER, "-k"), tmp_path / "both.svg"
    assert vstatics(*both, "flow", "--gear", "R", "-o", to).status == 0
    for panel in panels(parsed(to.read_bytes())).values():
        assert any("gear R" in text for text in words(panel))
    for form in ("png", "pdf"):
        assert vstatics(*both, "efficiency", "-o", tmp_path / f"both.{form}").status == 0
        assert (tmp_path / f"both.{form}").stat().st_size > 5000
    said = vstatics(*both[:3], ONE, "-k", "stick", "-o", to)
    assert said.is_wrong_use("one case or two: for more cases give a directory")
    assert vstatics(*both, "efficiency", "-o", f"{tmp_path}/out/").status == 0
    shown = {path.name for path in (tmp_path / "out").glob("*.svg")}
    assert shown == {"simpson.svg", "zf-6hp26.svg"}


@needs("vehicle")
def test_a_case_without_a_picture_is_named(tmp_path: Path) -> None:
    from tests.vehicle.pictures.cars import box

    said = vstatics("plot", ONE, CASES / "wheel-hub.yaml", "-k", "plan", "-o", tmp_path / "a.svg")
    assert said.fails("wheel-hub.yaml: error: a kinematic plan")
    both = [PairedCase("a", box([2.0])), PairedCase("b", box([2.0], vehicle=None))]
    with pytest.raises(ReadError, match="no `vehicle`"):
        pair_pages(both, "traction", "svg", Style())
