"""The part of docs/messages.md that is made here: ``python -m tests.message_page FILE``."""

from __future__ import annotations

import sys

from vstatics.core.writers.explained import explained, known_ids

BEGIN = "## Causes, cures, examples\n"


def made() -> str:
    """A heading for each id, below it cause, cure and example.

    >>> made().startswith(BEGIN)
    True
    """
    parts = [BEGIN]
    for one in map(explained, known_ids()):
        parts.append(f"### {one.id}\n\n{_sentence(one.cause)} {_sentence(one.cure)}\n")
        if one.example:
            parts.append("".join(f"    {line}".rstrip() + "\n" for line in one.example.split("\n")))
    return "\n".join(part.rstrip("\n") + "\n" for part in parts)


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."


def page(before: str) -> str:
    """The page with its last part made anew.

    >>> page("# Messages\\n").startswith("# Messages\\n\\n## Causes")
    True
    """
    return before.partition(BEGIN)[0].rstrip("\n") + "\n\n" + made()


if __name__ == "__main__":
    with open(sys.argv[1], "r+", encoding="utf-8") as file:  # noqa: PTH123
        text = page(file.read())
        file.seek(0)
        file.truncate()
        file.write(text)
