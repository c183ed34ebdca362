"""Pictures of sweeps: which columns they show, where contours run, where operation ends."""

from collections.abc import Iterable, Mapping
from itertools import product
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from matplotlib.figure import Figure

from tests.chance import generator
from tests.commands import CASES, vstatics
from tests.pictures.drawn import texts, titled
from tests.sweep.sweeps import DIFFERENTIAL
from vstatics import CaseError, save, sweep
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers import sweep_tables
from vstatics.core.tables.written_results import WrittenSweep
from vstatics.pictures.drawing.files import figures_of
from vstatics.pictures.drawing.style import PAGE_HEIGHT, Style
from vstatics.sweep.pictures import columns, curves, histogram, map_sheet
from vstatics.sweep.pictures import map as map_
from vstatics.sweep.pictures.columns import DrawnColumns
from vstatics.sweep.pictures.plotting import plot_sweep

GRID = ["D.ratio=-4:-2:5", "D.efficiency=.9,.95,1"]
OUT = "ratio[low],efficiency[low]"


def sweep_of(columns: Mapping[str, Iterable[float]], *varied: str) -> WrittenSweep:
    """A sweep with these columns, all of whose variants have a solution."""
    numbers = {name: [*map(float, column)] for name, column in columns.items()}
    rows = len(numbers[varied[0]])
    return WrittenSweep(list(range(rows)), ["ok"] * rows, numbers, varied)


def read(head: str, rows: Iterable[object]) -> WrittenSweep:
    return sweep_tables.read("\n".join([head, *map(str, rows), ""]).encode(), "s.csv")


def saddle(where: float = np.inf) -> WrittenSweep:
    """``z = x y`` over a grid, without the rows where it is above a number."""
    xs, ys = (one.ravel() for one in np.meshgrid(np.linspace(1, 4, 31), np.linspace(1, 4, 31)))
    z = xs * ys
    kept = z <= where
    return sweep_of({"x": xs[kept], "y": ys[kept], "z": z[kept]}, "x", "y")


def drawn(kind: Any, sweep: WrittenSweep, **asked: Any) -> Figure:
    [figure] = figures_of(kind.draw(sweep, Style(), DrawnColumns(**asked)))
    return figure


def lines(figure: Figure, title: str) -> list[Floats]:
    return [one.get_xydata() for said, one in titled(figure) if said == title]


def test_contours_run_where_the_number_is() -> None:
    """On the contour of 4 of ``x y`` the product is 4, to the chords of a grid of .1."""
    figure = drawn(map_, saddle())
    [line] = lines(figure, "4")
    left, low = map_sheet.MAP_SCALE_WIDTH, map_sheet.MAP_SCALE_HEIGHT
    x, y = ((line - (left, low)) / map_sheet.MAP_SIZE * 3 + 1).T
    np.testing.assert_allclose(x * y, 4, atol=0.01)
    assert "z: x, y" in texts(figure)
    assert "limit of operation" not in texts(figure)
    assert "limit of operation" in texts(drawn(map_, saddle(where=8.0)))  # no row is outside


def test_contours_are_even_and_each_has_its_number() -> None:
    """Of a ratio over teeth, most of whose values are small; a short one in a corner, too."""
    teeth = [(sun, ring) for sun in range(18, 37, 3) for ring in (66, 72, 78)]
    rows = (f"{at},{sun},{ring},ok,{1 + ring / sun}" for at, (sun, ring) in enumerate(teeth))
    figure = drawn(map_, read("variant,sun,ring,status,z", rows))
    levels = sorted({float(said) for said, _ in titled(figure)})
    np.testing.assert_allclose(np.diff(levels), 0.2)
    assert {f"{level:.1f}" for level in levels} <= {*texts(figure)}


def test_a_panel_without_a_number_says_why() -> None:
    rows = []
    for n, (x, y) in enumerate(product((1.0, 2.0), repeat=2)):
        rows += [f"{n},{x},{y},ok,low,{x * y}", f"{n},{x},{y},tied up,both,"]
    said = texts(drawn(map_, read("variant,x,y,status,gear,z", rows)))
    assert "no number: tied up" in said
    assert "limit of operation" not in said


