"""Finished work that is damaged: it is calculated again, or the command says that it cannot go on.

The reference is the result of the same command without a state.
"""

import os
import random
import shutil
from collections import Counter
from itertools import cycle
from pathlib import Path

import pytest

from tests.chance import seeded
from tests.core.cli.states import COMMANDS, StatedCommand

LAST = ("boxes.json", "boxes.txt", "f.json")
"""Files that a command writes last into its folder."""
pytestmark = pytest.mark.usefixtures("prepared")


def stop(command: StatedCommand, monkeypatch: pytest.MonkeyPatch) -> None:
    """Call a command that cannot write its result, so that its state stays."""
    rename = os.replace

    def full(source: str, target: str, **more: int | None) -> None:
        if os.path.basename(target) in (command.output, *LAST):  # noqa: PTH119
            raise OSError(28, "No space left on device")
        rename(source, target, **more)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", full)
        assert command.call().fails("No space left on device")


def flip_bit(choose: random.Random, data: bytes) -> bytes:
    place = choose.randrange(8 * len(data))
    flipped = data[place // 8] ^ 1 << place % 8
    return data[: place // 8] + bytes([flipped]) + data[place // 8 + 1 :]


def cut(choose: random.Random, data: bytes) -> bytes:
    return data[: choose.randrange(len(data))]


def repeat_part(choose: random.Random, data: bytes) -> bytes:
    """Repeat a stretch of a file, as a faulty copy does."""
    start, end = sorted(choose.randrange(len(data) + 1) for _ in "12")
    return data[:end] + data[start:]


DAMAGES = ("flip_bit", "cut", "swap", "miss", "repeat_part")
WAYS = {"flip_bit": flip_bit, "cut": cut, "repeat_part": repeat_part}


def apply(damage: str, choose: random.Random, files: list[Path]) -> None:
    """Damage a file that is chosen first, so that short files get their share."""
    one, other = choose.choice(files), choose.choice(files)
    data = one.read_bytes()
    if damage == "miss":
        one.unlink()
    elif damage == "swap":
        one.write_bytes(other.read_bytes())
        other.write_bytes(data)
    else:
        one.write_bytes(WAYS[damage](choose, data))


def outcomes_of(
    command: StatedCommand, damage: str, times: int, monkeypatch: pytest.MonkeyPatch
) -> Counter[str]:
    """Resume a command with a damaged state again and again: the same bytes, or words."""
    expected = command.whole()
    stop(command, monkeypatch)
    shutil.copytree(".", "../whole", dirs_exist_ok=True)
    choose, outcomes = seeded(23), Counter[str]()
    for _ in range(times):
        apply(damage, choose, [file for file in command.state if file.stat().st_size])
        said = command.call("--resume")
        assert "an error of vstatics" not in said.err
        assert "Traceback" not in said.err
        if said.status == 0:
            assert command.written() == expected
        else:
            assert (said.status in (1, 2), said.err != "") == (True, True), said
        outcomes["told" if said.status else "the same bytes"] += 1
        for name in os.listdir():  # noqa: PTH208
            shutil.rmtree(name) if Path(name).is_dir() else Path(name).unlink()
        shutil.copytree("../whole", ".", dirs_exist_ok=True)
    return outcomes


@pytest.mark.parametrize(("name", "damage"), [*zip(COMMANDS, cycle(DAMAGES), strict=False)])
def test_damaged_work_is_not_believed(
    name: str, damage: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    outcomes_of(COMMANDS[name], damage, 3, monkeypatch)


@pytest.mark.slow
@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize("name", COMMANDS)
def test_work_that_is_damaged_in_200_places_is_not_believed(
    name: str, damage: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    outcomes = outcomes_of(COMMANDS[name], damage, 200, monkeypatch)
    # without its record, a folder of gearboxes could contain files of the user
    is_alone = (name, damage) == ("record of boxes", "miss")
    assert (outcomes["the same bytes"] > 0) != is_alone, outcomes
