"""A scheduler that is not there: waiting for it disturbs nobody."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.processes import end, names
from tests.sweep.sweeps import CASE_TEXT, begin

pytest.importorskip("distributed")
VARY = ("--vary", "D.ratio=-4:-2:1000")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("address", "words"),
    [
        ("tcp://127.0.0.1:1", "no Dask scheduler answers there"),
        ("nonsense://x", "is not the address of a scheduler, expected tcp://HOST:PORT"),
    ],
)
def test_a_scheduler_that_is_not_there_is_told(address: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "box.yaml").write_text(CASE_TEXT, encoding="utf-8")
    sweep = ("box.yaml", *VARY, "-o", "o.csv", "--scheduler", address)
    status, said = end(begin(*sweep, cwd=tmp_path))
    assert (status, said.startswith(f"{address}: error: {words}")) == (1, True)
    assert len(said.splitlines()) <= 2
    assert names(tmp_path) == ["box.yaml"]
