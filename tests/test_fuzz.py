"""Mutated inputs end in a result or in words, soon; `tests.fuzz` tries more of them."""

import pytest

from tests import fuzz
from tests.chance import FRESH, count
from tests.fuzz import Kind, kinds, tried


@pytest.mark.parametrize("name", list(kinds()))
def test_good_inputs_are_read(name: str) -> None:
    kind = kinds()[name]
    for text in kind.good:
        kind.read(text.encode())


def test_memory_is_that_of_an_input_and_not_of_those_before(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    made = {
        "small": Kind(("x",), lambda data: data * 2**10),
        "large": Kind(("x" * 2**20,), lambda data: data * 2**6),
    }
    monkeypatch.setattr(fuzz, "kinds", lambda: made)
    monkeypatch.setattr(fuzz, "mutated", lambda _, good: good[0].encode())
    monkeypatch.setattr(fuzz, "MOST_MEMORY", 2**25)
    faults = {tried(number)[0]: tried(number)[2] for number in (1, 0)}
    assert faults["large"].startswith("took 6")  # 64 MB
    assert not faults["small"]


@pytest.mark.slow
@pytest.mark.parametrize("hundred", range(count(6, 20)))
def test_mutated_inputs_end_in_a_result_or_in_words(hundred: int) -> None:
    first = int(FRESH or 0) + hundred * 100
    for number in range(first, first + 100):
        name, _, fault = tried(number)
        assert not fault, f"input {number}, {name}: {fault}"
