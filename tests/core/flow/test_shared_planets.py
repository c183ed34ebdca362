"""Loops that may be an artefact of the model: a Ravigneaux set that is written as two mechanisms.

Teeth 30, 36, 84 (those of cases/ravigneaux-gf4a.yaml), so the small sun has +84/30 to the
ring and the large one -84/36. In gear 2 the small sun drives and the large one is held. By
hand, with M = 1 on the small sun and nothing on the carrier: 1.8 + M2 (-10/3) = 0, so the
other half has M2 = .54. With the large sun at rest c = .7 r, and 1 - c = 2.8 (r - c) gives
r = 1/1.54. The first half gives the ring 2.8/1.54, of which 1.26/1.54 come back by the
second half and the carrier.
"""

from dataclasses import replace

import pytest

from tests.chance import count, seeded
from tests.commands import json_answer, vstatics
from tests.core.flow.worked import only, sides
from vstatics import Gear, Mechanism, ShiftElement, Transmission, loads
from vstatics.core.flow.circulation import CommonLinks, Loop, Node
from vstatics.core.flow.rows import flow_grids
from vstatics.core.flow.shared_planets import shared
from vstatics.core.flow.tables import remarks
from vstatics.core.flow.text import text

AROUND = 1.26 / 1.54
M1 = Mechanism(1, 3, 4, 84 / 30, 0.97, name="m1")
M2 = Mechanism(2, 3, 4, -84 / 36, 0.97, name="m2")
BRAKE = ShiftElement(2, 0, "B")
LINKS = ("s1", "s2", "r", "c")
SET = Transmission(4, [BRAKE], [M1, M2], [Gear([1])], output=3, link_names=LINKS)
DOUBT = "may be an artefact of the model: m1 and m2 share r and c"
DECK = """
KJG= 4 KL= 1 KG= 2
NZF(I,1),I=1,KL: 2
NZF(I,2),I=1,KL: 0
NZD(I,1),I=1,KG: 1 2
NZD(I,2),I=1,KG: 3 3
NZD(I,3),I=1,KG: 4 4
IAB(I),I=1,KG: 2.8 -2.3333333333333333
ETAI(I),I=1,KG: .97 .97
NP= 1
KFRI(I),I=1,NP: 1
(NFRI(K,I),K=1,KFRI(I)),I=1,NP: 1
IOUT= 3
NAME J3: r
NAME J4: c
NAME D1: m1
NAME D2: m2
"""
BESIDE = """
links: [s1, s2, r, c, out]
shift_elements: {B: [s2, housing]}
elements: {final: {kind: gear_pair, first: r, second: out, teeth: {first: 20, second: 60}}}
mechanisms:
  m1: {first: s1, second: r, third: c, ratio: 2.8}
  m2: {first: s2, second: r, third: c, ratio: -7/3}
gears: {"2": {engaged: [B]}}
"""
HALF = "half: {kind: planetary, sun: s2, ring: r, carrier: c, teeth: {sun: 36, ring: 84}}"
WHOLE = (
    "set: {kind: ravigneaux, small_sun: s1, large_sun: s2, ring: r, carrier: c, "
    "teeth: {small_sun: 30, large_sun: 36, ring: 84, short: 22, long: 24}}"
)


def drawn(element: str, mechanisms: str = "") -> Transmission:
    return loads(f"""
links: [s1, s2, r, c]
output: r
shift_elements: {{B: [s2, housing]}}
elements:
  {element}
{mechanisms}
gears: {{"2": {{engaged: [B]}}}}
""")


def test_two_halves_of_one_set_are_marked_with_the_links_that_they_share() -> None:
    """In the flow, beside the sum and beside the loop of its tables, in text and JSON of a deck."""
    flow = only(SET)
    for side in sides(flow):
        [loop] = side.loops
        assert loop.note == DOUBT
        assert side.doubtful == side.circulating == loop.power
    assert sides(flow)[0].circulating == pytest.approx(AROUND)
    [line] = [line for line in remarks(flow) if DOUBT in line]
    assert line.strip().startswith(f"{sides(flow)[1].circulating:.3f}")
    assert any(f"; ideal {AROUND:.3f}" in line for line in remarks(flow))
    tables = {grid.title: grid for grid in flow_grids([flow])}
    [balance], [row] = tables["Balance"].texts, tables["Recirculating power"].texts
    assert balance[-1] == f"{balance[-2]} of it may be an artefact of the model"
    assert row[-1] == DOUBT
    assert DOUBT in vstatics("flow", "-", stdin=DECK.encode()).out
    [gear] = json_answer("flow", "-", stdin=DECK.encode())["gears"]
    assert [loop["note"] for loop in gear["lossy"]["loops"]] == [DOUBT]
    assert gear["ideal"]["loops"][0]["power"] == pytest.approx(AROUND)
    assert gear["ideal"]["doubtful"] == gear["ideal"]["circulating"]


def test_mechanisms_beside_elements_are_marked_like_any() -> None:
    """The same two mechanisms; behind them a final drive is an element."""
    ideal, _ = sides(only(loads(BESIDE)))
    [loop] = ideal.loops
    assert loop.note == DOUBT
    assert loop.power == pytest.approx(AROUND)


