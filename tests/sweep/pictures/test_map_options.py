"""Maps with a colour bar, operating points, full load and best gears."""

from __future__ import annotations

from itertools import product
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from tests.chance import examples, generator
from tests.commands import vstatics
from tests.installed import needs
from tests.sweep.sweeps import DIFFERENTIAL
from vstatics import sweep
from vstatics.core.numerics.arrays import Floats
from vstatics.sweep.pictures.best_gear import gear_regions, refined

CAR = """\
links: [in, out]
load: {speed: 1000 rpm, torque: 50 N*m}
mechanisms: {pair: {first: in, second: out, ratio: 2, efficiency: 0.98}}
gears: {low: []}
vehicle: {mass: 1000, radius: 0.3, engine: [[100, 80], [200, 150], [300, 120]]}
"""
DUTY = """\
time [s],gear,speed [rad/s],torque [N*m]
5,low,150,60
2,,0,0
5,high,250,100
5,low,900,10
"""


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    (folder / "car.yaml").write_text(CAR)
    (folder / "duty.csv").write_text(DUTY)
    write(lambda x, y: {"low": x - 100 + 2 * y, "high": 3 * y})


def write(
    values: object, name: str = "map.csv", axes: str = "load.speed [rad/s],load.torque [kN*m]"
) -> None:
    """Write a sweep by gear over 100 to 300 rad/s and 0 to 200 N*m."""
    rows = [
        f"{number},{x},{y / 1000},ok,{gear},{value}"
        for number, (x, y) in enumerate(product(np.linspace(100, 300, 11), np.linspace(0, 200, 9)))
        for gear, value in values(x, y).items()  # type: ignore[operator]
    ]
    Path(name).write_text("\n".join([f"variant,{axes},status,gear,efficiency", *rows, ""]))


def drawn(*options: str, file: str = "map.csv") -> list[ET.Element]:
    """Draw a map and return the elements of the SVG."""
    assert vstatics("plot", file, "-k", "map", *options, "-o", "map.svg").status == 0
    return list(ET.parse("map.svg").getroot().iter())  # noqa: S314 - written by the program


def of_class(elements: list[ET.Element], kind: str) -> list[ET.Element]:
    return [element for element in elements if element.get("class") == kind]


def numbers(path: ET.Element) -> Floats:
    """The points of a path, of shape (points, 2)."""
    words = path.get("d", "").replace("M", " ").replace("L", " ").replace("z", " ").split()
    return np.array(list(map(float, words))).reshape(-1, 2)


def test_the_colour_bar_lists_the_levels() -> None:
    """Of 0 to 600: steps of 50 give 11 levels, the nearest to 10; a list is taken as it is."""
    tens = "50 100 150 200 250 300 350 400 450 500 550"
    for levels, listed in {"10": tens, "90,150.5": "90 150.5"}.items():
        [bar] = of_class(drawn("--levels", levels), "colorbar")
        assert bar.get("data-levels") == listed
    for levels, is_within in (("600,700", True), ("-1,600.1", False)):  # as matplotlib warns
        texts = ["".join(element.itertext()) for element in drawn("--levels", levels)]
        assert any("no level is between" in text for text in texts) is not is_within


def test_contours_have_the_decimals_of_the_colour_bar() -> None:
    """Each number appears in the panel of each of two gears, and once at the bar."""
    texts = [
        element.text for element in drawn("--levels", "90,150.5") if element.tag.endswith("text")
    ]
    assert [texts.count(number) for number in ("90.0", "150.5", "90")] == [3, 3, 0]


