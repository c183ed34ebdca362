"""A found box as a case that every command takes, with names of its links, elements and gears."""

from __future__ import annotations

from collections.abc import Sequence

from vstatics.model.parts import HOUSING, Gear, Mechanism, ShiftElement
from vstatics.model.transmission import Transmission
from vstatics.synthesis.boxes.box import HELD, FoundBox
from vstatics.synthesis.gears.case_of_scheme import INERTIA, gear_names, set_name
from vstatics.synthesis.structures.scheme import link_name


def box_case(box: FoundBox, targets: Sequence[float], efficiency: float) -> Transmission:
    """The case of a found box: its sets, shift elements and gears.

    A link that is held for good is the housing; the others keep their numbers as names.

    Parameters
    ----------
    box : FoundBox
    targets : sequence of float
        Wanted ratios of its gears, in its order. [-]
    efficiency : float
        Of each set with its carrier held. [-]

    Raises
    ------
    CaseError
        If the box can't be a gearbox, as with a ratio that is none.

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
    links = [link for link in range(max(box.scheme.links, box.input + 1)) if link != box.held]
    number = {link: place for place, link in enumerate(links, 1)} | {HELD: HOUSING}
    if box.held is not None:
        number[box.held] = HOUSING
    names = target_names(targets)
    inertia = f"The inertias are in place of those of engine and load, {INERTIA:g} kg*m^2."
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


def _set(place: int, links: Sequence[int], ratio: float, efficiency: float) -> Mechanism:
    """A set by its number from 1; with its carrier held for good it has planets all the same."""
    sun, carrier, ring = links
    of_planet = (ratio + 1) / 2 if carrier == HOUSING and ratio < 0 and ratio != -1 else None
    return Mechanism(
        sun,
        ring,
        carrier,
        ratio,
        efficiency,
        planet_ratio=of_planet,
        name=set_name(place),
        is_set=carrier == HOUSING,
    )


HOUSING_NAME = "housing"


def element_links(element: tuple[int, int]) -> tuple[str, str]:
    """The names of the two links of an element.

    >>> element_links((2, HELD)), element_links((0, 3))
    (('L2', 'housing'), ('L0', 'L3'))
    """
    first, second = element
    return link_name(first), HOUSING_NAME if second == HELD else link_name(second)


def box_element_name(element: tuple[int, int]) -> str:
    """The name of a shift element.

    >>> box_element_name((2, HELD)), box_element_name((0, 3))
    ('T-L2', 'F-L0-L3')
    """
    first, second = element_links(element)
    return f"T-{first}" if element[1] == HELD else f"F-{first}-{second}"


def target_names(targets: Sequence[float]) -> tuple[str, ...]:
    """The name of the gear of each target: forward by descending ratio, then those backward.

    >>> target_names([1, -2.5, 3.2]), target_names([-2, 1, -4])
    (('2', 'R', '1'), ('R2', '1', 'R1'))
    """
    forward = sum(target > 0 for target in targets)
    names = gear_names(forward, len(targets) - forward)
    return tuple(name for _, name in sorted(zip(in_order(targets), names, strict=True)))


def in_order(targets: Sequence[float]) -> list[int]:
    """The indices of targets in the order of their gears.

    >>> in_order([1, -2.5, 3.2])
    [2, 0, 1]
    """
    return sorted(range(len(targets)), key=lambda index: (targets[index] < 0, -abs(targets[index])))
