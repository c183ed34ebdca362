"""Amounts as one says them: of bytes, of time, of what is not known exactly."""

from __future__ import annotations

import math


def size_text(length: float) -> str:
    """Bytes as one says them.

    >>> size_text(999), size_text(1.3e9)
    ('999 bytes', '1.3 GB')
    """
    units = ("bytes", "kB", "MB", "GB", "TB", "PB", "EB")
    power = min(int(math.log10(max(length, 1)) / 3), len(units) - 1)
    return f"{length / 1000**power:.3g} {units[power]}"


def duration_text(seconds: float) -> str:
    """A duration as one says it.

    >>> duration_text(0.2), duration_text(90), duration_text(9000), duration_text(1e8)
    ('a second', '1.5 minutes', '2.5 hours', '3.17 years')
    """
    if seconds < 1:
        return "a second"
    if seconds < 60:
        return f"{seconds:.0f} s"
    if seconds < 3600:
        return f"{seconds / 60:.2g} minutes"
    days = seconds / 3600 / 24
    if days < 4:
        return f"{seconds / 3600:.3g} hours"
    return f"{days:.3g} days" if days < 1000 else f"{days / 365.25:.3g} years"


def about(number: float) -> str:
    """A number that is not known exactly, as one says it.

    >>> about(785_512.3), about(2.03e22)
    ('about 786000', 'about 2.03e+22')
    """
    if number >= 1e15:
        return f"about {number:.3g}"
    return f"about {float(f'{number:.3g}'):.0f}"
