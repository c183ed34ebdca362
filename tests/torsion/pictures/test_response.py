"""Responses: their lines are the amplitudes that `torsion response` calculates."""

from pathlib import Path

import numpy as np
import pytest

from tests.commands import CASES, json_answer, vstatics
from tests.pictures import drawn as said
from tests.shipped import shipped_results
from tests.torsion.pictures.marks import drawn, marks, plotted
from vstatics import Damping, Gear, Load, Spring, Transmission, solve
from vstatics.pictures import picture
from vstatics.pictures.drawing.style import Excitation, Style
from vstatics.torsion.forced.harmonic_torques import Harmonic
from vstatics.torsion.pictures.orders.response_lines import response_panels

AT_WHEELS = Style(excited=Excitation(orders=(2.0, 4.0), at="wheels"))
DRIVELINE = "driveline-8hp70.yaml"


@pytest.mark.parametrize(
    ("name", "style", "gear", "at"),
    [
        ("moskvich412.yaml", Style(), 3, "engine"),
        ("moskvich412.yaml", AT_WHEELS, 1, "wheels"),
        (DRIVELINE, Style(), 6, "engine"),
    ],
)
def test_lines_are_those_of_the_command(name: str, style: Style, gear: int, at: str) -> None:
    results = shipped_results(name)
    _, [panel] = response_panels(results, style, [gear])
    assert panel.link == at
    for line in panel.lines:
        some = line.speeds[::7].tolist()
        options = ("--at", at, "--orders", f"{line.order.number:g}", "--gear", f"#{gear}")
        call = ("response", CASES / name, *options, "--speed", ",".join(map(repr, some)))
        [found] = json_answer("torsion", *call)["gears"]
        amplitudes = found["orders"][0]["amplitudes"][at]
        expected = dict(zip(found["speeds"], amplitudes, strict=True))
        assert line.amplitudes[::7] == pytest.approx([expected[n] for n in some], rel=1e-9)
        peaks = {met.speed for met in panel.peaks if met.order == line.order}
        assert {round(one, 6) for one in peaks} <= {round(one, 6) for one in line.speeds}
    assert len(panel.peaks) > 5


@pytest.mark.parametrize("gear", [2, 9])
def test_what_is_drawn_is_the_logarithm_over_the_speed(gear: int) -> None:
    """Each line in SVG, moved and stretched alike, lies on those numbers."""
    results = shipped_results(DRIVELINE)
    _, [panel] = response_panels(results, Style(), [gear])
    lines = marks(drawn(results, "response", Style(), gear), "line")
    assert [float(one.data["order"]) for one in lines] == [0.5, 1.0, 3.0, 6.0]
    assert [one.data["firing"] for one in lines] == ["false", "false", "true", "true"]
    ends = []
    for mark, line in zip(lines, panel.lines, strict=True):
        x, y = np.array(mark.points).T
        # paths are cut at the edges, and simplified: their points lie on the line
        ends.append((float(np.interp(x.max(), x, y)), np.log10(line.amplitudes[-1])))
    heights, logs = np.array(ends).T
    slope, start = np.polyfit(logs[:3], heights[:3], 1)
    assert slope < 0
    assert heights[:3] == pytest.approx(slope * logs[:3] + start, abs=0.02)


@pytest.mark.parametrize(
    ("shown", "runs"), [((600, 3000), False), ((600, 4000), True), ((5000, 6000), False)]
)
def test_the_legend_names_no_running_speed_outside_the_picture(
    shown: tuple[float, float], runs: bool
) -> None:
    """The load of the case is at 4000 rpm."""
    style = Style(excited=Excitation(shown=shown))
    texts = said.texts(picture(shipped_results(DRIVELINE), "response", style, [6]))
    assert ("the input runs at 4000 rpm" in texts) is runs


