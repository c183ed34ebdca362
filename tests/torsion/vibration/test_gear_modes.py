"""Natural modes: what holds of every system, and what is known in closed form."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from scipy import linalg

from tests.chance import count
from tests.commands import CASES
from tests.torsion.systems import (
    Array,
    branched,
    chain,
    matrices,
    sprung,
    wheels,
    with_planetary_set,
)
from vstatics import CaseError, Gear, ShiftElement, Spring, Transmission, load
from vstatics.torsion.vibration.gear_modes import GearModes, modes
from vstatics.torsion.vibration.tables import modes_grids


def only(case: Transmission, **options: object) -> GearModes:
    [gear] = modes(case, **options)  # type: ignore[arg-type]
    return gear


def omegas(gear: GearModes) -> list[float]:
    return [mode.omega for mode in gear.modes]


def shapes(gear: GearModes) -> Array:
    return np.array([list(mode.shape.values()) for mode in gear.modes]).T


def test_two_masses_on_a_shaft() -> None:
    """``omega^2 = c (1/J1 + 1/J2)``; they swing against each other, by their inertias."""
    gear = only(chain([2.0, 8.0], [40.0]))
    [mode] = gear.modes
    assert gear.rigid_modes == 1
    assert mode.omega == pytest.approx(math.sqrt(40 * (1 / 2 + 1 / 8)), rel=1e-14)
    assert mode.frequency == pytest.approx(mode.omega / (2 * math.pi))
    assert mode.shape == pytest.approx({"1": 1.0, "2": -0.25})
    assert mode.torques == pytest.approx({"shaft 1": 40 * 1.25})
    assert mode.kinetic == pytest.approx({"1": 0.8, "2": 0.2})
    assert mode.elastic == {"shaft 1": 1.0}
    assert mode.nodes == 1
    assert (mode.damping_ratio, mode.damped_frequency) == (0.0, mode.frequency)
    assert gear.damped == []


@settings(max_examples=count(24, 180))
@given(branched())
def test_every_system_of_springs(case: Transmission) -> None:
    """Sum of omega^2 = trace of M^-1 K; orthogonal in M and K; shares add up; M^-1 K x = w^2 x."""
    gear = only(case)
    mass, stiffness, _ = matrices(case)
    squares = np.square(omegas(gear))
    assert squares.sum() == pytest.approx(np.trace(linalg.solve(mass, stiffness)), rel=1e-11)
    x = shapes(gear)
    for matrix in (mass, stiffness):
        product = x.T @ matrix @ x
        size = np.sqrt(np.outer(np.diag(product), np.diag(product)))
        assert np.abs((product - np.diag(np.diag(product))) / size).max(initial=0) < 1e-9
    np.testing.assert_allclose(stiffness @ x, (mass @ x) * squares, atol=1e-9 * squares.max())
    for mode in gear.modes:
        assert sum(mode.kinetic.values()) == pytest.approx(1, abs=1e-12)
        assert sum(mode.elastic.values()) == pytest.approx(1, abs=1e-12)
        assert 1.0 in mode.shape.values()
        assert max(map(abs, mode.shape.values())) == pytest.approx(1, abs=1e-9)
    twists = [[one.form.get(n, 0.0) for n in range(1, case.links + 1)] for one in case.springs]
    rank = np.linalg.matrix_rank(np.array(twists))
    assert (len(gear.modes), gear.rigid_modes) == (rank, case.links - rank)


def test_a_soft_support_is_an_ordinary_mode() -> None:
    """``omega^2 = c/(J1 + J2)`` beside a shaft 1e19 times as stiff."""
    case = chain([1.0, 2.0], [1e10])
    soft = case.replace(springs=[*case.springs, Spring({1: 1}, stiffness=1e-9, name="string")])
    gear = only(soft)
    assert gear.rigid_modes == 0
    assert gear.modes[0].omega == pytest.approx(math.sqrt(1e-9 / 3), rel=1e-6)
    assert gear.modes[0].elastic["string"] == pytest.approx(1)


def test_what_stands_together_is_one_node() -> None:
    """Wheels in antiphase on half-shafts: all between engine and differential stands, (2.2).

    Two of three equal ones have the same frequency, and shapes of their own.
    """
    [antiphase] = [mode for mode in only(wheels()).modes if mode.omega == pytest.approx(5.0)]
    assert antiphase.nodes == 1
    springs = [Spring({1: 1, 2: -1, 3: -1}, stiffness=5.0), Spring({3: 1}, stiffness=9.0)]
    inertias = {1: 1.0, 2: 2.0, 3: 0.1}
    axle = only(sprung(3, springs, inertias))
    assert axle.modes[0].nodes == 1
    springs = [Spring({1: 1, n: -1}, stiffness=50.0) for n in (2, 3, 4)]
    masses = [9.0, 2.0, 2.0, 2.0]
    gear = only(sprung(4, springs, dict(enumerate(masses, 1))))
    assert omegas(gear) == pytest.approx([5.0, 5.0, math.sqrt(50 * (1 / 2 + 3 / 9))], rel=1e-13)
    assert abs(shapes(gear)[:, 0] @ np.diag(masses) @ shapes(gear)[:, 1]) < 1e-12


def test_a_tie_of_the_largest_amplitude_goes_to_the_first_link() -> None:
    [mode] = only(chain([2.0, 2.0], [1.0])).modes
    assert mode.shape == pytest.approx({"1": 1.0, "2": -1.0}, abs=1e-15)


def test_massless_links_follow_and_infinite_frequencies_are_left_out() -> None:
    """Two shafts in a row are one: 1/(1/c1 + 1/c2)."""
    gear = only(chain([2.0, 0.0, 8.0], [60.0, 120.0]))
    [mode] = gear.modes
    assert mode.omega == pytest.approx(5.0)
    assert mode.torques["shaft 1"] == pytest.approx(mode.torques["shaft 2"])
    assert mode.kinetic["2"] == 0


def test_without_inertia_or_with_one_mass_between_massless_links_there_is_no_mode() -> None:
    springs = chain([1.0] * 3, [500.0, 300.0], [0.0, 1.0]).springs
    with pytest.raises(CaseError, match="nothing has an inertia"):
        modes(Transmission(3, [], [], [], springs=springs))
    gear = only(sprung(3, springs, {2: 1.0}))
    assert (gear.rigid_modes, gear.modes) == (1, [])


def test_what_nothing_moves_or_holds_is_left_out_with_a_warning() -> None:
    """Link 3 hangs on an open clutch, without inertia."""
    case = chain([2.0, 8.0], [40.0])
    loose = Transmission(
        3, [ShiftElement(2, 3, name="C")], [], [Gear([]), Gear([1])], springs=case.springs,
        inertias={1: 2.0, 2: 8.0}, output=2,
    )  # fmt: skip
    opened, closed = modes(loose)
    assert omegas(opened) == pytest.approx([5.0])
    assert omegas(closed) == pytest.approx([5.0])
    assert math.isnan(opened.modes[0].shape["3"])
    [warning] = opened.warnings
    assert warning.startswith("3 has neither an inertia nor a component that resists")
    assert closed.modes[0].shape["3"] == pytest.approx(-0.25)
    assert closed.warnings == []
    assert closed.modes[0].torques["C"] == pytest.approx(0, abs=1e-12)


def test_redundant_devices_have_no_torque_of_their_own() -> None:
    springs = chain([2.0, 8.0], [40.0]).springs
    twice = [ShiftElement(2, 3, name="C"), ShiftElement(2, 3, name="D")]
    case = Transmission(
        3, twice, [], [Gear([1, 2])], springs=springs, output=3, inertias={1: 2.0, 3: 8.0}
    )
    gear = only(case)
    told = "C and D: 1 component is in excess; the speeds agree, the torque of C and D is not "
    assert gear.warnings == [f"{told}determined"]
    assert math.isnan(gear.modes[0].torques["C"])
    assert gear.modes[0].torques["shaft 1"] == pytest.approx(50)


def test_a_tied_up_gear_says_why_and_elastic_devices_tie_nothing_up() -> None:
    brakes = [ShiftElement(2, name="B"), ShiftElement(1, 2, name="C")]
    case = Transmission(
        2, brakes, [], [Gear([1, 2])], springs=[Spring({1: 1}, stiffness=1.0)], inertias={1: 1.0}
    )
    assert only(case).error.startswith("tied up: B and C let nothing move")
    assert only(case).modes == ()
    elastic = case.replace(shift_elements=[brakes[0], brakes[1]._replace(stiffness=8.0)])
    assert omegas(only(elastic)) == pytest.approx([3.0])


@settings(max_examples=count(12, 90))
@given(branched())
def test_a_gear_whose_input_is_held_vibrates(case: Transmission) -> None:
    """M and K without the row and the column of the input have its frequencies."""
    mass, stiffness, _ = matrices(case)
    squares = linalg.eigh(stiffness[1:, 1:], mass[1:, 1:], eigvals_only=True)
    brake = ShiftElement(1, name="H")
    gear = only(case.replace(shift_elements=[brake], gears=[Gear([1], name="park")]))
    found = np.concatenate([np.zeros(gear.rigid_modes), omegas(gear)])
    assert (gear.error, len(found)) == ("", case.links - 1)
    np.testing.assert_allclose(found**2, squares, rtol=1e-9, atol=1e-9 * squares.max())


def test_so_many_modes_as_are_asked_for_of_gears_called_as_elsewhere() -> None:
    case = chain([1.0] * 60, [10.0] * 59)
    assert len(only(case, count=59).modes) == 59
    assert len(only(chain([1.0] * 50, [10.0] * 49)).modes) == 49
    own = omegas(only(case))
    assert len(own) == 20
    assert omegas(only(case, count=3)) == pytest.approx(own[:3])
    shipped = load(CASES / "moskvich412.yaml")
    assert [gear.name for gear in modes(shipped, ["4", "#5"])] == ["4", "1 at stop"]
    with pytest.raises(ValueError, match="no gear '5'"):
        modes(shipped, ["5"])


def test_many_links_by_sparse_matrices() -> None:
    """A chain of 340 masses, clamped by a soft spring at one end; against all modes at once."""
    case = chain([1.0 + n % 3 for n in range(340)], [100.0 + n % 5 for n in range(339)])
    case = case.replace(springs=[*case.springs, Spring({1: 1}, stiffness=0.5)])
    mass, stiffness, _ = matrices(case)
    expected = np.sqrt(linalg.eigh(stiffness, mass, eigvals_only=True, subset_by_index=[0, 5]))
    assert omegas(only(case, count=6)) == pytest.approx(expected, rel=1e-9)


def test_sensitivities_are_differences_of_the_frequencies() -> None:
    case = with_planetary_set()
    [mode, *_] = modes(case)[0].modes
    step = 1e-6
    for number, spring in enumerate(case.springs):
        springs = list(case.springs)
        springs[number] = spring._replace(stiffness=spring.rate * (1 + step))
        changed = modes(case.replace(springs=springs))[0].modes[0].omega
        slope = (changed / mode.omega - 1) / step
        assert slope == pytest.approx(mode.by_stiffness[spring.name], abs=1e-6)
    for link, inertia in case.inertias.items():
        heavier = case.replace(inertias={**case.inertias, link: inertia * (1 + step)})
        slope = (modes(heavier)[0].modes[0].omega / mode.omega - 1) / step
        assert slope == pytest.approx(mode.by_inertia[str(link)], abs=1e-6)


def told(gear: GearModes) -> list[list[str]]:
    energy = next(one for one in modes_grids([gear]) if one.key == "energy")
    return [[cell if isinstance(cell, str) else cell.text for cell in row] for row in energy.rows]


@pytest.mark.parametrize("side", ["left", "right"])
def test_of_two_equal_shares_the_first_is_named_on_any_processor(side: str) -> None:
    """Both tyres of the driveline swing with the same energy; rounding makes one larger."""
    [gear, *_] = modes(load(CASES / "driveline-8hp70.yaml"))
    assert "left tyre" in [row[2] for row in told(gear)]

    def moved(shares: dict[str, float]) -> dict[str, float]:
        return {n: math.nextafter(part, part + n.startswith(side)) for n, part in shares.items()}

    other = []
    for each in gear.modes:
        elastic, kinetic = moved(dict(each.elastic)), moved(dict(each.kinetic))
        other.append(each._replace(elastic=elastic, kinetic=kinetic))
    assert told(gear._replace(modes=other)) == told(gear)
