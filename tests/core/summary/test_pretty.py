"""`vstatics run --pretty`: one table for a person; its numbers are those of the JSON result."""

from __future__ import annotations

import re
from decimal import Decimal
from pathlib import Path

import pytest
from rich.console import Console

import vstatics as library
from tests.commands import MZKT, SHIPPED, json_answer, vstatics
from vstatics.core.summary.pretty import ASCII, DOTS, view

FREEWHEEL = """
name: two states
links: [sun, ring, carrier]
load: {speed: 1000 rpm, torque: 100 N*m}
shift_elements:
  lock-up clutch: [sun, carrier]
  sprag: {kind: freewheel, links: [ring, housing]}
elements:
  set: {kind: planetary, sun: sun, ring: ring, carrier: carrier, teeth: {sun: 30, ring: 60}}
gears:
  low: {}
  high: {engaged: [lock-up clutch]}
"""


def shown(*arguments: object, stdin: bytes = b"") -> str:
    said = vstatics("run", "--pretty", *arguments, stdin=stdin)
    assert said.status == 0
    return said.out


def gear_lines(text: str) -> list[str]:
    """The lines of the table of gears: that of the ports comes after it."""
    lines = text.splitlines()
    return lines[: next(place for place, line in enumerate(lines) if " port " in line)]


@pytest.mark.slow
@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.name)
def test_the_numbers_are_those_of_the_result(path: Path) -> None:
    text = shown(path)
    document = json_answer("run", path)
    for name in ("ratio", "efficiency"):
        for value in document[name]:
            assert value is None or shown_as(value) in text
    assert all(len(line) <= 80 for line in text.splitlines())
    assert "…" not in text


def shown_as(value: float) -> str:
    """Three digits after the point, or four significant ones below 0.1."""
    return f"{value:.3f}" if abs(value) >= 0.1 else f"{Decimal(f'{value:.3e}'):f}"


def test_steps_are_quotients_of_neighbouring_ratios() -> None:
    """The published ratios: 6.23/3.46 = 1.80, 3.46/1.80 = 1.92, 1.80/1."""
    rows = [line.split() for line in shown(MZKT).splitlines() if re.match(r" \d +[●·]", line)]
    steps = [float(row[7]) for row in rows[:3]]
    assert steps == pytest.approx([1.80, 1.92, 1.80], abs=0.005)
    assert [row[1:6] for row in rows[:2]] == [list("●··●·"), list("·●·●·")]


def test_a_freewheel_that_holds_has_a_sign_of_its_own() -> None:
    """Ring held: ratio 1 + 60/30, carrier 100 + 200*.9702 N*m, planet 30/15*(1000 - 333) rpm."""
    text = shown("-", stdin=FREEWHEEL.encode())
    low, high = (line for line in gear_lines(text) if line.startswith((" low", " high")))
    assert "1 lock-up clutch, 2 sprag" in text
    assert low.split()[:3] == ["low", "·◆", "3.000"]
    assert high.split()[:3] == ["high", "●·", "1.000"]
    assert "◆ freewheel that holds" in text
    assert "1333 set " in low
    assert "294 set.carrier" in low
    assert re.search(r"^ +largest planet$", text, re.MULTILINE)
    assert re.search(r"^ gear .* speed, rpm +largest torque, N\*m ", text, re.MULTILINE)


def test_a_terminal_without_dots_gets_letters() -> None:
    results = library.solve(library.load(MZKT))
    for marks, sign in ((ASCII, "x"), (DOTS, "●")):
        console = Console(width=80)
        with console.capture() as captured:
            console.print(view(results, marks))
        assert sign in captured.get()


def test_a_shift_element_called_largest_stays_with_the_shift_elements() -> None:
    """In a narrow window the largest values get a table of their own."""
    text = FREEWHEEL.replace("lock-up clutch", "largest")
    console = Console(width=60)
    with console.capture() as captured:
        console.print(view(library.solve(library.loads(text)), DOTS, width=60))
    first, second = (line for line in gear_lines(captured.get()) if " high" in line)
    assert first.split()[:4] == ["high", "●", "·", "1.000"]
    assert "●" not in second


def test_gears_without_numbers_say_why() -> None:
    lock = "links: 2\nshift_elements: {B: [1, 0]}\nmechanisms: {P: {first: 1, second: 2, ratio: 2}}"
    said = vstatics(
        "run", "--pretty", "-", stdin=f"{lock}\ngears: {{1: {{engaged: [B]}}}}".encode()
    )
    assert said.status == 1
    assert "tied up" in said.out


STATES = """
links: [in, s, r, out]
shift_elements: {A: [in, s], B: [r, housing], C: [in, r], D: [in, out], P: [out, housing]}
mechanisms: {set: {first: s, second: r, third: out, ratio: -2.5, efficiency: 0.97}}
gears:
  direct: {engaged: [A, C]}
  low: {engaged: [A, B]}
  excess: {engaged: [A, C, D]}
  neutral: {engaged: [B]}
  park: {engaged: [A, P]}
  tied: {engaged: [A, B, C]}
"""


