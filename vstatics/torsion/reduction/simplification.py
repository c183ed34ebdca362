"""Simplification of a scheme: fewer masses with nearly unchanged lowest natural frequencies.

Each step removes the partial system with the highest frequency (Tsitovich, Algin, Vehicle dynamics,
1981, appendix П1.2).

The method of partial frequencies simplifies chains. A partial system of one mass is replaced by two
masses with the same frequency and the node at the mass, (П1.4). A partial system of two masses is
replaced by a mass between two springs, (П1.5). Neighbouring springs and inertias are then added, so
that the sums of compliances and of inertias do not change. A compliance at a free end and an
inertia on the housing have no effect and are dropped.

Static condensation simplifies branched schemes. It removes the mass whose partial system has the
highest frequency. The stiffness matrix becomes K - Kj Kj^T / Kjj, and neighbouring masses receive
some of the inertia.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Literal, NamedTuple, get_args

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError, Problem, count_of, listed, spoken
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
"""`partial`: partial frequencies, for chains; otherwise condensation by a `BranchRule`."""
SIMPLIFICATION_RULES: tuple[SimplificationRule, ...] = get_args(SimplificationRule)
ACCURATE = 0.5
"""Frequencies up to this fraction of a removed partial frequency are mostly accurate to 5 %. [-]

