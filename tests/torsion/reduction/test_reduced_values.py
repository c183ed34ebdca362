"""Inertias and compliances on one link."""

import math

import numpy as np
import pytest
from scipy import linalg

from tests.chance import count, seeded
from tests.torsion.systems import sprung, with_planetary_set
from vstatics import Gear, Mechanism, ShiftElement, Spring, Transmission, loads
from vstatics.torsion.reduction.reduced_scheme import gear_scheme
from vstatics.torsion.reduction.reduced_values import NO_REACTION, reduce
from vstatics.torsion.reduction.scheme import TorsionScheme, natural_frequencies
from vstatics.torsion.reduction.simplification import simplify
from vstatics.torsion.vibration.gear_modes import modes


def test_a_gearbox_with_a_compliant_casing() -> None:
    """(1.22), (1.23): ``J/(1 - i)^2``, ``E (1 - i)^2``; at i = 1 there is no reaction."""
    i = 3.49
    case = Transmission(
        3, [], [Mechanism(1, 2, 3, i, name="box")], [], output=2,
        inertias={1: 0.2, 2: 3.0, 3: 0.4}, springs=[Spring({3: 1}, compliance=2e-4, name="mount")],
    )  # fmt: skip
    [found] = reduce(case, 1)
    assert found.inertias == pytest.approx({"1": 0.2, "2": 3.0 / i**2, "3": 0.4 / (1 - i) ** 2})
    assert found.compliances == pytest.approx({"mount": 2e-4 * (1 - i) ** 2})
    [to_output] = reduce(case, 2)
    assert to_output.inertias["3"] == pytest.approx(0.4 / (1 / i - 1) ** 2)
    [at_1] = reduce(case.replace(mechanisms=[Mechanism(1, 2, 3, 1.0)]), 1)
    assert at_1.inertias["3"] is at_1.compliances["mount"] is at_1.ratios["3"] is None
    assert at_1.notes == {"3": NO_REACTION}


def test_a_train_of_two_mechanisms_on_one_casing_has_one_reaction() -> None:
    """1 - i of the whole train, i = 2*3."""
    case = Transmission(
        4, [], [Mechanism(1, 2, 4, 2.0), Mechanism(2, 3, 4, 3.0)], [], output=3,
        inertias={1: 1.0, 4: 5.0}, springs=[Spring({4: 1}, stiffness=9.0, name="mount")],
    )  # fmt: skip
    assert reduce(case, 1)[0].inertias["4"] == pytest.approx(5.0 / 25)


def omegas_of_scheme(case: Transmission) -> tuple[float, ...]:
    scheme = gear_scheme(case, case.gears[0])
    assert isinstance(scheme, TorsionScheme)
    return natural_frequencies(scheme)


@pytest.mark.parametrize("twist", [{3: 2, 4: -1}, {4: -1, 3: 2}])
def test_a_frame_behind_the_casing_is_scaled_by_the_mount(twist: dict[int, float]) -> None:
    """The casing by 1 - i = -2, and the frame by half as much, as it twists the mount half."""
    i = 3.0
    case = Transmission(
        4, [], [Mechanism(1, 2, 3, i, stiffness=800.0)], [], output=2,
        inertias={1: 0.2, 2: 3.0, 3: 0.4, 4: 8.0},
        springs=[Spring(twist, stiffness=70.0, name="mount"),
                 Spring({4: 1}, stiffness=900.0, name="frame")],
    )  # fmt: skip
    [found] = reduce(case, 1)
    assert found.inertias == pytest.approx({"1": 0.2, "2": 3 / 9, "3": 0.4 / 4, "4": 8.0})
    expected = {"D1": 1 / 800, "mount": 1 / 70, "frame": 1 / 900}
    assert found.compliances == pytest.approx(expected)
    omegas = [mode.omega for mode in modes(case)[0].modes]
    assert omegas_of_scheme(case) == pytest.approx(omegas, rel=1e-11)


