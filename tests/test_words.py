"""Messages, explanations, help texts and documents avoid words that readers stumble over.

A part of the texts is checked if its name is listed here. To check all of them write
``ROOMS = EXPLAINED = ("core", *ANNEXES)`` with `ANNEXES` of tests/installed.py, and
``DOCUMENTS = ("README.md", "docs/**/*.md", "website/*.md")``.
"""

from __future__ import annotations

import pytest

from tests.commands import ROOT
from tests.words import explanations, helps, messages, prose, stumbles
from vstatics.core.cli import main

ROOMS = ("core",)
"""The core and annexes whose messages are checked in the code."""
EXPLAINED = ("core",)
"""Files of explanations that are checked."""
COMMANDS = ("",)
"""First words of the commands whose help is checked; every command begins with an empty word."""
DOCUMENTS = (
    "README.md",
    "website/*.md",
    *(
        f"docs/{name}.md"
        for name in (
            *("README", "cases", "coming-from", "commands", "deck", "elements", "explain"),
            *("expressions", "messages", "method", "power-flow", "python", "results", "springs"),
            *("summary", "tutorial", "units", "simulation/method", "vehicle/README"),
        )
    ),
)
"""Documents that are checked, as patterns."""


@pytest.mark.parametrize("room", ROOMS)
def test_messages_are_plain(room: str) -> None:
    found = [f"{place}: {why}" for place, text in messages(room) for why in stumbles(text)]
    assert found == []


@pytest.mark.parametrize("file", EXPLAINED)
def test_explanations_are_plain(file: str) -> None:
    found = [
        f"{identity}: {why}" for identity, text in explanations(file) for why in stumbles(text)
    ]
    assert found == []


@pytest.mark.parametrize("file", EXPLAINED)
def test_explanations_are_sentences(file: str) -> None:
    for identity, text in explanations(file):
        for line in text.split("\n"):
            assert line[0].isupper() or line[0] in "`-", (identity, line)
            assert line.endswith("."), (identity, line)
            assert "..." not in line, (identity, line)


@pytest.mark.parametrize("first", COMMANDS)
def test_help_is_plain(first: str) -> None:
    found = [
        f"{command}: {why}"
        for command, text in helps(main)
        if command.startswith(first)
        for why in stumbles(text)
    ]
    assert found == []


@pytest.mark.parametrize("pattern", DOCUMENTS)
def test_documents_are_plain(pattern: str) -> None:
    documents = sorted(ROOT.glob(pattern))
    assert documents
    found = [f"{page.name}: {why}" for page in documents for why in stumbles(prose(page))]
    assert found == []
