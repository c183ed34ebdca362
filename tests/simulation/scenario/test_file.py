"""Scenarios are read with all their forms and units; what is wrong is told at its place."""

import math
from pathlib import Path

import pytest

from tests.core.readers.named.test_converters import CASE as CONVERTERS
from vstatics import ReadError, solve
from vstatics.core import readers
from vstatics.core.model.converters import Converter
from vstatics.core.writers import named
from vstatics.simulation import (
    Capacity,
    Dog,
    Formula,
    Points,
    Resistance,
    Road,
    Scenario,
    Shift,
    Start,
    constant,
    load_scenario,
    simulate,
)
from vstatics.simulation.scenario.distribution import Distribution
from vstatics.simulation.scenario.file import ScenarioFile, read_scenario
from vstatics.simulation.scenario.programme import newton_metres
from vstatics.simulation.scenario.table_files import table_of
from vstatics.simulation.system.devices import drags

CASE = b"""
inertias: {in: 0.5, front ring: 0.7, wheel: 0.8}
mechanisms: {set: {first: in, second: front ring, third: wheel, ratio: -1.5}}
load: {torque: 100 N*m}
shift_elements:
  B: {links: [front ring, housing], capacity: 300 N*m}
  lock up: {links: [in, front ring]}
  P:
    links: [in, front ring]
    friction: {radius: 0.1, area: 60 cm^2, surfaces: 8, coefficient: 0.1}
  W: {links: [wheel, housing], kind: freewheel}
gears: {low: [B], high: [lock up]}
"""
START = "start: {gear: low, speed: 60}"


def scenario_file(text: str, case: bytes = CASE) -> ScenarioFile:
    """A scenario of three lines at least; the texts of tests begin at line 4."""
    document = read_scenario(f"case: box.yaml\nduration: 6\n{text}".encode(), "shift.yaml")
    return document.with_case(readers.read(case, "box.yaml"))


def scenario(text: str) -> Scenario:
    return scenario_file(f"{START}\n{text}").scenario


def test_all_forms_of_controls() -> None:
    read = scenario("""controls:
  B: [[0, 30 kgf*m], [2000 ms, 3/10*1000], [2, 0]]
  lock up: {formula: "182*(1 - exp(-60*t))", scale: 0.9}
  P: {points: [[0, 2 bar], [1, 84e-5]]}
""")
    assert read.controls == {
        1: Capacity(Points((0.0, 2.0, 2.0), (30 * 9.80665, 300.0, 0.0))),
        2: Capacity(Formula("182*(1 - exp(-60*t))"), 0.9),
        3: Capacity(Points((0.0, 1.0), (2e5, 84e-5))),
    }
    read = scenario("controls: {B: 200 N*m, lock up: t}")
    assert read.controls == {1: Capacity(constant(200.0)), 2: Capacity(Formula("t"))}
    read = scenario("controls: {B: {dog: [[1.5, closed], [2, open]]}, P: {formula: 1 MPa}}")
    assert read.controls == {1: Dog(((1.5, True), (2.0, False))), 3: Capacity(constant(1e6))}


def test_all_forms_of_torques() -> None:
    read = scenario("""torques:
  in: 1.5 kN*m
  front ring: [[0, 100], [1, 200]]
  wheel:
    - -1200*tanh(speed/0.05)
    - {resistance: 300}
    - {over: speed, points: [[600 rpm, 900], [200, 1 kN*m]]}
    - {over: angle, points: [[90 deg, 1]]}
    - [[0, 5], [1, 6]]
    - {road: {mass: 12 t, radius: 500 mm, rolling: 0.012, drag_area: 6.5, slope: 3/100}}
""")
    assert read.torques == (
        (1, constant(1500.0)),
        (2, Points((0.0, 1.0), (100.0, 200.0))),
        (3, Formula("-1200*tanh(speed/0.05)")),
        (3, Resistance(300.0)),
        (3, Points((20 * math.pi, 200.0), (900.0, 1000.0), "speed")),
        (3, Points((math.pi / 2,), (1.0,), "angle")),
        (3, Points((0.0, 1.0), (5.0, 6.0))),
        (3, Road(12000.0, 0.5, 0.012, 6.5, 0.03)),
    )


