"""Conversion of a found gearbox to a case, and the names of its shift elements."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import combinations

from vstatics.core.elements.drawing import Drawing
from vstatics.core.elements.element import Element
from vstatics.core.elements.kinds import RAVIGNEAUX
from vstatics.core.model.parts import HOUSING, Gear, Mechanism, ShiftElement
from vstatics.core.model.transmission import Transmission
from vstatics.synthesis.boxes.box import HELD, FoundBox
from vstatics.synthesis.gears.case_of_scheme import INERTIA
from vstatics.synthesis.gears.names import in_order, names_of_gears, set_name
from vstatics.synthesis.structures.scheme import link_name


def box_case(box: FoundBox, targets: Sequence[float], efficiency: float) -> Transmission:
    """Return a found gearbox as a case: gear sets, shift elements and gears.

    A permanently held link becomes the housing; other links have their number in their name.

    Parameters
    ----------
    box : FoundBox
    targets : sequence of float
        Wanted ratios of the gears, in the order of the gearbox. [-]
    efficiency : float
        Basic efficiency of each gear set (carrier held). [-]

    Raises
    ------
    CaseError
        If the gearbox is not a valid case, for example because of a ratio.

    Examples
    --------
    >>> from vstatics.synthesis.structures.scheme import SetScheme
    >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, HELD), (0, 1)), (-2.0,),
    ...                ((1,), (0,)), 0.0)
    >>> case = box_case(box, [1, 3], 0.98)
    >>> [(gear.name, gear.engaged) for gear in case.gears], case.output
    ([('1', (1,)), ('2', (2,))], 2)
    >>> [element.name for element in case.shift_elements]
    ['T-L2', 'F-L0-L1']
    """
    links = [link for link in range(box.links) if link != box.held]
    number = {link: place for place, link in enumerate(links, 1)} | {HELD: HOUSING}
    if box.held is not None:
        number[box.held] = HOUSING
    names = names_of_gears(targets)
    inertia = f"The inertias stand for engine and load: {INERTIA:g} kg*m^2 each."
    assumed = f"Every set has the efficiency {efficiency:g} with its carrier held"
    return Transmission(
        links=len(links),
        shift_elements=[
            ShiftElement(number[first], number[second], box_element_name((first, second)))
            for first, second in box.elements
        ],
        mechanisms=[
            _set(place, [number[link] for link in links_of_set], ratio, efficiency)
            for place, (links_of_set, ratio) in enumerate(
                zip(box.scheme.sets, box.ratios, strict=True), 1
            )
        ],
        gears=[
            Gear(tuple(element + 1 for element in box.gears[index]), name=names[index])
            for index in in_order(targets)
        ],
        input=number[box.input],
        output=number[box.output],
        link_names=[link_name(link) for link in links],
        name=f"box {box.scheme.code}",
        description=f"{assumed}, as assumed. {inertia}",
        inertias={number[box.input]: INERTIA, number[box.output]: INERTIA},
    )


def drawn_case(box: FoundBox, case: Transmission) -> Transmission:
    """Replace pairs of gear sets that form a Ravigneaux set in the case of a gearbox.

    The Ravigneaux sets have ratios instead of teeth. Speeds, torques and losses do not change; the
    power flow within a Ravigneaux set is no longer shown.

    Parameters
    ----------
    box : FoundBox
    case : Transmission
        Result of `box_case`.

    Examples
    --------
    >>> from vstatics.synthesis.structures.scheme import SetScheme
    >>> box = FoundBox(SetScheme.of_code("0-1-2-3-1-2"), None, 3, 2, ((1, HELD), (0, HELD)),
    ...                (-2.0, 2.5), ((0,), (1,)), 0.0)
    >>> case = drawn_case(box, box_case(box, [2.5, 1.5], 0.98))
    >>> case.drawing.elements[0].kind, [mechanism.name for mechanism in case.mechanisms]
    ('ravigneaux', ['P1-P2.small_sun-ring', 'P1-P2.large_sun-ring'])
    """
    pairs = ravigneaux_sets(box)
    if not pairs:
        return case
    sets = {mechanism.name: mechanism for mechanism in case.mechanisms}
    elements = tuple(
        _ravigneaux(name, sets.pop(plain), sets.pop(meshed))
        for name, (plain, meshed) in pairs.items()
    )
    drawing = Drawing(case.links, elements, tuple(sets.values()))
    return case.replace(mechanisms=(), drawing=drawing)


def _ravigneaux(name: str, plain: Mechanism, meshed: Mechanism) -> Element:
    members = {"small_sun": meshed.first, "large_sun": plain.first}
    members |= {"ring": plain.second, "carrier": plain.third}
    ratios = {"small_sun": meshed.ratio, "large_sun": plain.ratio}
    return Element(name, RAVIGNEAUX, members, efficiency=plain.efficiency, ratios=ratios)


def ravigneaux_sets(box: FoundBox) -> dict[str, tuple[str, str]]:
    """Return the pairs of gear sets that form a Ravigneaux set, by name, simple set first.

    Both sets share carrier and ring; the second set has meshing planets and the smaller sun.

    Examples
    --------
    >>> from vstatics.synthesis.structures.scheme import SetScheme
    >>> box = FoundBox(SetScheme.of_code("0-1-2-3-1-2"), None, 3, 2, (), (2.5, -2.0), (), 0.0)
    >>> ravigneaux_sets(box), ravigneaux_sets(box._replace(ratios=(2.5, -3.0)))
    ({'P2-P1': ('P2', 'P1')}, {})
    """
    pairs = {}
    taken: set[int] = set()
    sets = [*enumerate(zip(box.scheme.sets, box.ratios, strict=True))]
    for set_1, set_2 in combinations(sets, 2):
        plain, meshed = sorted((set_1, set_2), key=lambda numbered: numbered[1][1])
        (first, (links, ratio)), (second, (others, more)) = plain, meshed
        is_one = links[1:] == others[1:] and ratio < 0 < -ratio < more
        if is_one and taken.isdisjoint((first, second)):
            taken |= {first, second}
            names = set_name(first + 1), set_name(second + 1)
            pairs["-".join(names)] = names
    return pairs


def planet_ratio(ratio: float) -> float:
    """Return sun speed divided by planet speed relative to the carrier; NaN if impossible.

    A planet that meshes with sun and ring has half the difference of their tooth numbers. Two
    planets that mesh with each other, in line between sun and ring, each have a quarter of the
    difference.

    Examples
    --------
    A simple gear set 30/90 has planets with 30 teeth, a set with meshing planets has 15 teeth:

    >>> planet_ratio(-3.0), planet_ratio(3.0)
    (-1.0, -0.5)
    """
    ratio_to_planet = (1 + ratio) / 2 if ratio < 0 else (1 - ratio) / 4
    return ratio_to_planet or math.nan


def _set(place: int, links: Sequence[int], ratio: float, efficiency: float) -> Mechanism:
    """Return the mechanism of a gear set. A planet ratio is added only if needed."""
    sun, carrier, ring = links
    has_planets = ratio > 0 or carrier == HOUSING
    of_planet = planet_ratio(ratio)
    return Mechanism(
        sun,
        ring,
        carrier,
        ratio,
        efficiency,
        planet_ratio=of_planet if has_planets and of_planet == of_planet else None,  # noqa: PLR0124
        name=set_name(place),
        is_set=carrier == HOUSING,
    )


HOUSING_NAME = "housing"


def element_links(element: tuple[int, int]) -> tuple[str, str]:
    """Return the names of the two links of a shift element.

    >>> element_links((2, HELD)), element_links((0, 3))
    (('L2', 'housing'), ('L0', 'L3'))
    """
    first, second = element
    return link_name(first), HOUSING_NAME if second == HELD else link_name(second)


def box_element_name(element: tuple[int, int]) -> str:
    """Return the name of a shift element.

    >>> box_element_name((2, HELD)), box_element_name((0, 3))
    ('T-L2', 'F-L0-L3')
    """
    first, second = element_links(element)
    return f"T-{first}" if element[1] == HELD else f"F-{first}-{second}"
