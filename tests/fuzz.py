"""Mutated inputs for all readers and expressions: `python -m tests.fuzz 1000000`.

Each input must end in a result or in an error of vstatics, within a second of the processor;
files are carried out by their commands, too, within ten.
The same seed makes the same inputs; `--from N` starts at one that failed, `--kinds run,driven`
tries some kinds only.
"""

import argparse
import json
import re
import sys
import time
import traceback
from collections import Counter
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import numpy as np

from tests.commands import CASES, MZKT
from tests.fuzzed_commands import commands
from tests.installed import HERE
from vstatics import VstaticsError, load, solve
from vstatics.core.readers import read
from vstatics.core.readers.results import read_results
from vstatics.core.writers import listing, named, result_json

READING_SECONDS, COMMAND_SECONDS = 1.0, 10.0
"""Of the processor, to read and to carry out a command; more is a fault."""
MOST_MEMORY = 2**30
"""Of an input, beside what its process had before; more is a fault. [bytes]"""

PIECES = (
    *("0", "-1", "1", "7", "1e308", "1e-308", "1e999999999", "999999999", "nan", "inf", "1/0"),
    *("9" * 400, "6*0", "1000000000*0", ".", ",", " ", "\n", "\t", "\r", "\0", "\x1b[2J", "\u202e"),
    *("(", ")", "=", ":", "[", "]", "{", "}", "- ", "&a ", "*a", "'", '"', "#", "**", "^3^3^3"),
    *("housing", "KJG= 3", "NAME P1: x", "!!int ", "<<: ", "---", "null", "true", "~", "|", ">"),
    *("400 Nm", "3000 1/min", "120 kW", "1.05*FL", "link 3", "kind: point", "1:2:3", "1e9:0:1"),
    *("input_turns: backward", "ratio", "speeds[1]", "abs(", "max(", "and", "not", "<=", "-3:-2:5"),
)
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


def of_annexes() -> dict[str, Kind]:
    """Return the kinds of the annexes that are installed."""
    found: dict[str, Kind] = {}
    if "sweep" in HERE:
        from tests.sweep.fuzz import kinds_of_sweeps

        found |= kinds_of_sweeps()
    if "simulation" in HERE:
        from tests.simulation.fuzz import kinds_of_scenarios

        found |= kinds_of_scenarios()
    if "vehicle" in HERE:
        from tests.vehicle.fuzz import KINDS

        found |= KINDS
    return found


@cache
def kinds() -> dict[str, Kind]:
    """All kinds, with shipped cases and what is made of them as good inputs."""
    decks = [MZKT.read_text("utf-8")]
    paths = sorted(CASES.glob("*.yaml"))
    yamls = [path.read_text("utf-8") for path in paths]
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
    return {
        "deck": Kind(tuple(decks), _case("deck")),
        "yaml": Kind(tuple(yamls), _case("yaml")),
        "json": Kind(tuple(jsons), _case("json")),
        "any": Kind((*decks, *yamls, *jsons), _case(None)),
        "result": Kind(tuple(results), lambda data: read_results(data, "result")),
        **of_annexes(),
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


def main() -> int:
    """Try the inputs, print the counts; the exit status is 1 if one failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("count", type=int)
    parser.add_argument("--from", dest="first", type=int, default=0)
    parser.add_argument("--kinds", type=lambda text: text.split(","), default=[*kinds()])
    asked = parser.parse_args()
    counts, failed = Counter[tuple[str, str]](), 0
    for number in range(asked.first, asked.first + asked.count):
        name, outcome, fault = tried(number, asked.kinds)
        counts[name, outcome] += 1
        if fault:
            failed += 1
            print(f"input {number}, {name}: {fault}", flush=True)  # noqa: T201
    for (name, outcome), found in sorted(counts.items()):
        print(f"{name:12} {outcome:8} {found}")  # noqa: T201
    print(f"{counts.total()} inputs, {failed} faults")  # noqa: T201
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
