"""Commands with a mutated file, for `tests.fuzz`: each ends in an answer or in words.

A file is written in a folder of this process and the command is called within it, as it would
be at a terminal. Its JSON holds no NaN, it says nothing of an error of its own, no number in it overflows unseen.
"""

import json
import tempfile
import warnings
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import NoReturn

import numpy as np

from tests.commands import CASES, Said, vstatics
from tests.installed import HERE
from tests.shipped import shipped_results
from vstatics import VstaticsError
from vstatics.core.writers import listing, result_json

TIMED = "-f json --limit 30"
"""Limit of a run [s], long enough for a good input on a busy machine."""
MEASURED = "--gear 1 --omega 27.4 --decrement .1"
SHAFTS = """\
links: [engine, gear, vehicle]
inertias: {engine: 0.2, gear: 0.05, vehicle: 9.5}
springs:
  shaft: {links: [engine, gear], stiffness: 9e3, damping: {loss_factor: .04}}
  tyre: {links: [gear, vehicle], compliance: 1/800, damping: 12}
"""
STICKS = """\
case: set.yaml
duration: 0.5
start: {speeds: {sun: 500 rpm, carrier: 0}}
controls: {brake: [[0, 120], [.2, 0]], lock-up: "200*(t > .25)"}
torques: {sun: {over: speed, points: [[0, 60], [50, 20]]}, carrier: {resistance: 30}}
"""
PLANT = """\
links: [dyno, e, m, o, h]
inertias: {e: .2, m: .1, o: 3, h: 1/2}
springs:
  S: {links: [e, m], points: [[0, 0], [.02, 0], [.1, 200]], damping: 2}
  T: {links: [dyno, e], stiffness: 4e3, damping: 5, limit: 300 N*m}
shift_elements:
  C:
    links: [m, o]
    friction: {radius: 10 cm, area: 60 cm^2, surfaces: 8, heat_capacity: 900, cooling: 5, ambient: 30,
      coefficient: {columns: [30, 230], rows: [[0, .12, .1], [60, .13, .08]]}}
  D: {links: [o, housing], kind: dog_clutch}
mechanisms: {hydro: {kind: variator, first: o, second: h, speed_ratio: .4, efficiency: .9}}
gears: {drive: [C], free: [], held: [D]}
"""
DRIVEN = """\
case: plant.yaml
duration: 0.1
start: {speeds: {dyno: 900 rpm, e: 900 rpm, m: 900 rpm, o: 0}}
numbers: {lag: 0.02, top: 3 bar}
tables:
  engine: {columns: [0, 1], rows: [[50, -5, 80], [150, -20, 60]]}
  ramp: [[0, 1], [.2, .5]]
set: {command: 0, closed: 0}
states:
  pressure: {start: 1e5, rate: "(command - pressure)/lag", min: 0, max: 9e5}
  error: {rate: "closed*(abs(slip('C')) - 5)", min: -50}
controls: {C: "pressure + 100*error"}
torques:
  m: "engine(speed, ramp(t)) - temperature('C')/100"
  o: [{resistance: 3}, "-.02*speed*abs(speed)"]
speeds: {dyno: [[0, 900 rpm], [.06, 700 rpm]]}
speed_ratios: {hydro: "0.4 - t"}
limits: {T: [[0, 250], [.1, 120]]}
sequences:
  shift:
    - {when: "t >= .01", set: {command: top}}
    - {when: "temperature('C') > 30.2 or locks('C')", within: 1, wait: .01, set: {closed: 1}, dog: {D: closed}}
  pulse: {steps: [{wait: .03, set: {closed: 0}}, {wait: .02, set: {closed: 1}}], repeat: true}
"""
WARM = """\
case: warm.yaml
duration: 0.05
start: {speeds: {dyno: 900 rpm, e: 900 rpm, m: 900 rpm, o: 0}}
speeds: {dyno: 900 rpm}
speed_ratios: {hydro: [[0, .4], [1, -2]]}
limits: {T: "200 - 1e3*t"}
controls: {C: [[0, 0], [.02, 3 bar]]}
"""
DUMP = """\
J1: 4.29
J2: 0.1
J3: 67.4e-3
J4: 0.147
J5: 10.8
E: 2600e-6
M_C0: 1344 N*m
M_phi: 507
omega1: 1300 rpm
"""
HARMONICS = "order,amplitude [N*m],phase [deg]\n.5,12,-30\n2,120,0\n4,33,90\n"
BOX = """\
links: [i, r, o]
shift_elements: {B: [r, housing], C: [i, r]}
mechanisms: {P: {first: i, second: r, third: o, ratio: -2.5, efficiency: .98}}
gears: {low: [B], high: [C]}
"""


