"""What is behind each id of a message: its cause, its cure, and a case that shows it.

`causes.txt` has a line for each id, the folder `examples` a case for each that a case alone can
show; both stand in the folder `messages`. The last part of docs/messages.md is made of them.

>>> told = explained("W318")
>>> told.severity, told.cause
('warning', "equally spaced bevel pinions can't be assembled")
>>> print(told.cure)
change teeth so that their sum is divisible by the pinions
"""

from __future__ import annotations

from functools import cache
from importlib import resources
from typing import NamedTuple

from vstatics.core.errors import DOUBTS, Severity, quoted, severity
from vstatics.core.suggestions import nearest

_FOLDER = resources.files("vstatics.core.writers").joinpath("messages")


class ExplainedMessage(NamedTuple):
    """A kind of message."""

    id: str
    severity: Severity
    cause: str
    cure: str
    example: str | None
    """A YAML case whose check tells it; None where another file or a run is needed."""


@cache
def _lines() -> dict[str, tuple[str, str]]:
    """Cause and cure of each id, in the order of the page."""
    text = _FOLDER.joinpath("causes.txt").read_text("utf-8")
    rows = (line.split(" | ") for line in text.splitlines() if not line.startswith("#"))
    return {identity: (DOUBTS.get(identity, cause), cure) for identity, cause, cure in rows}


def known_ids() -> list[str]:
    """All ids: errors, warnings, notes."""
    return list(_lines())


def explained(identity: str) -> ExplainedMessage:
    """What an id stands for, in large or small letters.

    Raises
    ------
    ValueError
        If there is no such message; with the nearest id.
    """
    identity = identity.upper()
    if identity not in _lines():
        message = f"there is no message {quoted(identity)}{nearest(identity, _lines())}"
        raise ValueError(message)
    file = _FOLDER.joinpath("examples", f"{identity}.yaml")
    example = file.read_text("utf-8") if file.is_file() else None
    return ExplainedMessage(identity, severity(identity), *_lines()[identity], example)


def text(one: ExplainedMessage) -> str:
    """An id as a person reads it, with its example.

    >>> print(text(explained("E660")), end="")
    E660, an error: the case that a scenario names has errors
      mend the case
    """
    article = "an" if one.severity == "error" else "a"
    lines = [f"{one.id}, {article} {one.severity}: {one.cause}", f"  {one.cure}"]
    if one.example:
        lines += ["", *(f"    {line}".rstrip() for line in one.example.splitlines())]
    return "\n".join(lines) + "\n"
