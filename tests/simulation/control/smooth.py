"""Random scenarios that rest on corners of their formulas and leave them smoothly.

Their motion is also integrated by scipy, by equations that are written here: two inertias, a clutch
between them, a brake on the second, torques, states. Formulas are texts that Python evaluates as
well. Friction is ``capacity tanh(slip/e)`` there, so speeds differ from those of dry friction by a few e.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from random import Random
from typing import Any, NamedTuple, Self

import numpy as np
from scipy.integrate import solve_ivp

CREEP = 2e-6
"""Slip at which friction is three quarters of its capacity in the reference [rad/s]."""
FUNCTIONS = {"exp": math.exp, "min": min, "max": max, "abs": abs, "__builtins__": {}}
BACK = 1e-6
"""Time in which the reference brings a state back to its limit [s]."""
CAPACITY = 400.0
"""Of the case. [N*m]"""


class Smooth(NamedTuple):
    """A random scenario."""

    duration: float
    inertias: tuple[float, float]
    start: tuple[float, float]
    states: dict[str, tuple[str, float, float, float]]
    """Rate, start, least and largest value."""
    tables: dict[str, list[list[float]]]
    controls: dict[str, str]
    torques: dict[str, str]
    command: tuple[float, float, float]
    """Its first value, the time at which a sequence changes it, its value then."""

    @property
    def case(self) -> str:
        """The case, as it is written."""
        first, second = self.inertias
        return f"""links: [a, b]
inertias: {{a: {first}, b: {second}}}
shift_elements:
  C: {{links: [a, b], capacity: {CAPACITY} N*m}}
  B: {{links: [b, housing], capacity: {CAPACITY} N*m}}
"""

    @property
    def scenario(self) -> str:
        """The scenario, as it is written, but for its case."""
        lines = [f"duration: {self.duration}"]
        lines.append(f"start: {{speeds: {{a: {self.start[0]}, b: {self.start[1]}}}}}")
        lines.append(f"set: {{command: {self.command[0]}}}")
        if self.tables:
            lines += ["tables:", *(f"  {name}: {one}" for name, one in self.tables.items())]
        lines.append("states:")
        for name, (rate, start, least, most) in self.states.items():
            limits = f", min: {least}" * math.isfinite(least) + f", max: {most}" * math.isfinite(
                most
            )
            lines.append(f'  {name}: {{rate: "{rate}", start: {start}{limits}}}')
        for key, texts in (("controls", self.controls), ("torques", self.torques)):
            lines.append(f"{key}:")
            lines += [f'  {name}: "{text}"' for name, text in texts.items()]
        _, time, value = self.command
        lines.append("sequences:")
        lines.append(f'  go: [{{when: "t >= {time}", set: {{command: {value}}}}}]')
        return "\n".join(lines) + "\n"


def smooth(rng: Random) -> Smooth:
    """A random scenario."""
    many = _Writer(rng)
    states, tables = many.states(), many.tables
    controls = {"C": many.formula(many.capacity, rng.choice([0, 1, 1, 2]))}
    controls["B"] = many.formula(many.capacity, rng.randrange(2)) if rng.random() < 0.3 else "0"
    torques = {"a": many.formula(many.torque, rng.choice([0, 1, 1, 2])) + many.load("a")}
    torques["b"] = (many.formula(many.torque, 0) if rng.random() < 0.3 else "0") + many.load("b")
    start = rng.choice([(0.0, 0.0), (0.0, 0.0), (10.0, 10.0), (60.0, 0.0), (20.0, -5.0)])
    inertias = round(rng.uniform(0.3, 3), 2), round(rng.uniform(0.3, 5), 2)
    command = 0.0, round(rng.uniform(0.1, 0.5), 2), float(rng.choice([1, 3, 50]))
    return Smooth(0.6, inertias, start, states, tables, controls, torques, command)


class _Writer:
    """Writes random formulas."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.names: list[str] = []
        self.tables: dict[str, list[list[float]]] = {}

    def number(self, low: float, high: float) -> float:
        return round(self.rng.uniform(low, high), 2)

    def states(self) -> dict[str, tuple[str, float, float, float]]:
        """Lags one after the other, and what begins below 0."""
        rng, made = self.rng, {}
        source = rng.choice(
            ["t", "min(3*t, 1)", "max(t - 0.2, 0)", "command", "t*t", "abs(t - 0.3)"]
        )
        for number in range(1, rng.randint(1, 4)):
            name, lag = f"p{number}", self.number(0.05, 0.3)
            least = rng.choice([-math.inf, 0.0])
            made[name] = (f"({source} - {name})/{lag}", 0.0, least, rng.choice([math.inf, 0.4]))
            source = name
            self.names.append(name)
        kind = rng.randrange(5)
        if kind == 0:
            made["e"] = ("3", -1.0, -math.inf, math.inf)
        elif kind == 1:
            made["e"] = (f"{self.number(1, 9)}*(t - 0.2)", 0.0, 0.0, 0.5)
        elif kind == 2:
            made["e"] = (f"{self.number(0.01, 0.2)}*slip('C')", 0.0, -0.3, 0.6)
        elif kind == 3:
            made["e"] = (
                f"{self.number(1, 5)}*{source} - 0.1*e",
                rng.choice([0.0, -0.2]),
                -1.0,
                1.0,
            )
        else:
            return made
        self.names.append("e")
        return made

    def atom(self) -> str:
        """What begins at 0, as a rule."""
        rng = self.rng
        if self.names and rng.random() < 0.6:
            name = rng.choice(self.names)
            return rng.choice(
                [name, name, f"max({name}, 0)", f"abs({name})", f"max({name} - 0.1, 0)"]
            )
        return rng.choice(
            [
                "t",
                "min(t, 0.5)",
                "max(t - 0.2, 0)",
                "t^2",
                "t^3",
                "abs(slip('C'))/30",
                "min(abs(slip('C')), 5)/5",
                "abs(speed('a'))/100",
                "max(speed('b'), 0)/50",
                "abs(speed('a') - speed('b'))/50",
            ]
        )

    def table(self) -> str:
        """The name of a table, whose first or second point is at 0."""
        rng, name = self.rng, f"m{len(self.tables)}"
        first = rng.choice([0.0, -1.0])
        points, value = [[first, rng.choice([0.0, 0.0, 1.0])]], 0.0
        if first < 0:
            points.append([0.0, rng.choice([0.0, 0.5])])
        for place in (0.2, 0.5, 1.0):
            value = self.number(-0.3, 1.5)
            points.append([place, value])
        self.tables[name] = points
        return name

    def shape(self, depth: int) -> str:
        """A number from nearly 0 to about 1."""
        if not depth:
            return self.atom()
        one, other = self.shape(depth - 1), self.shape(depth - 1)
        return self.rng.choice(
            [
                f"min({one}, {other})",
                f"max({one}, {other})",
                f"({one})*({other})",
                f"abs({one} - {other})",
                f"({one} + {other})/2",
                *[f"{self.table()}({one})"] * 2,
            ]
        )

    def formula(self, kind: Any, depth: int) -> str:
        return str(kind(self.shape(depth)))

    def capacity(self, shape: str) -> str:
        rng = self.rng
        size = rng.choice([30, 80, 300])
        return rng.choice(
            [
                f"{size}*({shape})",
                f"{size}*({shape})",
                f"max({size}*({shape}) - 5, 0)",
                f"10 + 3*exp(-abs(slip('C'))/5) + {size}*({shape})",
                f"20*abs(slip('C')) + {size}*({shape})",
                f"{size}*({shape}) - 2",
            ]
        )

    def torque(self, shape: str) -> str:
        rng = self.rng
        size = rng.choice([10, 60, 200])
        return rng.choice(
            [
                f"{size}*({shape})",
                f"{size}*({shape})",
                f"{size}*({shape})*(2 - abs(speed)/200)",
                f"min({size}*({shape}), 50)",
                f"-{size}*({shape})",
            ]
        )

    def load(self, link: str) -> str:
        rng = self.rng
        if rng.random() < 0.5:
            return ""
        return rng.choice(
            [f" - {self.number(0.05, 0.5)}*speed", f" - 0.002*speed*abs(speed('{link}'))"]
        )