@needs("vehicle")
def test_full_load_and_operating_points_are_at_their_numbers() -> None:
    """The straight full load from 150 N*m at 200 rad/s to 120 N*m at 300 rad/s."""
    elements = drawn("--best-gear", "--duty", "duty.csv", "--limits", "car.yaml")
    points = of_class(elements, "operating-point")
    told = [[p.get(f"data-{key}") for key in ("x", "y", "gear")] for p in points]
    assert told == [["150", "0.06", "low"], ["250", "0.1", "high"]]
    [curve] = of_class(elements, "limit")
    place = numbers(curve)
    assert place[-1, 0] == place[-2, 0]  # at the largest speed it falls to 0
    marks = [
        float(circle.get(key, ""))
        for p in points
        for circle in p.iter("{http://www.w3.org/2000/svg}circle")
        for key in ("cx", "cy")
    ]
    (x1, y1), (x2, y2) = np.array(marks).reshape(-1, 2)
    expected = [x1 + 50 * (x2 - x1) / 100, y1 + 90 * (y2 - y1) / 40]  # 200 rad/s, 150 N*m
    np.testing.assert_allclose(place[2], expected, atol=0.02)
    panels = drawn("--duty", "duty.csv")  # a panel for each gear, with the points of this gear
    assert len(of_class(panels, "operating-point")) == 2


def test_regions_of_planes_meet_where_the_planes_do() -> None:
    """``x - 100 + 2 y = 3 y`` where y = x - 100: from the lower left corner to the upper right."""
    regions = {g.get("data-gear"): g for g in of_class(drawn("--best-gear"), "gear")}
    assert set(regions) == {"low", "high"}
    for region in regions.values():
        border = next(p for p in region.iter() if p.get("fill") == "none")
        points = numbers(border)
        (left, low), (right, up) = points.min(axis=0), points.max(axis=0)
        share = (points - (left, low)) / (right - left, up - low)
        np.testing.assert_allclose(share.sum(axis=1), 1, atol=1e-3)  # ordinates of SVG run down


@examples(15, 60, 600)
def test_random_planes_have_the_region_of_the_largest(examples: int) -> None:
    """At nodes, the leader is that of NumPy's argmax over the planes; a circle has its area."""
    chance = generator(51)
    x, y = np.linspace(0, 1, 9), np.linspace(0, 2, 7)
    for _ in range(examples):
        count = int(chance.integers(2, 7))
        a, b, c = chance.normal(size=(3, count, 1, 1))
        xs, ys, fine = refined(x, y, a * x + b * y[:, None] + c)
        exact = a * xs + b * ys[:, None] + c
        np.testing.assert_allclose(fine, exact, atol=1e-12)
        leads = {r.gear: r.lead for r in gear_regions([str(g) for g in range(count)], fine)}
        best = exact.argmax(axis=0)
        gap = np.diff(np.sort(exact, axis=0)[-2:], axis=0)[0]
        for gear, lead in leads.items():
            is_best = best == int(gear)
            np.testing.assert_allclose(np.abs(lead[is_best]), gap[is_best], atol=1e-7)
        assert {str(g) for g in np.unique(best[gap > 1e-6])} <= set(leads)
    side = np.linspace(-1, 1, 401)
    dome = 1 - side**2 - side[:, None] ** 2
    [inner, _] = gear_regions(["a", "b"], np.array([dome, np.full_like(dome, 0.5)]))
    assert (inner.lead > 0).mean() * 4 == pytest.approx(np.pi / 2, rel=0.005)  # radius^2 = 0.5


def test_a_gear_without_a_value_leaves_the_region_to_others() -> None:
    values = np.array([[[2.0, np.nan, np.nan]], [[1.0, 1.0, np.nan]]])
    first, second = gear_regions(["1", "2"], values)
    assert [first.lead[0, 0] > 0, first.lead[0, 1] < 0] == [True, True]
    assert second.lead[0, 1] > 0
    assert np.isnan([first.lead[0, 2], second.lead[0, 2]]).all()


@needs("vehicle")
def test_a_gear_of_a_column_can_have_a_name_in_quotes() -> None:
    text = Path("map.csv").read_text().replace("efficiency", '"speeds[in,""a,b""]"')
    rows = [line.replace(",low,", ",") for line in text.splitlines() if ",high," not in line]
    Path("column.csv").write_text("\n".join(rows).replace("status,gear,", "status,"))
    Path("duty.csv").write_text(DUTY.replace("high", '"a,b"'))
    points = of_class(drawn("--duty", "duty.csv", file="column.csv"), "operating-point")
    assert [p.get("data-gear") for p in points] == ["a,b"]


