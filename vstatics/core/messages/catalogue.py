"""Catalogue of all messages, read from the files of this folder.

>>> warning = explained("W315")
>>> warning.severity, warning.cause
('warning', 'The tips of neighbouring planets touch.')
>>> print(warning.remedy)
Use fewer planets, or planets with fewer teeth.
"""

from __future__ import annotations

import os
import textwrap
from functools import cache

from vstatics.core.errors import Severity, severity
from vstatics.core.named_tuple import NamedTuple

_FOLDER = os.path.dirname(__file__)  # noqa: PTH120 (pathlib costs start-up time)
_WIDTH = 80


class ExplainedMessage(NamedTuple):
    """Message id with its explanation."""

    id: str
    severity: Severity
    cause: str
    remedy: str
    example: str | None
    """YAML case whose check prints the message; None if no single case can cause it."""


@cache
def _explanations() -> dict[str, tuple[str, str]]:
    """Return cause and remedy of each id: errors, then warnings, then notes."""
    found = {}
    for file in os.listdir(os.path.join(_FOLDER, "causes")):  # noqa: PTH118, PTH208
        for block in _read("causes", file).split("\n\n"):
            identity, cause, remedy = block.strip().split("\n")
            found[identity] = cause, remedy
    return {identity: found[identity] for identity in sorted(found, key=_order)}


def _read(*path: str) -> str:
    with open(os.path.join(_FOLDER, *path), encoding="utf-8") as file:  # noqa: PTH118, PTH123
        return file.read()


def _order(identity: str) -> tuple[int, str]:
    return "EWN".index(identity[0]), identity


def known_ids() -> list[str]:
    """Return the ids of all errors, warnings and notes."""
    return list(_explanations())


def causes_of_allowable() -> dict[str, str]:
    """Return the causes of all warnings and notes by id; errors cannot be suppressed.

    >>> sorted({identity[0] for identity in causes_of_allowable()})
    ['N', 'W']
    """
    return {
        identity: cause for identity, (cause, _) in _explanations().items() if identity[0] != "E"
    }


def explained(identity: str) -> ExplainedMessage:
    """Return the explanation of a known id."""
    path = ("examples", f"{identity}.yaml")
    has_example = os.path.isfile(os.path.join(_FOLDER, *path))  # noqa: PTH113, PTH118
    example = _read(*path) if has_example else None
    return ExplainedMessage(identity, severity(identity), *_explanations()[identity], example)


def text(message: ExplainedMessage) -> str:
    """Return the explanation of a message as text, with an example if there is one.

    >>> print(text(explained("W432")), end="")
    W432 (warning)
    Cause: The gear is marked `kind: neutral`, but its engaged shift elements
    determine all speeds, so it drives.
    Remedy: Remove `kind: neutral`, or release a shift element.
    """
    sentences = [f"Cause: {message.cause}", f"Remedy: {message.remedy}"]
    lines = [f"{message.id} ({message.severity})"]
    for sentence in sentences:
        lines += textwrap.wrap(sentence, _WIDTH, break_long_words=False, break_on_hyphens=False)
    if message.example:
        example = textwrap.indent(message.example.rstrip("\n"), "    ")
        lines += ["Example:", "", *example.splitlines()]
    return "\n".join(lines) + "\n"
