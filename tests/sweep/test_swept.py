"""A sweep as a table and as a dataset: each cell is a case solved alone."""

import numpy as np
import pytest

from tests.chance import generator
from tests.commands import CASES
from tests.installed import needs
from tests.sweep.sweeps import DIFFERENTIAL
from vstatics import CaseError, Load, load, solve, sweep

pytest.importorskip("xarray")
RATIOS = {"D.ratio": [-2.0, -3.0, -4.0]}


def test_the_best_of_several_pieces_are_those_of_the_closed_form() -> None:
    """Of 1 - u the least is where u is nearest to 0; none is better in ratio and efficiency."""
    varied = {"D.ratio": "-4:-2:400", "D.efficiency": ".9:.99:200"}
    out = "ratio[low],efficiency[low]"
    least = sweep(DIFFERENTIAL, varied, out=out, min="ratio[low]", best=200).to_dataframe()
    assert set(least["D.ratio"]) == {-2.0}
    assert (least["ratio[low]"] == 3).all()
    [front] = sweep(DIFFERENTIAL, varied, out=out, min="ratio[low]", max=["efficiency[low]"])
    u, eta = front.values.T
    efficiency = (1 - u * 0.99) / (1 - u)
    assert eta.tolist() == [0.99]  # at the least ratio it is the largest, too
    np.testing.assert_allclose(front.columns, np.column_stack([1 - u, efficiency]), rtol=1e-12)
    opposed = sweep(DIFFERENTIAL, varied, min="-ratio[low]", max="efficiency[low]", jobs=2)
    found = opposed.to_dataframe()
    np.testing.assert_allclose(sorted(found["D.ratio"]), np.linspace(-4, -2, 400), rtol=1e-12)
    assert set(found["D.efficiency"]) == {0.99}
    with pytest.raises(ValueError, match="best needs min or max"):
        sweep(DIFFERENTIAL, varied, best=3)


def test_a_random_grid_has_the_closed_form_of_a_differential_and_holes() -> None:
    """Ratio 1 - u, efficiency (1 - u eta)/(1 - u) with the ring held, where it is above 3."""
    chance = generator(33)
    ratios = [-1.5, *(-chance.uniform(1.2, 5) for _ in range(6)), -4.5]
    efficiencies = [chance.uniform(0.9, 1) for _ in range(5)]
    varied = {"D.ratio": ratios, "D.efficiency": efficiencies}
    found = sweep(DIFFERENTIAL, varied, out="ratio[low],efficiency[low]", where="ratio[low] > 3")
    grid, table = found.to_xarray(), found.to_dataframe()
    u, eta = grid["D.ratio"], grid["D.efficiency"]
    expected = ((1 - u * eta) / (1 - u)).where(1 - u > 3)
    np.testing.assert_allclose(grid["efficiency[low]"], expected, rtol=1e-13)
    holes = grid["status"] == "left out"
    assert 0 < holes.sum() == grid["ratio[low]"].isnull().sum() == 40 - len(table)
    kept = grid.to_dataframe(dim_order=["D.ratio", "D.efficiency"]).reset_index()
    kept = kept[kept["status"] == "ok"]
    np.testing.assert_array_equal(kept["ratio[low]"], table["ratio[low]"])
    np.testing.assert_array_equal(kept.index, table.index)


def test_what_is_no_grid_has_its_variants_and_gears_of_each_may_be_left_out() -> None:
    varied = {**RATIOS, "D.efficiency": [0.9, 0.95, 1]}
    found = sweep(DIFFERENTIAL, varied, zip=True, by="gear", out="ratio", where="ratio > 4")
    data = found.to_xarray()
    assert data["ratio"].dims == ("variant", "gear")
    assert data["variant"].values.tolist() == [2]
    assert data["D.efficiency"].values.tolist() == [1.0]
    np.testing.assert_array_equal(data["ratio"].sel(gear="low"), [5.0])
    assert data["status"].values.tolist() == [["left out", "ok"]]


