"""A differential of ratio -2 with links 1 (sun), 2 (ring) and 3 (carrier), and its messages."""

from collections.abc import Sequence

import pytest

from tests.commands import vstatics
from vstatics import Gear, Mechanism, ReadError, Results, ShiftElement, Transmission
from vstatics.core import readers
from vstatics.core.writers.named import write_json

SET = Mechanism(1, 2, 3, ratio=-2.0, efficiency=0.97)


def train(
    elements: Sequence[tuple[int, int]], gear: Gear, *, links: int = 3, output: int = 3
) -> Transmission:
    """The differential with these clutches and brakes, in one gear."""
    names = "ABCD"[: len(elements)]
    made = [ShiftElement(*pair, name) for pair, name in zip(elements, names, strict=True)]
    return Transmission(links, made, [SET], [gear], output=output)


def texts(results: Results) -> list[str]:
    return [f"{message.severity}: {message.text}" for message in results.messages]


def status(case: Transmission) -> int:
    """Exit status of `vstatics run`."""
    written = write_json(case).encode()
    assert readers.read(written, "", "json").case == case
    return vstatics("run", "-", "--from", "json", stdin=written).status


def assert_located(text: str, faults: Sequence[tuple[str, str, int, str]]) -> None:
    """Each change of a text (before, after) is told in its line, with these words."""
    for before, after, line, words in faults:
        assert text.count(before) == 1
        with pytest.raises(ReadError) as caught:
            readers.read(text.replace(before, after).encode(), "case.yaml")
        problem = caught.value.problems[0]
        assert problem.place is not None
        assert (problem.place[1], words in problem.message) == (line, True), after
