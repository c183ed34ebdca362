"""Mutated inputs end in a result or in words, soon; `tests.fuzz` tries more of them."""

from __future__ import annotations

import pytest

from tests.chance import FRESH, count
from tests.fuzz import kinds, tried


@pytest.mark.parametrize("name", list(kinds()))
def test_good_inputs_are_read(name: str) -> None:
    kind = kinds()[name]
    for text in kind.good:
        kind.read(text.encode())


@pytest.mark.slow
@pytest.mark.parametrize("hundred", range(count(6, 20)))
def test_mutated_inputs_end_in_a_result_or_in_words(hundred: int) -> None:
    first = int(FRESH or 0) + hundred * 100
    for number in range(first, first + 100):
        name, _, fault = tried(number)
        assert not fault, f"input {number}, {name}: {fault}"
