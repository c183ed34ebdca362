"""Circulating power: test rigs and differentials worked by hand."""

import pytest

from tests.core.flow.worked import around, lost, only, sides, through
from vstatics import Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.flow.circulation import Edge, Node, cancel
from vstatics.core.flow.tables import remarks


def rig(torque: float, efficiency: float) -> Transmission:
    """A back-to-back test rig: two gear pairs of one efficiency, joined by two shafts.

    Shaft 1 bears the first wheels of both pairs and is driven. The second shaft is cut, and
    a bevel differential joins its halves 2 and 3; a torque on its cage 4, which stands as
    one pair has an idler, is what is locked in. What little is left goes off at 2.
    """
    mechanisms = [
        Mechanism(1, 2, 0, -2.0, efficiency, name="tested"),
        Mechanism(1, 3, 0, 2.0, efficiency, name="returning"),
        Mechanism(2, 3, 4, -1.0, 1.0, name="lock"),
    ]
    names = ("drive", "half", "other half", "cage")
    return Transmission(4, [], mechanisms, [Gear(torques={4: torque})], output=2, link_names=names)


def test_a_back_to_back_rig_circulates_ten_times_what_drives_it() -> None:
    """By hand, from the principle of the four-square rig: the drive covers the losses alone.

    Equilibrium: cage -2 M = 40, so M = -20 at both halves, which turn at -1/2 and 1/2: 10
    go from the half through the lock to the other half. Ideal: 10 return to the drive,
    1 comes from outside, 11 go out by the tested pair, 1 is left.
    """
    flow = only(rig(40.0, 0.98))
    ideal, lossy = sides(flow)
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
    assert any("980.0% of the power in" in line for line in remarks(flow))
    # the torque turned round: 10 go from the other half to the half, 9 come back by `tested`
    ideal, _ = sides(only(rig(-40.0, 0.98)))
    assert around(ideal) == [("drive returning other half lock half tested", pytest.approx(9))]


def split(u: float, r: float) -> Transmission:
    """A differential whose first and second link are joined by a branch of ratio r."""
    mechanisms = [Mechanism(1, 2, 3, u, name="differential"), Mechanism(1, 2, 0, r, name="branch")]
    return Transmission(3, [], mechanisms, [Gear()], link_names=("in", "side", "out"))


@pytest.mark.parametrize("u", [-0.6, -2.0, -3.5, 2.5])
@pytest.mark.parametrize("r", [-5.0, -3.0, -1.5, -0.4, 0.7, 1.8, 4.0])
def test_the_branches_of_a_coupled_differential_share_as_its_speeds_say(u: float, r: float) -> None:
    """Two branches as in Macmillan (1961), Power flow and loss in differential mechanisms.

    J. Mech. Eng. Sci. 3(1), 37-41; the closed form is derived here. Torques on first,
    second, third are as 1 : -u : u - 1, speeds of the first two as 1 : 1/r. So their powers are as 1 : -u/r, and together 1: phi = 1/(1 - u/r) by the
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


def test_a_set_that_turns_as_one_piece_does_not_circulate() -> None:
    """Sun and carrier joined, ring out, by hand.

    The ring's torque -u M is -1, so with u = -2 the set gives .5 to the sun, which the
    clutch takes back to the carrier.
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


def test_of_loops_the_shortest_is_taken_first_then_the_strongest() -> None:
    """By hand: b-c-b with 2 goes before a-b-c-a with 1, which is left."""
    a, b, c = (Node("link", number, name) for number, name in enumerate("abc", 1))
    rest, loops = cancel([Edge(a, b, 1), Edge(b, c, 3), Edge(c, b, 2), Edge(c, a, 1)])
    assert rest == ()
    assert [(loop.nodes, loop.power) for loop in loops] == [((b, c), 2), ((a, b, c), 1)]
    rest, loops = cancel([Edge(a, b, 1), Edge(b, a, 1), Edge(b, c, 2), Edge(c, b, 2)])
    assert [loop.power for loop in loops] == [2, 1]
    assert cancel([Edge(a, b, 1.0), Edge(b, a, 1e-12)]).loops == ()
