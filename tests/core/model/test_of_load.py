"""Speeds and torques that were given with a unit stay what they are under another load."""

import copy
import pickle

import numpy as np

import vstatics
from vstatics import Load

CASE = """
load: {speed: 1000 rpm, torque: 100 N*m}
links: [a, b, c]
output: b
shift_elements: {C: {links: [a, b], capacity: 250 N*m, drag: 1 N*m}}
mechanisms:
  m: {first: a, second: b, ratio: -2, efficiency: .95}
  n: {first: c, second: b, ratio: -1.5, efficiency: .95}
drag: {b: 2 N*m}
gears: {g: {torques: {c: 10 N*m}}}
"""
FIRST = vstatics.loads(CASE)


def test_a_torque_in_newton_metres_is_the_same_driving_and_coasting() -> None:
    """The option, the parameter and the key say one thing, in copies and other processes, too."""
    by_key = vstatics.solve(vstatics.loads(f"coast: true\n{CASE}"))
    for case in (FIRST, copy.deepcopy(FIRST), pickle.loads(pickle.dumps(FIRST))):  # noqa: S301
        assert case == FIRST
        for results in (vstatics.solve(case, coast=True), vstatics.solve(case.replace(coast=True))):
            np.testing.assert_array_equal(results.lossy_torques_Nm, by_key.lossy_torques_Nm)
    assert by_key.case.gears[0].torques[3] == -0.1  # 10 N*m by -100 N*m
    back = vstatics.solve(by_key.case, coast=False)
    np.testing.assert_array_equal(back.lossy_torques, vstatics.solve(FIRST).lossy_torques)


def test_under_another_load_the_part_is_another() -> None:
    other = FIRST.replace(load=Load(1000.0, 200.0))
    gear = other.gears[0]
    drags = other.gear_drag(gear)[2], other.gear_open_drag(gear)[1]
    assert (gear.torques[3], *drags) == (0.05, 0.01, 0.005)
    assert other.shift_elements[0].capacity == 1.25
    assert FIRST.replace(load=None).gears[0].torques[3] == 0.1
    # relative numbers stay as they are
    plain = vstatics.loads(CASE.replace("{c: 10 N*m}", "{c: .1}")).replace(load=Load(1000, 200.0))
    assert plain.gears[0].torques[3] == 0.1
