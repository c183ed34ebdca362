"""Found boxes as cases with figures, against printed numbers and exact fractions; held members."""

import math
import pickle
from itertools import pairwise, permutations, product

import pytest

from tests.commands import json_file
from tests.oracle import gears as oracle
from tests.shipped import PUBLISHED
from tests.synthesis.boxes.hand_boxes import (
    CROWDED,
    CROWDED_SEARCH,
    SIMPSON,
    SIMPSON_SEARCH,
    ZF_6HP,
    ZF_6HP_SEARCH,
    ZF_8HP,
    ZF_8HP_SEARCH,
)
from vstatics import solve
from vstatics.core.explain.bodies import on_own_links
from vstatics.core.readers import read
from vstatics.core.writers import deck
from vstatics.core.writers.named import mapping, write_json, write_yaml
from vstatics.synthesis.boxes.box import HELD, BoxSearch, FoundBox
from vstatics.synthesis.boxes.chosen_gears import Engaged, chosen_sets, equal_sets, set_ratios
from vstatics.synthesis.boxes.figures.case import box_case
from vstatics.synthesis.boxes.figures.measured import MeasuredBox, measured
from vstatics.synthesis.boxes.figures.planar import box_is_planar
from vstatics.synthesis.structures.scheme import SetScheme
from vstatics.synthesis.teeth.layout import teeth_layouts

BUILT = {
    "zf-8hp70": (ZF_8HP_SEARCH, ZF_8HP),
    "simpson": (SIMPSON_SEARCH, SIMPSON),
    "zf-6hp26": (ZF_6HP_SEARCH, ZF_6HP),
}


@pytest.mark.parametrize("name", BUILT)
def test_gears_have_the_printed_ratios(name: str) -> None:
    found = measured(*BUILT[name], 0.98)
    ratios = {gear.name: gear.ratio for gear in found.gears}
    printed = json_file(PUBLISHED / f"{name}.json")["ratio"]
    assert ratios == pytest.approx(printed, abs=5.1e-4)
    results = solve(found.case)
    assert [gear.name for gear in results.case.gears] == list(ratios)
    assert results.ratio.tolist() == pytest.approx(list(ratios.values()), rel=1e-12)
    assert not results.messages
    assert all(results.consistent)
    assert pickle.loads(pickle.dumps(found)) == found  # noqa: S301 - to other processes


@pytest.mark.parametrize("name", BUILT)
def test_figures_are_those_of_exact_fractions(name: str) -> None:
    search, box = BUILT[name]
    found = measured(search, box._replace(ratios=tuple(round(one, 2) for one in box.ratios)), 0.97)
    gears = oracle.solve(box_case(found.box, found.targets, 0.97))
    figures = found.figures
    forward = [gear for gear in gears if gear.ratio > 0]  # type: ignore[operator]
    losses = [1 - gear.efficiency for gear in forward if gear.efficiency]
    assert figures.loss == pytest.approx(float(sum(losses) / len(losses)), rel=1e-9)
    planets = [abs(one) for gear in gears for one in gear.planet_speeds if one is not None]
    assert len(planets) == len(gears) * len(box.ratios)
    assert figures.planet_speed == pytest.approx(float(max(planets)), rel=1e-9)
    slips, torques = [], []
    for own, gear in zip(found.case.gears, gears, strict=True):
        for number, slip in enumerate(gear.slip_speeds, 1):
            torque = gear.torques.elements[number - 1]
            if number in own.engaged:
                torques.append(abs(torque))  # type: ignore[arg-type]
            else:
                slips.append(abs(slip))  # type: ignore[arg-type]
    assert figures.slip == pytest.approx(float(max(slips)), rel=1e-9)
    assert figures.torque == pytest.approx(float(max(torques)), rel=1e-9)
    assert (figures.brakes, figures.clutches) == (len(box.brakes), len(box.clutches))
    assert (figures.single, figures.planar) == (True, True)


def test_no_figure_without_what_it_is_of() -> None:
    # one meshed set; K = 2.5 reverses with the carrier held; planets of (2.5 - 1)/4 suns
    one = FoundBox(CROWDED.scheme, None, 0, 1, ((2, HELD),), (2.5,), ((0,),), 0.0)
    found = measured(BoxSearch(1, 1, 1, (-1.5,), meshed=1), one, 0.98)
    assert found.gears[0].ratio == pytest.approx(1 - 2.5)
    assert found.figures.planet_speed == pytest.approx((1 + 1 / 1.5) / 0.375)
    assert math.isnan(found.figures.slip)  # nothing is open
    assert found.figures.loss > 0  # the mean of all gears, as none is forward
    other = SIMPSON_SEARCH._replace(targets=(2.5, 1.5, 1.0, 2.1))  # the last one backward
    assert measured(other, SIMPSON, 0.98).figures.error == math.inf


