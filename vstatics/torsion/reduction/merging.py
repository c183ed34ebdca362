"""Merging of masses that move together in a simplification, such as masses of equal branches.

The inertias of both masses are added, springs between them are dropped, and springs that become
parallel are combined (Tsitovich, Algin, Vehicle dynamics, 1981, table 2.15).
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
    """Remove the masses in `remove`, merge the pairs in `merge`, then simplify by the rule.

    Parameters
    ----------
    scheme, frequencies, rule, remove
        Parameters of `simplify`. A scheme that merging turns into a chain is simplified by
        partial systems.
    merge : sequence of str
        Pairs of masses, as two names joined by a plus sign: the name of the merged mass.

    Raises
    ------
    CaseError
        As in `simplify`, or if a name in `merge` is not the name of a mass.

    Examples
    --------
    >>> from vstatics.torsion.reduction.scheme import SchemeSpring
    >>> springs = SchemeSpring("s", {0: 1, 1: -1}, 1.0), SchemeSpring("t", {0: 1, 2: -1}, 1.0)
    >>> fork = TorsionScheme(("a", "b", "c"), (4.0, 1.0, 1.0), springs)
    >>> [step] = simplify_merging(fork, 1, None, (), ["b+c"]).steps
    >>> step.operation, step.partial_frequency, step.inertias, step.compliances
    ('merge b and c', 1.0, (2.0, 4.0), (0.5,))
    """
    modes = len(natural_frequencies(scheme))
    removal = simplify(scheme, max(modes - len(remove), 1), rule, remove)
    scheme = removal.scheme
    merges: list[SimplificationStep] = []
    for pair in merge:
        scheme, step = _merged(scheme, _pair(pair, scheme.names))
        merges.append(step)
    final = simplify(scheme, frequencies, rule)
    removals = (*removal.steps, *final.steps)
    steps = (*removal.steps, *merges, *final.steps)
    return final._replace(steps=steps, warnings=tuple(doubts_of(removals, steps[-1:])))


def _pair(text: str, names: Sequence[str]) -> tuple[int, int]:
    """Return the indices of masses A and B in a text `A+B`; the names can contain plus signs."""
    parts = [(text[:n].strip(), text[n + 1 :].strip()) for n, c in enumerate(text) if c == "+"]
    for first, second in parts:
        if first in names and second in names and first != second:
            return names.index(first), names.index(second)
    wrong = next((name for name in (parts or [(text, text)])[0] if name not in names), text)
    hint = "" if wrong in names else nearest(wrong, names)
    raise CaseError(
        "E888", f"read {quoted(text)} to merge, expected two links of the system as `A+B`{hint}"
    )


def _merged(
    scheme: TorsionScheme, pair: tuple[int, int]
) -> tuple[TorsionScheme, SimplificationStep]:
    """Merge two masses at the position of the first, and describe the step."""
    stay, gone = min(pair), max(pair)
    names, inertias = list(scheme.names), list(scheme.inertias)
    first, second = (scheme.inertias[mass] for mass in pair)
    shape = np.zeros(len(scheme.names))
    shape[[*pair]] = second, -first
    energy = float(shape @ stiffness_matrix(scheme) @ shape)
    frequency = math.sqrt(max(energy, 0.0) / (first * second * (first + second)))
    system = PartialSystem(pair, tuple(scheme.names[mass] for mass in pair), frequency)
    names[stay] = "+".join(system.names)
    inertias[stay] += inertias.pop(gone)
    del names[gone]
    springs = [
        spring._replace(twist=dict(_twist(spring.twist, stay, gone))) for spring in scheme.springs
    ]
    merged = tidied(TorsionScheme(tuple(names), tuple(inertias), tuple(springs)))
    chain = chain_of(merged)
    is_chain = isinstance(chain, Chain)
    merged = scheme_of(chain) if isinstance(chain, Chain) else merged
    return merged, step_of((system, merged), "partial" if is_chain else "r", is_chain=is_chain)


def _twist(twist: Mapping[int, float], stay: int, gone: int) -> Iterator[tuple[int, float]]:
    total = twist.get(stay, 0.0) + twist.get(gone, 0.0)
    if abs(total) > TIE * max(abs(twist.get(mass, 0.0)) for mass in (stay, gone)):
        yield stay, total
    for mass, part in twist.items():
        if mass not in (stay, gone):
            yield mass - (mass > gone), part
