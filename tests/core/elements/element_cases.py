"""Random sets of wheels as small cases: every pair of links drives, every other one is held.

A case of one element has a brake on each of its links and a gear for every way to hold
one of them and to drive another one by a third. Then there is a gear for the set turning
as one piece.
"""

from collections.abc import Mapping, Sequence
from itertools import permutations
from typing import Any, NamedTuple

import numpy as np
import pytest
import yaml

import vstatics
from tests.oracle.single_meshes import Document, speeds
from vstatics.core.numerics.traced import plain
from vstatics.core.readers import read
from vstatics.core.readers.reading import Reading
from vstatics.core.statics.results import Results

PRECISION = 1e-12


class Held(NamedTuple):
    """A gear: power goes in and out, a third link stands."""

    held: str
    input: str
    output: str

    @property
    def name(self) -> str:
        """As a gear of a case."""
        return f"{self.input} to {self.output}, {self.held} held"


def all_held(members: Sequence[str]) -> list[Held]:
    return [Held(*three) for three in permutations(members, 3)]


def set_case(element: Document, members: Sequence[str], **more: Any) -> dict[str, Any]:
    """A case of one set `P` with a brake on every link and a clutch on the first two."""
    gears = {
        one.name: {"engaged": [f"brake {one.held}"], "input": one.input, "output": one.output}
        for one in all_held(members)
    }
    direct = {"engaged": ["clutch"], "input": members[0], "output": members[-1]}
    brakes = {f"brake {link}": [link, "housing"] for link in members}
    return {
        "links": list(members),
        "elements": {"P": element},
        "shift_elements": {**brakes, "clutch": list(members[:2])},
        "gears": {**gears, "direct": direct},
        **more,
    }


def pair_case(element: Document, first: str, second: str, **more: Any) -> dict[str, Any]:
    """A case of one pair `G` of wheels on fixed axes, driven from either side."""
    forth, back = {"input": first, "output": second}, {"input": second, "output": first}
    gears = {"forth": forth, "back": back}
    return {"links": [first, second], "elements": {"G": element}, "gears": gears, **more}


def reading(document: Document) -> Reading:
    text = yaml.safe_dump(dict(document), sort_keys=False, allow_unicode=True)
    return read(text.encode(), "case.yaml")


def solved(document: Document) -> Results:
    return vstatics.solve(reading(document).case)


def gear_names(results: Results) -> list[str]:
    return [gear.name for gear in results.case.gears]


def ratios(results: Results) -> dict[str, float]:
    return dict(zip(gear_names(results), results.ratio.tolist(), strict=True))


def efficiencies(results: Results) -> dict[str, float]:
    return dict(zip(gear_names(results), results.efficiency.tolist(), strict=True))


def link_speeds(results: Results, gear: str) -> dict[str, float]:
    state = results.gear(gear_names(results).index(gear) + 1)
    return dict(zip(results.case.link_names, map(plain, state.speeds), strict=True))


def torque(results: Results, gear: str, device: str) -> float:
    """The torque without losses that a shift element or a mechanism takes from its first link."""
    state = results.gear(gear_names(results).index(gear) + 1)
    return plain(state.torques.on_first_link[list(results.case.devices).index(device)])


def has_the_speeds_of_single_meshes(
    document: Document, results: Results, held: Mapping[str, Sequence[str]] | None = None
) -> None:
    """Check every link of every gear, and the planets that are links, against fractions.

    `held` are the freewheels that hold in gears.
    """
    for gear in gear_names(results):
        exact = speeds(document, gear, (held or {}).get(gear, ()))
        found = link_speeds(results, gear)
        assert set(map(str, document.get("links", ()))) <= set(found)
        for link, speed in found.items():
            if link in exact:
                expected = pytest.approx(float(exact[link]), rel=PRECISION, abs=PRECISION)
                assert speed == expected, (gear, link)
            elif link in document.get("links", ()):
                assert np.isnan(speed), (gear, link)


def with_speeds_of_single_meshes(document: Document) -> Results:
    """Solve a case, whose speeds are checked against fractions."""
    results = solved(document)
    has_the_speeds_of_single_meshes(document, results)
    return results
