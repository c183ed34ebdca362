"""Springs at mean speeds: loss-free devices whose column is their twist."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.chance import count, seeded
from tests.trains import on_springs, random_train, trains
from vstatics import Gear, Mechanism, Results, ShiftElement, Spring, Transmission, solve
from vstatics.core.model.springs import between
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.solve import distribution_matrix

SHAFT = Transmission(
    4,
    [ShiftElement(2, 0, "B"), ShiftElement(1, 2, "C")],
    [Mechanism(1, 2, 3, -2.5, 0.96, name="set")],
    [Gear([1], name="low"), Gear([2], name="direct")],
    springs=[Spring(between(3, 4), stiffness=9e4, damping=3, name="shaft")],
    inertias={1: 0.15, 4: 3},
)
ALIKE = (
    *("speeds", "slip_speeds", "ratio", "holding_torques", "lossy_holding_torques", "efficiency"),
    *("tied_up", "missing", "excess", "balanced", "holds", "conflict", "locked"),
)


def by_device(results: Results, array: Floats) -> dict[str, list[float]]:
    rows = [*results.case.devices, "output"]
    return dict(zip(rows, array.T.tolist(), strict=True))


def assert_agree(with_springs: Transmission, with_mechanisms: Transmission) -> None:
    one, other = solve(with_springs), solve(with_mechanisms)
    pairs = [(getattr(one, name), getattr(other, name)) for name in ALIKE]
    for name in ("torques", "lossy_torques"):
        ours, theirs = (by_device(each, getattr(each, name)) for each in (one, other))
        assert ours.keys() == theirs.keys()
        pairs += [(np.array(ours[device]), np.array(theirs[device])) for device in ours]
    for actual, expected in pairs:
        np.testing.assert_allclose(actual, expected, rtol=1e-9, atol=1e-9, equal_nan=True)


@settings(max_examples=count(24, 180))
@given(trains(gears=2), st.data())
def test_a_spring_of_any_row_is_the_loss_free_mechanism_of_that_row(
    case: Transmission, data: st.DataObject
) -> None:
    """Some mechanisms become springs, or all of them."""
    numbers = range(len(case.mechanisms))
    some = st.sets(st.sampled_from(numbers), min_size=1)
    chosen = data.draw(st.one_of(st.just({*numbers}), some))
    bare = [
        one._replace(efficiency=1.0, back_efficiency=None) if number in chosen else one
        for number, one in enumerate(case.mechanisms)
    ]
    case = replace(case, mechanisms=bare)
    assert_agree(on_springs(case, chosen), case)


def test_freewheels_find_their_state_beside_springs() -> None:
    elements = [ShiftElement(2, 0, "F", "freewheel"), SHAFT.shift_elements[1]]
    results = solve(replace(SHAFT, shift_elements=elements, gears=[Gear(), Gear([2])]))
    assert results.holds.tolist() == [[True, False], [False, True]]
    assert results.ratio == pytest.approx([3.5, 1])


def test_coefficients_need_not_add_to_0() -> None:
    """Twist a + 2b - 3c - 4d of four links, of which b, c stand: w_d = w_a/4, M_d = -4 M."""
    held = [Mechanism(2, 0, 0, 1.0, name="b"), Mechanism(3, 0, 0, 1.0, name="c")]
    spring = Spring({1: 1, 2: 2, 3: -3, 4: -4}, stiffness=8, name="s")
    results = solve(Transmission(4, [], held, [Gear()], springs=[spring]))
    assert results.speeds.tolist() == [[1, 0, 0, 0.25]]
    assert results.ratio.tolist() == [4]
    expected = {"b": [-2.0], "c": [3.0], "s": [1.0], "output": [4.0]}
    assert by_device(results, results.torques) == expected


def test_the_matrix_has_a_column_for_each_spring_behind_the_mechanisms() -> None:
    columns = [[0, 1, 0, 0], [1, -1, 0, 0], [1, 2.5, -3.5, 0], [0, 0, 1, -1]]
    assert distribution_matrix(SHAFT).T.tolist() == columns


def test_springs_in_excess_are_named() -> None:
    """Springs between the same links share an unknown torque; a mount ties the gear up."""
    twins = [*SHAFT.springs, SHAFT.springs[0]._replace(name="other")]
    results = solve(replace(SHAFT, springs=twins))
    assert results.ratio == pytest.approx([3.5, 1])
    assert results.excess.tolist() == [1, 1]
    assert np.isnan(results.torques[:, 3:5]).all()
    said = "shaft and other impose the same constraint on the speeds; the torque of shaft and other"
    assert said in str(results.messages[0])
    mount = Spring(between(1), stiffness=3, name="mount")
    results = solve(replace(SHAFT, springs=[*SHAFT.springs, mount]))
    assert results.tied_up.all()
    said = str(results.messages[0])
    assert "mount" in said
    assert said.endswith("can twist in `vstatics torsion`, but not in statics [E452]")


def with_springs(seed: int) -> Transmission:
    rng = seeded(seed)
    case = random_train(rng)
    numbers = range(len(case.mechanisms))
    return on_springs(case, set(rng.sample(numbers, rng.randint(1, len(numbers) - 1))))
