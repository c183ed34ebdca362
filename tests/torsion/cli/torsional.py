"""A case that the commands of `vstatics torsion` are tried on, and ways to call them."""

import csv
from typing import Any

from tests.commands import Said, vstatics

BOX = """\
name: two gears
links: [engine, disc, sun, ring, carrier, wheel, vehicle, casing]
output: vehicle
inertias: {engine: 0.15, disc: 0.02, sun: 0.003, carrier: 0.05, wheel: 1.2, vehicle: 4, casing: 0.4}
springs:
  damper: {links: [engine, disc], compliance: 84e-5, damping: 3.2}
  axle: {twist: {carrier: 1, wheel: -4.2, casing: 3.2}, compliance: 1.476e-2}
  tyre: {links: [wheel, vehicle], stiffness: 474}
  wind-up: {links: [casing, housing], compliance: 1.525e-2}
shift_elements:
  C: [disc, sun]
  D: [disc, carrier]
  B: [ring, casing]
  A: [engine, housing]
mechanisms:
  P: {first: sun, second: ring, third: carrier, ratio: -2}
gears:
  low: {engaged: [C, B]}
  direct: {engaged: [C, D]}
  tied: {engaged: [C, A]}
  N: {}
"""
"""A gearbox whose casing takes the reactions; its third gear holds the input."""
STUCK = """\
inertias: {a: 4, b: 1}
springs: {s: {links: [a, b], compliance: 1}}
shift_elements: {A: [a, housing], B: [b, housing]}
gears: {free: {}, stuck: {engaged: [A, B]}}
"""
"""Its second gear holds all that could move."""
GOOD = BOX.partition("gears:\n")[0] + "gears:\n  direct: {engaged: [C, D]}\n"
"""The same with one gear that nothing is wrong with."""
CHAIN = """\
inertias: {a: 4, b: 1, c: 4}
springs:
  s: {links: [a, b], compliance: 1}
  t: {links: [b, c], compliance: 0.25}
"""

ASKED: dict[str, tuple[str, ...]] = {
    "modes": (),
    "reduce": ("--to", "engine"),
    "response": ("--at", "engine", "--orders", "2,4", "--speed", "600:3000:5", "--sum"),
    "identify": ("--gear", "direct", "--omega", "5"),
    "damping": ("--gear", "direct", "--decrements", "tyre=.2"),
}
"""What commands that write tables are asked for, beside the case."""
OF_GEARS = ("modes", "reduce", "response")
"""Those that calculate several gears."""


def said(command: str, *options: object, text: str = BOX) -> Said:
    return vstatics("torsion", command, "-", *options, stdin=text.encode())


def asked(command: str, *options: object, text: str = BOX) -> Said:
    return said(command, *ASKED[command], *options, text=text)


def document(command: str, *options: object, text: str = BOX) -> Any:
    return said(command, *options, "-f", "json", text=text).json


def tables(text: str) -> dict[str, list[list[str]]]:
    found: dict[str, list[list[str]]] = {}
    heading: list[str] = []
    for name, *row in csv.reader(text.splitlines()):
        if name == "table":
            heading = row
        else:
            found.setdefault(name, [heading]).append(row)
    return found
