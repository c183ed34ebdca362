"""Converters that a gear opens: they transmit nothing."""

from __future__ import annotations

import pytest

from tests.core.writers.again import is_read_again
from vstatics import solve
from vstatics.core.errors import ReadError
from vstatics.core.readers import loads
from vstatics.core.readers.named.reader import read_yaml

COUPLINGS = """links: [engine, turbine, output]
shift_elements: {L: [engine, turbine]}
mechanisms:
  TC: {kind: converter, first: engine, second: turbine, speed_ratio: 0.8, points: [[0, 2], [1, 1]]}
  TD: {kind: converter, first: engine, second: output, speed_ratio: 0.5, points: [[0, 3], [1, 1]]}
  pair: {first: turbine, second: output, ratio: 2}
gears: {"1": {open: [TD]}, "2": {open: [TC]}, "3": {engaged: [L], open: [TD]}}
"""


def test_the_filled_one_of_two_couplings_drives() -> None:
    """K = 1.2 at i = 0.8 before a pair of 2, and K = 2 at i = 0.5."""
    results = solve(loads(COUPLINGS))
    assert results.ratio.tolist() == pytest.approx([2.5, 2, 2])
    assert results.lossy_output_torque.tolist() == pytest.approx([2.4, 2, 2])
    assert results.lossy_torques[:, 1:3].tolist() == [[1, 0], [0, 1], [0, 0]]
    assert results.messages == ()


def test_open_converters_are_written_as_they_were_read() -> None:
    case = loads(COUPLINGS)
    assert case.gears[0].open == (2,)
    assert is_read_again(case)


def test_only_converters_that_would_transmit_can_be_open() -> None:
    for given, message in (
        ("open: [pair]", "pair is not a converter"),
        ("open: [L]", "the name of a mechanism: TC, TD, pair"),
        ("open: [TC, TC]", "TC is listed twice"),
        ("open: [TC], speed_ratios: {TC: 0.8}", "TC also has a speed ratio in this gear"),
        ("engaged: [L], open: [TC]", "so it cannot be open"),
        ("open: TC", "expected a list of converters"),
    ):
        text = COUPLINGS.replace("open: [TD]", given, 1)
        with pytest.raises(ReadError, match=message) as caught:
            read_yaml(text.encode(), "case.yaml")
        assert "gears.1.open" in str(caught.value)
