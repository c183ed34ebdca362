"""Definitions that pictures of a page share."""

import re

import pytest

from tests.commands import CASES
from tests.page.report.pages import report
from vstatics.core.tables.html import Markup
from vstatics.page.report import definitions
from vstatics.page.report.definitions import shared_definitions

LONG = "M1 2h5.5v5.5h5.5v5.5h5.5v5.5h5.5v5.5"
HATCH = '<pattern id="{}" width="72"><path d="M0 72l72-72"/></pattern>'


def test_a_repeated_path_keeps_its_look_and_its_title() -> None:
    drawn = f'<path class="wire" d="{LONG}"><title>sun</title></path><path d="{LONG}" class="l1"/>'
    page = shared_definitions(Markup(drawn))
    assert f'<path id="p0" d="{LONG}"/>' in page
    uses = '<use href="#p0" class="wire"><title>sun</title></use><use href="#p0" class="l1"/>'
    assert page.endswith(uses)


def test_short_and_single_paths_stay() -> None:
    drawn = Markup(f'<path d="M0 0h5"/><path d="M0 0h5"/><path d="{LONG}"/>')
    assert shared_definitions(drawn) == drawn


def test_equal_hatches_are_defined_once() -> None:
    drawn = "".join(
        f'<svg><path fill="url(#{name}-h0)"/><defs>{HATCH.format(f"{name}-h0")}</defs></svg>'
        for name in ("stick.1", "stick.2")
    )
    page = shared_definitions(Markup(drawn))
    [name] = set(re.findall(r"url\(#([^)]+)\)", page))
    assert re.findall('<pattern id="([^"]+)"', page) == [name]


def test_a_page_draws_the_same_with_and_without_definitions(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Each reference is replaced by the definition, which must give the page without them."""
    page = report(CASES / "zf-6hp26.yaml")
    paths = dict(re.findall(r'<path id="(p\d+)" d="([^"]*)"/>', page))
    monkeypatch.setattr(definitions, "REFERENCE", 10**9)
    plain = report(CASES / "zf-6hp26.yaml")
    drawn = re.compile(r' (?:d|href)="(#p\d+|[Mm][^"]*)"')
    expanded = [paths.get(one[1:], one) for one in drawn.findall(page.partition("</defs>")[2])]
    assert expanded == drawn.findall(plain.partition("</defs>")[2])
    assert len(paths) > 20