Source: (П1.8).
"""


class SimplificationStep(NamedTuple):
    """Step of a simplification, and the resulting scheme."""

    operation: str
    partial_frequency: float
    """Frequency of the removed partial system. [rad/s]"""
    names: tuple[str, ...]
    """Names of the remaining masses, in the order of the chain or of the case."""
    inertias: tuple[float, ...]
    """Inertias of the remaining masses. [kg*m^2]"""
    compliances: tuple[float, ...] | None
    """Compliances along a chain, None for a branched scheme. [rad/(N*m)]"""
    stiffness: tuple[tuple[float, ...], ...] | None
    """Stiffness matrix, None for the rule `partial`. [N*m/rad]"""
    omegas: tuple[float, ...]
    """Natural frequencies of the resulting scheme, ascending. [rad/s]"""


class Simplification(NamedTuple):
    """Simplified scheme, and the steps of the simplification."""

    rule: SimplificationRule
    steps: tuple[SimplificationStep, ...]
    scheme: TorsionScheme
    """Simplified scheme, in which all masses have inertia."""
    warnings: tuple[Problem, ...]


SchemeReached = tuple[PartialSystem, TorsionScheme]
"""Removed partial system, and the scheme after its removal."""


@refusing()
def simplify(
    scheme: TorsionScheme,
    frequencies: int,
    rule: SimplificationRule | None = None,
    remove: Sequence[str] = (),
) -> Simplification:
    """Remove partial systems step by step, until a number of natural frequencies remains.

    Masses without inertia are removed first. This is exact, and does not count as a step.

    Parameters
    ----------
    scheme : TorsionScheme
    frequencies : int
        Number of natural frequencies to keep, not counting rigid motions.
    rule : {"partial", "r", "b", "u"}, optional
        By default `partial` for a chain and `r` for other schemes. Each step removes the partial
        system with the highest frequency. If frequencies agree within 1e-9, systems of a single
        mass come first, then the order of the masses. The other rules keep masses on which a single
        spring acts.
    remove : sequence of str
        Names of masses that are removed first, in this order, instead of by the rule.

    Returns
    -------
    Simplification
        Steps and simplified scheme, with inertias [kg*m^2] and compliances [rad/(N*m)].

    Raises
    ------
    CaseError
        If the number of frequencies is out of range, a name is not the name of a mass, or the
        rule is `partial` and the system is not a chain.

    Examples
    --------
    >>> from vstatics.torsion.reduction.scheme import SchemeSpring
    >>> springs = SchemeSpring("s", {0: 1, 1: -1}, 1.0), SchemeSpring("t", {1: 1, 2: -1}, 0.25)
    >>> simpler = simplify(TorsionScheme(("a", "b", "c"), (4.0, 1.0, 4.0), springs), 1)
    >>> [step] = simpler.steps
    >>> step.operation, round(step.partial_frequency, 3), step.inertias, step.compliances
    ('remove b', 2.236, (4.2, 4.8), (1.25,))
    """
    chain = chain_of(scheme)
    is_chain = isinstance(chain, Chain)
    rule = rule or ("partial" if is_chain else "r")
    given = scheme_of(chain) if isinstance(chain, Chain) else tidied(scheme)
    count = len(natural_frequencies(given)) - frequencies
    if problems := [*_problems(scheme, frequencies, count, remove)]:
        raise CaseError(problems)
    if rule != "partial":
        stages = [*_by_masses(given, count, rule, remove)]
    elif isinstance(chain, Chain):
        stages = [*_by_partial_systems(chain, count, remove)]
    else:
        message = f"read rule `partial`, expected r, b or u: the system is not a chain, {chain}"
        raise CaseError("E506", message)
    described = tuple(step_of(stage, rule, is_chain=is_chain) for stage in stages)
    final = without_massless(stages[-1][1] if stages else given)
    return Simplification(rule, described, final, tuple(doubts_of(described, described[-1:])))


def _by_partial_systems(chain: Chain, steps: int, remove: Sequence[str]) -> Iterator[SchemeReached]:
    for step in range(steps):
        if step < len(remove):
            system = one_mass_system(chain, chain.names.index(remove[step]))
        else:
            system = _highest(partial_systems(chain))
        mass, *neighbour = system.masses
        chain = with_masses_merged(chain, mass) if neighbour else without_mass(chain, mass)
        yield system, scheme_of(chain)


def _by_masses(
    scheme: TorsionScheme, steps: int, rule: BranchRule, remove: Sequence[str]
) -> Iterator[SchemeReached]:
    for step in range(steps):
        systems = one_mass_systems(scheme)
        if step < len(remove):
            system = next(s for s in systems if s.names == (remove[step],))
        else:
            inner = [system for system in systems if acted_on_by_several(scheme, system.masses[0])]
            if not inner:
                raise CaseError(
                    "E508",
                    "the rule can remove no further link, because only one component acts on each "
                    f"of {listed([system.names[0] for system in systems])}; name the links to "
                    "remove with --remove",
                )
            system = _highest(inner)
        [mass] = system.masses
        if not system.frequency:
            raise CaseError(
                "E507", f"`{system.names[0]}` cannot be removed: no component acts on it"
            )
        scheme = without_branch_mass(scheme, mass, rule)
        yield system, scheme


def _highest(systems: Sequence[PartialSystem]) -> PartialSystem:
    highest = max(system.frequency for system in systems)
    return next(system for system in systems if system.frequency >= highest * (1 - TIE))


def step_of(
    stage: SchemeReached, rule: SimplificationRule, *, is_chain: bool
) -> SimplificationStep:
    """Describe a removed partial system and the resulting scheme as a step."""
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
    most = frequencies + steps
    if not 1 <= frequencies <= most:
        to = f" to {most}" if most > 1 else ""
        expected = f"expected 1{to}: the system has {most}" if most else "but the system has none"
        noun = "frequency" if frequencies == 1 else "frequencies"
        message = f"read {frequencies} natural {noun} to remain (--links), {expected}"
        yield Problem("E509", message)
    elif len(remove) > steps:
        yield Problem(
            "E510",
            f"read {count_of('link', len(remove))} to remove, expected {steps} at most, so that "
            f"{frequencies} of {most} natural frequencies remain",
        )
    inertias = dict(zip(scheme.names, scheme.inertias, strict=True))
    for place, name in enumerate(remove):
        if name not in inertias:
            hint = nearest(name, inertias)
            yield Problem(
                "E511", f"read `{name}` to remove, expected a link of the simplified system{hint}"
            )
        elif name in remove[:place]:
            yield Problem("E512", f"read `{name}` to remove, which is already removed")
        elif not inertias[name]:
            yield Problem("E513", f"read `{name}` to remove, expected a link with inertia")


def doubts_of(
    steps: Sequence[SimplificationStep], last: Sequence[SimplificationStep]
) -> Iterator[Problem]:
    """Yield a warning if a natural frequency is too close to a removed partial frequency, (П1.8).

    Parameters
    ----------
    steps : sequence of SimplificationStep
        Steps whose partial frequencies are compared.
    last : sequence of SimplificationStep
        Steps; the natural frequencies of the last step are compared.
    """
    if not steps:
        return
    lowest = min(steps, key=lambda step: certain(step.partial_frequency))
    omega, partial = last[-1].omegas[-1], lowest.partial_frequency
    if omega > ACCURATE * partial:
        yield Problem(
            "W501",
            f"the remaining frequency {omega:.4g} rad/s is more than half of the removed partial "
            f"frequency {partial:.4g} rad/s ({lowest.operation}): it can be more than 5 % off",
        )


def without_mass(chain: Chain, mass: int) -> Chain:
    """Remove a mass from a chain, and divide its inertia between its neighbours, (П1.4).

    The shares are proportional to the stiffnesses between the mass and its neighbours. At a free
    end the neighbour gets the whole inertia, and the spring is dropped.

    Parameters
    ----------
    chain : Chain
    mass : int
        Index of the mass along the chain.

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
    """Merge two neighbouring masses of a chain, (П1.5).

    The compliance of the spring between the masses is divided between the springs on both sides, in
    proportion to the inertia of the mass farther from each spring. The share of a free end is
    dropped.

    Parameters
    ----------
    chain : Chain
    left : int
        Index of the first mass along the chain.

    Examples
    --------
    >>> three = Chain(("a", "b", "c"), (3, 1, 4), (ChainSpring("s", 1), ChainSpring("t", 0.25)))
    >>> with_masses_merged(three, 0)
    Chain(names=('a+b', 'c'), inertias=(4, 4), springs=(ChainSpring(name='t', compliance=1.0, damping=0.0),))
    """  # noqa: E501
    first, second = chain.inertias[left : left + 2]
    between, springs = chain.springs[left], list(chain.springs)
    if left > 0:
        springs[left - 1] = _longer(springs[left - 1], between, second / (first + second), 0.5)
    if left + 1 < len(springs):
        springs[left + 1] = _longer(springs[left + 1], between, first / (first + second), 0.5)
    del springs[left]
    behind = slice(left + 2, None)
    return Chain(
        (*chain.names[:left], "+".join(chain.names[left : left + 2]), *chain.names[behind]),
        (*chain.inertias[:left], first + second, *chain.inertias[behind]),
        tuple(springs),
    )


