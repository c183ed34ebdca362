"""Tables as HTML: signs of the language in names, digits kept for sorting, levels."""

from __future__ import annotations

from vstatics.tables.grid import Cell, Column, Grid, exact
from vstatics.tables.html import table


def test_texts_are_escaped_and_numbers_keep_their_digits() -> None:
    grid = Grid("<b>", [Column("a & b", is_number=False), Column("x")], [["<i>", exact(1 / 3)]])
    made = table(grid)
    assert "<h3>&lt;b&gt;</h3>" in made
    assert "a &amp; b" in made
    assert f'<td class="number" data-value="{1 / 3!r}">0.333</td>' in made


def test_signs_are_said_and_rows_have_levels() -> None:
    columns = [Column("gear", is_number=False), Column("C", is_sign=True)]
    made = table(Grid("t", columns, [["1", Cell("x", 1.0, "engaged")]], [2]))
    assert '<tr data-level="2"><th scope="row" class="level2">1</th>' in made
    assert '<span role="img" aria-label="engaged">x</span>' in made


def test_a_table_without_rows_is_its_title() -> None:
    assert table(Grid("none", [], [])) == "<p>none</p>"
