"""A case that is written keeps each drag and efficiency in its place: the case, a part or a gear.

So a gear that is added to the file afterwards has the drag that it has in the file that was read.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from tests.chance import ranges_with_slow, seeded
from tests.commands import vstatics
from tests.core.statics.batches import ARRAYS
from tests.dragging import random_case
from vstatics import load, loads, solve
from vstatics.core.statics.results import Results

PLACED = ("drag", "open_drag", "efficiency", "back_efficiency")


def places(data: Mapping[str, Any]) -> set[tuple[str, ...]]:
    """Paths of all drags and efficiencies of a document, down to their links and elements."""
    found: set[tuple[str, ...]] = set()
    for key, value in data.items():
        if key in ("drag", "open_drag"):
            owners = value if isinstance(value, dict) and "file" not in value else {"": None}
            found |= {(key, str(owner)) for owner in owners}
        elif key in PLACED and value != 1:
            found.add((key,))
        elif isinstance(value, Mapping):
            found |= {(str(key), *path) for path in places(value)}
    return found


def with_twin(data: dict[str, Any]) -> dict[str, Any]:
    """The document with a gear more, which engages what the first gear engages and no more."""
    first = next(iter(data["gears"].values()))
    engaged = first.get("engaged", []) if isinstance(first, dict) else first
    ends = {key: first[key] for key in ("input", "output", "speeds", "torques") if key in first}
    return {**data, "gears": {**data["gears"], "twin": {"engaged": engaged, **ends}}}


def assert_solved_as(expected: Results, path: Path) -> None:
    """Check that a case has the expected results, to the last bit.

    The power balance is an exception: it is the rounding error of a sum in the order of the drags.
    """
    found = solve(load(path))
    balance = expected.power_balance
    np.testing.assert_allclose(balance, found.power_balance, atol=1e-12, equal_nan=True)
    for name in {*ARRAYS} - {"power_balance"}:
        np.testing.assert_array_equal(getattr(expected, name), getattr(found, name), err_msg=name)


@ranges_with_slow(2, 150, 1500)
def test_each_drag_and_efficiency_keeps_its_place(seeds: range, tmp_path: Path) -> None:
    for seed in seeds:
        folder = tmp_path / str(seed)
        folder.mkdir()
        case = random_case(seeded(seed), folder).file
        data = yaml.safe_load(case.read_text("utf-8"))
        twin = folder / "twin.yaml"
        twin.write_text(yaml.safe_dump(with_twin(data), sort_keys=False), "utf-8")
        original, results = load(case), solve(load(twin))
        sheet, made = folder / "made.xlsx", {}
        for target in (folder / "made.yaml", folder / "made.json", sheet):
            assert vstatics("convert", case, target).status == 0
        assert vstatics("convert", sheet, folder / "sheet.yaml").status == 0
        for path in (folder / "made.yaml", folder / "made.json", folder / "sheet.yaml"):
            text = path.read_text("utf-8")
            made = json.loads(text) if path.suffix == ".json" else yaml.safe_load(text)
            assert places(made) == places(data), (seed, path)
            assert load(path) == original
            path.write_text(json.dumps(with_twin(made)), "utf-8")
            assert_solved_as(results, path)


def test_a_drag_of_the_case_follows_the_load_of_each_gear() -> None:
    """2 N*m at b are 1 % of 200 N*m there, and 4 % of 50: the load of the second gear is 25."""
    case = loads("""\
links: [a, b]
load: {speed: 1000 rpm, torque: 100 N*m}
drag: {b: 2 N*m}
mechanisms: {g: {first: a, second: b, ratio: 2}}
gears: {"1": [], "2": {load: {torque: 25 N*m}}}
""")
    np.testing.assert_allclose(solve(case).efficiency, [0.99, 0.96])
