"""Masses that turn as one, as those of equal branches do, in the course of a simplification.

Tsitovich and Algin, Vehicle dynamics (1981), table 2.15: the inertias of both are added, springs
between them are gone, those that come to stand beside each other are one.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from vstatics.core.errors import CaseError, quoted
from vstatics.core.numerics.tolerances import TIE
from vstatics.core.suggestions import nearest
from vstatics.torsion.reduction.chain import Chain, PartialSystem, chain_of, scheme_of
from vstatics.torsion.reduction.condensation import tidied
from vstatics.torsion.reduction.scheme import TorsionScheme, natural_frequencies, stiffness_matrix
from vstatics.torsion.reduction.simplification import (
    Simplification,
    SimplificationRule,
    SimplificationStep,
    doubts_of,
    simplify,
    step_of,
)


def simplify_merging(
    scheme: TorsionScheme,
    frequencies: int,
    rule: SimplificationRule | None,
    remove: Sequence[str],
    merge: Sequence[str],
) -> Simplification:
    """Remove masses, let pairs of others turn as one, then go on by the rule.

    Parameters
    ----------
    scheme, frequencies, rule, remove
        As of `simplify`; a scheme that is a chain only then goes by partial systems from there.
    merge : sequence of str
        Names of two masses with a plus between, which is the name of both from then on.

    Raises
    ------
    CaseError
        As `simplify`; and of names that it does not have.

    Examples
    --------
    >>> from vstatics.torsion.reduction.scheme import SchemeSpring
    >>> springs = SchemeSpring("s", {0: 1, 1: -1}, 1.0), SchemeSpring("t", {0: 1, 2: -1}, 1.0)
    >>> fork = TorsionScheme(("a", "b", "c"), (4.0, 1.0, 1.0), springs)
    >>> [step] = simplify_merging(fork, 1, None, (), ["b+c"]).steps
    >>> step.operation, step.partial_frequency, step.inertias, step.compliances
    ('merge b and c', 1.0, (2.0, 4.0), (0.5,))
    """
    most = len(natural_frequencies(scheme))
    removed = simplify(scheme, max(most - len(remove), 1), rule, remove)
    left = removed.scheme
    merges: list[SimplificationStep] = []
    for pair in merge:
        left, step = _merged(left, _pair(pair, left.names))
        merges.append(step)
    rest = simplify(left, frequencies, rule)
    own = (*removed.steps, *rest.steps)
    steps = (*removed.steps, *merges, *rest.steps)
    return rest._replace(steps=steps, warnings=tuple(doubts_of(own, steps[-1:])))


def _pair(text: str, names: Sequence[str]) -> tuple[int, int]:
    """The masses that a text names."""
    parts = [(text[:n].strip(), text[n + 1 :].strip()) for n, one in enumerate(text) if one == "+"]
    for first, second in parts:
        if first in names and second in names and first != second:
            return names.index(first), names.index(second)
    wrong = next((one for one in (parts or [(text, text)])[0] if one not in names), text)
    hint = "" if wrong in names else nearest(wrong, names)
    message = f"read {quoted(text)} to merge, expected two links of the scheme as `A+B`{hint}"
    raise CaseError("E888", message)


def _merged(
    scheme: TorsionScheme, pair: tuple[int, int]
) -> tuple[TorsionScheme, SimplificationStep]:
    """The scheme in which two masses are one, which stands where the first of them does."""
    stay, gone = min(pair), max(pair)
    names, inertias = list(scheme.names), list(scheme.inertias)
    system = _system(scheme, pair)
    names[stay] = "+".join(system.names)
    inertias[stay] += inertias.pop(gone)
    del names[gone]
    springs = [
        spring._replace(twist=dict(_twist(spring.twist, stay, gone))) for spring in scheme.springs
    ]
    made = tidied(TorsionScheme(tuple(names), tuple(inertias), tuple(springs)))
    chain = chain_of(made)
    is_chain = isinstance(chain, Chain)
    made = scheme_of(chain) if isinstance(chain, Chain) else made
    return made, step_of((system, made), "partial" if is_chain else "r", is_chain=is_chain)


def _twist(twist: Mapping[int, float], stay: int, gone: int) -> Iterator[tuple[int, float]]:
    """Its coefficients by the numbers of masses that are left."""
    joined = twist.get(stay, 0.0) + twist.get(gone, 0.0)
    if abs(joined) > TIE * max(abs(twist.get(one, 0.0)) for one in (stay, gone)):
        yield stay, joined
    for mass, part in twist.items():
        if mass not in (stay, gone):
            yield mass - (mass > gone), part


def _system(scheme: TorsionScheme, pair: tuple[int, int]) -> PartialSystem:
    """Both against each other, with their common mean and all others held."""
    one, two = (scheme.inertias[mass] for mass in pair)
    shape = np.zeros(len(scheme.names))
    shape[[*pair]] = two, -one
    energy = float(shape @ stiffness_matrix(scheme) @ shape)
    frequency = math.sqrt(max(energy, 0.0) / (one * two * (one + two)))
    return PartialSystem(pair, tuple(scheme.names[mass] for mass in pair), frequency)
