"""Looks of pictures that a page says once."""

import re

from vstatics.core.tables.html import Markup, tag
from vstatics.pictures.paged.inline import shared

LINE = '<path d="M0 0L1 1" fill="none" stroke="var(--ink)" />'
SHORT = '<path d="M0 0L1 1" class="l0" />'


def test_a_look_of_many_is_said_once() -> None:
    page, rules = shared(Markup(f"<svg>{LINE * 3}</svg>"))
    assert page == f"<svg>{SHORT * 3}</svg>"
    assert rules == ".l0{fill:none;stroke:var(--ink)}"


def test_a_look_of_one_stays_where_it_is() -> None:
    assert shared(Markup(LINE)) == (LINE, "")


def test_texts_that_look_like_attributes_are_left_alone() -> None:
    text = tag("text", '<path fill="none" stroke="red"> fill="none"', x=1)
    page, _ = shared(Markup(text * 2 + LINE * 2))
    assert page.startswith(text * 2)
    assert len(re.findall(r"class=", page)) == 2
