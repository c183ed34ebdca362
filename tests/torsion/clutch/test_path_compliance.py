"""Compliances between links: closed forms, and the reduced compliances of a chain."""

import math

import pytest

from vstatics import Transmission, loads
from vstatics.torsion.clutch.gear_dump import path_compliance
from vstatics.torsion.reduction.reduced_values import reduce
from vstatics.torsion.system.gear_system import torsional_system


def between(case: Transmission, near: str, far: str) -> float | None:
    """For a torque of 1 on the one link while the other is held."""
    system = torsional_system(case, case.gears[0])
    ends = [case.link_number(one) - 1 for one in (near, far)]
    return path_compliance(system, ends[:1], [1.0], ends[1:])


GEARBOX = """\
output: vehicle
springs:
  damper: {links: [engine, disc], compliance: 84e-5}
  propshaft: {links: [output, pinion], compliance: 4.1e-5}
  tyre: {links: [wheel, vehicle], stiffness: 1e5}
mechanisms:
  box: {first: disc, second: output, ratio: 3.49, stiffness: 5e3}
  final drive: {first: pinion, second: wheel, ratio: -4.22}
"""


def test_of_a_chain_it_is_the_sum_of_the_reduced_compliances() -> None:
    case = loads(GEARBOX)
    [reduced] = reduce(case, "engine")
    assert len(reduced.compliances) == 4
    total = math.fsum(one or math.nan for one in reduced.compliances.values())
    assert between(case, "engine", "vehicle") == pytest.approx(total, rel=1e-12)
    own = 4.1e-5 + 1e-5 * 4.22**2
    assert between(case, "output", "vehicle") == pytest.approx(own, rel=1e-12)


def test_mountings_on_the_way_add_their_reduced_compliances() -> None:
    """A casing with (1 - i)^2 (Tsitovich, Algin, 1981, (1.22)), an axle with i^2, (1.24)."""
    case = loads("""\
springs:
  box mounting: {links: [box, housing], compliance: 2e-4}
  leaf springs: {links: [axle, housing], compliance: 3e-5}
  half-shafts: {twist: {pinion: 0.25, wheel: -1, axle: -1}, compliance: 1e-5}
  engine mounting: {links: [block, housing], compliance: 1}
mechanisms:
  box: {first: disc, second: pinion, third: box, ratio: 3}
links: [disc, pinion, box, axle, wheel, block]
""")
    reduced = {"box": 2e-4 * 4, "axle": 3e-5 * 144, "half-shafts": 1e-5 * 144}
    total = math.fsum(reduced.values())
    assert between(case, "disc", "wheel") == pytest.approx(total, rel=1e-12)


def test_half_shafts_of_an_open_differential() -> None:
    """``(E_left + E_right)/4``, (2.1)."""
    case = loads("""\
springs:
  left shaft: {links: [left, left wheel], compliance: 2e-4}
  right shaft: {links: [right, right wheel], compliance: 6e-4}
  left tyre: {links: [left wheel, vehicle], compliance: 1e-9}
  right tyre: {links: [right wheel, vehicle], compliance: 1e-9}
mechanisms: {differential: {first: left, second: right, third: crown wheel, ratio: -1}}
""")
    assert between(case, "crown wheel", "vehicle") == pytest.approx(2e-4, rel=1e-5)


def test_shafts_side_by_side_share_the_torque() -> None:
    case = loads("""\
springs:
  a: {links: [1, 2], compliance: 3e-4}
  b: {links: [1, 2], compliance: 6e-4}
  c: {links: [1, housing], compliance: 2e-4}
""")
    assert between(case, "1", "2") == pytest.approx(1e-4, rel=1e-12)


def test_what_nothing_joins_turns_freely_and_what_is_rigidly_joined_has_no_compliance() -> None:
    text = "springs: {a: {links: [1, 2], compliance: 1e-4}, b: {links: [3, 4], compliance: 1e-4}}"
    assert between(loads(text), "1", "4") is None
    joined = text + "\nmechanisms: {m: {first: 2, second: 3, ratio: 2}}"
    assert between(loads(joined), "2", "3") == 0.0


def test_links_that_turn_as_one_have_no_spring_between_them() -> None:
    case = loads(GEARBOX)
    system = torsional_system(case, case.gears[0])
    names = ("disc", "output", "vehicle")
    disc, output, vehicle = (case.link_number(one) - 1 for one in names)
    speeds = [1.0, 1 / 3.49]
    found = path_compliance(system, [disc, output], speeds, [vehicle])
    assert found == pytest.approx(3.49**2 * (4.1e-5 + 1e-5 * 4.22**2), rel=1e-12)
