"""All messages with their explanations, below the page that describes ids."""

from __future__ import annotations

from collections.abc import Iterator

from vstatics.core.messages.catalogue import ExplainedMessage, explained, known_ids
from website.page import anchor

TITLES = {"error": "Errors", "warning": "Warnings", "note": "Notes"}


def explanations() -> str:
    """Return a heading for each severity and id, with cause, remedy and example.

    >>> explanations().startswith("## Errors")
    True
    """
    messages = [explained(identity) for identity in known_ids()]
    parts = []
    for severity, title in TITLES.items():
        parts.append(f"## {title}\n")
        for message in messages:
            if message.severity == severity:
                parts += _section(message)
    return "\n".join(parts)


def _section(message: ExplainedMessage) -> Iterator[str]:
    yield f"{anchor(message.id)}\n### {message.id}\n\n{message.cause}\n\n{message.remedy}\n"
    if message.example:
        yield f"```yaml\n{message.example.rstrip()}\n```\n"
