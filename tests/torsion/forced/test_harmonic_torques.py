"""Forced vibration: closed forms of one and two masses, and laws of every system."""

import math

import numpy as np
import pytest

from tests.chance import each_seed, seeded
from tests.torsion.systems import chain, mounted, sprung, wheels, with_planetary_set
from vstatics import (
    CaseError,
    Damping,
    Gear,
    Mechanism,
    ReadError,
    ShiftElement,
    Spring,
    Transmission,
)
from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.torsion.forced.cycle import summed
from vstatics.torsion.forced.harmonic_torques import Harmonic, _solved, response
from vstatics.torsion.forced.torque_table import read_torque_table
from vstatics.torsion.tolerances import SAME_ORDER
from vstatics.torsion.vibration.gear_modes import modes

SPEEDS = np.array([100.0, 300.0, 1000.0])


def natural(case: Transmission) -> list[float]:
    """Return the natural frequencies of the first gear [rad/s]."""
    return [mode.omega for mode in modes(case)[0].modes]


def one_mass(damping: Damping | float) -> Transmission:
    return mounted(damping, 800.0, 0.5)


def test_one_mass() -> None:
    """``q = 1/(c - J w^2 + i w d)``, torque ``(c + i w d) q``."""
    for damping, factor in ((6.0, lambda w: 6j * w), (Damping(loss_factor=0.1), lambda _: 80j)):
        [gear] = response(one_mass(damping), 1, [Harmonic(2.0, 3.0, 0.5)], SPEEDS)
        omega = 2 * RAD_PER_RPM * gear.speeds
        assert 190.98 < np.setdiff1d(gear.speeds, SPEEDS) < 190.99
        rate = 800 + np.array([factor(w) for w in omega])
        expected = 3 * np.exp(0.5j) / (rate - 0.5 * omega**2)
        [order] = gear.orders
        np.testing.assert_allclose(order.amplitudes["1"], expected, rtol=1e-13)
        np.testing.assert_allclose(order.torques["mount"], rate * expected, rtol=1e-13)


def test_torques_of_rigid_devices_balance_every_link() -> None:
    case = with_planetary_set()
    damper = Spring({2: 1}, damping=3.0, name="damper")
    [gear, _] = response(case.replace(springs=[*case.springs, damper]), 2, [Harmonic(2.0)], SPEEDS)
    [order] = gear.orders
    t, q, w2 = order.torques, order.amplitudes, (2 * RAD_PER_RPM * gear.speeds) ** 2
    found = -t["in"], 1 + t["in"] - t["P"] - t["damper"], 3.5 * t["P"] - t["out"]
    for torque, inertia, link in zip(found, (0.2, 0.01, 0.03), "124", strict=True):
        np.testing.assert_allclose(torque, -inertia * w2 * q[link], rtol=1e-9, atol=1e-9)


def test_resonances_lie_where_an_order_meets_a_natural_frequency() -> None:
    case = with_planetary_set()
    [gear, _] = response(case, 1, [Harmonic(2.0), Harmonic(4.5)], [300.0, 4000.0])
    omegas = natural(case)
    shapes = [mode.shape["1"] for mode in modes(case)[0].modes]
    expected = [
        (order, number, omega / order / RAD_PER_RPM, abs(shapes[number - 1]))
        for order in (2.0, 4.5)
        for number, omega in enumerate(omegas, 1)
        if 300 <= omega / order / RAD_PER_RPM <= 4000
    ]
    assert len(expected) > 2
    assert [one[:4] for one in gear.resonances] == [pytest.approx(one) for one in expected]


def test_a_link_that_stands_in_a_mode_does_not_excite_it() -> None:
    """Two equal wheels on equal half-shafts in antiphase, at 5 rad/s: from a wheel only."""
    case = wheels(damping=0.02)
    omegas = natural(case)
    [antiphase] = [number for number, one in enumerate(omegas, 1) if one == pytest.approx(5.0)]
    for link, excited in ((1, False), (2, False), (3, True)):
        [gear] = response(case, link, [Harmonic(1.0)], np.array([20.0, 60.0, 200.0]))
        told = {one.mode: one.participation for one in gear.resonances}
        assert (antiphase in told) == excited
        assert ((np.abs(gear.speeds * RAD_PER_RPM - 5) < 1e-9).any()) == excited
    assert told[antiphase] == pytest.approx(1.0)


