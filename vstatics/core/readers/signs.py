"""Typographic blanks and dashes, which occur in printed and copied text."""

from __future__ import annotations

import re

_BLANKS = "[\u00a0\u1680\u2000-\u200a\u202f\u205f\u3000\ufeff]"
"""No-break, thin and other typographic blanks, and byte order marks within joined files."""
DASHES = "\u2212\u2010\u2011\u2012\u2013\u2014"
"""Minus sign, and dashes that word processors write for a hyphen."""


def with_plain_blanks(text: str) -> str:
    r"""Return a text with plain blanks for typographic blanks; positions do not change.

    >>> with_plain_blanks("300\u00a0N*m, 1\u2009kW\n\ufeff12")
    '300 N*m, 1 kW\n 12'
    """
    return text if text.isascii() else re.sub(_BLANKS, " ", text)


def with_escaped_blanks(text: str) -> str:
    r"""Return JSON or quoted YAML with escapes for typographic blanks, which readers keep.

    >>> print(with_escaped_blanks('"a\u00a0b"'))
    "a\u00a0b"
    """
    return re.sub(_BLANKS, lambda blank: f"\\u{ord(blank[0]):04x}", text)


def dash_hint(text: str) -> str:
    """Return a hint to write a plain minus; empty if the text contains no dash.

    >>> dash_hint("\u22122.6"), dash_hint("-2.6")
    (' (with `-` instead of `\u2212`)', '')
    """
    dash = next((sign for sign in text if sign in DASHES), None)
    return f" (with `-` instead of `{dash}`)" if dash else ""
