"""A sweep file is checked."""

from __future__ import annotations

from pathlib import Path

from tests.commands import vstatics


def test_a_sweep_file_is_told_as_one(tmp_path: Path) -> None:
    file = tmp_path / "sweep.yaml"
    file.write_text("{case: box.yaml, vary: {D.ratio: -2:-3:3}}", encoding="utf-8")
    for command in ("check", "run", "explain"):
        said = vstatics(command, file)
        assert (said.status, said.err.count("\n")) == (1, 1)
        assert "this is a sweep file, expected a case; `vstatics sweep --file`" in said.err
    assert "a sweep file by --file" in vstatics("sweep", file).err
