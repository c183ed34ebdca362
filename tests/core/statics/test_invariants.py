"""What holds for any train, by equilibrium and power alone, on random ones."""

from collections.abc import Mapping
from dataclasses import replace
from random import Random
from typing import Any

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.trains import trains
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
