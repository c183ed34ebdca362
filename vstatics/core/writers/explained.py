"""Explanations of all messages: cause, cure, and a case that shows the message.

In the folder `messages`, `causes.txt` has a line for each id, and `examples` has a case for each
message that a case alone can show. They are the source of the last part of docs/messages.md.

>>> warning = explained("W318")
>>> warning.severity, warning.cause
('warning', "equally spaced bevel pinions can't be assembled")
>>> print(warning.cure)
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
    """Kind of message, with an explanation."""

    id: str
    severity: Severity
    cause: str
    cure: str
    example: str | None
    """YAML case whose check prints the message, if a case alone can show the message."""


@cache
def _lines() -> dict[str, tuple[str, str]]:
    """Return cause and cure of each id, in the order of the page."""
    text = _FOLDER.joinpath("causes.txt").read_text("utf-8")
    rows = (line.split(" | ") for line in text.splitlines() if not line.startswith("#"))
    return {identity: (DOUBTS.get(identity, cause), cure) for identity, cause, cure in rows}


def known_ids() -> list[str]:
    """List the ids of all errors, warnings and notes."""
    return list(_lines())


def explained(identity: str) -> ExplainedMessage:
    """Return the explanation of an id, in upper or lower case.

    Raises
    ------
    ValueError
        If no message has the id; the error suggests the nearest id.
    """
    identity = identity.upper()
    if identity not in _lines():
        raise ValueError(f"there is no message {quoted(identity)}{nearest(identity, _lines())}")
    file = _FOLDER.joinpath("examples", f"{identity}.yaml")
    example = file.read_text("utf-8") if file.is_file() else None
    return ExplainedMessage(identity, severity(identity), *_lines()[identity], example)


def text(message: ExplainedMessage) -> str:
    """Write the explanation of a message, with an example if there is any.

    >>> print(text(explained("E660")), end="")
    E660, an error: the case that a scenario names has errors
      mend the case
    """
    article = "an" if message.severity == "error" else "a"
    lines = [f"{message.id}, {article} {message.severity}: {message.cause}", f"  {message.cure}"]
    if message.example:
        lines += ["", *(f"    {line}".rstrip() for line in message.example.splitlines())]
    return "\n".join(lines) + "\n"
