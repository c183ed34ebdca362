"""Where the power goes: ports, devices, links."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.commands import SHIPPED
from tests.core.flow.worked import lost, only, sides, solved, through
from tests.shipped import shipped_results
from vstatics import Gear, Mechanism, ShiftElement, Transmission, loads
from vstatics.core.flow.circulation import cancel
from vstatics.core.flow.power import flows
from vstatics.core.flow.power_flow import PowerFlow
from vstatics.core.flow.text import text
from vstatics.core.tables.values import tables


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
    edges = {f"{edge.source} > {edge.target}" for edge in ideal.edges}
    assert edges == {"output > 2", "2 > pair", "pair > 1", "1 > input"}
    assert lossy.leaving == pytest.approx(1)
    assert through(lossy)["pair"] == pytest.approx((1 + 0.01) / 0.95)
    assert lossy.entering == pytest.approx((1 + 0.01) / 0.95 - 0.0025)
    assert lost(lossy) == pytest.approx({"pair": (1 + 0.01) * (1 / 0.95 - 1), "C": 0.0075})


def test_all_ports_count() -> None:
    """A differential with two inputs: the power of link 2, at a given speed of .4, enters too.

    Torques are as 1 : 2.5 : -3.5, so 1 and 2.5 * .4 enter.
    """
    gear = Gear(speeds={2: 0.4})
    ideal, _ = sides(only(Transmission(3, [], [Mechanism(1, 2, 3, -2.5, 0.97)], [gear])))
    assert ideal.entering == pytest.approx(2)
    assert through(ideal)["output"] == pytest.approx(2)
    ports = [str(node) for node in ideal.throughput if node.kind == "port"]
    assert ports == ["input", "2", "output"]


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
    forward, whole = (sum(e.power for e in edges) for edges in (side.forward, side.edges))
    assert forward + around == pytest.approx(whole, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("coast", [False, True])
@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.name)
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
    results = shipped_results("umdm.yaml")
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


def test_what_statics_does_not_determine_stays_open() -> None:
    """Two clutches hold a set as one piece: how they share the torque is not determined."""
    clutches = [ShiftElement(1, 2), ShiftElement(1, 3)]
    ideal, _ = sides(only(Transmission(3, clutches, [Mechanism(1, 2, 3, -2.5)], [Gear([1, 2])])))
    assert {"F1", "F2", "D1"} < {str(node) for node in ideal.unknown}
    assert np.isnan(ideal.circulating)
    assert ideal.entering == ideal.leaving == pytest.approx(1)


@pytest.mark.parametrize("ratio", [0.4, -1.6])
@pytest.mark.parametrize("coast", [False, True])
def test_the_flow_of_a_variator_closes_where_something_follows_the_load(
    ratio: float, coast: bool
) -> None:
    """A law on any part has each gear calculated at its load: eta of the power goes through."""
    law = "{over: speed, points: [[0, 0.8], [50, 0.9]]}"
    for efficiency, behind, passed in ((law, "1.0", 0.9), ("0.9", law, 0.9 * 0.9)):
        case = loads(f"""
links: [eng, out, axle]
load: {{speed: 2000 rpm, torque: 100 N*m}}
mechanisms:
  h: {{kind: variator, first: eng, second: out, speed_ratio: {ratio}, efficiency: {efficiency}}}
  p: {{first: out, second: axle, ratio: -2.0, efficiency: {behind}}}
gears: {{"1": []}}
""")
        _, lossy = sides(only(replace(case, coast=coast)))
        assert lossy.leaving / lossy.entering == pytest.approx(passed, rel=1e-9)
        assert lossy.balance == pytest.approx(0, abs=1e-12)
