"""Boxes that keep parts of a gearbox: of shipped cases, whose ratios the solver tells."""

import json

import pytest

from vstatics import CaseError, example, solve
from vstatics.core.jobs.finished_cases import differing
from vstatics.synthesis.boxes.batches.found import found_in
from vstatics.synthesis.boxes.batches.ports import PortSearch
from vstatics.synthesis.boxes.batches.work import description
from vstatics.synthesis.boxes.modified import kept_search
from vstatics.synthesis.boxes.schemes.stems import box_schemes

BUILT = "aisin-8speed gm-8l90 mercedes-5g mercedes-7g ravigneaux-aod simpson zf-6hp26"
"""With and without one-way clutches, meshed sets, held members, inputs of their own."""


def ratios(name: str) -> tuple[float, ...]:
    """Those of a case, by the solver; each once."""
    found: list[float] = []
    for ratio in solve(example(name)).ratio.tolist():
        if all(abs(ratio / one - 1) > 0.01 for one in found):
            found.append(ratio)
    return tuple(found)


@pytest.mark.slow
@pytest.mark.parametrize("name", BUILT.split())
def test_a_gearbox_that_keeps_all_is_itself(name: str) -> None:
    search = kept_search(example(name), 0, ratios(name))
    [found] = found_in(search).boxes
    assert search.kept is not None
    assert (sorted(found.elements), found.error < 1e-6) == (sorted(search.kept.elements), True)


@pytest.mark.slow
@pytest.mark.parametrize("free", range(4))
def test_what_is_kept_is_what_a_filter_leaves(free: int) -> None:
    search = kept_search(example("ravigneaux-aod"), free, ratios("ravigneaux-aod"))
    kept = search.kept
    assert kept is not None
    [scheme] = box_schemes(search)
    every = PortSearch(search._replace(kept=None), scheme).boxes(kept.input, kept.output)
    has = {*kept.elements}
    left = [one for one in every if len(has & {*one.elements}) >= len(has) - free]
    assert {one.elements for one in found_in(search).boxes} == {one.elements for one in left}
    assert 0 < len(left) <= len(every)


@pytest.mark.slow
def test_the_seven_speed_is_on_its_own_ports() -> None:
    """With all elements free; a group of planets is two sets on one sun."""
    wanted = (4.377, 2.859, 1.921, 1.368, 1.0, 0.82, 0.728, -3.416, -2.231)  # as published
    search = kept_search(example("mercedes-7g"), 7, wanted)._replace(tolerance=0.005)
    assert search.kept is not None
    found = found_in(search)
    assert found.given_up == 0
    assert {*search.kept.elements} in [{*one.elements} for one in found.boxes]


def test_the_ten_speed_has_a_shaft_beside_its_sets() -> None:
    search = kept_search(example("ford-10r80"), 0, (3.0, 1.0))
    assert search[:3] == (4, 6, 4)
    assert (search.shafts, search.own_input, search.fixed) == (1, False, 0)
    assert search.kept is not None
    ends = [link for one in search.kept.elements for link in one]
    assert ends.count(search.links) == 3  # its clutches C, D, F


def test_what_is_no_gearbox_of_sets_is_refused() -> None:
    for name, told in (("two-stage", "E920"), ("moskvich-start", "E921")):
        with pytest.raises(CaseError) as error:
            kept_search(example(name), 0, (3.0, 1.0))
        assert [one.id for one in error.value.problems] == [told]


@pytest.mark.parametrize("free", [0, 2])
def test_a_search_is_that_of_its_description(free: int) -> None:
    """As JSON has it, so that an interrupted search goes on."""
    wanted = description(kept_search(example("simpson"), free, ratios("simpson")), 3)
    assert differing(json.loads(json.dumps(wanted)), wanted) == []
