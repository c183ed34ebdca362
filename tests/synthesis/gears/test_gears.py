"""Combinations of shift elements against published tables, closed forms and other ways."""

import math
from typing import Any

import pytest

from vstatics import CaseError, Gear, Mechanism, ShiftElement, Spring, Transmission, solve
from vstatics.synthesis import SetScheme, combinations, scheme_case
from vstatics.synthesis.gears.kinds import kind_alone
from vstatics.synthesis.gears.search import CombinationSearch, chosen_elements

P1, P2, P3, P4 = 2.0, 2.6, 2.2, 2.4
BELAZ = {
    ("F1", "F2"): ("direct", 1.0),
    ("F1", "T3"): ("gear", 1 + P3),
    ("F1", "T2"): ("gear", (1 + P2) * (1 + P3) / (1 + P2 + P3)),
    ("F1", "T4"): ("gear", 1 - P3 * P4),
    ("F2", "T1"): ("gear", (1 + P1) / P1),
    ("T1", "T3"): ("gear", (1 + P1) / P1 * (1 + P3)),
    ("T1", "T2"): ("gear", (1 + P1) / P1 * (1 + P2) * (1 + P3) / (1 + P2 + P3)),
    ("T1", "T4"): ("gear", (1 + P1) / P1 * (1 - P3 * P4)),
    ("F1", "T1"): ("blocked", None),
}
"""Evseenko, tables 1 and 2, with ratios by Willis for ring by sun = p; all others park."""


def belaz() -> Transmission:
    """Links J1..J7; sets sun, ring, carrier."""
    sets = [(3, 1, 2), (2, 4, 5), (2, 5, 7), (5, 6, 7)]
    links = {"F1": (1, 2), "F2": (2, 5), "T1": (3, 0), "T2": (4, 0), "T3": (5, 0), "T4": (6, 0)}
    elements = [ShiftElement(*pair, name=name) for name, pair in links.items()]
    mechanisms = [Mechanism(*own, -p) for own, p in zip(sets, (P1, P2, P3, P4), strict=True)]
    return Transmission(7, elements, mechanisms, [Gear([1, 2])])


def test_belaz_7516_as_published() -> None:
    found = combinations(belaz())
    assert len(found) == 15
    for one in found:
        first, second = one.engaged
        kind, ratio = BELAZ.get((first, second), ("parking", None))
        assert (one.kind, one.free) == (kind, False), one
        assert one.ratio == pytest.approx(ratio, rel=1e-12) if ratio else one.ratio != one.ratio


def kinds(case: Transmission, *engaged: int) -> list[tuple[str, bool]]:
    return [(one.kind, one.free) for one in combinations(case, engaged)]


SIMPLE = Mechanism(1, 2, 3, -2.5)


def names(case: Transmission) -> list[str]:
    """Of all elements there can be."""
    return [one.name for one in CombinationSearch(case, elements=["auto"]).elements]


def one_set(*elements: ShiftElement, **more: Any) -> Transmission:
    return Transmission(3, elements, [SIMPLE], [Gear()], **more)


def test_one_set_with_nothing_and_with_too_much_engaged() -> None:
    """A differential; two brakes hold all of it, a clutch beside a brake, too."""
    case = one_set(ShiftElement(2), ShiftElement(1, 2), ShiftElement(1))
    assert kinds(case, 0) == [("neutral", False)]
    assert kinds(case, 2) == [("blocked", False)] * 3
    assert kinds(case, 3, 0) == [("blocked", False), ("neutral", False)]
    [freewheel] = combinations(one_set(ShiftElement(2, kind="freewheel", name="L")))
    assert freewheel.ratio == pytest.approx(3.5)  # it counts as one that holds


def test_free_links_are_named() -> None:
    """A second set hangs on a link: as long as nothing holds it, two of its speeds are open."""
    elements = [ShiftElement(2), ShiftElement(4), ShiftElement(1, 2), ShiftElement(1)]
    case = Transmission(5, elements, [SIMPLE, Mechanism(4, 5, 3, -2)], [Gear()], output=3)
    free = [("gear", True), ("neutral", False), ("direct", True), ("blocked", True)]
    assert kinds(case, 1) == free
    assert kinds(case, 2)[0] == ("gear", False)


def test_ratio_1_by_chance_is_no_direct_drive() -> None:
    """Two sets in series with K and 1/K have 1 by their numbers; a clutch by itself.

    Two equal sets beside each other are one set; of different ratios they lock.
    """
    pairs = [Mechanism(1, 2, 0, -3), Mechanism(2, 3, 0, -1 / 3)]
    case = Transmission(3, [ShiftElement(1, 3)], pairs, [Gear()])
    assert [(one.kind, one.ratio) for one in combinations(case, [0])] == [("gear", 1.0)]
    assert combinations(case, [1])[0].kind == "gear"
    alike = one_set(ShiftElement(1, 2)).replace(mechanisms=[SIMPLE, SIMPLE])
    assert combinations(alike)[0].kind == "direct"
    braked = alike.replace(shift_elements=[ShiftElement(2)])
    assert combinations(braked, [1])[0].ratio == pytest.approx(3.5)
    other = braked.replace(mechanisms=[SIMPLE, SIMPLE._replace(ratio=-2.6)])
    assert [(one.engaged, one.kind) for one in combinations(other)] == [([], "direct")]
    assert kinds(other, 1) == [("blocked", False)]