def test_a_ring_gear_on_the_casing_takes_the_reaction_with_it() -> None:
    """The casing takes ``1 - 3*4`` of a torque at the engine: of the set and of the final drive."""
    case = Transmission(
        5, [ShiftElement(2, 5, name="brake")],
        [Mechanism(1, 2, 3, -2.0, name="set"), Mechanism(3, 4, 5, 4.0, stiffness=900.0)],
        [Gear([1])], output=4, inertias={1: 0.2, 4: 3.0, 5: 0.5},
        springs=[Spring({5: 1}, compliance=0.01, name="mount")],
    )  # fmt: skip
    [found] = reduce(case, 1)
    assert found.merged == {"2": ["5"]}
    assert found.inertias["2"] == pytest.approx(0.5 / 11**2)
    assert found.compliances["mount"] == pytest.approx(0.01 * 11**2)


def test_what_does_not_turn_with_the_link_has_no_value() -> None:
    case = Transmission(
        4, [ShiftElement(2, 3, name="C")], [], [Gear([]), Gear([1])], output=4,
        inertias={1: 1.0, 4: 2.0},
        springs=[Spring({1: 1, 2: -1}, stiffness=5.0, name="a"),
                 Spring({3: 1, 4: -1}, stiffness=7.0, name="b")],
    )  # fmt: skip
    opened, closed = reduce(case, 1)
    assert opened.inertias["4"] is opened.compliances["b"] is None
    assert (closed.inertias["4"], closed.merged) == (2.0, {"2": ["3"]})


@pytest.mark.parametrize("stiffness", [None, 700.0])
def test_the_scheme_of_a_gear_has_its_frequencies(stiffness: float | None) -> None:
    case = with_planetary_set()
    mechanisms = [case.mechanisms[0]._replace(stiffness=stiffness)]
    inertias = {**case.inertias, 2: 0.0 if stiffness is None else 0.01}
    case = case.replace(mechanisms=mechanisms, inertias=inertias)
    expected = [mode.omega for mode in modes(case, ["low"])[0].modes]
    assert omegas_of_scheme(case) == pytest.approx(expected, rel=1e-10)


def test_a_rigid_set_with_inertia_on_all_its_links_is_a_stiff_spring() -> None:
    """One frequency more, far above, which is the first to be taken out."""
    case = with_planetary_set()
    expected = [mode.omega for mode in modes(case, ["low"])[0].modes]
    *own, stiff = omegas_of_scheme(case)
    assert own == pytest.approx(expected, rel=1e-7)
    assert stiff > 1000 * own[-1]
    scheme = gear_scheme(case, case.gears[0])
    assert isinstance(scheme, TorsionScheme)
    [step] = simplify(scheme, 3).steps
    assert step.omegas[0] == pytest.approx(expected[0], rel=0.003)
    assert step.omegas == pytest.approx(expected, rel=0.1)


