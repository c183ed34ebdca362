"""The summary of a transmission: design table, shifts, largest values, sensitivities."""

from __future__ import annotations

from tests.commands import CASES, TIED_UP, vstatics


def test_a_gear_that_is_tied_up_makes_the_status_1() -> None:
    said = vstatics("summary", "-", stdin=TIED_UP.encode())
    assert said.status == 1
    assert "tied up" in said.out
    assert "tied up" in said.err


def test_tables_are_80_columns_wide_with_many_gears() -> None:
    """MZKT and the ten gears of the 10R80; a table of numbers goes on below."""
    said = vstatics("summary", CASES / "ford-10r80.yaml")
    assert said.status == 0
    assert max(map(len, said.out.splitlines())) <= 80
    assert said.out.count("mechanism ") == 4
