"""Sweeps over loads, given numbers and speed ratios, by their paths and in units."""

import math
from pathlib import Path

import numpy as np
import pytest

import vstatics
from tests.chance import seeded
from tests.commands import vstatics as run
from tests.core.model.test_bare_drags import BARE
from vstatics import CaseError, Load, load, loads, solve, sweep

CASE = """
links: [in, mid, out]
mechanisms:
  a: {first: in, second: mid, ratio: -3, efficiency: .96}
  b: {first: mid, second: out, ratio: 2, efficiency: .9}
load: {speed: 2000 rpm, torque: 50 N*m}
drag: {mid: 2 N*m}
gears: {one: {torques: {mid: 4 N*m}}, two: []}
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    (tmp_path / "case.yaml").write_text(CASE)
    return tmp_path / "case.yaml"


@pytest.fixture
def case(file: Path) -> vstatics.Transmission:
    return load(file)


def test_points_of_load_are_those_of_cases_made_anew(case: vstatics.Transmission) -> None:
    """The same numbers as a loop over cases; N*m of the case stay what they are."""
    rng = seeded(2780)
    speeds = [rng.choice([-1, 1]) * rng.uniform(500, 4000) for _ in range(20)]
    torques = [rng.choice([-1, 1]) * rng.uniform(20, 90) for _ in range(20)]
    table = {"load.speed": np.array(speeds) * math.pi / 30, "load.torque": np.array(torques)}
    out = "efficiency, lossy_torques_Nm[b], drag_losses_kW, speeds_rpm[out]"
    [chunk] = vstatics.sweep(case, variants=table, out=out)
    for row, speed, torque in zip(chunk.columns, speeds, torques, strict=True):
        one = solve(case.replace(load=Load(speed, torque)))
        own = (one.efficiency, one.lossy_torques_Nm[:, 1], one.drag_losses_kW, one.speeds_rpm[:, 2])
        np.testing.assert_allclose(row, np.concatenate(own), rtol=1e-11)


def test_values_and_headings_have_the_unit_that_is_written(tmp_path: Path) -> None:
    """A constant drag T_d on the input: eta = 1 - T_d/T, whatever the speed."""
    file = tmp_path / "pair.yaml"
    file.write_text(
        "links: [in, out]\nmechanisms: {pair: {first: in, second: out, ratio: 2}}\n"
        'gears: {"1": {drag: {in: 2 N*m}}}\nload: {speed: 100 rad/s, torque: 10 N*m}\n'
    )
    vary = "--vary", "load.torque=.01 kN*m:.04 kN*m:4", "--vary", "load.speed=60 rpm"
    ran = run("sweep", file, *vary, "--out", "efficiency, k=load.torque, W_rpm[out]")
    lines = [line.split(",") for line in ran.out.splitlines()]
    assert lines[0][1:3] == ["load.torque [kN*m]", "load.speed [rpm]"]
    efficiencies = [1 - 2 / torque for torque in (10, 20, 30, 40)]
    assert [float(one[4]) for one in lines[1:]] == pytest.approx(efficiencies)
    assert [float(one[5]) for one in lines[1:]] == pytest.approx([0.01, 0.02, 0.03, 0.04])
    assert {one[6] for one in lines[1:]} == {"30"}


def test_numbers_of_gears_and_mechanisms_vary_together(case: vstatics.Transmission) -> None:
    rows = [(0.0, 0.9, 0.0), (6.0, 0.8, 3.0)]
    names = ("gears.one.torques.mid", "b.efficiency", "drag.mid")
    values = dict(zip(names, map(list, zip(*rows, strict=True)), strict=True))
    [chunk] = vstatics.sweep(case, variants=values, out="lossy_output_torque_Nm")
    one, two = case.gears
    for row, (torque, eta, drag) in zip(chunk.columns, rows, strict=True):
        shared = {2: drag / 50}
        gears = [one._replace(torques={2: torque / 50}, drag=shared), two._replace(drag=shared)]
        sets = [case.mechanisms[0], case.mechanisms[1]._replace(efficiency=eta)]
        own = solve(case.replace(gears=gears, mechanisms=sets)).lossy_output_torque_Nm
        np.testing.assert_allclose(row, own, rtol=1e-11)


def test_the_ratio_of_a_variator_varies_through_0(tmp_path: Path) -> None:
    """Speeds by hand: w_motor = -x w_in, w_out = w_motor - (w_in - w_motor)/2."""
    (tmp_path / "h.yaml").write_text(
        "links: [in, pump, motor, out]\noutput: out\ngears: {a: []}\nelements:\n"
        "  set: {kind: planetary, sun: in, ring: out, carrier: motor, teeth: {sun: 30, ring: 60}}\n"
        "mechanisms:\n  pair: {first: in, second: pump, ratio: -1}\n"
        "  hydro: {kind: variator, first: pump, second: motor, speed_ratio: .4, efficiency: .9}\n"
    )
    case = load(tmp_path / "h.yaml")
    for path in ("gears.a.speed_ratios.hydro", "hydro.speed_ratio"):
        x = np.linspace(-1, 1, 21)
        [chunk] = vstatics.sweep(case, {path: x}, out="speeds[out], speeds[motor]")
        np.testing.assert_allclose(chunk.columns[:, 1], -x, atol=1e-15)
        np.testing.assert_allclose(chunk.columns[:, 0], -x - (1 + x) / 2, atol=1e-14)
        [chunk] = vstatics.sweep(case, {"pair.ratio": [-1.0]}, out=path)
        assert chunk.columns.tolist() == [[0.4]]


def test_impossible_values_make_a_variant_invalid(case: vstatics.Transmission) -> None:
    [chunk] = vstatics.sweep(case, {"load.speed": [0.0, 100.0]}, out="ratio")
    assert chunk.counts == {"invalid": 1, "ok": 1}


def test_what_is_wrong_is_reported_at_its_place(file: Path, tmp_path: Path) -> None:
    for vary, said in {
        "load.sped=1 rpm": "expected `load.` and one of speed, torque; did you mean `load.speed`",
        "vehicle.mass=1 kg,2 kg": "numbers of `vehicle` cannot vary in a sweep of a case",
        "bearings.pin.dynamic=1 N,2 N": "numbers of `bearings` cannot vary in a sweep of a case",
        "load.torque=100..400": "a list such as 0.95,0.97; such as `100:400:50`",
        "gears.*.balance.battery=1 W": "expected `gears.*.` and one of load, speeds, torques",
        "gears.on.drag.mid=1 N*m": "did you mean `gears.one`",
        "gears.*.torques.out=1 N*m": "link out is the output",
        "load.speed=1,2": "its values need their unit, such as 2000 rpm",
        "load.speed=1 rpm,nan rpm": "1:18: error: read `nan rpm`, expected a number",
        "load.speed=1 kg,2 kg": "expected a speed with its unit, such as `rad/s`; this is a mass",
        "load.speed=1 rpm,2 rad/s": "expected one unit for all",
        "a.efficiency=.9 rpm": "read `.9 rpm`",
    }.items():
        ran = run("sweep", file, "--vary", vary, "-o", tmp_path / "out.csv")
        assert ran.gives_nothing("--vary:1:", said), vary
        assert not (tmp_path / "out.csv").exists()
    (tmp_path / "v.csv").write_text("load.speed\n1000 rpm\n")
    ran = run("sweep", file, "--variants", tmp_path / "v.csv")
    assert ran.gives_nothing("such as 2000 rpm; give the unit in brackets in the heading")
    (tmp_path / "v.csv").write_text("a.efficiency [%]\n98\n")
    ran = run("sweep", file, "--variants", tmp_path / "v.csv")
    assert ran.gives_nothing("read values in %, expected bare numbers; write each value as `98%`")
    assert "in brackets" not in ran.err
    for twice in (
        ("gears.*.torques.mid=1 N*m", "gears.one.torques.mid=2 N*m"),
        ("drag.mid=1 N*m", "gears.two.drag.mid=2 N*m"),
        ("gears.*.drag.mid=1 N*m", "drag.mid=1 N*m"),
    ):
        ran = run("sweep", file, "--vary", twice[0], "--vary", twice[1])
        assert ran.gives_nothing("is varied twice"), twice


def test_the_battery_of_all_gears_varies_at_once(tmp_path: Path) -> None:
    """What the machine takes, battery/eta, is missing at the output: 2 M w_in = P_in - P_m."""
    (tmp_path / "b.yaml").write_text(
        "links: [in, m, out]\nload: {speed: 1000 rpm, torque: 100 N*m}\noutput: out\n"
        "mechanisms:\n  a: {first: in, second: m, ratio: -1}\n"
        "  b: {first: in, second: out, ratio: -2}\n"
        "gears: {x: {balance: {m: .8, battery: 1 kW}}, y: {balance: {m: .5, battery: 2 kW}}}\n"
    )
    case, kilowatts = load(tmp_path / "b.yaml"), np.array([1.0, 2.0])
    path = "gears.*.balance.battery"
    [chunk] = vstatics.sweep(case, {path: 1e3 * kilowatts}, out="output_torque_Nm")
    speed = 1000 * math.pi / 30
    for column, efficiency in zip(chunk.columns.T, (0.8, 0.5), strict=True):
        left = 100 * speed - 1e3 * kilowatts / efficiency
        np.testing.assert_allclose(column, -left / (speed / 2), rtol=1e-9)


def test_what_is_not_varied_has_its_own_number(case: vstatics.Transmission) -> None:
    """As the document of the case has it: in rpm and N*m."""
    names = "load.speed, load.torque, drag.mid, gears.one.torques.mid, drag.out, b.efficiency"
    [chunk] = vstatics.sweep(case, {"a.ratio": [-3.0]}, out=names, where="load.torque > 5")
    assert chunk.columns.tolist() == [[2000, 50, 2, 4, 0, 0.9]]


def test_what_has_no_number_of_its_own_is_reported(file: Path) -> None:
    file.write_text(CASE.replace("two: []}", "two: [], three: {drag: {out: .01}}}"))
    for path, said in {
        "gears.two.torques.mid": "the case has no number at",
        "gears.two.load.speed": "the case has no number at",
        "gears.*.drag.out": "differs from gear to gear",
        "gears.three.drag.out": "is relative to the load",
    }.items():
        ran = run("sweep", file, "--vary", "a.ratio=-3", "--out", path)
        assert ran.gives_nothing("--out:1:1: error", said), path


def test_an_error_writes_nothing(file: Path, tmp_path: Path) -> None:
    out = tmp_path / "out.csv"
    without = CASE.replace("load: {speed: 2000 rpm, torque: 50 N*m}\n", "")
    file.write_text(without.replace(" N*m", ""))
    for more in ((), ("-o", out)):
        ran = run("sweep", file, "--vary", "a.ratio=-2", "--vary", "drag.mid=1 N*m", *more)
        assert ran.gives_nothing("--vary:1:1: error: gears.one.drag.mid varies in SI, expected a l")
        assert not out.exists()


def test_a_case_may_lack_the_load_that_varies(file: Path, tmp_path: Path) -> None:
    """4 N*m on the second link of two pairs, by hand: M_out = -(2 (-3 M_in + 4))."""
    table = tmp_path / "table.csv"
    lossless = CASE.replace(", efficiency: .96", "").replace(", efficiency: .9", "")
    lines = [line for line in lossless.splitlines() if not line.startswith(("load", "drag"))]
    file.write_text("\n".join(lines))
    table.write_text("load.torque [N*m]\n10\n-20\n")
    for vary in (("--variants", table), ("--vary", "load.torque=10 N*m,-20 N*m")):
        ran = run("sweep", file, *vary, "--out", "M=output_torque_Nm[one]")
        found = [float(line.split(",")[-1]) for line in ran.out.splitlines()[1:]]
        assert found == pytest.approx([2 * (-3 * torque + 4) for torque in (10, -20)])
    assert run("sweep", file, "--vary", "a.ratio=-2").status == 1


def test_a_note_tells_that_a_converter_is_asked_outside_its_points(file: Path) -> None:
    file.write_text(
        "links: [engine, turbine]\n"
        "mechanisms: {TC: {kind: converter, first: engine, second: turbine,"
        " points: [[.1, 2.4], [.8, 1]]}}\n"
        "gears: {drive: {speed_ratios: {TC: .5}}}\n"
    )
    for least, count in ((0.1, 0), (0.05, 1)):
        ran = run("sweep", file, "--vary", f"gears.drive.speed_ratios.TC={least},.8")
        assert ran.err.count(f"{OUTSIDE} TC, {NEAREST}") == count


OUTSIDE, NEAREST = "note: outside the points of", "the value of the nearest end point applies"


@pytest.mark.usefixtures("folder")
def test_one_note_tells_that_variants_are_outside_a_law(file: Path) -> None:
    law = "drag: {in: [[0, 1], [100, 3]]}"
    file.write_text(CASE.replace("drag: {mid: 2 N*m}", law))
    for options in ((), ("-o", "out.npz", "--jobs", "2"), ("--max", "efficiency[one]")):
        for most, is_outside in ((100, 0), (101, 1)):
            vary = "--vary", f"load.speed=50 rad/s,{most} rad/s"
            ran = run("sweep", file, *vary, "--out", "efficiency[one]", *options)
            assert (ran.status, ran.err.count(f"{OUTSIDE} in (0 to 954.93 rpm), {NEAREST}")) == (
                0,
                is_outside,
            )


def test_a_sweep_warns_once_of_a_drag_without_a_unit() -> None:
    vary = ("--vary", "load.torque=50 N*m:200 N*m:7")
    assert run("sweep", "-", *vary, stdin=BARE.encode()).err.count("has no unit") == 1


def test_relative_slip_of_a_case_varies_without_a_unit_or_with_one(tmp_path: Path) -> None:
    """The carrier of P1 turns at (w - slip)/3.5; the clutch loses P slip/w of the input power P."""
    file = tmp_path / "troll.yaml"
    file.write_text(
        "links: [in, sun, ring, out]\nshift_elements: {C: [in, sun], B: [ring, housing]}\n"
        "mechanisms: {P1: {first: sun, second: ring, third: out, ratio: -2.5}}\n"
        "gears: {troll: {engaged: [B], slip: {C: 0.5}}}\nload: {speed: 100 rad/s, torque: 10 N*m}\n"
    )
    slips = "--vary", "gears.troll.slip.C=0:0.6:3", "--vary", "load.speed=100 rad/s, 200 rad/s"
    ran = run("sweep", file, *slips, "--out", "speeds_rpm[out], slip_losses_kW[C]")
    heading, *lines = [line.split(",") for line in ran.out.splitlines()]
    assert heading[1] == "gears.troll.slip.C"
    for line, slip, speed in zip(lines, np.repeat([0, 0.3, 0.6], 2), [100, 200] * 3, strict=True):
        expected = [speed * (1 - slip) / 3.5 * 30 / math.pi, 10 * speed * slip / 1000]
        np.testing.assert_allclose([float(cell) for cell in line[4:]], expected, rtol=1e-11)
    twice = run("sweep", file, "--vary", "gears.*.slip.C=3 rpm", *slips[:2])
    assert "varied twice" in twice.err
    both = run("sweep", file, slips[0], "gears.troll.slip.C=30 rad/s", "--out", "speeds_rpm[out]")
    assert float(both.out.split(",")[-1]) == pytest.approx(70 / 3.5 * 30 / math.pi)


def test_a_case_without_a_load_can_have_laws_if_the_load_varies() -> None:
    pair = "{first: a, second: b, ratio: -2, efficiency: 0.8 + 1e-3*T + 1e-4*w}"
    text = f"links: [a, b]\nmechanisms: {{P: {pair}}}"
    speeds, torques = [100.0, 200.0], [50.0, 80.0]
    [chunk] = sweep(loads(text), {"load.speed": speeds, "load.torque": torques}, out="efficiency")
    wanted = [0.8 + 1e-3 * torque + 1e-4 * speed for speed in speeds for torque in torques]
    assert chunk.columns[:, 0].tolist() == pytest.approx(wanted)
    with pytest.raises(CaseError, match="has no speed"):
        [*sweep(loads(text), {"load.torque": torques}, out="efficiency")]
    varied = solve(loads(text), vary={"load.speed": speeds, "load.torque": torques})
    assert varied.efficiency[:, 0].tolist() == pytest.approx([wanted[0], wanted[3]])
