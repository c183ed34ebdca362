"""Small random calculations that decide by comparisons, for floats and for traced numbers."""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from hypothesis import strategies as st

from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.memory import Rows
from vstatics.core.numerics.traced import Number, absolute

INPUTS = 3
CONSTANTS = (0.0, 1.0, -1.0, 2.0, 3.0, 0.5, -0.25, 4.0, math.nan)
NUMBERS = (1.0, 2.0, 3.0, 0.5, 1.5, 4.0, 0.25, 1 + 1e-15, 1 - 1e-12, 2 + 1e-9, 1 / 3, 0.1)
PRODUCTS = 5
"""At most: powers of the inputs that neither overflow nor vanish."""


class Step(NamedTuple):
    """An operation on values made before: their places, counted modulo their number."""

    name: str
    places: tuple[int, int, int, int]


Program = Sequence[Step]


def run(program: Program, inputs: Sequence[Number]) -> list[Number]:
    """All values of a program, after its inputs and the constants."""
    values: list[Number] = [*inputs, *CONSTANTS]
    for name, places in program:
        a, b, c, d = (values[place % len(values)] for place in places)
        values.append(_value(name, a, b, c, d))
    return values[len(inputs) + len(CONSTANTS) :]


def _value(name: str, a: Number, b: Number, c: Number, d: Number) -> Number:
    simple: dict[str, Callable[[], Number]] = {
        "+": lambda: a + b,
        "-": lambda: a - b,
        "*": lambda: a * b,
        "/": lambda: 0.0 if b == 0 else a / b,
        "negative": lambda: -a,
        "magnitude": lambda: absolute(a),
        "zero": lambda: a * 0.0,
        "less": lambda: c if a < b else d,
        "less or equal": lambda: c if a <= b else d,
        "greater": lambda: c if a > b else d,
        "greater or equal": lambda: c if a >= b else d,
        "equal": lambda: c if a == b else d,
        "other": lambda: c if a != b else d,
        "largest": lambda: max(a, b, c),
        "exists": lambda: c if a == a else d,  # noqa: PLR0124
    }
    return simple[name]()


NAMES = (
    *("+", "-", "*", "/", "+", "-", "*", "/", "less", "equal", "negative", "magnitude", "zero"),
    *("less or equal", "greater", "greater or equal", "other", "largest", "exists"),
)


@st.composite
def programs(draw: st.DrawFn, steps: int = 14) -> Program:
    """Programs with few products; most steps take inputs or the last values."""
    made: list[Step] = []
    for _ in range(draw(st.integers(1, steps))):
        name = draw(st.sampled_from(NAMES))
        if sum(step.name in ("*", "/") for step in made) >= PRODUCTS and name in ("*", "/"):
            name = "-"
        places = st.one_of(st.integers(-4, INPUTS - 1), st.integers(0, 40))
        made.append(Step(name, (draw(places), draw(places), draw(places), draw(places))))
    return made


@st.composite
def variants(draw: st.DrawFn, most: int = 12) -> Floats:
    """Inputs, shape (inputs, variants): most like the first variant, some like each other."""
    number = st.one_of(st.sampled_from(NUMBERS), st.floats(0.02, 50))
    signed = st.tuples(number, st.sampled_from((1, 1, 1, -1))).map(lambda pair: pair[0] * pair[1])
    factor = st.one_of(st.just(1.0), st.sampled_from(NUMBERS), st.just(-1.0))
    start = draw(st.lists(signed, min_size=INPUTS, max_size=INPUTS))
    columns = [start]
    for _ in range(draw(st.integers(1, most - 1))):
        own = draw(st.lists(factor, min_size=INPUTS, max_size=INPUTS))
        columns.append([first * by for first, by in zip(start, own, strict=True)])
    return np.array(columns).T.copy()


def rows_for(results: int, count: int) -> Rows:
    """Memory for the results of some variants, full of what is no result."""
    return Rows([np.full(count, 1e300) for _ in range(results)])


def same_bits(one: float, other: float) -> bool:
    """Whether two numbers are the same to the last bit, except that all NaN are one."""
    if math.isnan(one) or math.isnan(other):
        return math.isnan(one) and math.isnan(other)
    return one == other and math.copysign(1, one) == math.copysign(1, other)
