"""Decks that follow one of the same structure: read as if each stood alone."""

import random
from collections.abc import Iterator

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.commands import MZKT
from tests.strategies import transmissions
from vstatics import Transmission, load
from vstatics.core.errors import Problem, ReadError
from vstatics.core.readers.deck import reader
from vstatics.core.readers.deck.reader import LONGEST_REMEMBERED_DECK
from vstatics.core.readers.reading import Reading
from vstatics.core.writers import deck

TEXT = deck.write(load(MZKT))


@pytest.fixture(autouse=True)
def _nothing_known() -> Iterator[None]:
    reader._known = None
    yield
    reader._known = None


def read(text: str) -> Reading:
    return reader.read(text.encode(), "case.dat")


def outcome(text: str) -> tuple[Transmission | None, list[Problem], list[Problem]]:
    """Case, problems, and where the gears stand."""
    try:
        reading = read(text)
    except ReadError as error:
        return None, error.problems, []
    gears = range(1, len(reading.case.gears) + 1)
    places = [reading.locate(Problem("E234", "", ("gears", gear))) for gear in gears]
    return reading.case, reading.warnings, places


def same_as_alone(before: str, text: str) -> None:
    reader._known = None
    alone = outcome(text)
    reader._known = None
    outcome(before)
    assert outcome(text) == alone


@settings(max_examples=count(8, 60))
@given(transmissions(follow=False), st.randoms(use_true_random=False))
def test_a_deck_of_other_numbers_is_read_as_alone(case: Transmission, rng: random.Random) -> None:
    others = [
        mechanism._replace(ratio=rng.uniform(-3, 3) or 1.0, efficiency=rng.uniform(0.5, 1.0))
        for mechanism in case.mechanisms
    ]
    same_as_alone(deck.write(case), deck.write(case.replace(mechanisms=others)))


@given(st.randoms(use_true_random=False))
def test_a_deck_with_any_change_is_read_as_alone(rng: random.Random) -> None:
    """A word is put in the place of another, or a line left out or repeated."""
    lines = TEXT.splitlines()
    at = rng.randrange(len(lines))
    words = lines[at].split(" ")
    word = rng.choice(["-2.5", "0", "1", "7", "2*3", "x", "1,5", "", "1e400", "KL=", "NAME P1: a"])
    words[rng.randrange(len(words))] = word
    changed = rng.choice([[" ".join(words)], [], [lines[at]] * 2])
    same_as_alone(TEXT, "\n".join([*lines[:at], *changed, *lines[at + 1 :]]))


def test_of_a_variant_only_numbers_are_read() -> None:
    """All else is the very object of the deck before."""
    first = read(TEXT).case
    second = read(TEXT.replace(".9500E+00", ".9400E+00")).case
    assert second.gears is first.gears
    assert [one.efficiency for one in first.mechanisms] == [0.94, 0.95, 0.97]
    assert [one.efficiency for one in second.mechanisms] == [0.94, 0.94, 0.97]


@pytest.mark.parametrize(
    "other",
    [
        TEXT.replace("KWZ(I),I=1,NP: 0 0 0 0 0 0", "KWZ(I),I=1,NP: 6*0"),
        TEXT + "remarks\n" * LONGEST_REMEMBERED_DECK,
        TEXT.replace("KMZ(I),I=1,NP: 0 0 0 0 0 0", ""),
    ],
    ids=["repeat counts", "long", "a warning"],
)
def test_a_deck_is_not_remembered_that_is_not_plain(other: str) -> None:
    assert other != TEXT
    read(other)
    assert reader._known is None
