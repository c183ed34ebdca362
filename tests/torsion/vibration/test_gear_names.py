"""Gears of torsion are called as those of statics."""

from __future__ import annotations

import pytest

from tests.commands import CASES
from vstatics import load, torsion


def test_gears_of_torsion_are_named_as_elsewhere() -> None:
    case = load(CASES / "moskvich412.yaml")
    assert [mode.name for mode in torsion.modes(case, ["4", "#5"])] == ["4", "1 at stop"]
    with pytest.raises(ValueError, match="no gear '5'"):
        torsion.modes(case, ["5"])
