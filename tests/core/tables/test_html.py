"""Tables as HTML: signs of the language in names, digits kept for sorting, levels."""

from __future__ import annotations

from vstatics.core.tables.grid import Cell, Column, Grid, exact
from vstatics.core.tables.html import table, tables


def test_texts_are_escaped_and_numbers_keep_their_digits() -> None:
    grid = Grid("<b>", [Column("a & b", is_number=False), Column("x")], [["<i>", exact(1 / 3)]])
    made = table(grid)
    assert "<h3>&lt;b&gt;</h3>" in made
    assert "a &amp; b" in made
    assert f'<td data-value="{1 / 3!r}">0.333</td>' in made


def test_signs_are_said_and_rows_have_levels() -> None:
    columns = [Column("gear", is_number=False), Column("C", is_sign=True)]
    made = table(Grid("t", columns, [["1", Cell("x", 1.0, "engaged")]], [2]))
    assert '<tr data-level="2"><th scope="row" class="level2">1</th>' in made
    assert '<span role="img" aria-label="engaged">x</span>' in made


def test_a_table_without_rows_is_its_title() -> None:
    assert table(Grid("none", [], [])) == "<p>none</p>"


def test_what_columns_are_stands_over_them_once() -> None:
    columns = [Column("link", is_number=False), *(Column(name, over="gear") for name in "12")]
    made = table(Grid("t", columns, [["sun", exact(1.0), exact(0.5)]]))
    first, last = made.partition("</tr>")[::2]
    assert '<td></td><th scope="colgroup" colspan="2">gear</th>' in first
    assert last.count('scope="col"') == 3


def test_two_narrow_tables_stand_side_by_side() -> None:
    """Each as wide as its words; a wide one has the page for itself."""
    narrow, wide = (
        Grid("t", [Column("name", is_number=False)], [["x" * width]]) for width in (10, 90)
    )
    sides = [part.count("<table>") for part in tables([narrow, narrow, wide, narrow])]
    assert sides == [2, 1, 1]


def test_what_is_blank_keeps_its_value_also_with_digits() -> None:
    grid = Grid(
        "t", [Column("x", is_number=False), Column("y")], [["a", exact(0.0)._replace(text="")]]
    )
    assert '<td data-value="0"></td>' in table(grid.with_digits(2))
