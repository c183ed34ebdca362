"""The arrays of the results: in the order of the fields, with their rows and their names."""

import math

import numpy as np
import pytest

import vstatics as library
from tests.chance import some
from tests.commands import CASES, MZKT
from tests.core.elements.element_texts import AOD, SET, changed, loaded, shown
from tests.core.statics.differential import train
from vstatics import Gear, load, solve
from vstatics.core.statics.result_arrays import ARRAYS, OUTPUT, ResultFields, row_counts, row_names
from vstatics.core.statics.state import flat, values_of


def test_the_arrays_are_declared_in_the_order_of_the_fields() -> None:
    fields = ("case", *ARRAYS, "messages", "points")
    assert ResultFields._fields == library.Results._fields == fields


def test_the_output_torque_is_the_last_row_of_the_torques() -> None:
    """Without losses it is the ratio; gear 1 has 6.230 and 5.934 in the published report."""
    results = solve(load(MZKT))
    assert results.output_torque.tolist() == results.torques[:, -1].tolist()
    assert results.output_torque.round(3)[0] == 6.230
    assert results.lossy_output_torque.round(3)[0] == 5.934


def test_results_show_own_links_elements_and_planets() -> None:
    found = shown(AOD)
    assert list(found["speeds"].rows) == ["input", "forward sun", "reverse sun", "carrier", "ring"]
    assert list(found["planet_speeds"].rows) == ["set.short", "set.long"]
    assert found["planet_speeds"].values[:, 0] == pytest.approx([-30 / 18, 30 / 18])  # carrier held
    assert list(found["losses"].rows) == ["set"]
    assert found["losses"].values[0] == pytest.approx(1 - found["efficiency"].values[0])
    assert "mesh_torques" not in shown(SET)


GROUP = """
links: [in, {name}, H]
output: H
losses: meshes
elements:
  g: {{kind: planet_group, carrier: H, rims: {{A: {{A1: 18}}}},
      suns: [{{link: in, teeth: 36, rim: A1}}], rings: [{{link: {name}, teeth: 72, rim: A1}}]}}
shift_elements: {{B: [{name}, housing]}}
gears: {{1: {{engaged: [B]}}}}
"""


def test_wheels_of_a_group_keep_their_rows_whatever_their_links_are_called() -> None:
    """Ring held: sun 1, ring 2, carrier -3, whoever has a link called carrier or A."""
    for name, row in (("ring", "g.ring"), ("carrier", "g.carrier/A1"), ("A", "g.A/A1")):
        found = shown(GROUP.format(name=name))["torques"]
        assert list(found.rows) == ["B", "g.in", row, "g.carrier", "Mx"]
        assert found.values[1:4, 0] == pytest.approx([1, 2, -3])
    # two gears of the housing on one ring gear have different names
    text = """
links: [C, out]
input: C
elements:
  g: {kind: planet_group, carrier: C, rims: {A: {A1: 18, A2: 20}}, rings: [
      {link: housing, teeth: 72, rim: A1}, {link: out, teeth: 74, rim: A2}]}
gears: {1: {}}
"""
    assert "g.housing" in shown(text)["torques"].rows
    both = changed("72, rim: A1}", "72, rim: A1}, {link: housing, teeth: 72, rim: A1}", text)
    assert {"g.housing/A1", "g.housing/A1 (ring)"} < set(shown(both)["torques"].rows)


def test_every_array_has_as_many_rows_as_there_are_names() -> None:
    for path in some(sorted(CASES.glob("*.yaml"))):
        results = library.solve(library.load(path))
        gears = len(results.case.gears)
        for name, one in ARRAYS.items():
            rows = row_names(results.case, one.rows)
            shape = (gears,) if one.rows == "one" else (gears, len(rows))
            assert getattr(results, name).shape == shape, (path, name)
            assert getattr(results, name).dtype == one.dtype, name


def test_rows_of_a_case_that_is_drawn_are_those_of_its_drawing() -> None:
    case = loaded(AOD)
    assert row_names(case, "devices") == ["set"]
    members = ("set.small_sun", "set.large_sun", "set.ring", "set.carrier")
    assert row_names(case, "torques")[5:] == [*members, OUTPUT]
    assert row_names(case, "meshes") == row_names(case, "mechanisms")
    counts = row_counts(case)
    names = ("speeds", "planet_speeds", "slip_speeds", "losses", "power_sign", "torques", "ratio")
    assert [counts[name] for name in names] == [5, 2, 5, 1, 4, 10, None]
    assert counts["mesh_losses"] == 4


def test_every_array_of_results_has_its_values() -> None:
    case = train([(2, 0)], Gear([1]))
    values = values_of(solve(case).gear(1))
    assert list(values) == list(ARRAYS)
    for name, width in row_counts(case).items():
        assert len(flat(values, [name])) == (1 if width is None else width), name
    gone = flat({"ratio": math.inf, "efficiency": -0.0}, ["ratio", "efficiency"])
    assert list(map(str, gone)) == ["nan", "0.0"]  # what overflowed does not exist


def test_planets_have_the_same_speeds_in_both_forms() -> None:
    given = shown(AOD)["planet_speeds"].values
    for losses in ("meshes", "reduced"):
        other = shown(changed("mesh_eff", f"losses: {losses}\nmesh_eff", AOD))["planet_speeds"]
        assert other.values == pytest.approx(given, abs=1e-12)


def test_a_planet_without_teeth_has_no_speed_and_its_mesh_no_torque() -> None:
    known, bare = shown(AOD), shown(changed(", short: 18, long: 18", "", AOD))
    for name, unknown in (("planet_speeds", "set.short"), ("lossy_mesh_torques", "set.short-long")):
        rows = list(bare[name].rows)
        assert rows == list(known[name].rows)
        expected = np.array(known[name].values)
        expected[rows.index(unknown)] = np.nan
        assert np.array(bare[name].values) == pytest.approx(expected, nan_ok=True)


def test_the_planets_of_a_plain_set_follow_its_ratio_in_a_sweep() -> None:
    """Ring held: (w_sun - w_carrier)/(planet ratio) with the planet (ring - sun)/2."""
    for ratio in (-2.0, -4.0):
        results = library.solve(loaded(SET), ratios=np.array([[ratio], [-3.0]]))
        motion = 1 - 1 / (1 - ratio)
        assert results.planet_speeds[0, 0] == pytest.approx([motion / ((1 + ratio) / 2)])
