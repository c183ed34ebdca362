"""Power that a convention divides, in what turns as one piece."""

from dataclasses import replace
from pathlib import Path

import pytest

from tests.commands import SHIPPED
from tests.core.flow.worked import only, solved
from vstatics import Gear, Mechanism, ShiftElement, Transmission, load, solve
from vstatics.core.flow.power import flows
from vstatics.core.flow.power_flow import GearFlow, PowerFlow
from vstatics.core.flow.tables import power_grid
from vstatics.core.flow.text import text

SET = Mechanism(1, 2, 3, -2.5, 0.96, name="set")


def marked(flow: GearFlow) -> set[str]:
    return {str(node) for node in flow.by_convention}


def held(*engaged: int) -> GearFlow:
    """A set behind a starting clutch, its sun and carrier joined by another, or its ring held."""
    elements = [ShiftElement(4, 1, "start"), ShiftElement(1, 3, "direct"), ShiftElement(2, 0, "B")]
    names = ("sun", "ring", "carrier", "in")
    return only(Transmission(4, elements, [SET], [Gear(engaged)], 4, 2, link_names=names))


def test_a_set_and_the_clutch_beside_it_are_marked_and_what_stands_in_series_is_not() -> None:
    """All power passes the starting clutch, whatever the set does."""
    flow = held(1, 2)
    assert marked(flow) == {"set", "direct", "sun", "carrier"}
    lines = text(flow).splitlines()
    assert [line.split()[1] for line in lines if line[:6] in ("  set ", "  dire")] == ["~", "~"]
    assert "~ by convention, as it is locked up: sun, carrier, direct, set" in lines
    grid = power_grid(flow)
    assert grid.columns[-1].heading == "by convention"
    signs = {row[0].strip(): row[-1] for row in grid.texts}
    assert (signs["set"], signs["direct"], signs["start"], signs["ring"]) == ("~", "~", "", "")


def test_a_set_that_turns_in_itself_has_a_mark_nowhere() -> None:
    elements = [ShiftElement(4, 1, "start"), ShiftElement(2, 0, "B")]
    flow = only(Transmission(4, elements, [SET], [Gear([1, 2])], 4, 3))
    assert flow.by_convention == ()
    assert "by convention" not in [column.heading for column in power_grid(flow).columns]
    assert "~" not in text(flow)


def test_a_set_that_is_one_piece_by_coincidence_is_marked() -> None:
    """Two pairs of one ratio drive sun and ring alike, and the carrier goes along with them."""
    pairs = [Mechanism(4, 1, 0, 2.0, 1.0, name="one"), Mechanism(4, 2, 0, 2.0, 1.0, name="other")]
    flow = only(Transmission(4, [], [SET, *pairs], [Gear()], 4, 3))
    assert "set" in marked(flow)


def differing(one: PowerFlow, other: PowerFlow) -> set[str]:
    """Devices with a member whose power is another one, links through which another one goes."""
    pairs = zip(one.members, other.members, strict=True)
    devices = {str(a.device) for a, b in pairs if a.power != pytest.approx(b.power, abs=1e-9)}
    through = ((node, power) for node, power in one.throughput.items() if node.kind == "link")
    other_links = {str(n) for n, power in through if power != pytest.approx(other.throughput[n])}
    return devices | other_links


@pytest.mark.slow
@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.name)
def test_what_is_marked_is_what_the_two_conventions_disagree_about(path: Path) -> None:
    """`exact` and `published` differ in nothing but idle mechanisms with losses."""
    if all(one.efficiency == 1 for one in solved(path, coast=False).case.mechanisms):
        pytest.skip("without losses the conventions agree")
    exact, published = (
        flows(solve(replace(load(path), idle=one))) for one in ("exact", "published")
    )
    for flow, other in zip(exact, published, strict=True):
        if flow.lossy is not None and other.lossy is not None:
            assert marked(flow) == differing(flow.lossy, other.lossy), flow.gear
