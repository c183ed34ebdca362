"""Drag of links and open elements: numbers from equilibrium and power, by hand.

A gear pair has the ratio 4 and the efficiency .95; its output turns at 1/4.
"""

import pytest

from tests.core.statics.differential import assert_located
from tests.core.writers.again import is_read_again
from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
from vstatics.core.readers.named.reader import read_yaml
from vstatics.core.writers import deck, named

D = 0.02


def pair(drag: dict[int, float], *, clutch: float = 0.0) -> Transmission:
    """The gear pair, with an open clutch between its links."""
    elements = [ShiftElement(1, 2, drag=clutch)]
    return Transmission(2, elements, [Mechanism(1, 2, 0, 4, 0.95)], [Gear(drag=drag)])


def test_drag_on_the_output_takes_from_the_output_torque_and_adds_to_it_when_coasting() -> None:
    results = solve(pair({2: D}))
    assert results.lossy_torques[0] == pytest.approx([0, 1, 4 * 0.95 - D])
    assert results.torques[0] == pytest.approx([0, 1, 4])
    assert results.efficiency == pytest.approx([0.95 - D / 4])
    assert results.losses[0] == pytest.approx([0.05])
    assert results.drag_losses == pytest.approx([D / 4])
    coasting = solve(pair({2: D}), coast=True)
    assert coasting.lossy_torques[0] == pytest.approx([0, 1, 4 / 0.95 + D])
    assert coasting.efficiency == pytest.approx([1 / (1 / 0.95 + D / 4)])
    assert coasting.drag_losses == pytest.approx([-D / 4])


def test_an_open_clutch_takes_by_its_slip() -> None:
    """It brakes link 1 and drives link 2; the slip is 3/4. Coasting turns its torque."""
    for coast, d in ((False, D), (True, -D)):
        results = solve(pair({}, clutch=D), coast=coast)
        output = (1 - d) * 4 * 0.95 ** (-1 if coast else 1) + d
        assert results.lossy_torques[0] == pytest.approx([d, 1 - d, output])
        assert results.torques[0] == pytest.approx([0, 1, 4])
        assert results.drag_losses == pytest.approx([0.75 * d])
        assert results.efficiency == pytest.approx([(output / 4) ** (-1 if coast else 1)])
        assert results.power_balance == pytest.approx([0])


def test_an_overrunning_freewheel_drags_and_one_that_holds_does_not() -> None:
    """Link 2 follows link 1 by the freewheel, or the clutch drives it by the pair at 2."""
    elements = [ShiftElement(2, 1, kind="freewheel", drag=D), ShiftElement(1, 3)]
    gears = [Gear(), Gear([2])]
    results = solve(Transmission(3, elements, [Mechanism(3, 2, 0, 0.5)], gears, output=2))
    assert results.drag_losses == pytest.approx([0, D])
    assert results.efficiency == pytest.approx([1, 1 - D])
    assert results.lossy_torques[:, 0] == pytest.approx([-1, D])


def test_drag_at_a_speed_that_is_not_determined_is_left_out() -> None:
    """A direct clutch with a set that hangs on the input."""
    elements = [ShiftElement(1, 4), ShiftElement(2, 0, "B", drag=D)]
    gear = Gear([1], drag={3: D, 4: D})
    results = solve(Transmission(4, elements, [Mechanism(1, 2, 3, -2.0, 0.97)], [gear]))
    assert results.efficiency == pytest.approx([1 - D])
    [said] = [one for one in results.messages if "drag" in one.text]
    assert (said.id, said.gear, said.text[:27]) == ("W412", "1", "the drag of 3 and B is igno")


TEXT = """\
links: [in, out]
shift_elements:
  C: {kind: clutch, links: [in, out], drag: 0.02}
  B: [out, housing]
mechanisms:
  P: {first: in, second: out, ratio: 4, efficiency: 0.95}
gears:
  "1": {drag: {out: 0.01}, open_drag: {C: 0.03, B: 1/100}}
"""


def test_what_is_written_is_read_again() -> None:
    case = read_yaml(TEXT.encode(), "case.yaml").case
    assert case.shift_elements[0] == ShiftElement(1, 2, "C", "clutch", 0.02)
    assert (case.gears[0].drag, case.gears[0].open_drag) == ({2: 0.01}, {1: 0.03, 2: 0.01})
    assert is_read_again(case)
    clutch = {"kind": "clutch", "links": ["in", "out"], "drag": 0.02}
    assert named.mapping(case)["shift_elements"] == {"C": clutch, "B": ["out", "housing"]}
    assert deck.lost(case) == ["drag of shift element C", "drag of gear 1", "open_drag of gear 1"]


def test_faults_are_located() -> None:
    opened = "{C: 0.03, B: 1/100}"
    rows = (
        ("drag: 0.02", "drag: -0.02", 3, "C.drag: read -0.02, expected a torque of 0 or more"),
        ("kind: clutch", "kind: dog_clutch", 3, "C.drag: a disengaged dog clutch has no drag"),
        ("{out: 0.01}", "{out: -1}", 8, "drag.out: read -1, expected a torque of 0 or more"),
        ("{out: 0.01}", "{outt: 1}", 8, "did you mean `out`"),
        ("{out: 0.01}", "{housing: 1}", 8, "the housing does not turn, expected a link"),
        ("{out: 0.01}", "0.01", 8, "expected a mapping: a number for each link"),
        (opened, "{D: 1}", 8, "expected the name of a shift element"),
        (opened, "{C: -1}", 8, "open_drag.C: read -1, expected a torque of 0"),
        (opened, "[1]", 8, "expected a mapping: a number for each shift element"),
    )
    assert_located(TEXT, rows)
