"""What is said is safe to print."""

import re

import pytest

from vstatics.core import errors


@pytest.mark.parametrize("lines", [True, False])
def test_texts_of_one_letter_are_escaped_by_the_pattern_alone(lines: bool) -> None:
    """The short way out is for letters only that the pattern leaves as they are."""
    pattern = errors._IN_LINES if lines else errors._IN_LINE
    for number in (*range(0x3000), *range(0xD700, 0xE100), 0xFEFF, 0x1F69C, 0x10FFFF):
        letter = chr(number)
        shown = f"\\u{number:04x}" if re.match(pattern, letter) else letter
        assert errors.printable(letter, lines=lines) == shown
