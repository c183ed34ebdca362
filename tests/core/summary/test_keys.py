"""Keys and headings of the tables: they are names of sheets, and columns of CSV."""

from vstatics import Gear, Load, Mechanism, ShiftElement, Transmission, solve
from vstatics.core.summary import Summary, summarize
from vstatics.core.summary.contrast import contrasted
from vstatics.core.summary.tables import summary_grids
from vstatics.core.tables.grid import Grid
from vstatics.core.tables.values import tables as result_tables


def summary(load: Load | None) -> Summary:
    brake = ShiftElement(2, 0, "B", capacity=4)
    train = Mechanism(1, 2, 3, -2.5, 0.96)
    return summarize(solve(Transmission(3, [brake], [train], [Gear([1])], load=load)), reserve=2)


def headings(tables: list[Grid], key: str) -> list[str]:
    [grid] = [grid for grid in tables if grid.key == key]
    return [column.heading for column in grid.columns]


def test_keys_and_titles_are_short_and_differ_and_all_columns_are_headed() -> None:
    for load in (None, Load(2000, 300), Load(torque=300), Load(2000)):
        one = summary(load)
        for tables in (list(summary_grids(one)), list(contrasted([one, one]))):
            keys, titles = [grid.key for grid in tables], [grid.title for grid in tables]
            assert all(key and key == key.lower() for key in keys)
            assert len({*keys}) == len({*titles}) == len(tables)
            assert all(len(title.split()) <= 10 for title in titles)
            assert all(column.heading for grid in tables for column in grid.columns)
        in_results = [table.quantity.title for table in result_tables(one.results)]
        assert len({*in_results}) == len(in_results)
        assert all(len(title.split()) <= 10 for title in in_results)


def test_units_stand_behind_a_comma() -> None:
    loaded = list(summary_grids(summary(Load(2000, 300))))
    elements = headings(loaded, "shift elements with load")
    assert elements[1::2] == ["slip, rpm", "torque, N*m", "with losses, N*m"]
    for key in ("margins", "needed capacity"):
        assert headings(loaded, key)[1] == "torque capacity, N*m"
    ports = ["port", "speed, rpm", "torque, N*m", "power, kW", "direction"]
    assert headings(loaded, "ports")[1:] == ports
    only_torque = list(summary_grids(summary(Load(torque=300))))
    assert headings(only_torque, "shift elements with load")[1] == "torque, N*m"
