"""Results as a dataset of xarray: the numbers of `run -f json`, by their names."""

import numpy as np
import pytest

from tests import commands
from tests.chance import some
from tests.commands import CASES
from vstatics import Gear, Load, Mechanism, ShiftElement, Transmission, load, solve
from vstatics.core.tables.quantities import BY_NAME

pytest.importorskip("xarray")

SHIPPED = some(sorted(path for path in CASES.iterdir() if path.suffix in {".yaml", ".dat"}))


def test_every_cell_of_a_shipped_case_is_that_of_its_json() -> None:
    """By the names that JSON gives to rows and gears; numbers from 1 are names, too."""
    written = commands.json_answer("run", *SHIPPED)
    assert len(written) == len(SHIPPED) > 10
    cells = 0
    for path, one in zip(SHIPPED, written, strict=True):
        data = solve(load(path)).to_xarray()
        assert data.attrs["case"] == one["case"].get("name", "")
        assert data["gear"].values.tolist() == one["gears"]
        for key in (one.keys() & BY_NAME.keys()) - {"distribution_matrix"}:  # which is of no gear
            found = data[BY_NAME[key].name]
            told = np.array(one[key], dtype=float).reshape(found.T.shape)
            if "rows" in one and found.ndim == 2:
                assert data[found.dims[1]].values.tolist() == one["rows"][key]
            found = found.T
            np.testing.assert_array_equal(found.values, told, err_msg=f"{path.name}: {key}")
            cells += told.size
    assert cells > 3_000


def test_axes_of_variants_come_first_and_a_loaded_case_has_units() -> None:
    """Ring held: the carrier turns at 1/(1 - u), the output torque is (1 - u) of 300 N*m."""
    case = Transmission(
        3,
        [ShiftElement(2, 0, "B")],
        [Mechanism(1, 2, 3, -2.5, name="set")],
        [Gear([1], name="low")],
        link_names=["sun", "ring", "carrier"],
        load=Load(2000, 300),
    )
    ratios = np.array([[-2.0, -3.0, -4.0], [-1.5, -2.5, -3.5]])
    data = solve(case, ratios=ratios[..., None]).to_xarray()
    low = data.sel(gear="low")
    speed = low["speeds_rpm"].sel(link="carrier")
    assert speed.dims == ("variant_1", "variant_2")
    np.testing.assert_allclose(speed.values, 2000 / (1 - ratios))
    torque = low["torques_Nm"].sel(device="Mx")
    np.testing.assert_allclose(torque.values, 300 * (1 - ratios))
    assert (speed.attrs["units"], torque.attrs["units"]) == ("rpm", "N*m")
    assert "units" not in data["speeds"].attrs
    assert data["mesh"].dtype.kind == data["converter"].dtype.kind == "U"  # without rows as well
    assert solve(case, ratios=ratios[0][:, None]).to_xarray()["ratio"].dims == ("variant", "gear")