def test_states_of_gears_are_named_and_explained() -> None:
    said = vstatics("run", "--pretty", "-", stdin=STATES.encode())
    for gear, state in (("neutral", "neutral"), ("park", "output at rest"), ("tied", "tied up")):
        [line] = [line for line in gear_lines(said.out) if line.startswith(f" {gear} ")]
        assert line.rstrip().endswith(f"  {state}")
        assert f"\n{state}: " in said.out


def rows() -> dict[str, list[str]]:
    """The words of each gear."""
    text = vstatics("run", "--pretty", "-", stdin=STATES.encode()).out
    lines = [line.split() for line in gear_lines(text) if line.startswith(" ")]
    return {words[0]: words for words in lines if words}


def test_steps_are_those_of_the_summary() -> None:
    """From low, 3.5, to direct, whatever the order in the case."""
    made = json_answer("summary", "-", stdin=STATES.encode())
    assert [one["step"] for one in made["gears"][:2]] == [pytest.approx(1), pytest.approx(3.5)]
    assert rows()["direct"][2:4] == ["1.000", "1.000"]
    assert rows()["low"][2:4] == ["3.500", "3.500"]


def test_a_largest_torque_is_given_only_where_all_are_known() -> None:
    """In low the carrier has 1/3.5, the brake 2.5*.97; s has 4/3 of the teeth of the planet."""
    assert rows()["excess"][-2:] == ["0", "set"]
    assert rows()["low"][-4:] == ["0.95", "set", "2.42", "B"]


def test_names_in_brackets_are_names() -> None:
    text = STATES.replace("direct:", '"[/]":').replace("set:", '"[red]set":')
    said = vstatics("run", "--pretty", "-", stdin=text.encode())
    assert "\n [/]" in said.out
    assert "[red]set" in said.out


def test_a_bad_case_does_not_stop_the_others() -> None:
    said = vstatics("run", "--pretty", "tests/bad/efficiency-0.dat", MZKT)
    assert said.status == 1
    assert "6.230" in said.out


def test_small_torques_of_a_dragged_gear_are_shown_and_rounding_is_not() -> None:
    """The output turns the input by 2 x .02 N*m; beside 1000 N*m .00000002 is nothing."""
    case = b"""\
links: [in, out]
mechanisms: {pair: {first: in, second: out, ratio: 2}}
gears:
  small: {load: {speed: 3000 rpm, torque: 0 N*m}, drag: {in: 0.02 N*m}}
  large: {load: {speed: 3000 rpm, torque: 1000 N*m}, drag: {in: 1000 N*m, out: 0.00000002 N*m}}
"""
    text = shown("-", "--from", "yaml", stdin=case)
    small = next(line for line in text.splitlines() if " small " in line)
    assert small.split()[-3:] == ["0.02000", "pair", "back-driven"]
    ports = text.splitlines()[len(gear_lines(text)) :]
    assert [line.split()[2] for line in ports if line.split()[:1] == ["out"]] == ["-0.04000", "0.0"]


HUB = """\
links: [cog, sun, ring]
output: ring
shift_elements: {{lock: [cog, ring], B: [sun, housing]}}
mechanisms: {{set: {{first: sun, second: ring, third: cog, ratio: {ratio}}}}}
gears: {{fast: [B], direct: [lock]}}
"""


@pytest.mark.parametrize("ratio", [-1.5, -2.5, -3.2, -9.0])
def test_a_ratio_below_1_is_shown_as_output_over_input_too(ratio: float) -> None:
    """The ring turns at 1 - 1/u of the carrier where the sun is held."""
    text = shown("-", stdin=HUB.format(ratio=ratio).encode())
    assert f"1/i = output speed / input speed; gear fast: {1 - 1 / ratio:.3f}\n" in text


def test_gears_that_are_slower_than_their_input_have_no_inverse() -> None:
    assert "1/i" not in shown(MZKT)


def test_planets_without_teeth_are_named() -> None:
    [case] = (path for path in SHIPPED if path.name == "ravigneaux-aod.yaml")
    text = case.read_text("utf-8").replace(", short: 18", "")
    said = shown("-", stdin=text.encode())
    assert "planet speed: relative to its carrier; not determined: set.short" in said


def test_a_self_locking_gear_has_no_torque() -> None:
    """A worm with back efficiency 0, driven by the wheel: torques with losses do not exist."""
    worm = """
input: m
output: drum
load: {speed: 1400 rpm, power: 2 kW}
elements:
  W: {kind: worm, worm: m, wheel: drum, teeth: {worm: 1, wheel: 40},
      efficiency: {worm: 0.55, wheel: 0}}
"""
    line = next(
        line for line in gear_lines(shown("-", "--coast", stdin=worm.encode())) if "40.0" in line
    )
    assert line.split() == ["1", "40.000", "-", "-", "1400", "m", "self-locking"]