def test_a_sweep_is_iterated_once_and_has_all_variants_again_and_again() -> None:
    found = sweep(DIFFERENTIAL, RATIOS, out="ratio[low]")
    assert next(found).columns.ravel().tolist() == [3, 4, 5]
    assert list(found) == []
    for _ in range(2):
        assert found.to_dataframe()["ratio[low]"].tolist() == [3, 4, 5]
    assert repr(found) == "<Sweep of D.ratio: 3 variants, columns ratio[low]>"
    none = sweep(DIFFERENTIAL, variants={"D.ratio": []}, out="ratio[low]")
    assert none.to_dataframe().shape == (0, 3)
    assert none.to_xarray().sizes == {"variant": 0}


def test_more_than_memory_holds_is_refused_before_it_is_calculated() -> None:
    grid = ["D.ratio=-3:-2:1000000", "D.efficiency=.9:1:1000000"]
    for ask in ("to_dataframe", "to_xarray", "plot"):
        with pytest.raises(CaseError, match=r"1000000000000 rows would need about .* \[E911\]"):
            getattr(sweep(DIFFERENTIAL, grid), ask)()


def test_no_column_is_called_like_what_every_output_has() -> None:
    for name in ("variant", "status", "gear"):
        with pytest.raises(CaseError, match=f"`{name}` already has a meaning"):
            sweep(DIFFERENTIAL, RATIOS, out=f"{name}=ratio[low]")


def test_numbers_vary_in_the_order_in_which_they_are_given_texts_among_arrays() -> None:
    found = sweep(DIFFERENTIAL, {"D.ratio": [-2, -3], "D.efficiency": ".9:1:3"}, out="ratio[low]")
    assert found.plan.names == ("D.ratio", "D.efficiency")
    assert found.to_xarray()["ratio[low]"].values.tolist() == [[3] * 3, [4] * 3]


def test_variables_of_a_dataset_have_the_units_that_those_of_results_have() -> None:
    case = load(CASES / "zf-8hp70.yaml").replace(load=Load(2000, 300))
    tables = ["ratio", "speeds", "speeds_rpm", "lossy_torques_Nm", "losses_kW"]
    told = solve(case).to_xarray()
    varied = {"load.torque": [200, 400], "P4.teeth.ring": [81, 85]}
    for by in (None, "gear"):
        data = sweep(case, varied, out=",".join(tables), by=by).to_xarray()
        for name, one in data.data_vars.items():
            table = str(name).partition("[")[0]
            if table != "status":
                assert one.attrs.get("units") == told[table].attrs.get("units")
        assert data["load.torque"].attrs == {"units": "N*m"}
        assert data["P4.teeth.ring"].attrs == {}
    parallel = sweep(case, varied, zip=True, out="x=ratio[1]*1, max(speeds_rpm)").to_xarray()
    assert parallel["load.torque"].attrs == {"units": "N*m"}
    assert [parallel[one].attrs.get("units") for one in ("x", "max(speeds_rpm)")] == [None, "rpm"]


@needs("simulation", "torsion")
def test_what_swings_and_what_runs_has_units_too() -> None:
    from vstatics import load_varied

    sprung = load(CASES / "moskvich412.yaml")
    data = sweep(sprung, {"propshaft.stiffness": [5e4]}, out="omega[1,1]").to_xarray()
    assert data["propshaft.stiffness"].attrs == {"units": "N*m/rad"}
    assert data["omega[1,1]"].attrs == {"units": "rad/s"}
    run = load_varied(CASES / "scenarios/tarasik-set-upshift.yaml")
    duration = run.own.scenario.duration
    asked = "sum(heat), max(speeds), events"
    data = sweep(run, {"duration": [duration]}, out=asked).to_xarray()
    assert data["sum(heat)"].attrs == {"units": "J"}
    assert data["max(speeds)"].attrs == {"units": "rad/s"}
