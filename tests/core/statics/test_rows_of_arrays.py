"""The rows of the arrays of `Results`, of cases of elements above all."""

from __future__ import annotations

from pathlib import Path

import pytest

import vstatics as library
from tests.commands import CASES
from tests.core.elements.element_texts import AOD, SET, changed, loaded, shown
from vstatics.core.statics.result_arrays import ARRAYS, OUTPUT, row_counts, row_names


def test_results_show_own_links_elements_and_planets() -> None:
    found = shown(AOD)
    assert list(found["speeds"].rows) == ["input", "forward sun", "reverse sun", "carrier", "ring"]
    assert list(found["planet_speeds"].rows) == ["set.short", "set.long"]
    assert found["planet_speeds"].values[:, 0] == pytest.approx([-30 / 18, 30 / 18])  # carrier held
    assert list(found["losses"].rows) == ["set"]
    total = 1 - found["efficiency"].values[0]
    assert found["losses"].values[0] == pytest.approx(total)
    assert "mesh_torques" not in shown(SET)


def test_wheels_of_a_group_keep_their_rows_whatever_their_links_are_called() -> None:
    """Ring held: sun 1, ring 2, carrier -3, whoever has a link called carrier or A."""
    for name in ("ring", "carrier", "A"):
        text = f"""
links: [in, {name}, H]
output: H
losses: meshes
elements:
  g: {{kind: planet_group, carrier: H, rims: {{A: {{A1: 18}}}},
      suns: [{{link: in, teeth: 36, rim: A1}}], rings: [{{link: {name}, teeth: 72, rim: A1}}]}}
shift_elements: {{B: [{name}, housing]}}
gears: {{1: {{engaged: [B]}}}}
"""
        found = shown(text)["torques"]
        row = "g.ring" if name == "ring" else f"g.{name}/A1"
        assert list(found.rows) == ["B", "g.in", row, "g.carrier", "Mx"]
        assert found.values[1:4, 0] == pytest.approx([1, 2, -3])


def test_two_wheels_of_the_housing_on_one_rim_have_names_of_their_own() -> None:
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


@pytest.mark.parametrize("path", sorted(CASES.glob("*.yaml")), ids=lambda path: path.stem)
def test_every_array_has_as_many_rows_as_there_are_names(path: Path) -> None:
    results = library.solve(library.load(path))
    gears = len(results.case.gears)
    for name, one in ARRAYS.items():
        rows = row_names(results.case, one.rows)
        shape = (gears,) if one.rows == "one" else (gears, len(rows))
        assert getattr(results, name).shape == shape, name
        assert getattr(results, name).dtype == one.dtype, name


def test_arrays_are_the_fields_of_results() -> None:
    fields = [
        name for name in library.Results._fields if name not in ("case", "messages", "points")
    ]
    assert list(ARRAYS) == fields


def test_rows_of_a_case_that_is_drawn_are_those_of_its_drawing() -> None:
    case = loaded(AOD)
    assert row_names(case, "devices") == ["set"]
    assert row_names(case, "torques")[5:] == [
        *("set.small_sun", "set.large_sun", "set.ring", "set.carrier"),
        OUTPUT,
    ]
    assert row_names(case, "meshes") == row_names(case, "mechanisms")
    expected = {
        "speeds": 5,
        "planet_speeds": 2,
        "slip_speeds": 5,
        "losses": 1,
        "power_sign": 4,
        "torques": 10,
        "mesh_losses": 4,
        "ratio": None,
    }
    assert expected.items() <= row_counts(case).items()
