"""`vstatics simulate` and `check` of a scenario: formats, files, messages, exit statuses.

The numbers are those of the facts about a single planetary set: its brake locks at 0.410054006 s.
"""

import csv
import io
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.chance import some
from tests.commands import CASES, json_answer, vstatics
from tests.core.cli.test_schemas import validator
from tests.installed import needs
from tests.processes import names
from vstatics import Problem, ReadError
from vstatics.simulation import load_scenario
from vstatics.simulation import run as module
from vstatics.simulation.scenario.file import load_scenario_file, read_scenario

CASE = """\
name: one set
inertias: {in: 0.5, ring: 0.7, "out, too": 0.8}
mechanisms: {set: {first: in, second: ring, third: "out, too", ratio: -1.5}}
shift_elements: {brake: [ring, housing], clutch: [in, ring]}
gears: {low: [brake]}
"""
SCENARIO = """\
case: box.yaml
duration: 1
start: {speeds: {in: 500 rpm, "out, too": 0}}
controls: {brake: 120}
torques: {in: 40, "out, too": -60}
"""
LOCKS = 0.410054006
WITH_GEAR = (
    "read `gear` together with `speeds` or `engaged`, expected one or the other: "
    "instead of `gear`, write `engaged: [brake]`"
)


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    (folder / "box.yaml").write_text(CASE, "utf-8")
    (folder / "lock.yaml").write_text(SCENARIO, "utf-8")


def document(*options: str) -> Any:
    said = vstatics("simulate", "lock.yaml", "-f", "json", *options)
    assert said.is_without_messages()
    found = said.json
    assert list(validator("simulation").iter_errors(found)) == []
    return found


def test_columns_that_are_asked_for_are_in_all_files_or_refused_at_once() -> None:
    out = 'accelerations[ring], heat[brake], powers["out, too"]'
    found = document("--out", out)
    assert [*found["accelerations"], *found["powers"]] == ["ring", "out, too"]
    assert found["heat"]["brake"][-1] == pytest.approx(found["energy"]["heat"]["brake"])
    said = vstatics("simulate", "lock.yaml", "-f", "csv", "--out", out)
    rows = list(csv.DictReader(io.StringIO(said.out)))
    for table, name in (("accelerations", "ring"), ("heat", "brake"), ("powers", '"out, too"')):
        column = found[table][name.strip('"')]
        assert [float(one[f"{table}[{name}]"]) for one in rows] == column
    vstatics("simulate", "lock.yaml", "-o", "out.npz", "--out", out)
    assert np.load("out.npz")["heat[brake]"].tolist() == found["heat"]["brake"]
    said = vstatics("simulate", "lock.yaml", "-f", "csv", "--out", "jerk[in], jerks[inn], work")
    assert said.gives_nothing(
        "--out:1:1: error: read `jerk[in]`, expected columns of accelerations",
        "--out:1:17: error: there is no link `inn`",
        "--out:1:23: error: read `work`",
    )


def test_json_has_all_of_it() -> None:
    found = document("--time-step", "0.25")
    parts = ["work", "heat", "losses", "kinetic", "elastic", "impact", "balance"]
    assert list(found["energy"]) == parts
    assert found["energy"]["heat"]["brake"] == pytest.approx(858.815102, abs=1e-5)
    [event] = found["events"]
    assert event.pop("time") == pytest.approx(LOCKS, abs=1e-8)
    assert event == {"element": "brake", "event": "locks", "energy": 0, "word": "locks"}
    assert {0.0, 0.25, 0.5, 0.75, 1.0} <= set(found["time"])
    assert (found["time"][-1], found["stopped"]) == (1.0, None)


@pytest.mark.parametrize("form", ["csv", "npz", "parquet"])
def test_columns_have_the_names_of_expressions(form: str) -> None:
    said = vstatics("simulate", "lock.yaml", "-o", f"out.{form}")
    assert said.is_silent()
    read: dict[str, Any]
    if form == "csv":
        rows = list(csv.reader(io.StringIO(Path("out.csv").read_text("utf-8"))))
        read = dict(zip(rows[0], np.array(rows[1:], float).T, strict=True))
    elif form == "npz":
        read = dict(np.load("out.npz"))
    else:
        table = pytest.importorskip("pyarrow.parquet").read_table("out.parquet")
        read = {name: table[name].to_numpy() for name in table.column_names}
    assert list(read) == [
        *("time", "speeds[in]", "speeds[ring]", 'speeds["out, too"]', "slips[brake]"),
        *("slips[clutch]", "torques[brake]", "torques[clutch]", "torques[set]"),
    ]
    found = document()
    assert np.array_equal(read["time"], found["time"])
    assert np.array_equal(read["torques[set]"], found["torques"]["set"])


