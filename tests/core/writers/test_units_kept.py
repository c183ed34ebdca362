"""What a case gives in N*m or rpm stays that, whatever the file becomes that it is written to."""

from pathlib import Path

import pytest

from vstatics import Transmission, load, loads, save
from vstatics.core.comparison.case_changes import case_changes
from vstatics.core.writers.named import mapping, write_yaml

LIKE_THE_PAGE = """\
links: [sun, ring, carrier]
load: {speed: 1000 rpm, torque: 200 N*m}
drag: {carrier: 4 N*m, sun: 0.01}
shift_elements:
  C: {links: [sun, ring], capacity: 300 N*m, drag: 3 N*m}
  B: {links: [ring, housing], capacity: 2.5}
mechanisms:
  set: {first: sun, second: ring, third: carrier, ratio: -2.5, efficiency: 0.96}
gears:
  low: {engaged: [B]}
  own: {engaged: [B], load: {torque: -50 N*m}, open_drag: {C: 1 N*m}}
  split: {speeds: {ring: 250 rpm}, drag: {carrier: 2 N*m}}
  pulled: {engaged: [C], torques: {ring: 30 N*m}}
"""


def with_load(case: Transmission, torque: float) -> Transmission:
    assert case.load is not None
    return case.replace(load=case.load._replace(torque=torque, power=None))


def again(case: Transmission, folder: Path, suffix: str) -> Transmission:
    path = folder / f"again{suffix}"
    assert save(case, path) == []
    return load(path)


@pytest.mark.parametrize("suffix", [".yaml", ".json", ".xlsx"])
def test_the_load_changes_and_what_has_a_unit_does_not(tmp_path: Path, suffix: str) -> None:
    case = loads(LIKE_THE_PAGE)
    made = again(case, tmp_path, suffix)
    assert made == case
    assert not [*case_changes(made, case)]
    for torque in (50.0, 400.0, -120.0):
        here, there = with_load(case, torque), with_load(made, torque)
        assert there == here
        assert there.shift_elements[0].capacity == pytest.approx(300 / abs(torque))
        assert there.shift_elements[1].capacity == 2.5  # a bare number is a part of the load
        assert there.gear_drag(there.gears[0]) == pytest.approx({3: 4 / abs(torque), 1: 0.01})


def test_a_part_of_another_load_is_written_as_a_part() -> None:
    """Without its load a torque is nothing but a number: it could not be read again."""
    case = loads(LIKE_THE_PAGE)
    bare = case.replace(load=None, gears=case.gears[:1])
    assert loads(write_yaml(bare)) == bare


def test_a_case_that_knows_no_units_is_compared_by_parts() -> None:
    """As a result of an older version has them: 1.5 of 200 N*m are 300 N*m."""
    case = loads(LIKE_THE_PAGE)
    older = Transmission.from_dict(mapping(case, units=False))
    assert older.shift_elements[0].capacity == 1.5
    assert not [*case_changes(case, older)]
    less = loads(LIKE_THE_PAGE.replace("300 N*m", "290 N*m"))
    [change] = case_changes(less, case)
    assert change == ("C.capacity", "300.0 N*m", "290.0 N*m")
