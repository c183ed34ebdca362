"""Mechanisms of ratio 1 with three links: the first turns as the second, the third takes losses.

Ferguson's paradox: three wheels mesh with one thick planet, and the first of them stands.
With the arm at 1 a wheel of z teeth beside a fixed one of 100 turns by 1 - 100/z.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.chance import count, generator, seeded
from tests.core.statics.batches import disagreements, ratios
from tests.core.statics.test_against_oracle import _disagreements
from tests.trains import random_train, shown
from vstatics import Gear, Mechanism, Results, ShiftElement, Transmission, solve
from vstatics.core.elements.checks import hints
from vstatics.core.elements.drawing import drawing_of
from vstatics.core.readers.deck.reader import read as read_deck
from vstatics.core.readers.named.reader import read_yaml
from vstatics.core.writers import deck

FERGUSON = """\
links: [arm, first, w99, w100, w101]
elements:
  set:
    kind: planet_group
    carrier: arm
    rims: {planet: {thick: 20}}
    suns:
      - {link: first, teeth: 100, rim: thick}
      - {link: w99, teeth: 99, rim: thick}
      - {link: w100, teeth: 100, rim: thick}
      - {link: w101, teeth: 101, rim: thick}
shift_elements: {B: [first, housing]}
gears:
  low: {engaged: [B]}
"""


def ferguson(text: str = FERGUSON) -> Transmission:
    return read_yaml(text.encode(), "ferguson.yaml").case


@pytest.mark.parametrize("losses", ["meshes", "reduced"])
def test_fergusons_paradox_from_its_teeth(losses: str) -> None:
    results = solve(ferguson(f"losses: {losses}\n{FERGUSON}"))
    expected = [1, 0, 1 - 100 / 99, 0, 1 - 100 / 101]
    assert results.speeds[0] == pytest.approx(expected, abs=1e-15)
    assert results.speeds[0, 3] == 0
    assert results.ratio == pytest.approx([101])


def test_fergusons_paradox_as_three_mechanisms() -> None:
    """Each from the wheel that stands; that of 100 teeth holds its wheel."""
    wheels = [Mechanism(0, 2 + n, 1, z / 100, 0.98) for n, z in enumerate((99, 100, 101))]
    results = solve(Transmission(4, [], wheels, [Gear(output=2), Gear(output=3), Gear()]))
    expected = [1, 1 - 100 / 99, 0, 1 - 100 / 101]
    assert results.speeds == pytest.approx(np.array([expected] * 3), abs=1e-15)
    assert results.speeds[1, 2] == 0
    assert results.status(2).name == "output stands"
    said = [message for message in results.messages if "D2.ratio" in message.text]
    assert [message.severity for message in said] == ["note"]


def test_wheels_that_turn_alike_get_a_note() -> None:
    drawing = drawing_of(ferguson())
    assert drawing is not None
    alike = [one for one in hints(drawing) if "always turn at the same speed" in one.message]
    assert [one.severity for one in alike] == ["note"]
    assert alike[0].message.startswith(
        "first and w100 always turn at the same speed (ratio 1): the carrier"
    )


def through_the_wheels(gear: Gear, *, coast: bool = False) -> Results:
    """Two equal wheels on one planet, from one to the other; a brake on the carrier."""
    mechanism = Mechanism(1, 3, 2, 1.0, 0.96)
    return solve(Transmission(3, [ShiftElement(2)], [mechanism], [gear], coast=coast))


@pytest.mark.parametrize("coast", [False, True])
def test_the_third_link_takes_torque_by_losses_only(coast: bool) -> None:
    """Of it u eta^x - 1 = eta^x - 1 for 1 on the first link; the brake balances it."""
    results = through_the_wheels(Gear([1]), coast=coast)
    lossy = 0.96 ** (-1 if coast else 1)
    assert results.ratio == pytest.approx([1])
    assert results.torques[0] == pytest.approx([0, 1, 1])
    assert results.lossy_torques[0] == pytest.approx([1 - lossy, 1, lossy])
    assert results.efficiency == pytest.approx([0.96])
    assert results.power_balance == pytest.approx([0], abs=1e-15)


def test_the_speed_of_the_third_link_changes_losses_only() -> None:
    """With the planets at rest against the wheels nothing is lost, in between a part."""
    for speed in (0.0, 0.25, 1.0, 2.0):
        results = through_the_wheels(Gear(speeds={2: speed}))
        assert results.ratio == pytest.approx([1])
        x = np.sign(1 - speed)
        assert results.lossy_torques[0, 1:] == pytest.approx([1, 0.96**x])
        assert results.lossy_holding_torques[0, 1] == pytest.approx(0.96**x - 1)
        assert results.losses[0, 0] == pytest.approx((1 - speed) * (1 - 0.96**x))


def test_a_third_link_that_nothing_holds_leaves_the_losses_open() -> None:
    results = through_the_wheels(Gear())
    assert results.ratio == pytest.approx([1])
    assert results.torques[0] == pytest.approx([0, 1, 1])
    assert np.isnan([results.speeds[0, 1], results.efficiency[0]]).all()
    assert not results.locked[0]


def test_a_deck_may_have_it() -> None:
    case = through_the_wheels(Gear([1])).case
    assert read_deck(deck.write(case).encode(), "").case.mechanisms == case.mechanisms


def with_ones(seed: int) -> Transmission:
    """A random train with losses everywhere, many of whose ratios are 1."""
    rng = seeded(seed)
    case = random_train(rng, regular=seed % 3 == 0)
    part = rng.choice((0.3, 0.6, 1.0))
    return replace(
        case,
        mechanisms=[
            one._replace(
                ratio=1.0 if rng.random() < part else one.ratio,
                efficiency=min(one.efficiency, 0.99),
            )
            for one in case.mechanisms
        ],
    )


@pytest.mark.parametrize(
    "seeds", [range(30), pytest.param(range(30, count(110, 400)), marks=pytest.mark.slow)]
)
def test_every_number_is_that_of_exact_arithmetic(seeds: range) -> None:
    for seed in seeds:
        case = with_ones(seed)
        assert _disagreements(case) == [], (seed, shown(case))


@pytest.mark.parametrize(
    "seeds", [range(5), pytest.param(range(5, count(20, 60)), marks=pytest.mark.slow)]
)
def test_variants_go_through_1_as_they_go_alone(seeds: range) -> None:
    for seed in seeds:
        case, rng = with_ones(seed), generator(seed)
        u = ratios(rng, case, 24, "short decimals" if seed % 2 else "other signs")
        u[rng.random(u.shape) < 0.2] = 1.0
        assert not disagreements(case, u, None, range(6)), seed
