"""Tables of reduced inertias and compliances, and of the steps of a simplification."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from vstatics.core.tables.grid import Grid, Values, exact, grid_of
from vstatics.torsion.reduction.reduced_values import GearReduction
from vstatics.torsion.reduction.simplification import Simplification


def reduction_grids(to: str, gears: Sequence[GearReduction]) -> Iterator[Grid]:
    """Yield tables of reduced values, with a row for each link or component.

    Examples
    --------
    >>> gear = GearReduction("1", {"a": 0.5}, {"s": 0.04}, {"a": 2.0}, {"a": ["b", "c"]}, {})
    >>> [grid.key for grid in reduction_grids("a", [gear])]
    ['inertias', 'compliances', 'ratios', 'notes']
    """
    for title, heading, by_gear in (
        (f"Inertias reduced to {to} [kg*m^2]", "link", [gear.inertias for gear in gears]),
        (
            f"Compliances reduced to {to} [rad/(N*m)]",
            "component",
            [gear.compliances for gear in gears],
        ),
        (f"Ratios w_{to}/w_link", "link", [gear.ratios for gear in gears]),
    ):
        names = dict.fromkeys(name for amounts in by_gear for name in amounts)
        rows: list[Values] = [
            (name, *(exact(amounts.get(name), 4) for amounts in by_gear)) for name in names
        ]
        yield grid_of(
            title,
            (heading, *(gear.name for gear in gears)),
            rows,
            key=title.split(maxsplit=1)[0].lower(),
        )
    notes = [
        (gear.name, first, f"rigidly joined: {', '.join(others)}")
        for gear in gears
        for first, others in gear.merged.items()
    ]
    notes += [(gear.name, link, note) for gear in gears for link, note in gear.notes.items()]
    notes += [(gear.name, "", gear.error) for gear in gears if gear.error]
    if notes:
        yield grid_of("Notes", ["gear", "link", "note"], notes, key="notes")


def simplification_grids(simplification: Simplification) -> Iterator[Grid]:
    """Yield tables of the steps, the remaining masses and the remaining springs.

    Examples
    --------
    >>> from vstatics.torsion.reduction.scheme import SchemeSpring, TorsionScheme
    >>> from vstatics.torsion.reduction.simplification import simplify
    >>> springs = SchemeSpring("s", {0: 1, 1: -1}, 1.0), SchemeSpring("t", {1: 1, 2: -1}, 0.25)
    >>> simpler = simplify(TorsionScheme(("a", "b", "c"), (4.0, 1.0, 4.0), springs), 1)
    >>> [grid.title for grid in simplification_grids(simpler)]
    ['Steps, by rule partial', 'Masses', 'Springs']
    """
    most = max((len(step.omegas) for step in simplification.steps), default=0)
    headings = ["partial [rad/s]", *(f"omega {n} [rad/s]" for n in range(1, most + 1))]
    rows = [
        (step.operation, step.partial_frequency, *step.omegas, *[None] * (most - len(step.omegas)))
        for step in simplification.steps
    ]
    title = f"Steps, by rule {simplification.rule}" + ": none" * (not rows)
    yield grid_of(title, ["step", *headings], rows, key="steps")
    scheme = simplification.scheme
    inertias = (exact(inertia, 6) for inertia in scheme.inertias)
    masses = zip(scheme.names, inertias, strict=True)
    yield grid_of("Masses", ["link", "inertia [kg*m^2]"], masses, key="masses")
    springs = (
        (spring.name, _form(spring.twist, scheme.names), exact(spring.compliance, 6))
        for spring in scheme.springs
    )
    yield grid_of("Springs", ["spring", "twist", "compliance [rad/(N*m)]"], springs, key="springs")


def _form(twist: Mapping[int, float], names: Sequence[str]) -> str:
    """Return the twist of a spring as the text of a linear form of the angles of masses.

    >>> _form({0: 1.0, 2: -2.5}, ["a", "b", "c"])
    '1*a -2.5*c'
    """
    parts = (f"{part:+.4g}*{names[mass]}" for mass, part in twist.items())
    return " ".join(parts).removeprefix("+")
