"""Cases that the commands are tried on."""

from pathlib import Path

import pytest

from tests.commands import BAD, LOCKED, NEUTRAL, TIED_UP


@pytest.fixture
def files(folder: Path) -> Path:
    """A folder, the current one, with a case of each kind."""
    for name, text in {
        "neutral.yaml": NEUTRAL,
        "tied.yaml": TIED_UP,
        "locked.yaml": LOCKED,
        "bad.yaml": BAD,
        "open.yaml": NEUTRAL.replace("B: [2, housing]", "B: [2, housing], A: [2, housing]").replace(
            "N: {}", "both: {engaged: [A, B]}"
        ),
    }.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder
