"""Steps to a simpler scheme as tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from vstatics.tables.grid import Column, Grid, Row, exact, text
from vstatics.torsion.simplification import Simplification


def simplification_grids(found: Simplification) -> Iterator[Grid]:
    """What each step takes out and what frequencies remain; then the masses and springs left.

    Examples
    --------
    >>> from vstatics.torsion.scheme import SchemeSpring, TorsionScheme
    >>> from vstatics.torsion.simplification import simplify
    >>> springs = SchemeSpring("s", {0: 1, 1: -1}, 1.0), SchemeSpring("t", {1: 1, 2: -1}, 0.25)
    >>> left = simplify(TorsionScheme(("a", "b", "c"), (4.0, 1.0, 4.0), springs), 1)
    >>> [grid.title for grid in simplification_grids(left)]
    ['Steps, by rule partial', 'Masses', 'Springs']
    """
    most = max((len(step.omegas) for step in found.steps), default=0)
    headings = ["partial [rad/s]", *(f"omega {n} [rad/s]" for n in range(1, most + 1))]
    rows: list[Row] = [
        [
            step.operation,
            exact(step.partial_frequency),
            *map(exact, (*step.omegas, *[None] * (most - len(step.omegas)))),
        ]
        for step in found.steps
    ]
    columns = [text("step"), *map(Column, headings)]
    title = f"Steps, by rule {found.rule}" + ": none" * (not rows)
    yield Grid(title, columns, rows, key="steps")
    scheme = found.scheme
    masses: list[Row] = [
        [name, exact(inertia, 6)]
        for name, inertia in zip(scheme.names, scheme.inertias, strict=True)
    ]
    yield Grid("Masses", [text("link"), Column("inertia [kg*m^2]")], masses, key="masses")
    springs: list[Row] = [
        [
            spring.name,
            _form(spring.twist, scheme.names),
            exact(spring.compliance, 6),
        ]
        for spring in scheme.springs
    ]
    heading = [text("spring"), text("twist"), Column("compliance [rad/(N*m)]")]
    yield Grid("Springs", heading, springs, key="springs")


def _form(twist: Mapping[int, float], names: Sequence[str]) -> str:
    """A twist by the angles of masses.

    >>> _form({0: 1.0, 2: -2.5}, ["a", "b", "c"])
    '1*a -2.5*c'
    """
    parts = (f"{part:+.4g}*{names[mass]}" for mass, part in twist.items())
    return " ".join(parts).removeprefix("+")
