"""A gear that cannot drive fails `vstatics check`, unless it is neutral on purpose."""

from __future__ import annotations

import io
from pathlib import Path

import pytest

import vstatics as library
from tests.commands import json_answer, vstatics

CASE = """name: two-speed
links: [in, ring, carrier]
shift_elements: {B: [ring, housing], C: [in, ring]}
mechanisms: {P: {first: in, second: ring, third: carrier, ratio: -2}}
input: in
output: carrier
"""
GEARS = "gears: {low: {engaged: [B]}, direct: {engaged: [C]}, N: {engaged: []%s}}\n"


def written(folder: Path, neutral: str = "", rest: str = "") -> str:
    file = folder / "box.yaml"
    file.write_text(CASE + GEARS % neutral + rest, encoding="utf-8")
    return str(file)


def test_a_gear_that_cannot_drive_fails_the_check_at_its_place(tmp_path: Path) -> None:
    file = written(tmp_path)
    said = vstatics("check", file)
    assert said.status == 1
    assert (
        f"{file}:7:{1 + GEARS.index('N:')}: error: gears.N: cannot drive: expected another engaged"
        in said.err
    )
    assert [problem["id"] for problem in json_answer("check", file)] == ["E453", "W414"]
    assert vstatics("run", file).status == 0
    assert vstatics("summary", file).status == 0
    assert vstatics("flow", file).status == 0


@pytest.mark.parametrize(
    ("neutral", "rest", "options"),
    [
        (", kind: neutral", "", ()),
        ("", "allow: [W414]\n", ()),
        ("", "", ("--allow", "W414")),
        (", kind: neutral", "load: {speed: 2000 rpm, torque: 90 N*m}\n", ()),
    ],
)
def test_a_neutral_gear_that_is_meant_passes_also_strictly(
    tmp_path: Path, neutral: str, rest: str, options: tuple[str, ...]
) -> None:
    said = vstatics("check", written(tmp_path, neutral, rest), "--strict", *options)
    assert (said.status, said.err) == (0, "")


def test_a_gear_marked_as_neutral_that_drives_gets_a_warning(tmp_path: Path) -> None:
    """With C the set rotates as a block, so the ratio is 1."""
    file = written(tmp_path, ", kind: neutral")
    text = Path(file).read_text("utf-8").replace("N: {engaged: []", "N: {engaged: [C]")
    Path(file).write_text(text, encoding="utf-8")
    said = vstatics("check", file)
    assert said.status == 0
    assert "gear N: marked `kind: neutral`, but drives with the ratio 1" in said.err


def test_a_neutral_gear_is_not_part_of_steps_and_spread(tmp_path: Path) -> None:
    """With the ring held, the Willis equation gives w_in = (1 - ratio)*w_carrier = 3 w_carrier."""
    with_neutral = json_answer("summary", written(tmp_path, ", kind: neutral"))
    without = json_answer("summary", written(tmp_path))
    assert with_neutral["spread"] == without["spread"]
    assert [gear["ratio"] for gear in with_neutral["gears"]] == [pytest.approx(3), 1, None]


def test_python_reports_the_same_error() -> None:
    problems = library.check(io.StringIO(CASE + GEARS % ""))
    assert "E453" in [problem.id for problem in problems]
    assert library.check(io.StringIO(CASE + GEARS % ", kind: neutral")) == []


def test_a_case_without_gears_that_only_moves_is_no_fault() -> None:
    text = CASE + "inertias: {in: 0.1, ring: 0.1, carrier: 1}\n"
    assert [problem.id for problem in library.check(io.StringIO(text))] == ["N420"]
