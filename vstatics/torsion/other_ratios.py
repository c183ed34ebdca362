"""Natural frequencies of variants with other ratios, in which links are joined otherwise.

Their motions follow those of the first variant (`followed`), of which the ranks are known.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

from vstatics.numerics.arrays import Booleans, Floats, Integers
from vstatics.numerics.motions import values_of
from vstatics.torsion.coordinates import Coordinates, coordinates
from vstatics.torsion.followed import LOST_PIVOT, RESIDUE, followed_motions
from vstatics.torsion.normed import Split, natural_frequencies, of_split
from vstatics.torsion.system import TorsionalSystem
from vstatics.torsion.variants import NUMBERS, Varied


class VariedSystem(NamedTuple):
    """A system and what is other in its variants; it is the first of them.

    Attributes
    ----------
    system : TorsionalSystem
    turning : int
        Index of a link that has to turn, the input.
    twists : mapping of int to ndarray, shape (variants, links)
        By places in `TorsionalSystem.devices`.
    stiffnesses, inertias : mapping of int to ndarray, shape (variants,)
        By places among elastic devices and among bodies. [N*m/rad, kg*m^2]
    """

    system: TorsionalSystem
    turning: int
    twists: Mapping[int, Floats]
    stiffnesses: Varied
    inertias: Varied


def frequencies_of_ratios(
    varied: VariedSystem, modes: Sequence[int], variants: int
) -> tuple[Floats, Booleans]:
    """The frequencies of variants, and which go the way of the first: others are unknown.

    Returns
    -------
    ndarray, shape (variants, len(modes)), and ndarray, shape (variants,)
        NaN where there are fewer modes. [rad/s]

    Examples
    --------
    A mass of 1 on a shaft of 100 to a pair of wheels, another of 1 behind these:
    ``omega^2 = c (1 + u^2)``; the ratio -2 and the ratio -3.

    >>> from vstatics import Mechanism, Spring, Transmission
    >>> from vstatics.torsion.system import torsional_system
    >>> shaft, pair = Spring({1: 1, 2: -1}, stiffness=100.0), Mechanism(2, 3, 0, -2.0)
    >>> case = Transmission(3, [], [pair], [], springs=[shaft], inertias={1: 1.0, 3: 1.0})
    >>> twists = np.array([[0.0, 1.0, 2.0], [0.0, 1.0, 3.0]])
    >>> system = torsional_system(case, case.gears[0])
    >>> frequencies_of_ratios(VariedSystem(system, 0, {0: twists}, {}, {}), [0], 2)
    (array([[22.36067977],
           [31.6227766 ]]), array([ True,  True]))
    """
    system = varied.system
    bodies = list(system.bodies)
    for place, numbers in varied.inertias.items():
        bodies[place] = bodies[place]._replace(inertia=float(numbers[0]))
    system = system._replace(bodies=tuple(bodies))
    split = coordinates(system)
    found = np.full((variants, len(modes)), np.nan)
    safe = np.zeros(variants, np.bool_)
    if split.undetermined.any() or not variants:
        return found, safe
    existing = [place for place, mode in enumerate(modes) if mode < split.modes]
    step = max(NUMBERS // (len(system.devices) * len(system.names)), 1)
    for start in range(0, variants, step):
        rows = np.arange(start, min(start + step, variants))
        omegas, kept = _block(varied._replace(system=system), split, np.append(0, rows))
        for place in existing:
            found[rows, place] = omegas[1:, modes[place]]
        safe[rows] = kept[1:]
    return found, safe


def _block(varied: VariedSystem, split: Coordinates, variants: Integers) -> tuple[Floats, Booleans]:
    """All frequencies of a few variants, the first of all before them."""
    system = varied.system
    forms = _table(values_of([one.twist for one in system.devices], len(system.names)), variants)
    for place, rows in varied.twists.items():
        forms[:, place] = rows[variants]
    stiffnesses = _table([one.stiffness or 0.0 for one in system.elastic], variants)
    inertias = _table([body.inertia for body in system.bodies], variants)
    for table, given in ((stiffnesses, varied.stiffnesses), (inertias, varied.inertias)):
        for place, numbers in given.items():
            table[:, place] = numbers[variants]
    rigid = np.array([one.stiffness is None for one in system.devices])
    heavy = inertias > 0

    free = followed_motions(forms[:, rigid], split.free.shape[1])
    bodies = values_of([body.form for body in system.bodies], len(system.names)) @ free.motions
    still = followed_motions(bodies[:, heavy[0]], split.massless.shape[1])
    twists = forms[:, ~rigid] @ free.motions
    together = followed_motions(twists, split.rigid.shape[1])
    massless = twists @ still.motions
    moving, others = still.others, together.motions[:, still.free]
    by_heavy = together.motions[:, moving] - still.motions[:, moving] @ others
    safe = free.safe & still.safe & together.safe & _resisted(massless)
    safe &= (np.abs(free.motions[:, varied.turning]) > RESIDUE).any(axis=1)
    safe &= (heavy == heavy[0]).all(axis=1)

    parts = Split(bodies[:, :, moving], twists[:, :, moving], massless, by_heavy)
    omegas = np.full((len(variants), split.modes), np.nan)
    if split.modes and safe.any():
        normed = of_split(Split(*(part[safe] for part in parts)), inertias[safe])
        omegas[safe] = natural_frequencies(normed, stiffnesses[safe])
    return omegas, safe


def _table(numbers: ArrayLike, variants: Integers) -> Floats:
    """The same numbers for each of some variants, to be changed."""
    return np.repeat(np.array(numbers, np.float64)[None], len(variants), axis=0)


def _resisted(massless: Floats) -> Booleans:
    """Whether devices resist all massless motions, as in the first variant."""
    if not massless.shape[2]:
        return np.ones(len(massless), np.bool_)
    sizes = np.linalg.svd(massless, compute_uv=False)
    shares = sizes[:, -1] / sizes[:, 0]
    resisted: Booleans = shares > LOST_PIVOT * shares[0]
    return resisted
