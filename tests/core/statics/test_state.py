"""The state of a gear: one object that holds what `Results` hold, and powers that close."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import vstatics
from tests.commands import CASES
from tests.core.elements.element_texts import SET, shown
from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
from vstatics.core.numerics.traced import plain


def test_member_torques_of_a_plain_set() -> None:
    """Ring held: sun 1, ring 75/30, carrier what both leave; with losses the ring has less."""
    ideal, lossy = shown(SET)["torques"], shown(SET)["lossy_torques"]
    assert list(ideal.rows) == ["B", "C", "P1.sun", "P1.ring", "P1.carrier", "Mx"]
    assert ideal.values[2:, 0] == pytest.approx([1, 2.5, -3.5, 3.5])
    held = 2.5 * 0.98 * 0.99
    assert lossy.values[2:, 0] == pytest.approx([1, held, -1 - held, 1 + held])


def test_a_member_alone_with_the_load_carries_it() -> None:
    """Two clutches make one piece: they share a torque, but the load is all on one member."""
    for output, clutches, losses, member in (
        ("carrier", "C1: [a, ring], C2: [b, ring]", "meshes", "R.carrier"),
        ("ring", "C1: [a, carrier], C2: [b, carrier]", "meshes", "R.ring"),
        ("ring", "C1: [a, carrier], C2: [b, carrier]", "reduced", "R.ring"),
    ):
        found = shown(f"""
links: [a, b, carrier, ring]
output: {output}
losses: {losses}
elements:
  R:
    {{kind: ravigneaux, small_sun: a, large_sun: b, ring: ring, carrier: carrier,
     teeth: {{small_sun: 30, large_sun: 36, ring: 84, short: 22, long: 24}}}}
shift_elements: {{{clutches}}}
gears: {{1: {{engaged: [C1, C2]}}}}
""")
        for name in ("torques", "lossy_torques"):
            torques = dict(zip(found[name].rows, found[name].values[:, 0].tolist(), strict=True))
            assert torques[member] == pytest.approx(-1, abs=1e-14)
            assert np.isnan(torques["C1"])
            assert np.isnan(torques["R.small_sun"])


@pytest.mark.slow
@pytest.mark.parametrize("coast", [False, True])
@pytest.mark.parametrize("path", sorted(CASES.glob("*.yaml")), ids=lambda path: path.stem)
def test_the_state_of_a_gear_is_what_the_arrays_say(path: Path, coast: bool) -> None:
    results = solve(vstatics.load(path), coast=coast)
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
            assert np.array([plain(one) for one in values], float) == pytest.approx(
                expected, nan_ok=True
            ), name
        assert state.calculable == results.calculable[index]
        assert state.status == results.status(index + 1)


def test_engaged_are_the_elements_of_the_gear_and_the_freewheels_that_hold() -> None:
    """Ring braked by a freewheel: it holds in low and overruns in direct drive at 1."""
    held = ShiftElement(2, 0, "F", "freewheel"), ShiftElement(1, 2, "C")
    case = Transmission(3, held, [Mechanism(1, 2, 3, -2.0, 0.97)], [Gear(), Gear([2])])
    low, direct = (solve(case).gear(number) for number in (1, 2))
    assert (list(low.engaged), low.holding) == ([1], [1])
    assert (list(direct.engaged), direct.holding) == ([2], [])
    assert low.ratio == pytest.approx(3)
    assert direct.slip_speeds == pytest.approx([1, 0])
