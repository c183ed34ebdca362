"""Sweeps that leave a state, in small pieces."""

from pathlib import Path

import pytest

from tests.sweep.sweeps import CASE_TEXT, small_pieces


def prepare_sweeps(monkeypatch: pytest.MonkeyPatch) -> None:
    """Write a case into the current folder; eight variants are calculated at once."""
    Path("box.yaml").write_text(CASE_TEXT, "utf-8")
    small_pieces(monkeypatch)