def test_equal_gears_with_long_names_have_a_readable_map() -> None:
    """Of equal gears the first is best; a long name is broken into lines, or only in the key."""
    name = "a name that is as long as the page of this picture is wide " * 2
    write(lambda *_: {name.strip(): 0.9, "high": 0.9})
    for options in (("--best-gear",), ("--z", "efficiency", "--width", "80mm")):
        elements = drawn(*options)
        assert {g.get("data-gear") for g in of_class(elements, "gear")} <= {name.strip()}
        texts = [text for text in map(str, (e.text for e in elements)) if "as long" in text]
        assert texts
        assert max(map(len, texts)) < len(name) - 10
    titles = ["".join(e.itertext()) for e in elements if e.tag.endswith("text")]
    assert any("efficiency = 0.900" in title for title in titles)


@needs("vehicle")
def test_panels_of_a_narrow_map_stand_below_each_other() -> None:
    """The full load from 100 to 300 rad/s is as wide as a panel."""
    limits = of_class(drawn("--limits", "car.yaml", "--width", "85mm"), "limit")
    assert [np.ptp(numbers(limit)[:, 0]) > 90 for limit in limits] == [True, True]


def test_wrong_options_of_maps_are_reported(folder: Path) -> None:
    write(lambda x, y: {"low": x + y}, "others.csv", "a,b")
    write(lambda x, y: {"low": x if y == 100 else ""}, "line.csv")
    (folder / "plain.yaml").write_text(CAR.partition("vehicle")[0])
    (folder / "hole.csv").write_text("time [s],gear,speed [rpm],torque [N*m]\n1,low,x,1\n")
    (folder / "back.csv").write_text(DUTY.replace("5,low,150", "-1,low,150"))
    text = Path("map.csv").read_text()
    one = [line.replace(",low", "") for line in text.splitlines() if ",high," not in line]
    Path("one.csv").write_text("\n".join(one).replace("status,gear,", "status,"))
    for options, words in (
        (("map.csv", "--levels", "0"), "read 0, expected 1 to 100"),
        (("map.csv", "--levels", "2,1"), "levels in ascending order"),
        (("map.csv", "--levels", "x"), "read 'x', expected a number of levels"),
        (("map.csv", "--best-gear", "--levels", "3"), "with --best-gear has no levels"),
        (("others.csv", "--duty", "duty.csv"), "expected load.speed and load.torque"),
        (("others.csv", "--limits", "car.yaml"), "expected load.speed and load.torque"),
        (("map.csv", "--limits", "plain.yaml"), "plain.yaml: error: the case has no `vehicle`"),
        (("map.csv", "--duty", "hole.csv"), "hole.csv:2:1: error"),
        (("map.csv", "--duty", "back.csv"), "back.csv:2:1: error: time: read -1, expected 0"),
        (("map.csv", "--duty", "car.yaml"), "expected a CSV of points"),
        (("line.csv",), "the rows with efficiency span no area"),
        (("one.csv", "--best-gear"), "expected a sweep written with --by gear"),
    ):
        said = vstatics("plot", options[0], "-k", "map", *options[1:], "-o", "no.svg")
        assert said.status in (1, 2), options
        assert words in said.err, (options, said.err)
    asked = ("plot", "map.csv", "-k", "curves", "--x", "load.speed [rad/s]", "-o", "no.svg")
    assert vstatics(*asked, "--best-gear").is_wrong_use("only map shows the best gear")
    assert not (folder / "no.svg").exists()


def test_python_draws_the_same_map() -> None:
    grid = {"D.ratio": "-4:-2:5", "D.efficiency": "0.9,0.95,1"}
    swept = sweep(DIFFERENTIAL, grid, by="gear")
    regions = swept.plot("map", best_gear=True)._repr_svg_()
    assert 'data-gear="direct"' in regions
    levels = swept.plot("map", z="efficiency", levels=[0.93, 0.96])._repr_svg_()
    assert 'data-levels="0.93 0.96"' in levels
    with pytest.raises(ValueError, match="expected 1 to 100"):
        swept.plot("map", levels=0)
    with pytest.raises(ValueError, match="only map shows the best gear"):
        swept.plot("histogram", best_gear=True)
