"""One gear: speeds of its planets, torques on its meshes."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import vstatics as library
from tests.core.elements.element_texts import AOD, SET, changed, loaded, shown
from tests.core.statics.differential import train
from vstatics import Gear, solve
from vstatics.core.statics.result_arrays import ARRAYS, row_counts
from vstatics.core.statics.state import flat, values_of


@pytest.mark.parametrize("losses", ["meshes", "reduced"])
def test_planets_have_the_same_speeds_in_both_forms(losses: str) -> None:
    given = shown(AOD)["planet_speeds"].values
    other = shown(changed("mesh_eff", f"losses: {losses}\nmesh_eff", AOD))["planet_speeds"].values
    assert other == pytest.approx(given, abs=1e-12)


def test_a_planet_without_teeth_has_no_speed() -> None:
    found = shown(changed(", short: 18, long: 18", "", AOD))
    assert list(found["planet_speeds"].rows) == ["set.short", "set.long"]
    assert np.isnan(found["planet_speeds"].values[0]).all()
    assert found["planet_speeds"].values[1] == pytest.approx(
        shown(AOD)["planet_speeds"].values[1]
    )  # (72 - 36)/2


def test_a_mesh_with_a_planet_without_teeth_has_no_torque_on_it() -> None:
    found = shown(changed(", short: 18, long: 18", "", AOD))["lossy_mesh_torques"]
    given = shown(AOD)["lossy_mesh_torques"]
    assert list(found.rows) == list(given.rows)
    for name, row, other in zip(found.rows, found.values, given.values, strict=True):
        if name == "set.short-long":
            assert np.isnan(row).all()
        else:
            assert row == pytest.approx(other)


def test_the_planets_of_a_plain_set_follow_its_ratio_in_a_sweep() -> None:
    """Ring held: (w_sun - w_carrier)/(planet ratio) with the planet (ring - sun)/2."""
    case = loaded(SET)
    for ratio in (-2.0, -4.0):
        results = library.solve(case, ratios=np.array([[ratio], [-3.0]]))
        motion = 1 - 1 / (1 - ratio)
        assert results.planet_speeds[0, 0] == pytest.approx([motion / ((1 + ratio) / 2)])


def test_a_plain_planet_turns_against_its_carrier() -> None:
    """Willis by the planet: (w_sun - w_carrier)/((1 + u)/2), here (2/3)/(-1/2)."""
    results = library.solve(train([(2, 0)], Gear([1])))
    assert results.planet_speeds[0] == pytest.approx([-4 / 3])


def test_a_planet_ratio_that_is_given_is_taken() -> None:
    case = train([(2, 0)], Gear([1]))
    own = replace(case, mechanisms=[case.mechanisms[0]._replace(planet_ratio=-4.0)])
    assert library.solve(own).planet_speeds[0] == pytest.approx([(2 / 3) / -4])


def test_every_array_of_results_has_its_values() -> None:
    case = train([(2, 0)], Gear([1]))
    values = values_of(solve(case).gear(1))
    assert list(values) == list(ARRAYS)
    for name, width in row_counts(case).items():
        assert len(flat(values, [name])) == (1 if width is None else width), name


def test_what_overflowed_does_not_exist() -> None:
    assert [
        str(one) for one in flat({"ratio": math.inf, "efficiency": -0.0}, ["ratio", "efficiency"])
    ] == [
        "nan",
        "0.0",
    ]
