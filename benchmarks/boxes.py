"""Benchmarks of the search for gearboxes, which also check that it finds a gearbox that exists."""

from __future__ import annotations

import json

from benchmarks.measuring import CASES, VSTATICS, Race, Setting, command, timer
from benchmarks.peer import Peer
from vstatics import load

SIX = ("--sets=3", "--shift-elements=5", "--engaged=2", "--tolerance=.01")
SIX_RATIOS = "--ratios=4.484,2.872,1.842,1.414,1,.742,-2.882"
EIGHT = ("--sets=4", "--shift-elements=5", "--engaged=3", "--tolerance=.005")
EIGHT_RATIOS = "--ratios=4.70,3.13,2.10,1.67,1.28,1,.84,.67,-3.30"
FIRST = 5
"""The gearbox that exists is among this many."""


def six_speeds(setting: Setting) -> Race:
    """Search for gearboxes with six gears and reverse; the GM 6T70 is one of them."""
    return _search(setting, "gm-6t70", "mzkt7922.dat", *SIX, SIX_RATIOS)


def eight_speeds(setting: Setting) -> Race:
    """Search for gearboxes with eight gears and reverse; the ZF 8HP70 is one of them."""
    return _search(setting, "zf-8hp70", "zf-8hp70.yaml", *EIGHT, EIGHT_RATIOS)


def _search(setting: Setting, known: str, same_size: str, *options: str) -> Race:
    """Compare with one gear of each gearbox in C, the least work of a search without pruning.

    The compiled search discards most gearboxes after a few operations.
    """
    output, case = setting.folder / "boxes.json", load(CASES / same_size)
    words = (VSTATICS, "synth", "box", *options, "-q", "-o", str(output))
    count = setting.some(20_000)
    one_gear = Peer(setting, case).timer(count, count * len(case.gears))

    def all_gears() -> float:
        found = json.loads(output.read_text("utf-8"))
        assert known in [box["known"] for box in found["boxes"][:FIRST]]  # noqa: S101
        return float(found["searched"]) * one_gear()

    return Race(timer(command(*words, folder=setting.folder)), all_gears)
