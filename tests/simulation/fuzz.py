"""Good inputs of readers of scenarios and of their sweeps, for `tests.fuzz`."""

from functools import cache

from tests.commands import CASES
from tests.fuzz import Kind
from vstatics import VariedScenario
from vstatics.core.readers import read
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.reading import Reading
from vstatics.simulation import Formula
from vstatics.simulation.scenario.file import read_scenario
from vstatics.simulation.scenario.formula import read_formula
from vstatics.sweep import build
from vstatics.sweep.options import SweepOptions
from vstatics.sweep.results.columns import read_columns
from vstatics.sweep.variants.subject import Document

SCENARIO = """\
case: tarasik-box.yaml
duration: 6 s
start: {speeds: {in: 600 rpm, out: 3 km/h}, engaged: [FH], settled: true}
controls:
  {FH: {points: [[0, 3 kN*m], [2, 0]], scale: .9}, F1: {dog: [[1, closed]]}, F2: "6000*min(t^2, 1)"}
torques:
  in: {over: speed, points: [[80 rad/s, 900], [200, 1100]]}
  out: ["-1200*tanh(speed/0.05)", {resistance: 300}, {road: {mass: 12 t, radius: 1/2, slope: .03}}]
converters: {TC: {links: [in, b0], points: [[0, 2.4, 3.1e-3], [.8, 1.0, 2.2e-3]]}}
shifts: [{at: 2, to: "2", overlap: 300 ms}]
targets: {out: [8.3, 50 km/h]}
samples: {controls.FH.scale: {normal: [.7, .05], min: .5}}
"""

CONTROLLED = """\
case: tarasik-box.yaml
duration: 6 s
start: {gear: "1", speed: 600 rpm}
numbers: {lag: .03, top: 9 kN*m}
tables:
  engine: {columns: [0, .5, 1], rows: [[80, -20, 150, 380], [200, -30, 220, 420]]}
  pedal: [[0, 1], [4, .2]]
set: {command: 0, closed: 0}
states:
  grip: {rate: "(command - grip)/lag", min: 0, max: 9000}
  e: {start: 1, rate: "closed*(abs(slip('F1')) - e)"}
controls: {F1: "grip + 10*e", FH: 3000}
torques: {in: "engine(speed, pedal(t))"}
speeds: {out: [[0, 0], [2, 30 rpm]]}
sequences:
  fill: [{when: "t > .3", set: {command: top}},
         {when: "locks('F1')", within: 2, wait: .1, shift: {to: "2", overlap: .3}}]
  again: {steps: [{wait: .5, set: {closed: 1}},
                  {when: "e < 1 or slips('F1')", set: {closed: "closed/2"}}], repeat: true}
"""


def _scenario(data: bytes) -> object:
    made = read_scenario(data, "shift.yaml").with_case(_box()).scenario
    laws = [law for _, law in made.torques if isinstance(law, Formula)]
    return [law.function(1.0, -2.0, 3.0, *[0.5] * len(law.seen)) for law in laws]


def _formula(data: bytes) -> float:
    return read_formula(Excerpt(text_of(data), "f")).function(0.5, -3.0, 1e9)


def text_of(data: bytes) -> str:
    return data.decode(errors="replace")


@cache
def _box() -> Reading:
    file = CASES / "tarasik-box.yaml"
    return read(file.read_bytes(), file.name)


@cache
def _varied() -> VariedScenario:
    scenario, case = CASES / "scenarios/tarasik-box.yaml", CASES / "tarasik-box.yaml"
    return VariedScenario(
        Document(scenario.read_bytes(), scenario.name), Document(case.read_bytes(), case.name)
    )


def kinds_of_scenarios() -> dict[str, Kind]:
    shipped = [one.read_text("utf-8") for one in sorted(CASES.glob("scenarios/tarasik-box*"))]
    formulas = "-1200*tanh(speed/0.05)^3", "182*(1 - exp(-60*t)) + 1/(0 < angle <= 1 or not t)"
    varied = (
        *("controls.FH.2.1=0:2:5", "controls.FB.scale=.9,1.1", "in.inertia=1,2"),
        *('start.speeds."in"=60 rad/s:90 rad/s:3', "mechanisms.'set 1'.ratio=-2,-3"),
        "duration=1 s:6:step=.5",
    )
    columns = (
        "heat[F2], max(abs(slips[F2] - slips[F1])), last(speeds[out])",
        "locks[F1] - controls.F1.2.1, sum(losses)/work, time*(speeds > 3)",
    )
    return {
        "scenario": Kind((SCENARIO, CONTROLLED, *shipped), _scenario),
        "formula": Kind(formulas, _formula),
        "scenario sweep": Kind(
            varied, lambda data: build.plan(_varied(), SweepOptions.of(vary=[text_of(data)]))
        ),
        "run columns": Kind(columns, lambda data: read_columns(text_of(data), _varied(), [])),
    }