def integrated(given: Smooth) -> np.ndarray:
    """Speeds at the end, by an implicit solver of scipy."""
    names = [*given.states]
    codes = {
        key: compile(text.replace("^", "**"), key, "eval")
        for key, text in (
            *((f"rate {name}", one[0]) for name, one in given.states.items()),
            *((f"control {name}", text) for name, text in given.controls.items()),
            *((f"torque {name}", text) for name, text in given.torques.items()),
        )
    }
    tables = {
        name: partial(_straight, [tuple(point) for point in points])
        for name, points in given.tables.items()
    }

    def change(time: float, y: np.ndarray, command: float) -> list[float]:
        speeds = {"a": float(y[0]), "b": float(y[1])}
        values = {
            name: min(max(float(value), given.states[name][2]), given.states[name][3])
            for name, value in zip(names, y[2:], strict=True)
        }
        slips = {"C": speeds["a"] - speeds["b"], "B": speeds["b"]}
        words = {"t": time, "command": command, "slip": slips.__getitem__, **values}

        def told(key: str, speed: Any = speeds.__getitem__) -> float:
            seen = {**FUNCTIONS, **tables, **words, "speed": speed}
            return float(eval(codes[key], seen))  # noqa: S307 - it is written above

        friction = {
            name: min(max(told(f"control {name}"), 0.0), CAPACITY) * math.tanh(slips[name] / CREEP)
            for name in slips
        }
        rates = [
            told(f"rate {name}") + (values[name] - value) / BACK
            for name, value in zip(names, y[2:].tolist(), strict=True)
        ]
        first, second = (told(f"torque {link}", OwnSpeed(speeds[link], speeds)) for link in "ab")
        return [
            (first - friction["C"]) / given.inertias[0],
            (second + friction["C"] - friction["B"]) / given.inertias[1],
            *rates,
        ]

    y = np.array([*given.start, *(one[1] for one in given.states.values())])
    before, time, after = given.command
    for begin, end, command in ((0.0, time, before), (time, given.duration, after)):
        found = solve_ivp(
            change, (begin, end), y, "Radau", args=(command,), rtol=1e-9, atol=1e-9, max_step=0.01
        )
        y = found.y[:, -1]
    return np.asarray(y[:2])


def _straight(points: Sequence[tuple[float, ...]], at: float) -> float:
    """Interpolate linearly between points, with the end values outside."""
    places, values = zip(*points, strict=True)
    return float(np.interp(at, np.array(places), np.array(values)))


class OwnSpeed(float):
    """The speed of a link itself, which may be called for that of another one."""

    speeds: dict[str, float]

    def __new__(cls, value: float, speeds: dict[str, float]) -> Self:
        """Know the speeds of all links."""
        made = super().__new__(cls, value)
        made.speeds = speeds
        return made

    def __call__(self, link: str) -> float:
        """Return the speed of a link."""
        return self.speeds[link]
