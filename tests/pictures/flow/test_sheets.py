"""Flows on paper: rows, lines of plain chains, pages; sums that are told."""

import re
from pathlib import Path

import pytest

from tests.commands import CASES, SHIPPED, json_answer
from tests.pictures.drawn import texts, titled
from tests.pictures.flow.test_flow import in_rows
from tests.shipped import shipped_results
from vstatics import load, loads, solve
from vstatics.core.flow.power import flows
from vstatics.pictures import pages, picture
from vstatics.pictures.drawing.style import PAGE_HEIGHT, Style
from vstatics.pictures.flow.chain import is_chain
from vstatics.pictures.flow.graph import graph

DRIVELINE = CASES / "driveline-8hp70.yaml"
CHAIN = """
links: [in, a, b, out]
output: out
shift_elements: {A: [in, a], B: [in, b]}
mechanisms:
  p1: {first: a, second: out, ratio: -3, efficiency: .97}
  p2: {first: b, second: out, ratio: 2, efficiency: .98}
gears: {low: [A], high: [B]}
drag: {out: 0.01}
"""
AXLES = """
links: [prop, front, rear, FL, FR, RL, RR]
outputs: [RR, FL, FR, RL]
mechanisms:
  centre: {first: front, second: rear, third: prop, ratio: -2, efficiency: 0.99}
  front axle: {first: FL, second: FR, third: front, ratio: -1, efficiency: 0.98}
  rear axle: {first: RL, second: RR, third: rear, ratio: -1, efficiency: 0.98}
gears: {straight: {speeds: {FL: 1*FR, FR: 1*RL, RL: 1*RR}}}
"""


def test_a_band_that_is_cut_goes_on_as_wide_in_another_row() -> None:
    found = 0
    for _, rows in in_rows(solve(load(DRIVELINE)), Style()):
        cut = [stub for row in rows for stub in row.stubs if stub.port.cut]
        leaving = {stub.port.cut: stub.width for stub in cut if not stub.port.enters}
        assert leaving == {stub.port.cut: stub.width for stub in cut if stub.port.enters}
        assert bool(cut) == (len(rows) > 1)
        found += len(cut)
    assert found


def test_all_gears_are_on_one_of_the_pages_by_their_names() -> None:
    """Their sizes are measured by tests/pictures/test_pages.py."""
    results = solve(load(DRIVELINE))
    made = pages(results, "flow", "svg", Style(height=PAGE_HEIGHT))
    assert len(made) > 1
    assert all(">gear " in svg.decode() for svg in made)
    heads = re.findall(r">gear (\w+)</text>", b"".join(made).decode())
    assert heads == [gear.name for gear in results.case.gears]


def test_a_gear_without_branches_is_a_line_whose_losses_make_up_the_difference() -> None:
    """What enters less all losses is what leaves; nodes stand in the order of the power."""
    results = solve(loads(CHAIN))
    figure = picture(results, "flow", Style())
    said = texts(figure)
    at = said.index("gear high")
    for name, device, words in (("low", "p1", said[:at]), ("high", "p2", said[at:])):
        order = [words.index(one) for one in (f"gear {name}", "in", device, "out")]
        assert order == sorted(order)
        numbers = [float(one.replace("−", "-")) for one in words if re.fullmatch(r"−?\d\.\d+", one)]
        entering, *losses, leaving = numbers
        assert entering + sum(losses) == pytest.approx(leaving, abs=1.6e-3)
        assert min(losses) < 0
    assert not any("→" in said for said, _ in titled(figure))
    alone = picture(results, "flow", Style(), [1])  # with bands
    assert any("→" in said for said, _ in titled(alone))


TWO_SPEED_AXLE = """
links: [L0, L1, L2, L3]
output: L1
load: {speed: 8000 rpm, torque: 180 N*m}
shift_elements:
  T-L2: {links: [L2, housing], drag: 2 N*m}
  T-L3: {links: [L3, housing], drag: 2 N*m}
elements:
  P1: {kind: planetary, sun: L0, ring: L2, carrier: L1, teeth: {sun: 39, ring: 121, planet: 41}}
  P2: {kind: planetary, sun: L2, ring: L1, carrier: L3, teeth: {sun: 46, ring: 80, planet: 17}}
gears: {'1': [T-L3], '2': [T-L2]}
"""


@pytest.mark.parametrize("source", [TWO_SPEED_AXLE, CHAIN, *SHIPPED], ids=lambda s: str(s)[-20:])
def test_a_line_gives_on_what_it_gets_and_ends_at_the_output(source: Path | str) -> None:
    """What is behind the output would be a branch, as is an open brake of the axle's gear 2."""
    results = solve(loads(source) if isinstance(source, str) else load(source))
    for flow in flows(results):
        if flow.shown is None:
            continue
        drawn = graph(flow.shown)
        if not is_chain(flow, drawn):
            assert source != CHAIN
            continue
        assert source != TWO_SPEED_AXLE
        order = sorted(range(len(drawn.runs)), key=lambda place: drawn.layers[place])
        nodes = [node for place in order for node in drawn.runs[place]]
        assert [port.enters for port in drawn.ports[nodes[0]]] == [True]
        assert [port.enters for port in drawn.ports[nodes[-1]]] == [False]
        power = flow.shown.entering
        for node in nodes:
            assert drawn.through(node) == pytest.approx(power, abs=1e-9)
            power -= drawn.losses.get(node, 0.0)
        assert power == pytest.approx(flow.shown.leaving, abs=1e-9)


def test_the_sum_of_what_circulates_is_shown_where_there_are_several_loops() -> None:
    case = CASES / "mercedes-9g.yaml"
    answer = json_answer("flow", case)
    told = {gear["gear"]: gear["lossy"] for gear in answer["gears"]}
    results = solve(load(case))
    for number, gear in enumerate(results.case.gears, 1):
        said = "\n".join(texts(picture(results, "flow", Style(), [number])))
        sums = re.findall(r"recirculating power in all ([\d.]+): ([\d.]+)%", said)
        flow = told[gear.name]
        if len(flow["loops"]) < 2:
            assert not sums
            continue
        [(power, share)] = sums
        assert float(power) == pytest.approx(flow["circulating"], abs=5e-4)
        assert float(share) == pytest.approx(100 * flow["circulating_share"], abs=0.05)


def test_differentials_whose_wheels_turn_alike_divide_by_their_ratio() -> None:
    """Only friction is open there; what a clutch closes is by convention still."""
    figure = picture(solve(loads(AXLES)), "flow", Style())
    said = "\n".join(one for one, _ in titled(figure))
    assert "within friction" in said
    assert "convention" not in said
    assert "divided within friction, locked up" in texts(figure)
    direct = picture(shipped_results("ravigneaux-aod.yaml"), "flow", Style(), [3])
    assert "divided by convention, locked up" in texts(direct)
