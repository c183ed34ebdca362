"""Names that a person types in a sweep."""

import re

import numpy as np
import pytest

from tests.commands import CASES
from tests.core.elements.element_texts import loaded
from tests.core.tables.test_names import DECLARED, EVERYTHING
from vstatics import ReadError, Transmission, load, solve, sweep
from vstatics.core.tables.dataframe import to_dataframe
from vstatics.core.tables.names import quantity_named, row_named
from vstatics.core.tables.quantities import BY_NAME, Quantity
from vstatics.core.tables.values import tables

VARIED = {"P1.ratio": [-2.5, -2.4]}


@pytest.fixture(scope="module")
def everything() -> Transmission:
    return loaded(EVERYTHING)


@pytest.mark.parametrize("one", DECLARED, ids=lambda one: one.name)
def test_a_sweep_of_a_deck_name_has_columns_with_the_name(
    one: Quantity, everything: Transmission
) -> None:
    (named,) = sweep(everything, VARIED, out=one.name)
    (aliased,) = sweep(everything, VARIED, out=one.deck_name)
    assert aliased.headings == named.headings
    np.testing.assert_array_equal(named.columns, aliased.columns)
    own = solve(everything).existing(one.name)  # -2.5 is 75/30
    expected = own.T.ravel()  # all gears of the first row, then of the second
    np.testing.assert_array_equal(named.columns[0], expected.astype(float))


def test_a_table_in_its_unit_stands_in_conditions(everything: Transmission) -> None:
    """The ring of P1 stands, so its carrier has 1 - u = 3.5 times the sun's torque."""
    chunk, other = (
        next(iter(sweep(everything, VARIED, out=out, where=where)))
        for out, where in (
            ("lossy_torques_Nm[P1.sun, low]", "W_rpm[out, low] > 0 and LOSS_kW[P1, low] > 0"),
            ("AMLGP[P1.sun, low] * 300", "abs(Mx_Nm[low] / Mx[low] - 300) < 1e-9"),
        )
    )
    assert chunk.headings == ("lossy_torques_Nm[P1.sun,low]",)
    assert chunk.columns == pytest.approx(other.columns)


def test_mx_is_the_output_torque_and_its_lossy_sister_ends_in_p(everything: Transmission) -> None:
    (chunk,) = sweep(everything, VARIED, out="Mx[low],torques[Mx,low],MxP[low],AMLGP[Mx,low]")
    assert chunk.headings == (
        *("output_torque[low]", "torques[Mx,low]"),
        *("lossy_output_torque[low]", "lossy_torques[Mx,low]"),
    )
    assert chunk.columns[:, 0].tolist() == chunk.columns[:, 1].tolist()
    assert chunk.columns[:, 2].tolist() == chunk.columns[:, 3].tolist()


def test_another_name_is_refused_with_the_nearest(everything: Transmission) -> None:
    for name, hint in {
        "ETa": "ETA",
        "effciency": "efficiency",
        "w": "W",
        "amlgp_nm": "AMLGP_Nm",
        "Losses": "losses",
        "lossy_torque": "lossy_torques",
        "W_Nm": "W_rpm",
    }.items():
        told = re.escape(f"there is no table `{name}`; did you mean `{hint}`?")
        with pytest.raises(ReadError, match=told):
            quantity_named(name)
        with pytest.raises(ReadError, match=told):
            sweep_of(everything, f"{name}[out]")
    with pytest.raises(ReadError, match="`AJK` does not belong to a gear"):
        sweep_of(everything, "AJK")
    with pytest.raises(ReadError, match=r"the case gives no torque at the input, so .*`Mx_Nm`"):
        sweep_of(load(CASES / "simpson.yaml"), "Mx_Nm")


def sweep_of(case: Transmission, out: str) -> tuple[str, ...]:
    (chunk,) = sweep(case, {f"{case.mechanisms[-1].name}.ratio": [-2.5]}, out=out)
    return chunk.headings


def test_a_row_has_one_name_and_a_device_alone_means_its_only_row(everything: Transmission) -> None:
    results = solve(everything)
    for table, typed, row in (
        ("torques", "P1.ring", "P1.ring"),
        ("torques", "B1", "B1"),
        ("planet_speeds", "P1", "P1.planet"),
        ("planet_speeds", "P1.planet", "P1.planet"),
        ("power_sign", "P1", "P1"),
        ("losses", "set", "set"),
        ("mesh_torques", '"set.ring-long"', '"set.ring-long"'),
    ):
        assert sweep_of(everything, f"{table}[{typed},low]") == (f"{table}[{row},low]",)
        quantity = BY_NAME[table]
        index = row_named(typed.strip('"'), quantity.rows, everything)
        shown = next(one for one in tables(results) if one.quantity is quantity)
        assert shown.rows[index] == row.strip('"')
        assert (table, row.strip('"')) in to_dataframe(results).columns
    headings = ("power_sign[D1,2]", "torques[T1,2]", "planet_speeds[D2,1]")
    deck = load(CASES / "mzkt7922.dat")  # a mechanism of a deck is its own row
    assert sweep_of(deck, "IX[D1,2],torques[T1,2],WSAT[D2,1]") == headings


def test_a_device_with_several_rows_lists_them(everything: Transmission) -> None:
    meshes = "set.small_sun-short, set.large_sun-long, set.ring-long, set.short-long"
    for table, device, rows in (
        ("torques", "P1", "P1.sun, P1.ring, P1.carrier"),
        ("planet_speeds", "set", "set.short, set.long"),
        ("IX", "set", meshes),
    ):
        told = re.escape(f"`{device}` has the rows {rows}; expected one of them")
        with pytest.raises(ReadError, match=told):
            sweep_of(everything, f"{table}[{device}]")
        with pytest.raises(ReadError, match=told):
            row_named(device, BY_NAME[table].rows, everything)


def test_a_varied_number_may_have_the_name_of_the_deck(everything: Transmission) -> None:
    for name, vary in (
        ("P1.ratio", ("P1.ratio=-2.5,-2.4", "P1.IAB=-2.5,-2.4")),
        ("P1.efficiency", ("P1.ETAI=.9,.95", "P1.efficiency=.9,.95")),
    ):
        for one in vary:
            (chunk,) = sweep(everything, one, out="P1.IAB - P1.ratio, P1.ETAI - P1.efficiency")
            assert chunk.names == (name,)
            assert not chunk.columns.any()


def test_an_element_with_several_mechanisms_lists_them(everything: Transmission) -> None:
    with pytest.raises(ReadError, match=r"`set` has the mechanisms set\.small_sun-short, set\.l"):
        sweep(everything, {"set.ratio": [0.98]})
    with pytest.raises(ReadError, match="did you mean `ETAI`"):
        sweep(everything, {"P1.etai": [0.98]})
