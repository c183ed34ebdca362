"""Cases as Modelica, compiled and run by another program, Rumoca, beside ours.

It has no standard library, so `modelica/Modelica.mo` stands in for it: the names and equations of
the components, but friction is smoothed, straight to its full torque at a slip of 1e-4 rad/s.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.commands import CASES
from tests.summary.test_inertia import ACCELERATIONS
from tests.writers.modelica_system import IDENTIFIER
from vstatics import Transmission, load, load_scenario, loads, simulate
from vstatics.writers import modelica
from vstatics.writers.modelica_models import identifier

rumoca = pytest.importorskip("rumoca")

LIBRARY = (Path(__file__).parent / "modelica" / "Modelica.mo").read_text(encoding="utf-8")
SOURCE = "Modelica.Mechanics.Rotational.Sources.Torque"


def compiled(
    case: Transmission,
    controls: Mapping[str, object],
    torques: Mapping[str, object],
    start: Mapping[str, float] | None = None,
) -> Any:
    """A case with controls of shift elements, 0 if not given, torques on links, first speeds.

    Controls and torques are numbers or expressions of Modelica.
    """
    text = modelica.write(case)
    package = text.split()[1]
    known = {identifier(f"control_{name}"): control for name, control in controls.items()}
    inputs = re.findall(rf"RealInput ({IDENTIFIER})\(unit", text)
    assert set(known) <= set(inputs)
    run = [
        f"model Run\n  {package}.Gearbox box;",
        *(f"  {SOURCE} source{number};" for number in range(len(torques))),
        "equation",
        *(f"  box.{name} = {known.get(name, 0)};" for name in inputs),
        *(f"  source{number}.tau = {torque};" for number, torque in enumerate(torques.values())),
        *(
            f"  connect(source{number}.flange, box.{identifier(link)});"
            for number, link in enumerate(torques)
        ),
        "initial equation",
        *(f"  box.{name} = {speed};" for name, speed in (start or {}).items()),
        "end Run;",
    ]
    whole = LIBRARY + text + "\n".join(run)
    return rumoca.Session().loads(whole, model="Run", filename="run.mo")


def run(
    case: Transmission,
    controls: Mapping[str, object],
    torques: Mapping[str, object],
    *,
    duration: float = 1.0,
    start: Mapping[str, float] | None = None,
) -> dict[str, list[float]]:
    """Every variable at 51 times, and some between; the times are `time`."""
    config = rumoca.SimConfig(rtol=1e-9, atol=1e-9)
    model = compiled(case, controls, torques, start)
    result = model.simulate((0.0, duration), dt=duration / 50, config=config)
    return {"time": list(result.time)} | {name: list(result[name]) for name in result.names}


def last(found: Mapping[str, list[float]], name: str) -> float:
    return found[f"box.{name}"][-1]


BOX = load(CASES / "tarasik-box.yaml")


@pytest.mark.parametrize(
    "gear",
    [gear if gear == "1" else pytest.param(gear, marks=pytest.mark.slow) for gear in ACCELERATIONS],
)
def test_the_box_of_seven_links_gains_speed_as_published(gear: str) -> None:
    engaged = BOX.gears[BOX.gear_number(gear) - 1].engaged
    controls = {BOX.shift_elements[n - 1].name: 9e3 for n in engaged}
    found = run(BOX, controls, {"in": 1500, "out": -1200})
    assert last(found, "J_in.w") == pytest.approx(ACCELERATIONS[gear], rel=2e-6)


@pytest.mark.slow
def test_two_shifts_of_the_box() -> None:
    """The published speeds at 3 and 6 s, and our run of the same scenario at all times."""
    controls = {
        "FH": "if time < 2 then 3000 elseif time < 4 then 0 elseif time < 4.3 "
        "then (time - 4)/0.3*3000 else 3000",
        "FB": "if time < 1.9 then 0 elseif time < 2.2 then (time - 1.9)/0.3*3000 "
        "elseif time < 4 then 3000 else 0",
        "F1": "if time < 0.4 then time/0.4*9000 elseif time < 4.05 then 9000 else 0",
        "F2": "if time < 3.9 then 0 elseif time < 4.3 then (time - 3.9)/0.4*6000 else 6000",
    }
    start = {"J_in.w": 60.0, "J_a0.w": 60.0, "J_out.w": 0.0}
    torques = {"in": 1500, "out": "-1200*tanh(box.J_out.w/0.05)"}
    found = run(BOX, controls, torques, duration=6, start=start)

    def theirs(time: float) -> dict[str, float]:
        instant = np.flatnonzero(np.isclose(found["time"], time))[-1]
        return {link: found[f"box.J_{link}.w"][instant] for link in BOX.link_names}

    for time, speeds in {3: (388.0379, 144.7903), 6: (513.4905, 255.4615)}.items():
        assert (theirs(time)["in"], theirs(time)["out"]) == pytest.approx(speeds, abs=6e-5)
    motion = simulate(load_scenario(CASES / "scenarios" / "tarasik-box.yaml"), step=6 / 50)
    for place in range(51):
        instant = np.flatnonzero(np.isclose(motion.time, place * 6 / 50))[-1]
        ours = dict(zip(motion.links, motion.speeds[instant].tolist(), strict=True))
        assert theirs(place * 6 / 50) == pytest.approx(ours, abs=1e-3)


def test_a_brake_locks_a_set() -> None:
    """Tarasik's set from 500 rpm: the exact state one second later, friction smoothed."""
    case = load(CASES / "tarasik-set.yaml")
    start = {"J_sun.w": 500 * math.pi / 30, "J_carrier.w": 0.0}
    found = run(case, {"brake": 120}, {"sun": 40, "carrier": -60}, start=start)
    assert last(found, "J_sun.w") == pytest.approx(67.165507611, rel=1e-5)
    assert last(found, "J_carrier.w") == pytest.approx(26.866203045, rel=1e-5)


