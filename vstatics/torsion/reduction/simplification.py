"""A scheme with fewer natural frequencies, step by step: the lowest ones hardly change.

Each step takes out the partial system with the highest frequency. Chains go by systems of one
and of two masses (`chain_simplification`), schemes with branches by systems of one mass
(`branch_simplification`).

Chains with one mass less, by the method of partial frequencies.

Tsitovich and Algin, Vehicle dynamics (1981), appendix П1.2: a partial system of one mass becomes
one of two masses with the same frequency and its node at the mass, (П1.4), or the other way
round, (П1.5). Springs and inertias that come to stand beside each other are added, so the sums of
both stay as they were. A compliance at a free end, and an inertia on the housing, do nothing.

Schemes of any shape with one mass less, by static condensation.

Tsitovich and Algin, Vehicle dynamics (1981), appendix П1.2: the mass of the system of one mass
with the highest partial frequency is taken out. K - Kj Kj^T / Kjj is left of the stiffness
matrix, and a part of its inertia goes to the masses that it is joined with.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Literal, NamedTuple, get_args

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError, Problem, listed, spoken
from vstatics.core.numerics.tolerances import TIE
from vstatics.core.suggestions import nearest
from vstatics.core.tables.numbers import certain
from vstatics.torsion.reduction.chain import (
    Chain,
    ChainSpring,
    PartialSystem,
    chain_of,
    one_mass_system,
    partial_systems,
    scheme_of,
)
from vstatics.torsion.reduction.condensation import tidied, without_massless
from vstatics.torsion.reduction.scheme import TorsionScheme, natural_frequencies, stiffness_matrix

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


SchemeReached = tuple[PartialSystem, TorsionScheme]
"""A system that is taken out, and the scheme then."""


@refusing()
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

    Returns
    -------
    Simplification
        The steps, and what is left: inertias [kg*m^2], compliances [rad/(N*m)].

    Raises
    ------
    CaseError
        A number of frequencies that the scheme can't come down to, names that it does not
        have, the rule `partial` for a scheme that is no chain.

    Examples
    --------
    >>> from vstatics.torsion.reduction.scheme import SchemeSpring
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
        raise CaseError("E506", message)
    found = tuple(step_of(stage, rule, is_chain=is_chain) for stage in stages)
    left = without_massless(stages[-1][1] if stages else given)
    return Simplification(rule, found, left, tuple(doubts_of(found, found[-1:])))


def _by_partial_systems(chain: Chain, steps: int, remove: Sequence[str]) -> Iterator[SchemeReached]:
    """The stages of a chain by systems of one and of two masses."""
    for step in range(steps):
        if step < len(remove):
            system = one_mass_system(chain, chain.names.index(remove[step]))
        else:
            system = _highest(partial_systems(chain))
        one, *other = system.masses
        chain = with_masses_merged(chain, one) if other else without_mass(chain, one)
        yield system, scheme_of(chain)


def _by_masses(
    scheme: TorsionScheme, steps: int, rule: BranchRule, remove: Sequence[str]
) -> Iterator[SchemeReached]:
    """The stages of any scheme by systems of one mass."""
    for step in range(steps):
        systems = one_mass_systems(scheme)
        if step < len(remove):
            system = next(one for one in systems if one.names == (remove[step],))
        else:
            system = _highest(_inner(scheme, systems))
        [mass] = system.masses
        if not system.frequency:
            raise CaseError("E507", f"`{system.names[0]}` can't be removed: no device acts on it")
        scheme = without_branch_mass(scheme, mass, rule)
        yield system, scheme


def _inner(scheme: TorsionScheme, systems: Sequence[PartialSystem]) -> list[PartialSystem]:
    """The systems that a rule may take out."""
    inner = [one for one in systems if acted_on_by_several(scheme, one.masses[0])]
    if not inner:
        raise CaseError(
            "E508",
            "no link is left that a rule removes: one device alone acts on each of "
            f"{listed([one.names[0] for one in systems])}; name those to remove",
        )
    return inner


def _highest(systems: Sequence[PartialSystem]) -> PartialSystem:
    """The system with the highest frequency; at a tie the first."""
    highest = max(system.frequency for system in systems)
    return next(one for one in systems if one.frequency >= highest * (1 - TIE))


def step_of(
    stage: SchemeReached, rule: SimplificationRule, *, is_chain: bool
) -> SimplificationStep:
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
        to = f" to {most}" if most > 1 else ""
        expected = f"expected 1{to}: the scheme has {most}" if most else "but the scheme has none"
        noun = "frequency" if frequencies == 1 else "frequencies"
        message = f"read {frequencies} natural {noun} to remain (--links), {expected}"
        yield Problem("E509", message)
    elif len(remove) > steps:
        yield Problem(
            "E510",
            f"read {len(remove)} links to remove, expected {steps} at most, so that {frequencies} "
            f"of {most} natural frequencies remain",
        )
    inertias = dict(zip(scheme.names, scheme.inertias, strict=True))
    for place, name in enumerate(remove):
        if name not in inertias:
            hint = nearest(name, inertias)
            yield Problem("E511", f"read `{name}` to remove, expected a link of the scheme{hint}")
        elif name in remove[:place]:
            yield Problem("E512", f"read `{name}` to remove, which is removed before")
        elif not inertias[name]:
            yield Problem("E513", f"read `{name}` to remove, expected a link with inertia")


def doubts_of(
    steps: Sequence[SimplificationStep], last: Sequence[SimplificationStep]
) -> Iterator[Problem]:
    """A frequency that the last step keeps is too near to one that was taken out, (П1.8)."""
    if not steps:
        return
    lowest = min(steps, key=lambda step: certain(step.partial_frequency))
    kept, partial = last[-1].omegas[-1], lowest.partial_frequency
    if kept > ACCURATE * partial:
        yield Problem(
            "W501",
            f"{kept:.4g} rad/s is kept, more than half of the partial frequency {partial:.4g} "
            f"rad/s that is taken out ({lowest.operation}): it may be more than 5 % off",
        )


def without_mass(chain: Chain, mass: int) -> Chain:
    """One mass gives way to a spring: its inertia goes to its neighbours, (П1.4).

    Each gets the part that the stiffness towards it has in both. At a free end the neighbour
    gets all, and the spring is gone.

    Parameters
    ----------
    chain : Chain
    mass : int
        Its number along the chain, from 0.

    Examples
    --------
    >>> three = Chain(("a", "b", "c"), (4, 1, 4), (ChainSpring("s", 1), ChainSpring("t", 0.25)))
    >>> without_mass(three, 1)[1:]
    ((4.2, 4.8), (ChainSpring(name='s+t', compliance=1.25, damping=0.0),))
    """
    inertias = list(chain.inertias)
    around = slice(max(mass - 1, 0), mass + 1)
    match chain.springs[around]:
        case [left, right]:
            joined = [_longer(left, right)._replace(name=f"{left.name}+{right.name}")]
            inertias[mass - 1] += inertias[mass] * right.compliance / joined[0].compliance
            inertias[mass + 1] += inertias[mass] * left.compliance / joined[0].compliance
        case _:
            joined = []
            inertias[1 if mass == 0 else mass - 1] += inertias[mass]
    return Chain(
        chain.names[:mass] + chain.names[mass + 1 :],
        tuple(inertias[:mass] + inertias[mass + 1 :]),
        (*chain.springs[: around.start], *joined, *chain.springs[around.stop :]),
    )


def with_masses_merged(chain: Chain, left: int) -> Chain:
    """A mass and the next one become one: the spring between them goes to those beside, (П1.5).

    Each takes the part that the farther inertia has in both; at a free end it is gone.

    Parameters
    ----------
    chain : Chain
    left : int
        The number of the first of both along the chain, from 0.

    Examples
    --------
    >>> three = Chain(("a", "b", "c"), (3, 1, 4), (ChainSpring("s", 1), ChainSpring("t", 0.25)))
    >>> with_masses_merged(three, 0)
    Chain(names=('a+b', 'c'), inertias=(4, 4), springs=(ChainSpring(name='t', compliance=1.0, damping=0.0),))
    """  # noqa: E501
    one, two = chain.inertias[left : left + 2]
    between, springs = chain.springs[left], list(chain.springs)
    if left > 0:
        springs[left - 1] = _longer(springs[left - 1], between, two / (one + two), 0.5)
    if left + 1 < len(springs):
        springs[left + 1] = _longer(springs[left + 1], between, one / (one + two), 0.5)
    del springs[left]
    rest = slice(left + 2, None)
    return Chain(
        (*chain.names[:left], "+".join(chain.names[left : left + 2]), *chain.names[rest]),
        (*chain.inertias[:left], one + two, *chain.inertias[rest]),
        tuple(springs),
    )


def _longer(
    spring: ChainSpring, other: ChainSpring, part: float = 1.0, damped: float = 1.0
) -> ChainSpring:
    """A spring in a row with a part of another one, which carry one torque; damping by (П1.14).

    Where the other is divided, by (П1.15), both parts of it dissipate the same at the same torque:
    (П1.15) in (П1.16) leaves K/2 of it, times the square of its own compliance by that of the sum,
    however small the part is.
    """
    compliance = spring.compliance + part * other.compliance
    damping = spring.damping * (spring.compliance / compliance) ** 2
    damping += damped * other.damping * (other.compliance / compliance) ** 2
    return ChainSpring(spring.name, compliance, damping)


BranchRule = Literal["r", "b", "u"]
"""How the inertia of a mass is shared out."""

_SHARES: dict[BranchRule, Callable[[float], float]] = {
    "r": lambda part: part,  # (П1.7), which the book recommends
    "b": lambda part: part**2,  # (П1.6), of Banakh
    "u": lambda _: 0.0,
}
"""What a mass gets of the inertia, by its part |Kij|/Kjj of the stiffness."""


def one_mass_systems(scheme: TorsionScheme) -> list[PartialSystem]:
    """Each mass with all others held: sqrt(Kjj/Jj), K and J without the massless ones.

    Parameters
    ----------
    scheme : TorsionScheme
        Masses without inertia are where springs meet.

    Returns
    -------
    list of PartialSystem
        In the order of the scheme.
    """
    heavy = without_massless(scheme)
    stiffness = stiffness_matrix(heavy).diagonal().tolist()
    number = {name: mass for mass, name in enumerate(scheme.names)}
    return [
        PartialSystem((number[name],), (name,), math.sqrt(own / inertia))
        for name, inertia, own in zip(heavy.names, heavy.inertias, stiffness, strict=True)
    ]


def acted_on_by_several(scheme: TorsionScheme, mass: int) -> bool:
    """Whether more than one device acts on a mass: it is no end of the scheme."""
    return sum(mass in spring.twist for spring in scheme.springs) > 1


def without_branch_mass(scheme: TorsionScheme, mass: int, rule: BranchRule) -> TorsionScheme:
    """The scheme without the inertia of one mass, a part of which others get.

    The mass stays as a place without inertia where three springs or more meet: so the scheme
    keeps its shape, and it is still seen which device acts on which mass.

    Parameters
    ----------
    scheme : TorsionScheme
    mass : int
        Its number, from 0.
    rule : {"r", "b", "u"}

    Examples
    --------
    >>> from vstatics.torsion.reduction.scheme import SchemeSpring
    >>> springs = SchemeSpring("s", {0: 1, 1: -1}, 1.0), SchemeSpring("t", {1: 1, 2: -1}, 1/3)
    >>> three = TorsionScheme(("a", "b", "c"), (4.0, 2.0, 4.0), springs)
    >>> [without_branch_mass(three, 1, rule).inertias for rule in ("r", "b", "u")]
    [(4.5, 5.5), (4.125, 5.125), (4.0, 4.0)]
    """
    heavy = without_massless(scheme)
    own = heavy.names.index(scheme.names[mass])
    column = stiffness_matrix(heavy)[own].tolist()
    inertias = dict(zip(scheme.names, scheme.inertias, strict=True))
    for name, stiffness in zip(heavy.names, column, strict=True):
        if name != scheme.names[mass]:
            inertias[name] += scheme.inertias[mass] * _SHARES[rule](abs(stiffness) / column[own])
    inertias[scheme.names[mass]] = 0.0
    return tidied(scheme._replace(inertias=tuple(inertias.values())))