class RefusedError(VstaticsError):
    """The command said what is wrong."""


def _no_constant(name: str) -> NoReturn:
    raise AssertionError(f"{name} in JSON")


def check_answer(said: Said, words: Sequence[object]) -> None:
    """Check that a command ended with a result or a message, and that JSON contains no NaN."""
    assert "an error of vstatics" not in said.err, said.err
    assert said.status == 0 or (said.status in (1, 2) and said.all), f"{said.status}: {said.err}"
    if said.out and "json" in words:
        json.loads(said.out, parse_constant=_no_constant)


@cache
def _folder() -> Path:
    """A folder of this process, with the files that commands read beside the mutated one."""
    folder = Path(tempfile.mkdtemp(prefix="vstatics-fuzz-"))
    if "simulation" in HERE:
        from tests.simulation.variants.scenarios import CASE

        (folder / "set.yaml").write_bytes(CASE)
    (folder / "shafts.yaml").write_text(SHAFTS, "utf-8")
    (folder / "box.yaml").write_text(BOX, "utf-8")
    (folder / "plant.yaml").write_text(PLANT, "utf-8")
    (folder / "warming.yaml").write_text(WARM, "utf-8")
    return folder


Fuzzed = tuple[tuple[str, ...], Callable[[bytes], object]]
"""Good files, and the reader of a mutated one."""


def _command(file: str, *words: str) -> Callable[[bytes], object]:
    """What calls a command, whose words name files of the folder."""

    def reader(data: bytes) -> object:
        folder = _folder()
        (folder / file).write_bytes(data)
        named = [str(folder / word) if (folder / word).is_file() else word for word in words]
        with np.errstate(all="warn", under="ignore"), warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            said = vstatics(*named)
        check_answer(said, words)
        if said.status:
            raise RefusedError(said.err or "in its answer")
        return said.out

    return reader


RESPONSE = "torsion response shafts.yaml --at engine --speed 600,900 --torque t.csv -f json"
TEETH = "synth teeth t.yaml --ratios low=3.2 --range sun=20:24,ring=40:60,planet=10:20 --planets 3"
ROWS = (
    ("simulation", "driven", DRIVEN, "driven.yaml", f"simulate driven.yaml {TIMED}"),
    ("simulation", "driven case", PLANT, "warm.yaml", f"simulate warming.yaml {TIMED}"),
    ("torsion", "dump", DUMP, "dump.yaml", "torsion dump dump.yaml -f json"),
    ("torsion", "modes", SHAFTS, "m.yaml", "torsion modes m.yaml -f json"),
    ("torsion", "measured", SHAFTS, "x.yaml", f"torsion identify x.yaml {MEASURED} -f json"),
    ("torsion", "harmonics", HARMONICS, "t.csv", RESPONSE),
    ("synthesis", "combinations", BOX, "c.yaml", "synth combinations c.yaml"),
    ("synthesis", "fit", BOX, "f.yaml", "synth fit f.yaml --ratios low=3.2 -f json"),
    ("synthesis", "teeth", BOX, "t.yaml", f"{TEETH} -f json"),
)
"""Annex, kind, a good file, its name, and a command that reads it."""


def commands() -> Mapping[str, Fuzzed]:
    """Return good files and what reads them, by what they are; of annexes that are installed."""
    found: dict[str, Fuzzed] = {
        name: ((text,), _command(file, *line.split()))
        for annex, name, text, file, line in ROWS
        if annex in HERE
    }
    if "simulation" in HERE:
        from tests.simulation.variants.scenarios import SCENARIO

        run = _command("run.yaml", "simulate", "run.yaml", *TIMED.split())
        found["run"] = (SCENARIO.decode(), STICKS), run
    if "synthesis" in HERE:
        from tests.synthesis.boxes.listed_boxes import simpson

        summary = _command("boxes.json", "summary", "boxes.json", "-f", "json")
        found["boxes"] = (json.dumps(simpson()),), summary
    one = shipped_results("mzkt7922.yaml")
    written: list[str] = [json.dumps(result_json.document(one)), listing.write(one)]
    written += [vstatics("run", CASES / "mzkt7922.dat", "-f", "csv").out]
    compared = _command("result.json", "compare", "result.json", "result.json")
    return {**found, "compared": (tuple(written), compared)}