def test_a_loop_inside_one_element_is_not_counted() -> None:
    assert [side.loops for side in sides(only(drawn(WHOLE)))] == [(), ()]


def test_loops_through_an_element_a_clutch_or_a_gear_pair_are_real() -> None:
    """An element has planets of its own; two carriers that a clutch joins are those of two sets."""
    mechanism = "mechanisms:\n  m1: {first: s1, second: r, third: c, ratio: 2.8, efficiency: .97}"
    apart = replace(
        SET,
        links=5,
        link_names=("s1", "s2", "r", "c1", "c2"),
        shift_elements=[BRAKE, ShiftElement(4, 5, "C")],
        mechanisms=[M1, M2._replace(third=5)],
        gears=[Gear([1, 2])],
    )
    pairs = [Mechanism(1, 2, 3, -2.0), Mechanism(1, 2, 0, -4.0, name="pair")]
    textbook = Transmission(3, [], pairs, [Gear()])
    for case, power in ((drawn(HALF, mechanism), AROUND), (apart, AROUND), (textbook, 1)):
        ideal, _ = sides(only(case))
        assert ideal.circulating == pytest.approx(power)
        assert ideal.doubtful == 0
        assert [loop.shared for loop in ideal.loops] == [()]
        assert "artefact" not in text(only(case))


def around(*names: str) -> Loop:
    """A loop through mechanisms 1, 2, 3, ... and links by their names."""
    kinds = {name: "mechanism" if name[0] == "m" else "link" for name in names}
    nodes = [Node(kinds[name], int(name[1:]), name) for name in names]  # type: ignore[arg-type]
    return Loop(tuple(nodes), 1.0)


def many(*links: tuple[int, int, int]) -> Transmission:
    """Mechanisms m1, m2, ... between links l1, l2, ..."""
    mechanisms = [Mechanism(*own, -2.0, name=f"m{n}") for n, own in enumerate(links, 1)]
    names = tuple(f"l{number}" for number in range(1, 1 + max(map(max, links))))
    return Transmission(len(names), [], mechanisms, [Gear()], link_names=names)


def test_a_set_with_two_rings_is_three_mechanisms_that_share_a_carrier() -> None:
    """Suns 1, 2, rings 3, 4, carrier 5: the third shares a sun with the first, not with m2."""
    case = many((1, 3, 5), (2, 3, 5), (1, 4, 5))
    found = shared(case, around("l3", "m1", "l1", "m3", "l5", "m2"))
    assert found == (CommonLinks("m1", "m2", ("l3", "l5")), CommonLinks("m1", "m3", ("l1", "l5")))
    assert Loop((), 1.0, found).note == (
        "may be an artefact of the model: m1 and m2 share l3 and l5, m1 and m3 share l1 and l5"
    )
    joined_by_m3 = shared(many((1, 3, 5), (2, 4, 5), (3, 4, 5)), around("m1", "m2", "m3"))
    assert [one[:2] for one in joined_by_m3] == [("m1", "m3"), ("m3", "m2")]


def test_loops_are_real_where_no_carrier_can_be_common() -> None:
    for sets, loop, found in (
        # cases/gm-thm440.yaml, joined twice: the carrier of each is the ring of the other
        ([(1, 2, 3), (4, 3, 2)], "l2 m1 l3 m2", (CommonLinks("m1", "m2", ("l2", "l3")),)),
        # halves of one set, and a third mechanism that shares one link with each
        ([(1, 3, 5), (2, 3, 5), (1, 2, 6)], "l3 m2 l2 m3 l1 m1", ()),
        # three sets in a ring that share one link each
        ([(1, 2, 3), (2, 4, 5), (4, 1, 6)], "l2 m2 l4 m3 l1 m1", ()),
        # four in a ring; each shares two links with the next, and none is in all of them
        ([(1, 2, 3), (2, 3, 4), (3, 4, 5), (4, 5, 1)], "l2 m2 l3 m3 l5 m4 l1 m1", ()),
    ):
        assert shared(many(*sets), around(*loop.split())) == found


def test_every_loop_between_the_mechanisms_of_one_set_is_marked() -> None:
    """Toothed gears on one carrier, each written with any of those before it; one link is held.

    Of such loops the most run through two mechanisms, one in eight through three.
    """
    for seed in range(count(60, 200)):
        rng = seeded(seed)
        wheels = rng.randint(3, 6)
        ratios = [
            round(rng.uniform(0.3, 0.95), 2) * rng.choice((-4, -1, 1, 4)) for _ in range(wheels)
        ]
        sets = [
            Mechanism(wheel, rng.randint(1, wheel - 1), wheels + 1, ratio, 0.98)
            for wheel, ratio in enumerate(ratios[1:], 2)
        ]
        entry, output, brake = rng.sample(range(1, wheels + 2), 3)
        held = [ShiftElement(brake, 0)]
        flow = only(Transmission(wheels + 1, held, sets, [Gear([1])], entry, output))
        for side in (flow.ideal, flow.lossy):
            assert all(loop.shared for loop in side.loops) if side else True
