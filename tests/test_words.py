"""Messages, explanations, help texts and documents avoid words that readers stumble over."""

import pytest

from tests.commands import ROOT
from tests.installed import ANNEXES, missing
from tests.words import explanations, helps, messages, prose, stumbles
from vstatics.core.cli import main

ROOMS = ("core", *ANNEXES)
"""The core and the annexes, whose messages and explanations are checked."""
EXCEPTED = ROOT / "docs/glossary.md"
"""Document that lists words of the sources."""
DOCUMENTS = {ROOT / "README.md", *ROOT.glob("docs/**/*.md"), *ROOT.glob("website/*.md")}


@pytest.mark.parametrize("room", sorted({*ROOMS} - {*missing(ANNEXES)}))
def test_messages_are_plain(room: str) -> None:
    found = [f"{place}: {why}" for place, text in messages(room) for why in stumbles(text)]
    assert found == []


@pytest.mark.parametrize("file", ROOMS)
def test_explanations_are_plain_sentences(file: str) -> None:
    for identity, text in explanations(file):
        assert stumbles(text) == [], identity
        for line in text.split("\n"):
            assert line[0].isupper() or line[0] in "`-", (identity, line)
            assert line.endswith("."), (identity, line)
            assert "..." not in line, (identity, line)


def test_help_is_plain() -> None:
    found = [f"{command}: {why}" for command, text in helps(main) for why in stumbles(text)]
    assert found == []


def test_documents_are_plain() -> None:
    found = {path: stumbles(prose(path)) for path in DOCUMENTS - {EXCEPTED}}
    assert {str(path): why for path, why in found.items() if why} == {}
