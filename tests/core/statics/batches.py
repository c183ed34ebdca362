"""Arrays of variants for any train, and their results beside those of each variant alone."""

from collections import OrderedDict
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from copy import copy
from dataclasses import replace
from random import Random
from typing import Any

import numpy as np

from tests import trains
from tests.chance import generator, seeded
from tests.trains import random_train
from vstatics import Gear, Mechanism, Results, ShiftElement, Transmission, solve
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics import result_arrays
from vstatics.core.statics import variants as solver

Array = np.ndarray[Any, Any]

ARRAYS = [*result_arrays.ARRAYS]


def ratios(rng: np.random.Generator, case: Transmission, count: int, kind: str) -> Floats:
    """Ratios of a kind, shape (count, mechanisms); a ratio of 1 mostly stays."""
    own = np.array([mechanism.ratio for mechanism in case.mechanisms])
    with np.errstate(over="ignore"):
        u = np.clip(RATIOS[kind](rng, np.tile(own, (count, 1))), -1e308, 1e308)
    u = np.where((own == 1) & (rng.random(own.size) < 0.7), own, u)
    return np.where(u == 0, 0.5, u)


def _signs(rng: np.random.Generator, own: Floats) -> Floats:
    found: Floats = rng.choice([-1.0, 1.0], own.shape)
    return found


def _in_pairs(rng: np.random.Generator, own: Floats) -> Floats:
    """All the same in a variant, or one by it, or the case's own."""
    u = np.round(rng.uniform(-3, 3, (len(own), 1)), 1) * np.ones(own.shape)
    u = np.where(rng.random(own.shape) < 0.5, u, 1 / np.where(u == 0, 1, u))
    return np.where(rng.random(own.shape) < 0.2, own, u)


def _line(rng: np.random.Generator, own: Floats) -> Floats:
    u = own.copy()
    u[:, rng.integers(own.shape[1])] = np.linspace(-3, 3, len(own))
    return u


EXTREMES = [-320.0, -308.0, -150.0, -12.0, 0.0, 12.0, 150.0, 308.0]
COINCIDENCES = [0.5, 1, 2, -1, 1 + 1e-14, 1 - 1e-13, 1 + 1e-9]
RATIOS: dict[str, Callable[[np.random.Generator, Floats], Floats]] = {
    "the same": lambda _, own: own,
    "ordinary": lambda rng, own: own * rng.uniform(0.95, 1.05, own.shape),
    "other signs": lambda rng, own: own * rng.uniform(-1.5, 1.5, own.shape),
    "short decimals": lambda rng, own: np.round(rng.uniform(-3, 3, own.shape), 1),
    "nearly the same": lambda rng, own: (
        own * (1 + _signs(rng, own) * 10.0 ** rng.uniform(-16, -1, own.shape))
    ),
    "near 1": lambda rng, own: 1 + _signs(rng, own) * 10.0 ** -rng.integers(1, 17, own.shape),
    "powers of ten": lambda rng, own: _signs(rng, own) * 10.0 ** rng.integers(-12, 13, own.shape),
    "extreme": lambda rng, own: _signs(rng, own) * 10.0 ** rng.choice(EXTREMES, own.shape),
    "in pairs": _in_pairs,
    "coincidences": lambda rng, own: own * rng.choice(COINCIDENCES, own.shape),
    "wide": lambda rng, own: own * np.exp(rng.normal(0, 3, own.shape)),
    "a line": _line,
}
KINDS = tuple(RATIOS)
LOSSES = ("own", "any", "some 1", "nearly 1", "tiny")
"""Kinds of efficiencies."""


def efficiencies(
    rng: np.random.Generator, case: Transmission, count: int, kind: str
) -> Floats | None:
    """Efficiencies of a kind, shape (count, mechanisms), or None for the case's own."""
    own = np.array([mechanism.efficiency for mechanism in case.mechanisms])
    size = count, own.size
    if kind == "own":
        return None
    if kind == "any":
        return rng.uniform(0.8, 1, size)
    if kind == "some 1":
        return np.where(rng.random(size) < 0.5, rng.uniform(0.3, 1, size), 1.0)
    if kind == "nearly 1":
        return np.where(rng.random(size) < 0.7, own, 1 - 10.0 ** -rng.integers(1, 18, size))
    tiny: Floats = 10.0 ** rng.choice([-320.0, -100, -12, -1, -0.01, 0], size)
    return tiny


def with_numbers(case: Transmission, u: Floats | None, eta: Floats | None) -> Transmission:
    mechanisms = list(case.mechanisms)
    for name, given in (("ratio", u), ("efficiency", eta)):
        if given is not None:
            mechanisms = [
                mechanism._replace(**{name: number})
                for mechanism, number in zip(mechanisms, given.tolist(), strict=True)
            ]
    return replace(case, mechanisms=mechanisms)


