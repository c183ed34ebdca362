"""Power flow and circulating power: test rigs and differentials worked by hand."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from tests.commands import LOCKED, NEUTRAL, TIED_UP, vstatics
from vstatics import Gear, Mechanism, Results, ShiftElement, Transmission, load, solve
from vstatics.flow.circulation import Edge, Node, cancel
from vstatics.flow.power import GearFlow, PowerFlow, flows
from vstatics.flow.text import text
from vstatics.model.parts import Load
from vstatics.readers.named.reader import read_yaml
from vstatics.tables.values import tables

CASES = sorted(path for path in (Path(__file__).parents[2] / "cases").iterdir())


def only(case: Transmission) -> GearFlow:
    """The flow of a case of one gear."""
    [flow] = flows(solve(case))
    return flow


def sides(flow: GearFlow) -> tuple[PowerFlow, PowerFlow]:
    """Without and with losses; both exist."""
    assert flow.ideal is not None
    assert flow.lossy is not None
    return flow.ideal, flow.lossy


def through(side: PowerFlow) -> dict[str, float]:
    """The power through whatever has this name; names of one case differ."""
    return {str(node): value for node, value in side.throughput.items()}


def lost(side: PowerFlow) -> dict[str, float]:
    return {str(node): value for node, value in side.losses.items()}


def around(side: PowerFlow) -> list[tuple[str, object]]:
    """Each loop and its power."""
    return [(" ".join(map(str, loop.nodes)), loop.power) for loop in side.loops]


def rig(torque: float, efficiency: float) -> Transmission:
    """A back-to-back test rig: two gear pairs of one efficiency, joined by two shafts.

    Shaft 1 bears the first wheels of both pairs and is driven. The second shaft is cut, and
    a bevel differential joins its halves 2 and 3; a torque on its cage 4, which stands as
    one pair has an idler, is what is locked in. What little is left goes off at 2.
    """
    return Transmission(
        4,
        [],
        [
            Mechanism(1, 2, 0, -2.0, efficiency, name="tested"),
            Mechanism(1, 3, 0, 2.0, efficiency, name="returning"),
            Mechanism(2, 3, 4, -1.0, 1.0, name="lock"),
        ],
        [Gear(torques={4: torque})],
        output=2,
        link_names=("drive", "half", "other half", "cage"),
    )


def test_a_back_to_back_rig_circulates_ten_times_what_drives_it() -> None:
    """By hand, from the principle of the four-square rig: the drive covers the losses alone.

    Equilibrium: cage -2 M = 40, so M = -20 at both halves, which turn at -1/2 and 1/2: 10
    go from the half through the lock to the other half. Ideal: 10 return to the drive,
    1 comes from outside, 11 go out by the tested pair, 1 is left.
    """
    ideal, lossy = sides(only(rig(40.0, 0.98)))
    assert around(ideal) == [("drive tested half lock other half returning", pytest.approx(10))]
    assert through(ideal)["tested"] == pytest.approx(11)
    assert ideal.leaving == pytest.approx(1)
    # with losses: 10 * .98 return; (1 + 9.8) * .98 = 10.584 arrive, of which 10 go round
    assert around(lossy) == [("drive tested half lock other half returning", pytest.approx(9.8))]
    assert through(lossy)["drive"] == pytest.approx(10.8)
    assert through(lossy)["half"] == pytest.approx(10.584)
    assert lossy.leaving == pytest.approx(0.584)
    assert lost(lossy) == pytest.approx({"tested": 0.216, "returning": 0.2, "lock": 0}, abs=1e-12)
    assert {str(n): s for n, s in lossy.shares.items()} == pytest.approx(
        {"tested": 0.216 / 0.416, "returning": 0.2 / 0.416, "lock": 0}, abs=1e-12
    )
    assert lossy.circulating_share == pytest.approx(9.8)


def test_a_torque_locked_in_the_other_way_turns_the_loop_round() -> None:
    """As above with M = 20: 10 go from the other half to the half, 9 come back by `tested`."""
    ideal, _ = sides(only(rig(-40.0, 0.98)))
    assert around(ideal) == [("drive returning other half lock half tested", pytest.approx(9))]


def split(u: float, r: float) -> Transmission:
    """A differential whose first and second link are joined by a branch of ratio r."""
    return Transmission(
        3,
        [],
        [
            Mechanism(1, 2, 3, u, name="differential"),
            Mechanism(1, 2, 0, r, name="branch"),
        ],
        [Gear()],
        link_names=("in", "side", "out"),
    )


@pytest.mark.parametrize("u", [-0.6, -2.0, -3.5, 2.5])
@pytest.mark.parametrize("r", [-5.0, -3.0, -1.5, -0.4, 0.7, 1.8, 4.0])
def test_the_branches_of_a_coupled_differential_share_as_its_speeds_say(u: float, r: float) -> None:
    """Two branches as in Macmillan (1961), Power flow and loss in differential mechanisms.

    J. Mech. Eng. Sci. 3(1), 37-41; the closed form is derived here. Torques on first, second, third are as 1 : -u : u - 1, speeds of the first two as
    1 : 1/r. So their powers are as 1 : -u/r, and together 1: phi = 1/(1 - u/r) by the
    first link, 1 - phi by the branch. Where phi > 1 the branch carries phi - 1 back;
    where phi < 0 the differential gives |phi| back to the input.
    """
    phi = 1 / (1 - u / r)
    ideal, lossy = sides(only(split(u, r)))
    for side in (ideal, lossy):
        powers = {one.member: one.power for one in side.members if one.device.name[0] == "d"}
        assert powers == pytest.approx({"first": phi, "second": 1 - phi, "third": -1})
        assert side.circulating == pytest.approx(max(phi - 1, -phi, 0), abs=1e-12)
        assert lost(side) == ({} if side is ideal else {"differential": 0, "branch": 0})
    expected = {True: ["in differential side branch"], False: ["in branch side differential"]}
    assert [nodes for nodes, _ in around(ideal)] == ([] if 0 <= phi <= 1 else expected[phi > 1])


def test_a_planetary_reduction_has_no_circulation() -> None:
    """Sun in, ring held, carrier out, eta .97: the carrier gives (1 + 2.5 * .97)/3.5."""
    reducer = Transmission(
        3, [ShiftElement(2, 0, "B")], [Mechanism(1, 2, 3, -2.5, 0.97, name="set")], [Gear([1])]
    )
    ideal, lossy = sides(only(reducer))
    out = (1 + 2.5 * 0.97) / 3.5
    assert ideal.loops == lossy.loops == lossy.locked_in == ()
    assert through(lossy) == pytest.approx(
        {"1": 1, "2": 0, "3": out, "B": 0, "set": 1, "input": 1, "output": out}, abs=1e-12
    )
    assert lost(lossy) == pytest.approx({"set": 1 - out})


def test_a_set_that_turns_as_one_piece_does_not_circulate() -> None:
    """Sun and carrier joined, ring out, by hand.

    The ring's torque -u M is -1, so with u = -2 the set gives .5 to the sun, which the clutch takes back to the carrier.
    """
    case = Transmission(
        3, [ShiftElement(1, 3, "C")], [Mechanism(1, 2, 3, -2.0, name="set")], [Gear([1])], output=2
    )
    ideal, lossy = sides(only(case))
    assert ideal.circulating == lossy.circulating == 0
    [loop] = ideal.locked_in
    assert " ".join(map(str, loop.nodes)) == "1 C 3 set"
    assert loop.power == pytest.approx(0.5)
    assert through(ideal)["C"] == pytest.approx(1.5)


def pair(**gear: object) -> Transmission:
    """A gear pair of ratio 4 and efficiency .95, and a clutch between its links that is open."""
    clutch = ShiftElement(1, 2, "C", drag=0.01)
    made = Gear(**gear)  # type: ignore[arg-type]
    return Transmission(2, [clutch], [Mechanism(1, 2, 0, 4.0, 0.95, name="pair")], [made])


def test_drag_takes_its_power_from_links_and_slipping_elements() -> None:
    """The clutch slips by 3/4: it takes .01 from link 1 and gives .0025 to link 2.

    The pair loses .05 of .99; link 2, at 1/4, is braked by .02.
    """
    ideal, lossy = sides(only(pair(drag={2: 0.02})))
    assert lost(ideal) == {}
    assert "C" not in through(ideal)
    losses = {(node.kind, str(node)): value for node, value in lossy.losses.items()}
    assert losses == pytest.approx(
        {("mechanism", "pair"): 0.0495, ("element", "C"): 0.0075, ("drag", "2"): 0.005}
    )
    assert lossy.leaving == pytest.approx(1 - 0.0495 - 0.0075 - 0.005)
    assert lossy.balance == pytest.approx(0, abs=1e-15)


def test_coasting_power_goes_from_the_output_to_the_input() -> None:
    """1 leaves at the input link, so without drag 1/.95 goes into the pair.

    The open clutch gives what it takes from link 1 (.01 * 1) less the loss of .0075 to link 2.
    """
    ideal, lossy = sides(only(replace(pair(), coast=True)))
    assert {(str(edge.source), str(edge.target)) for edge in ideal.edges} == {
        ("output", "2"),
        ("2", "pair"),
        ("pair", "1"),
        ("1", "input"),
    }
    assert lossy.leaving == pytest.approx(1)
    assert through(lossy)["pair"] == pytest.approx((1 + 0.01) / 0.95)
    assert lossy.entering == pytest.approx((1 + 0.01) / 0.95 - 0.0025)
    assert lost(lossy) == pytest.approx({"pair": (1 + 0.01) * (1 / 0.95 - 1), "C": 0.0075})


def test_a_freewheel_that_holds_carries_power() -> None:
    """The input turns the output by a freewheel, which is in no list of engaged elements."""
    freewheel = ShiftElement(2, 1, "F", kind="freewheel")
    ideal, lossy = sides(only(Transmission(2, [freewheel], [], [Gear()])))
    for side in (ideal, lossy):
        assert through(side) == pytest.approx({"1": 1, "2": 1, "F": 1, "input": 1, "output": 1})


def test_all_ports_count() -> None:
    """A differential with two inputs: the power of link 2, at a given speed of .4, enters too.

    Torques are as 1 : 2.5 : -3.5, so 1 and 2.5 * .4 enter.
    """
    gear = Gear(speeds={2: 0.4})
    ideal, _ = sides(only(Transmission(3, [], [Mechanism(1, 2, 3, -2.5, 0.97)], [gear])))
    assert ideal.entering == pytest.approx(2)
    assert through(ideal)["output"] == pytest.approx(2)
    assert [str(node) for node in ideal.throughput if node.kind == "port"] == [
        "input",
        "2",
        "output",
    ]


def test_of_loops_the_shortest_is_taken_first_then_the_strongest() -> None:
    """By hand: b-c-b with 2 goes before a-b-c-a with 1, which is left."""
    a, b, c = (Node("link", number, name) for number, name in enumerate("abc", 1))
    rest, loops = cancel([Edge(a, b, 1), Edge(b, c, 3), Edge(c, b, 2), Edge(c, a, 1)])
    assert rest == ()
    assert [(loop.nodes, loop.power) for loop in loops] == [((b, c), 2), ((a, b, c), 1)]
    rest, loops = cancel([Edge(a, b, 1), Edge(b, a, 1), Edge(b, c, 2), Edge(c, b, 2)])
    assert [loop.power for loop in loops] == [2, 1]
    assert cancel([Edge(a, b, 1.0), Edge(b, a, 1e-12)]).loops == ()


@cache
def solved(path: Path, *, coast: bool) -> Results:
    return solve(load(path), coast=coast)


def closes(side: PowerFlow) -> None:
    """What enters each node leaves it or is lost; likewise all in all; loops are apart."""
    for node, value in side.throughput.items():
        entering = sum(edge.power for edge in side.edges if edge.target == node)
        leaving = sum(edge.power for edge in side.edges if edge.source == node)
        if node.kind not in ("port", "drag"):
            assert entering == pytest.approx(value, abs=1e-9)
            assert entering - leaving == pytest.approx(side.losses.get(node, 0), abs=1e-9)
    assert side.balance == pytest.approx(0, abs=1e-9)
    assert cancel(side.forward).loops == ()
    around = sum(loop.power * len(loop.nodes) for loop in (*side.loops, *side.locked_in))
    assert sum(e.power for e in side.forward) + around == pytest.approx(
        sum(e.power for e in side.edges), abs=1e-9
    )


@pytest.mark.parametrize("coast", [False, True])
@pytest.mark.parametrize("path", CASES, ids=lambda path: path.name)
def test_the_power_of_every_shipped_case_closes(path: Path, coast: bool) -> None:
    """Conservation of energy, at each node and for the whole."""
    results = solved(path, coast=coast)
    for number, flow in enumerate(flows(results)):
        if flow.ideal is not None:
            closes(flow.ideal)
        if flow.lossy is not None:
            closes(flow.lossy)
            losses = np.abs(results.losses[number]).sum()
            assert flow.lossy.lost == pytest.approx(losses, abs=1e-12)
        assert max(map(len, text(flow).splitlines())) < 80


def test_members_of_drawn_elements_have_the_powers_of_the_printed_tables() -> None:
    """Planets are no links of the user: torques of AMLGP times speeds of W, by hand."""
    results = solved(next(path for path in CASES if path.stem == "umdm"), coast=False)
    found = {table.quantity.name: table for table in tables(results)}
    speeds, torques = (
        dict(zip(found[name].rows, found[name].values, strict=True))
        for name in ("speeds", "lossy_torques")
    )
    speeds["housing"] = np.zeros(len(results.case.gears))
    for number, flow in enumerate(flows(results)):
        assert flow.lossy is not None
        for one in flow.lossy.members:
            if one.device.kind == "mechanism":
                product = torques[f"{one.device}.{one.member}"] * speeds[one.link]
                assert one.power == pytest.approx(product[number], abs=1e-9)


def test_a_gear_without_power_says_why(tmp_path: Path) -> None:
    [tied, _] = flows(solve(read_yaml(TIED_UP.encode(), "x").case))
    assert (tied.ideal, tied.lossy, tied.note) == (None, None, "tied up")
    [neutral, _] = flows(solve(read_yaml(NEUTRAL.encode(), "x").case))
    assert (neutral.ideal, neutral.note) == (None, "torques do not balance")
    locked = only(read_yaml(LOCKED.encode(), "x").case)
    assert locked.ideal is not None
    assert (locked.lossy, locked.note) == (None, "locked by friction")
    assert "with losses: locked by friction" in text(locked)
    (tmp_path / "tied.yaml").write_text(TIED_UP, encoding="utf-8")
    said = vstatics("flow", tmp_path / "tied.yaml")
    assert said.status == 1
    assert said.out.startswith("gear both: tied up, so there is no power to show\n\ngear low ")


def test_what_statics_does_not_determine_stays_open() -> None:
    """Two clutches hold a set as one piece: how they share the torque is not determined."""
    clutches = [ShiftElement(1, 2), ShiftElement(1, 3)]
    ideal, _ = sides(only(Transmission(3, clutches, [Mechanism(1, 2, 3, -2.5)], [Gear([1, 2])])))
    assert {"F1", "F2", "D1"} < {str(node) for node in ideal.unknown}
    assert np.isnan(ideal.circulating)
    assert ideal.entering == ideal.leaving == pytest.approx(1)


def test_a_load_gives_kilowatts() -> None:
    """2000 rpm * pi/30 * 500 N*m = 104.72 kW; the pair of efficiency .95 loses 5.24 kW."""
    loaded = Transmission(
        2, [], [Mechanism(1, 2, 0, 4.0, 0.95, name="pair")], [Gear()], load=Load(2000.0, 500.0)
    )
    assert only(loaded).kilowatts == pytest.approx(104.7197551)
    assert only(replace(loaded, coast=True)).kilowatts == pytest.approx(104.7197551)
    [line] = [line for line in text(only(loaded)).splitlines() if "pair" in line]
    assert line.split() == ["pair", "1.000", "1.000", "104.72", ".0500", "5.24", "100.0%"]


def test_arrays_of_variants_are_refused() -> None:
    case = Transmission(2, [], [Mechanism(1, 2, 0, 4.0)], [Gear()])
    with pytest.raises(ValueError, match="expected \\(gears, links\\)"):
        flows(solve(case, ratios=[[4.0], [5.0]]))


def test_the_command_shows_one_gear_by_name_or_number(tmp_path: Path) -> None:
    file = tmp_path / "case.yaml"
    file.write_text(NEUTRAL, encoding="utf-8")
    by_name = vstatics("flow", file, "--gear", "low")
    assert by_name.status == 0
    assert by_name.out.startswith("gear low ")
    assert vstatics("flow", "-", "--gear", "2", stdin=file.read_bytes()).out == by_name.out
    wrong = vstatics("flow", file, "--gear", "lwo")
    assert (wrong.status, wrong.out) == (2, "")
    assert "no gear 'lwo'; did you mean `low`?" in wrong.err


def test_json_has_the_numbers_of_the_library(tmp_path: Path) -> None:
    file = tmp_path / "case.yaml"
    file.write_text(NEUTRAL, encoding="utf-8")
    [neutral, low] = json.loads(vstatics("flow", file, "-f", "json").out)["gears"]
    assert (neutral["ideal"], neutral["note"]) == (None, "torques do not balance")
    # the differential has -2.5 and .96, its second link is held: the third gives .9714
    assert low["lossy"]["leaving"] == pytest.approx(3.4 / 3.5)
    assert low["lossy"]["losses"] == [
        {
            "kind": "mechanism",
            "number": 1,
            "name": "D",
            "power": pytest.approx(0.1 / 3.5),
            "share": 1,
        }
    ]
    assert low["input_link_kW"] is None
