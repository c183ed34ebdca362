"""Freewheels in a sweep."""

from __future__ import annotations

from tests.core.statics.test_freewheels import pair
from vstatics.sweep import sweep
from vstatics.sweep.chunk import STATUS


def test_a_sweep_tells_a_conflict() -> None:
    (made,) = sweep(pair(2.0), {"D1.ratio": [2, -2]}, out="ratio")
    assert [STATUS[code] for code in made.status] == ["ok", "conflict"]