def test_speeds_that_fall_and_rise_pass_a_resonance_each_time() -> None:
    """A mass on a mount: ``1/(d w)`` at its frequency."""
    hit = 40.0 / RAD_PER_RPM
    [gear] = response(one_mass(0.1), 1, [Harmonic(1.0)], [500.0, 300.0, 500.0])
    assert gear.speeds == pytest.approx([500.0, hit, 300.0, hit, 500.0])
    assert np.abs(gear.orders[0].amplitudes["1"]).max() == pytest.approx(1 / (0.1 * 40))


@pytest.mark.slow
@each_seed(40)
def test_no_peak_of_a_random_chain_is_missed(seed: int) -> None:
    """Lightly damped: of 20,001 speeds none has more than the few with resonances."""
    rng = seeded(seed)
    links = rng.randint(2, 8)
    stiffnesses = [10 ** rng.uniform(2, 5) for _ in range(links - 1)]
    inertias = [10 ** rng.uniform(-2, 1) for _ in range(links)]
    case = chain(inertias, stiffnesses, [c * 1e-5 for c in stiffnesses])
    [few] = response(case, 1, [Harmonic(2.0)], [100.0, 5000.0])
    [many] = response(case, 1, [Harmonic(2.0)], np.linspace(100, 5000, 20_001))
    for name, values in many.orders[0].amplitudes.items():
        most = np.abs(few.orders[0].amplitudes[name]).max()
        assert np.abs(values).max() <= most * 1.02


def test_an_undamped_system_that_is_hit_exactly_has_no_value() -> None:
    case = one_mass(0.0)
    hit = 40.0 / RAD_PER_RPM
    [gear] = response(case, 1, [Harmonic(1.0)], [hit, 2 * hit])
    assert np.isnan(gear.orders[0].amplitudes["1"]).tolist() == [True, False]
    assert np.isnan(gear.orders[0].torques["mount"]).tolist() == [True, False]
    [damped] = response(one_mass(1.0), 1, [Harmonic(1.0)], [hit])
    assert abs(damped.orders[0].amplitudes["1"][0]) == pytest.approx(1 / 40)


def test_a_singular_speed_leaves_the_values_of_the_others() -> None:
    """The amplitude 1/(k - J omega^2) of 4 kg*m^2 on 100 N*m/rad is undefined at 5 rad/s."""
    mass, stiffness, none = np.array([[4.0]]), np.array([[100.0]]), np.zeros((1, 1))
    found = _solved((mass, stiffness, none, none), np.ones(1), np.array([3.0, 5.0, 10.0]))
    assert found[:, 0] == pytest.approx([1 / 64, np.nan, -1 / 300], nan_ok=True)


def test_a_part_without_damping_that_is_hit_exactly_has_no_value() -> None:
    shafts = [
        Spring({1: 1, 2: -1}, stiffness=150.0, name="s"),
        Spring({3: 1, 4: -1}, stiffness=50.0, damping=0.1, name="t"),
    ]
    case = sprung(4, shafts, {1: 1.0, 2: 2.0, 3: 1.0, 4: 1.0})
    omegas = natural(case)
    assert omegas == pytest.approx([10.0, 15.0])
    for at in (1, 3):
        [gear] = response(case, at, [Harmonic(1.0)], np.array(omegas) / RAD_PER_RPM)
        assert np.isnan(gear.orders[0].amplitudes["1"]).tolist() == [False, True]


def test_a_link_that_nothing_resists_has_no_value_and_its_device_no_torque() -> None:
    case = Transmission(
        4, [], [Mechanism(3, 4, 0, 2.0, name="loose")], [], inertias={1: 1.0, 2: 2.0},
        springs=[Spring({1: 1, 2: -1}, stiffness=150.0, name="s")],
    )  # fmt: skip
    [gear] = response(case, 1, [Harmonic(1.0)], [100.0])
    assert np.isnan(gear.orders[0].amplitudes["3"][0])
    assert gear.orders[0].torques["loose"][0] == 0
    assert response(case, 3, [Harmonic(1.0)], [100.0])[0].error.startswith("link 3 has no inertia")


def test_an_open_element_has_a_torque_of_0_at_every_speed() -> None:
    case = Transmission(2, [ShiftElement(1, 2, name="C")], [], [Gear()], inertias={1: 1.0, 2: 1.0})
    [gear] = response(case, 1, [Harmonic(2.0)], SPEEDS)
    assert gear.orders[0].torques["C"].tolist() == [0, 0, 0]
    expected = -1 / (RAD_PER_RPM * 2 * SPEEDS) ** 2
    np.testing.assert_allclose(gear.orders[0].amplitudes["1"].real, expected)


