"""A scheme as a case: links, inertias, springs and one gear."""

from __future__ import annotations

from collections.abc import Sequence

from vstatics.model.springs import Spring
from vstatics.model.transmission import Gear, Transmission
from vstatics.torsion.scheme import TorsionScheme


def scheme_case(scheme: TorsionScheme, name: str, ends: Sequence[str], gear: str) -> Transmission:
    """A case that vibrates as a scheme does, on its reference shaft.

    Parameters
    ----------
    scheme : TorsionScheme
    name : str
        Of the case.
    ends : sequence of str
        The links of input and output, as far as masses are named after them.
    gear : str
        The name of its gear.

    Examples
    --------
    >>> from vstatics.torsion.scheme import SchemeSpring
    >>> springs = (SchemeSpring("s", {0: 1.0, 1: -1.0}, 0.5),)
    >>> case = scheme_case(TorsionScheme(("a+b", "c"), (1.0, 2.0), springs), "", ("b", "c"), "1")
    >>> case.link_name(case.input), case.link_name(case.output), case.springs[0].compliance
    ('a+b', 'c', 0.5)
    """
    first, last = (_mass_of(scheme.names, end) for end in ends)
    masses = range(1, len(scheme.names) + 1)
    others = [mass for mass in reversed(masses) if mass != first]
    output = last if last not in (None, first) else next(iter(others), 1)
    return Transmission(
        len(scheme.names),
        [],
        [],
        [Gear(name=gear)],
        input=first or next((mass for mass in masses if mass != output), 1),
        output=output or 0,
        name=name,
        link_names=scheme.names,
        inertias={mass: scheme.inertias[mass - 1] for mass in masses},
        springs=[
            Spring(
                {mass + 1: part for mass, part in spring.twist.items()},
                compliance=spring.compliance,
                damping=spring.damping,
                name=spring.name,
            )
            for spring in scheme.springs
        ],
    )


def _mass_of(names: Sequence[str], link: str) -> int | None:
    """The number of the mass that a link is part of."""
    found = (n for n, name in enumerate(names, 1) if link in (name, *name.split("+")))
    return next(found, None)
