"""Springs, dampings and inertias given to the library."""

import math
import pickle
from typing import Any

import pytest

from tests.rejects import rejects
from vstatics import CaseError, Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.model.checks import doubts, hints
from vstatics.core.model.parts import NO_DAMPING, Damping, damping
from vstatics.core.model.springs import Spring, between, ends


def made(*springs: Spring, **others: Any) -> Transmission:
    return Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()], springs=springs, **others)


def test_a_spring_has_one_rate_whichever_is_given() -> None:
    assert Spring(between(1, 2), stiffness=500).rate == 500
    assert Spring(between(1, 2), compliance=1 / 1024).rate == 1024


def test_a_half_shaft_to_a_link_without_inertia_never_twists() -> None:
    """A link with an inertia of 0 is deliberate."""
    shaft = Spring(between(2, 3), stiffness=9e3, name="shaft")
    case = Transmission(3, [], [Mechanism(1, 2, 0, 4.0)], [Gear()], springs=[shaft], output=2)
    for given, ids in (({}, ["N207"]), ({3: 0.0}, [])):
        assert [note.id for note in hints(case.replace(inertias={1: 0.2, **given}))] == ids


def test_the_housing_has_no_part_in_a_twist() -> None:
    for twist in (between(2), {2: 1}, {2: 1, 0: -1}, ((2, 1), (0, 5))):
        [spring] = made(Spring(twist, stiffness=3)).springs
        assert (spring.form, ends(spring.twist)) == ({2: 1.0}, (2, 0))
    assert ends({2: -1.0}) == (0, 2)
    assert ends({2: 2.0}) is None
    assert ends({2: 1.0, 1: -1.5}) is None


def test_a_case_fills_in_names_and_kinds_of_numbers() -> None:
    first = Spring({1: 1, 2: -1}, stiffness=3, damping=2)
    case = made(first, Spring({1: 1}, compliance=1), inertias={1: 2})
    assert [spring.name for spring in case.springs] == ["S1", "S2"]
    twist = (1, 1.0), (2, -1.0)
    assert case.springs[0] == Spring(twist, stiffness=3.0, damping=Damping(2.0), name="S1")
    assert case.devices == ["D1", "S1", "S2"]
    assert case.inertias == {1: 2.0}
    assert pickle.loads(pickle.dumps(case)) == case  # noqa: S301 - our own
    assert repr(case).endswith("1 mechanism, 1 gear, 2 springs>")


def test_springs_alone_have_one_gear() -> None:
    case = Transmission(1, [], [], [], springs=[Spring(between(1), stiffness=3)])
    assert case.gears == (Gear(name="1"),)
    with pytest.raises(CaseError, match=r"expected the shift elements that each gear .* \[T1\]"):
        Transmission(2, [ShiftElement(2)], [Mechanism(1, 2, 0, 2)], [])


def test_a_damping_may_be_a_number() -> None:
    assert damping(3) == Damping(3.0)
    assert damping(Damping(loss_factor=0.1)) == Damping(0.0, 0.1)
    assert not NO_DAMPING
    assert Damping(loss_factor=0.1)


STAGES = [(0, 0), (0.02, 0), (0.05, 30), (0.06, 90)]
"""A clutch disc: play, a soft stage, a stiff one."""
STEEL = Spring(between(1, 2), stiffness=3.0)
CURVE = STEEL._replace(stiffness=None, points=STAGES)


FAULTS = (
    (STEEL._replace(stiffness=math.nan), "springs[1].stiffness: read nan, expected"),
    (STEEL._replace(stiffness=math.inf), "springs[1].stiffness: read inf, expected"),
    (STEEL._replace(stiffness=1e-320), "9.99989e-321, expected a stiffness that is larger"),
    (STEEL._replace(damping=math.inf), "springs[1].damping.viscous: read inf, expected a damp"),
    (STEEL._replace(twist={0: 1}), "springs[1].twist: read an empty twist"),
    (STEEL._replace(twist={1: 1, 2: math.nan}), "twist[2]: read nan, expected a finite coeff"),
    (STEEL._replace(twist={1: 1, 4: 2}), "[4]: read 4, expected a link number from 1 to 3"),
    (STEEL._replace(twist=between(1, 4)), "springs[1].second: read 4, expected a link number"),
    (STEEL._replace(name="D1"), "springs[1]: `D1` is also the name of a mechanism, expected"),
    (STEEL._replace(name="a\nb"), "expected one line of text"),
    (STEEL._replace(friction=-1), "friction: read -1, expected a torque of 0 or more"),
    (CURVE._replace(points=[(0, 0), (0.1, 5), (0.1, 6)]), "3][1]: read 0.1 after 0.1, expec"),
    (CURVE._replace(points=[(0, 0), (0.1, 5), (0.2, 4)]), "3][2]: read 4 after 5, expected t"),
    (CURVE._replace(points=[(0, 1), (0.1, 5)]), "1]: read 0, 1, expected [0, 0] first"),
    (CURVE._replace(points=[(0, 0), (0.1, 0)]), "at least two points, and a torque that rises"),
    (CURVE._replace(stiffness=5), "stiffness: read `stiffness` with `points`"),
    (CURVE._replace(limit=5), "limit: read `limit` with `points`"),
    (CURVE._replace(damping=Damping(1, 0.1)), "read a loss factor or ratio with"),
)


