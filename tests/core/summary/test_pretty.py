"""`vstatics run --pretty`: one table for a person; its numbers are those of the JSON result."""

import re
from decimal import Decimal
from pathlib import Path

import pytest
from rich.console import Console

import vstatics as library
from tests.commands import BAD, CASES, MZKT, SHIPPED, TIED_UP, json_answer, vstatics
from vstatics.core.summary.pretty import ASCII, DOTS, view

FREEWHEEL = """
name: two states
links: [sun, ring, carrier]
load: {speed: 1000 rpm, torque: 100 N*m}
shift_elements: {lock-up clutch: [sun, carrier], sprag: {kind: freewheel, links: [ring, housing]}}
elements:
  set: {kind: planetary, sun: sun, ring: ring, carrier: carrier, teeth: {sun: 30, ring: 60}}
gears: {low: {}, high: [lock-up clutch]}
"""
STATES = """
links: [in, s, r, out]
shift_elements: {A: [in, s], B: [r, housing], C: [in, r], D: [in, out], P: [out, housing]}
mechanisms: {set: {first: s, second: r, third: out, ratio: -2.5, efficiency: 0.97}}
gears: {direct: [A, C], low: [A, B], excess: [A, C, D], neutral: [B], park: [A, P], tied: [A, B, C]}
"""
HUB = """\
links: [cog, sun, ring]
output: ring
shift_elements: {{lock: [cog, ring], B: [sun, housing]}}
mechanisms: {{set: {{first: sun, second: ring, third: cog, ratio: {ratio}}}}}
gears: {{fast: [B], direct: [lock]}}
"""


def shown(text: str, status: int = 0) -> str:
    said = vstatics("run", "--pretty", "-", "--from", "yaml", stdin=text.encode())
    assert said.status == status
    return said.out


def gear_lines(text: str) -> list[str]:
    """The lines of the table of gears: that of the ports comes after it, if at all."""
    lines = text.splitlines()
    places = (place for place, line in enumerate(lines) if " port " in line)
    return lines[: next(places, len(lines))]


def rows(text: str) -> dict[str, list[str]]:
    lines = [line.split() for line in gear_lines(text) if line.startswith(" ")]
    return {words[0]: words for words in lines if words}


@pytest.mark.slow
@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.name)
def test_the_numbers_are_those_of_the_result(path: Path) -> None:
    """Three digits after the point, or four significant ones below 0.1."""
    text = vstatics("run", "--pretty", path).out
    document = json_answer("run", path)
    for value in (*document["ratio"], *document["efficiency"]):
        if value is not None:
            small = f"{Decimal(f'{value:.3e}'):f}"
            assert (f"{value:.3f}" if abs(value) >= 0.1 else small) in text
    assert all(len(line) <= 80 for line in text.splitlines())
    assert "…" not in text


def test_steps_are_quotients_of_neighbouring_ratios() -> None:
    """The published ratios: 6.23/3.46 = 1.80, 3.46/1.80 = 1.92, 1.80/1; none is below 1."""
    text = vstatics("run", "--pretty", MZKT).out
    found = [line.split() for line in text.splitlines() if re.match(r" \d +[●·]", line)]
    assert [float(row[7]) for row in found[:3]] == pytest.approx([1.80, 1.92, 1.80], abs=0.005)
    assert [row[1:6] for row in found[:2]] == [list("●··●·"), list("·●·●·")]
    assert "1/i" not in text


def test_a_freewheel_that_holds_has_a_sign_of_its_own() -> None:
    """Ring held: ratio 1 + 60/30, carrier 100 + 200*.9702 N*m, planet 30/15*(1000 - 333) rpm.

    A clutch that slips by 0.3 of the input speed, i = 1/(1 - 0.3), has another.
    """
    text = shown(FREEWHEEL)
    low, high = (line for line in gear_lines(text) if line.startswith((" low", " high")))
    assert "1 lock-up clutch, 2 sprag" in text
    assert low.split()[:3] == ["low", "·◆", "3.000"]
    assert high.split()[:3] == ["high", "●·", "1.000"]
    assert "◆ freewheel that holds" in text
    assert "1333 set " in low
    assert "294 set.carrier" in low
    assert re.search(r"^ +largest planet$", text, re.MULTILINE)
    assert re.search(r"^ gear .* speed, rpm +largest torque, N\*m ", text, re.MULTILINE)
    slipping = shown(FREEWHEEL.replace("low: {}", "low: {slip: {lock-up clutch: 300 rpm}}"))
    assert rows(slipping)["low"][1:3] == ["~·", "1.429"]
    assert "~ slips" in slipping


def test_a_shift_element_called_largest_stays_with_the_shift_elements() -> None:
    """In a narrow window the largest values get a table of their own; without dots, letters."""
    results = library.solve(library.loads(FREEWHEEL.replace("lock-up clutch", "largest")))
    for marks, sign in ((ASCII, "x"), (DOTS, "●")):
        console = Console(width=60)
        with console.capture() as captured:
            console.print(view(results, marks, width=60))
        first, second = (line for line in gear_lines(captured.get()) if " high" in line)
        assert first.split()[1:4:2] == [sign, "1.000"]
        assert sign not in second


