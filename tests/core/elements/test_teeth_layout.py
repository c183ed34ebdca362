"""Wheels of one element fit between their axes."""

from __future__ import annotations

from dataclasses import replace

from tests.core.elements.toothed import UMDM, element, told
from vstatics.core.elements import CentralWheel


def test_a_ring_holds_the_sun_and_two_planets() -> None:
    assert not told(element("planetary", sun=48, ring=96, planet=24), "ring 96 is not")
    (close,) = told(
        element("planetary", sun=48, ring=98, planet=24), "ring 98 is not sun + 2 planet = 96"
    )
    assert close.severity == "note"
    assert "shifted profiles" in close.message
    (far,) = told(
        element("planetary", sun=48, ring=99, planet=24), "ring 99 is not sun + 2 planet = 96"
    )
    assert far.severity == "warning"
    assert far.path == ("elements", 1, "teeth", "ring")


def test_half_a_tooth_is_left_for_planets_between_odd_wheels() -> None:
    assert not told(element("planetary", sun=48, ring=96), "would need")
    (problem,) = told(element("planetary", sun=48, ring=97), "would need")
    assert problem.severity == "note"
    assert problem.message.startswith(
        "the planet would need 24.5 teeth ((ring - sun)/2); its speed"
    )


def test_long_planets_of_a_ravigneaux_set_fit_the_large_sun_and_the_ring() -> None:
    teeth = {"small_sun": 30, "large_sun": 36, "ring": 72, "short": 20, "long": 18}
    assert not told(element("ravigneaux", **teeth), "large_sun + 2 long")
    (problem,) = told(
        element("ravigneaux", **teeth | {"ring": 80}), "ring 80 is not large_sun + 2 long = 72"
    )
    assert problem.severity == "warning"
    (problem,) = told(element("ravigneaux", small_sun=28, large_sun=32, ring=75), "would need")
    assert problem.message.startswith("the long planet would need 21.5 teeth")
    (problem,) = told(
        element("ravigneaux", small_sun=30, large_sun=36, ring=30), "no planet `long` fits"
    )
    assert problem.path == ("elements", 1, "teeth", "ring")


def test_wheels_of_one_rim_of_a_group_stand_on_one_axis() -> None:
    other = replace(UMDM, wheels=[*UMDM.wheels[:4], CentralWheel("8", 5, 79, True, "B2")])
    (problem,) = told(other, "ring `8` 79 is not sun `4` + 2 rim `B2` = 74")
    assert problem.path == ("elements", 1, "rings", 3, "teeth")
    assert problem.severity == "warning"


def test_rims_of_different_radius_need_different_modules() -> None:
    assert not told(element("stepped", sun=30, planet=20, planet2=25, ring2=75), "module")
    # 25 + 20 = 45 and 61 - 25 = 36; 45/36 = 1.25
    (problem,) = told(element("stepped", sun=25, planet=20, planet2=25, ring2=61), "module")
    assert "the module of planet2 is 1.25 times the module of planet (5/4)" in problem.message
    assert problem.severity == "note"
    assert problem.path == ("elements", 1, "teeth", "planet2")


def test_rims_of_almost_one_radius_need_shifted_profiles() -> None:
    """A Wolfrom set: 100 - 40 = 60 and 97 - 38 = 59."""
    teeth = {"sun": 20, "ring": 100, "ring2": 97, "planet": 40, "planet2": 38}
    (problem,) = told(element("stepped", **teeth), "module")
    assert problem.message == (
        "coaxial with shifted profiles, or with different modules: "
        "the module of planet2 is 1.0169 times the module of planet (60/59)"
    )


def test_meshed_planets_reach_one_another() -> None:
    assert not told(element("double_planet", sun=30, inner=20, outer=20, ring=90), "cannot mesh")
    # Radii (30 + 20)/2 = 25 and (120 - 20)/2 = 50 leave 25 between, planets make 20.
    (problem,) = told(element("double_planet", sun=30, inner=20, outer=20, ring=120), "cannot mesh")
    assert "distance 20 would have to be between 25 and 75" in problem.message
    assert problem.path == ("elements", 1, "teeth", "inner")


def test_meshed_planets_pass_the_wheel_that_they_dont_mesh_with() -> None:
    # The tips of the inner planet reach to 30 + 28 + 28 + 2 = 88, twice the radius in modules;
    # those of a ring of 90 stand at 88 too, those of one of 91 leave a gap.
    assert told(
        element("double_planet", sun=30, inner=28, outer=20, ring=90), "inner 28 and ring 90"
    )
    assert not told(element("double_planet", sun=30, inner=28, outer=20, ring=91), "inner 28 and")
    assert told(
        element("double_planet", sun=30, inner=29, outer=20, ring=90), "inner 29 and ring 90"
    )
    assert told(
        element("double_planet", sun=30, inner=20, outer=29, ring=90), "outer 29 and sun 30"
    )
