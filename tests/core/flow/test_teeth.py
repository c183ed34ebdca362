"""Tooth power: against the carrier, by mechanism and by mesh."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given

from tests.commands import SHIPPED, json_answer
from tests.core.flow.worked import only, sides, solved
from tests.shipped import shipped_results
from tests.trains import regular_trains, trains
from vstatics import Gear, Mechanism, ShiftElement, Transmission, loads, solve
from vstatics.core.flow.power import flows
from vstatics.core.flow.power_flow import PowerFlow
from vstatics.core.flow.rows import flow_grids
from vstatics.core.flow.tables import power_grid
from vstatics.core.summary.sensitivity import sensitivities


def teeth(side: PowerFlow) -> dict[str, float]:
    """Tooth powers by mechanism and mesh."""
    return {f"{one.device} {one.mesh}".strip(): one.power for one in side.teeth}


@pytest.mark.parametrize("u", [-4.0, -1.2, 2.0, 0.5])
def test_with_the_ring_held_it_is_what_the_carrier_leaves(u: float) -> None:
    """The carrier turns at 1/(1 - u), the sun against it at -u/(1 - u), with the torque 1.

    For u of .5 the carrier is faster than the sun, and power enters the teeth by the ring.
    """
    sets = [Mechanism(1, 2, 3, u, 0.96, name="set")]
    ideal, lossy = sides(only(Transmission(3, [ShiftElement(2)], sets, [Gear([1])])))
    assert teeth(ideal) == pytest.approx({"set": abs(u / (1 - u))})
    assert lossy.lost == pytest.approx(0.04 * teeth(lossy)["set"])


def test_a_self_locking_train_has_many_times_the_input_power_in_its_teeth() -> None:
    """Carrier in, ring held, other ring out, u = 1.004 (cases/self-locking.yaml), by hand.

    The ring that goes out turns at (u - 1)/u, against the carrier at -1/u; its torque is
    u/(u - 1). So 1/(u - 1) = 250 times the input power goes through the teeth.
    """
    ideal = flows(shipped_results("self-locking.yaml"))[0].ideal
    assert ideal is not None
    assert list(teeth(ideal).values()) == [pytest.approx(250)]


def test_a_wolfrom_reducer_has_sixty_times_the_input_power_in_its_teeth() -> None:
    """Sun 10, planets 23 and 21, held ring 56, ring 52 out.

    The carrier turns at w_c = 10/66. Against it the output ring turns at -I w_c with
    I = (56/23)(21/52), so at (1 - I) w_c in all; its torque is 1/w_out. Between ring and
    planet go I/(1 - I) = 1176/20 times the input power, by the sun 1 - w_c = 56/66, and by
    the held ring both together.
    """
    [flow] = flows(shipped_results("wolfrom.yaml"))
    ideal, _ = sides(flow)
    meshes = {"set sun-planet": 56 / 66, "set ring-planet": 58.8 + 56 / 66}
    meshes |= {"set": 58.8 + 56 / 66, "set ring2-planet": 58.8}
    assert teeth(ideal) == pytest.approx(meshes)


RAVIGNEAUX = """
links: [small, large, ring, carrier]
output: ring
shift_elements: {C: [carrier, housing]}
elements:
  set:
    kind: ravigneaux
    small_sun: small
    large_sun: large
    ring: ring
    carrier: carrier
    teeth: {small_sun: 30, large_sun: 36, ring: 84, short: 22, long: 24}
    mesh_efficiency: {external: .98, internal: .99}
