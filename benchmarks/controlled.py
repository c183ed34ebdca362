"""A closed loop: an up-shift of an eight-speed driveline of 20 links, under control.

Beside it stand integrations of the same equations with smoothed friction, as one would write them
by hand, in the same process on one core, after imports. They are told what `simulate` finds out by
itself: when each step of the sequence is done. With friction of .01 rad/s RK45 takes steps of less
than a microsecond: it is measured over a short piece of each phase, and so much longer for all of
it. Meshes are without losses in both.
"""

import os
import sys
from collections.abc import Callable
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from common import medians, options, print_table, timed
from scipy.integrate import solve_ivp
from scipy.linalg import null_space

from vstatics.core.readers import read
from vstatics.simulation import Motion, Scenario, simulate
from vstatics.simulation.run import begun
from vstatics.simulation.scenario.file import read_scenario

Array = np.ndarray[Any, Any]
CASES = Path(__file__).parents[1] / "cases"
SCENARIO, CASE = CASES / "scenarios/8hp70-upshift.yaml", CASES / "driveline-8hp70.yaml"
HELD = ("lock-up", "B", "E")
"""What sticks all the time."""
ROUNDS, OWN = 5, "`simulate`"
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
PLAIN, PIECE = 0.01, 1e-4
"""Smoothing of RK45 [rad/s], and of each phase the piece that it does [s]."""
SMOOTHINGS, TOLERANCES = (1e-6, 1e-7), (1e-9, 1e-10, 1e-11)
SAME_SPEED = 1e-6
"""How far BDF may be from `simulate` at the end. [rad/s]"""
LAG, FALLING, GAIN, INTEGRAL = 0.03, 0.35, 0.6, 12.0
STEPS: tuple[dict[str, float], ...] = (
    {"base": 0, "rise": 0, "hold": 1500, "closed": 0, "fall": 0, "less": 0},
    {"base": 30, "hold": 150},
    {"rise": 1500},
    {"hold": 0, "rise": 300},
    {"rise": 0, "closed": 1, "less": 150},
    {"fall": 60},
    {"closed": 0, "less": 0},
    {"base": 900},
)
"""What each step of the sequence sets; the fourth the slip that is followed, too."""
SPEEDS = np.array([80.0, 200.0, 450.0, 680.0, 720.0])
ENGINE = 0.4 * np.array([150.0, 220, 200, 100, -80]) + 0.6 * np.array([380.0, 420, 400, 300, 0])


def scenario() -> Scenario:
    """The shipped one, its meshes without losses."""
    text = CASE.read_bytes().replace(b"efficiency: 0.98", b"efficiency: 1")
    document = read_scenario(SCENARIO.read_bytes(), str(SCENARIO))
    return document.with_case(read(text, CASE.name)).scenario