def test_scattered_points_are_drawn_as_a_map() -> None:
    """The plane ``x + 2 y`` of random points: interpolation between three is exact."""
    points = np.random.default_rng(1).random((400, 2))
    x, y = points.T
    figure = drawn(map_, sweep_of({"x": x, "y": y, "z": x + 2 * y}, "x", "y"))
    longest = max(lines(figure, "1.5"), key=len)
    low, high = points.min(axis=0), points.max(axis=0)
    place = (longest - (map_sheet.MAP_SCALE_WIDTH, map_sheet.MAP_SCALE_HEIGHT)) / map_sheet.MAP_SIZE
    np.testing.assert_allclose((place * (high - low) + low) @ (1, 2), 1.5, atol=1e-9)


def test_curves_have_a_line_for_each_value_and_coinciding_ones_are_one() -> None:
    sweep = saddle()
    sweep.columns["double"] = [2 * x for x in sweep.columns["x"]]
    figure = drawn(curves, sweep, x="x")
    said = [title.rpartition(" ")[2] for title, _ in titled(figure)]
    assert (said.count("z"), said.count("double")) == (curves.MOST_CURVES, 1)
    assert "12 lines are drawn, of 31" in texts(figure)
    rows = ["0,1,ok,a,1", "0,1,ok,b,2", "1,2,ok,a,2", "1,2,ok,b,4"]  # a line for each gear
    by_gear = read("variant,x,status,gear,z", rows)
    assert (by_gear.varied, by_gear.gears) == (("x",), ["a", "b", "a", "b"])
    assert [said for said, _ in titled(drawn(curves, by_gear))] == ["a z", "b z"]


def test_a_number_that_follows_from_the_others_gives_no_lines() -> None:
    """Slip and its linked torque, or a grid with a linked number; in any order it would vary."""
    x, y = (array.ravel().tolist() for array in np.meshgrid([1, 2, 3], [5, 6]))
    linked = sweep_of({"x": [3, 2, 1], "t": [9, 4, 9], "z": [1, 2, 3]}, "x", "t")
    assert [title for title, _ in titled(drawn(curves, linked))] == ["z"]
    assert len(lines(drawn(curves, linked, x="x"), "z")[0]) == 3
    grid = sweep_of({"x": x, "y": y, "t": [3, 4, 4, 3, 5, 9], "z": range(6)}, "x", "y", "t")
    assert "z: x, y" in texts(drawn(map_, grid))
    said = [title for title, _ in titled(drawn(curves, grid, x="x"))]
    assert said == ["y = 5 z", "y = 6 z"]
    with pytest.raises(CaseError, match="varies x, t: expected --x"):
        drawn(curves, sweep_of({"x": [2, 3, 1], "t": [9, 4, 1], "z": [1, 2, 3]}, "x", "t"))


def test_a_column_can_be_named_without_its_unit() -> None:
    numbers = {"u [rpm]": [1, 2], "v [N*m]": [1, 4], "v [kW]": [3, 4], "v": [5, 6]}
    sweep = sweep_of(numbers, "u [rpm]")
    named = DrawnColumns("u", ("v", "w"), "u [rpm]")
    assert columns.with_units(sweep, named) == named._replace(x="u [rpm]")
    assert plot_sweep(sweep, x="u", y="v [kW]")._repr_svg_()


