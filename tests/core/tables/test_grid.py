"""What cells stand for, and tables of them as plain text and HTML."""

import math

from vstatics import Gear, Mechanism, Transmission, solve
from vstatics.core.summary.pretty import gears_grid
from vstatics.core.tables.grid import Cell, Column, Grid, exact, sign, whole
from vstatics.core.tables.html import table, tables
from vstatics.core.tables.text import lines

NAME = Column("name", is_number=False)


def test_a_cell_is_a_number_a_count_a_sign_or_words() -> None:
    """Words beside a number are words: the number is what they are sorted by."""
    assert exact(4.696, 0)[:2] == ("5", 4.696)
    assert exact(4.696, 0).datum == 4.696
    assert repr(whole(20_000_000).datum) == "20000000"
    assert repr(sign(1.0).datum) == "True"
    assert [make(math.nan).datum for make in (exact, whole, sign)] == [None] * 3
    assert Cell("1333 set.planet", 1333.33).datum == "1333 set.planet"
    pair = Transmission(2, [], [Mechanism(1, 2, 0, 4.696, 0.98)], [Gear()])
    assert gears_grid(solve(pair)).data[0][1] == 4.696  # coloured


def test_lines_of_a_text() -> None:
    """Levels are indented; with fixed widths a long name has a line by itself; headings are optional."""
    leveled = Grid("", [NAME, Column("x")], [["all", ""], ["part", exact(1.0)]], [1, 2])
    assert list(lines(leveled)) == ["name        x", "all", "  part  1.000"]
    wide = Grid("", [NAME, Column("x")], [["a", "1.0"], ["a long name", "12345.0"]])
    expected = ["name      x", "a       1.0", "a long name", "      12345.0"]
    assert list(lines(wide, widths=[5, 5], gap=" ")) == expected
    bare = Column("", is_number=False)
    grid = Grid("title", [bare, bare], [["gear 1", "ok"], ["gear 10", "tied up"]])
    assert list(lines(grid, indent="  ")) == ["title", "  gear 1   ok", "  gear 10  tied up"]


def test_numbers_that_do_not_fit_go_on_below_with_the_names_again() -> None:
    """Indent and name are 6 wide, a column 9: eight of them make 78."""
    headings = [f"column{number}" for number in range(10)]
    grid = Grid("", [NAME, *map(Column, headings)], [["a", *"0123456789"]])
    found = list(lines(grid, indent="  "))
    assert max(map(len, found)) <= 80
    begun = [["name", "column0"], ["a", "0"], ["name", "column8"], ["a", "8"]]
    assert [line.split()[:2] for line in found if line] == begun


def test_html_escapes_texts_and_keeps_the_digits_of_numbers() -> None:
    grid = Grid("<b>", [Column("a & b", is_number=False), Column("x")], [["<i>", exact(1 / 3)]])
    made = table(grid)
    assert "<h3>&lt;b&gt;</h3>" in made
    assert "a &amp; b" in made
    assert f'<td data-value="{1 / 3!r}">0.333</td>' in made
    blank = Grid("t", [NAME, Column("y")], [["a", exact(0.0)._replace(text="")]])
    assert '<td data-value="0"></td>' in table(blank.with_digits(2))
    assert table(Grid("none", [], [])) == "<p>none</p>"


def test_in_html_signs_are_said_and_rows_have_levels() -> None:
    columns = [Column("gear", is_number=False), Column("C", is_sign=True)]
    made = table(Grid("t", columns, [["1", Cell("x", 1.0, "engaged")]], [2]))
    assert '<tr data-level="2"><th>1</th>' in made
    assert '<span role="img" aria-label="engaged">x</span>' in made


def test_what_columns_are_stands_over_them_once() -> None:
    columns = [Column("link", is_number=False), *(Column(name, over="gear") for name in "12")]
    made = table(Grid("t", columns, [["sun", exact(1.0), exact(0.5)]]))
    first, last = made.partition("</tr>")[::2]
    assert '<th></th><th scope="colgroup" colspan="2">gear</th>' in first
    assert last.count("<th") == 4  # three columns and the row


def test_two_narrow_tables_of_a_page_stand_side_by_side() -> None:
    """Each as wide as its words; a wide one has the page for itself."""
    narrow, wide = (Grid("t", [NAME], [["x" * width]]) for width in (10, 90))
    sides = [part.count("<table>") for part in tables([narrow, narrow, wide, narrow])]
    assert sides == [2, 1, 1]
