"""Pictures of a sweep from Python: to the byte those of the command, from what it has written."""

from __future__ import annotations

from pathlib import Path

import pytest

import vstatics
from tests import commands
from tests.sweep.sweeps import DIFFERENTIAL

pytest.importorskip("matplotlib")
GRID = ["D.ratio=-4:-2:5", "D.efficiency=.9,.95,1"]
OUT = "ratio[low],efficiency[low]"


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(
    ("kind", "columns"),
    [
        ("map", {"z": "efficiency[low]"}),
        ("curves", {"x": "D.ratio", "y": "efficiency[low]", "by": "D.efficiency"}),
        ("histogram", {"y": "ratio[low]"}),
    ],
)
def test_it_is_the_picture_of_the_command(
    kind: str,
    columns: dict[str, str],
) -> None:
    vstatics.save(DIFFERENTIAL, "box.yaml")
    varied = [part for one in GRID for part in ("--vary", one)]
    assert (
        commands.vstatics("sweep", "box.yaml", *varied, "--out", OUT, "-o", "own.csv").status == 0
    )
    asked = [part for name, column in columns.items() for part in (f"--{name}", column)]
    assert commands.vstatics("plot", "own.csv", "-k", kind, *asked, "-o", "told.svg").status == 0
    picture = vstatics.sweep(DIFFERENTIAL, GRID, out=OUT).plot(kind, **columns)
    picture.save("own.svg")
    assert Path("own.svg").read_bytes() == Path("told.svg").read_bytes()
    assert picture._repr_svg_().startswith("<?xml")
    assert picture.figure.axes or picture.figure.texts
    assert repr(picture) == f"<SweepPicture {kind} of 15 rows>"


def test_another_kind_and_another_column_are_told() -> None:
    with pytest.raises(ValueError, match="no picture 'mpa' of a sweep; did you mean `map`"):
        vstatics.sweep(DIFFERENTIAL, GRID, out=OUT).plot("mpa")
    with pytest.raises(vstatics.CaseError, match=r"no column `efficiency\[1\]`"):
        vstatics.sweep(DIFFERENTIAL, GRID, out=OUT).plot("map", z="efficiency[1]")._repr_svg_()
