"""Summaries of two cases side by side."""

from __future__ import annotations

import re

from tests.commands import CASES, vstatics


def test_two_cases_stand_side_by_side() -> None:
    """ZF 8HP70 and Ford 10R80; spreads as the makers round them, 7.0 and 7.4."""
    said = vstatics("summary", CASES / "zf-8hp70.yaml", CASES / "ford-10r80.yaml")
    assert said.status == 0
    assert re.search(r"^spread +7\.04\d +7\.3\d\d$", said.out, re.MULTILINE)
    assert re.search(r"^1 +4\.696 +4\.69\d ", said.out, re.MULTILINE)
    assert re.search(r"^10 +- +\.6\d\d ", said.out, re.MULTILINE)
    assert max(map(len, said.out.splitlines())) <= 80
