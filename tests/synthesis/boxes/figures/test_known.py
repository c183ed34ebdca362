"""Boxes that are built are told by the names of their cases; a case is read back as a box."""

from importlib.resources import files

import pytest

from tests.synthesis.boxes import hand_boxes
from tests.synthesis.boxes.figures.random_boxes import RandomBox, numbered_box, random_boxes
from vstatics.core.examples import example
from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.boxes.choice import find_boxes
from vstatics.synthesis.boxes.figures.built import built_box
from vstatics.synthesis.boxes.figures.known import known_name
from vstatics.synthesis.boxes.figures.shipped import table
from vstatics.synthesis.boxes.least_form import identity, least_box, least_forms

BUILT = {
    "zf-8hp70": hand_boxes.ZF_8HP,
    "simpson": hand_boxes.SIMPSON,
    "zf-6hp26": hand_boxes.ZF_6HP,
    "ford-10r80": hand_boxes.FORD_10R,
}


@pytest.mark.parametrize("name", BUILT)
def test_a_built_gearbox_is_known_whatever_its_teeth_are(name: str) -> None:
    box = BUILT[name]
    assert known_name(least_box(box)) == name
    other = box._replace(ratios=tuple(1.01 * ratio for ratio in box.ratios))
    assert known_name(least_box(other)) == name


def test_the_table_is_that_of_the_shipped_cases() -> None:
    file = files("vstatics.synthesis.boxes.figures") / "known.jsonl"
    assert file.read_text("utf-8") == table(), "write it: make known"


def test_with_another_element_or_gear_it_is_not() -> None:
    """The clutch to the rear carrier goes to the ring; gear 3 engages what locks the rear set."""
    box = hand_boxes.ZF_6HP
    elements = (*box.elements[:2], (0, 6), *box.elements[3:])
    assert known_name(least_box(box._replace(elements=elements))) is None
    assert known_name(least_box(box._replace(gears=((0, 3), (3, 4), *box.gears[2:])))) is None


@pytest.mark.parametrize("one", [*random_boxes(40, seed=9)], ids=numbered_box)
def test_the_case_of_a_box_is_read_back_as_the_box(one: RandomBox) -> None:
    found = one.measured()
    box = built_box(found.case)
    assert box is not None
    assert identity(least_box(box)) == identity(found.box)
    forms = [(form.ratios, {*form.gears}) for form in least_forms(box)]
    assert (found.box.ratios, {*found.box.gears}) in forms


def test_what_is_not_of_sets_brakes_and_clutches_alone_is_no_box() -> None:
    for name in ("two-stage", "driveline-8hp70", "dual-clutch-wheels", "wheel-hub"):
        assert built_box(example(name)) is None


SEARCHES = {
    "simpson": hand_boxes.SIMPSON_SEARCH,
    "ravigneaux-aod": BoxSearch(2, 5, 2, (2.4, 1.467, 1, 0.667, -2), meshed=1, own_input=True),
    "gm-6t70": BoxSearch(3, 5, 2, (4.584, 2.964, 1.912, 1.446, 1.0, 0.746, -2.94)),
    "zf-6hp26": hand_boxes.ZF_6HP_SEARCH,
}


@pytest.mark.slow
@pytest.mark.parametrize("name", SEARCHES)
def test_a_search_with_its_ratios_finds_it_by_name(name: str) -> None:
    found = find_boxes(SEARCHES[name]).boxes
    own = [one.found for one in found if one.found.known == name]
    assert len(own) == 1
    if "ravigneaux" in name or "6hp" in name:
        assert own[0].ravigneaux
