"""Sweeps of a scenario that leave a state, in small pieces."""

from pathlib import Path

import pytest

from tests.simulation.variants.scenarios import CASE, SCENARIO
from vstatics.sweep import runs


def write_scenario(folder: Path) -> None:
    (folder / "set.yaml").write_bytes(CASE)
    (folder / "lock.yaml").write_bytes(SCENARIO)


def prepare_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Write the inputs into the current folder; two runs are calculated at once."""
    write_scenario(Path())
    monkeypatch.setattr(runs, "piece_of_runs", lambda _: 2)