def test_planets_turn_where_their_carrier_is_held_for_good() -> None:
    # ring 1 backward by half of the input, planets by twice: 1/((1 - p)/2) with p = 2;
    # the second set, p = 2.5, stands on its sun: ratio -2 (1 + 1/2.5)
    scheme = SetScheme(((0, 1, 2), (3, 4, 2)))
    box = FoundBox(scheme, 1, 0, 4, ((3, HELD),), (-2.0, -2.5), ((0,),), 0.0)
    found = measured(BoxSearch(2, 1, 1, (-2.8,), fixed=1), box, 0.98)
    assert found.figures.error < 1e-12
    assert found.figures.planet_speed == pytest.approx(2.0)


def lockable(third: tuple[int, int]) -> MeasuredBox:
    """A Simpson set with a clutch more, which locks its second set."""
    gears = (*SIMPSON.gears[:2], third, SIMPSON.gears[3])
    box = SIMPSON._replace(elements=(*SIMPSON.elements, (0, 3)), gears=gears)
    return measured(SIMPSON_SEARCH._replace(elements=5), box, 0.98)


def test_of_equal_gears_those_are_taken_that_change_one_element() -> None:
    # direct drive: the input to two links, or to one with a set locked; A stays from gear 2.
    # The least code is 0-1-2-0-2-3: L0 the sun, L1 carrier 2, L3 ring 1, L4 the input
    found = lockable((1, 4))
    direct = found.gears[2]
    assert (direct.ratio, direct.engaged) == (1.0, ("F-L0-L1", "F-L3-L4"))
    assert found.figures.single
    assert lockable((0, 4)).gears == found.gears


def test_the_choice_is_the_best_of_all() -> None:
    # by looking at every choice; of two ranges, the second of one gear
    sets: list[Engaged] = [(0, 1), (0, 2), (1, 2), (2, 3)]
    ranges = [[sets[:2], sets[1:], sets[2:]], [sets[::2]]]
    costs = {one: (float(sum(one)), 0.0) for one in sets}

    def worth(way: tuple[Engaged, ...]) -> tuple[float, ...]:
        gone = [len(set(one) - set(other)) for one, other in pairwise(way[:3])]
        return sum(one > 1 for one in gone), sum(gone), math.fsum(costs[one][0] for one in way)

    ways = [way for way in product(*ranges[0], *ranges[1]) if {0, 1, 2, 3} <= set(sum(way, ()))]
    chosen = chosen_sets(ranges, 4, costs.__getitem__)
    assert chosen in ways
    assert worth(chosen) == min(map(worth, ways))


def test_ratios_of_all_sets_are_those_of_the_solver() -> None:
    sets = list(permutations(range(5), 3))
    found = set_ratios(ZF_8HP, sets)
    case = measured(ZF_8HP_SEARCH, ZF_8HP, 1.0).case
    of_gear = dict(zip(ZF_8HP.gears, solve(case).ratio.tolist(), strict=True))
    for own, ratio in zip(sets, found.tolist(), strict=True):
        if (gear := tuple(sorted(own))) in of_gear:
            assert ratio == pytest.approx(of_gear[gear], rel=1e-12)
    assert [len(one) for one in equal_sets(ZF_8HP)] == [1] * 9


def test_what_is_crowded_is_not_planar() -> None:
    # K5 by Kuratowski; without one of its ten edges it is planar, but the axis stands for the
    # clutch of input and output
    found = measured(CROWDED_SEARCH, CROWDED, 0.98)
    assert not found.figures.planar
    case = found.case
    gears = [case.gears[0]._replace(engaged=(1, 2))]
    for gone in case.shift_elements:
        left = [one for one in case.shift_elements if one != gone]
        joins_ports = {*gone.links} == {case.input, case.output}
        assert box_is_planar(case.replace(shift_elements=left, gears=gears)) != joins_ports


@pytest.mark.parametrize(("held", "key"), [(0, "first"), (1, "third"), (2, "second")])
@pytest.mark.parametrize(("ratio", "kind"), [(-2.5, "planetary"), (2.5, "double_planet")])
def test_a_held_member_is_kept_in_files_and_for_teeth(
    held: int, key: str, ratio: float, kind: str
) -> None:
    """One set with sun, carrier or ring held, from one of the others to the third, locked too."""
    first, last = (link for link in range(3) if link != held)
    box = FoundBox(CROWDED.scheme, held, first, last, ((first, last),), (ratio,), ((0,),), 0.0)
    case = box_case(box, [1.0], 0.98)
    assert mapping(case)["mechanisms"]["P1"][key] == "housing"
    assert read(write_yaml(case).encode(), "a.yaml").case.mechanisms == case.mechanisms
    assert read(write_json(case).encode(), "a.json").case == case
    (layout,) = teeth_layouts(on_own_links(case))
    assert layout.element.kind == kind
    assert layout.element.link(("sun", "carrier", "ring")[held]) == 0


def test_a_pair_has_no_third_link() -> None:
    for third, is_set in (("", False), (", third: housing", True)):
        pair = f"{{g: {{first: 1, second: 2{third}, ratio: 2}}}}"
        case = read(f"links: 2\nmechanisms: {pair}\ngears: {{1: {{}}}}".encode(), "a.yaml").case
        assert case.mechanisms[0].is_set is is_set
        assert ("third" in mapping(case)["mechanisms"]["g"]) is is_set
        assert ("third: housing of mechanism g" in deck.lost(case)) is is_set
