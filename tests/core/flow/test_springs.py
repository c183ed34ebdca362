"""Springs in the flow of power."""

import pytest
from hypothesis import given

from tests.core.flow.worked import only, sides, through
from tests.trains import on_springs, trains
from vstatics import Gear, Mechanism, ShiftElement, Spring, Transmission, solve
from vstatics.core.flow.circulation import Node
from vstatics.core.flow.power import flows
from vstatics.core.flow.text import text
from vstatics.core.model.springs import between
from vstatics.core.tables.answer import plain_data

SHAFT = Spring(between(2, 3), stiffness=9e4, name="shaft")
MOUNT = Spring(between(4), stiffness=9e4, name="mount")
AXLE = Transmission(
    5,
    [],
    [Mechanism(1, 2, 0, -2.0, 0.98, name="pair"), Mechanism(3, 5, 4, 4.0, 0.97, name="axle")],
    [Gear()],
    springs=[SHAFT, MOUNT],
)
FORM = Spring({1: 2, 2: -1, 3: -0.5, 4: -1}, stiffness=8, name="form")


def test_power_goes_through_a_shaft_as_it_is() -> None:
    """.98 of the power leaves the pair, .98 * .97 the axle; a casing that stands has none."""
    ideal, lossy = sides(only(AXLE))
    assert through(ideal)["shaft"] == pytest.approx(1)
    assert through(lossy)["shaft"] == pytest.approx(0.98)
    assert through(lossy)["mount"] == 0
    assert (lossy.leaving, lossy.balance) == pytest.approx((0.98 * 0.97, 0))
    members = [one for one in lossy.members if one.device.kind == "spring"]
    assert [(str(one.device), one.member, one.link, one.power) for one in members] == [
        ("shaft", "2", "2", pytest.approx(0.98)),
        ("shaft", "3", "3", pytest.approx(-0.98)),
        ("mount", "4", "4", 0),
    ]
    assert Node("spring", 1, "shaft") not in lossy.losses
    [gear] = plain_data(flows(solve(AXLE)))
    kinds = {node["name"]: node["kind"] for node in gear["lossy"]["throughput"]}
    assert (kinds["shaft"], kinds["mount"]) == ("spring", "spring")


def test_a_spring_of_several_links_divides_power_by_its_coefficients() -> None:
    """Links 2 and 4 stand: w_3 = 4 w_1, so M_3 = -1/4, and 2, 4 are held by the spring's torque."""
    held = [Mechanism(2, 0, 0, 1.0, name="b"), Mechanism(4, 0, 0, 1.0, name="d")]
    case = Transmission(4, [], held, [Gear()], output=3, springs=[FORM])
    assert solve(case).ratio == pytest.approx([0.25])
    ideal, _ = sides(only(case))
    powers = {one.link: one.power for one in ideal.members if str(one.device) == "form"}
    assert powers == pytest.approx({"1": 1, "2": 0, "3": -1, "4": 0})
    assert through(ideal)["form"] == pytest.approx(1)


def test_a_shaft_beside_an_engaged_clutch_is_one_piece() -> None:
    """Two ways through one piece: statics does not divide the power between them."""
    train = [ShiftElement(1, 2, "C")], [Mechanism(1, 2, 3, -2.0, 0.98, name="set")], [Gear([1])]
    ideal, _ = sides(only(Transmission(3, *train, springs=[SHAFT])))
    assert ideal.unknown


def test_the_text_has_springs_between_mechanisms_and_shift_elements() -> None:
    shown = text(only(AXLE))
    lines = shown.splitlines()
    at = lines.index("springs")
    assert lines[at + 1] == "  shaft                        1.000    0.980"
    assert "no power: 4, mount" in shown
    case = Transmission(4, [], [], [Gear(speeds={2: 0, 4: 0})], output=3, springs=[FORM])
    assert "    1                          1.000    1.000\n" in text(only(case))


@given(trains(gears=1))
def test_power_is_balanced_with_springs(case: Transmission) -> None:
    """What enters a spring leaves it, and what enters the train leaves it or is lost."""
    chosen = range(0, len(case.mechanisms), 2)
    [flow] = flows(solve(on_springs(case, chosen)))
    for side in (flow.ideal, flow.lossy):
        if side is None or side.unknown:
            continue
        size = max(side.throughput.values(), default=0)
        assert side.balance == pytest.approx(0, abs=1e-9 * max(1, size))
        powers: dict[Node, float] = {}
        for one in side.members:
            if one.device.kind == "spring":
                powers[one.device] = powers.get(one.device, 0.0) + one.power
        assert all(total == pytest.approx(0, abs=1e-9 * max(1, size)) for total in powers.values())
