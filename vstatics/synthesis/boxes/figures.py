"""A found box as a case, and its figures: losses, speeds, torques of elements, whether planar."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from itertools import pairwise
from typing import Any, NamedTuple, cast

from vstatics.explain.bodies import on_own_links
from vstatics.extras import require
from vstatics.model.parts import HOUSING, Gear, Mechanism, ShiftElement
from vstatics.model.transmission import Transmission
from vstatics.statics.freewheels import find_state
from vstatics.statics.state import values_of
from vstatics.synthesis.boxes.box import HELD, BoxFigures, BoxSearch, FoundBox
from vstatics.synthesis.boxes.chosen_gears import (
    Engaged,
    all_of,
    chosen_sets,
    equal_sets,
    is_single,
    set_ratios,
)
from vstatics.synthesis.boxes.least_form import least_box
from vstatics.synthesis.gears.case_of_scheme import INERTIA, in_order, names_of_gears, set_name
from vstatics.synthesis.ratios.fitting import deviation
from vstatics.synthesis.structures.scheme import link_name
from vstatics.synthesis.tolerances import NO_LOAD


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
    links = [link for link in range(box.links) if link != box.held]
    number = {link: place for place, link in enumerate(links, 1)} | {HELD: HOUSING}
    if box.held is not None:
        number[box.held] = HOUSING
    names = names_of_gears(targets)
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


FIGURE_DECIMALS = 9
"""Figures that agree in so many decimals are equal."""


class BoxGear(NamedTuple):
    """A gear of a found box."""

    name: str
    engaged: tuple[str, ...]
    ratio: float
    target: float


class MeasuredBox(NamedTuple):
    """A found box, in the form of `least_box`, with its figures."""

    box: FoundBox
    targets: tuple[float, ...]
    efficiency: float
    """Of each set with its carrier held. [-]"""
    gears: tuple[BoxGear, ...]
    """By descending ratio, those backward last."""
    figures: BoxFigures

    @property
    def elements(self) -> dict[str, tuple[str, str]]:
        """By the name of each shift element the links that it joins."""
        return {box_element_name(one): element_links(one) for one in self.box.elements}

    @property
    def ratios(self) -> dict[str, float]:
        """By the name of each set its internal ratio [-]."""
        return {set_name(number): ratio for number, ratio in enumerate(self.box.ratios, 1)}

    @property
    def case(self) -> Transmission:
        """The box as a case, made when it is asked for."""
        return box_case(self.box, self.targets, self.efficiency)


def measured(search: BoxSearch, box: FoundBox, efficiency: float) -> MeasuredBox:
    """A found box with its figures, as the solver has them.

    Where several sets of elements give the ratio of a gear, those are taken with which one element
    changes between neighbours, then those with the least loss.

    Parameters
    ----------
    search : BoxSearch
    box : FoundBox
    efficiency : float
        Of each set with its carrier held, above 0 and up to 1. [-]

    Examples
    --------
    >>> from vstatics.synthesis.boxes.box import HELD
    >>> from vstatics.synthesis.structures.scheme import SetScheme
    >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, HELD), (0, 1)), (-2.0,),
    ...                ((1,), (0,)), 0.0)
    >>> found = measured(BoxSearch(1, 2, 1, (1.0, 3.02)), box, 0.98)
    >>> for gear in found.gears:
    ...     print(gear)
    BoxGear(name='1', engaged=('T-L2',), ratio=3.0, target=3.02)
    BoxGear(name='2', engaged=('F-L0-L1',), ratio=1.0, target=1.0)
    >>> figures = found.figures
    >>> round(figures.error, 6), round(figures.loss, 6), round(figures.planet_speed, 6)
    (0.006645, 0.006667, 1.333333)
    >>> figures.slip, figures.torque, figures.single, figures.planar
    (1.0, 2.0, True, True)
    """
    least = least_box(box)
    targets = search.targets
    if search.sequence is not None:  # further gears are as they are wanted
        targets += tuple(set_ratios(least, least.gears[len(targets) :]).tolist())
    case = box_case(least, targets, efficiency)
    solved, order, names = _solved(case), in_order(targets), names_of_gears(targets)
    used_in = (lambda one: solved(one).carrying) if search.shafts else all_of
    sets = _chosen(least, targets, solved, used_in)
    gears = tuple(
        BoxGear(
            names[place],
            tuple(box_element_name(least.elements[number]) for number in one),
            solved(one).ratio,
            targets[place],
        )
        for place, one in zip(order, sets, strict=True)
    )
    chosen = least._replace(
        gears=tuple(one for _, one in sorted(zip(order, sets, strict=True))),
        error=max(deviation(gear.ratio, gear.target) for gear in gears),  # maybe of another sign
    )
    figures = _figures(chosen, case, targets, sets, solved)
    return MeasuredBox(chosen, targets, efficiency, gears, figures)


class _GearValues(NamedTuple):
    """What the solver has of a gear."""

    ratio: float
    loss: float
    planet_speed: float
    slip: float
    torque: float
    carrying: int
    """The engaged elements that carry torque, as bits."""


_Solved = Callable[[Engaged], _GearValues]


def _solved(case: Transmission) -> _Solved:
    """What the solver has of a gear of a case by its engaged elements, each calculated once."""
    ratios = [one.ratio for one in case.mechanisms]
    efficiencies = [one.efficiency for one in case.mechanisms]

    @cache
    def values(engaged: Engaged) -> _GearValues:
        numbers = [number + 1 for number in engaged]
        state = find_state(case, Gear(numbers), ratios, efficiencies)
        found = cast("Mapping[str, Any]", values_of(state))  # floats, where nothing is traced
        torques, slips, holds = (found[name] for name in ("torques", "slip_speeds", "holds"))
        efficiency = found["efficiency"]
        return _GearValues(
            ratio=found["ratio"],
            loss=1.0 if math.isnan(efficiency) else 1.0 - efficiency,  # nothing comes through
            planet_speed=_largest(found["planet_speeds"]),
            slip=_largest(slip for slip, held in zip(slips, holds, strict=True) if not held),
            torque=_largest(one for one, held in zip(torques, holds, strict=False) if held),
            carrying=all_of(tuple(one for one in engaged if abs(torques[one]) > NO_LOAD)),
        )

    return values


def _largest(numbers: Iterable[float]) -> float:
    """The largest one without its sign; NaN where there is none."""
    return max((abs(one) for one in numbers if not math.isnan(one)), default=math.nan)


def _chosen(
    box: FoundBox,
    targets: Sequence[float],
    solved: _Solved,
    used_in: Callable[[Engaged], int],
) -> Sequence[Engaged]:
    """Of each gear, in their order, one of the sets of elements that give its ratio."""
    order, choices = in_order(targets), equal_sets(box)
    ranges = [
        [choices[index] for index in order if (targets[index] > 0) == forward]
        for forward in (True, False)
    ]

    def cost(engaged: Engaged) -> tuple[float, float]:
        found = solved(engaged)
        return round(found.loss, FIGURE_DECIMALS), round(found.torque, FIGURE_DECIMALS)

    return chosen_sets(ranges, len(box.elements), cost, used_in)


def _figures(
    box: FoundBox,
    case: Transmission,
    targets: Sequence[float],
    sets: Sequence[Engaged],
    solved: _Solved,
) -> BoxFigures:
    """The figures of a box with the sets of elements that are chosen for its gears in order."""
    forward = sum(target > 0 for target in targets)
    values = [solved(one) for one in sets]
    losses = [one.loss for one in values[:forward] or values]
    return BoxFigures(
        error=box.error,
        loss=math.fsum(losses) / len(losses),
        planet_speed=_largest(one.planet_speed for one in values),
        slip=_largest(one.slip for one in values),
        torque=_largest(one.torque for one in values),
        brakes=len(box.brakes),
        clutches=len(box.clutches),
        single=is_single(sets[:forward]) and is_single(sets[forward:]),
        planar=box_is_planar(case),
    )


Edge = tuple[int, int]
AXIS = -1
"""A vertex beside the links and the housing."""
MOST_ENDS = 2
"""Links that an elastic device joins; one of a single link stands on the housing."""


def box_is_planar(case: Transmission) -> bool:
    """Whether the graph of links, housing and axis is planar.

    Its edges are sun to carrier and carrier to ring of each set, each shift element, and the
    axis to the housing, the input and each output: these leave at the ends of the axis, where
    they, the axis and the housing lie on one face. Of a pair of gears both links go to the
    housing, which holds their shafts; wheels that share planets are sets of one carrier.

    Parameters
    ----------
    case : Transmission
        Any one.

    Raises
    ------
    CaseError
        If the library for it is missing.

    Examples
    --------
    >>> from vstatics.model.transmission import Gear, Mechanism
    >>> box_is_planar(Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()]))
    True
    """
    own = on_own_links(case).case
    ports = {own.input, own.output, *own.outputs}
    for gear in own.gears:
        ports |= {own.gear_input(gear), own.gear_output(gear)}
    edges: list[Edge] = [(AXIS, port) for port in (HOUSING, *ports)]
    for one in own.mechanisms:
        edges += [(one.first, one.third), (one.third, one.second)]
    edges += [element.links for element in own.shift_elements]
    for spring in own.springs:
        edges += pairwise([*spring.form, HOUSING][:MOST_ENDS])
    return is_planar(edges)


def is_planar(edges: Iterable[Edge]) -> bool:
    """Whether a graph is planar; an edge may come twice, or have two equal ends.

    Examples
    --------
    >>> five = range(5)
    >>> is_planar((one, other) for one in five for other in five), is_planar([(0, 1), (1, 0)])
    (False, True)
    """
    require("boxes", "whether a gearbox is planar")
    import networkx as nx  # an extra

    graph: nx.Graph[int] = nx.Graph()
    graph.add_edges_from((one, other) for one, other in edges if one != other)
    return bool(nx.check_planarity(graph)[0])