def test_what_cannot_be_drawn_is_reported(tmp_path: Path) -> None:
    without = sweep_of({"x": [np.nan], "z": [1.0]}, "x")
    wrong: list[tuple[object, WrittenSweep, dict[str, Any], str]] = [
        (map_, saddle(), {"z": "zz"}, r"no column `zz`; did you mean `z`\?"),
        (map_, saddle(), {"x": "z", "y": ["z"]}, "no column to draw"),
        (curves, without, {"x": "x"}, "no row of the sweep has x"),
        (curves, saddle(), {"x": "x", "by": "x"}, "as it also varies y: expected --by"),
        (curves, saddle(), {}, "varies x, y: expected --x"),
        (curves, sweep_of({"x": [1, 2], "z": [1, 1e301]}, "x"), {}, "`z` has a number above 1e"),
    ]
    for kind, one, options, words in wrong:
        with pytest.raises(CaseError, match=words):
            drawn(kind, one, **options)
    asked = ("plot", CASES / "simpson.yaml", "-o", tmp_path / "a.svg", "-k")
    assert vstatics(*asked, "map").fails("not a table of variants")
    assert vstatics(*asked, "plan", "--x", "a").is_wrong_use("only map, curves and histogram")
    written = tmp_path / "none.csv"
    empty = ("--vary", "D1.ratio=-0.9:-0.7:3", "--where", "ratio[1]>1e9", "-o", written)
    assert vstatics("sweep", CASES / "mzkt7922.dat", *empty).status == 0
    for name in ("map", "curves", "histogram"):
        said = vstatics("plot", written, "-k", name, "-o", tmp_path / "a.svg")
        assert said.fails("none.csv: error: the sweep has no row")
    assert not (tmp_path / "a.svg").exists()


def test_histograms_count_the_numbers_of_the_file(tmp_path: Path) -> None:
    """Bars have the counts of NumPy over the same edges; all numbers fall into one."""
    chance = generator(7)
    drawn_numbers = {"u": chance.normal(3, 0.5, 400), "heat[C1]": chance.exponential(2, 400)}
    missing = chance.random(400) < 0.1
    columns = [one.tolist() for one in drawn_numbers.values()]
    table = zip(*columns, missing.tolist(), strict=True)
    rows = [
        f"{n},{u!r},{'stopped' if gone else 'ok'},{'' if gone else repr(heat)}"
        for n, (u, heat, gone) in enumerate(table)
    ]
    file, to = tmp_path / "runs.csv", tmp_path / "runs.svg"
    file.write_text("\n".join(["variant,u,status,heat[C1]", *rows, ""]))
    assert vstatics("plot", str(file), "-k", "histogram", "-o", str(to)).status == 0
    panels = [one for one in ET.parse(to).iter() if one.get("class") == "panel"]  # noqa: S314 - our own
    assert [one.get("data-name") for one in panels] == ["heat[C1]", "u"]
    for panel in panels:
        values = drawn_numbers[str(panel.get("data-name"))]
        values = values[~missing] if panel.get("data-name") != "u" else values
        bars = [one.attrib for one in panel.iter() if one.get("class") == "bar"]
        edges = [float(one["data-from"]) for one in bars] + [float(bars[-1]["data-to"])]
        np.testing.assert_allclose([edges[0], edges[-1]], [values.min(), values.max()], rtol=1e-8)
        edges[0], edges[-1] = -np.inf, np.inf
        counts, _ = np.histogram(values, edges)
        assert [int(one["data-count"]) for one in bars] == counts.tolist()


def test_bars_of_a_histogram_are_as_high_as_their_counts() -> None:
    figure = drawn(histogram, sweep_of({"x": [0] * 6 + [1] * 3}, "x"))
    bars: list[Any] = [one for one in figure.artists if '"bar"' in str(one.get_gid())]
    heights = [one.get_path().get_extents().height for one in bars]
    assert heights[0] == pytest.approx(2 * heights[-1])


