"""Random scenarios that rest on corners of their formulas and leave them smoothly.

Their motion is also integrated by scipy, by equations that are written here: inertias in a row,
clutches and springs between them, brakes, torques, states. Formulas are texts that Python evaluates
as well. Friction is ``capacity tanh(slip/e)`` there, so speeds differ from those of dry friction by
a few e.
"""

import json
import math
import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import count
from random import Random
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

CREEP = 2e-6
"""Slip at which friction is three quarters of its capacity in the reference [rad/s]."""
FUNCTIONS = {"exp": math.exp, "tanh": math.tanh, "min": min, "max": max, "abs": abs}
BACK = 1e-6
"""Time in which the reference brings a state back to its limit [s]."""
CAPACITY = 400.0
"""Of the case. [N*m]"""
_MOST_CALLS = 50_000
"""Calls of the equations after which another tolerance is tried."""
BETWEEN = {"C": ("a", "b"), "B": ("b", "")}
"""Links of each shift element; no second one: the housing."""


SOURCES = "t; min(3*t, 1); max(t - 0.2, 0); command; t*t; abs(t - 0.3)"
ATOMS = (
    "t; min(t, 0.5); max(t - 0.2, 0); t^2; t^3; abs(slip('C'))/30; min(abs(slip('C')), 5)/5; "
    "abs(speed('a'))/100; max(speed('b'), 0)/50; abs(speed('a') - speed('b'))/50"
)
"""Numbers that begin at 0, as a rule."""
CAPACITIES = (
    "{0}*({1}); {0}*({1}); max({0}*({1}) - 5, 0); 10 + 3*exp(-abs(slip('C'))/5) + {0}*({1}); "
    "20*abs(slip('C')) + {0}*({1}); {0}*({1}) - 2"
)
TORQUES = "{0}*({1}); {0}*({1}); {0}*({1})*(2 - abs(speed)/200); min({0}*({1}), 50); -{0}*({1})"


class RowSpring(NamedTuple):
    """A spring of a random scenario."""

    first: str
    second: str
    stiffness: float
    """[N*m/rad]"""
    damping: float
    """[N*m*s/rad]"""


class Smooth(NamedTuple):
    """A random scenario."""

    duration: float
    inertias: tuple[float, ...]
    """Of the links a, b, ..."""
    start: tuple[float, ...]
    states: dict[str, tuple[str, float, float, float]]
    """Rate, start, least and largest value."""
    tables: dict[str, list[list[float]]]
    controls: dict[str, str]
    torques: dict[str, str]
    commands: list[tuple[float, dict[str, float]]]
    """Numbers that are set, with the time from which on they are; the first ones at 0."""
    sequences: dict[str, list[dict[str, Any]]]
    """Steps that set them."""
    elements: Mapping[str, tuple[str, str]] = BETWEEN
    springs: Mapping[str, RowSpring] = {}

    @property
    def links(self) -> str:
        """The names of the links, each a letter."""
        return "abcdef"[: len(self.inertias)]

    @property
    def case(self) -> str:
        """The case, as it is written."""
        elements = {
            name: {"links": [first, second or "housing"], "capacity": f"{CAPACITY} N*m"}
            for name, (first, second) in self.elements.items()
        }
        springs = {
            name: {"links": one[:2], "stiffness": one.stiffness, "damping": one.damping}
            for name, one in self.springs.items()
        }
        inertias = dict(zip(self.links, self.inertias, strict=True))
        given = {"links": [*self.links], "inertias": inertias, "shift_elements": elements}
        return written({**given, "springs": springs})

    @property
    def scenario(self) -> str:
        """The scenario, as it is written, but for its case."""
        states = {}
        for name, (rate, start, least, most) in self.states.items():
            limits = {"min": least, "max": most}
            finite = {key: limit for key, limit in limits.items() if math.isfinite(limit)}
            states[name] = {"rate": rate, "start": start, **finite}
        speeds = dict(zip(self.links, self.start, strict=True))
        given = {"duration": self.duration, "start": {"speeds": speeds}, "set": self.commands[0][1]}
        given |= {"tables": self.tables, "states": states, "sequences": self.sequences}
        return written({**given, "controls": self.controls, "torques": self.torques})


def written(given: Mapping[str, Any]) -> str:
    """A line for each key that is not empty."""
    return "".join(f"{key}: {json.dumps(one)}\n" for key, one in given.items() if one)


