"""Random scenarios of inertias in a row, with springs, several clutches and sequences.

They are written and integrated as those of two links, see `smooth`.
"""

from itertools import combinations, pairwise
from random import Random
from typing import Any

from tests.simulation.control.smooth import RowSpring, Smooth, Writer

NO_LIMITS = -float("inf"), float("inf")


def _joints(rng: Random, links: str) -> tuple[dict[str, tuple[str, str]], dict[str, RowSpring]]:
    """Clutches and springs between neighbours, at times a brake, and a clutch beside them."""
    springs: dict[str, RowSpring] = {}
    elements: dict[str, tuple[str, str]] = {}
    for first, second in pairwise(links):
        if elements and rng.random() < 0.5:
            numbers = rng.choice([60.0, 800.0, 9000.0]), rng.choice([0.5, 4.0, 30.0])
            springs[f"s{first}"] = RowSpring(first, second, *numbers)
        else:
            elements["CDE"[len(elements)]] = first, second
    if rng.random() < 0.5:
        elements["B"] = rng.choice(links), ""
    if rng.random() < 0.3:
        elements["F"] = "a", "c"
    return elements, springs


def smooth_row(rng: Random) -> Smooth:
    """A random scenario of three or four links.

    Up to three sequences act at one instant: by the time, by a state, and by a number that another
    one of them has set. The first one acts again a little later.
    """
    links = "abcd"[: rng.randint(3, 4)]
    elements, springs = _joints(rng, links)
    many = Writer(rng)
    states = many.states()
    time, value = round(rng.uniform(0.1, 0.3), 2), float(rng.choice([1, 3, 50]))
    again, later = round(rng.uniform(0.05, 0.2), 2), float(rng.choice([0, 1, 2]))
    states["clock"] = ("1", 0.0, *NO_LIMITS)
    names = ["second", "third"][: rng.randrange(3)]
    many.names += names
    go: dict[str, Any] = {"when": f"t >= {time}", "set": {"command": value}}
    steps = {"go": [go, {"wait": again, "set": {"command": later}}]}
    first_values, then = dict.fromkeys(["command", *names], 0.0), {"command": value}
    for name, when in zip(names, (f"clock >= {time}", "command > 0.5"), strict=False):
        then[name] = many.number(0.1, 1)
        steps[f"and_{name}"] = [{"when": when, "set": {name: then[name]}}]
    commands = [(0.0, first_values), (time, then), (time + again, {"command": later})]
    controls, torques = {}, {}
    for name in elements:
        control = many.formula(many.capacity, rng.choice([0, 1, 1, 2]))
        controls[name] = control.replace("slip('C')", f"slip('{rng.choice([*elements])}')")
    for link in links:
        given = many.formula(many.torque, rng.choice([0, 1])) if rng.random() < 0.5 else "0"
        torques[link] = given + many.load(link)
    inertias = tuple(many.number(0.3, 4) for _ in links)
    start = rng.choice([0.0, 0.0, 10.0, 60.0])
    speeds = tuple(start if link == "a" or start < 60 else 0.0 for link in links)
    return Smooth(
        0.6, inertias, speeds, states, many.tables, controls, torques, commands, steps, elements,
        springs,
    )  # fmt: skip


def smooth_loop(rng: Random) -> Smooth:
    """A random scenario of links in loops of clutches.

    More clutches can stick than slips can differ. Capacities grow from 0 or are 0, and torques grow
    from 0.
    """
    links = "abcd"[: rng.randint(3, 4)]
    pairs = [*combinations(links, 2)]
    elements = dict(zip("CDEFGH", rng.sample(pairs, rng.randint(3, len(pairs))), strict=False))
    if rng.random() < 0.5:
        elements["B"] = rng.choice(links), ""
    many = Writer(rng)
    states = many.states()
    shapes = ["0", "min(t, 0.3)", "t^2", *many.names]
    controls = {}
    for name in elements:
        grip = rng.choice([20, 100, 300])
        seen = rng.choice([*elements])
        forms = "{0}*({1}); {0}*abs(slip('{2}')); {3}; {0}*abs(slip('{2}'))/9 + {0}*({1})"
        form = rng.choice(forms.split("; "))
        controls[name] = form.format(grip, rng.choice(shapes), seen, many.number(0, 9))
    torques = dict.fromkeys(links, "0")
    for link in rng.sample(links, rng.randint(1, 2)):
        torques[link] = f"{rng.choice([-90, 20, 60])}*({rng.choice(shapes)})" + many.load(link)
    inertias = tuple(many.number(0.3, 4) for _ in links)
    start = rng.choice([0.0, 0.0, 10.0])
    commands = [(0.0, {"command": 0.0}), (0.2, {"command": 1.0})]
    steps: dict[str, Any] = {"go": [{"when": "t >= 0.2", "set": {"command": 1}}]}
    return Smooth(
        0.6, inertias, (start,) * len(links), states, {}, controls, torques, commands, steps,
        elements,
    )  # fmt: skip