def test_many_speeds_are_solved_piece_by_piece(monkeypatch: pytest.MonkeyPatch) -> None:
    case, speeds = with_planetary_set(), np.linspace(10, 5000, 50)
    [whole, _] = response(case, 1, [Harmonic(2.0)], speeds)
    monkeypatch.setattr("vstatics.torsion.forced.harmonic_torques.MOST_ENTRIES", 40)
    [pieces, _] = response(case, 1, [Harmonic(2.0)], speeds)
    for name, values in whole.orders[0].amplitudes.items():
        np.testing.assert_allclose(pieces.orders[0].amplitudes[name], values, rtol=1e-12)


@pytest.mark.filterwarnings("error")
def test_absurd_speeds_have_no_value_and_absurd_orders_no_resonance() -> None:
    """It would be at 40 rad/s/1e-309, beyond any float."""
    for speed in (1e-300, 1e300):
        [gear, _] = response(with_planetary_set(), 1, [Harmonic(speed)], [speed])
        assert np.isnan(gear.orders[0].amplitudes["1"]).all()
    [gear] = response(one_mass(6.0), 1, [Harmonic(1e-309)], SPEEDS)
    assert gear.resonances == []


@pytest.mark.parametrize(
    ("orders", "amplitudes"),
    [
        ([2.0, 4.5], [1, 1j]),
        ([1.0, 3.0], [1, -1]),
        ([0.5, 1.0, 1.5], [1 + 1j, 0.3 - 2j, 0.7]),
        ([7.5, 8.0], [7 + 12.5j, 3e-3]),  # 30 maxima of nearly equal height
    ],
)
def test_the_largest_value_of_several_orders(
    orders: list[float], amplitudes: list[complex]
) -> None:
    """Against a million points of the wave itself."""
    turning = np.exp(2j * np.outer(orders, np.linspace(0, 2 * np.pi, 1_000_001)))
    wave = (np.array(amplitudes)[:, np.newaxis] * turning).real.sum(axis=0)
    found = summed(orders, [np.array([a], complex) for a in amplitudes])
    assert found.largest[0] == pytest.approx(np.abs(wave).max(), rel=1e-9)
    assert found.rms[0] == pytest.approx(math.sqrt(np.mean(wave[:-1] ** 2)), rel=1e-9)


def test_the_sum_of_one_order_is_that_order() -> None:
    """Its largest value is its amplitude, the root of the mean square that over sqrt 2."""
    [gear] = response(one_mass(6.0), 1, [Harmonic(2.0, 3.0, 0.5)], SPEEDS)
    total = gear.with_sum().sum
    assert total is not None
    for summed_up, alone in (
        (total.amplitudes["1"], gear.orders[0].amplitudes["1"]),
        (total.torques["mount"], gear.orders[0].torques["mount"]),
    ):
        np.testing.assert_allclose(summed_up.largest, np.abs(alone), rtol=1e-12)
        np.testing.assert_allclose(summed_up.rms, np.abs(alone) / math.sqrt(2), rtol=1e-12)


def test_orders_meet_in_every_phase_only_where_no_cycle_is_short() -> None:
    """3 cos x - 4 sin k x: a peak of the sine is 90/k degrees from the nearest of the cosine."""
    for slow, fast, meet in (
        (1 / 720, 1.0, False), (1 / 721, 1.0, True), (1.0, math.sqrt(2), True),
        (1.0, 300 * (1 + 0.5 * SAME_ORDER), False), (1.0, 300 * (1 + 2 * SAME_ORDER), True),
        (0.5, 2_000_000.5, True),
    ):  # fmt: skip
        [largest] = summed([slow, fast], [np.array([3.0 + 0j]), np.array([4j])]).largest
        apart = 0.0 if meet else math.pi / 2 * slow / fast
        assert largest == pytest.approx(4 + 3 * math.cos(apart), rel=1e-9)


def test_a_table_of_torques() -> None:
    table = b"order, amplitude, phase [deg]\n2, 80, 90\n\n4.5,20,0\n"
    found = read_torque_table(table, "engine.csv")
    assert found == [Harmonic(2.0, 80.0, math.pi / 2), Harmonic(4.5, 20.0, 0.0)]
    # a line of units; pure numbers lack a unit: github.com/BurntSushi/xsv/issues/245
    for units in (b";[kN*m];[deg]", b"-;kN*m;deg"):
        table = b"order;amplitude;phase\n" + units + b"\n2;0,08;90\n4,5;0,02;0\n"
        assert read_torque_table(table, "engine.csv") == found
    for row in (b"nan,nan,nan", b"none,,", b"s,N*m,deg"):
        with pytest.raises(ReadError, match=r"engine\.csv:2:1: error: "):
            read_torque_table(b"order,amplitude [N*m],phase [deg]\n" + row, "engine.csv")