def _longer(
    spring: ChainSpring, other: ChainSpring, part: float = 1.0, damped: float = 1.0
) -> ChainSpring:
    """Lengthen a spring by a fraction `part` of another spring, with damping by (П1.14).

    If `other` is divided between two springs, both fractions dissipate equally at equal torque,
    (П1.15). Each fraction then adds half of the damping of `other` (`damped` = 0.5), times the
    squared ratio of the compliances of the whole of `other` and of the result (П1.16).
    """
    compliance = spring.compliance + part * other.compliance
    damping = spring.damping * (spring.compliance / compliance) ** 2
    damping += damped * other.damping * (other.compliance / compliance) ** 2
    return ChainSpring(spring.name, compliance, damping)


BranchRule = Literal["r", "b", "u"]
"""Rule by which static condensation distributes the inertia of a removed mass."""

_SHARES: dict[BranchRule, Callable[[float], float]] = {
    "r": lambda part: part,  # (П1.7), which the book recommends
    "b": lambda part: part**2,  # rule of Banakh, equation (П1.6)
    "u": lambda _: 0.0,
}
"""Share of the inertia of a removed mass j that mass i receives, as a function of |Kij|/Kjj."""


def one_mass_systems(scheme: TorsionScheme) -> list[PartialSystem]:
    """Return the partial systems of the masses with inertia, in the order of the scheme.

    The frequency with all other masses held is sqrt(Kjj/Jj), where the stiffness matrix K is
    condensed to masses with inertia.
    """
    heavy = without_massless(scheme)
    stiffness = stiffness_matrix(heavy).diagonal().tolist()
    number = {name: mass for mass, name in enumerate(scheme.names)}
    return [
        PartialSystem((number[name],), (name,), math.sqrt(k / j))
        for name, j, k in zip(heavy.names, heavy.inertias, stiffness, strict=True)
    ]


def acted_on_by_several(scheme: TorsionScheme, mass: int) -> bool:
    """Return whether several springs act on a mass, so that it is not an end."""
    return sum(mass in spring.twist for spring in scheme.springs) > 1


def without_branch_mass(scheme: TorsionScheme, mass: int, rule: BranchRule) -> TorsionScheme:
    """Remove the inertia of a mass, and distribute it to other masses.

    If three or more springs meet at the mass, it stays without inertia. The scheme then still shows
    which masses each spring acts on.

    Parameters
    ----------
    scheme : TorsionScheme
    mass : int
        Index of the mass.
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
    removed = heavy.names.index(scheme.names[mass])
    column = stiffness_matrix(heavy)[removed].tolist()
    inertias = dict(zip(scheme.names, scheme.inertias, strict=True))
    for name, stiffness in zip(heavy.names, column, strict=True):
        if name != scheme.names[mass]:
            inertias[name] += scheme.inertias[mass] * _SHARES[rule](
                abs(stiffness) / column[removed]
            )
    inertias[scheme.names[mass]] = 0.0
    return tidied(scheme._replace(inertias=tuple(inertias.values())))
