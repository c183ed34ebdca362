"""Drag of every form acts in the torques and is reported: the numbers of every format close.

The expected power ``sum(c(w) w)`` is from `tests.dragging`, which shares nothing with the program.
"""

import json
import math
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from tests.chance import count, seeded, with_slow
from tests.commands import vstatics
from tests.dragging import random_case
from vstatics import Transmission, loads, solve


class Sums(NamedTuple):
    """Powers that a format prints for a gear [kW], and what their last digits leave open."""

    entering: float
    leaving: float
    meshes: float
    drag: float
    slack: float = 0.0


def figure(text: str) -> tuple[float, float]:
    """A printed number, and half of its last digit; NaN where none is printed."""
    if not re.fullmatch(r"-?(\d+\.?\d*|\.\d+)", text):
        return math.nan, 0.0
    return float(text), 0.5 * 10.0 ** -len(text.partition(".")[2])


def ports_of_text(text: str, gears: list[str]) -> dict[str, Sums]:
    """By gear: the sums of a table of ports, printed for people."""
    found: dict[str, dict[str, float]] = {}
    gear = ""
    _, table = re.split(r"^ *gear +port .*power, kW.*\n", text, maxsplit=1, flags=re.MULTILINE)
    for line in table.splitlines():
        if not (words := line.split()):
            break
        if set(line.strip()) <= {"─"}:
            continue
        if words[0] in gears:
            gear = words.pop(0)
        own = found.setdefault(gear, dict.fromkeys(("in", "out", "meshes", "drag", "slack"), 0.0))
        if words[0] == "lost:":
            key, text_of_power = words[1] if len(words) == 3 else "", words[-1]
        else:
            key = words[-1] if words[-1] in ("in", "out") else ""
            text_of_power = words[-2] if key else words[-1]
        power, half = figure(text_of_power)
        if key:
            own[key] += power
            own["slack"] += half
        elif words[0] != "lost:":  # a port without a way passes nothing, as printed
            assert not power > half
            own["slack"] += half
    return {
        gear: Sums(one["in"], one["out"], one["meshes"], one["drag"], one["slack"])
        for gear, one in found.items()
    }


def of_summary(text: str, gears: list[str]) -> dict[str, Sums]:
    """By gear: the ports in the JSON of `summary`."""
    found = {}
    for table in json.loads(text)["ports"]:
        power = {
            way: math.fsum(_number(p["power_kW"]) for p in table["ports"] if p["way"] == way)
            for way in ("in", "out")
        }
        lost = {one["in"]: _number(one["power_kW"]) for one in table["lost"]}
        found[table["gear"]] = Sums(power["in"], power["out"], lost["meshes"], lost["drag"])
    assert [*found] == gears
    return found


def _number(value: float | None) -> float:
    return math.nan if value is None else value


def of_json(text: str, gears: list[str]) -> dict[str, Sums]:
    """By gear: what `run -f json` says."""
    data = json.loads(text)
    keys = "input_power_kW", "output_power_kW", "drag_losses_kW"
    entering, leaving, drag = ([_number(one) for one in data[key]] for key in keys)
    meshes = [math.fsum(map(_number, column)) for column in zip(*data["losses_kW"], strict=True)]
    rows = gears, entering, leaving, meshes, drag
    return {gear: Sums(*row) for gear, *row in zip(*rows, strict=True)}


def of_listing(text: str, gears: list[str]) -> dict[str, Sums]:
    """By gear: what the listing says."""
    columns = {}
    for key in ("PINKW", "POUTKW", "LOSSKW", "DRAGKW"):
        block = re.search(rf"^\(?{key}\(.*\n((?:[ \d.*-]+\n)+)", text, re.MULTILINE)
        assert block, key
        rows = [[figure(one) for one in line.split()] for line in block[1].splitlines()]
        columns[key] = [
            (math.fsum(one for one, _ in column), math.fsum(half for _, half in column))
            for column in zip(*rows, strict=True)
        ]
    found = {}
    for gear, *numbers in zip(gears, *columns.values(), strict=True):
        slack = math.fsum(half for _, half in numbers)
        entering, leaving, meshes, drag = (one for one, _ in numbers)
        found[gear] = Sums(entering, leaving, meshes, drag, slack)
    return found


FORMATS: tuple[tuple[str, Callable[[str, list[str]], dict[str, Sums]]], ...] = (
    ("run --pretty", ports_of_text),
    ("summary", ports_of_text),
    ("summary -f json", of_summary),
    ("run -f json", of_json),
    ("run --digits 9", of_listing),
    ("run", of_listing),
)


def of_python(case: Transmission) -> dict[str, Sums]:
    """By gear: the arrays of `solve`."""
    found = solve(case)
    arrays = found.input_power_kW, found.output_power_kW, found.losses_kW.sum(axis=-1)
    rows = zip(*arrays, found.drag_losses_kW, strict=True)
    return {gear.name: Sums(*map(float, row)) for gear, row in zip(case.gears, rows, strict=True)}


@pytest.mark.parametrize(
    "seeds", with_slow([range(1, 2), range(2, 4)], [[0, *range(4, count(300, 3000))]])
)
def test_the_powers_of_every_format_close_and_the_drag_is_that_of_its_laws(
    seeds: Sequence[int], tmp_path: Path
) -> None:
    known, dragged = 0, 0
    for seed in seeds:
        folder = tmp_path / str(seed)
        folder.mkdir()
        given = random_case(seeded(seed), folder)
        gears = [gear.name for gear in given.case.gears]
        drags = any(solve(given.case).dragged)
        by_format = {"python": of_python(given.case)}
        if given.case.has_drag:
            by_format |= {
                command: read(vstatics(*command.split(), given.file).out, gears)
                for command, read in FORMATS
            }
        for form, sums in by_format.items():
            for gear, lost in given.lost_kw.items():
                one = sums[gear]
                if any(map(math.isnan, one)):
                    continue
                size = 1e-11 * (1 + one.entering)
                slack = one.slack + size
                left = one.entering - one.leaving - one.meshes - one.drag
                assert abs(left) <= slack, (seed, form, gear, one)
                assert abs(one.drag - lost) <= slack, (seed, form, gear, one, lost)
                known += 1
                dragged += drags
    assert known > len(seeds)
    assert dragged


def test_drag_that_only_some_variants_have_is_in_tables_of_variants() -> None:
    """A pair 2:1 at 1000 rpm: 4 N*m at 52.36 rad/s are 0.20944 kW."""
    case = loads(
        "links: [a, b]\nload: {speed: 1000 rpm, torque: 100 N*m}\n"
        "mechanisms: {g: {first: a, second: b, ratio: 2}}\ngears: {'1': []}"
    )
    found = solve(case, vary={"drag.b": [0, 4]})
    lost = [0, 4 * math.pi * 1000 / 60 / 1000]
    assert found.to_dataframe()["drag_losses_kW", ""].tolist() == pytest.approx(lost)
    assert found.to_xarray()["drag_losses_kW"].values.ravel() == pytest.approx(np.array(lost))
