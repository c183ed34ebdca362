"""A scheme with fewer natural frequencies, step by step: the lowest ones hardly change.

Each step takes out the partial system with the highest frequency. Chains go by systems of one
and of two masses (`chain_simplification`), schemes with branches by systems of one mass
(`branch_simplification`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple, get_args

from vstatics.errors import CaseError, Problem, listed, nearest, spoken
from vstatics.numerics.tolerances import TIE
from vstatics.torsion.branch_simplification import (
    BranchRule,
    acted_on_by_several,
    one_mass_systems,
    without_branch_mass,
)
from vstatics.torsion.chain import (
    Chain,
    PartialSystem,
    chain_of,
    one_mass_system,
    partial_systems,
    scheme_of,
)
from vstatics.torsion.chain_simplification import with_masses_merged, without_mass
from vstatics.torsion.condensation import tidied, without_massless
from vstatics.torsion.scheme import TorsionScheme, natural_frequencies, stiffness_matrix

SimplificationRule = Literal["partial", "r", "b", "u"]
"""By partial systems of one and two masses; by those of one, and how their inertia is shared."""
SIMPLIFICATION_RULES: tuple[SimplificationRule, ...] = get_args(SimplificationRule)
ACCURATE = 0.5
"""Of a partial frequency: what is below it stays right to 5 % in most cases, (П1.8)."""


class SimplificationStep(NamedTuple):
    """What is taken out of a scheme, and what is left then."""

    operation: str
    partial_frequency: float
    """Of the system that is taken out. [rad/s]"""
    names: tuple[str, ...]
    """Of the masses, in the order of the chain, or of the case."""
    inertias: tuple[float, ...]
    """[kg*m^2]"""
    compliances: tuple[float, ...] | None
    """Of a chain, in its order. [rad/(N*m)]"""
    stiffness: tuple[tuple[float, ...], ...] | None
    """The matrix, by the other rules than `partial`. [N*m/rad]"""
    omegas: tuple[float, ...]
    """Natural frequencies, ascending. [rad/s]"""


class Simplification(NamedTuple):
    """Steps from a scheme to a simpler one."""

    rule: SimplificationRule
    steps: tuple[SimplificationStep, ...]
    scheme: TorsionScheme
    """What is left: its masses all have inertia."""
    warnings: tuple[Problem, ...]


class _SchemeReached(NamedTuple):
    """A scheme on the way, and how it came about."""

    system: PartialSystem
    scheme: TorsionScheme


def simplify(
    scheme: TorsionScheme,
    frequencies: int,
    rule: SimplificationRule | None = None,
    remove: Sequence[str] = (),
) -> Simplification:
    """Take out one partial system after another until so many natural frequencies are left.

    Masses without inertia are taken out first, which changes nothing and is no step.

    Parameters
    ----------
    scheme : TorsionScheme
    frequencies : int
        How many natural frequencies remain, those of rigid motions not counted.
    rule : {"partial", "r", "b", "u"}, optional
        `partial` for a chain, else `r`, when not given. The system with the highest frequency
        is taken out; of several within 1e-9, one of one mass, then the first. By the rules for
        branched schemes a mass that one device alone acts on stays.
    remove : sequence of str
        Names of masses that are taken out first, in this order, in place of the rule's choice.

    Raises
    ------
    CaseError
        A number of frequencies that the scheme can't come down to, names that it does not
        have, the rule `partial` for a scheme that is no chain.

    Examples
    --------
    >>> from vstatics.torsion.scheme import SchemeSpring
    >>> springs = SchemeSpring("s", {0: 1, 1: -1}, 1.0), SchemeSpring("t", {1: 1, 2: -1}, 0.25)
    >>> found = simplify(TorsionScheme(("a", "b", "c"), (4.0, 1.0, 4.0), springs), 1)
    >>> [step] = found.steps
    >>> step.operation, round(step.partial_frequency, 3), step.inertias, step.compliances
    ('remove b', 2.236, (4.2, 4.8), (1.25,))
    """
    chain = chain_of(scheme)
    is_chain = isinstance(chain, Chain)
    rule = rule or ("partial" if is_chain else "r")
    given = scheme_of(chain) if isinstance(chain, Chain) else tidied(scheme)
    steps = len(natural_frequencies(given)) - frequencies
    if problems := [*_problems(scheme, frequencies, steps, remove)]:
        raise CaseError(problems)
    if rule != "partial":
        stages = [*_by_masses(given, steps, rule, remove)]
    elif isinstance(chain, Chain):
        stages = [*_by_partial_systems(chain, steps, remove)]
    else:
        message = f"read rule `partial`, expected r, b or u: the scheme is no chain, {chain}"
        raise CaseError([Problem(message)])
    found = tuple(_step(stage, rule, is_chain=is_chain) for stage in stages)
    left = without_massless(stages[-1].scheme if stages else given)
    return Simplification(rule, found, left, tuple(_warnings(found)))


def _by_partial_systems(
    chain: Chain, steps: int, remove: Sequence[str]
) -> Iterator[_SchemeReached]:
    """The stages of a chain by systems of one and of two masses."""
    for step in range(steps):
        if step < len(remove):
            system = one_mass_system(chain, chain.names.index(remove[step]))
        else:
            system = _highest(partial_systems(chain))
        one, *other = system.masses
        chain = with_masses_merged(chain, one) if other else without_mass(chain, one)
        yield _SchemeReached(system, scheme_of(chain))


def _by_masses(
    scheme: TorsionScheme, steps: int, rule: BranchRule, remove: Sequence[str]
) -> Iterator[_SchemeReached]:
    """The stages of any scheme by systems of one mass."""
    for step in range(steps):
        systems = one_mass_systems(scheme)
        if step < len(remove):
            system = next(one for one in systems if one.names == (remove[step],))
        else:
            system = _highest(_inner(scheme, systems))
        [mass] = system.masses
        if not system.frequency:
            message = f"`{system.names[0]}` can't be removed: no device acts on it"
            raise CaseError([Problem(message)])
        scheme = without_branch_mass(scheme, mass, rule)
        yield _SchemeReached(system, scheme)


def _inner(scheme: TorsionScheme, systems: Sequence[PartialSystem]) -> list[PartialSystem]:
    """The systems that a rule may take out."""
    inner = [one for one in systems if acted_on_by_several(scheme, one.masses[0])]
    if not inner:
        message = (
            "no link is left that a rule removes: one device alone acts on each of "
            f"{listed([one.names[0] for one in systems])}; name those to remove"
        )
        raise CaseError([Problem(message)])
    return inner


def _highest(systems: Sequence[PartialSystem]) -> PartialSystem:
    """The system with the highest frequency; at a tie the first."""
    highest = max(system.frequency for system in systems)
    return next(one for one in systems if one.frequency >= highest * (1 - TIE))


def _step(stage: _SchemeReached, rule: SimplificationRule, *, is_chain: bool) -> SimplificationStep:
    """What is told of a stage."""
    system, scheme = stage
    heavy = without_massless(scheme)
    verb = "remove" if len(system.names) == 1 else "merge"
    return SimplificationStep(
        f"{verb} {spoken(system.names)}",
        system.frequency,
        heavy.names,
        heavy.inertias,
        tuple(spring.compliance for spring in heavy.springs) if is_chain else None,
        None if rule == "partial" else tuple(map(tuple, stiffness_matrix(heavy).tolist())),
        natural_frequencies(heavy),
    )


def _problems(
    scheme: TorsionScheme, frequencies: int, steps: int, remove: Sequence[str]
) -> Iterator[Problem]:
    """What is wrong with what is asked for."""
    most = frequencies + steps
    if not 1 <= frequencies <= most:
        expected = f"expected 1 to {most}" if most else "but the scheme has none"
        noun = "frequency" if frequencies == 1 else "frequencies"
        yield Problem(f"read {frequencies} natural {noun} to remain, {expected}")
    elif len(remove) > steps:
        yield Problem(
            f"read {len(remove)} links to remove, expected {steps} at most, so that {frequencies} "
            f"of {most} natural frequencies remain"
        )
    inertias = dict(zip(scheme.names, scheme.inertias, strict=True))
    for place, name in enumerate(remove):
        if name not in inertias:
            hint = nearest(name, inertias)
            yield Problem(f"read `{name}` to remove, expected a link of the scheme{hint}")
        elif name in remove[:place]:
            yield Problem(f"read `{name}` to remove, which is removed before")
        elif not inertias[name]:
            yield Problem(f"read `{name}` to remove, expected a link with inertia")


def _warnings(steps: Sequence[SimplificationStep]) -> Iterator[Problem]:
    """A kept frequency is too near to one that was taken out, (П1.8)."""
    if not steps:
        return
    lowest = min(steps, key=lambda step: step.partial_frequency)
    kept, partial = steps[-1].omegas[-1], lowest.partial_frequency
    if kept > ACCURATE * partial:
        yield Problem(
            f"{kept:.4g} rad/s is kept, more than half of the partial frequency {partial:.4g} "
            f"rad/s that is taken out ({lowest.operation}): it may be more than 5 % off",
            severity="warning",
        )
