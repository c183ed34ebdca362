"""Doubts about teeth as a whole."""

import time

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.core.elements.toothed import RANDOM, element, found
from vstatics.core.elements import Drawing, Element
from vstatics.core.elements.checks import problems
from vstatics.core.elements.kinds import KINDS, Planetary


@pytest.mark.parametrize(
    "one",
    [
        element("belt", first=10, second=10.5),
        element("worm", worm=1, wheel=40),
        element("shaft"),
        element("held"),
        element("bevel"),
        element("planetary", 3, sun=10.5, ring=30),
        element("gear_pair", first=20, second=41),
        element("planetary", sun=49, ring=95),
    ],
    ids=lambda one: one.kind,
)
def test_there_is_nothing_to_say_about(one: Element) -> None:
    assert not found(one)


def test_no_doubt_is_an_error_and_elements_count_from_1() -> None:
    bad = element("planetary", 3, sun=10, ring=97, planet=12)
    doubtful = found(element("gear_pair", first=20, second=41), bad)
    assert {problem.path[:2] for problem in doubtful} == {("elements", 2)}
    assert {problem.severity for problem in doubtful} == {"warning", "note"}


@RANDOM
@given(st.data(), st.integers(1, 7))
def test_any_teeth_without_errors_can_be_doubted(data: st.DataObject, planets: int) -> None:
    kind = data.draw(st.sampled_from(["planetary", "double_planet", "stepped", "ravigneaux"]))
    shape = KINDS[kind]
    assert isinstance(shape, Planetary)
    names = data.draw(st.lists(st.sampled_from(shape.toothed), min_size=2, unique=True))
    one = element(kind, planets, **{name: data.draw(st.integers(1, 60)) for name in names})
    assume(not [*problems(Drawing(9, [one]))])
    assert all(problem.severity in ("warning", "note") for problem in found(one))


def test_a_case_of_ten_elements_is_checked_at_once() -> None:
    one = element("planetary", 3, sun=48, ring=97, planet=24)
    start = time.process_time()
    found(*[one] * 10)
    assert time.process_time() - start < 2  # some 40 ms; much more on a busy machine