def test_zeros_of_points_keep_their_sign() -> None:
    read = scenario("""controls: {B: [[0, -0.0], [1, 5]]}
torques: {wheel: {resistance: -0.0}}
""")
    control, (_, law) = (read.controls or {})[1], read.torques[0]
    assert isinstance(control, Capacity)
    assert isinstance(control.law, Points)
    assert isinstance(law, Resistance)
    assert math.copysign(1.0, control.law.y[0]) == math.copysign(1.0, law.torque) == -1.0


def test_what_else_a_scenario_has() -> None:
    read = scenario_file("""start:
  {speeds: {in: 600 rpm, wheel: 36 km/h}, engaged: [B], settled: true}
torques: {wheel: {road: {mass: 1, radius: 0.5}}}
converters: {TC: {links: [in, wheel], points: [[0, 2.4, 3.1e-3], [.8, 1.0, 0]]}}
shifts: [{at: 2, to: high, overlap: 300 ms}, {at: 3, to: low}]
targets: {wheel: [8.3, 50 km/h], in: 4*3}
samples: {start.speeds.in: {normal: [600 rpm, 6], min: 20}, x: {uniform: [1, 2]}}
""")
    assert read.scenario[3:8] == (
        None,
        ((3, Road(1.0, 0.5)),),
        (Converter("TC", 1, 3, ((0.0, 2.4, 3.1e-3), (0.8, 1.0, 0.0))),),
        (Shift(2.0, "high", 0.3), Shift(3.0, "low", 0.0)),
        {3: (8.3, 50 / 3.6 / 0.5), 1: (12.0,)},
    )
    speeds = {1: 20 * math.pi, 3: 20.0}
    assert read.scenario.start == Start(speeds=speeds, engaged=(1,), settled=True)
    assert read.samples == {
        "start.speeds.in": Distribution(normal=(20 * math.pi, 6.0), min=20.0),
        "x": Distribution(uniform=(1.0, 2.0)),
    }


FAULTS = [
    ("contrls: {}", "4:1", "unknown key `contrls`; did you mean `controls`?"),
    ("controls: {C: 3}", "4:12", "read 'C', expected the name of a shift element: B, lock up"),
    ("controls: {B: [[0, 1], [2, 1], [1, 1]]}", "4:32", "read 1 after 2, expected points in"),
    ("controls: {B: {scale: 1}}", "4:15", "read none of them, expected one of `points`, `form"),
    ("controls: {B: {dog: [[1, open]], points: [[0, 1]]}}", "4:15", "read `points` and `dog`, exp"),
    ("controls: {B: {dog: [[1, shut]]}}", "4:26", "expected `open` or `closed`"),
    ("controls: {B: {dog: [[1, open], [0, closed]]}}", "4:33", "expected times in their order"),
    ("controls: {B: []}", "4:12", "expected at least one point"),
    ("controls: [3]", "4:11", "expected a mapping: a number for each shift element"),
    ("controls: {B: 3 bar}", "4:12", "read a number in Pa, expected a number in N*m, since B has"),
    ("controls: {P: [[0, 3 N*m]]}", "4:20", "expected a number in Pa, since P has `friction`"),
    ("controls: {B: 3 kg}", "4:15", "expected a number in N*m or Pa, bare or with its unit"),
    ("controls: {B: 2*(t + speed)}", "4:22", "read `speed`, expected a formula of t"),
    ("controls: {B: {points: [[0, 1]], scale: -2}}", "4:41", "read -2, expected a scale of 0 or"),
    ("controls: {B: sqrt(1 - t)}", "4:12", "is nan at 1.0"),
    ("controls: {B: .nan}", "4:15", "read `.`, expected a number, t, or"),
    ("controls: {W: 3}", "4:12", "read a control of a freewheel, which holds without a control"),
    ("torques: {wheels: 3}", "4:11", "did you mean `wheel`?"),
    ("torques: {housing: 3}", "4:10", "read the housing, expected a link that can rotate"),
    ('torques: {in: "1 + tt"}', "4:20", "read `tt`, expected a formula of t, speed and angle"),
    ("torques: {in: [[0, 1], [1, 2, 3]]}", "4:24", "read a list of 3, expected 2 numbers"),
    ("torques: {in: [0, [1, 5]]}", "4:16", "read '0', expected 2 numbers: [time, torque]"),
    ("torques: {in: [3, {resistance: -1}]}", "4:32", "read -1, expected a torque of 0 or more"),
    ("torques: {in: {over: speed, resistance: 1}}", "4:15", "read `over` with `resistance`"),
    ("torques: {in: {over: speed, points: [[1 s, 2]]}}", "4:39", "the points are over speed"),
    ("torques: {in: {road: {mass: 1, radius: 1, slope: 3}}}", "4:50", "the sine of an angle"),
    ("converters: {B: {links: [in, wheel], points: [[0, 1, 1]]}}", "4:14", "of another component"),
    ("converters: {T: {links: [in, in], points: [[0, 1, 1]]}}", "4:25", "two different links"),
    ("converters: {T: {links: [in, housing], points: [[0, 1, 1]]}}", "4:30", "a link number from"),
    ("converters: {T: {links: [in, wheel], points: [[0, 1, -1]]}}", "4:54", "lambda of 0 or more"),
    ("shifts: [{at: 1, to: hih}]", "4:22", "expected the name of a gear; did you mean `high`?"),
    ("shifts: [{at: 2, to: low}, {at: 0, to: high}]", "4:33", "expected shifts in the order of"),
    ("shifts: [{at: 2, to: low, overlap: -1}]", "4:36", "read -1, expected a time of 0 or more"),
    ("shifts: [{to: low}]", "4:10", "`at` is missing"),
    ("tables: {T: {columns: x, rows: [[0, 1, 2]]}}", "4:23", "read 'x', expected a list"),
    ("targets: {in: 50 km/h}", "4:11", "a velocity belongs to a link with a `road`"),
    # modelica/ModelicaStandardLibrary/issues/4009: a table with a wrong head has one cause
    ("tables: {k: {file: no.csv}}\ntorques: {in: 'k(t, 1)'}", "4:20", "which cannot be read"),
    ("samples: {x: {normal: [0, -1]}}", "4:23", "expected a standard deviation of 0 or more"),
    ("samples: {x: {normal: [0, 1], min: 3}}", "4:23", "expected a mean from min to max"),
    ("samples: {x: {min: 3}}", "4:14", "expected one of `normal`, `lognormal` or `uniform`"),
]


