"""The runs of two scenarios on one page: numbers are those that `vstatics simulate` answers."""

from pathlib import Path

import numpy as np
import pytest

from tests.commands import CASES, json_answer, vstatics
from tests.page.report.pages import Page
from tests.simulation.pictures.test_shift import LOCK, run
from vstatics.page.report.pair.merged import merged
from vstatics.simulation.pictures.line_panel import range_of
from vstatics.simulation.pictures.lines import MotionLine, MotionPanel
from vstatics.simulation.report.pair import run_grids

SCENARIO = CASES / "scenarios" / "tarasik-set-upshift.yaml"


def test_an_event_goes_by_what_happens_whenever_it_is() -> None:
    first = run()
    [locks] = first.events
    later = first._replace(events=(locks._replace(time=LOCK / 2), locks._replace(time=0.9)))
    [events, *_] = run_grids([first, later])
    times = [[row[1].value for row in grid.cells] for grid in events if grid]
    assert times == [[LOCK], [LOCK / 2, 0.9]]
    rows = merged([grid for grid in events if grid], "AB").texts
    common = [["brake locks", "A"], ["brake locks", "B"], ["change", ""]]
    assert [row[:2] for row in rows] == [*common, ["brake locks", "B"], ["not in A", ""]]


def test_energies_are_in_one_unit_and_without_a_run_there_are_none() -> None:
    small, large = run(), run()
    heat = dict.fromkeys(large.energy.heat, 100000.0)
    large = large._replace(energy=large.energy._replace(heat=heat))
    by_key = {next(grid.key for grid in pair if grid): pair for pair in run_grids([small, large])}
    assert {grid.columns[1].heading for grid in by_key["energy"] if grid} == {"energy [J]"}
    one, other = next(run_grids([None, small]))
    assert one is None
    assert other is not None
    assert list(run_grids([None, None])) == []


def test_panels_of_both_have_one_scale_whatever_their_links_are_called() -> None:
    """Of lines twice as large: by the names of the lines, else by which panel of a kind it is."""
    small = MotionPanel("torque", "torque", 1.0, (MotionLine(("a",), np.array([0.0, 3.0])),))
    for name in ("a", "other"):
        line = MotionLine((name,), np.array([-1.0, 6.0]))
        large = MotionPanel("torque", "torque", 1.0, (line,))
        slip = large._replace(kind="slip")
        both = small.with_scale_of([large, slip]), large.with_scale_of([small])
        assert range_of(both[0]) == range_of(both[1]) == range_of(large)
        assert range_of(small.with_scale_of([slip])) == range_of(small)


@pytest.mark.slow
def test_the_page_has_both_runs(tmp_path: Path) -> None:
    other, made = tmp_path / "firmer.yaml", tmp_path / "both.html"
    text = SCENARIO.read_text("utf-8").replace("[[0, 300]]", "[[0, 330]]")
    other.write_text(text.replace("case: ..", f"case: {CASES}"), "utf-8")
    assert vstatics("report", SCENARIO, other, "-o", made).status == 0
    page = Page(made.read_text("utf-8"))
    for label, file in (("A", SCENARIO), ("B", other)):
        told = json_answer("simulate", file)
        cells = [one.attributes for one in page.all("td")]
        cells = [one for one in cells if one.get("data-case") == label and "data-number" in one]
        shown = {float(one["data-number"] or "nan") for one in cells}
        wanted = [told["events"][0]["time"], *told["energy"]["heat"].values()]
        for number in filter(None, wanted):
            assert any(abs(one - number) < 1e-9 * number for one in shown), number
    assert sum("over time" in one.text for one in page.all("figcaption")) == 2
    assert not any("axes of time differ" in one.text for one in page.all("p"))
