"""Conversion of a scheme to a case with gear sets, shift elements and gears."""

from __future__ import annotations

import math
from collections.abc import Sequence

from vstatics.core.arguments import refusing
from vstatics.core.errors import count_of
from vstatics.core.model.parts import HOUSING, Gear, Mechanism, ShiftElement
from vstatics.core.model.transmission import Transmission
from vstatics.synthesis.gears.names import in_order, names_of_gears, set_name
from vstatics.synthesis.gears.search import CombinationSearch
from vstatics.synthesis.structures.arrays import LEAST_MOBILITY
from vstatics.synthesis.structures.scheme import SetScheme, link_name

FEW_COMBINATIONS = 60
"""Largest number of combinations for which the input gets clutches to all other links."""
MOST_OF_SCHEME = 100
"""Largest number of gears of the case. The first combinations are used."""
NEUTRAL = "N"
"""Name of the only gear of a case in which no combination gives a ratio."""
INERTIA = 1.0
"""Placeholder for the inertia of input and output, so that the case can be simulated. [kg*m^2]"""


@refusing()
def scheme_case(
    scheme: SetScheme, input_link: int, output_link: int, ratios: Sequence[float]
) -> Transmission:
    """Convert a scheme to a case with brakes, clutches and all resulting gears.

    Every link except input and output has a brake, and a clutch connects input and output. If a
    gear engages several shift elements, clutches also connect the input to all other links, unless
    this gives more than `FEW_COMBINATIONS` combinations. The gears are the combinations with
    different ratios, including direct drive, by descending ratio.

    Parameters
    ----------
    scheme : SetScheme
    input_link, output_link : int
        Numbers of links of the scheme, from 0.
    ratios : sequence of float
        Basic ratio of each gear set, sun to ring, carrier held. [-]

    Returns
    -------
    Transmission
        Case, with inertias of 1 kg*m^2 at input and output.

    Raises
    ------
    ValueError
        If the scheme cannot be a gearbox (schemes with `locked_sets` can), or the number of ratios
        differs from the number of sets.
    CaseError
        If a ratio is not valid.

    Examples
    --------
    >>> case = scheme_case(SetScheme.of_code("0-1-2"), 0, 1, [-2])
    >>> [(gear.name, gear.engaged) for gear in case.gears]
    [('1', (1,)), ('2', (2,))]
    >>> [element.name for element in case.shift_elements]
    ['T-L2', 'F-L0-L1']
    """
    if input_link == output_link:
        raise ValueError(f"{link_name(input_link)} is input and output; expected two links")
    if not scheme.is_connected:
        raise ValueError("its sets share no link: these are several gearboxes, expected one")
    if scheme.mobility < LEAST_MOBILITY:
        sets = len(scheme.sets)
        raise ValueError(
            f"{count_of('set', sets)} with {scheme.links} links turn as one body"
            f"; expected {sets + LEAST_MOBILITY} links or more"
        )
    if len(ratios) != len(scheme.sets):
        raise ValueError(
            f"ratios: read {len(ratios)}, but the structure has {count_of('set', len(scheme.sets))}"
        )
    others = [link for link in range(scheme.links) if link not in (input_link, output_link)]
    elements = [ShiftElement(link + 1, HOUSING, f"T-{link_name(link)}") for link in others]
    clutches = [_clutch(input_link, output_link)]
    engaged = scheme.mobility - 1
    if engaged > 1:
        more = [_clutch(input_link, link) for link in others]
        if math.comb(len(elements) + 1 + len(more), engaged) <= FEW_COMBINATIONS:
            clutches += more
    case = Transmission(
        links=scheme.links,
        shift_elements=elements + clutches,
        mechanisms=[
            Mechanism(sun + 1, ring + 1, carrier + 1, ratio, name=set_name(number))
            for number, ((sun, carrier, ring), ratio) in enumerate(
                zip(scheme.sets, ratios, strict=True), 1
            )
        ],
        gears=[Gear((), name=NEUTRAL)],
        input=input_link + 1,
        output=output_link + 1,
        link_names=[link_name(link) for link in range(scheme.links)],
        name=f"scheme {scheme.code}",
        description=f"The inertias stand for engine and load: {INERTIA:g} kg*m^2 each.",
        inertias={input_link + 1: INERTIA, output_link + 1: INERTIA},
    )
    gears = _gears(case, engaged)
    return case.replace(gears=gears) if gears else case


def _clutch(first: int, second: int) -> ShiftElement:
    name = f"F-{link_name(first)}-{link_name(second)}"
    return ShiftElement(first + 1, second + 1, name)


def _gears(case: Transmission, engaged: int) -> list[Gear]:
    """Return gears with different ratios that engage exactly `engaged` elements, up to a limit."""
    by_ratio: dict[str, tuple[float, tuple[int, ...]]] = {}
    for batch in CombinationSearch(case, [engaged]).batches():
        good = batch.where(batch.gears & ~batch.free)
        for ratio, members in zip(good.ratios.tolist(), good.members.tolist(), strict=True):
            by_ratio.setdefault(f"{ratio:.9e}", (ratio, tuple(index + 1 for index in members)))
        if len(by_ratio) >= MOST_OF_SCHEME:
            break
    chosen = list(by_ratio.values())[:MOST_OF_SCHEME]
    ratios = [ratio for ratio, _ in chosen]
    names = names_of_gears(ratios)
    return [Gear(chosen[index][1], name=names[index]) for index in in_order(ratios)]
