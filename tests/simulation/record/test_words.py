"""What events are called, notes on targets, and runs as data frames."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import each_seed, seeded
from tests.simulation.boxes import held, points
from tests.simulation.control.written import simulated
from tests.simulation.test_closed_forms import links, run
from vstatics import ShiftElement
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation import Capacity, Dog, Motion, Resistance, Road, constant
from vstatics.simulation.record.motion import Energy, Event, Peak
from vstatics.simulation.record.tables import motion_grids


def words(motion: Motion) -> list[tuple[str, str | None]]:
    return [(one.event, one.word) for one in motion.events]


def test_a_dog_clutch_closes_and_opens() -> None:
    case = links(1.0, 1.0, elements=(ShiftElement(1, 2, "D", "dog_clutch"),))
    dog = {1: Dog(((0.2, True), (0.5, False)))}
    motion = run(case, 1.0, {1: 5.0, 2: 3.0}, (), dog)
    assert words(motion) == [("impact", "closes"), ("slips", "opens")]
    assert motion.events[0].energy == pytest.approx(1.0)  # 1/2 (1/2 kg*m^2) (2 rad/s)^2
    together = ((1, constant(1.0)), (2, constant(1.0)))
    still = run(case, 1.0, {1: 5.0, 2: 5.0}, together, dog)
    assert words(still) == [("locks", "closes"), ("slips", "opens")]


def test_a_clutch_is_let_go_or_overcome() -> None:
    """Half of the torque passes: 10 of 100 N*m when it is let go, 30 of 30 N*m at .6 s."""
    case = links(1.0, 1.0, elements=(ShiftElement(1, 2, "C"),))
    for drive, capacity, word, time in (
        (constant(20.0), Capacity(points((0, 100), (0.5, 100), (0.5, 0))), "opens", 0.5),
        (points((0, 0), (1, 100)), held(30), "slips", 0.6),
    ):
        motion = run(case, 1.0, {1: 5.0, 2: 5.0}, ((1, drive),), {1: capacity}, engaged=(1,))
        assert words(motion) == [("slips", word)]
        assert motion.events[0].time == pytest.approx(time)


def test_a_freewheel_overruns() -> None:
    case = links(0.2, 0.5, elements=(ShiftElement(2, 1, "L", "freewheel"),))
    drive = ((1, points((0, 5), (2, 5), (2, -8))), (2, constant(-2)))
    motion = run(case, 3.0, {1: 10.0, 2: 20.0}, drive)
    assert words(motion) == [("locks", "locks"), ("slips", "overruns")]


@pytest.mark.parametrize("load", [Resistance(50.0), Road(100 / 9.81, 0.5, rolling=1.0)])
def test_a_load_starts(load: Resistance | Road) -> None:
    """Both hold 50 N*m at rest."""
    motion = run(links(4.0), 2.0, {1: 0.0}, ((1, points((0, 0), (2, 100))), (1, load)))
    assert words(motion) == [("slips", "starts")]
    assert motion.events[0].time == pytest.approx(1.0)


def test_rounding_noise_is_left_out_or_printed_as_0() -> None:
    case = links(1.0)
    motion = run(case, 1.0, {1: 0.0}, ((1, constant(1.0)),))._replace(
        events=(Event(0.5, "D", "impact", 3e-9, "closes"),),
        energy=Energy(100.0, {"C": 60.0, "D": 5e-8}, {}, {"m": -2e-9}, 40.0, 1e-12, 0.0, 0.0),
        peaks={"C": Peak(2e3, 0.1), "F": Peak(-1e-6, 0.2), "E": Peak(3e-6, 0.2)},
    )
    shown = {
        str(row[0 if grid.key != "events" else 1].text): row[-2 if grid.key == "peaks" else -1].text
        for grid in motion_grids(motion)
        for row in grid.cells
    }
    assert shown["elastic"] == shown["D"] == "0.000" != shown["E"]
    assert shown.keys().isdisjoint(("F", "m"))


AT_REST = """links: [a, m, b]
inertias: {{a: {a!r}, m: {m!r}, b: {b!r}}}
shift_elements:
  L: {{links: [a, m], capacity: 300 N*m}}
  K: {{links: [m, {end}], capacity: 300 N*m}}
