"""Reduced inertias and compliances, and steps to a simpler scheme, as tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from vstatics.core.tables.grid import Grid, Values, exact, grid_of
from vstatics.torsion.reduction.reduced_values import Amounts, GearReduction
from vstatics.torsion.reduction.simplification import Simplification


def reduction_grids(to: str, gears: Sequence[GearReduction]) -> Iterator[Grid]:
    """A row for each link or device, a column for each gear.

    Examples
    --------
    >>> one = GearReduction("1", {"a": 0.5}, {"s": 0.04}, {"a": 2.0}, {"a": ["b", "c"]}, {})
    >>> [grid.key for grid in reduction_grids("a", [one])]
    ['inertias', 'compliances', 'ratios', 'notes']
    """
    for title, heading, by_gear in (
        (f"Inertias reduced to {to} [kg*m^2]", "link", [one.inertias for one in gears]),
        (f"Compliances reduced to {to} [rad/(N*m)]", "device", [one.compliances for one in gears]),
        (f"Ratios w_{to}/w_link", "link", [one.ratios for one in gears]),
    ):
        yield _by_gear(title, heading, gears, by_gear)
    notes = [
        (gear.name, first, f"rigidly joined: {', '.join(others)}")
        for gear in gears
        for first, others in gear.merged.items()
    ]
    notes += [(gear.name, link, note) for gear in gears for link, note in gear.notes.items()]
    notes += [(gear.name, "", gear.error) for gear in gears if gear.error]
    if notes:
        yield grid_of("Notes", ["gear", "link", "note"], notes, key="notes")


def _by_gear(
    title: str, heading: str, gears: Sequence[GearReduction], by_gear: Sequence[Amounts]
) -> Grid:
    names = dict.fromkeys(name for amounts in by_gear for name in amounts)
    rows: list[Values] = [
        (name, *(exact(amounts.get(name), 4) for amounts in by_gear)) for name in names
    ]
    headings = heading, *(gear.name for gear in gears)
    return grid_of(title, headings, rows, key=title.split(maxsplit=1)[0].lower())


def simplification_grids(found: Simplification) -> Iterator[Grid]:
    """What each step takes out and what frequencies remain; then the masses and springs left.

    Examples
    --------
    >>> from vstatics.torsion.reduction.scheme import SchemeSpring, TorsionScheme
    >>> from vstatics.torsion.reduction.simplification import simplify
    >>> springs = SchemeSpring("s", {0: 1, 1: -1}, 1.0), SchemeSpring("t", {1: 1, 2: -1}, 0.25)
    >>> left = simplify(TorsionScheme(("a", "b", "c"), (4.0, 1.0, 4.0), springs), 1)
    >>> [grid.title for grid in simplification_grids(left)]
    ['Steps, by rule partial', 'Masses', 'Springs']
    """
    most = max((len(step.omegas) for step in found.steps), default=0)
    headings = ["partial [rad/s]", *(f"omega {n} [rad/s]" for n in range(1, most + 1))]
    rows = [
        (step.operation, step.partial_frequency, *step.omegas, *[None] * (most - len(step.omegas)))
        for step in found.steps
    ]
    title = f"Steps, by rule {found.rule}" + ": none" * (not rows)
    yield grid_of(title, ["step", *headings], rows, key="steps")
    scheme = found.scheme
    inertias = (exact(inertia, 6) for inertia in scheme.inertias)
    masses = zip(scheme.names, inertias, strict=True)
    yield grid_of("Masses", ["link", "inertia [kg*m^2]"], masses, key="masses")
    springs = (
        (spring.name, _form(spring.twist, scheme.names), exact(spring.compliance, 6))
        for spring in scheme.springs
    )
    headings = ["spring", "twist", "compliance [rad/(N*m)]"]
    yield grid_of("Springs", headings, springs, key="springs")


def _form(twist: Mapping[int, float], names: Sequence[str]) -> str:
    """A twist by the angles of masses.

    >>> _form({0: 1.0, 2: -2.5}, ["a", "b", "c"])
    '1*a -2.5*c'
    """
    parts = (f"{part:+.4g}*{names[mass]}" for mass, part in twist.items())
    return " ".join(parts).removeprefix("+")
