"""Summaries of two cases side by side."""

from __future__ import annotations

import re
from pathlib import Path

from tests.commands import CASES, vstatics


def test_two_cases_stand_side_by_side() -> None:
    """ZF 8HP70 and Ford 10R80; spreads as the makers round them, 7.0 and 7.4."""
    said = vstatics("summary", CASES / "zf-8hp70.yaml", CASES / "ford-10r80.yaml")
    assert said.status == 0
    assert re.search(r"^spread +7\.04\d +7\.3\d\d$", said.out, re.MULTILINE)
    assert re.search(r"^1 +4\.696 +4\.69\d ", said.out, re.MULTILINE)
    assert re.search(r"^10 +- +0\.6\d\d ", said.out, re.MULTILINE)
    assert max(map(len, said.out.splitlines())) <= 80


def test_shifts_and_needed_capacities_stand_side_by_side(tmp_path: Path) -> None:
    """Ring held: 2.5 n on the brake, which slips by 1 in the direct gear; 1.2 times 2.5 without n."""
    files = []
    for n in (0.9, 0.8):
        files.append(tmp_path / f"{n}.yaml")
        files[-1].write_text(
            "links: [sun, ring, carrier]\n"
            "shift_elements: {C: [sun, ring], B: [ring, housing]}\n"
            "mechanisms: {set: {first: sun, second: ring, third: carrier, ratio: -2.5,"
            f" efficiency: {n}}}}}\n"
            "gears: {low: [B], direct: [C]}\n"
        )
    said = vstatics("summary", *files, "--reserve", "1.2").out
    # of low (1 + 2.5 n)/3.5, of direct 1
    assert re.search(r"^mean forward efficiency +0\.964 +0\.929$", said, re.MULTILINE)
    assert re.search(
        r"^largest slip power +2\.250  B, low-direct +2\.000  B, low-direct$", said, re.MULTILINE
    )
    assert re.search(
        r"^largest required torque capacity +3\.000  B, low +3\.000  B, low$", said, re.MULTILINE
    )
