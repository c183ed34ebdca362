"""The flow of one gear, and the powers in it."""

from functools import cache
from pathlib import Path

from vstatics import Results, Transmission, load, solve
from vstatics.core.flow.power import flows
from vstatics.core.flow.power_flow import GearFlow, PowerFlow


def only(case: Transmission) -> GearFlow:
    """The flow of a case of one gear."""
    [flow] = flows(solve(case))
    return flow


def sides(flow: GearFlow) -> tuple[PowerFlow, PowerFlow]:
    """Without and with losses; both exist."""
    assert flow.ideal is not None
    assert flow.lossy is not None
    return flow.ideal, flow.lossy


def through(side: PowerFlow) -> dict[str, float]:
    """The power through whatever has this name; names of one case differ."""
    return {str(node): value for node, value in side.throughput.items()}


def lost(side: PowerFlow) -> dict[str, float]:
    return {str(node): value for node, value in side.losses.items()}


def around(side: PowerFlow) -> list[tuple[str, object]]:
    """Each loop and its power."""
    return [(" ".join(map(str, loop.nodes)), loop.power) for loop in side.loops]


@cache
def solved(path: Path, *, coast: bool) -> Results:
    return solve(load(path), coast=coast)
