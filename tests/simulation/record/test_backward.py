"""Runs in which a link turns in the direction opposite to its target; runs as data frames."""

from __future__ import annotations

import pytest

from tests.chance import count, seeded
from tests.simulation.control.written import simulated

AXLE = """links: [in, out]
inertias: {{in: 1, out: 5}}
mechanisms: {{g: {{first: in, second: out, ratio: {ratio!r}}}}}
"""


@pytest.mark.parametrize("seed", range(count(12, 200)))
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
    motion = simulated(
        "duration: 1\nstart: {speeds: {in: -10}}\ntorques: {in: 1}\ntargets: {out: 90}\n",
        AXLE.format(ratio=4),
    )
    assert not motion.messages


def test_a_run_is_a_data_frame_with_the_columns_of_its_file() -> None:
    pytest.importorskip("pandas")
    motion = simulated(
        "duration: 1\nstart: {speeds: {in: 0}}\ntorques: {in: 21}\n", AXLE.format(ratio=4)
    )
    frame = motion.to_dataframe()
    assert list(frame) == ["speeds[in]", "speeds[out]", "torques[g]"]
    assert (frame.index.name, frame.index[-1]) == ("time", 1.0)
    assert frame["speeds[out]"].iloc[-1] == pytest.approx(4 * 21 / (16 + 5))