def test_a_spring_that_cannot_be_is_reported() -> None:
    """Faults that a document can have too are in `tests/bad`."""
    for spring, said in FAULTS:
        with rejects(CaseError, said) as caught:
            made(spring)
        assert len(caught.value.problems) == 1


def test_an_inertia_a_rigid_part_and_a_second_spring_that_cannot_be_are_reported() -> None:
    for inertias, said in (
        ({1: math.nan}, "inertias[1]: read nan, expected an inertia of 0 or more"),
        ({2: math.inf}, "inertias[2]: read inf"),
        ({4: 1}, "inertias[4]: read 4, expected a link number from 1 to 3"),
    ):
        with rejects(CaseError, said):
            made(inertias=inertias)
    rigid = ShiftElement(1, damping=Damping(1))
    with pytest.raises(CaseError, match=r"shift_elements\[1\].damping: read a damping without"):
        Transmission(2, [rigid], [Mechanism(1, 2, 0, 2)], [Gear()])
    with pytest.raises(CaseError, match="spring 2 has the name of spring 1, expected another name"):
        made(STEEL, STEEL._replace(name="S1"))


def test_points_hold_in_both_directions_and_go_on_with_their_last_slope() -> None:
    """Points with a twist below 0 are used as given, without a mirror image."""
    curve = Spring(between(1, 2), points=STAGES).curve
    torques = {0.0: 0.0, 0.02: 0.0, 0.035: 15.0, 0.05: 30.0, 0.07: 150.0}  # by hand
    for sign in (1, -1):
        found = {twist: sign * curve.at(sign * twist) for twist in torques}
        assert found == pytest.approx(torques)
    curve = Spring(between(1, 2), points=[(-0.1, -5), (0.1, -5), (0.2, 15)]).curve
    assert [curve.at(twist) for twist in (-9, 0, 0.15, 0.3)] == pytest.approx([-5, -5, 5, 35])


def test_the_energy_of_points_is_their_integral() -> None:
    curve = Spring(between(1, 2), points=STAGES).curve
    triangle, trapezium = 0.03 * 30 / 2, 0.01 * (30 + 90) / 2
    for twist in (0.06, -0.06):
        assert curve.energy(twist) == pytest.approx(triangle + trapezium)
    assert curve.energy(0.01) == 0
    assert Spring(between(1), stiffness=500).curve.energy(-0.2) == pytest.approx(500 * 0.02)


def test_of_a_torque_points_tell_twist_and_slope() -> None:
    """In play the twist is the one nearest 0; a torque beyond a flat end has none."""
    stages = Spring(between(1, 2), points=STAGES).curve
    play = Spring(between(1), points=[(-0.2, -9), (0.05, 0), (0.1, 0), (0.2, 7)]).curve
    flat = Spring(between(1), points=[(0, 0), (0.1, 8), (0.3, 8)]).curve
    for curve, torque, twist, slope in (
        *((stages, 0, 0, 0), (stages, 15, 0.035, 1000), (stages, -15, -0.035, 1000)),
        *((stages, 30, 0.05, 6000), (stages, 300, 0.095, 6000)),
        (play, 0, 0.05, 0),
        (flat, 8.5, None, 0),
    ):
        assert curve.twist_at(torque) == pytest.approx(twist)
        assert curve.slope_at(torque) == pytest.approx(slope)
    assert [flat.twist_at(torque) for torque in (8, -9)] == [pytest.approx(0.1), None]


def test_a_damping_ratio_in_percent_without_the_sign_is_noted() -> None:
    """Source: ratios in percent, as in github.com/IEAWindSystems/IEA-22-280-RWT/pull/47."""
    for ratio, noted in ((5.0, ["N205"] * 2), (0.05, [])):
        elastic: Any = {"stiffness": 9e3, "damping": Damping(loss_factor=2 * ratio)}
        clutch, shaft = ShiftElement(1, 2, "C", **elastic), Spring(between(1, 2), **elastic)
        case = Transmission(2, [clutch], [], [], springs=[shaft], inertias={1: 0.2, 2: 3.0})
        assert [doubt.id for doubt in doubts(case)] == noted


def test_twists_in_degrees_without_the_unit_are_noted() -> None:
    """40 rad are six turns; the extension of a straight spring is in m."""
    for twist, given, noted in (
        (40.0, "inertias", ["N205"]),
        (0.7, "inertias", []),
        (40.0, "masses", []),
    ):
        arc = Spring(between(1, 2), points=((-twist, -330.0), (twist, 330.0)), name="arc")
        case = Transmission(2, [], [], [], springs=[arc]).replace(**{given: {1: 2.0, 2: 3.0}})
        assert [doubt.id for doubt in doubts(case)] == noted
