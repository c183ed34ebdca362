"""Signs that word processors and print have instead of plain ones: blanks and dashes."""

from __future__ import annotations

import re

_BLANKS = re.compile("[\u00a0\u1680\u2000-\u200a\u202f\u205f\u3000]")
"""No-break, thin and other blanks."""
DASHES = "\u2212\u2010\u2011\u2012\u2013\u2014"
"""The sign for minus, and what word processors make of a hyphen."""


def with_plain_blanks(text: str) -> str:
    r"""Return a text with plain blanks instead of those of word processors, each at its place.

    >>> with_plain_blanks("300\u00a0N*m, 1\u2009kW")
    '300 N*m, 1 kW'
    """
    return text if text.isascii() else _BLANKS.sub(" ", text)


def dash_hint(text: str) -> str:
    """Return a hint that a dash is not the sign for minus; nothing where there is no dash.

    >>> dash_hint("\u22122.6"), dash_hint("-2.6")
    (' (with `-` in place of `\u2212`)', '')
    """
    dash = next((sign for sign in text if sign in DASHES), None)
    return f" (with `-` in place of `{dash}`)" if dash else ""