def test_a_scheme_has_the_frequencies_of_its_planets_or_none() -> None:
    """Planets of 30 teeth turn at 2 w_c - w_s.

    A scheme does not exist if the inertia of the carrier is less than 4*0.1 kg*m^2.
    """
    twists = np.array([(0, 0, 1, -1), (0, 1, 0, 0)])
    refused = set()
    for carrier in (0.0, 0.02, 0.1, 0.5):
        case = loads(
            "links: [sun, ring, carrier, vehicle]\noutput: vehicle\n"
            f"inertias: {{sun: 0.2, ring: 0.3, carrier: {carrier}, vehicle: 4}}\n"
            "springs: {out: {links: [carrier, vehicle], stiffness: 2500},\n"
            "  mount: {links: [ring, housing], stiffness: 4000}}\n"
            "elements:\n  P: {kind: planetary, sun: sun, ring: ring, carrier: carrier,\n"
            "    teeth: {sun: 30, ring: 90}, planets: 1, planet: {inertia: 0.1, mass: 0, radius: 1}}\n"
        )
        motions = np.array([[-3, 4, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])  # of ring, carrier
        spin = np.array([-1, 0, 2, 0]) @ motions
        mass = motions.T @ np.diag([0.2, 0.3, carrier, 4]) @ motions + 0.1 * np.outer(spin, spin)
        rows = twists @ motions
        squares = linalg.eigh(rows.T @ np.diag([2500, 4000]) @ rows, mass, eigvals_only=True)
        scheme = gear_scheme(case, case.gears[0])
        if isinstance(scheme, TorsionScheme):
            found = natural_frequencies(scheme)[:2]
            assert found == pytest.approx(np.sqrt(squares[1:]), rel=1e-6)
        else:
            refused.add(carrier)
    assert refused == {0.0, 0.02, 0.1}  # (3 w_r - 2 w_c)^2 is w_s^2/2 + 4.5 w_r^2 - 4 w_c^2


def test_planets_are_reduced_by_the_squares_of_their_speeds() -> None:
    """Sun 30, ring 90 held, planets 30: the carrier has 1/4 of the speed of the sun.

    About their axes planets have w_h + (w_h - w_r)*90/30 = -2 w_h seen from the housing, so
    -1/2 of the sun; their orbit is that of the carrier.
    """
    case = loads(
        "links: [sun, carrier]\noutput: carrier\ninertias: {sun: 0.2, carrier: 3.0}\n"
        "elements:\n  P: {kind: planetary, sun: sun, ring: housing, carrier: carrier,\n"
        "    teeth: {sun: 30, ring: 90}, planets: 3,\n"
        "    planet: {inertia: 0.004, mass: 0.5, radius: 0.1}}\n"
    )
    [found] = reduce(case, "sun")
    spin, orbit = 3 * 0.004 / 2**2, 3 * 0.5 * 0.1**2 / 4**2
    assert found.inertias["P.planet"] == pytest.approx(spin + orbit)
    assert found.inertias["sun"] == pytest.approx(0.2 + 3.0 / 4**2)


def test_an_axle_over_the_mean_of_two_wheels_has_its_frequencies() -> None:
    """Its twist has halves, which are not rounded."""
    springs = [
        Spring({1: 1, 2: -0.5, 3: -0.5}, stiffness=900.0, name="axle"),
        Spring({2: 1, 4: -1}, stiffness=700.0, name="left"),
        Spring({3: 1, 4: -1}, stiffness=600.0, name="right"),
    ]
    case = sprung(4, springs, {1: 0.2, 2: 0.5, 3: 0.8, 4: 40.0})
    rows = np.array([[1, -0.5, -0.5, 0], [0, 1, 0, -1], [0, 0, 1, -1]])
    stiffness = rows.T @ np.diag([900.0, 700.0, 600.0]) @ rows
    squares = linalg.eigh(stiffness, np.diag([0.2, 0.5, 0.8, 40.0]), eigvals_only=True)
    assert omegas_of_scheme(case) == pytest.approx(np.sqrt(squares[1:]), rel=1e-11)


def test_pairs_of_any_ratio_in_a_row_are_reduced_by_its_square() -> None:
    """J/u^2, E u^2 and d/u^2 behind pairs of the ratio u together, forward or reversed."""
    rng = seeded(3)
    for _ in range(count(20, 1000)):
        ratios = [rng.choice((1, -1)) * rng.uniform(0.3, 5) for _ in range(rng.randint(1, 4))]
        links = len(ratios) + 2
        case = Transmission(
            links, [], [Mechanism(n, n + 1, 0, u) for n, u in enumerate(ratios, 1)], [],
            output=links, inertias={1: 0.1, links - 1: 2.0, links: 9.0},
            springs=[Spring({links - 1: 1, links: -1}, compliance=3e-4, damping=0.7, name="shaft")],
        )  # fmt: skip
        [found] = reduce(case, 1)
        square = math.prod(ratios) ** 2
        assert found.inertias == pytest.approx({"1": 0.1 + 2.0 / square, str(links): 9.0 / square})
        assert found.compliances["shaft"] == pytest.approx(3e-4 * square)
        assert found.ratios[str(links)] == pytest.approx(math.prod(ratios))
        scheme = gear_scheme(case, case.gears[0])
        assert isinstance(scheme, TorsionScheme)
        [spring] = scheme.springs
        assert (spring.compliance, spring.damping) == pytest.approx((3e-4 * square, 0.7 / square))
