"""Found boxes as cases with figures, against printed numbers and exact fractions."""

import json
import math
import pickle
from itertools import pairwise, permutations, product
from pathlib import Path

import pytest

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
from vstatics import load, solve
from vstatics.synthesis.boxes.box import HELD, BoxSearch, FoundBox
from vstatics.synthesis.boxes.chosen_gears import Engaged, chosen_sets, equal_sets, set_ratios
from vstatics.synthesis.boxes.figures.case import box_case
from vstatics.synthesis.boxes.figures.measured import MeasuredBox, measured
from vstatics.synthesis.boxes.figures.planar import box_is_planar
from vstatics.synthesis.structures.scheme import SetScheme

BUILT = {
    "zf-8hp70": (ZF_8HP_SEARCH, ZF_8HP),
    "simpson": (SIMPSON_SEARCH, SIMPSON),
    "zf-6hp26": (ZF_6HP_SEARCH, ZF_6HP),
}


def printed(name: str) -> dict[str, float]:
    """Ratios of a gearbox as its source has them."""
    ratios: dict[str, float] = json.loads((PUBLISHED / f"{name}.json").read_text())["ratio"]
    return ratios


@pytest.mark.parametrize("name", BUILT)
def test_gears_have_the_printed_ratios(name: str) -> None:
    search, box = BUILT[name]
    found = measured(search, box, 0.98)
    ratios = {gear.name: gear.ratio for gear in found.gears}
    assert ratios == pytest.approx(printed(name), abs=5.1e-4)
    results = solve(found.case)
    assert [gear.name for gear in results.case.gears] == list(ratios)
    assert results.ratio.tolist() == pytest.approx(list(ratios.values()), rel=1e-12)
    assert not results.messages
    assert all(results.consistent)


def test_the_eight_speed_is_the_shipped_one() -> None:
    # links and sets have other numbers there, speeds, torques and losses are the same
    own = solve(load("cases/zf-8hp70.yaml"))
    figures = measured(ZF_8HP_SEARCH, ZF_8HP, 0.98).figures
    assert figures.loss == pytest.approx(1 - own.efficiency[:8].mean(), rel=1e-12)
    assert figures.planet_speed == pytest.approx(abs(own.planet_speeds).max(), rel=1e-12)
    assert figures.slip == pytest.approx(abs(own.slip_speeds).max(), rel=1e-12)
    assert figures.torque == pytest.approx(abs(own.torques[:, :5]).max(), rel=1e-12)
    assert (figures.brakes, figures.clutches, figures.single, figures.planar) == (2, 3, True, True)


@pytest.mark.parametrize("name", BUILT)
def test_figures_are_those_of_exact_fractions(name: str) -> None:
    search, box = BUILT[name]
    short = box._replace(ratios=tuple(round(ratio, 2) for ratio in box.ratios))
    found = measured(search, short, 0.97)
    gears = oracle.solve(box_case(found.box, found.targets, 0.97))
    figures = found.figures
    losses = [1 - gear.efficiency for gear in gears if gear.ratio > 0 and gear.efficiency]  # type: ignore[operator]
    assert figures.loss == pytest.approx(float(sum(losses) / len(losses)), rel=1e-9)
    planets = [abs(one) for gear in gears for one in gear.planet_speeds if one is not None]
    assert len(planets) == len(gears) * len(box.ratios)
    assert figures.planet_speed == pytest.approx(float(max(planets)), rel=1e-9)
    open_slips, torques = [], []
    for own, gear in zip(found.case.gears, gears, strict=True):
        for number, slip in enumerate(gear.slip_speeds, 1):
            torque = gear.torques.elements[number - 1]
            assert slip is not None
            if number in own.engaged:
                assert torque is not None
                torques.append(abs(torque))
            else:
                open_slips.append(abs(slip))
    assert figures.slip == pytest.approx(float(max(open_slips)), rel=1e-9)
    assert figures.torque == pytest.approx(float(max(torques)), rel=1e-9)


def test_no_figure_without_what_it_is_of() -> None:
    # one meshed set; K = 2.5 reverses with the carrier held; planets of (2.5 - 1)/4 suns
    held = FoundBox(ZF_8HP.scheme, None, 0, 1, ((2, HELD),), (2.5,), ((0,),), 0.0)
    one = held._replace(scheme=CROWDED.scheme)
    found = measured(BoxSearch(1, 1, 1, (-1.5,), meshed=1), one, 0.98)
    assert found.gears[0].ratio == pytest.approx(1 - 2.5)
    assert found.figures.planet_speed == pytest.approx((1 + 1 / 1.5) / 0.375)
    assert math.isnan(found.figures.slip)  # nothing is open
    assert found.figures.loss > 0  # the mean of all gears, as none is forward


def test_planets_turn_where_their_carrier_is_held_for_good() -> None:
    # ring 1 backward by half of the input, planets by twice: 1/((1 - p)/2) with p = 2;
    # the second set, p = 2.5, stands on its sun: ratio -2 (1 + 1/2.5)
    scheme = SetScheme(((0, 1, 2), (3, 4, 2)))
    box = FoundBox(scheme, 1, 0, 4, ((3, HELD),), (-2.0, -2.5), ((0,),), 0.0)
    found = measured(BoxSearch(2, 1, 1, (-2.8,), fixed=1), box, 0.98)
    assert found.figures.error < 1e-12
    assert found.figures.planet_speed == pytest.approx(2.0)


def test_a_gear_of_another_sign_meets_no_target() -> None:
    found = measured(SIMPSON_SEARCH._replace(targets=(2.5, 1.5, 1.0, 2.1)), SIMPSON, 0.98)
    assert found.figures.error == math.inf


def test_a_box_goes_to_other_processes() -> None:
    found = measured(SIMPSON_SEARCH, SIMPSON, 0.98)
    assert pickle.loads(pickle.dumps(found)) == found  # noqa: S301


def lockable(third: tuple[int, int]) -> MeasuredBox:
    """A Simpson set with a clutch more, which locks its second set."""
    elements = (*SIMPSON.elements, (0, 3))
    gears = (*SIMPSON.gears[:2], third, SIMPSON.gears[3])
    return measured(
        SIMPSON_SEARCH._replace(elements=5), SIMPSON._replace(elements=elements, gears=gears), 0.98
    )


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
    for one, ratio in zip(sets, found.tolist(), strict=True):
        expected = of_gear.get(tuple(sorted(one)))
        if expected is not None:
            assert ratio == pytest.approx(expected, rel=1e-12)
    assert [len(one) for one in equal_sets(ZF_8HP)] == [1] * 9


def test_what_is_crowded_is_not_planar() -> None:
    # K5 by Kuratowski; without one of its ten edges it is planar, but the axis stands for the
    # clutch of input and output
    found = measured(CROWDED_SEARCH, CROWDED, 0.98)
    assert not found.figures.planar
    case = found.case
    for gone in range(6):
        left = [one for place, one in enumerate(case.shift_elements) if place != gone]
        gears = [case.gears[0]._replace(engaged=(1, 2))]
        ports = {case.input, case.output}
        joins_ports = set(case.shift_elements[gone].links) == ports
        assert box_is_planar(case.replace(shift_elements=left, gears=gears)) != joins_ports


@pytest.mark.slow
@pytest.mark.parametrize("path", sorted(Path("cases").glob("*.yaml")), ids=lambda path: path.stem)
def test_shipped_gearboxes_are_planar(path: Path) -> None:
    assert box_is_planar(load(path))
