"""The gearbox of the BelAZ-7516 from teeth: eight gears, and seven pairs that are none.

Source: Evseenko, Method of synthesis of planetary gearboxes with any number of degrees of
freedom (in Russian), figure 1 and tables 1 and 2, gives the structure: which element of which
set is on which link, and the controls. It has no teeth. They are a choice from tables of
simple sets for an invented target 4.00, 2.01, -5.12, 1.4925 for F1T3, F1T2, F1T4, T1F2.

Two of two clutches F1, F2 and four brakes T1 to T4 are engaged. K = -z_ring/z_sun of a set.
"""

from collections.abc import Mapping
from fractions import Fraction
from itertools import combinations
from typing import Any

import numpy as np
import pytest

from tests.core.elements.element_cases import (
    gear_names,
    has_the_speeds_of_single_meshes,
    link_speeds,
    ratios,
    reading,
    solved,
    torque,
)
from tests.oracle.single_meshes import ContradictionError, speeds
from vstatics.core.statics.results import Results

SETS = {
    # sun, ring, carrier; teeth of sun, planet, ring; planets
    "P1": (("J3", "J1", "J2"), (33, 17, 67), 4),
    "P2": (("J2", "J4", "J5"), (33, 17, 67), 4),
    "P3": (("J2", "J5", "J7"), (15, 15, 45), 3),
    "P4": (("J5", "J6", "J7"), (50, 26, 102), 4),
}
CONTROLS = {
    "F1": ["J1", "J2"],
    "F2": ["J2", "J5"],
    "T1": ["J3", "housing"],
    "T2": ["J4", "housing"],
    "T3": ["J5", "housing"],
    "T4": ["J6", "housing"],
}
PAIRS = list(combinations(CONTROLS, 2))
PRECISION = 1e-12

K1 = K2 = Fraction(-67, 33)
K3 = Fraction(-3)
K4 = Fraction(-102, 50)
SPLIT = (K1 - 1) / K1
"""Of set 1 with its sun held by T1, ring in, carrier out; with F1 it is 1."""

GEARS: Mapping[str, tuple[Fraction, Fraction, float]] = {
    # formula in K, the same in p = z_ring/z_sun, its value
    "F1 F2": (Fraction(1), Fraction(1), 1),
    "F1 T3": (1 - K3, 1 + Fraction(45, 15), 4.0),
    "F1 T2": (
        (1 - K2) * (1 - K3) / (1 - K2 - K3),
        Fraction(33 + 67, 33) * 4 / (1 + Fraction(67, 33) + 3),
        2.01005,
    ),
    "F1 T4": (1 - K3 * K4, 1 - 3 * Fraction(102, 50), -5.12),
    "F2 T1": (SPLIT, Fraction(33 + 67, 67), 1.49254),
    "T1 T3": (SPLIT * (1 - K3), Fraction(100, 67) * 4, 5.97015),
    "T1 T2": (
        SPLIT * (1 - K2) * (1 - K3) / (1 - K2 - K3),
        Fraction(100, 67) * Fraction(100, 33) * 4 / (4 + Fraction(67, 33)),
        3.00008,
    ),
    "T1 T4": (SPLIT * (1 - K3 * K4), Fraction(100, 67) * Fraction(-512, 100), -7.64179),
}
"""Section by section the products of a splitter (set 1) and a box of sets 2 to 4."""

BLOCKED = "F1 T1"
STANDING = ("F2 T2", "F2 T3", "F2 T4", "T2 T3", "T2 T4", "T3 T4")


def belaz(**more: Any) -> dict[str, Any]:
    """The gearbox with every pair of controls as a gear."""
    return {
        "name": "BelAZ-7516",
        "links": [f"J{number}" for number in range(1, 8)],
        "elements": {
            name: {
                "kind": "planetary",
                **dict(zip(("sun", "ring", "carrier"), links, strict=True)),
                "teeth": dict(zip(("sun", "planet", "ring"), teeth, strict=True)),
                "planets": planets,
            }
            for name, (links, teeth, planets) in SETS.items()
        },
        "shift_elements": CONTROLS,
        "gears": {" ".join(pair): {"engaged": list(pair)} for pair in PAIRS},
        **more,
    }


@pytest.fixture(scope="module", params=["meshes", "reduced"])
def results(request: pytest.FixtureRequest) -> Results:
    return solved(belaz(losses=request.param))


