"""Springs, dampings and inertias given to the library."""

from __future__ import annotations

import math
import pickle
import re
from typing import Any

import pytest

from vstatics import CaseError, Gear, Mechanism, ShiftElement, Transmission
from vstatics.model.parts import NO_DAMPING, Damping, damping
from vstatics.model.springs import Spring, between, ends


def made(*springs: Spring, **others: Any) -> Transmission:
    return Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()], springs=springs, **others)


def test_a_spring_has_one_rate_whichever_is_given() -> None:
    assert Spring(between(1, 2), stiffness=500).rate == 500
    assert Spring(between(1, 2), compliance=1 / 1024).rate == 1024


def test_the_housing_has_no_part_in_a_twist() -> None:
    for twist in (between(2), {2: 1}, {2: 1, 0: -1}, ((2, 1), (0, 5))):
        [spring] = made(Spring(twist, stiffness=3)).springs
        assert (spring.form, ends(spring.twist)) == ({2: 1.0}, (2, 0))
    assert ends({2: -1.0}) == (0, 2)
    assert ends({2: 2.0}) is None
    assert ends({2: 1.0, 1: -1.5}) is None


def test_a_case_fills_in_names_and_kinds_of_numbers() -> None:
    case = made(
        Spring({1: 1, 2: -1}, stiffness=3, damping=2),
        Spring({1: 1}, compliance=1),
        inertias={1: 2},
    )
    assert [spring.name for spring in case.springs] == ["S1", "S2"]
    assert case.springs[0] == Spring(
        ((1, 1.0), (2, -1.0)), stiffness=3.0, damping=Damping(2.0), name="S1"
    )
    assert case.devices == ["D1", "S1", "S2"]
    assert case.inertias == {1: 2.0}
    assert pickle.loads(pickle.dumps(case)) == case  # noqa: S301 - our own
    assert repr(case).endswith("1 mechanism, 1 gear, 2 springs>")


def test_springs_alone_have_one_gear() -> None:
    case = Transmission(1, [], [], [], springs=[Spring(between(1), stiffness=3)])
    assert case.gears == (Gear(name="1"),)
    with pytest.raises(CaseError, match="there is no gear"):
        Transmission(2, [], [Mechanism(1, 2, 0, 2)], [])


def test_a_damping_may_be_a_number() -> None:
    assert damping(3) == Damping(3.0)
    assert damping(Damping(loss_factor=0.1)) == Damping(0.0, 0.1)
    assert not NO_DAMPING
    assert Damping(loss_factor=0.1)


STEEL = Spring(between(1, 2), stiffness=3.0)


@pytest.mark.parametrize(
    ("spring", "said"),
    [
        (STEEL._replace(stiffness=0), "springs[1].stiffness: read 0, expected a stiffness above 0"),
        (STEEL._replace(stiffness=math.nan), "springs[1].stiffness: read nan, expected a stiffness"),
        (STEEL._replace(stiffness=math.inf), "springs[1].stiffness: read inf, expected a stiffness"),
        (STEEL._replace(stiffness=1e-320), "read 9.99989e-321, expected a stiffness that is not so"),
        (STEEL._replace(stiffness=None), "springs[1]: there is no `stiffness` and no `compliance`"),
        (STEEL._replace(compliance=1), "springs[1]: read both `stiffness` and `compliance`"),
        (Spring(between(1), None, -1), "springs[1].compliance: read -1, expected a compliance above"),
        (STEEL._replace(damping=-1), "springs[1].damping.viscous: read -1, expected a damping of 0"),
        (STEEL._replace(damping=math.inf), "springs[1].damping.viscous: read inf, expected a damp"),
        (STEEL._replace(damping=Damping(0, -1)), "damping.loss_factor: read -1, expected a loss fac"),
        (STEEL._replace(twist={}), "springs[1].twist: the twist is empty, expected at least one"),
        (STEEL._replace(twist={0: 1}), "springs[1].twist: the twist is empty"),
        (STEEL._replace(twist={1: 1, 2: 0}), "twist[2]: read 0, expected a finite coefficient other"),
        (STEEL._replace(twist={1: 1, 2: math.nan}), "twist[2]: read nan, expected a finite coeff"),
        (STEEL._replace(twist={1: 1, 2: math.inf, 3: 1}), "twist[2]: read inf, expected a finite"),
        (STEEL._replace(twist={1: 1, 4: 2}), "twist[4]: read 4, expected a link number from 1 to 3"),
        (STEEL._replace(twist=between(1, 4)), "springs[1].second: read 4, expected a link number"),
        (STEEL._replace(twist=between(1, 1)), "springs[1].second: joins link 1 to itself"),
        (STEEL._replace(twist=between(0, 0)), "springs[1].second: joins link 0 (the housing) to"),
        (STEEL._replace(name="D1"), "springs[1]: `D1` is the name of a mechanism too, expected"),
        (STEEL._replace(name="a\nb"), "expected one line of text"),
    ],
)  # fmt: skip
def test_a_spring_that_cannot_be_is_told(spring: Spring, said: str) -> None:
    with pytest.raises(CaseError, match=re.escape(said)) as caught:
        made(spring)
    assert len(caught.value.problems) == 1


@pytest.mark.parametrize(
    ("inertias", "said"),
    [
        ({1: -1}, "inertias[1]: read -1, expected an inertia of 0 or more"),
        ({1: math.nan}, "inertias[1]: read nan, expected an inertia of 0 or more"),
        ({2: math.inf}, "inertias[2]: read inf"),
        ({0: 1}, "inertias[0]: read 0 (the housing), expected a link number from 1 to 3"),
        ({4: 1}, "inertias[4]: read 4, expected a link number from 1 to 3"),
    ],
)
def test_an_inertia_that_cannot_be_is_told(inertias: dict[int, float], said: str) -> None:
    with pytest.raises(CaseError, match=re.escape(said)):
        made(inertias=inertias)


@pytest.mark.parametrize(
    ("elastic", "said"),
    [
        ({"stiffness": 0}, "stiffness: read 0, expected a stiffness above 0"),
        ({"stiffness": 3, "damping": -1}, "damping.viscous: read -1, expected a damping of 0 or more"),
        ({"damping": 1}, "damping: there is a damping without `stiffness`"),
    ],
)  # fmt: skip
def test_a_device_that_cannot_be_elastic_so_is_told(elastic: dict[str, Any], said: str) -> None:
    with pytest.raises(CaseError, match=re.escape(f"mechanisms[1].{said}")):
        Transmission(2, [], [Mechanism(1, 2, 0, 2, **elastic)], [Gear()])
    brake = ShiftElement(1, **elastic)
    with pytest.raises(CaseError, match=re.escape(f"shift_elements[1].{said}")):
        Transmission(2, [brake], [Mechanism(1, 2, 0, 2)], [Gear()])


def test_two_springs_have_two_names() -> None:
    with pytest.raises(CaseError, match="spring 2 has the name `S1` of spring 1"):
        made(STEEL, STEEL._replace(name="S1"))