def test_states_of_gears_are_named_and_explained() -> None:
    text = shown(STATES, status=1)
    for gear, state in (("neutral", "neutral"), ("park", "output at rest"), ("tied", "tied up")):
        [line] = [line for line in gear_lines(text) if line.startswith(f" {gear} ")]
        assert line.rstrip().endswith(f"  {state}")
        assert f"\n{state}: " in text
    assert "tied up" in shown(TIED_UP, status=1)


def test_a_largest_torque_is_given_only_where_all_are_known() -> None:
    """In low the carrier has 1/3.5, the brake 2.5*.97; s has 4/3 of the teeth of the planet."""
    found = rows(shown(STATES, status=1))
    assert found["excess"][-2:] == ["0", "set"]
    assert found["low"][-4:] == ["0.95", "set", "2.42", "B"]


def test_names_in_brackets_are_names() -> None:
    text = shown(STATES.replace("direct:", '"[/]":').replace("set:", '"[red]set":'), status=1)
    assert "\n [/]" in text
    assert "[red]set" in text


def test_a_bad_case_does_not_stop_the_others() -> None:
    said = vstatics("run", "--pretty", "-", MZKT, stdin=BAD.encode())
    assert (said.status, "6.230" in said.out) == (1, True)


def test_small_torques_of_a_dragged_gear_are_shown_and_rounding_is_not() -> None:
    """The output turns the input by 2 x .02 N*m; beside 1000 N*m .00000002 is nothing."""
    text = shown("""\
links: [in, out]
mechanisms: {pair: {first: in, second: out, ratio: 2}}
gears:
  small: {load: {speed: 3000 rpm, torque: 0 N*m}, drag: {in: 0.02 N*m}}
  large: {load: {speed: 3000 rpm, torque: 1000 N*m}, drag: {in: 1000 N*m, out: 0.00000002 N*m}}
""")
    assert rows(text)["small"][-3:] == ["0.02000", "pair", "back-driven"]
    ports = text.splitlines()[len(gear_lines(text)) :]
    assert [line.split()[2] for line in ports if line.split()[:1] == ["out"]] == ["-0.04000", "0.0"]


def test_a_ratio_below_1_is_shown_as_output_over_input_too() -> None:
    """The ring turns at 1 - 1/u of the carrier where the sun is held."""
    for ratio in (-1.5, -2.5, -3.2, -9.0):
        words = f"1/i = output speed / input speed; gear fast: {1 - 1 / ratio:.3f}\n"
        assert words in shown(HUB.format(ratio=ratio))


def test_planets_without_teeth_are_named() -> None:
    said = shown((CASES / "ravigneaux-aod.yaml").read_text("utf-8").replace(", short: 18", ""))
    assert "planet speed: relative to its carrier; not determined: set.short" in said


def test_a_self_locking_gear_has_no_torque() -> None:
    """A worm with back efficiency 0, driven by the wheel: torques with losses do not exist."""
    text = shown("""{input: m, output: drum, load: {speed: 1400 rpm, power: 2 kW}, coast: true,
elements: {W: {kind: worm, worm: m, wheel: drum, teeth: {worm: 1, wheel: 40},
efficiency: {worm: 0.55, wheel: 0}}}}""")
    line = next(line for line in gear_lines(text) if "40.0" in line)
    assert line.split() == ["1", "40.000", "-", "-", "1400", "m", "self-locking"]
    assert " port " not in text


def test_ports_are_shown_if_they_have_more_than_ratio_and_efficiency() -> None:
    """Without load M2/M1 = i*eta and P2/P1 = eta; a speed, a slip or a third port adds numbers."""
    text = shown(STATES, status=1)
    assert gear_lines(text) == text.splitlines()
    for more in ("load: {speed: 900 rpm}\n", "drag: {s: 0.1}\n"):
        assert " port " in shown(more + STATES, status=1)


def test_the_headings_of_a_long_table_are_repeated_below_it() -> None:
    """Seven gears have 21 lines of ports, more than the usual 24 lines of a terminal leave."""
    for number, times in ((6, 1), (7, 2)):
        gears = ", ".join(f"{gear}: {{}}" for gear in range(number))
        text = shown(f"{FREEWHEEL.partition('gears:')[0]}gears: {{{gears}}}\n")
        assert len(re.findall("^ gear  port .*$", text, re.MULTILINE)) == times
    assert text.splitlines()[-1].startswith(" gear  port ")


def test_the_legend_says_which_numbers_are_relative() -> None:
    """With a speed alone, planet speeds are in rpm, and only torques are relative."""
    for load, words in (
        ("", ["1.00 is the input speed or torque"]),
        ("load: {speed: 1000 rpm}\n", ["1.00 is the input torque"]),
        ("load: {speed: 1000 rpm, torque: 90 N*m}\n", []),
    ):
        assert re.findall("1.00 is .*", shown(HUB.format(ratio=-2) + load)) == words


def test_the_legend_explains_the_signs_of_torques_on_further_ports() -> None:
    """Power P = M w of a link that holds the carrier at speed is negative where it goes out."""
    signs = "torque of an output: on its load; of other ports: on their links"
    text = """\
links: [engine, motor, axle]
mechanisms: {split: {first: motor, second: axle, third: engine, ratio: -2.6}}
gears: {drive: {engaged: [], speeds: {motor: 1.5}}}
"""
    assert signs in shown(text)
    assert signs not in shown(HUB.format(ratio=-2))
