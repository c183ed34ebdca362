"""Calculation of the figures of a found gearbox and of the gears, with the solver."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from typing import Any, NamedTuple, cast

from vstatics.core.flow.power import shown_flow
from vstatics.core.model.parts import Gear
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.freewheels import find_state
from vstatics.core.statics.state import GearState, values_of
from vstatics.synthesis.boxes.box import BoxSearch, FoundBox
from vstatics.synthesis.boxes.chosen_gears import (
    Engaged,
    all_of,
    chosen_sets,
    equal_sets,
    is_single,
    set_ratios,
)
from vstatics.synthesis.boxes.figures.by_box import BoxFigures
from vstatics.synthesis.boxes.figures.by_gear import (
    BoxGear,
    GearFigures,
    check_search_weights,
    mean_drag,
    with_drag,
    without_noise,
)
from vstatics.synthesis.boxes.figures.case import (
    box_case,
    box_element_name,
    drawn_case,
    element_links,
    planet_ratio,
    ravigneaux_sets,
)
from vstatics.synthesis.boxes.figures.known import known_name
from vstatics.synthesis.boxes.figures.planar import box_is_planar
from vstatics.synthesis.boxes.figures.shifting import beyond, one_way, reversing, skip_shifts
from vstatics.synthesis.boxes.least_form import least_box
from vstatics.synthesis.gears.names import in_order, names_of_gears, set_name
from vstatics.synthesis.ratios.fitting import deviation
from vstatics.synthesis.tolerances import NO_LOAD

FIGURE_DECIMALS = 9
"""Number of decimals in comparisons of losses and other figures."""
ALIKE: Mapping[str, float] = {}
"""Weights that are equal for all gears."""


class MeasuredBox(NamedTuple):
    """Found gearbox, renumbered by `least_box`, with its characteristic numbers (figures)."""

    box: FoundBox
    targets: tuple[float, ...]
    efficiency: float
    """Basic efficiency of each gear set (carrier held). [-]"""
    gears: tuple[BoxGear, ...]
    """Gears by descending ratio, reverse gears last."""
    figures: BoxFigures

    @property
    def elements(self) -> dict[str, tuple[str, str]]:
        """Links of each shift element, by name."""
        return {box_element_name(element): element_links(element) for element in self.box.elements}

    @property
    def ratios(self) -> dict[str, float]:
        """Basic ratio of each gear set, by name [-]."""
        return {set_name(number): ratio for number, ratio in enumerate(self.box.ratios, 1)}

    @property
    def known(self) -> str | None:
        """Name of the shipped case that equals the gearbox apart from tooth numbers, if any."""
        return known_name(self.box)

    @property
    def ravigneaux(self) -> dict[str, tuple[str, str]]:
        """Pairs of gear sets that form a Ravigneaux set, by name."""
        return ravigneaux_sets(self.box)

    @property
    def case(self) -> Transmission:
        """Case of the gearbox."""
        return drawn_case(self.box, box_case(self.box, self.targets, self.efficiency))


def measured(
    search: BoxSearch, box: FoundBox, efficiency: float, weights: Mapping[str, float] = ALIKE
) -> MeasuredBox:
    """Calculate the figures of a found gearbox with the solver.

    If several sets of shift elements give the ratio of a gear, sets with a single exchange between
    neighbouring gears are preferred, then sets with the smallest loss.

    Parameters
    ----------
    search : BoxSearch
    box : FoundBox
    efficiency : float
        Basic efficiency of each gear set (carrier held), above 0 and up to 1. [-]
    weights : mapping of str to float
        Weights of forward gears in the mean drag, by the name of the gear; by default 1. [-]

    Raises
    ------
    CaseError
        If a weight does not belong to a gear that the search can find, or all weights are 0.

    Examples
    --------
    >>> from vstatics.synthesis.boxes.box import HELD
    >>> from vstatics.synthesis.structures.scheme import SetScheme
    >>> box = FoundBox(SetScheme.of_code("0-1-2"), None, 0, 1, ((2, HELD), (0, 1)), (-2.0,),
    ...                ((1,), (0,)), 0.0)
    >>> result = measured(BoxSearch(1, 2, 1, (1.0, 3.02)), box, 0.98)
    >>> for gear in result.gears:
    ...     print(gear[:4], gear.figures.torques, gear.figures.slips, gear.figures.drag)
    ('1', ('T-L2',), 3.0, 3.02) {'T-L2': -2.0} {'F-L0-L1': 0.6666666666666667} 0.6666666666666667
    ('2', ('F-L0-L1',), 1.0, 1.0) {'F-L0-L1': 1.0} {'T-L2': 1.0} 2.0
    >>> figures = result.figures
    >>> round(figures.error, 6), round(figures.loss, 6), round(figures.planet_speed, 6)
    (0.006645, 0.006667, 1.333333)
    >>> figures.slip, figures.torque, figures.single, figures.planar, figures.one_way
    (1.0, 2.0, True, True, ('T-L2',))
    """
    check_search_weights(search, weights)
    least = least_box(box)
    targets = search.targets
    # Gears of a sequence have no wanted ratio: their own ratio is the target.
    if search.sequence is not None:
        targets += tuple(set_ratios(least, least.gears[len(targets) :]).tolist())
    case = box_case(least, targets, efficiency)
    solved, order, names = _solved(case), in_order(targets), names_of_gears(targets)
    used_in = (lambda engaged: solved(engaged).carrying) if search.shafts else all_of
    sets = _chosen(least, targets, solved, used_in)
    drawn = drawn_case(least, case)
    by_gear = with_drag(
        [
            _of_gear(least, case, engaged, solved(engaged))._replace(
                circulating=_circulating(drawn, engaged)
            )
            for engaged in sets
        ]
    )
    gears = tuple(
        BoxGear(
            names[place],
            tuple(box_element_name(least.elements[number]) for number in engaged),
            solved(engaged).ratio,
            targets[place],
            gear_figures,
        )
        for place, engaged, gear_figures in zip(order, sets, by_gear, strict=True)
    )
    chosen = least._replace(
        gears=tuple(engaged for _, engaged in sorted(zip(order, sets, strict=True))),
        # infinite if a ratio and its target have opposite signs
        error=max(deviation(gear.ratio, gear.target) for gear in gears),
    )
    losses = [solved(engaged).loss for engaged in sets]
    figures = _figures(chosen, gears, losses, weights, planar=box_is_planar(case))
    return MeasuredBox(chosen, targets, efficiency, gears, figures)


class _SolvedGear(NamedTuple):
    """Results of the solver for a gear."""

    ratio: float
    loss: float
    torque: float
    """Largest torque of an engaged shift element, divided by the input torque. [-]"""
    carrying: int
    """Engaged shift elements that carry torque, as bits."""
    values: Mapping[str, Any]


def _state_of(case: Transmission, engaged: Engaged) -> GearState:
    ratios = [mechanism.ratio for mechanism in case.mechanisms]
    efficiencies = [mechanism.efficiency for mechanism in case.mechanisms]
    return find_state(case, Gear([number + 1 for number in engaged]), ratios, efficiencies)


_Solved = Callable[[Engaged], _SolvedGear]


def _solved(case: Transmission) -> _Solved:
    """Return a function with a cache that solves a case with given shift elements engaged."""

    @cache
    def solved(engaged: Engaged) -> _SolvedGear:
        state = _state_of(case, engaged)
        # Numbers are traced only for many variants, so all values here are floats.
        values = cast("Mapping[str, Any]", values_of(state))
        efficiency, torques = values["efficiency"], values["torques"]
        return _SolvedGear(
            ratio=values["ratio"],
            loss=1.0 if math.isnan(efficiency) else 1.0 - efficiency,  # no power reaches the output
            torque=_largest(torques[number] for number in engaged),
            carrying=all_of(tuple(number for number in engaged if abs(torques[number]) > NO_LOAD)),
            values=values,
        )

    return solved


def _largest(numbers: Iterable[float]) -> float:
    return max((abs(number) for number in numbers if not math.isnan(number)), default=math.nan)


def _of_gear(
    box: FoundBox, case: Transmission, engaged: Engaged, solved: _SolvedGear
) -> GearFigures:
    """Return the figures of a gear except drag and recirculating power."""
    values = solved.values
    held = range(len(box.elements))
    is_open = [number for number in held if number not in engaged]
    sets = [set_name(number) for number in range(1, len(box.ratios) + 1)]
    speeds = [0.0, *values["speeds"]]  # the speed of the housing comes first
    carriers = [speeds[mechanism.third] for mechanism in case.mechanisms]
    planets = [
        (speeds[mechanism.first] - speeds[mechanism.third]) / planet_ratio(mechanism.ratio)
        for mechanism in case.mechanisms
    ]

    def of(numbers: Iterable[int], name: str) -> dict[str, float]:
        chosen = [*numbers]
        names = (box_element_name(box.elements[number]) for number in chosen)
        return without_noise(names, (values[name][number] for number in chosen))

    return GearFigures(
        torques=of(engaged, "torques"),
        slips=of(is_open, "slip_speeds"),
        carriers=without_noise(sets, carriers),
        planets=without_noise(sets, planets),
        losses=without_noise(sets, values["losses"]),
        circulating=math.nan,
        drag=math.nan,
    )


def _circulating(case: Transmission, engaged: Engaged) -> float:
    flow = shown_flow(_state_of(case, engaged))
    return math.nan if flow is None else flow.circulating


def _chosen(
    box: FoundBox,
    targets: Sequence[float],
    solved: _Solved,
    used_in: Callable[[Engaged], int],
) -> Sequence[Engaged]:
    order, choices = in_order(targets), equal_sets(box)
    ranges = [
        [choices[index] for index in order if (targets[index] > 0) == forward]
        for forward in (True, False)
    ]

    def cost(engaged: Engaged) -> tuple[float, float]:
        gear = solved(engaged)
        return round(gear.loss, FIGURE_DECIMALS), round(gear.torque, FIGURE_DECIMALS)

    return chosen_sets(ranges, len(box.elements), cost, used_in)


def _figures(
    box: FoundBox,
    gears: Sequence[BoxGear],
    losses: Sequence[float],
    weights: Mapping[str, float],
    *,
    planar: bool,
) -> BoxFigures:
    forward = sum(gear.target > 0 for gear in gears)
    of_mean = gears[:forward] or gears
    by_gear = [gear.figures for gear in gears]
    lost = losses[: len(of_mean)]
    sets = [gear.engaged for gear in gears]
    return BoxFigures(
        error=box.error,
        loss=math.fsum(lost) / len(lost),
        planet_speed=_largest(
            speed for gear_figures in by_gear for speed in gear_figures.planets.values()
        ),
        slip=_largest(slip for gear_figures in by_gear for slip in gear_figures.slips.values()),
        torque=_largest(
            torque for gear_figures in by_gear for torque in gear_figures.torques.values()
        ),
        brakes=len(box.brakes),
        clutches=len(box.clutches),
        drag=mean_drag({gear.name: gear.figures.drag for gear in of_mean}, weights),
        skip_shifts=skip_shifts(sets[:forward]),
        reversing=reversing(by_gear),
        one_way=one_way(by_gear, [box_element_name(brake) for brake in box.brakes]),
        beyond=beyond(box, [gear.ratio for gear in gears]),
        single=is_single(sets[:forward]) and is_single(sets[forward:]),
        planar=planar,
    )
