"""Chains with one mass less, by the method of partial frequencies.

Tsitovich and Algin, Vehicle dynamics (1981), appendix П1.2: a partial system of one mass becomes
one of two masses with the same frequency and its node at the mass, (П1.4), or the other way
round, (П1.5). Springs and inertias that come to stand beside each other are added, so the sums of
both stay as they were. A compliance at a free end, and an inertia on the housing, do nothing.
"""

from __future__ import annotations

from vstatics.torsion.chain import Chain, ChainSpring


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
            joined = [_joined(left, right)]
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
        springs[left - 1] = _longer(springs[left - 1], between, two / (one + two))
    if left + 1 < len(springs):
        springs[left + 1] = _longer(springs[left + 1], between, one / (one + two))
    del springs[left]
    rest = slice(left + 2, None)
    return Chain(
        (*chain.names[:left], "+".join(chain.names[left : left + 2]), *chain.names[rest]),
        (*chain.inertias[:left], one + two, *chain.inertias[rest]),
        tuple(springs),
    )


def _joined(left: ChainSpring, right: ChainSpring) -> ChainSpring:
    """Two springs in a row, which carry one torque; damping by (П1.14)."""
    compliance = left.compliance + right.compliance
    damping = left.damping * (left.compliance / compliance) ** 2
    damping += right.damping * (right.compliance / compliance) ** 2
    return ChainSpring(f"{left.name}+{right.name}", compliance, damping)


def _longer(spring: ChainSpring, divided: ChainSpring, part: float) -> ChainSpring:
    """A spring in a row with a part of another one, whose damping is divided by (П1.15).

    Both parts of it dissipate the same at the same torque: (П1.15) in (П1.16) leaves K/2 of
    it, times the square of its own compliance by that of the sum, however small the part is.
    """
    compliance = spring.compliance + part * divided.compliance
    damping = spring.damping * (spring.compliance / compliance) ** 2
    damping += divided.damping / 2 * (divided.compliance / compliance) ** 2
    return ChainSpring(spring.name, compliance, damping)
