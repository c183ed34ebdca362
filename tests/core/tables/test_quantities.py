"""The declaration of the quantities: names that tell them apart, rows and kinds, units."""

import re

from vstatics.core.statics.result_arrays import ARRAYS
from vstatics.core.tables import quantities
from vstatics.core.tables.quantities import ASKED, BY_NAME, QUANTITIES, RELATIVE, WITH_UNITS
from vstatics.core.texts import heading as in_language
from vstatics.core.texts import speaking

PUBLISHED = ["AJK", "W", "WSAT", "WFRI", "AMLG", "AMLGP", "ETA", "IX"]
"""The tables of the report of the source, in its order."""


def test_each_name_stands_for_one_quantity() -> None:
    """A person may type the name or the deck name."""
    names = [name for one in QUANTITIES + ASKED for name in (one.name, one.deck_name)]
    assert len(names) == len(set(names)) == len(BY_NAME)
    assert len(quantities.PRINTED) == len(QUANTITIES)
    assert all(BY_NAME[one.name] is BY_NAME[one.deck_name] is one for one in QUANTITIES)
    assert BY_NAME["AMLGP_Nm"] is BY_NAME["lossy_torques_Nm"]
    assert "w" not in BY_NAME


def test_the_tables_of_the_source_come_first_under_its_names() -> None:
    first = [one for one in QUANTITIES if one.published]
    assert [one.deck_name for one in first] == [one.printed for one in first] == PUBLISHED
    assert list(QUANTITIES[: len(first)]) == first


def test_a_quantity_is_an_array_or_says_what_its_rows_are() -> None:
    for one in RELATIVE:
        assert (one.name in ARRAYS) == (one.own_rows is None), one.name


def test_headings_are_in_every_language() -> None:
    for one in QUANTITIES:
        for heading in (one.heading, *(one.members or ()), *([one.brief] if one.brief else [])):
            assert not heading.endswith(":")
            with speaking("ru"):
                assert not re.search("[а-яА-Я]", heading)
                assert re.search("[а-яА-Я]", in_language(heading))


def test_a_load_adds_its_own_unit_to_each_quantity_that_has_one() -> None:
    assert {one.of for one in WITH_UNITS if one.of} == {q.name for q in RELATIVE if q.with_load}
    for one in WITH_UNITS:
        assert one.name.endswith(f"_{one.unit}")
        assert not one.always
        if one.of:
            assert one.rows == BY_NAME[one.of].rows
