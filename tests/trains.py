"""Random connected trains, as functions of a `random.Random` and as strategies.

W = links - mechanisms; a gear of the right count engages W - 1 - given speeds
elements. Ratios are short decimals of both signs, many of them near 1 or such
that coincidences happen (-1, 2, 1/2).
"""

from collections.abc import Container, Sequence
from dataclasses import replace
from itertools import product
from random import Random

from hypothesis import strategies as st

from tests.oracle.systems import Speeds
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, SpeedOf, Transmission
from vstatics.core.writers.named import write_yaml

Links = tuple[int, int, int]
EASY = (-1.0, -2.0, -3.0, -0.5, -1.5, 2.0, 0.5, 3.0, 1.5)
NEAR_ONE = (0.95, 0.99, 0.998, 1.002, 1.004, 1.01, 1.05, 1.25, 0.8)
TRIES = 25


def random_ratio(rng: Random, links: Links) -> float:
    """An internal ratio; 1 for shafts (third = 0), hardly ever for others."""
    kind = rng.random()
    if kind < (0.2 if links[2] == 0 else 0.02 if 0 in links else 0.01):
        return 1.0
    if kind < 0.55:
        return round(rng.uniform(-4, -0.2), rng.choice((1, 2, 3)))
    if kind < 0.75:
        return round(rng.choice((rng.uniform(1.2, 4), rng.uniform(0.2, 0.85))), 2)
    return rng.choice(NEAR_ONE if kind < 0.85 else EASY)


def random_efficiency(rng: Random) -> float:
    """From .8 to 1, often 1 and often good."""
    kind = rng.random()
    if kind < 0.15:
        return 1.0
    return round(rng.uniform(0.8 if kind < 0.5 else 0.95, 1), rng.choice((2, 3)))


def random_value(rng: Random) -> float:
    """A given speed or torque: a short decimal, sometimes 0 or 1."""
    return rng.choice((0.0, 1.0, *(round(rng.uniform(-2, 2), 2) for _ in range(4))))


def random_mechanism(rng: Random, links: Links) -> Mechanism:
    """A mechanism on these links."""
    ratio = random_ratio(rng, links)
    planet = round(rng.uniform(0.3, 3), 2) if rng.random() < 0.2 else None
    return Mechanism(*links, ratio, random_efficiency(rng), planet)


def random_links(rng: Random, mechanisms: int) -> tuple[int, list[Links]]:
    """How many links there are, and those of each mechanism.

    Each new mechanism shares links with earlier ones and mostly brings one new;
    one link alone is a support.
    """
    count, found = 0, []
    for number in range(mechanisms):
        size = rng.choices((3, 2, 1), (0.8, 0.18, 0.02 if number else 0))[0]
        fresh = {3: rng.choice((0, 1, 1, 1, 1, 2)), 2: 1, 1: 0}[size]
        fresh = size if number == 0 else max(fresh, size - count)
        members = rng.sample(range(1, count + 1), size - fresh)
        members += range(count + 1, count + fresh + 1)
        members += [0] * (3 - size)
        rng.shuffle(members)
        if size < 3 and rng.random() < 0.5:
            members.sort(key=lambda link: link == 0)  # a gear pair: third is the housing
        count += fresh
        found.append((members[0], members[1], members[2]))
    return count, found


def random_elements(rng: Random, links: int, number: int) -> list[ShiftElement]:
    """Brakes and clutches, no two between the same links."""
    pairs: set[tuple[int, int]] = set()
    for _ in range(4 * number):
        if len(pairs) < number:
            first, second = rng.sample(range(1, links + 1), 2)
            brake = rng.random() < 0.55
            pairs.add((first, 0) if brake else (min(first, second), max(first, second)))
    elements = [ShiftElement(*pair) for pair in sorted(pairs)]
    rng.shuffle(elements)
    return elements


def is_regular(case: Transmission, gear: Gear) -> bool:
    """Both systems have exactly one solution: speeds do, and the output moves."""
    speeds = Speeds(case, gear)
    system = speeds.system
    if not system.consistent or system.missing or system.excess:
        return False
    return bool(speeds.link(case.gear_output(gear)))


def random_gear(rng: Random, case: Transmission, *, regular: bool) -> Gear:
    """A gear; a regular one has one input, one output and the right count."""
    kind = "plain" if regular else rng.choice(KINDS)
    gear = Gear()
    for _ in range(TRIES):
        gear = _gear_of_kind(rng, case, kind)
        if rng.random() < 0.02 or kind in ("fewer", "more") or is_regular(case, gear):
            break
    return gear


KINDS = ("plain", "plain", "ports", "speeds", "torques", "both", "fewer", "more", "direct")


def _gear_of_kind(rng: Random, case: Transmission, kind: str) -> Gear:
    """One attempt at a gear; it may turn out to be singular."""
    gear, count = Gear(), case.links - len(case.mechanisms) - 1
    ends = case.input, case.output
    if kind == "ports" or (kind in ("speeds", "torques", "both") and rng.random() < 0.3):
        first, second = rng.sample(range(1, case.links + 1), 2)
        ends = first, second
        gear = gear._replace(input=ends[0], output=ends[1])
    free = [link for link in range(1, case.links + 1) if link not in ends]
    if kind in ("speeds", "both") and free and count > 0:
        held = rng.sample(free, rng.randint(1, min(2, len(free), count)))
        gear = gear._replace(speeds={link: _speed(rng, link, case.links) for link in held})
        count -= len(held)
        free = [link for link in free if link not in held]
    if kind in ("torques", "both"):
        loads = rng.sample([*free, ends[0]], rng.randint(1, min(2, len(free) + 1)))
        gear = gear._replace(torques={link: random_value(rng) for link in loads})
    count += {"fewer": -1, "more": rng.choice((1, 1, 2))}.get(kind, 0)
    return gear._replace(engaged=_choice(rng, case, count, clutches=kind == "direct"))