class Driveline:
    """Speeds, twists, and ramp, aim, e, grip, release, cut of the control."""

    def __init__(self, given: Scenario, motion: Motion) -> None:
        case, names = given.case, given.case.link_names
        system = begun(given, step=None, rtol=1e-9).system
        slips = {one.name: one.row for one in system.contacts}
        sides = [np.eye(len(names))[names.index(f"{one} side")] for one in ("left", "right")]
        rigid = [*(one.row for one in system.meshes), *(slips[one] for one in HELD)]
        self.free = null_space(np.array([*rigid, sides[0] - sides[1]]))  # both sides are alike
        self.inverse = np.linalg.inv(self.free.T @ system.mass @ self.free)
        self.slips = np.array([slips["A"], slips["C"]]) @ self.free
        self.forms = np.array([one.row for one in system.springs]) @ self.free
        self.stiffness = np.array([one.stiffness for one in system.springs])
        self.damping = np.array([one.viscous for one in system.springs])
        self.engine, self.vehicle = (self.free[names.index(one)] for one in ("engine", "vehicle"))
        self.motions = self.free.shape[1]
        steps = [one.time for one in motion.events if one.event == "step"]
        self.times = [0.0, *steps, given.duration]
        twists = [motion.torques[0, motion.devices.index(one.name)] for one in case.springs]
        twists = np.array(twists) / self.stiffness
        speeds = np.linalg.lstsq(self.free, motion.speeds[0], rcond=None)[0]
        self.start = np.concatenate([speeds, twists, [0.0, 0.0, 0.0, 0.0, 1500.0, 0.0]])

    def change(self, set_: dict[str, float], smooth: float, _time: float, state: Array) -> Array:
        """The derivative in a phase."""
        speeds, twists, control = np.split(state, [self.motions, len(state) - 6])
        ramp, aim, e, grip, release, cut = control
        slip_a, slip_c = self.slips @ speeds
        rates = self.forms @ speeds
        friction = np.array([release, max(grip, 0.0)]) * np.tanh(
            np.array([slip_a, slip_c]) / smooth
        )
        driven = np.interp(self.engine @ speeds, SPEEDS, ENGINE) - cut
        v = 0.33 * self.vehicle @ speeds
        road = -0.33 * (1900 * 9.81 * 0.012 * np.sign(v) + 0.6 * 0.7 * v * abs(v))
        torques = self.engine * driven + self.vehicle * road - self.slips.T @ friction
        torques -= self.forms.T @ (self.stiffness * twists + self.damping * rates)
        off = set_["closed"] * (abs(slip_c) - aim)
        command = set_["base"] + ramp + set_["closed"] * e + GAIN * off
        states = [
            set_["rise"],
            -set_["fall"] if aim > 0 else 0.0,
            INTEGRAL * off,
            (command - grip) / LAG,
            (set_["hold"] - release) / LAG,
            (set_["less"] - cut) / 0.02,
        ]
        return np.concatenate([self.inverse @ torques, rates, states])

    def jacobian(self, set_: dict[str, float], smooth: float, time: float, state: Array) -> Array:
        """Of `change`, by differences; that of SciPy overflows where nothing changes."""
        now, step = self.change(set_, smooth, time, state), 1e-3 * smooth
        columns = [
            self.change(set_, smooth, time, one) - now for one in state + step * np.eye(len(state))
        ]
        return np.array(columns).T / step

    def run(self, method: Any, smooth: float, tolerance: float, piece: float = np.inf) -> Array:
        """The speeds at the end, phase by phase; or of each phase a piece."""
        state, settings = self.start.copy(), dict(STEPS[0])
        for number, (begin, end) in enumerate(pairwise(self.times)):
            settings |= STEPS[number]
            if number == 4:
                aim = abs(self.slips[1] @ state[: self.motions])
                state[self.motions + len(self.stiffness) + 1] = aim
                settings["fall"] = aim / FALLING
            options: dict[str, Any] = {"rtol": tolerance, "atol": tolerance}
            if method == "BDF":
                options["jac"] = partial(self.jacobian, settings, smooth)
            change, ends = partial(self.change, settings, smooth), (begin, min(end, begin + piece))
            found = solve_ivp(change, ends, state, method, **options)
            state = found.y[:, -1]
        return np.asarray(self.free @ state[: self.motions])


def best_stiff(driveline: Driveline, motion: Motion) -> tuple[float, float]:
    """The smoothing and tolerance of the fastest stiff run that ends as `simulate` does."""
    found = []
    for smoothing in SMOOTHINGS:
        for tolerance in TOLERANCES:
            run = partial(driveline.run, "BDF", smoothing, tolerance)
            if abs(run() - motion.speeds[-1]).max() < SAME_SPEED:
                found.append((timed(run), smoothing, tolerance))
    if not found:
        sys.exit("no stiff run ends at the same speeds")
    return min(found)[1:]


def main() -> None:
    """Measure and print."""
    given = options(__doc__, peer=False)
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    loop = scenario()
    motion = simulate(loop)
    driveline = Driveline(loop, motion)
    actions: dict[str, Callable[[], float]] = {
        "`simulate`": partial(timed, partial(simulate, loop))
    }
    if not given.quick:
        smoothing, tolerance = best_stiff(driveline, motion)
        words = f"BDF, tanh of {smoothing:g} rad/s, speeds at the end to {SAME_SPEED:g} rad/s"
        actions[words] = partial(timed, partial(driveline.run, "BDF", smoothing, tolerance))
    found = medians(actions, 1 if given.quick else ROUNDS)
    pieces = partial(driveline.run, "RK45", PLAIN, 1e-3, PIECE / 10 if given.quick else PIECE)
    share = loop.duration / (len(STEPS) * (PIECE / 10 if given.quick else PIECE))
    found[f"RK45 as it is, tanh of {PLAIN:g} rad/s, by pieces"] = timed(pieces) * share
    own = found[OWN]
    rows = [("3 s", name, f"{taken:.2f} s", f"{taken / own:.1f}") for name, taken in found.items()]
    print_table("A closed loop, one core", ("", "", "time", "times `simulate`"), rows)


if __name__ == "__main__":
    if any(os.environ.get(name) != value for name, value in ONE_THREAD.items()):
        os.execve(sys.executable, [sys.executable, *sys.argv], {**os.environ, **ONE_THREAD})  # noqa: S606
    main()
