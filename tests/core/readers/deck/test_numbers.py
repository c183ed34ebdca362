"""Numbers as Fortran reads them."""

from __future__ import annotations

import pytest

from vstatics.core.readers.deck.numbers import NotANumberError, integer, real


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("-.8", -0.8),
        ("+2.", 2.0),
        (".26E+01", 2.6),
        (".2600Е+01", 2.6),
        (".2600е+01", 2.6),
        ("2.6D0", 2.6),
        ("2.6q-1", 0.26),
        (".26+1", 2.6),
        ("26-1", 2.6),
        ("1E400-400", None),
        ("1_0", None),
        ("nan", None),
        ("inf", None),
        ("1e999", None),
        ("٢", None),
        ("0x10", None),
        ("", None),
        (".", None),
        ("+", None),
        ("1e", None),
        ("1 2", None),
        ("1" * 2000, None),
    ],
)
def test_numbers_of_list_directed_input(text: str, value: float | None) -> None:
    if value is None:
        with pytest.raises(NotANumberError):
            real(text)
    else:
        assert real(text) == value


@pytest.mark.parametrize("text", ["2.", "1e0", "1_0", "٢", "", "-", "9" * 30])
def test_no_whole_numbers(text: str) -> None:
    with pytest.raises(NotANumberError):
        integer(text)


def test_whole_numbers() -> None:
    assert [integer(text) for text in ("6", "+6", "-6", "006")] == [6, 6, -6, 6]