def test_a_fault_is_reported_once_at_its_place() -> None:
    for text, place, message in FAULTS:
        with pytest.raises(ReadError) as caught:
            scenario(text)
        [problem] = caught.value.problems
        assert message in problem.message, text
        assert str(problem).startswith(f"shift.yaml:{place}: error: "), text


NO_SCENARIOS = [
    ("{case: box.yaml, duration: 6}", "expected `gear`, or `speeds`"),
    ("{case: box.yaml, duration: 0, start: {gear: low}}", "read 0, expected a time above 0"),
    ("{duration: 6, start: {gear: low, speeds: {in: 3}}}", "read `gear` together with `speeds`"),
    ("{duration: 6, start: {speed: 12.1 rpm}}", "read `speed` without `gear`"),
    ("{duration: 6, start: {speed: 3, speeds: {in: 3}}}", "read `speed` without `gear`"),
    ("{duration: 6, start: {gear: slow}}", "did you mean `low`?"),
    ("{duration: 6, start: {speeds: {in: 3 N}}}", "expected a number in rad/s or m/s"),
    ("[]", "read a list, expected a scenario"),
    ("{case: box.yaml, vary: {}}", "this is a sweep file, expected a scenario"),
    (CASE.decode(), "this is a case, expected a scenario: a mapping with `case`"),
]


def test_what_is_no_scenario() -> None:
    for text, message in NO_SCENARIOS:
        with pytest.raises(ReadError) as caught:
            read_scenario(text.encode(), "x.yaml").with_case(readers.read(CASE, "box.yaml"))
        [problem] = caught.value.problems
        assert message in problem.message, text


def test_all_faults_are_reported_together() -> None:
    with pytest.raises(ReadError) as caught:
        scenario("controls: {B: sqrt(-t), X: 2}\ntorques: {in: x}\nshifts: [{at: -1, to: x}]")
    assert [one.place.line for one in caught.value.problems if one.place] == [4, 4, 5, 6, 6]