def test_targets_are_shown_where_they_are_asked_for() -> None:
    assert "targets" not in document()
    Path("lock.yaml").write_text(SCENARIO + "targets: {in: [60, 1e4]}\n", "utf-8")
    met, missed = document()["targets"]
    assert met["link"] == "in"
    # after the lock the input gains 25.477707 rad/s^2 from 52.135036 rad/s
    expected = LOCKS + (60 - 52.135036) / 25.477707
    assert met["time"] == pytest.approx(expected, abs=1e-6)
    assert missed["time"] is None
    assert "Speeds reached" in vstatics("simulate", "lock.yaml").out


def test_a_case_on_the_command_line_replaces_that_of_the_scenario() -> None:
    Path("heavy.yaml").write_text(CASE.replace("0.8", "8"), "utf-8")
    said = vstatics("simulate", "lock.yaml", "heavy.yaml")
    assert said.status == 0
    assert "0.410054006" not in said.out
    without = SCENARIO.partition("\n")[2]
    assert vstatics("simulate", "-", "box.yaml", stdin=without.encode()).status == 0
    said = vstatics("simulate", "-", stdin=without.encode())
    assert said.gives_nothing(
        "<stdin>:1:1: error: no file of a case is named: expected `case: FILE`"
    )


def test_what_is_in_error_is_reported_at_its_place_and_nothing_is_written() -> None:
    for old, new, said in (
        ("brake: 120", "brakes: 120", "4:12: error: controls: read 'brakes', expected the name"),
        ("box.yaml", "bax.yaml", "1:7: error: bax.yaml cannot be read: No such file"),
        ("box.yaml", '"b\\0x"', "1:7: error: b\\u0000x cannot be read: "),
        ("in: 500 rpm", "in: 500 rpm, ring: 100", "3:"),
        ("in: 500 rpm, ", "", "3:"),
        ("start: {", "start: {gear: low, ", f"3:8: error: start: {WITH_GEAR}"),
    ):
        Path("lock.yaml").write_text(SCENARIO.replace(old, new), "utf-8")
        shown = vstatics("simulate", "lock.yaml", "-o", "out.csv")
        assert shown.gives_nothing()
        assert shown.err.startswith(f"lock.yaml:{said}")
        assert ("did you mean `box.yaml`?" in shown.err) == (new == "bax.yaml")
        assert names() == ["box.yaml", "lock.yaml"]
    one_way = CASE.replace("[in, ring]", "{kind: freewheel, links: [in, ring]}")
    Path("box.yaml").write_text(one_way, "utf-8")
    shown = vstatics("simulate", "lock.yaml")  # with the last of these mistakes
    assert f"{WITH_GEAR}, and add freewheels that hold (clutch)" in shown.err


