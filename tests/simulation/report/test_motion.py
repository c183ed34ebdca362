"""The section of the report on a run: its tables and pictures, and why it stopped.

The run is that of `tests.simulation.pictures.test_shift`, in closed form.
"""

from pathlib import Path

import pytest

from tests.commands import CASES, vstatics
from tests.page.report.pages import Page, value
from tests.shipped import shipped_results
from tests.simulation.pictures.test_shift import LOCK, run
from vstatics import Message, Problem, load, write_report
from vstatics.core.tables.grid import Column, Grid, Row, exact, text
from vstatics.page.report.html_page import page
from vstatics.page.report.material import Naming, gather
from vstatics.simulation.report.motion import RunSection, in_figures

SCENARIO = CASES / "scenarios" / "tarasik-set-lock.yaml"


def test_a_run_has_its_events_energy_and_torques() -> None:
    shown = Page("".join(RunSection(run()).shown(None)))
    assert list(shown.table("Events")) == [f"{LOCK:.4f}"]
    assert value(shown.table("Energy")["brake"]["energy [J]"]) == 858.815102
    assert value(shown.table("Largest torques")["brake"]["torque [N*m]"]) == -120.0


def test_large_energies_are_in_kj_and_what_does_not_exist_stays_so() -> None:
    rows: list[Row] = [["work", exact(474894.33)], ["brake", exact(None)], ["elastic", exact(0.0)]]
    made = in_figures(Grid("Energy", [text(""), Column("energy [J]")], rows))
    assert [column.heading for column in made.columns] == ["part", "energy [kJ]"]
    assert made.texts == [["work", "474.894"], ["brake", "-"], ["elastic", "0.000"]]
    none = Grid("Events: none", [Column("time [s]")], [])
    assert in_figures(none) == none


def test_why_a_run_stopped_is_shown_with_its_messages() -> None:
    motion = run()._replace(
        stopped=Problem("E608", "stopped at <b>3 s\x1b"), messages=(Message("N601", "a & b"),)
    )
    text = "".join(RunSection(motion).shown(None))
    assert "The run stopped: stopped at &lt;b&gt;3 s\\u001b [E608]" in text
    assert "note: a &amp; b [N601]" in text


@pytest.mark.usefixtures("without_pictures")
def test_a_case_alone_has_no_run(tmp_path: Path) -> None:
    results = shipped_results("tarasik-set.yaml")
    write_report(results, tmp_path / "case.html")
    assert "<h2>Run</h2>" not in (tmp_path / "case.html").read_text("utf-8")


@pytest.mark.slow
def test_a_page_of_a_run_has_both_pictures() -> None:
    text = page(gather(shipped_results("tarasik-set.yaml"), motion=run()))
    section = text.partition("<h2>Run</h2>")[2].partition("<h2>")[0]
    assert section.count("<svg") == 2
    names = [name.partition("<")[0] for name in section.split("<figcaption>")[1:]]
    assert names == ["Run over time", "Run in the kinematic plan"]
    ids = [part.partition('"')[0] for part in text.split(' id="')[1:]]
    assert len(ids) == len(set(ids))


@pytest.mark.usefixtures("without_pictures")
def test_what_a_scenario_says_of_itself_stands_at_the_top() -> None:
    material = gather(
        shipped_results("tarasik-set.yaml"), motion=run(), naming=Naming("Lock <up>", "To 2 & back")
    )
    shown = Page(page(material))
    assert shown.all("title")[0].text == f"Lock <up>, {material.results.case.name}"
    [told] = [one for one in shown.all("p") if "To 2 & back" in one.text]
    assert "header" in told.inside
    assert [one.text for one in shown.all("a") if one.attributes["href"] == "#run"] == ["Run"] * 2


@pytest.mark.slow
def test_commands_take_a_scenario_for_its_case(tmp_path: Path) -> None:
    said = vstatics("report", SCENARIO, "-o", tmp_path / "run.html")
    assert said.is_silent()
    shown = Page((tmp_path / "run.html").read_text("utf-8"))
    assert [row["event"].text for row in shown.table("Events").values()] == ["locks"]
    case = load(CASES / "tarasik-set.yaml").name
    assert [shown.all(name)[0].text for name in ("title", "h1")] == [f"{SCENARIO.stem}, {case}"] * 2
    assert [one.text for one in shown.all("h2")][:2] == ["Overview", "Run"]
    for kind in ("shift", "plan", "lever"):
        said = vstatics("plot", SCENARIO, "--kind", kind, "-o", tmp_path / f"{kind}.png")
        assert said.is_silent()


@pytest.mark.usefixtures("folder")
def test_a_run_is_shown_though_its_gears_are_none() -> None:
    """A mass on a spring to the housing swings; in statics, which has no springs, it is tied up."""
    case = "links: [m, n]\ninertias: {m: 1, n: 1}\ngears: {g: []}\n"
    case += "springs: {k: {links: [m, housing], stiffness: 100}}\n"
    Path("mass.yaml").write_text(case, "utf-8")
    scenario = "{case: mass.yaml, duration: 2, start: {speeds: {m: 1, n: 0}}}"
    Path("swing.yaml").write_text(scenario, "utf-8")
    assert vstatics("simulate", "swing.yaml").status == 0
    for wanted in (("plot", "--kind", "shift", "-o", "a.svg"), ("report", "-o", "a.html")):
        said = vstatics(*wanted, "swing.yaml", "--strict")
        assert said.is_without_messages()
    assert Page(Path("a.html").read_text("utf-8")).table("Largest torques").keys() == {"k"}
    assert vstatics("plot", "--kind", "structure", "swing.yaml", "-o", "b.svg").status == 1


def test_other_commands_say_that_it_is_a_scenario() -> None:
    other = ["simulate", SCENARIO]
    for command in (["run"], ["flow"], ["summary"], ["convert", "--to", "yaml"], other):
        said = vstatics(*command, SCENARIO, *["x.yaml"] * (command[0] == "convert"))
        assert said.fails("error: this is a scenario, expected a case; simulate, plot")
        assert said.err.count("error:") == 1


def test_a_wrong_scenario_is_reported_at_its_place(tmp_path: Path) -> None:
    text, file = SCENARIO.read_text("utf-8"), tmp_path / "run.yaml"
    case = (CASES / "tarasik-set.yaml").as_posix()
    undetermined = text.replace("../tarasik-set.yaml", case).replace(", carrier: 0", "")
    for written, place in ((text, ":2:7: error: "), (undetermined, ":4:")):
        file.write_text(written, "utf-8")
        said = vstatics("plot", file, "--kind", "shift", "-o", tmp_path / "out.svg")
        assert (said.status, place in said.err) == (1, True), said.err
        assert not (tmp_path / "out.svg").exists()
    said = vstatics("plot", SCENARIO, "--kind", "shift", "--gear", "2", "-o", tmp_path / "a.svg")
    assert said.is_wrong_use("--gear: a run goes through all gears")
