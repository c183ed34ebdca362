"""The power split of the Prius under load, against what is printed of it.

Sources: fate.5ch.net/test/read.cgi/auto/1508626950/655, an example with all its numbers: engine at
1220 rpm with 8 kgf*m (13.6 PS), MG1 at rest with 2.24 kgf*m, ring at 1689 rpm with 5.76 kgf*m and
13.6 PS; greenhybrid.com/discuss/f10/introduction-prius-power-12525: MG1 has 28 % of the engine's
torque, the ring 72 %; ecomodder.com/forum/101593-post71.html: MG1 = 3.6 ICE - 2.6 MG2.
"""

import pytest

from vstatics import Results, solve
from vstatics.core.readers import loads

KGF_M = 9.80665
PS_IN_KW = 75 * KGF_M / 1000


def split(mg1: float) -> Results:
    """The power split without losses; MG2 and the wheels are on the ring."""
    return solve(
        loads(f"""\
links: [MG1, ring, engine]
input: engine
output: ring
load: {{speed: 1220 rpm, torque: {8 * KGF_M} N*m}}
mechanisms: {{split: {{first: MG1, second: ring, third: engine, ratio: -78/30}}}}
gears: {{drive: {{speeds: {{MG1: {mg1} rpm}}}}}}
""")
    )


def test_with_the_generator_at_rest_all_power_goes_to_the_ring() -> None:
    results = split(0)
    assert results.speeds_rpm[0, 1] == pytest.approx(1689, abs=0.5)
    held = -results.lossy_holding_torques_Nm[0, 0] / KGF_M
    # printed with the rounded .28; .72 is rounded, too
    assert held == pytest.approx(2.24, abs=8 * 0.005)
    assert results.lossy_output_torque_Nm[0] / KGF_M == pytest.approx(5.76, abs=8 * 0.005)
    assert results.input_power_kW[0] / PS_IN_KW == pytest.approx(13.6, abs=0.05)
    assert results.output_power_kW[0] / PS_IN_KW == pytest.approx(13.6, abs=0.05)


@pytest.mark.parametrize("mg1", [-1500.0, 1220.0, 3000.0])
def test_at_any_speed_the_torque_is_split_alike(mg1: float) -> None:
    results = split(mg1)
    ring = (3.6 * 1220 - mg1) / 2.6  # the printed equation of speeds
    assert results.speeds_rpm[0, 1] == pytest.approx(ring, rel=1e-12)
    assert -results.lossy_holding_torques_Nm[0, 0] / (8 * KGF_M) == pytest.approx(0.28, abs=0.005)
    # what the engine gives and MG1 does not take, or gives besides, is at the ring
    left = 1220 * 8 - mg1 * 8 / 3.6
    at_ring = results.lossy_output_torque_Nm[0] / KGF_M * results.speeds_rpm[0, 1]
    assert at_ring == pytest.approx(left, rel=1e-12)
