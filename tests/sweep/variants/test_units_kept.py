"""A written case with units is swept as it was."""

from __future__ import annotations

import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from tests.commands import CASES, SHIPPED
from tests.core.writers.test_units_kept import again, with_load
from vstatics import Transmission, load, sweep

LOADED = [
    path
    for path in SHIPPED
    if path.suffix == ".yaml" and "load" in yaml.safe_load(path.read_text(encoding="utf-8"))
]


QUICK = ("gm-8l90.yaml", "moskvich412.yaml")


def with_units(data: dict[str, Any], chance: random.Random) -> dict[str, Any]:
    """A case with all keys that take N*m, here and there."""

    def torque() -> str:
        return f"{chance.uniform(1, 30):.6g} N*m"

    case = load(CASES / data.pop("file"))
    links = [*case.link_names[: case.own_links]]
    data["drag"] = {link: torque() for link in chance.sample(links, 2)}
    for name, element in data.get("shift_elements", {}).items():
        own = element if isinstance(element, dict) else {"links": element}
        more = {"capacity": f"{chance.uniform(500, 5000):.6g} N*m"}
        if "kind" not in own and chance.random() < 0.5:
            more["drag"] = torque()
        data["shift_elements"][name] = own | more
    for name, gear in data["gears"].items():
        given = gear if isinstance(gear, dict) else {"engaged": gear}
        drag = {"drag": {chance.choice(links): torque()}} if chance.random() < 0.5 else {}
        data["gears"][name] = given | drag
    return data


def swept(case: Transmission) -> np.ndarray[Any, Any]:
    """Efficiencies over the torque of the load."""
    torques = {"load.torque": [20.0, 150.0, 777.0]}
    return np.vstack([chunk.columns for chunk in sweep(case, torques, out="efficiency")])


@pytest.mark.parametrize(
    "path",
    [
        pytest.param(path, id=path.name, marks=[pytest.mark.slow] * (path.name not in QUICK))
        for path in LOADED
    ],
)
def test_a_shipped_case_with_units_everywhere_is_swept_alike(path: Path, tmp_path: Path) -> None:
    chance = random.Random(path.name)  # noqa: S311
    data = yaml.safe_load(path.read_text(encoding="utf-8"))
    case = Transmission.from_dict(with_units(data | {"file": path.name}, chance))
    made = again(case, tmp_path, chance.choice([".yaml", ".json", ".xlsx"]))
    assert made == case
    assert with_load(made, 33.0) == with_load(case, 33.0)
    np.testing.assert_array_equal(swept(made), swept(case))