@contextmanager
def no_plans() -> Iterator[None]:
    """Without the plans of earlier calls: a single case is then calculated with floats."""
    kept = solver._plans
    solver._plans = OrderedDict()
    try:
        yield
    finally:
        solver._plans = kept


def plainly(case: Transmission) -> Results:
    """The results without plans: a copy of a case does not have plans that the case keeps."""
    with no_plans():
        return solve(copy(case))


def same(one: Array, other: Array) -> bool:
    """Whether two arrays agree to the last bit; all NaN are one."""
    if one.shape != other.shape or one.dtype != other.dtype:
        return False
    if one.dtype.kind != "f":
        return np.array_equal(one, other)
    signs = np.signbit(np.nan_to_num(one)), np.signbit(np.nan_to_num(other))
    return np.array_equal(one, other, equal_nan=True) and np.array_equal(*signs)


def alike(one: Array, other: Array) -> bool:
    """Whether arrays over gears agree to 1e-11 of the largest number of a gear, 1 at least."""
    if one.dtype.kind != "f" or not np.array_equal(np.isnan(one), np.isnan(other)):
        return same(one, other)
    gears = (len(one), -1)
    one, other = np.nan_to_num(one.reshape(gears)), np.nan_to_num(other.reshape(gears))
    with np.errstate(all="ignore"):
        left = np.abs(one - other).max(axis=1, initial=0)
    return bool((left <= 1e-11 * np.abs(other).max(axis=1, initial=1)).all())


def disagreements(
    case: Transmission,
    u: Floats | None,
    eta: Floats | None = None,
    variants: Iterable[int] | None = None,
) -> list[str]:
    """Where variants together are not what they are alone; [] is what we want.

    To the last bit, but where a plan of any sign has served: there to rounding.
    """
    with no_plans():
        together = solve(case, ratios=u, efficiencies=eta)
        signed = any(plan.signed for own in solver._plans.values() for plan in own.plans)
    agree, given = alike if signed else same, next(one for one in (u, eta) if one is not None)
    found = []
    for variant in range(len(given)) if variants is None else variants:
        numbers = (None if one is None else one[variant] for one in (u, eta))
        own = with_numbers(case, *numbers)
        alone = plainly(own)
        wrong = [n for n in ARRAYS if not agree(getattr(together, n)[variant], getattr(alone, n))]
        if wrong:
            found.append(f"variant {variant}: {', '.join(wrong)} of {trains.shown(own)}")
    return found


def large_train(rng: Random, most: int = 12) -> Transmission:
    """A random train of 2-12 mechanisms, few of them with losses where there are many."""
    while True:
        mechanisms = rng.randint(2, most)
        links, members = trains.random_links(rng, mechanisms)
        freedom = links - mechanisms
        if 1 <= freedom <= 6 and links >= 3:
            break
    members = trains._renumbered(rng, links, members)
    made = [trains.random_mechanism(rng, one) for one in members]
    if len(made) > 6:
        made = [one._replace(efficiency=1.0) if rng.random() < 0.6 else one for one in made]
    case = Transmission(
        links,
        trains.random_elements(rng, links, freedom - 1 + rng.randint(1, 4)),
        made,
        [Gear()],
        idle=rng.choice(("exact", "published")),
        coast=rng.random() < 0.25,
    )
    return replace(case, gears=[trains.random_gear(rng, case, regular=False) for _ in range(3)])


def chain(count: int, into: Transmission | None = None) -> Transmission:
    """Gear pairs of ratio 2 and efficiency .97 one after another, then a train."""
    last = into or Transmission(2, [ShiftElement(1, 2)], [], [Gear([1])])
    ends = [last.links + number for number in range(1, count + 1)]
    pairs = zip(ends, [*ends[1:], last.input], strict=True)
    made = [Mechanism(first, second, 0, 2.0, 0.97) for first, second in pairs]
    made += [one._replace(name="") for one in last.mechanisms]
    links = last.links + count
    return replace(last, links=links, link_names=(), mechanisms=made, input=ends[0])


def random_case(seed: int, largest: int = 6) -> tuple[Transmission, Floats, Floats | None]:
    random, rng = seeded(seed), generator(seed)
    case = random_train(random) if seed % 2 else large_train(random, largest)
    count = random.choice((1, 2, 4, 5, 6, 9, 20, 60))
    u = ratios(rng, case, count, random.choice(KINDS))
    return case, u, efficiencies(rng, case, count, random.choice(LOSSES))
