"""The state of a gear: one object that holds what `Results` hold, and powers that close."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import vstatics
from tests.commands import CASES
from tests.core.elements.element_texts import shown
from vstatics import solve
from vstatics.core.numerics.traced import plain


def test_a_member_alone_with_the_load_carries_it() -> None:
    """Two clutches make one piece: they share a torque, but the load is all on one member."""
    for output, other, losses in (
        ("carrier", "ring", "meshes"),
        ("ring", "carrier", "meshes"),
        ("ring", "carrier", "reduced"),
    ):
        found = shown(f"""
links: [a, b, carrier, ring]
output: {output}
losses: {losses}
elements:
  R:
    {{kind: ravigneaux, small_sun: a, large_sun: b, ring: ring, carrier: carrier,
     teeth: {{small_sun: 30, large_sun: 36, ring: 84, short: 22, long: 24}}}}
shift_elements: {{C1: [a, {other}], C2: [b, {other}]}}
gears: {{1: {{engaged: [C1, C2]}}}}
""")
        for name in ("torques", "lossy_torques"):
            torques = dict(zip(found[name].rows, found[name].values[:, 0].tolist(), strict=True))
            assert torques[f"R.{output}"] == pytest.approx(-1, abs=1e-14)
            assert np.isnan([torques["C1"], torques["R.small_sun"]]).all()


@pytest.mark.slow
@pytest.mark.parametrize("path", sorted(CASES.glob("*.yaml")), ids=lambda path: path.stem)
def test_the_state_of_a_gear_is_what_the_arrays_say(path: Path) -> None:
    for results in (solve(vstatics.load(path), coast=coast) for coast in (False, True)):
        case = results.case
        for index in range(len(case.gears)):
            state = results.gear(index + 1)
            names = ("ratio", "tied_up", "conflict", "balanced", "consistent")
            found: dict[str, Any] = {name: [getattr(state, name)] for name in names}
            found |= {
                "speeds": state.speeds[: case.own_links],
                "slip_speeds": state.slip_speeds,
                "power_sign": state.signs,
                "efficiency": [state.search.lossy.efficiency],
                "locked": [state.search.locked],
                "holds": [n in state.engaged for n in range(1, len(case.shift_elements) + 1)],
            }
            if case.drawing is None:
                found["torques"] = state.torques.on_first_link
                found["lossy_torques"] = state.lossy_torques.on_first_link
                found["losses"] = state.mechanism_losses
            for name, values in found.items():
                expected = np.ravel(getattr(results, name)[index]).astype(float)
                got = np.array([plain(one) for one in values], float)
                assert got == pytest.approx(expected, nan_ok=True), name
            assert state.calculable == results.calculable[index]
            assert state.status == results.status(index + 1)