load: {speed: 955 rpm, torque: 100 N*m}
gears: {low: {engaged: [C]}}
"""


MESHES = ("small_sun-short", "large_sun-long", "ring-long", "short-long")


def test_each_mesh_of_a_ravigneaux_set_takes_its_part() -> None:
    """The carrier is held: 1 goes by the small sun and both planets to the ring.

    The large sun idles. 100 N*m at 955 rpm are 955/60 * 2 pi * 100 W = 10.00 kW.
    """
    flow = only(loads(RAVIGNEAUX))
    _, lossy = sides(flow)
    passed = {"": 1, "small_sun-short": 1, "short-long": 0.98, "ring-long": 0.98**2}
    passed["large_sun-long"] = 0
    lost = {"small_sun-short": 0.02, "short-long": 0.98 * 0.02, "ring-long": 0.98**2 * 0.01}
    lost |= {"": 1 - 0.98**2 * 0.99, "large_sun-long": 0}
    assert {one.mesh: one.power for one in lossy.teeth} == pytest.approx(passed)
    assert {one.mesh: one.loss for one in lossy.teeth} == pytest.approx(lost)
    rows = {row[0]: row for row in power_grid(flow).texts}
    assert rows["teeth"][1:4] == ["1.000", "1.000", "10.001"]
    assert rows["short-long"][1:5] == ["1.000", "0.980", "9.801", "0.01960"]
    [gear] = json_answer("flow", "-", stdin=RAVIGNEAUX.encode())["gears"]
    shown = {one["mesh"]: (one["power"], one["loss"]) for one in gear["lossy"]["teeth"]}
    assert shown["short-long"] == pytest.approx((0.98, 0.0196))
    parts = [row[3] for row in next(flow_grids([flow])).texts if row[2] == "set"]
    assert parts[-5:] == ["teeth", *(f"teeth {mesh}" for mesh in MESHES)]


def test_variators_belts_and_shafts_have_no_teeth() -> None:
    """A variator loses 15 % of the incoming power, whichever of its links drives."""
    for links in ("first: in, second: out", "first: out, second: in"):
        variator = f"{{kind: variator, {links}, speed_ratio: 0.5, efficiency: 0.85}}"
        text = f"{{links: [in, out], mechanisms: {{H: {variator}}}, gears: {{g: []}}}}"
        _, lossy = sides(only(loads(text, format="yaml")))
        assert teeth(lossy) == {}, links
        assert lossy.losses == pytest.approx(dict.fromkeys(lossy.losses, 0.15))
    case = """
links: [in, middle, side, out]
elements:
  one: {kind: shaft, first: in, second: middle, efficiency: .99}
  two: {kind: belt, first: middle, second: side, diameters: {first: 100, second: 150}}
  three: {kind: gear_pair, first: side, second: out, teeth: {first: 20, second: 41}}
gears: {"1": {}}
"""
    _, lossy = sides(only(loads(case)))
    assert teeth(lossy) == pytest.approx({"three": 0.99})


@pytest.mark.slow
@pytest.mark.parametrize("coast", [False, True])
@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.name)
def test_every_mesh_loses_its_part_of_the_tooth_power(path: Path, coast: bool) -> None:
    """Whichever way power goes: what enters the teeth, less eta of it, is lost."""
    results = solved(path, coast=coast)
    efficiencies = {one.name: one.efficiency for one in results.case.mechanisms}
    for flow in flows(results):
        for one in flow.lossy.teeth if flow.lossy else ():
            name = f"{one.device}.{one.mesh}" if one.mesh else str(one.device)
            efficiency = efficiencies.get(name)
            if efficiency is not None:
                assert one.loss == pytest.approx((1 - efficiency) * one.power, abs=1e-9)


@pytest.mark.parametrize("stem", ["umdm", "wolfrom", "ravigneaux-gf4a"])
def test_losses_of_meshes_are_those_of_the_results(stem: str) -> None:
    results = shipped_results(f"{stem}.yaml")
    for number, flow in enumerate(flows(results)):
        _, lossy = sides(flow)
        found = [one.loss for one in lossy.teeth if one.mesh]
        assert found == pytest.approx(results.mesh_losses[number].tolist())


@given(case=trains(gears=2))
def test_losses_of_random_trains_are_parts_of_their_tooth_power(case: Transmission) -> None:
    """Teeth may bear what is not determined even where all links stand that they move."""
    results = solve(case)
    for flow, torques in zip(flows(results), results.lossy_torques, strict=True):
        if flow.lossy is None or flow.lossy.unknown:
            continue
        found = {one.device.number: one for one in flow.lossy.teeth}
        for number, mechanism in enumerate(case.mechanisms, 1):
            one = found[number]
            if math.isnan(torques[len(case.shift_elements) + number - 1] + one.power):
                continue  # what nothing determines, also speeds
            assert one.power >= 0
            part = (1 - mechanism.efficiency) * one.power
            assert one.loss == pytest.approx(part, rel=1e-6, abs=1e-6)
        mechanisms = math.fsum(one.loss for one in found.values())
        assert mechanisms == pytest.approx(flow.lossy.lost, rel=1e-6, abs=1e-6)


@given(case=regular_trains(coast=False))
def test_without_losses_it_is_the_sensitivity_of_the_ratio(case: Transmission) -> None:
    """(u/i) di/du of docs/summary.md is the power by the first link, seen from the third."""
    results = solve(case)
    [flow] = flows(results)
    if flow.ideal is not None and not flow.ideal.unknown:
        wanted = np.abs(sensitivities(results)[0])
        found = [one.power for one in flow.ideal.teeth]
        assert found == pytest.approx(wanted.tolist(), rel=1e-6, abs=1e-6, nan_ok=True)
