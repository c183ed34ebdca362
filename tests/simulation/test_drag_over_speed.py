"""Motions with drag that depends on speed: times and speeds by closed forms."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.chance import each_seed, seeded
from tests.simulation.boxes import capacity
from tests.simulation.test_closed_forms import EXACT, links, run
from tests.simulation.test_golden import happened
from vstatics import CaseError, Gear, Load, ShiftElement, Transmission
from vstatics.core.model.laws import PointLaw
from vstatics.core.model.parts import Law
from vstatics.core.readers.named.law_formulas import DragFormula
from vstatics.simulation import constant

LOAD = Load(100, 20)


def dragged_link(law: Law, inertia: float = 0.5) -> Transmission:
    return replace(links(inertia), gears=[Gear(drag={1: law})], load=LOAD)


def joined(element: ShiftElement, *inertias: float) -> Transmission:
    return replace(links(*inertias), shift_elements=[element], load=LOAD)


@each_seed(6)
def test_coast_down_by_a_constant_and_a_slope(seed: int) -> None:
    """J dw/dt = -a - b w: w + a/b = (w0 + a/b) exp(-b t/J) until it rests, backward as forward."""
    random = seeded(seed)
    a, b, inertia, w0 = (random.uniform(*ends) for ends in ((1, 5), (0.1, 0.5), (0.5, 2), (20, 90)))
    rest = inertia / b * math.log(1 + b * w0 / a)
    steep = PointLaw([(0, a), (100, a + 100 * b)])
    for law in (steep, DragFormula(f"{a!r} + {b!r}*w")):
        for way in (1, -1):
            motion = run(dragged_link(law, inertia), rest * 1.5, {1: way * w0})
            moving = motion.time < rest
            expected = (w0 + a / b) * np.exp(-b * motion.time[moving] / inertia) - a / b
            np.testing.assert_allclose(
                motion.speeds[moving, 0] * way, expected, atol=w0 * EXACT, rtol=0
            )
            assert motion.speeds[-1, 0] == 0
            assert sum(motion.energy.losses.values()) == pytest.approx(inertia * w0**2 / 2)


def test_a_drag_that_begins_with_the_speed_holds_nothing_at_rest() -> None:
    """J dw/dt = T - b w from rest: w = T/b (1 - exp(-b t/J))."""
    for law in (PointLaw([(0, 0), (100, 20)]), DragFormula("0.2*w")):
        motion = run(dragged_link(law), 4.0, {1: 0.0}, ((1, constant(5)),))
        assert motion.speeds[-1, 0] == pytest.approx(25 * (1 - math.exp(-0.4 * 4)), rel=EXACT)
        assert run(dragged_link(law), 4.0, {1: 0.0}).speeds[-1, 0] == 0
        # -9 rad/s and 5 N*m: through 0 to +25 rad/s in the end
        through = run(dragged_link(law), 4.0, {1: -9.0}, ((1, constant(5)),)).speeds[-1, 0]
        assert through == pytest.approx(25 - 34 * math.exp(-0.4 * 4), rel=EXACT)


def test_a_link_is_held_up_to_its_drag_at_rest() -> None:
    """1.2 N*m holds 1 N*m, and 1.5 N*m turn the link with what is left."""
    case = dragged_link(DragFormula("1.2 + 0.02*w"))
    assert run(case, 4.0, {1: 0.0}, ((1, constant(1)),)).speeds[-1, 0] == 0
    turned = run(case, 4.0, {1: 0.0}, ((1, constant(1.5)),)).speeds[-1, 0]
    assert turned == pytest.approx(15 * (1 - math.exp(-0.02 * 4 / 0.5)), rel=EXACT)


def test_an_open_clutch_drags_by_points_of_its_slip() -> None:
    """Two links, s' = -T(s)/J with J = 1/(1/J1 + 1/J2): 4 N*m above 40 rad/s, to 6 at 20, to 0.

    From 50 to 40 rad/s: 10 J/4 s; to 20, where T = 8 - s/10: 10 J ln(6/4); then exp(-0.3 t/J).
    """
    drag = PointLaw([(0, 0), (20, 6), (40, 4)])
    case = joined(ShiftElement(1, 2, "C", drag=drag), 0.5, 0.2)
    motion = run(case, 3.0, {1: 50.0, 2: 0.0})
    together = 1 / (1 / 0.5 + 1 / 0.2)
    at_20 = together * (2.5 + 10 * math.log(1.5))
    left = 20 * math.exp(-0.3 * (3 - at_20) / together)
    assert motion.speeds[-1, 0] - motion.speeds[-1, 1] == pytest.approx(left, rel=1e-7)
    # no torque acts from outside
    assert 0.5 * motion.speeds[-1, 0] + 0.2 * motion.speeds[-1, 1] == pytest.approx(25, rel=EXACT)
    assert motion.energy.losses["C"] == pytest.approx(together * (50**2 - left**2) / 2, rel=1e-7)


def test_a_clutch_that_closes_drags_no_more() -> None:
    """It drags with w/10 N*m for a second, then brakes with 30 N*m: heat is no loss."""
    drag = DragFormula("w/10")
    case = joined(ShiftElement(1, 0, "B", drag=drag), 0.5)
    motion = run(case, 3.0, {1: 60.0}, controls={1: capacity((1, 0), (1, 30))})
    after = 60 * math.exp(-0.2)
    [(name, what, time)] = happened(motion)
    assert (name, what) == ("B", "locks")
    assert time == pytest.approx(1 + 0.5 * after / 30, abs=1e-7)
    assert motion.energy.heat["B"] == pytest.approx(0.5 * after**2 / 2, rel=1e-7)


def test_drag_that_turns_below_0_or_that_a_freewheel_cannot_have_is_refused() -> None:
    said = r"the drag torque of 1 is -0\.\d+ N\*m, expected 0 or more"
    with pytest.raises(CaseError, match=said):
        run(dragged_link(DragFormula("1 - w/30")), 30.0, {1: 50.0})
    wheel = ShiftElement(1, 0, "F", kind="freewheel", drag=DragFormula("w/10"))
    with pytest.raises(CaseError, match="the drag of F depends on speed") as caught:
        run(joined(wheel, 0.5), 1.0, {1: 50.0})
    assert caught.value.problems[0].path == ("case", "shift_elements", 1, "drag")
