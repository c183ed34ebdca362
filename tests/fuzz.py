"""Mutated inputs for all readers and expressions: `python -m tests.fuzz 1000000`.

Each input must end in a result or in an error of vstatics, within a second of the processor;
files are carried out by their commands, too, within ten.
The same seed makes the same inputs; `--from N` starts at one that failed, `--kinds run,driven`
tries some kinds only.
"""

from __future__ import annotations

import argparse
import io
import json
import re
import sys
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from functools import cache, partial
from multiprocessing import Pool
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import numpy as np

from tests.commands import CASES, MZKT
from tests.fuzzed_commands import commands
from vstatics import VstaticsError, load, solve
from vstatics.core.readers import read
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.reading import Reading
from vstatics.core.readers.results import read_results
from vstatics.core.writers import listing, named, result_json
from vstatics.simulation.scenario.file import read_scenario
from vstatics.simulation.scenario.formula import Formula, read_formula
from vstatics.simulation.variants.subject import VariedScenario
from vstatics.sweep import build
from vstatics.sweep.file import read_sweep_file
from vstatics.sweep.options import SweepOptions
from vstatics.sweep.results.columns import read_columns
from vstatics.sweep.results.expressions import read_expression
from vstatics.sweep.variants.subject import Document
from vstatics.sweep.variants.table import read_table
from vstatics.sweep.variants.targets import target
from vstatics.sweep.variants.variation import read_variation
from vstatics.vehicle.duty_file import read_duty

READING_SECONDS, COMMAND_SECONDS = 1.0, 10.0
"""Of the processor, to read and to carry out a command; more is a fault."""
MOST_MEMORY = 2**30
"""Of an input, beside what its process had before; more is a fault. [bytes]"""
CHUNK = 100

PIECES = (
    *("0", "-1", "1", "7", "1e308", "1e-308", "1e999999999", "999999999", "nan", "inf", "1/0"),
    *("9" * 400, "6*0", "1000000000*0", ".", ",", " ", "\n", "\t", "\r", "\0", "\x1b[2J", "\u202e"),
    *("(", ")", "=", ":", "[", "]", "{", "}", "- ", "&a ", "*a", "'", '"', "#", "**", "^3^3^3"),
    *("housing", "KJG= 3", "NAME P1: x", "!!int ", "<<: ", "---", "null", "true", "~", "|", ">"),
    *(
        "400 Nm",
        "3000 1/min",
        "120 kW",
        "1.05*FL",
        "link 3",
        "kind: point",
        "input_turns: backward",
    ),
    *("ratio", "speeds[1]", "abs(", "max(", "and", "not", "<=", "1:2:3", "-3:-2:5", "1e9:0:1"),
)
SCENARIO = """\
case: tarasik-box.yaml
duration: 6 s
start: {speeds: {in: 600 rpm, out: 3 km/h}, engaged: [FH], settled: true}
controls: {FH: {points: [[0, 3 kN*m], [2, 0]], scale: .9}, F1: {dog: [[1, closed]]}, F2: "6000*min(t^2, 1)"}
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
tables: {engine: {columns: [0, .5, 1], rows: [[80, -20, 150, 380], [200, -30, 220, 420]]}, pedal: [[0, 1], [4, .2]]}
set: {command: 0, closed: 0}
states: {grip: {rate: "(command - grip)/lag", min: 0, max: 9000}, e: {start: 1, rate: "closed*(abs(slip('F1')) - e)"}}
controls: {F1: "grip + 10*e", FH: 3000}
torques: {in: "engine(speed, pedal(t))"}
speeds: {out: [[0, 0], [2, 30 rpm]]}
sequences:
  fill: [{when: "t > .3", set: {command: top}}, {when: "locks('F1')", within: 2, wait: .1, shift: {to: "2", overlap: .3}}]
  again: {steps: [{wait: .5, set: {closed: 1}}, {when: "e < 1 or slips('F1')", set: {closed: "closed/2"}}], repeat: true}
"""

TOKEN = re.compile(r"[A-Za-z_]+|[-+.0-9eE]+|\s+|.", re.DOTALL)

NUMBER = re.compile(r"[0-9]+\.?[0-9]*|\.[0-9]+")
OTHER_NUMBERS = 0.4
"""So many inputs have other numbers and no other change."""


class Kind(NamedTuple):
    """A kind of input: good ones, and what reads them."""

    good: tuple[str, ...]
    read: Callable[[bytes], object]
    seconds: float = READING_SECONDS


def _case(form: Any) -> Callable[[bytes], object]:
    """Read a case, and calculate what can be: that must end well, too."""

    def reader(data: bytes) -> object:
        case = read(data, "case", form).case
        if case.links < 30 and len(case.gears) < 20 and len(data) % 4 == 0:
            return solve(case)
        return case

    return reader


def _scenario(data: bytes) -> object:
    """Read a scenario of a shipped case, and the formulas in it."""
    made = read_scenario(data, "shift.yaml").with_case(_box()).scenario
    laws = [law for _, law in made.torques if isinstance(law, Formula)]
    return [law.function(1.0, -2.0, 3.0, *[0.5] * len(law.seen)) for law in laws]