def test_samples_become_histograms_of_what_differs(tmp_path: Path) -> None:
    scenario = CASES / "scenarios/moskvich-samples.yaml"
    runs, to = tmp_path / "runs.npz", tmp_path / "runs.svg"
    made = vstatics("simulate", str(scenario), "--samples", "4", "-q", "-o", str(runs))
    assert made.status == 0
    assert vstatics("plot", str(runs), "-k", "histogram", "-o", str(to)).status == 0
    read = sweep_tables.read(runs.read_bytes(), "runs.npz")
    names = [
        one.get("data-name")
        for page in tmp_path.glob("runs*.svg")
        for one in ET.parse(page).iter()  # noqa: S314 - our own
        if one.get("class") == "panel"
    ]
    assert set(read.varied) <= set(names)
    assert "work" not in names  # 0 in all runs
    ran = vstatics("plot", str(runs), "-k", "histogram", "--x", "work", "-o", str(to))
    assert ran.is_wrong_use("columns of --y")


def test_panels_go_on_on_further_pages_of_a_width() -> None:
    gears = [f"gear {n}" for n in range(1, 10)]
    rows = [
        f"{n},{x},{y},ok,{gear},{x * y}"
        for n, (x, y) in enumerate(product((1.0, 2.0), repeat=2))
        for gear in gears
    ]
    columns = sweep_of({"x": [1, 2], **{gear: [1, 2] for gear in gears}}, "x")
    style = Style(height=PAGE_HEIGHT)
    maps = map_.draw(read("variant,x,y,status,gear,z", rows), style, DrawnColumns())
    panels = curves.draw(columns, style, DrawnColumns(y=gears))
    for figures in (maps, panels):
        said = [one for figure in figures for one in texts(figure)]
        assert sorted(one for one in said if one in gears) == gears
        assert len(figures) > 1
        for figure in figures:
            wide, high = figure.size
            assert wide <= style.width
            assert high <= style.height


def test_a_gear_number_is_a_whole_number_all_the_way() -> None:
    """Of steps of a driving cycle: between first gear and fourth nothing is in second or third."""
    sweep = sweep_of({"time [s]": [5, 15, 30], "gear number": [1, 4, 4]}, "time [s]")
    [line] = lines(drawn(curves, sweep), "gear number")
    assert len({round(y, 3) for _, y in line}) == 2
    two = sweep_of({"time [s]": [5, 15], "gear number": [1, 2]}, "time [s]")
    assert "1.5" not in texts(drawn(curves, two))
    for name, shown in (("2L", "2L"), ("crawler of the low range", "2")):
        drawn_texts = texts(drawn(curves, two._replace(gear_names={1.0: "1L", 2.0: name})))
        assert shown in drawn_texts


@pytest.mark.usefixtures("folder")
def test_a_picture_from_python_is_that_of_the_command() -> None:
    """To the byte, from what the command has written."""
    vary = [part for number in GRID for part in ("--vary", number)]
    save(DIFFERENTIAL, "box.yaml")
    assert vstatics("sweep", "box.yaml", *vary, "--out", OUT, "-o", "own.csv").status == 0
    for kind, named in {
        "map": {"z": "efficiency[low]"},
        "curves": {"x": "D.ratio", "y": "efficiency[low]", "by": "D.efficiency"},
        "histogram": {"y": "ratio[low]"},
    }.items():
        asked = [part for name, column in named.items() for part in (f"--{name}", column)]
        assert vstatics("plot", "own.csv", "-k", kind, *asked, "-o", "told.svg").status == 0
        picture = sweep(DIFFERENTIAL, GRID, out=OUT).plot(kind, **named)
        picture.save("own.svg")
        assert Path("own.svg").read_bytes() == Path("told.svg").read_bytes()
        assert picture._repr_svg_().startswith("<?xml")
        assert picture.figure.axes or picture.figure.texts
        assert repr(picture) == f"<SweepPicture {kind} of 15 rows>"


def test_another_kind_and_another_column_are_reported() -> None:
    with pytest.raises(ValueError, match="no picture 'mpa' of a sweep; did you mean `map`"):
        sweep(DIFFERENTIAL, GRID, out=OUT).plot("mpa")
    with pytest.raises(CaseError, match=r"no column `efficiency\[1\]`"):
        sweep(DIFFERENTIAL, GRID, out=OUT).plot("map", z="efficiency[1]")._repr_svg_()