def test_springs_turn_as_shafts_at_mean_speeds() -> None:
    damper = Spring({4: 1, 1: -1}, stiffness=1000)
    elements = [ShiftElement(2), ShiftElement(4, 3)]
    case = Transmission(4, elements, [SIMPLE], [Gear()], input=4, output=3, springs=[damper])
    low, direct = combinations(case)
    assert (low.kind, direct.kind) == ("gear", "direct")
    assert [low.ratio, direct.ratio] == pytest.approx([3.5, 1])


def test_all_elements_have_names_by_their_links() -> None:
    """None on input and output; those of the case keep their names, and their order."""
    sets, given = [SIMPLE, Mechanism(2, 3, 4, -2)], [ShiftElement(2, name="B"), ShiftElement(4)]
    case = Transmission(4, given, sets, [Gear()], link_names=["in", "x", "y-z", "out"])
    expected = ["F-in-x", "F-in-y-z", "F-in-out", "F-x-y-z", "F-x-out", "F-y-z-out", "B", "T-y-z"]
    assert names(case) == expected
    some = belaz().replace(shift_elements=CombinationSearch(belaz(), elements=["auto"]).elements)
    assert names(some) == names(belaz())
    fewer = some.replace(shift_elements=some.shift_elements[5:9])
    assert {"F-1-7", "F-2-3", "T-4"} < {*names(fewer)}
    found = combinations(belaz(), [1], ["T2", "F1", "3"])
    assert [one.engaged for one in found] == [["F1"], ["T1"], ["T2"]]


def test_names_that_would_be_the_same_are_numbers() -> None:
    """The clutches a-b to c and a to b-c would both be F-a-b-c."""
    case = belaz().replace(link_names=["a-b", "x", "c", "a", "y", "b-c", "z"])
    taken = case.replace(shift_elements=[ShiftElement(3, 7, "F-1-3"), *case.shift_elements[1:]])
    for one, has in (case, {"F1", "F-1-3", "F-4-6"}), (taken, {"F-1-3", "F-1-3'"}):
        assert len({*names(one)}) == len(names(one)) == 26
        assert has < {*names(one)}


def test_batches_do_not_matter(monkeypatch: pytest.MonkeyPatch) -> None:
    expected = combinations(belaz(), [0, 1, 2], "auto")
    assert [len(set(one.engaged)) for one in expected].count(2) == 325
    monkeypatch.setattr(CombinationSearch, "_room", lambda *_: 50)
    again = combinations(belaz(), [0, 1, 2], "auto")
    assert list(map(str, again)) == list(map(str, expected))


def test_alone_and_on_arrays_agree() -> None:
    case = belaz()
    links = {element.name: element.links for element in case.shift_elements}
    for one in combinations(case, [0, 1, 2, 3, 4]):
        alone = kind_alone(case, [links[name] for name in one.engaged])
        kind = one.kind.replace("direct", "gear")
        assert (alone.kind.word, alone.free) == (kind, one.free)
        assert alone.ratio == pytest.approx(one.ratio, rel=1e-12, nan_ok=True)


@pytest.mark.parametrize("engaged", [2, 3])
def test_torques_are_those_of_the_statics(engaged: int) -> None:
    """One solution of all equations for each gear; where elements share, there is none to tell."""
    case = belaz().replace(idle="exact")
    elements = chosen_elements(case, ["auto"])
    number = {element.name: place for place, element in enumerate(elements, 1)}
    found = [one for one in combinations(case, engaged, "auto") if one.torques is not None][:400]
    gears = [Gear([number[name] for name in one.engaged]) for one in found]
    results = solve(case.replace(shift_elements=elements, gears=gears))
    told = 0
    for one, torques in zip(found, results.torques.tolist(), strict=True):
        assert one.torques is not None
        for name, torque in one.torques.items():
            if not math.isnan(torque):
                told += 1
                expected = torques[number[name] - 1]
                assert torque == pytest.approx(expected, rel=1e-9, abs=1e-9), one
    assert told > 100