def test_torques_on_several_cranks() -> None:
    """Phases of the firing order 1-3-4-2, against the equations of motion solved in full.

    Source: forced response of crankshafts in github.com/Aalto-Arotor/openTorsion/pull/11.
    """
    masses, rates, losses = [0.05, 0.04, 0.03, 0.04, 1.2], [8e5, 7e5, 8e5, 9e5], [20.0, 10, 20, 30]
    springs = [
        Spring({n + 1: 1, n + 2: -1}, rates[n], damping=Damping(losses[n]), name=f"{n}")
        for n in range(4)
    ]
    case = sprung(5, springs, dict(enumerate(masses, 1)))
    rows = "order,amplitude,phase [deg],link\n"
    rows += "".join(
        f"{order},{50 * order},{-order * angle},{link}\n"
        for order in (0.5, 2, 4)
        for link, angle in zip("1342", (0, 180, 360, 540), strict=True)
    )
    harmonics = read_torque_table(rows.encode(), "engine.csv")
    [gear] = response(case, 5, harmonics, SPEEDS)
    twists = np.eye(4, 5) - np.eye(4, 5, 1)
    for harmonic, found in zip(harmonics, gear.orders, strict=True):
        order = harmonic.order
        omegas = order * gear.speeds * RAD_PER_RPM
        angles = np.pi * np.array([0, 3, 1, 2, 0])
        torques = 50 * order * np.exp(-1j * order * angles) * [1, 1, 1, 1, 0]
        for place, omega in enumerate(omegas):
            dynamic = np.array(rates) + 1j * omega * np.array(losses)
            matrix = twists.T * dynamic @ twists - omega**2 * np.diag(masses)
            expected = np.linalg.solve(matrix, torques)
            values = [found.amplitudes[f"{link}"][place] for link in range(1, 6)]
            assert values == pytest.approx(expected.tolist(), rel=1e-9)
            twist = twists @ expected
            carried = [found.torques[f"{n}"][place] for n in range(4)]
            # differences of angles lose digits: 1e-9 of the exciting torques remain
            assert carried == pytest.approx((dynamic * twist).tolist(), abs=1e-9 * 50 * order)
    wrong = read_torque_table(rows.replace(",2\n", ",x\n").encode(), "engine.csv")
    with pytest.raises(CaseError, match="no link 'x'"):
        response(case, 5, wrong, SPEEDS)


HEADS = b"order,amplitude\n"


def test_a_fault_of_a_table_is_reported_with_its_line() -> None:
    for text, message in (
        (b"order\n2\n", "1:1: error: `amplitude [N*m]` is missing, expected a table"),
        (b"order,torque\n", "1:1: error: read the heading 'torque', expected `order`, `amplitude"),
        (HEADS, "1:1: error: read no row below the headings, expected a table of"),
        (HEADS + b"2,x\n", "2:1: error: amplitude: read 'x', expected a finite number"),
        (HEADS + b"0,1\n", "2:1: error: order: read 0, expected a number above"),
        (HEADS + b"-2,1\n3,5\n", "2:1: error: order: read -2, expected a number above"),
        (HEADS + b"2,nan\n", "2:1: error: amplitude: read 'nan'"),
        # two cylinders on one crank, as in github.com/speeduino/speeduino/pull/744
        (HEADS + b"2,1\n2,3\n", "3:1: error: order 2 is given twice; give the vector sum of"),
        (HEADS[:-1] + b",link\n2,1,a\n2,3,b\n2,4,a\n", "4:1: error: order 2 is given twice"),
        (HEADS + b"2,1,5\n", "2:1: error: read 3 cells, expected 2"),
        (HEADS + b"2," + b"1" * 140_000, "2:1: error: amplitude: read '1111"),
        (b"", "1:1: error: the file is empty, expected a table of orders"),
    ):
        with pytest.raises(ReadError) as caught:
            read_torque_table(text, "engine.csv")
        assert any(str(one).startswith(f"engine.csv:{message}") for one in caught.value.problems)


def test_without_any_inertia_no_link_can_be_excited() -> None:
    """All links move without resistance, so the message names no link as an example."""
    case = Transmission(2, [], [Mechanism(1, 2, 0, 3.0)], [Gear()])
    [gear] = response(case, 1, [Harmonic(2.0, 1.0)], [100.0])
    assert gear.error.endswith("expected another, such as one with an inertia")
