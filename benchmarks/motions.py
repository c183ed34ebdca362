"""Benchmarks of motions, against the same equations with smoothed friction."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial

import vstatics
from benchmarks.driveline import ClosedLoop
from benchmarks.measuring import CASES, Race, Setting, timer
from benchmarks.smoothed import OpenLoop
from vstatics import load_scenario, simulate
from vstatics.core.readers import read
from vstatics.simulation import Capacity, Points, Scenario, constant
from vstatics.simulation.scenario.file import read_scenario
from vstatics.simulation.variants.subject import load_varied

SCENARIOS = CASES / "scenarios"
TOLERANCES = (1e-7, 1e-8, 1e-9, 1e-10, 1e-11)
SAME_TIME, SAME_SPEED = 1e-9, 1e-6
"""Deviations of the peer, at most, in lock-up times [s] and in speeds at the end [rad/s]."""
CLUTCHES = {"at once": constant(145.6), "in 0.02 s": Points((0.0, 0.02), (0.0, 145.6))}
"""Capacities of a clutch that is dumped."""


def box_shifts(_setting: Setting) -> Race:
    """Simulate six seconds of a gearbox of seven links, with two shifts.

    The equations are smooth between two events, so that `simulate` takes large steps.
    """
    return _open_loop(load_scenario(SCENARIOS / "tarasik-box.yaml"))


def dumped_clutch(_setting: Setting, engaged: str) -> Race:
    """Simulate a start with six springs, whose clutch is dumped and whose tyres can slip."""
    scenario = load_scenario(SCENARIOS / "moskvich-start.yaml")
    [clutch] = scenario.case.shift_elements  # of the peer, static and sliding friction are equal
    scenario = scenario._replace(
        case=scenario.case.replace(shift_elements=[clutch._replace(static=1.0)])
    )
    if engaged in CLUTCHES:
        scenario = scenario._replace(controls={1: Capacity(CLUTCHES[engaged])})
    return _open_loop(scenario)


def _open_loop(scenario: Scenario) -> Race:
    motion = simulate(scenario)
    peer = OpenLoop(scenario, motion)
    elements = {name: number for number, name in enumerate(motion.elements)}
    events = [one for one in motion.events if one.event == "locks" and one.element in elements]
    exact = {elements[one.element]: one.time for one in events}

    def agrees(tolerance: float) -> bool:
        found = peer.lock_ups(tolerance)
        return all(abs(found.get(n, 0.0) - time) < SAME_TIME for n, time in exact.items())

    run = partial(peer.lock_ups, _largest(agrees))
    return Race(timer(partial(simulate, scenario)), timer(run))


def closed_loop(_setting: Setting) -> Race:
    """Simulate a controlled upshift of a driveline of 20 links.

    `simulate` also finds the instants at which the sequence goes on, which its peer knows.
    """
    case, file = CASES / "driveline-8hp70.yaml", SCENARIOS / "8hp70-upshift.yaml"
    text = case.read_bytes().replace(b"efficiency: 0.98", b"efficiency: 1")
    document = read_scenario(file.read_bytes(), str(file))
    scenario = document.with_case(read(text, case.name)).scenario
    motion = simulate(scenario)
    peer = ClosedLoop(scenario, motion)

    def agrees(tolerance: float) -> bool:
        return bool(abs(peer.last_speeds(tolerance) - motion.speeds[-1]).max() < SAME_SPEED)

    run = partial(peer.last_speeds, _largest(agrees))
    return Race(timer(partial(simulate, scenario)), timer(run))


def _largest(agrees: Callable[[float], bool]) -> float:
    """Return the largest tolerance at which the peer agrees, so that it is not too exact."""
    for tolerance in TOLERANCES:
        if agrees(tolerance):
            return tolerance
    sys.exit("the peer does not agree with `simulate`")


def swept_shifts(setting: Setting) -> Race:
    """Sweep a shift, whose document is read and checked for each variant."""
    file, count = SCENARIOS / "tarasik-box.yaml", setting.some(100)
    varied = load_varied(str(file))
    vary: dict[str, str | list[float]] = {"controls.FB.2.1": f"2.05:2.4:{count}", "duration": [3.0]}
    scenario = load_scenario(file)._replace(duration=3.0)
    controls = scenario.controls or {}

    def sweep() -> None:
        for chunk in vstatics.sweep(varied, vary, out="heat[FB],max(abs(slips[FB])),locks[FB]"):
            if set(chunk.counts) != {"ok"}:
                sys.exit("a variant has no numbers")

    def loop() -> None:
        for number in range(count):
            law = Points((1.9, 2.05 + 0.35 * number / count, 4.0, 4.0), (0.0, 3e3, 3e3, 0.0))
            simulate(scenario._replace(controls={**controls, 2: Capacity(law)}))

    return Race(timer(sweep, count), timer(loop, count))
