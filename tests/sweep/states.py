"""Sweeps that leave a state, in small pieces."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.installed import HERE
from tests.sweep.sweeps import CASE_TEXT
from vstatics.sweep import build, runs


def write_inputs(folder: Path) -> None:
    """Write a case, and a scenario with its case."""
    (folder / "box.yaml").write_text(CASE_TEXT, encoding="utf-8")
    if "simulation" in HERE:
        from tests.simulation.variants.scenarios import CASE, SCENARIO

        (folder / "set.yaml").write_bytes(CASE)
        (folder / "lock.yaml").write_bytes(SCENARIO)


def prepare_sweeps(monkeypatch: pytest.MonkeyPatch) -> None:
    """Write the inputs into the current folder; variants are calculated 8 at once, runs 2."""
    write_inputs(Path())
    whole = build.plan
    monkeypatch.setattr(build, "plan", lambda *of: replace(whole(*of), piece=8))
    monkeypatch.setattr(runs, "piece_of_runs", lambda _: 2)