def test_15_pairs_of_controls_are_8_gears_and_7_that_are_none() -> None:
    found = {*GEARS, BLOCKED, *STANDING}
    assert found == {" ".join(pair) for pair in PAIRS}
    assert (len(GEARS), len(found)) == (8, 15)


def test_the_sets_are_coaxial_and_can_be_assembled() -> None:
    for _, (sun, planet, ring), planets in SETS.values():
        assert sun + 2 * planet == ring
        assert (sun + ring) % planets == 0
    assert not any("assembled" in told.message for told in reading(belaz()).warnings)


def test_seven_links_less_four_sets_leave_three_degrees_of_freedom() -> None:
    case = reading(belaz(losses="reduced")).case
    assert case.links - len(case.mechanisms) == 3


@pytest.mark.parametrize("gear", GEARS)
def test_formulas_in_k_and_in_p_and_single_meshes_agree(gear: str) -> None:
    in_k, in_p, value = GEARS[gear]
    assert in_k == in_p
    assert float(in_k) == pytest.approx(value, rel=0, abs=0.5e-5 + 1e-12)
    assert 1 / speeds(belaz(), gear)["J7"] == in_k


@pytest.mark.parametrize("gear", GEARS)
def test_ratio(results: Results, gear: str) -> None:
    assert ratios(results)[gear] == pytest.approx(float(GEARS[gear][0]), rel=PRECISION)


def test_six_forward_gears_and_two_reverse_ones(results: Results) -> None:
    found = sorted(ratios(results)[gear] for gear in GEARS)
    assert sum(ratio > 0 for ratio in found) == 6
    assert sum(ratio < 0 for ratio in found) == 2


def test_the_target_is_met_within_25_millionths(results: Results) -> None:
    """F1T3 4.00, F1T2 2.01, F1T4 -5.12, T1F2 1.4925."""
    target = {"F1 T3": 4.00, "F1 T2": 2.01, "F1 T4": -5.12, "F2 T1": 1.4925}
    found = ratios(results)
    for gear, ratio in target.items():
        assert found[gear] == pytest.approx(ratio, rel=3e-5)


def test_speeds_of_all_links(results: Results) -> None:
    """Also where the output stands: what turns on is determined, and right."""
    document = belaz()
    del document["gears"][BLOCKED]
    for gear in (*GEARS, *STANDING):
        exact = speeds(document, gear)
        found = link_speeds(results, gear)
        for link in document["links"]:
            if link in exact:
                assert found[link] == pytest.approx(float(exact[link]), rel=PRECISION, abs=1e-12)
            else:
                assert np.isnan(found[link]), (gear, link)


def test_speeds_of_the_gears_alone_are_those_of_single_meshes() -> None:
    document = belaz()
    document["gears"] = {gear: document["gears"][gear] for gear in GEARS}
    has_the_speeds_of_single_meshes(document, solved(document))


@pytest.mark.parametrize("gear", STANDING)
def test_with_these_pairs_the_output_stands_and_the_input_turns(
    results: Results, gear: str
) -> None:
    """Box of sets 2 to 4 locked, with no way for the input to turn it."""
    assert speeds(belaz(), gear)["J7"] == 0
    assert link_speeds(results, gear)["J1"] == 1
    assert link_speeds(results, gear)["J7"] == pytest.approx(0, abs=1e-12)
    assert not np.isfinite(ratios(results)[gear])
    assert not results.tied_up[gear_names(results).index(gear)]


def test_clutch_1_with_brake_1_blocks_the_input(results: Results) -> None:
    """Sun and carrier of set 1 stand, so its ring, the input, stands too."""
    with pytest.raises(ContradictionError):
        speeds(belaz(), BLOCKED)
    tied_up = dict(zip(gear_names(results), results.tied_up.tolist(), strict=True))
    assert tied_up[BLOCKED]
    assert sum(tied_up.values()) == 1


@pytest.mark.parametrize("gear", GEARS)
def test_torques_balance_and_less_than_everything_comes_out(results: Results, gear: str) -> None:
    """Both brakes and the output together take the torque of the input."""
    at = gear_names(results).index(gear)
    brakes = [torque(results, gear, name) for name in gear.split() if name.startswith("T")]
    assert sum(brakes) + results.output_torque[at] == pytest.approx(1, rel=1e-11)
    efficiency = float(results.efficiency[at])
    assert efficiency == pytest.approx(1) if gear == "F1 F2" else 0.9 < efficiency < 1