def _formula(data: bytes) -> float:
    """Read a formula of its own link alone, and calculate it."""
    return read_formula(Excerpt(data.decode(errors="replace"), "f")).function(0.5, -3.0, 1e9)


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


@cache
def kinds() -> dict[str, Kind]:
    """All kinds, with shipped cases and what is made of them as good inputs."""
    decks = [MZKT.read_text(encoding="utf-8")]
    paths = sorted(CASES.glob("*.yaml"))
    yamls = [path.read_text(encoding="utf-8") for path in paths]
    yamls += [
        "links: [e, FL, FR]\noutputs: [FL, FR]\nload: {speed: 3000 1/min, torque: 1.3*400 Nm}\n"
        "shift_elements: {C: [e, FL]}\n"
        "mechanisms: {axle: {first: FL, second: FR, third: e, ratio: -1}}\n"
        "gears: {curve: {speeds: {FR: 1.05*FL}, kind: point}, lock: [C]}\n"
    ]
    some = [load(path) for path in paths[:6]]
    jsons = [named.write_json(case) for case in some]
    solved = [solve(case) for case in some[:3]]
    results = [json.dumps(result_json.document(one)) for one in solved]
    results += [listing.write(one) for one in solved]
    case = load(CASES / "mzkt7922.yaml")
    varied = [target("D1.ratio", case), target("D3.efficiency", case)]
    values = np.array([[-0.8, 0.97], [-0.9, 0.98]])
    numbers = solve(case)

    def expression(data: bytes) -> object:
        made = read_expression(data.decode(errors="replace"), case, varied, "--where")
        return made(numbers, values[:1])

    def columns(data: bytes) -> object:
        return read_columns(data.decode(errors="replace"), case, varied)

    def variation(data: bytes) -> object:
        return read_variation(data.decode(errors="replace"), case)

    return {
        "deck": Kind(tuple(decks), _case("deck")),
        "yaml": Kind(tuple(yamls), _case("yaml")),
        "json": Kind(tuple(jsons), _case("json")),
        "any": Kind((*decks, *yamls, *jsons), _case(None)),
        "result": Kind(tuple(results), lambda data: read_results(data, "result")),
        "duty": Kind(
            ("energy: {1: .2, 2: .3, 3: .5}\n", "time: {low: 1/3, R: 2/3}\n"),
            lambda data: read_duty(data, "duty.yaml"),
        ),
        "scenario": Kind(
            (
                SCENARIO,
                CONTROLLED,
                *(one.read_text("utf-8") for one in sorted(CASES.glob("scenarios/tarasik-box*"))),
            ),
            _scenario,
        ),
        "formula": Kind(
            ("-1200*tanh(speed/0.05)^3", "182*(1 - exp(-60*t)) + 1/(0 < angle <= 1 or not t)"),
            _formula,
        ),
        "sweep file": Kind(
            (
                "case: box.yaml\nvary: {D1.ratio: [-3, -2], D2.efficiency: '.9:.99:5'}\n"
                "out: ratio[1],efficiency[1]\nwhere: ratio[1] > 2\nmax: ETA[1]\nbest: 3\n",
                "case: box.yaml\nsample: 1000\nmethod: sobol\nseed: 1\nvary: {D1.ratio: '-3:-2'}\n",
            ),
            lambda data: read_sweep_file(data, "sweep.yaml"),
        ),
        "table": Kind(
            ("D1.ratio,D3.efficiency\n-.8,.97\n-.9,.98\n", "D1.ratio;D2.ratio\n-0,8;2,6\n"),
            lambda data: read_table(io.BytesIO(data), "table.csv", case),
        ),
        "expression": Kind(
            (
                "abs(ratio[1] / ratio[2] - 1.8) < .1 and min(efficiency) > .9",
                "max(abs(slip_speeds[T1]), 2 * AMLGP[Mx, 1] ** 2) - D1.ratio",
                "not (W[2, :] <= 1) or IX[D1,1] == -1",
            ),
            expression,
        ),
        "columns": Kind(
            ("ratio[1],ETA[1],speeds[:,2]", "AMLGP[Mx,1] - AMLG[Mx,1], ratio"), columns
        ),
        "scenario sweep": Kind(
            (
                "controls.FH.2.1=0:2:5",
                "controls.FB.scale=.9,1.1",
                'start.speeds."in"=60 rad/s:90 rad/s:3',
                "in.inertia=1,2",
                "mechanisms.'set 1'.ratio=-2,-3",
                "duration=1 s:6:step=.5",
            ),
            lambda data: build.plan(
                _varied(), SweepOptions.of(vary=[data.decode(errors="replace")])
            ),
        ),
        "run columns": Kind(
            (
                "heat[F2], max(abs(slips[F2] - slips[F1])), last(speeds[out])",
                "locks[F1] - controls.F1.2.1, sum(losses)/work, time*(speeds > 3)",
            ),
            lambda data: read_columns(data.decode(errors="replace"), _varied(), []),
        ),
        "variation": Kind(
            ("D1.ratio=-3:-2:5", "D1.ratio=-3:-2", "D2.efficiency=.9,.95,.97", "D1.ratio=-96/39"),
            variation,
        ),
        **{name: Kind(*one, COMMAND_SECONDS) for name, one in commands().items()},
    }


