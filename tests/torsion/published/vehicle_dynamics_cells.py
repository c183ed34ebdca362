"""Cells of tables of Tsitovich and Algin that are wrong in print, calculated."""

import math
from collections.abc import Iterator, Sequence

from tests.torsion.book import TENTH, chain, scheme, table
from tests.torsion.test_book_vehicles import PUBLISHED, omegas_of_table_2_2, truck
from tests.torsion.test_simplification_tables import GEARS, cells_of_p1_2
from tests.torsion.vibration.test_decrements import TABLE_P2_1
from tests.torsion.vibration.test_gear_modes import omegas, only
from vstatics.torsion.reduction.chain import scheme_of
from vstatics.torsion.reduction.scheme import natural_frequencies
from vstatics.torsion.reduction.simplification import simplify

Cell = tuple[tuple[str, str], float]
"""Table and cell, as the page calls them, and the number."""
AXLE: list[dict[int, float]] = [
    {1: 1, 2: -1}, {2: 1, 3: -1}, {3: 1, 4: -1}, {4: 1, 5: -1, 7: -1}, {5: 1, 6: -1}, {7: 1},
]  # fmt: skip
"""A chain of six masses; the fourth spring bears against the casing, mass 7."""
ALLISON = {
    "I": ((0.99, 0.592, 0.0243, 0.0195, 0.486, 35.1, 0.22), (6.17, 14.9, 81, 1335, 215, 218)),
    "VI": ((0.87, 0.73, 2.53, 0.545, 13.6, 983, 6.15), (2.17, 2.05, 2.89, 47.8, 7.96, 7.8)),
}
"""Tables 2.7 and 2.8: J''1, J2 to J6, J_p; E; the pump side J'1 is 6.42."""
BELAZ_III = (3.34, 36.9 + 9.86, 9.67, 8.02, 59.7, 2080), (0.204, 0.0956, 0.104, 4.42, 0.76)
"""Table 2.9, gear III, with its shifted columns put back, the converter open."""
BELAZ_II = (3.34, 20.06, 0.997, 1.95, 14.5, 495), (0.291, 0.244, 0.467, 18.1, 3.1)
"""The same of gear II."""


def axle(inertias: Sequence[float], compliances: Sequence[float]) -> tuple[float, ...]:
    """Frequencies of `AXLE` by J*10 and E*10^5."""
    springs = [
        {"twist": twist, "compliance": compliance}
        for twist, compliance in zip(AXLE, compliances, strict=True)
    ]
    return natural_frequencies(scheme([one * TENTH for one in inertias], springs, 1e-5))


def numbered(name: str, cell: str, omegas: Sequence[float]) -> Iterator[Cell]:
    for number, omega in enumerate(omegas, 1):
        yield (name, f"{cell}, {number}"), omega


def moskvich() -> Iterator[Cell]:
    """Tables 2.5 and 2.6."""
    for state, gear, found in omegas_of_table_2_2():
        yield from numbered("2.5", f"{state} {GEARS[gear]}", found)
    links = table("table_2_6")
    for state, first in links["damper"].items():
        for name, inertias, rest in zip(
            GEARS, links["inertias"], links["compliances"], strict=False
        ):
            given = scheme_of(chain(inertias, [first, *rest]))
            yield ("2.6", f"{state} {name}"), simplify(given, 1).steps[-1].omegas[0]


def vehicles() -> Iterator[Cell]:
    """Table 2.10."""
    for name, of in PUBLISHED.items():
        for gear, _ in enumerate(of["J_p"]):
            yield from numbered("2.10", f"{name} {GEARS[gear]}", omegas(only(truck(name, gear))))
    for letter, ((turbine, *behind), springs) in ALLISON.items():
        for state, first in (("locked", 6.42 + turbine), ("open", turbine)):
            found = axle([first, *behind], springs)
            yield from numbered("2.10", f"Allison {state} {letter}", found)
    for roman, given in (("II", BELAZ_II), ("III", BELAZ_III)):
        found = natural_frequencies(scheme_of(chain(*given)))
        yield from numbered("2.10", f"BelAZ-540 open {roman}", found)


def appendices() -> Iterator[Cell]:
    """Tables P1.2 and P2.1."""
    for (name, rule, count, mode), omega, _ in cells_of_p1_2():
        yield ("P1.2", f"{name}, {rule}, {count} masses, {mode}"), omega
    for gear, given in TABLE_P2_1.items():
        first, second, third = given.inertias
        inertia = 1 / (1 / (first + second) + 1 / third)
        yield ("P2.1", f"omega {gear}"), 1 / math.sqrt(inertia * given.compliance)
        yield ("P2.1", f"K {gear}"), inertia * given.decrement * given.measured / math.pi


def cells() -> dict[tuple[str, str], float]:
    return dict([*moskvich(), *vehicles(), *appendices()])