def test_there_is_a_panel_for_each_gear_and_a_line_for_each_order(tmp_path: Path) -> None:
    svg = plotted(tmp_path, CASES / DRIVELINE, "-k", "response", "--orders", "3,1.5")
    panels = marks(svg, "panel")
    assert [one.data["gear"] for one in panels] == [*"12345678R"]
    assert [one.data["order"] for one in marks(svg, "line")] == ["1.5", "3"] * 9


def test_each_gear_is_excited_at_its_own_input() -> None:
    """Order 6 meets 200 rad/s, sqrt(3000 (1/0.1 + 1/0.3)), at 318 rpm, far below 9000 rpm."""
    springs = [Spring({1: 1, 2: -1}, 3000.0, damping=Damping(viscous=1.0), name="shaft")]
    gears = [Gear(), Gear(input=2, output=1, load=Load(speed=9000.0))]
    twins = solve(Transmission(2, [], [], gears, springs=springs, inertias={1: 0.1, 2: 0.3}))
    _, panels = response_panels(twins, Style())
    assert [one.link for one in panels] == ["1", "2"]
    heading = said.texts(picture(twins, "response", Style()))[0]
    assert heading == "Amplitude of the input by a torque of 1 N·m on it"
    sixth = Style(excited=Excitation(orders=(6.0,)))
    assert "6×, mode 1: 318 rpm" in drawn(twins, "response", sixth).decode()


def test_orders_of_another_link_do_not_fire() -> None:
    results = shipped_results("moskvich412.yaml")
    lines = marks(drawn(results, "response", AT_WHEELS, 1), "line")
    assert [one.data for one in lines] == [{"order": n, "firing": "false"} for n in ("2", "4")]


def test_another_link_must_be_one_that_turns(tmp_path: Path) -> None:
    options = ("-k", "response", "-o", tmp_path / "a.svg", "--at")
    result = vstatics("plot", CASES / "moskvich412.yaml", *options, "wheel")
    assert result.is_wrong_use("no link 'wheel'; did you mean `wheels`?")
    held = """\
links: [a, b, c]
output: b
inertias: {a: 1, b: 1, c: 1}
springs: {s: {links: [a, b], stiffness: 100}}
shift_elements: {B: [c, housing]}
gears: {one: [B]}
"""
    result = vstatics("plot", "-", *options, "c", stdin=held.encode())
    assert result.fails("error: no response in gear one: link c stands still")


def test_a_line_is_as_high_as_its_order_of_the_torque(tmp_path: Path) -> None:
    """The response is linear: 150 N*m of order 2 against 1 N*m; orders can be chosen."""
    table = tmp_path / "engine.csv"
    table.write_text("order,amplitude [N*m],phase [rad]\n2,150,0\n4,40,0.5\n")
    results = shipped_results("moskvich412.yaml")
    torques = [Harmonic(2.0, 150.0), Harmonic(4.0, 40.0, 0.5)]
    excited = Excitation(orders=(2.0, 4.0))
    _, [unit] = response_panels(results, Style(excited=excited), [4])
    _, [given] = response_panels(results, Style(data=torques), [4])
    for one, other, torque in zip(unit.lines, given.lines, torques, strict=True):
        np.testing.assert_allclose(other.amplitudes, torque.amplitude * one.amplitudes, rtol=1e-12)
    asked = ("plot", CASES / "moskvich412.yaml", "-k", "response", "--gear", "4")
    named = "each order of the torque"
    to = tmp_path / "r.svg"
    assert vstatics(*asked, "--torque", table, "-o", to).status == 0
    assert named in to.read_text()
    assert vstatics(*asked, "--torque", table, "--orders", "3", "-o", to).fails("no order 3")
    table.write_text("order,amplitude\n-2,150\n")
    assert vstatics(*asked, "--torque", table, "-o", to).fails("engine.csv:2:1: error: order")
    assert vstatics(*asked[:3], "campbell", "--torque", table, "-o", to).is_wrong_use(
        "only response"
    )
