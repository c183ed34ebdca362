"""Freewheels and clutches of a vibrating gear: they hold or slip as they do at its mean load."""

import pytest

from vstatics import loads
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.system.state import vibrating


@pytest.mark.parametrize(("torque", "holds"), [(100, True), (1.2, True), (1.0, False)])
def test_a_drag_by_points_lets_a_freewheel_hold_as_the_load_does(
    torque: float, *, holds: bool
) -> None:
    # the clutch drags .8 N*m from the sun to the ring, which 2.5 (T - .8) hold back
    case = loads(f"""\
links: [sun, ring, out]
output: out
load: {{speed: 1000 rpm, torque: {torque} N*m}}
shift_elements:
  C: {{links: [sun, ring], drag: [[0, 0.8], [10, 0.8]]}}
  F: {{kind: freewheel, links: [ring, housing]}}
mechanisms: {{set: {{first: sun, second: ring, third: out, ratio: -2.5}}}}
gears: {{one: []}}
inertias: {{sun: 1, ring: 1, out: 1}}
""")
    system = vibrating(case, case.gears[0])
    assert isinstance(system, TorsionalSystem)
    assert (
        ("F" in [device.name for device in system.rigid]) == holds == (2.5 * (torque - 0.8) > 0.8)
    )


def test_a_slipping_clutch_transmits_no_vibration() -> None:
    text = """\
links: [engine, shaft, wheels]
shift_elements: {{C: [engine, shaft]}}
mechanisms: {{pair: {{first: shaft, second: wheels, ratio: 4}}}}
gears: {{one: {{slip: {{C: {slip}}}}}, open: []}}
inertias: {{engine: 1, shaft: 1, wheels: 1}}
"""
    for slip, is_joined in ((0.3, False), (0, True)):
        case = loads(text.format(slip=slip))
        system = vibrating(case, case.gears[0])
        assert isinstance(system, TorsionalSystem)
        assert ("C" in [device.name for device in system.rigid]) == is_joined