gears: {{"1": []}}
"""


@each_seed(4, 300)
def test_a_slip_that_leaves_0_slips_and_reverses_only_through_0(seed: int) -> None:
    """A viscous clutch or brake K rests until L grips a shaft that turns: then it slips.

    Later the torque on the shaft turns round. The zeros of the slip of K are those of three bodies
    by `solve_ivp`, with the friction of L smoothed.
    """
    rng = seeded(seed)
    inertias = [rng.uniform(*ends) for ends in ((0.5, 2), (0.1, 1), (2, 8))]
    end = rng.choice(("b", "housing"))
    way, viscous = rng.choice((-1, 1)), rng.uniform(1, 5)
    begin, turn = rng.uniform(0.2, 0.6), rng.uniform(0.8, 1)
    size = rng.uniform(5, 20)
    motion = simulated(
        "duration: 2\nstart: {speeds: {a: 0, m: 0, b: 0}}\n"
        f"controls: {{L: [[0, 0], [{begin!r}, 0], [{begin + 0.2!r}, {size!r}]], "
        f"K: \"{viscous!r}*abs(slip('K'))\"}}\n"
        f"torques: {{a: [[0, {30 * way}], [{turn!r}, {30 * way}], [{turn!r}, {-90 * way}]]}}\n",
        AT_REST.format(**dict(zip("amb", inertias, strict=True)), end=end),
    )

    def rates(time: float, speeds: Floats) -> Floats:
        gripping = size * min(max((time - begin) / 0.2, 0.0), 1.0)
        sliding = gripping * float(np.tanh((speeds[0] - speeds[1]) / 1e-4))
        driven = 30 * way if time < turn else -90 * way
        braking = viscous * slip(time, speeds)
        torques = driven - sliding, sliding - braking, braking if end == "b" else 0.0
        return np.array(torques) / inertias

    def slip(_time: float, speeds: Floats) -> float:
        return float(speeds[1] - speeds[2])

    told = [one for one in motion.events if one.element == "K"]
    assert told[0].word == "slips"
    assert told[0].time == pytest.approx(begin, abs=1e-6)
    crossings, values = list[float](), [0.0, 0.0, 0.0]
    for first, last in pairwise((0.0, begin, begin + 0.2, turn, 2.0)):
        course = solve_ivp(rates, (first, last), values, "Radau", events=slip, rtol=1e-7, atol=1e-7)
        assert course.t_events is not None
        crossings += [float(zero) for zero in course.t_events[0] if zero > begin + 1e-3]
        values = course.y[:, -1].tolist()
    assert [one.word for one in told[1:]] == ["reverses"] * len(crossings)
    assert [one.time for one in told[1:]] == pytest.approx(crossings, abs=1e-3)


AXLE = """inertias: {{in: 1, out: 5}}
mechanisms: {{g: {{first: in, second: out, ratio: {ratio!r}}}}}
"""


@each_seed(12, 200)
def test_a_note_says_that_the_output_turns_opposite_to_its_target(seed: int) -> None:
    """The output ends at ``u T t / (J1 u^2 + J2)`` plus its start, without losses."""
    rng = seeded(seed)
    ratio = rng.choice((-1, 1)) * rng.uniform(1, 5)
    torque, target = rng.uniform(-30, 30), rng.choice((-1, 1)) * rng.uniform(500, 900)
    motion = simulated(
        f"duration: 2\nstart: {{speeds: {{in: 0}}}}\ntorques: {{in: {torque!r}}}\n"
        f"targets: {{out: {target!r}}}\n",
        AXLE.format(ratio=ratio),
    )
    end = ratio * torque * 2 / (ratio**2 + 5)
    assert motion.speeds[-1, 1] == pytest.approx(end)
    assert ("N613" in {one.id for one in motion.messages}) == (end * target < 0)


def test_a_link_that_slows_down_towards_its_target_has_no_note() -> None:
    text = "duration: 1\nstart: {speeds: {in: -10}}\ntorques: {in: 1}\ntargets: {out: 90}\n"
    assert not simulated(text, AXLE.format(ratio=4)).messages


def test_a_run_is_a_data_frame_with_the_columns_of_its_file() -> None:
    pytest.importorskip("pandas")
    text = "duration: 1\nstart: {speeds: {in: 0}}\ntorques: {in: 21}\n"
    frame = simulated(text, AXLE.format(ratio=4)).to_dataframe()
    assert list(frame) == ["time", "speeds[in]", "speeds[out]", "torques[g]"]
    assert (frame.index[-1], frame["time"].iloc[-1]) == (1.0, 1.0)
    assert frame["speeds[out]"].iloc[-1] == pytest.approx(4 * 21 / (16 + 5))
