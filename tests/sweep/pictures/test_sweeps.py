"""Pictures of sweeps: which columns they show, where contours run, where operation ends."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from tests.chance import generator
from tests.commands import CASES, vstatics
from tests.pictures.drawn import texts, titled
from vstatics.core.errors import CaseError
from vstatics.core.readers import sweep_tables
from vstatics.core.tables.written_results import WrittenSweep
from vstatics.pictures.drawing.files import settings_of
from vstatics.pictures.drawing.style import PAGE_HEIGHT, Style
from vstatics.sweep.pictures import curves, histogram, map  # noqa: A004
from vstatics.sweep.pictures.columns import DrawnColumns

CASE = """
links: [in, out, c]
input: in
output: c
mechanisms:
  set: {first: in, second: out, third: c, ratio: -2.5, efficiency: .96}
shift_elements: {B: [out, housing], C: [in, out]}
gears: {low: [B], high: [C]}
"""


def saddle(where: float = np.inf) -> WrittenSweep:
    """``z = x y`` over a grid, without the rows where it is above a number."""
    xs, ys = np.meshgrid(np.linspace(1, 4, 31), np.linspace(1, 4, 31))
    z = xs * ys
    kept = z <= where
    columns = {"x": xs[kept].tolist(), "y": ys[kept].tolist(), "z": z[kept].tolist()}
    rows = int(kept.sum())
    return WrittenSweep(list(range(rows)), ["ok"] * rows, columns, ("x", "y"))


def drawn(kind: object, sweep: WrittenSweep, **asked: object) -> object:
    style = Style()
    with settings_of(style):
        [figure] = kind.draw(sweep, style, DrawnColumns(**asked))  # type: ignore[attr-defined, arg-type]
    return figure


def lines(figure: object, title: str) -> list[np.ndarray]:
    """The lines of a title, by places in the figure [pt]."""
    return [one.get_xydata() for said, one in titled(figure) if said == title]  # type: ignore[arg-type]


def test_contours_run_where_the_number_is() -> None:
    """On the contour of 4 of ``x y`` the product is 4, to the chords of a grid of .1."""
    figure = drawn(map, saddle())
    [line] = lines(figure, "4")
    left, low = map.MAP_SCALE_WIDTH, map.MAP_SCALE_HEIGHT
    x, y = ((line - (left, low)) / map.MAP_SIZE * 3 + 1).T
    np.testing.assert_allclose(x * y, 4, atol=0.01)
    assert "z: x, y" in texts(figure)  # type: ignore[arg-type]


def test_contours_are_even_and_each_has_its_number() -> None:
    """Of a ratio over teeth, most of whose values are small; a short one in a corner, too."""
    teeth = [(sun, ring) for sun in range(18, 37, 3) for ring in (66, 72, 78)]
    rows = (f"{at},{sun},{ring},ok,{1 + ring / sun}\n" for at, (sun, ring) in enumerate(teeth))
    text = "variant,sun,ring,status,z\n" + "".join(rows)
    figure = drawn(map, sweep_tables.read(text.encode(), "s.csv"))
    levels = sorted({float(said) for said, _ in titled(figure)})  # type: ignore[arg-type]
    np.testing.assert_allclose(np.diff(levels), 0.2)
    assert {f"{level:g}" for level in levels} <= {*texts(figure)}  # type: ignore[arg-type]


def test_where_operation_ends_is_marked() -> None:
    """Outside 8 of ``x y`` there is no row."""
    figure = drawn(map, saddle(where=8.0))
    assert "limit of operation" in texts(figure)  # type: ignore[arg-type]
    assert "limit of operation" not in texts(drawn(map, saddle()))  # type: ignore[arg-type]


def test_a_panel_without_a_number_says_why() -> None:
    """Of two gears one is tied up everywhere; nowhere is a limit of operation."""
    rows = [(x, y, gear) for x in (1.0, 2.0) for y in (1.0, 2.0) for gear in ("low", "both")]
    text = "variant,x,y,status,gear,z\n" + "".join(
        f"{n // 2},{x},{y},ok,{gear},{x * y}\n"
        if gear == "low"
        else f"{n // 2},{x},{y},tied up,{gear},\n"
        for n, (x, y, gear) in enumerate(rows)
    )
    said = texts(drawn(map, sweep_tables.read(text.encode(), "s.csv")))  # type: ignore[arg-type]
    assert "no number: tied up" in said
    assert "limit of operation" not in said


def test_scattered_points_are_drawn_as_a_map() -> None:
    """The plane ``x + 2 y`` of random points: interpolation between three is exact."""
    points = np.random.default_rng(1).random((400, 2))
    z = points @ (1, 2)
    columns = {"x": points[:, 0].tolist(), "y": points[:, 1].tolist(), "z": z.tolist()}
    sweep = WrittenSweep(list(range(400)), ["ok"] * 400, columns, ("x", "y"))
    figure = drawn(map, sweep)
    longest = max(lines(figure, "1.5"), key=len)
    low, high = points.min(axis=0), points.max(axis=0)
    place = (longest - (map.MAP_SCALE_WIDTH, map.MAP_SCALE_HEIGHT)) / map.MAP_SIZE
    np.testing.assert_allclose((place * (high - low) + low) @ (1, 2), 1.5, atol=1e-9)


def test_curves_have_a_line_for_each_value_and_coinciding_ones_are_one() -> None:
    sweep = saddle()
    sweep.columns["double"] = [2 * x for x in sweep.columns["x"]]
    figure = drawn(curves, sweep, x="x")
    assert len([said for said, _ in titled(figure) if said.endswith(" z")]) == curves.MOST_CURVES  # type: ignore[arg-type]
    assert len([said for said, _ in titled(figure) if said.endswith(" double")]) == 1  # type: ignore[arg-type]
    assert "12 lines are drawn, of 31" in texts(figure)  # type: ignore[arg-type]


def test_a_row_for_each_gear_gives_a_panel_or_a_line_for_each() -> None:
    rows = [
        (n, x, gear, x * k) for n, x in enumerate((1.0, 2.0)) for k, gear in ((1, "a"), (2, "b"))
    ]
    text = "variant,x,status,gear,z\n" + "".join(f"{n},{x},ok,{g},{z}\n" for n, x, g, z in rows)
    sweep = sweep_tables.read(text.encode(), "s.csv")
    assert (sweep.varied, sweep.gears) == (("x",), ["a", "b", "a", "b"])
    assert [said for said, _ in titled(drawn(curves, sweep))] == ["a z", "b z"]  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"z": "zz"}, "no column `zz`; did you mean `z`?"),
        ({"x": "z", "y": ["z"]}, "no column to draw"),
    ],
)
def test_what_cannot_be_drawn_is_told(asked: dict[str, object], said: str) -> None:
    with pytest.raises(CaseError, match=said.replace("?", r"\?")):
        drawn(map, saddle(), **asked)


def test_curves_over_a_column_without_numbers_are_refused() -> None:
    sweep = WrittenSweep([1], ["ok"], {"x": [np.nan], "z": [1.0]}, ("x",))
    with pytest.raises(CaseError, match="no row of the sweep has x"):
        drawn(curves, sweep, x="x")


def test_several_rows_at_a_place_are_told() -> None:
    with pytest.raises(CaseError, match="as it also varies y: expected --by"):
        drawn(curves, saddle(), x="x", by="x")
    with pytest.raises(CaseError, match="varies x, y: expected --x"):
        drawn(curves, saddle())


def test_a_sweep_becomes_a_picture(tmp_path: Path) -> None:
    (tmp_path / "box.yaml").write_text(CASE)
    vary = "--vary", "set.ratio=-4:-1.5:9", "--vary", "set.efficiency=.9:.98:5"
    for name in ("s.csv", "s.npz"):
        file = str(tmp_path / name)
        out = "--out", "efficiency[low]", "-o", file
        assert vstatics("sweep", str(tmp_path / "box.yaml"), *vary, *out).status == 0
        picture = tmp_path / f"{name}.svg"
        assert vstatics("plot", file, "-k", "map", "-o", str(picture)).status == 0
        assert b"set.efficiency" in picture.read_bytes()


def test_wrong_use(tmp_path: Path) -> None:
    (tmp_path / "box.yaml").write_text(CASE)
    case, to = str(tmp_path / "box.yaml"), str(tmp_path / "a.svg")
    ran = vstatics("plot", case, "-k", "map", "-o", to)
    assert ran.fails("not a table of variants")
    ran = vstatics("plot", case, "-k", "plan", "--x", "a", "-o", to)
    assert ran.is_wrong_use("only map, curves and histogram")
    assert not Path(to).exists()


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


def test_a_histogram_is_as_high_as_its_count() -> None:
    columns = {"x": [0.0] * 6 + [1.0] * 3}
    figure = drawn(histogram, WrittenSweep([*range(9)], ["ok"] * 9, columns, ("x",)))
    bars = [
        one.get_path().get_extents()
        for one in figure.artists  # type: ignore[attr-defined]
        if '"bar"' in str(one.get_gid())
    ]
    heights = [one.height for one in bars]
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
    """Nine gears, of which each has a map; nine columns, of which each has a panel of curves."""
    gears = [f"gear {n}" for n in range(1, 10)]
    rows = [(x, y, gear) for x in (1.0, 2.0) for y in (1.0, 2.0) for gear in gears]
    text = "variant,x,y,status,gear,z\n" + "".join(
        f"{n // 9},{x},{y},ok,{gear},{x * y}\n" for n, (x, y, gear) in enumerate(rows)
    )
    columns = {"x": [1.0, 2.0], **{gear: [1.0, 2.0] for gear in gears}}
    asked = DrawnColumns(y=gears)
    style = Style(height=PAGE_HEIGHT)
    with settings_of(style):
        maps = map.draw(sweep_tables.read(text.encode(), "s.csv"), style, DrawnColumns())
        lines = curves.draw(WrittenSweep([0, 1], ["ok"] * 2, columns, ("x",)), style, asked)
    for figures in (maps, lines):
        said = [one for figure in figures for one in texts(figure)]
        assert sorted(one for one in said if one in gears) == gears
        assert len(figures) > 1
        for figure in figures:
            wide, high = 72 * figure.get_size_inches()
            assert wide <= style.width
            assert high <= style.height


@pytest.mark.parametrize("kind", ["map", "curves", "histogram"])
def test_a_sweep_of_which_nothing_is_left_says_so(kind: str, tmp_path: Path) -> None:
    written = tmp_path / "none.csv"
    asked = ("--vary", "D1.ratio=-0.9:-0.7:3", "--where", "ratio[1]>1e9", "-o", written)
    assert vstatics("sweep", CASES / "mzkt7922.dat", *asked).status == 0
    said = vstatics("plot", written, "--kind", kind, "-o", tmp_path / "none.svg")
    assert said.fails("none.csv: error: the sweep has no row")


def test_a_gear_number_is_a_whole_number_all_the_way() -> None:
    """Of steps of a driving cycle: between first gear and fourth nothing is in second or third."""
    columns = {"time [s]": [5.0, 15.0, 30.0], "gear number": [1.0, 4.0, 4.0]}
    sweep = WrittenSweep([0, 1, 2], ["ok"] * 3, columns, ("time [s]",))
    [line] = lines(drawn(curves, sweep), "gear number")
    assert len({round(y, 3) for _, y in line}) == 2
