"""Cases that the commands are tried on."""

from pathlib import Path

import pytest

from tests.commands import BAD, LOCKED, NEUTRAL, TIED_UP
from tests.core.cli.states import prepare

OPEN = NEUTRAL.replace("B: [2, housing]", "B: [2, housing], A: [2, housing]").replace(
    "N: {}", "both: {engaged: [A, B]}"
)


@pytest.fixture
def files(folder: Path) -> Path:
    """A folder, the current one, with a case of each kind."""
    texts = {"neutral": NEUTRAL, "tied": TIED_UP, "locked": LOCKED, "bad": BAD, "open": OPEN}
    for name, text in texts.items():
        (folder / f"{name}.yaml").write_text(text, "utf-8")
    return folder


@pytest.fixture
def prepared(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder, the current one, with the inputs of all commands that leave a state."""
    prepare(tmp_path, monkeypatch)
    return tmp_path