def smooth(rng: Random) -> Smooth:
    many = Writer(rng)
    states, tables = many.states(), many.tables
    controls = {"C": many.formula(many.capacity, rng.choice([0, 1, 1, 2]))}
    controls["B"] = many.formula(many.capacity, rng.randrange(2)) if rng.random() < 0.3 else "0"
    torques = {"a": many.formula(many.torque, rng.choice([0, 1, 1, 2])) + many.load("a")}
    torques["b"] = (many.formula(many.torque, 0) if rng.random() < 0.3 else "0") + many.load("b")
    start = rng.choice([(0.0, 0.0), (0.0, 0.0), (10.0, 10.0), (60.0, 0.0), (20.0, -5.0)])
    inertias = round(rng.uniform(0.3, 3), 2), round(rng.uniform(0.3, 5), 2)
    time, command = round(rng.uniform(0.1, 0.5), 2), float(rng.choice([1, 3, 50]))
    commands = [(0.0, {"command": 0.0}), (time, {"command": command})]
    steps = {"go": [{"when": f"t >= {time}", "set": {"command": command}}]}
    return Smooth(0.6, inertias, start, states, tables, controls, torques, commands, steps)


class Writer:
    """Writes random formulas."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.names: list[str] = []
        self.tables: dict[str, list[list[float]]] = {}

    def number(self, low: float, high: float) -> float:
        """Return a number between two."""
        return round(self.rng.uniform(low, high), 2)

    def states(self) -> dict[str, tuple[str, float, float, float]]:
        """Lags one after the other, and what begins below 0."""
        rng, made = self.rng, {}
        source = rng.choice(SOURCES.split("; "))
        for number in range(1, rng.randint(1, 4)):
            name, lag = f"p{number}", self.number(0.05, 0.3)
            least = rng.choice([-math.inf, 0.0])
            made[name] = (f"({source} - {name})/{lag}", 0.0, least, rng.choice([math.inf, 0.4]))
            source = name
            self.names.append(name)
        slow, fast, gain = self.number(0.01, 0.2), self.number(1, 9), self.number(1, 5)
        kinds = [
            ("3", -1.0, -math.inf, math.inf),
            (f"{fast}*(t - 0.2)", 0.0, 0.0, 0.5),
            (f"{slow}*slip('C')", 0.0, -0.3, 0.6),
            (f"{gain}*{source} - 0.1*e", rng.choice([0.0, -0.2]), -1.0, 1.0),
        ]
        kind = rng.randrange(5)
        if kind == len(kinds):
            return made
        made["e"] = kinds[kind]
        self.names.append("e")
        return made

    def atom(self) -> str:
        """What begins at 0, as a rule."""
        rng = self.rng
        if self.names and rng.random() < 0.6:
            name = rng.choice(self.names)
            forms = "{0}; {0}; max({0}, 0); abs({0}); max({0} - 0.1, 0)"
            return rng.choice(forms.format(name).split("; "))
        return rng.choice(ATOMS.split("; "))

    def table(self) -> str:
        """The name of a table, whose first or second point is at 0."""
        rng, name = self.rng, f"m{len(self.tables)}"
        first = rng.choice([0.0, -1.0])
        points = [[first, rng.choice([0.0, 0.0, 1.0])]]
        if first < 0:
            points.append([0.0, rng.choice([0.0, 0.5])])
        points += [[place, self.number(-0.3, 1.5)] for place in (0.2, 0.5, 1.0)]
        self.tables[name] = points
        return name

    def shape(self, depth: int) -> str:
        """A number from nearly 0 to about 1."""
        if not depth:
            return self.atom()
        one, other = self.shape(depth - 1), self.shape(depth - 1)
        table = f"{self.table()}({one})"
        forms = "min({0}, {1}); max({0}, {1}); ({0})*({1}); abs({0} - {1}); ({0} + {1})/2"
        return self.rng.choice([*forms.format(one, other).split("; "), table, table])

    def formula(self, kind: Any, depth: int) -> str:
        """Return a formula of a kind, so deep."""
        return str(kind(self.shape(depth)))

    def capacity(self, shape: str) -> str:
        """Return the control of a clutch."""
        size = self.rng.choice([30, 80, 300])
        return self.rng.choice(CAPACITIES.split("; ")).format(size, shape)

    def torque(self, shape: str) -> str:
        """Return an outside torque."""
        size = self.rng.choice([10, 60, 200])
        return self.rng.choice(TORQUES.split("; ")).format(size, shape)

    def load(self, link: str) -> str:
        """Return the load on a link, or nothing."""
        rng = self.rng
        if rng.random() < 0.5:
            return ""
        return rng.choice(
            [f" - {self.number(0.05, 0.5)}*speed", f" - 0.002*speed*abs(speed('{link}'))"]
        )


class _TooManyCalls(Exception):  # noqa: N818 - it never leaves the module
    """More calls than a solver needs which gets on."""


def integrated(given: Smooth) -> np.ndarray:
    """Speeds at the end, by LSODA of ODEPACK, from one command to the next.

    Where it does not get on, as its steps follow the rounding of a slip that is held, the
    tolerance is larger, and Radau is the last.
    """
    for method, tolerance in (("LSODA", 1e-10), ("LSODA", 1e-8)):
        try:
            return _integrated(given, method, tolerance, _MOST_CALLS)
        except _TooManyCalls:
            continue
    return _integrated(given, "Radau", 1e-8, math.inf)


def _integrated(given: Smooth, method: Any, tolerance: float, most: float) -> np.ndarray:
    change, calls = _equations(given), count()

    def counted(t: float, y: np.ndarray, numbers: dict[str, float]) -> list[float]:
        if next(calls) > most:
            raise _TooManyCalls
        return change(numbers, t, y)

    y = np.array(
        [*given.start, *[0.0] * len(given.springs), *(one[1] for one in given.states.values())]
    )
    ends = [*(time for time, _ in given.commands[1:]), given.duration]
    numbers: dict[str, float] = {}
    for (begin, changed), end in zip(given.commands, ends, strict=True):
        numbers = numbers | changed
        found = solve_ivp(
            counted, (begin, end), y, method, args=(numbers,), rtol=tolerance, atol=tolerance,
            max_step=0.01,
        )  # fmt: skip
        assert found.status == 0, found.message
        y = found.y[:, -1]
    return np.asarray(y[: len(given.inertias)])


def _equations(given: Smooth) -> Callable[..., list[float]]:
    """The changes of speeds, twists and states, as a function that Python has compiled."""
    slips = {
        name: f"({first} - {second or '0.0'})" for name, (first, second) in given.elements.items()
    }
    links = given.links
    names = [*links, *(f"twist_{name}" for name in given.springs), *given.states]
    lines = ["def change(numbers, t, y):", f"    {', '.join(names)}, = y.tolist()"]
    lines += [f"    {name} = numbers['{name}']" for name in given.commands[0][1]]
    for name, (_, _, least, most) in given.states.items():
        lines.append(f"    free_{name}, {name} = {name}, min(max({name}, {least}), {most})")
    sums = {link: [f"({_plain(text, slips, link)})"] for link, text in given.torques.items()}
    for name, control in given.controls.items():
        held = f"min(max({_plain(control, slips)}, 0.0), {CAPACITY})"
        lines.append(f"    friction_{name} = {held}*tanh({slips[name]}/{CREEP})")
        for sign, link in zip("-+", given.elements[name], strict=True):
            sums.setdefault(link, []).append(f"{sign} friction_{name}")
    rates = []
    for name, spring in given.springs.items():
        rates.append(f"{spring.first} - {spring.second}")
        torque = f"{spring.stiffness}*twist_{name} + {spring.damping}*({rates[-1]})"
        sums.setdefault(spring.first, []).append(f"- ({torque})")
        sums.setdefault(spring.second, []).append(f"+ ({torque})")
    for name, (rate, *_) in given.states.items():
        rates.append(f"{_plain(rate, slips)} + ({name} - free_{name})/{BACK}")
    speeds = [
        f"({' '.join(sums.get(link, ['0.0']))})/{inertia}"
        for link, inertia in zip(links, given.inertias, strict=True)
    ]
    lines.append(f"    return [{', '.join([*speeds, *rates])}]")
    known: dict[str, Any] = {**FUNCTIONS, "inf": math.inf}
    for name, points in given.tables.items():
        known[name] = partial(_straight, [(x, value) for x, value in points])
    exec("\n".join(lines), known)  # noqa: S102 - it is written above
    change: Callable[..., list[float]] = known["change"]
    return change


def _plain(text: str, slips: Mapping[str, str], link: str = "") -> str:
    """A formula as Python has it, with the speeds of links by their names."""
    text = re.sub(r"slip\('(\w+)'\)", lambda found: slips[found[1]], text.replace("^", "**"))
    text = re.sub(r"speed\('(\w+)'\)", r"\1", text)
    return re.sub(r"\bspeed\b", link, text)


def _straight(points: Sequence[tuple[float, float]], at: float) -> float:
    before, value = points[0]
    if at <= before:
        return value
    for place, following in points[1:]:
        if at <= place:
            return value + (following - value) * (at - before) / (place - before)
        before, value = place, following
    return value
