"""Results to be written, and what was written read again."""

import csv
import io
import json
from typing import Any

from vstatics import Gear, Mechanism, Results, ShiftElement, Transmission
from vstatics.core.writers import result_csv, result_json

NAMED = Transmission(
    links=4,
    link_names=["engine", "ring gear", "output", "motor"],
    shift_elements=[ShiftElement(2, 0, "Bremse"), ShiftElement(1, 2, "clutch, direct")],
    mechanisms=[
        Mechanism(1, 2, 3, -2.5, 0.96, name="planetary set"),
        Mechanism(4, 2, 0, -3.0, 0.98, name="motor pair"),
    ],
    gears=[
        Gear([1], name="low"),
        Gear(speeds={4: 0.75}, torques={2: -0.125}, name="split"),
        Gear([2], input=3, output=1, name="tow"),
        Gear(name="N"),
    ],
    output=3,
    name="named train",
)
"""A differential whose ring is braked, clutched, or turned by a motor."""


def parsed(results: Results) -> dict[str, Any]:
    """A result written as JSON and read again; NaN and the like are refused."""

    def refuse(word: str) -> None:
        raise ValueError(word)

    text = result_json.text(result_json.document(results))
    found: dict[str, Any] = json.loads(text, parse_constant=refuse)
    return found


def table(text: str, index_list: str) -> list[str]:
    """The lines of a printed table."""
    rest = text.split(index_list + "\n")[1]
    return rest.split("\n\n")[0].splitlines()


def csv_of(results: Results) -> list[list[str]]:
    return list(csv.reader(io.StringIO(result_csv.write(results))))