def _speed(rng: Random, link: int, links: int) -> float | SpeedOf:
    """Of a link: a number, or that of another link."""
    value = random_value(rng)
    if rng.random() < 0.7:
        return value
    return SpeedOf(rng.choice([one for one in range(1, links + 1) if one != link]), value or 0.5)


def _choice(rng: Random, case: Transmission, count: int, *, clutches: bool) -> list[int]:
    """Numbers of `count` elements, or as many as there are; only clutches if wanted."""
    numbers = [
        n
        for n, e in enumerate(case.shift_elements, 1)
        if not clutches or 0 not in (e.first, e.second)
    ]
    return rng.sample(numbers, max(0, min(count, len(numbers))))


def random_train(
    rng: Random, *, regular: bool = False, gears: int = 3, coast: bool | None = None
) -> Transmission:
    """A random train of 2-6 mechanisms; `regular`: one-input-one-output gears only."""
    while True:
        case = _random_case(rng, coast=coast)
        found = [random_gear(rng, case, regular=regular) for _ in range(gears)]
        good = not regular or all(is_regular(case, gear) for gear in found)
        if good or rng.random() < 0.15:
            return replace(case, gears=found)


def _random_case(rng: Random, *, coast: bool | None) -> Transmission:
    """Links, devices and conventions, with a gear that stands for nothing yet."""
    while True:
        mechanisms = rng.randint(2, 6)
        links, members = random_links(rng, mechanisms)
        freedom = links - mechanisms
        if 1 <= freedom <= 5 and links >= 3:
            break
    members = _renumbered(rng, links, members)
    elements = random_elements(rng, links, freedom - 1 + rng.randint(1, 4))
    return Transmission(
        links,
        elements,
        [random_mechanism(rng, one) for one in members],
        [Gear()],
        output=0 if rng.random() < 0.8 else rng.randint(2, links),
        idle=rng.choice(("exact", "published")),
        coast=rng.random() < 0.25 if coast is None else coast,
    )


def _renumbered(rng: Random, links: int, members: Sequence[Links]) -> list[Links]:
    """The same train with its links in random order; 0 stays the housing."""
    order = [0, *rng.sample(range(1, links + 1), links)]
    return [(order[a], order[b], order[c]) for a, b, c in members]


def random_slipping(chance: Random) -> list[Transmission]:
    """A train whose gear is determined by one or two slipping elements, of all signs of slip."""
    while True:
        case = random_train(chance, regular=True, gears=1)
        [gear] = case.gears
        if gear.engaged and is_regular(case, gear):
            break
    slipping = chance.sample(gear.engaged, min(len(gear.engaged), chance.randint(1, 2)))
    engaged = tuple(number for number in gear.engaged if number not in slipping)
    sizes = [round(chance.uniform(0.01, 0.5), 2) for _ in slipping]
    return [
        replace(case, gears=[gear._replace(engaged=engaged, slip=slip)], idle="exact")
        for signs in product((1, -1), repeat=len(slipping))
        for slip in [{n: x * size for n, x, size in zip(slipping, signs, sizes, strict=True)}]
    ]


@st.composite
def trains(
    draw: st.DrawFn, *, regular: bool = False, gears: int = 1, coast: bool | None = None
) -> Transmission:
    """Random trains for hypothesis."""
    rng = draw(st.randoms(use_true_random=False))
    return random_train(rng, regular=regular, gears=gears, coast=coast)


def regular_trains(*, gears: int = 1, coast: bool | None = None) -> st.SearchStrategy[Transmission]:
    """Random trains whose gears have one input, one output and the right count."""
    return trains(regular=True, gears=gears, coast=coast)


def no_losses(case: Transmission) -> Transmission:
    """The same train with all efficiencies 1."""
    return replace(case, mechanisms=[m._replace(efficiency=1.0) for m in case.mechanisms])


def with_variators(rng: Random, case: Transmission) -> Transmission:
    """The train in which every pair of wheels is a variator, of a speed ratio of any sign."""

    def variator(one: Mechanism) -> Mechanism:
        if one.third or not (one.first and one.second):
            return one
        ratio = rng.choice((-1, 1)) * round(rng.uniform(0.1, 2), 2)
        return one._replace(ratio=ratio, kind="variator", planet_ratio=None, is_set=False)

    return replace(case, mechanisms=list(map(variator, case.mechanisms)))


def on_springs(case: Transmission, chosen: Container[int] | None = None) -> Transmission:
    """The train in which springs stand for loss-free mechanisms: their rows as twists.

    Parameters
    ----------
    chosen : container of int, optional
        Indices of mechanisms; all when not given. Their losses are left out.
    """
    kept, springs = [], []
    for number, one in enumerate(case.mechanisms):
        row = zip(one.links, (1.0, -one.ratio, one.ratio - 1), strict=True)
        twist = {link: part for link, part in row if link and part}
        if twist and (chosen is None or number in chosen):
            springs.append(Spring(twist, stiffness=9e4, name=one.name))
        else:
            kept.append(one if twist else one._replace(efficiency=1.0))
    return replace(case, mechanisms=kept, springs=springs)


def shown(case: Transmission) -> str:
    """The train as a file, for messages and reports."""
    return write_yaml(case)
