"""Sweeps that leave a state, in small pieces."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.sweep.sweeps import CASE_TEXT
from vstatics.sweep import build


def prepare_sweeps(monkeypatch: pytest.MonkeyPatch) -> None:
    """Write a case into the current folder; eight variants are calculated at once."""
    Path("box.yaml").write_text(CASE_TEXT, encoding="utf-8")
    whole = build.plan
    monkeypatch.setattr(build, "plan", lambda *of: replace(whole(*of), piece=8))
