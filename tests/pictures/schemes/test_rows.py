"""The structure in rows: each device stands once, and what goes on is named at both ends.

A row of a case is a part of it: which links go on is told by the devices alone.
"""

from __future__ import annotations

from collections import Counter
from math import inf
from pathlib import Path

import pytest

import vstatics
from tests.chance import some
from tests.commands import SHIPPED
from tests.pictures.schemes.test_schemes import assert_apart, pieces_of
from vstatics.pictures.schemes import structure
from vstatics.pictures.schemes.rows import SchemeRow
from vstatics.pictures.schemes.scheme import Scheme, scheme_of, scheme_state
from vstatics.pictures.schemes.sheet import extent
from vstatics.pictures.sheet.gear_state import state_of
from vstatics.pictures.sheet.style import Style
from vstatics.statics.results import Results

NAMES = ["zf-8hp70.yaml", "power-split.yaml", "moskvich412.yaml"]


def rows(scheme: Scheme, width: float) -> list[SchemeRow]:
    return structure.rows(scheme, Style(width=width))


def results_of(name: str) -> Results:
    return vstatics.solve(vstatics.load(SHIPPED[0].parent / name))


def links(scheme: Scheme, numbers: object) -> set[int]:
    return {link for one in numbers for link in scheme.devices[one].links}  # type: ignore[attr-defined]


@pytest.mark.parametrize("width", [Style().width, 250.0])
@pytest.mark.parametrize("name", NAMES)
def test_each_device_stands_once_and_links_go_on_where_they_are_needed(
    name: str, width: float
) -> None:
    scheme = scheme_of(results_of(name).case)
    found = rows(scheme, width)
    assert len(found) > 1
    assert sorted(number for row in found for number in row.numbers) == [
        *range(len(scheme.devices))
    ]
    ports: Counter[object] = Counter()
    for place, row in enumerate(found):
        own = links(scheme, row.numbers)
        early = links(scheme, [number for one in found[:place] for number in one.numbers])
        late = links(scheme, [number for one in found[place + 1 :] for number in one.numbers])
        further = {(one.link, one.role) for one in row.scheme.ports if one.is_further}
        assert further == {(link, "before") for link in own & early} | {
            (link, "behind") for link in own & late
        }
        ports += Counter(one for one in row.scheme.ports if not one.is_further)
        assert_apart(row.placement)
        for index, number in enumerate(row.numbers):
            taps = [tap for tap in row.placement.row.taps if tap.item == index]
            assert {tap.wire for tap in taps if tap.reach != "none"} == scheme.devices[number].links
        assert {pieces_of(row.placement, wire) for wire in own} == {1}
    assert ports == Counter(scheme.ports)


def test_a_wide_page_has_one_row() -> None:
    scheme = scheme_of(results_of("zf-8hp70.yaml").case)
    [row] = rows(scheme, inf)
    assert row.placement == structure.place(scheme, Style())
    assert row.scheme is scheme


@pytest.mark.parametrize("gear", [1, 3])
def test_what_goes_on_is_pale_where_no_torque_passes(gear: int) -> None:
    """Torque passes between two rows if something carries it on either side (by `loaded`)."""
    results = results_of("zf-8hp70.yaml")
    scheme = scheme_of(results.case)
    state = scheme_state(scheme, state_of(results, gear))
    assert state.loaded is not None
    found, both = rows(scheme, Style().width), set()
    for place, row in enumerate(found):
        own = row.state(state)
        assert own.loaded == [state.loaded[number] for number in row.numbers]
        for port in row.scheme.ports:
            if not port.is_further:
                continue
            cut = place + (port.role == "behind")
            sides = [
                any(port.link in state.loaded[number] for one in part for number in one.numbers)
                or any(
                    one.link == port.link and one not in state.idle_ports
                    for one in scheme.ports
                    if one.is_left == is_left
                )
                for part, is_left in ((found[:cut], True), (found[cut:], False))
            ]
            assert (port in own.idle_ports) == (not all(sides))
            both.add(all(sides))
    assert both == {True, False}


@pytest.mark.slow
@pytest.mark.parametrize("path", some(SHIPPED), ids=lambda path: path.name)
def test_rows_fit_the_page(path: Path) -> None:
    scheme = scheme_of(vstatics.load(path))
    style = Style()
    for row in rows(scheme, style.width):
        low, high = extent(row.scheme, row.placement)
        assert high[0] - low[0] <= style.width
