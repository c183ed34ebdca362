"""Pictures of several pages as files, and the width that they are drawn for."""

import re
from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.commands import CASES, vstatics
from tests.processes import names
from vstatics import ReadError, Results, load, solve
from vstatics.pictures.drawing.canvas import Canvas
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.flow import efficiency
from vstatics.pictures.plotting import plot

UMDM = CASES / "umdm.yaml"


@pytest.fixture
def count(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many pages a picture of efficiencies has, where pages have a height."""
    wanted = [3]

    def draw(_: Results, style: Style, gears: Sequence[int]) -> list[Canvas]:
        assert not gears
        number = wanted[0] if style.height < style.width * 10 else 1
        return [Canvas((style.width, 72 + page), style, [], {}) for page in range(number)]

    monkeypatch.setattr(efficiency, "draw", draw)
    return wanted


def wide(svg: str) -> float:
    found = re.search(r'<svg [^>]*?\bwidth="([\d.]+)pt"', svg)
    assert found, svg[:200]
    return float(found[1])


@pytest.mark.parametrize("form", ["svg", "png"])
def test_each_page_is_a_file_and_stale_ones_go(folder: Path, count: list[int], form: str) -> None:
    for number in (3, 2, 1, 3):
        count[0] = number
        said = vstatics("plot", UMDM, "-k", "efficiency", "-o", f"box.{form}")
        further = [f"box-{page}.{form}" for page in range(2, number + 1)]
        shown = f"box.{form} continues in {' and '.join(further)}\n" if further else ""
        assert (said.status, said.out, said.err) == (0, "", shown)
        assert names(folder) == [*further, f"box.{form}"]


def test_a_pdf_has_all_pages_and_stdout_has_one(folder: Path, count: list[int]) -> None:
    asked = ("plot", UMDM, "-k", "efficiency", "-o")
    assert vstatics(*asked, "box.pdf").status == 0
    first = (folder / "box.pdf").read_bytes()
    assert first.count(b"/Type /Page ") == count[0]
    vstatics(*asked, "box.pdf")
    assert (folder / "box.pdf").read_bytes() == first
    assert names(folder) == ["box.pdf"]
    assert vstatics(*asked, "-").out.count("<svg ") == 1


def test_cases_of_a_directory_have_their_pages(folder: Path, count: list[int]) -> None:
    for name in ("box", "box-2", "gear"):
        (folder / f"{name}.yaml").write_bytes(UMDM.read_bytes())
    said = vstatics("plot", "box.yaml", "gear.yaml", "-k", "efficiency", "-o", "out/")
    assert said.status == 0
    shown = [one for one in names(folder / "out") if not one.startswith(".")]
    assert shown == [f"{name}{n}.svg" for name in ("box", "gear") for n in ("-2", "-3", "")]
    said = vstatics("plot", "box.yaml", "box-2.yaml", "-k", "efficiency", "-o", "out/")
    assert said.fails("out/box-2.svg: error: is page 2 of out/box.svg: expected another name")
    count[0] = 1
    said = vstatics("plot", "box-2.yaml", "box.yaml", "-k", "efficiency", "-o", "new/")
    assert said.status == 0


@pytest.mark.usefixtures("count")
def test_python_saves_pages_of_a_width(folder: Path) -> None:
    results = solve(load(UMDM))
    made = plot(results, "efficiency", width=100)
    made.save("box.svg")
    assert names(folder) == ["box-2.svg", "box-3.svg", "box.svg"]
    assert wide(Path("box.svg").read_text("utf-8")) == pytest.approx(100 / 25.4 * 72, abs=0.01)
    assert 'data-page="3"' in Path("box-3.svg").read_text("utf-8")
    Path("own-2.svg").write_text("mine", "utf-8")
    with pytest.raises(ReadError, match=r"own-2\.svg: error: exists already and would be page 2"):
        made.save("own.svg")
    for wrong in (79.0, 1201.0, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="expected a width of 80mm to 1200mm"):
            plot(results, "efficiency", width=wrong)


@pytest.mark.usefixtures("count")
def test_a_width_has_its_unit() -> None:
    asked = ("plot", UMDM, "-k", "efficiency", "-o", "-", "--width")
    one = 85 / 25.4 * 72
    for width, points in {"85mm": one, "8.5 cm": one, "6.5in": 468.0, "500pt": 500.0}.items():
        assert wide(vstatics(*asked, width).out) == pytest.approx(points, abs=0.01)
    for width, why in {
        "170": "expected a length in mm, cm, in, pt, such as 170mm",
        "-170mm": "expected a length in mm",
        "1e3mm": "expected a length in mm",
        "17м": "expected a length in mm",
        "79mm": "expected a width of 80mm to 1200mm",
        "48in": "expected a width of 80mm to 1200mm",
        "999999999in": "expected a width of 80mm to 1200mm",
    }.items():
        told = f"Invalid value for '--width': read `{width}`, {why}"
        assert vstatics(*asked, width).is_wrong_use(told)
