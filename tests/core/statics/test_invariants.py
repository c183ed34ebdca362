"""What holds for any train, by equilibrium and power alone, on random ones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from random import Random
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.trains import is_regular, no_losses, regular_trains, trains
from vstatics import Transmission, solve
from vstatics.core.model.parts import SpeedOf
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers import read
from vstatics.core.statics.result_arrays import ARRAYS
from vstatics.core.writers import deck, named

RANDOM = settings(max_examples=count(8, 48))
CLOSE = {"rtol": 1e-8, "atol": 1e-8}


def same(actual: Floats, expected: Floats, rtol: float = 1e-8, atol: float = 1e-8) -> None:
    np.testing.assert_allclose(actual, expected, rtol=rtol, atol=atol, equal_nan=True)


@RANDOM
@given(regular_trains(gears=2))
def test_output_torque_times_output_speed_is_1_without_losses(case: Transmission) -> None:
    results = solve(case)
    for number, gear in enumerate(case.gears):
        if is_regular(case, gear):
            speed = results.speeds[number, case.gear_output(gear) - 1]
            assert results.output_torque[number] * speed == pytest.approx(1)
            assert results.ratio[number] == pytest.approx(results.output_torque[number])


@RANDOM
@given(trains(gears=2))
def test_with_all_efficiencies_1_losses_change_nothing(case: Transmission) -> None:
    results = solve(no_losses(case))
    there = results.calculable
    same(results.lossy_torques[there], results.torques[there], **CLOSE)
    same(results.lossy_holding_torques[there], results.holding_torques[there], **CLOSE)
    known = results.efficiency[there]
    assert known[~np.isnan(known)] == pytest.approx(1)
    assert not results.locked.any()
    assert not np.nan_to_num(results.losses).any()


@RANDOM
@given(trains(gears=2))
def test_power_is_balanced_and_losses_are_not_negative(case: Transmission) -> None:
    """Coasting turns all flows, so in units of the input torque losses are below 0."""
    results = solve(case)
    there = results.consistent
    size = 1 + np.nan_to_num(np.abs(results.lossy_torques[there])).max(axis=1, initial=0)
    balance = results.power_balance[there] / size
    assert np.nan_to_num(balance) == pytest.approx(0, abs=1e-7)
    losses = np.nan_to_num(results.losses[there]) * (-1 if case.coast else 1)
    assert (losses >= -1e-9 * size[:, None]).all()


@RANDOM
@given(trains(gears=2), st.randoms(use_true_random=False))
def test_renumbering_links_permutes_the_result(case: Transmission, rng: Random) -> None:
    links = list(range(1, case.links + 1))
    rng.shuffle(links)
    new = dict(enumerate(links, 1)) | {0: 0}
    before, after = solve(case), solve(renumbered(case, new))
    assume(not (before.choices > 1).any())  # equal efficiencies may choose either
    order = [new[link] - 1 for link in range(1, case.links + 1)]
    for name in ("speeds", "holding_torques", "lossy_holding_torques"):
        same(getattr(after, name)[:, order], getattr(before, name), **CLOSE)
    for name in ("slip_speeds", "planet_speeds", "torques", "lossy_torques", "efficiency"):
        same(getattr(after, name), getattr(before, name), **CLOSE)
    for name in ("power_sign", "idle", "consistent", "locked", "tied_up", "missing", "excess"):
        np.testing.assert_array_equal(getattr(after, name), getattr(before, name))


def renumbered(case: Transmission, new: Mapping[int, int]) -> Transmission:
    """The same train with other numbers of links."""

    def keys(given: Mapping[int, Any]) -> dict[int, Any]:
        return {
            new[link]: value._replace(link=new[value.link]) if isinstance(value, SpeedOf) else value
            for link, value in given.items()
        }

    return replace(
        case,
        input=new[case.input],
        output=new[case.output],
        link_names=(),
        shift_elements=[
            e._replace(first=new[e.first], second=new[e.second]) for e in case.shift_elements
        ],
        mechanisms=[
            m._replace(first=new[m.first], second=new[m.second], third=new[m.third])
            for m in case.mechanisms
        ],
        gears=[
            g._replace(
                speeds=keys(g.speeds),
                torques=keys(g.torques),
                input=g.input and new[g.input],
                output=g.output and new[g.output],
            )
            for g in case.gears
        ],
    )


@RANDOM
@given(trains(gears=2))
def test_deck_yaml_and_json_of_a_case_give_one_result(case: Transmission) -> None:
    expected = solve(case)
    written = {"yaml": named.write_yaml(case), "json": named.write_json(case)}
    if not any(isinstance(one, SpeedOf) for gear in case.gears for one in gear.speeds.values()):
        written["deck"] = deck.write(case)  # which has no place for speeds of other links
    for form, text in written.items():
        results = solve(read(text.encode(), "", form).case)  # type: ignore[arg-type]
        assert results.messages == expected.messages
        for name in ARRAYS:
            np.testing.assert_array_equal(getattr(results, name), getattr(expected, name))
