"""An answer as a record: its JSON and its schema are of one mind."""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from jsonschema import Draft202012Validator

from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables import answer
from vstatics.core.tables.answer import Count, Failure, Flat, Sometimes, json_keys, plain_data


class Inner(NamedTuple):
    """What stands in another record."""

    a: Count | None
    b: Sometimes[Mapping[str, float]] = None


@json_keys("name", "inner", from_="begin", moduli="values", error="error")
class Outer(NamedTuple):
    """One of all marks."""

    name: str
    inner: Flat[Inner | None] = None
    begin: complex = 0j
    values: Floats = np.zeros(0)
    hidden: int = 0
    error: Failure = ""


def test_data_have_the_keys_that_types_tell() -> None:
    nothing = {"from": {"real": 0, "imag": 0}, "moduli": []}
    record: Outer
    expected: Mapping[str, object]
    for record, expected in (
        (
            Outer("x", Inner(None), complex(1, math.inf), np.array([3 + 4j, math.nan])),
            {"name": "x", "a": None, "from": {"real": 1, "imag": None}, "moduli": [5, None]},
        ),
        (Outer("x", Inner(2, {"p": 1.5})), {"name": "x", "a": 2, "b": {"p": 1.5}, **nothing}),
        (Outer("x", error="tied up"), {"name": "x", "error": "tied up", "moduli": []}),
    ):
        made = plain_data(record)
        assert (made, list(made)) == (expected, list(expected))
        Draft202012Validator(answer.schema(Outer)).validate(made)
