"""Tables as plain text: widths, levels and columns that go on below."""

from __future__ import annotations

from vstatics.core.tables.grid import Column, Grid, exact
from vstatics.core.tables.text import lines

NAME = Column("name", is_number=False)


def test_rows_are_set_in_by_their_level() -> None:
    grid = Grid("", [NAME, Column("x")], [["all", ""], ["part", exact(1.0)]], [1, 2])
    assert list(lines(grid)) == ["name        x", "all", "  part  1.000"]


def test_in_fixed_widths_a_long_name_has_a_line_of_its_own() -> None:
    grid = Grid("", [NAME, Column("x")], [["a", "1.0"], ["a long name", "12345.0"]])
    assert list(lines(grid, widths=[5, 5], gap=" ")) == [
        "name      x",
        "a       1.0",
        "a long name",
        "      12345.0",
    ]


def test_without_headings_there_is_no_line_of_them() -> None:
    bare = Column("", is_number=False)
    grid = Grid("title", [bare, bare], [["gear 1", "ok"], ["gear 10", "tied up"]])
    assert list(lines(grid, indent="  ")) == ["title", "  gear 1   ok", "  gear 10  tied up"]


def test_numbers_that_do_not_fit_go_on_below_with_the_names_again() -> None:
    """Indent and name are 6 wide, a column 9: eight of them make 78."""
    headings = [f"column{number}" for number in range(10)]
    grid = Grid("", [NAME, *map(Column, headings)], [["a", *"0123456789"]])
    found = list(lines(grid, indent="  "))
    assert max(map(len, found)) <= 80
    assert [line.split()[:2] for line in found if line] == [
        ["name", "column0"],
        ["a", "0"],
        ["name", "column8"],
        ["a", "8"],
    ]
