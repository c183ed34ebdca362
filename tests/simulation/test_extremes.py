"""Random scenarios with extreme numbers: run right, or refused with the place of the fault."""

import math
import re
from collections.abc import Iterator
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.chance import count, seeded
from tests.commands import vstatics

CASE = """\
links: [in, ring, out, w]
inertias: {{in: {0}, ring: {0}, out: {0}, w: {1}}}
mechanisms:
  set: {{first: in, second: ring, third: out, ratio: -{2}, efficiency: {3}}}
shift_elements:
  B: {{links: [ring, housing], capacity: {4} N*m}}
  C: {{links: [in, ring], capacity: {4} N*m}}
springs:
  S: {{links: [out, w], stiffness: {5}, damping: {6}}}
gears: {{low: [B], high: [C]}}
"""
SCENARIO = """\
case: case.yaml
duration: {0}
start: {{gear: {1}, speed: {2}}}
{3}
torques:
  in: {4}
  w: {5}
"""
EXTREMES = ["1e20", "1e-40", "1e-98", "15e90", "1e300", "1e-300", "1e12", "1e-12", "1e-6"]


class Numbers:
    """Numbers of a usual size, some of them extreme."""

    def __init__(self, rng: Random) -> None:
        self.rng, self.part = rng, rng.choice([0.02, 0.08, 0.2])

    def __call__(self, low: float, high: float) -> str:
        """One, as it is written."""
        if self.rng.random() > self.part:
            return f"{self.rng.uniform(low, high):.4g}"
        exponent = self.rng.choice([self.rng.randint(-300, 300), self.rng.randint(-20, 20)])
        return self.rng.choice([*EXTREMES, f"{self.rng.uniform(1, 9):.3g}e{exponent}"])


def random_law(rng: Random, number: Numbers) -> str:
    """A torque: by time, speed or angle, with jumps, friction, a road."""
    torque, other, size = number(1, 200), number(1, 200), number(1, 200)
    return rng.choice(
        [
            f"-{torque}",
            f"[[0, {torque}], [{number(0.1, 0.5)}, -{other}]]",
            f"{{over: speed, points: [[100, {torque}], [100, -{other}]]}}",
            f"{{over: angle, points: [[5, {torque}], [5, -{other}]]}}",
            f"{{resistance: {torque}}}",
            f'"{torque}/{other}"',
            f'"-{torque}*sign(speed - {number(0, 100)})"',
            f'"{torque}*(speed < {size})"',
            f'"{torque}*(speed < {size} + {other}*t) - {other}*sign(speed^2 - {size})"',
            f'"-{torque}*sign(speed - {number(-9, 9)}*angle - sin({number(1, 9)}*t))"',
            f'"-{torque}*tanh(speed/{number(0.1, 10)})"',
            f'"{torque}*exp({number(0, 3)}*t)"',
            f'"{torque}/(t - {number(0.1, 0.4)})"',
            f"{{road: {{mass: {size}, radius: {number(0.1, 0.5)}, rolling: 0.02, drag_area: 1}}}}",
        ]
    )


def random_texts(rng: Random) -> tuple[str, str]:
    number = Numbers(rng)
    damping = rng.choice([number(0.1, 10), f"{{ratio: {number(0.01, 0.2)}}}"])
    case = CASE.format(
        *(number(0.1, 5), number(0.1, 5), number(1.2, 3), rng.choice(["1", "0.97"])),
        *(number(50, 500), number(100, 5000), damping),
    )
    slips = f"controls: {{B: 20, C: [[0, 0], [{number(0.1, 0.5)}, {number(10, 50)}]]}}"
    shifts = f"shifts: [{{at: {number(0.05, 0.2)}, to: high, overlap: {number(0.05, 0.2)}}}]"
    moves, gear = rng.choice(["", slips, shifts]), rng.choice(["low", "high"])
    laws = random_law(rng, number), random_law(rng, number)
    return case, SCENARIO.format(number(0.2, 1), gear, number(10, 300), moves, *laws)


def floats(value: Any) -> Iterator[float]:
    if isinstance(value, dict):
        for key, one in value.items():
            yield from floats(one) if key != "stopped" else ()
    elif isinstance(value, list):
        for one in value:
            yield from floats(one)
    elif value is None or isinstance(value, float):
        yield math.nan if value is None else value


@pytest.mark.slow
@pytest.mark.parametrize("command", [("simulate", "run.yaml"), ("torsion", "modes", "case.yaml")])
@settings(max_examples=count(15, 50))
@given(seed=st.integers(0, 10**6))
def test_extreme_numbers_are_right_or_refused_where_they_stand(
    command: tuple[str, ...], seed: int
) -> None:
    """No exception, no warning of NumPy, no NaN; energy closes where a run comes to its end."""
    with TemporaryDirectory() as folder:
        for name, text in zip(("case.yaml", "run.yaml"), random_texts(seeded(seed)), strict=True):
            (Path(folder) / name).write_text(text)
        check_answer(*command[:-1], f"{folder}/{command[-1]}")


@pytest.mark.parametrize("ratio", ["1e12", "1e300"])
def test_a_damping_beside_which_all_else_is_rounding(tmp_path: Path, ratio: str) -> None:
    numbers = ("1e-300", "4", "1.8", "1", "99", "4895", f"{{ratio: {ratio}}}")
    (tmp_path / "case.yaml").write_text(CASE.format(*numbers))
    check_answer("torsion", "modes", str(tmp_path / "case.yaml"))


def check_answer(*command: str) -> None:
    """Within 10 s of the processor, a document of numbers, or errors with their places."""
    begun = process_time()
    said = vstatics(*command, "-f", "json")
    assert process_time() - begun < 10
    if said.status == 0:
        document = said.json
        assert document.get("stopped") is None
        assert all(map(math.isfinite, floats(document)))
        return
    assert said.status == 1
    errors = [line for line in said.err.splitlines() if "error:" in line]
    assert errors
    for line in errors:
        assert re.match(r"\S+\.yaml:\d+:\d+: error: ", line), line
        assert "please report" not in line