def mutated(rng: Random, good: tuple[str, ...]) -> bytes:
    """A good text with other numbers, or with other words."""
    tokens = TOKEN.findall(rng.choice(good))
    numbers = [place for place, token in enumerate(tokens) if NUMBER.fullmatch(token)]
    if not numbers or rng.random() > OTHER_NUMBERS:
        return with_other_words(rng, tokens)
    for place in rng.sample(numbers, min(len(numbers), rng.choice((1, 1, 2, 3)))):
        factor = rng.choice((-1, 0, 1, 1, 1, 10.0 ** rng.uniform(-9, 9), rng.uniform(0, 2)))
        tokens[place] = f"{float(tokens[place]) * factor:.{rng.randint(1, 17)}g}"
    return "".join(tokens).encode()


def with_other_words(rng: Random, tokens: list[str]) -> bytes:
    """A text, of which words are cut out, doubled, moved or replaced, or bytes changed."""
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        place = rng.randrange(max(len(tokens), 1))
        match rng.randrange(7):
            case 0:
                tokens[place : place + 1] = [rng.choice(PIECES)]
            case 1:
                tokens.insert(place, rng.choice(PIECES))
            case 2:
                del tokens[place : place + rng.randint(1, 12)]
            case 3:
                tokens[place:place] = tokens[place : place + rng.randint(1, 40)]
            case 4:
                tokens[place:place] = [rng.choice(PIECES)] * rng.choice((2, 10, 300))
            case 5:
                other = rng.randrange(max(len(tokens), 1))
                if tokens:
                    tokens[place], tokens[other] = tokens[other], tokens[place]
            case _:
                del tokens[place:]
    data = "".join(tokens).encode("utf-8", "replace")
    if data and rng.random() < 0.2:
        place = rng.randrange(len(data))
        data = data[:place] + rng.randbytes(rng.randint(1, 3)) + data[place + 1 :]
    return data


def memory(what: str) -> int:
    """Of this process, as the kernel calls it [bytes]."""
    found = re.search(rf"{what}:\s+(\d+) kB", Path("/proc/self/status").read_text("utf-8"))
    assert found
    return int(found[1]) * 1024


def tried(number: int, names: Sequence[str] = ()) -> tuple[str, str, str]:
    """Kind, outcome and fault of the input of a number; the fault is empty if all is well."""
    rng = Random(number)  # noqa: S311
    names = names or [*kinds()]
    name = names[number % len(names)]
    kind = kinds()[name]
    data = mutated(rng, kind.good)
    Path("/proc/self/clear_refs").write_text("5", "utf-8")  # the peak begins anew
    before = memory("VmRSS")
    begin = time.process_time()
    outcome, fault = "read", ""
    try:
        with np.errstate(all="ignore"):
            kind.read(data)
    except VstaticsError as error:
        outcome = "refused"
        if not str(error):
            fault = "an error without words"
    except Exception:  # noqa: BLE001 - that is what is looked for
        outcome, fault = "fault", traceback.format_exc()
    seconds = time.process_time() - begin
    if seconds > kind.seconds:
        fault += f"took {seconds:.1f} s"
    if (more := memory("VmHWM") - before) > MOST_MEMORY:
        fault += f"took {more / 2**20:.0f} MB"
    return name, outcome, f"{fault}\n{data[:2000]!r}" if fault else ""


def _many(names: Sequence[str], start: int) -> tuple[Counter[tuple[str, str]], list[str]]:
    counts: Counter[tuple[str, str]] = Counter()
    faults = []
    for number in range(start, start + CHUNK):
        name, outcome, fault = tried(number, names)
        counts[name, outcome] += 1
        if fault:
            faults.append(f"input {number}, {name}: {fault}")
    return counts, faults


def run(
    first: int, count: int, processes: int, names: Sequence[str]
) -> Iterator[tuple[Counter[tuple[str, str]], list[str]]]:
    """Counts and faults of some inputs, a chunk at a time."""
    with Pool(processes) as pool:
        yield from pool.imap_unordered(partial(_many, names), range(first, first + count, CHUNK))


def main() -> int:
    """Try the inputs, print the counts; the exit status is 1 if one failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("count", type=int)
    parser.add_argument("--from", dest="first", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--kinds", type=lambda text: text.split(","), default=[*kinds()])
    asked = parser.parse_args()
    counts: Counter[tuple[str, str]] = Counter()
    failed = 0
    for found, faults in run(asked.first, asked.count, asked.jobs, asked.kinds):
        counts += found
        failed += len(faults)
        for fault in faults:
            print(fault, flush=True)  # noqa: T201
    for name in asked.kinds:
        of_kind = {outcome: n for (kind, outcome), n in counts.items() if kind == name}
        print(f"{name:12} {of_kind}")  # noqa: T201
    accepted = sum(n for (_, outcome), n in counts.items() if outcome == "read")
    print(f"{sum(counts.values())} inputs, {accepted} accepted, {failed} faults")  # noqa: T201
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