def test_elements_that_hold_the_same_share_a_torque_that_nobody_tells() -> None:
    """Two brakes on a ring, and a clutch that is direct with them open: 1/slip."""
    brakes = ShiftElement(2), ShiftElement(2, 0, "twin")
    case = one_set(*brakes, ShiftElement(1, 2), ShiftElement(3, 1))
    [both] = [one for one in combinations(case, 2) if one.engaged == ["T1", "twin"]]
    assert both.torques is not None
    assert [*map(math.isnan, both.torques.values())] == [True, True]
    direct = [one for one in combinations(case, 1) if one.kind == "direct"]
    # with the carrier held the ring turns at 1/-2.5: 1 - 1/u, and u = -2.5 itself joins the ports
    assert [one.slip for one in direct] == pytest.approx([1 + 1 / 2.5, -1.0])


def test_ratios_of_any_size() -> None:
    """A clutch joins everything behind a set of 1e10: rows that lose digits go another way."""
    sets = (8, 5, 6, -8 / 3), (7, 5, 2, 1e10), (4, 8, 3, -3), (4, 2, 6, -2.5)
    elements = [ShiftElement(5, 8), ShiftElement(4, 8), ShiftElement(4, 7)]
    case = Transmission(8, elements, [Mechanism(*one) for one in sets], [Gear()], input=3)
    [found] = combinations(case, [3])
    assert found[:4] == (["F1", "F2", "F3"], "direct", 1.0, True)


def test_what_cannot_be_tried_is_reported() -> None:
    """399 links have 80 thousand pairs: nothing of that size is made before it is refused."""
    sets = [Mechanism(2 * n - 1, 2 * n, 2 * n + 1, -2) for n in range(1, 200)]
    long = Transmission(399, [], sets, [Gear()])
    alone = belaz().replace(shift_elements=[], gears=[Gear()])
    wrong: dict[str, tuple[Transmission, dict[str, Any]]] = {
        "read 7 engaged shift elements, expected 0 to 6": (belaz(), {"engaged": 7}),
        "more than the limit of 100": (belaz(), {"elements": "auto", "at_most": 100}),
        "did you mean `F1`": (belaz(), {"elements": ["f1"]}),
        "2 engaged shift elements leave one degree of freedom": (alone, {}),
        "more than 1e.200 combinations": (long, {"elements": "auto"}),
    }
    for said, (case, given) in wrong.items():
        with pytest.raises(CaseError, match=said):
            combinations(case, **given)
    with pytest.raises(CaseError, match="too many for the memory"):
        CombinationSearch(long, [1], ["auto"]).check(10**6)
    brakes = long.replace(shift_elements=[ShiftElement(link) for link in range(2, 399)])
    with pytest.raises(CaseError, match="too many for an hour"):
        CombinationSearch(brakes, [396]).check(1000)


def test_a_converter_which_takes_power_and_may_be_bypassed_is_no_part_of_combinations() -> None:
    converter = Mechanism(1, 2, 0, 0.8, kind="converter", points=((0, 2), (1, 1)), name="TC")
    sets = [converter, Mechanism(2, 3, 0, -2.0)]
    case = one_set(ShiftElement(1, 2)).replace(mechanisms=sets)
    with pytest.raises(CaseError, match=r"no converter \(TC\).* its turbine as `input`"):
        CombinationSearch(case)


def test_a_row_of_reductions_is_their_product() -> None:
    """Rings braked: each set of the row reduces by 1 - K, from sun to carrier."""
    case = scheme_case(SetScheme.of_code("0-1-2-1-3-4-3-5-6"), 0, 5, (-2.0, -2.5, -3.0))
    own = [element.name for element in case.shift_elements]
    wanted = tuple(own.index(name) + 1 for name in ("T-L2", "T-L4", "T-L6"))
    [gear] = [number for number, one in enumerate(case.gears) if one.engaged == wanted]
    assert solve(case).ratio[gear] == pytest.approx(3 * 3.5 * 4, rel=1e-12)
    assert case.gears[gear].name == "1"


def test_many_combinations_of_a_scheme_are_all_tried() -> None:
    """Six of eight sets in a row by ring and sun: 3432, and the first that gives a gear is late."""
    chain = "0-1-2-0-3-1-2-4-5-5-6-7-7-8-9-9-10-11-11-12-13-13-14-15"
    case = scheme_case(SetScheme.of_code(chain), 0, 14, [-2 - number / 10 for number in range(8)])
    assert len(case.gears) > 1
    results = solve(case)
    assert results.calculable.all()
    assert len(set(results.ratio.round(9))) == len(case.gears)


@pytest.mark.parametrize("code", ["0-1-2-0-3-4-5-2-6-7-8-1", "0-1-2-3-4-1-2-5-6"])
def test_every_speed_is_determined_in_a_gear_of_a_scheme(code: str) -> None:
    scheme = SetScheme.of_code(code)
    case = scheme_case(scheme, scheme.links - 1, scheme.links - 3, [-2.0] * len(scheme.sets))
    assert solve(case).calculable.all()
    assert all(len(gear.engaged) == scheme.mobility - 1 for gear in case.gears)