def test_the_case_is_found_beside_the_scenario_or_given(tmp_path: Path) -> None:
    (tmp_path / "box.yaml").write_bytes(CASE)
    (tmp_path / "other.yaml").write_bytes(CASE.replace(b"low", b"first"))
    file = tmp_path / "shift.yaml"
    file.write_text('{"case": "box.yaml", "duration": 6, "start": {"gear": "low"}}')
    assert load_scenario(file).case.gears[0].name == "low"
    with pytest.raises(ReadError, match="expected the name of a gear"):
        load_scenario(file, tmp_path / "other.yaml")
    for case, message in (
        ("case: bax.yaml, ", r"shift.yaml:1:8: error: .*bax.yaml cannot be read"),
        ("", "no file of a case is named: expected `case: FILE`"),
    ):
        file.write_text(f"{{{case}duration: 6, start: {{gear: low}}}}")
        with pytest.raises(ReadError, match=message):
            load_scenario(file)


def test_names_of_a_drawn_case() -> None:
    """Links of planets are none of the case's own."""
    case = b"""
input: in
output: out
elements: {P: {kind: planetary, sun: in, ring: held, carrier: out, teeth: {sun: 30, ring: 70}}}
shift_elements: {"B 1": [held, housing]}
gears: {"1": [B 1]}
"""
    read = scenario_file('start: {gear: 1}\ncontrols: {"B 1": 3}\ntorques: {out: 3}', case)
    out = read.scenario.case.link_number("out")
    assert read.scenario.torques == ((out, constant(3.0)),)
    with pytest.raises(ReadError, match="expected the name of a link"):
        scenario_file("start: {gear: 1}\ntorques: {4: 1}", case)
    assert read.scenario.controls == {1: Capacity(constant(3.0))}


def test_capacities_and_drag_with_a_unit_need_no_load_where_there_are_inertias() -> None:
    case = b"""
inertias: {a: 1, b: 3}
shift_elements: {C: {links: [a, b], capacity: 20 N*m, drag: 2 N*m}}
gears: {"1": {engaged: [C]}}
"""
    read = readers.read(case, "box.yaml").case
    written = readers.read(named.write_yaml(read).encode(), "box.yaml").case
    for one in (read, written):
        assert newton_metres(one.shift_elements[0].capacity, one) == 20
        assert [drag.torque for drag in drags(one, None)] == [2]
        [told] = [each.text for each in solve(one).messages if each.id == "W401"]
        assert told.startswith("the drag of C has a unit, but the case has no operating point")


def test_a_dog_clutch_takes_no_capacity() -> None:
    case = CASE.replace(b"lock up: {links", b"lock up: {kind: dog_clutch, links")
    with pytest.raises(ReadError, match="a dog clutch, which has no friction"):
        _ = scenario_file(f"{START}\ncontrols: {{lock up: 100}}", case).scenario


def test_a_scenario_without_converters_has_those_of_the_case() -> None:
    reading = readers.read(CONVERTERS.encode(), "case.yaml")
    scenario = b"{case: case.yaml, duration: 1, start: {speeds: {engine: 1, turbine: 1}}%s}"
    own = b", converters: {C2: {links: [engine, out], points: [[0, 1, 1]]}}"
    files = [read_scenario(scenario % more, "s.yaml") for more in (b"", own)]
    without, other = (file.with_case(reading).scenario.converters for file in files)
    assert without == reading.case.converters
    assert other == (Converter("C2", 1, 3, ((0.0, 1.0, 1.0),)),)


def test_a_run_does_not_start_in_a_gear_with_a_given_slip(tmp_path: Path) -> None:
    slipping = CASE.replace(b"{low:", b"{troll: {slip: {B: 0.2}}, low:")
    (tmp_path / "box.yaml").write_bytes(slipping)
    file = tmp_path / "shift.yaml"
    for key, place in (("start: {gear: troll}", "3:15"), ("shifts: [{at: 1, to: troll}]", "3:22")):
        start = "" if key.startswith("start") else "\nstart: {gear: low}"
        file.write_text(f"case: box.yaml\nduration: 6\n{key}{start}", "utf-8")
        with pytest.raises(ReadError, match=rf"shift.yaml:{place}: error: .*B has a given slip in"):
            load_scenario(file)


def test_input_speeds_in_rpm_are_those_of_the_start_and_of_laws_over_speed() -> None:
    """Pi rad/s are 30 rpm; what acts on another link counts nothing."""
    laws = "in: {over: speed, points: [[-30 rpm, 0], [6 rad/s, 0]]}"
    laws += ", wheel: {over: speed, points: [[1, 0], [2, 0]]}"
    file = scenario_file(f"start: {{gear: low, speed: 900 rpm}}\ntorques: {{{laws}}}")
    assert file.input_speeds == pytest.approx((900, 30, 6 * 30 / math.pi))


