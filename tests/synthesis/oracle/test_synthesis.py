"""What the program finds against the oracles, on trains that nobody chose."""

import math
import random
from dataclasses import replace
from fractions import Fraction
from itertools import combinations as subsets

import numpy as np
import pytest

from tests.chance import each_seed, seeded
from tests.oracle import schemes
from tests.oracle.combinations import Train, every, found
from tests.oracle.fits import Wish, fits
from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
from vstatics.synthesis.gears.search import combinations
from vstatics.synthesis.ratios.fitting import fit

pytestmark = pytest.mark.slow
SPECIAL = "-2 -2.6 2.5 -1 0.5 -0.5 2 3 -3 1.5 0.4 1.004 1 -2.2 1.0001 0.999 -1e3 -1e-3"
"""Ratios at which groups lock that otherwise turn, and large and small ones."""


def random_case(chance: random.Random) -> Transmission:
    """Up to nine links and five sets; some elements are there twice, some links hang loose."""
    links = chance.randint(3, 9)
    sets = []
    for _ in range(chance.randint(1, 5)):
        places = chance.sample(range(0 if chance.random() < 0.1 else 1, links + 1), 3)
        if chance.random() < 0.15:
            places[2] = 0
        plain = f"{chance.choice((-1, 1)) * chance.uniform(1.2, 5):.3f}"
        ratio = chance.choice(SPECIAL.split()) if chance.random() < 0.3 else plain
        sets.append((places, ratio))
    # every link has something on it
    pairs = [
        (link, chance.choice([n for n in range(links + 1) if n != link]))
        for link in range(1, links + 1)
    ]
    source, sink = chance.sample(range(1, links + 1), 2)
    return Transmission(
        links,
        [ShiftElement(*pair) for pair in pairs],
        [Mechanism(a, b, c, float(ratio)) for (a, b, c), ratio in sets if a and b]
        or [Mechanism(1, 2, 3, -2.0)],
        [Gear([1])],
        input=source,
        output=sink,
    )


@each_seed(40)
def test_kinds_and_ratios_are_those_of_the_null_space(seed: int) -> None:
    chance = seeded(seed)
    case = random_case(chance)
    size = chance.randint(0, min(len(case.shift_elements), 5))
    seen = combinations(case, size)
    train = Train(
        [mechanism.links for mechanism in case.mechanisms],
        [Fraction(repr(mechanism.ratio)) for mechanism in case.mechanisms],
        [element.links for element in case.shift_elements],
        case.input,
        case.output,
    )
    expected = list(every(train, size))
    assert len(seen) == len(expected)
    for one, (_, other) in zip(seen, expected, strict=True):
        assert (one.kind, one.free) == (other.kind, other.free)
        if other.ratio is None:
            assert math.isnan(one.ratio)
        else:
            assert one.ratio == pytest.approx(float(other.ratio), rel=1e-9)


def test_all_elements_of_a_scheme_of_four_sets() -> None:
    """Four of 43 elements: 36 clutches and 7 brakes, 123 410 combinations, some looked at."""
    sets = [(1, 2, 3), (3, 4, 5), (5, 6, 7), (7, 8, 9)]
    ratios = ["-2", "-2.5", "-3", "-1.7"]
    mechanisms = [Mechanism(a, b, c, float(k)) for (a, b, c), k in zip(sets, ratios, strict=True)]
    case = Transmission(9, [ShiftElement(2)], mechanisms, [Gear([1])])
    seen = combinations(case, elements="auto")
    pairs = [*subsets(range(1, 10), 2), *((link, 0) for link in range(2, 9))]
    names = {one for each in seen for one in each.engaged}
    assert (len(seen), len(names)) == (123_410, 43)
    train = Train(sets, [Fraction(k) for k in ratios], pairs, 1, 9)
    places = list(subsets(range(43), 4))
    for at in seeded(0).sample(range(len(seen)), 400):
        expected = found(train, places[at])
        assert (seen[at].kind, seen[at].free) == (expected.kind, expected.free)
        if expected.ratio is not None:
            assert seen[at].ratio == pytest.approx(float(expected.ratio), rel=1e-11)


def fitted_case(chance: random.Random) -> tuple[Transmission, Train]:
    """A sound scheme of three sets as a case, every combination of brakes that is a gear."""
    listed = schemes.fixed(tuple(range(9)))
    codes = listed.codes[listed.is_sound()]
    while True:
        links = [int(link) + 1 for link in codes[chance.randrange(len(codes))]]
        sets = [(links[at], links[at + 2], links[at + 1]) for at in (0, 3, 6)]
        source, sink = chance.sample(range(1, max(links) + 1), 2)
        brakes = [(link, 0) for link in range(1, max(links) + 1) if link not in {source, sink}]
        ratios = [Fraction(chance.randint(-400, -150), 100) for _ in sets]
        train = Train(sets, ratios, brakes, source, sink)
        size = max(links) - 4
        gears = [on for on, one in every(train, size) if one.kind == "gear" and not one.free]
        if len(gears) >= 3:
            break
    case = Transmission(
        max(links),
        [ShiftElement(*pair) for pair in brakes],
        [Mechanism(a, b, c, float(k)) for (a, b, c), k in zip(sets, ratios, strict=True)],
        [Gear([n + 1 for n in on]) for on in gears],
        input=source,
        output=sink,
    )
    return case, train


@each_seed(12)
def test_fitted_ratios_are_as_good_as_those_of_many_slow_starts(seed: int) -> None:
    chance = seeded(seed)
    case, train = fitted_case(chance)
    own = solve(case).ratio.tolist()
    noise = chance.choice([0.0, 0.05])
    names = [gear.name for gear in case.gears[:5]]
    wanted = {
        name: ratio * math.exp(chance.uniform(-noise, noise))
        for name, ratio in zip(names, own, strict=False)
    }
    start = replace(case, mechanisms=[one._replace(ratio=-2.0) for one in case.mechanisms])
    seen = fit(start, wanted, bounds={"all": (-5, -1.4)})
    gears = {gear.name: [n - 1 for n in gear.engaged] for gear in case.gears}
    wish = Wish(train, gears, wanted, [(-5.0, -1.4)] * 3)
    best, *_ = fits(wish, starts=6)
    squares = wish.squares(np.log(np.abs(list(seen.ratios.values()))))
    assert squares <= best.squares * (1 + 1e-6) + 1e-20
    assert all(-5 <= ratio <= -1.4 for ratio in seen.ratios.values())
    if not noise:
        assert seen.residual < 1e-11