@pytest.mark.parametrize("form", ["json", "csv", "text"])
def test_a_run_that_stops_leaves_what_it_has_with_a_mark(
    form: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = module.simulate

    def stopped(*scenario: Any, **options: Any) -> Any:
        problem = Problem("E608", "at 0.5 s brake neither sticks nor slips")
        return whole(*scenario, **options)._replace(stopped=problem)

    monkeypatch.setattr(module, "simulate", stopped)
    said = vstatics("simulate", "lock.yaml", "-f", form)
    assert said.status == 1
    assert said.err == "lock.yaml: error: at 0.5 s brake neither sticks nor slips\n"
    if form == "json":
        assert said.json["stopped"] == "at 0.5 s brake neither sticks nor slips [E608]"
    assert said.out


def test_wrong_use() -> None:
    files = (["lock.yaml", "-o", name] for name in ("box.yaml", "out.svg"))
    steps = (["lock.yaml", "--time-step", step] for step in ("0", "nan", "1e-9"))
    for options in (*files, *steps, ["-", "-"]):
        assert vstatics("simulate", *options).status == 2, options
    said = vstatics("simulate", "box.yaml")
    assert said.gives_nothing("this is a case, expected a scenario")
    for options in ([], ["--samples", "2", "-o", "a.csv"]):
        said = vstatics("simulate", "box.yaml", "lock.yaml", *options)
        assert said.is_wrong_use("expected the scenario first, then the case: lock.yaml box.yaml")


def test_a_scenario_is_checked_with_its_case() -> None:
    said = vstatics("check", "lock.yaml", "box.yaml")
    assert said.is_without_messages()
    assert said.out.startswith("lock.yaml: 1 s, 1 control, 2 torques\nbox.yaml: 3 links")
    assert vstatics("check", "-", stdin=SCENARIO.encode()).out.startswith("<stdin>: 1 s, 1 control")
    Path("lock.yaml").write_text(SCENARIO.replace("120", "1e20"), "utf-8")
    [problem] = json_answer("check", "lock.yaml")
    assert (problem["line"], problem["severity"]) == (4, "error")


def test_shipped_scenarios_fit_their_schema() -> None:
    yaml = pytest.importorskip("yaml")
    files = sorted((CASES / "scenarios").glob("*.yaml"))
    assert files
    for file in files:
        data = yaml.safe_load(file.read_text("utf-8"))
        assert list(validator("scenario").iter_errors(data)) == [], file.name
        load_scenario(file)


SHAPES = [[0, 0, 1, 9], [[]], [5], [], {}, None, 5, {"points": [0, 1]}]


def replaced(value: Any, by: Any) -> Iterator[Any]:
    """Copies of a document, each with another value replaced."""
    pairs = value.items() if isinstance(value, dict) else ()
    for key, below in pairs:
        for other in (by, *replaced(below, by)):
            yield value | {key: other}


def test_a_scenario_has_the_shape_of_its_schema_if_it_can_be_read() -> None:
    yaml = pytest.importorskip("yaml")
    file = CASES / "scenarios/8hp70-downshift.yaml"
    reading, schema = load_scenario_file(file).reading, validator("scenario")
    document = yaml.safe_load(file.read_text("utf-8")) | {"limits": {}, "targets": {}}
    for new in some([new for by in SHAPES for new in replaced(document, by)]):
        wrong = set()
        try:
            read_scenario(json.dumps(new).encode(), "").with_case(reading)
        except ReadError as error:
            wrong = {problem.id for problem in error.problems}
        is_valid = schema.is_valid(new)
        assert not (wrong & {"E127", "E190", "E191"} if is_valid else not wrong), new


def test_an_output_with_the_suffix_of_a_picture_leads_to_the_command_plot() -> None:
    said = vstatics("simulate", "upshift.yaml", "-o", "run.png")
    assert said.is_wrong_use("or none for text; `vstatics plot --kind shift` draws pictures")


@needs("vehicle")
def test_runs_and_sweeps_of_a_scenario_have_the_warnings_of_a_check() -> None:
    """A road of 1000 kg on wheels of 0.3 m needs 1000*0.3^2 = 90 kg*m^2, and the link has 0.8."""
    road = "{road: {mass: 1000, radius: 0.3, rolling: 0.01}}"
    Path("road.yaml").write_text(SCENARIO.replace("-60", road), "utf-8")
    vary = ("sweep", "road.yaml", "--vary", "duration=0.1,0.2", "--out", "work")
    assert vstatics("check", "road.yaml", "--strict").status == 1
    for command in (("check", "road.yaml"), ("simulate", "road.yaml"), vary):
        said = vstatics(*command)
        assert said.err.count("road.yaml:5:19: warning: ") == 1
        assert "expected 90 for a mass of 1000 kg" in said.err
    Path("box.yaml").write_text(f"{CASE}vehicle: {{mass: 9, radius: 0.3}}\n", "utf-8")
    assert "counts twice" in vstatics("check", "box.yaml").err
    assert vstatics("simulate", "lock.yaml").is_without_messages()


@pytest.mark.parametrize("options", [["-q"], ["--allow", "W201"]])
def test_warnings_beside_an_error_of_the_case_can_be_suppressed(
    options: list[str], folder: Path
) -> None:
    """A misspelled key is an error; a simple planetary gear set cannot have the basic ratio 2.5."""
    (folder / "box.yaml").write_text(
        "links: [a, b, c]\nmechanisms: {P: {first: a, second: b, third: c, ratio: 2.5}}\nnmae: x\n"
    )
    (folder / "run.yaml").write_text("case: box.yaml\nduration: 1\nstart: {speeds: {a: 1}}\n")
    assert "warning: mechanisms.P" in vstatics("simulate", "run.yaml").err
    said = vstatics("simulate", "run.yaml", *options)
    assert said.gives_nothing("error: unknown key `nmae`")
    assert "warning" not in said.err