def test_a_start_speed_without_its_unit_is_noted_if_few_engines_are_as_fast() -> None:
    """3000 rad/s are 28,648 rpm. A motor of 12,000 rpm, with its unit, gets no note.

    The name of the scenario is cut off, which is a warning of its own.
    """
    for speed, noted in (("3000", "W104 N205"), ("12000 rpm", "W104"), ("300", "W104")):
        file = scenario_file(f"name: speed #1\nstart: {{gear: low, speed: {speed}}}")
        assert " ".join(note.id for note in file.doubts if "speed" in note.message) == noted


def test_a_start_speed_of_an_input_with_a_road_can_be_a_vehicle_speed() -> None:
    """Source of the case, a car on a slope: github.com/osrf/drcsim/issues/109."""
    case = b"links: [wheel]\ninertias: {wheel: 194}\ngears: {'1': []}\n"
    road = "torques: {wheel: {road: {mass: 1500, radius: 0.36}}}\n"
    read = scenario_file(f"start: {{gear: '1', speed: 36 km/h}}\n{road}", case).scenario
    assert read.start.speed == pytest.approx(10 / 0.36)


@pytest.mark.parametrize(
    ("text", "pedal", "expected"),
    [
        # hgrecco/pint/issues/2171: 1140.654898 hp at 5000 rpm are 16.245 bar*litre of torque
        ("speed [rpm],power [hp]\n0,0\n5000,1140.654898001541\n", 0.0, 1624.5),
        ("speed [rpm];power [kW]\n0;0\n5000;850,586211\n", 0.0, 1624.5),
        ("speed [rpm],0%,100 %\n0,0,0\n5000,0,850586.211\n", 0.5, 812.25),
        ("speed [rpm],0,1\n0,0,0\n5000,0 W,850.586211 kW\n", 1.0, 1624.5),
    ],
)
def test_a_table_file_has_powers_and_percentages(
    tmp_path: Path, text: str, pedal: float, expected: float
) -> None:
    """The torque is the power divided by the speed."""
    (tmp_path / "engine.csv").write_text(text, "utf-8")
    power = table_of(str(tmp_path / "run.yaml"), "engine.csv")
    speed = 5000 * math.pi / 30
    assert power.at(speed, pedal) / speed == pytest.approx(expected, rel=1e-6)


def test_formulas_run_with_a_table_file(tmp_path: Path) -> None:
    """OpenModelica/OpenModelica/issues/3542: a table ran in the model, but not from a file.

    With a torque of 1 N*m*s/rad times the speed and 1 kg*m^2, the speed grows by the factor e.
    """
    (tmp_path / "box.yaml").write_text("inertias: {a: 1}\n", "utf-8")
    (tmp_path / "engine.csv").write_text(f"n [rpm],M [N*m]\n0,0\n# rated\n30,{math.pi}\n", "utf-8")
    (tmp_path / "run.yaml").write_text(
        "case: box.yaml\nduration: 1\nstart: {speeds: {a: 1}}\n"
        "tables: {engine: {file: engine.csv}}\ntorques: {a: engine(speed)}\n",
        "utf-8",
    )
    speeds = simulate(load_scenario(tmp_path / "run.yaml")).speeds
    assert speeds[-1, 0] == pytest.approx(math.e, rel=1e-8)


@pytest.mark.parametrize("title", ["", "Bench 3\n"])
def test_units_of_a_table_file_can_be_below_its_names(tmp_path: Path, title: str) -> None:
    rows = "speed,0.2,1\nrpm,kN*m,kN*m\n0,1,2\n30,3,4\n"
    (tmp_path / "grid.csv").write_text(title + rows, "utf-8")
    grid = table_of(str(tmp_path / "run.yaml"), "grid.csv")
    assert grid.at(math.pi, 1.0) == pytest.approx(4000)  # 30 rpm is pi rad/s


def test_a_table_file_with_an_unknown_unit_is_rejected(tmp_path: Path) -> None:
    (tmp_path / "engine.csv").write_text("speed [rpm],power [kVA]\n0,1\n", "utf-8")
    with pytest.raises(ValueError, match=r"line 2: read 1 kVA, expected .* such as `N\*m`, `kW`"):
        table_of(str(tmp_path / "run.yaml"), "engine.csv")
