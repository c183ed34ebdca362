"""Results in rpm, N*m and kW: a relative number times that of the load, in closed form.

One planetary set with the ring held: the carrier turns at w/(1 - u), and with losses it gets
M(1 - u*eta), as the sun drives.
"""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.commands import CASES
from vstatics import CaseError, Gear, Load, Mechanism, ShiftElement, Transmission, load, solve
from vstatics.core.flow.power import flows
from vstatics.core.statics.physical import known_units, lacking_load, scales
from vstatics.core.tables.quantities import ASKED, WITH_UNITS

KW = math.pi / 30 / 1000
"""1 N*m at 1 rpm."""
U, ETA = -2.5, 0.96
SET = Transmission(
    3,
    [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
    [Mechanism(1, 2, 3, U, ETA, name="P1")],
    [Gear([2], name="low"), Gear([1], name="direct", load=Load(1000, 100))],
    load=Load(2000, 300),
)
LOW = replace(SET, gears=[Gear([2])])
RATIOS = [[-2.0], [-2.5], [-3.0]]


def test_speeds_torques_and_powers_by_hand() -> None:
    results = solve(SET)
    speeds = np.array([[2000, 0, 2000 / 3.5], [1000, 1000, 1000]])
    assert results.speeds_rpm == pytest.approx(speeds)
    assert results.slip_speeds_rpm == pytest.approx(np.array([[2000, 0], [0, 1000]]))
    # planet of a plain set: z_planet = (z_ring - z_sun)/2, so -2/(ring/sun - 1) of sun - carrier
    assert results.planet_speeds_rpm[0, 0] == pytest.approx((2000 - 2000 / 3.5) * -2 / 1.5)
    assert results.output_torque_Nm == pytest.approx([300 * 3.5, 100])
    assert results.lossy_output_torque_Nm == pytest.approx([300 * (1 + 2.5 * ETA), 100])
    assert results.torques_Nm[0] == pytest.approx([0, -300 * 2.5, 300, 300 * 3.5])
    assert results.lossy_torques_Nm[0, 1] == pytest.approx(-300 * 2.5 * ETA)
    lost = 2000 * 300 * (1 - (1 + 2.5 * ETA) / 3.5) * KW
    assert results.losses_kW == pytest.approx(np.array([[lost], [0]]))
    assert results.input_power_kW == pytest.approx([2000 * 300 * KW, 1000 * 100 * KW])
    assert results.output_power_kW == pytest.approx([2000 * 300 * KW - lost, 1000 * 100 * KW])


def test_every_declared_unit_has_its_array() -> None:
    """What enters and leaves is no multiple of another array: there it is that of the load."""
    results = solve(SET, ratios=RATIOS)
    singles = [solve(SET, ratios=ratios) for ratios in RATIOS]
    entering = np.array([2000 * 300, 1000 * 100]) * KW
    share = {"input_power_kW": np.ones((3, 2)), "output_power_kW": results.efficiency}
    for one in (one for one in WITH_UNITS + ASKED if one.unit):
        made = getattr(results, one.name)
        np.testing.assert_array_equal(made, [getattr(alone, one.name) for alone in singles])
        if not one.of:
            np.testing.assert_allclose(made, share[one.name] * entering, rtol=1e-12)
            continue
        for gear, scale in enumerate(scales(SET)[one.unit].tolist()):
            expected = getattr(results, one.of)[:, gear] * scale
            np.testing.assert_allclose(made[:, gear], expected, rtol=1e-15)


@pytest.mark.parametrize("file", sorted(CASES.glob("*.yaml")), ids=lambda file: file.stem)
def test_ports_have_the_power_that_the_flow_tells(file: Path) -> None:
    """Which adds up the ports of each gear one by one, in their real direction."""
    case = load(file)
    gears = [gear._replace(load=None) for gear in case.gears]
    for coast in (False, True):
        results = solve(replace(case, gears=gears, load=Load(2000, 300)), coast=coast)
        for number, flow in enumerate(flows(results)):
            if flow.lossy is not None and not flow.lossy.unknown:
                both = [flow.lossy.entering * flow.kilowatts, flow.lossy.leaving * flow.kilowatts]
                found = results.input_power_kW[number], results.output_power_kW[number]
                assert sorted(found) == pytest.approx(sorted(both), rel=1e-9, abs=1e-9)


def test_values_without_an_operating_point_are_rejected_or_nan() -> None:
    results = solve(replace(LOW, load=None))
    with pytest.raises(CaseError, match=r"the case gives no speed at the input, so .*speeds_rpm"):
        _ = results.speeds_rpm
    with pytest.raises(CaseError, match=r"speed and torque at the input, so .*`input_power_kW`"):
        _ = results.input_power_kW
    case = replace(LOW, load=Load(torque=300))
    assert solve(case).output_torque_Nm == pytest.approx([1050])
    assert known_units(case) == {"Nm"}
    said = lacking_load("losses_kW", "kW")
    assert said.endswith("give `load: {speed: 2000 rpm, torque: 300 N*m}`")
    own = solve(replace(SET, load=None))  # only the second gear has a load
    assert np.isnan(own.speeds_rpm[0]).all()
    assert own.speeds_rpm[1] == pytest.approx([1000] * 3)
    results = solve(replace(LOW, load=Load(1e300, 1e300)))
    assert np.isnan(results.input_power_kW).all()
    assert np.isnan(results.losses_kW).all()
    assert np.isfinite(results.speeds_rpm).all()