def test_a_freewheel_holds_one_way() -> None:
    """On the housing the link is held from turning backward: 20 N*m against 12 N*m of the pair."""
    case = loads("""
inertias: {engine: 0.5, out: 2}
shift_elements: {F: {kind: freewheel, links: [out, housing]}}
mechanisms: {pair: {first: engine, second: out, ratio: 2}}
""")
    assert last(run(case, {}, {"engine": 6, "out": -20}), "J_out.w") == pytest.approx(0, abs=1e-5)
    forward = last(run(case, {}, {"engine": 6, "out": -2}), "J_out.w")
    assert forward == pytest.approx((2 * 6 - 2) / (2 + 4 * 0.5), rel=1e-6)


def test_a_twist_of_three_links_swings() -> None:
    """One mass on ``2 w - 3 w`` of two links, one of them held: omega = 2 sqrt(c/J)."""
    case = loads("""
links: [mass, held, free]
inertias: {mass: 0.5, held: 3, free: 1}
shift_elements: {B: [held, housing]}
mechanisms: {pair: {first: free, second: held, ratio: 1}}
springs: {twist: {twist: {mass: 2, held: -3, free: 1}, stiffness: 50}}
""")
    found = run(case, {"B": 1e4}, {}, start={"J_mass.w": 1.0}, duration=0.4)
    assert last(found, "J_mass.w") == pytest.approx(math.cos(2 * 10 * 0.4), abs=1e-4)


def test_a_friction_pack_has_the_torque_of_its_pressure() -> None:
    """2e5 Pa on 60 cm^2 at .1 m, 8 surfaces of .12: 115.2 N*m, which take 0.5 kg*m^2 along."""
    case = loads("""
inertias: {a: 1, b: 0.5}
shift_elements:
  C: {links: [a, b], friction: {radius: .1, area: 60 cm^2, surfaces: 8, coefficient: .12}}
""")
    found = run(case, {"C": 2e5}, {}, start={"J_a.w": 400.0})
    assert last(found, "J_b.w") == pytest.approx(115.2 / 0.5, rel=1e-6)
    assert last(found, "J_a.w") == pytest.approx(400 - 115.2, rel=1e-6)


def test_planets_are_moved() -> None:
    """Sun 30 in, ring 90 held, carrier out at 1/4, where planets of 30 turn by -1/2."""
    case = loads("""
links: [sun, ring, carrier]
inertias: {sun: 0.5, ring: 1, carrier: 2}
elements:
  P: {kind: planetary, sun: sun, ring: ring, carrier: carrier, teeth: {sun: 30, ring: 90},
      planets: 4, planet: {inertia: 1e-1, mass: 5, radius: 0.1}}
shift_elements: {B: [ring, housing]}
gears: {low: [B]}
""")
    found = run(case, {"B": 1e4}, {"sun": 60})
    inertia = 0.5 + 2 * 0.25**2 + 4 * (0.1 * 0.5**2 + 5 * 0.1**2 * 0.25**2)
    assert last(found, "J_sun.w") == pytest.approx(60 / inertia, rel=1e-5)


@pytest.mark.slow
@pytest.mark.parametrize("file", sorted(path.name for path in CASES.glob("*.yaml")))
def test_every_shipped_case_is_compiled(file: str) -> None:
    """As many equations as unknowns: the compiler refuses others."""
    assert compiled(load(CASES / file), {}, {}).name == "Run"
