"""Drag without a unit in a sweep."""

from __future__ import annotations

from tests.commands import vstatics
from tests.core.model.test_bare_drags import BARE


def test_a_sweep_warns_once() -> None:
    vary = ("--vary", "load.torque=50 N*m:200 N*m:7")
    assert vstatics("sweep", "-", *vary, stdin=BARE.encode()).err.count("has no unit") == 1
