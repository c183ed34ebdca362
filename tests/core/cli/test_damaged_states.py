"""Finished work that is damaged: it is calculated again, or the command says that it cannot go on.

The reference is the result of the same command without a state.
"""

from __future__ import annotations

import os
import random
import shutil
from collections import Counter
from collections.abc import Callable
from itertools import cycle
from pathlib import Path

import pytest

from tests.chance import seeded
from tests.commands import Said
from tests.core.cli.states import COMMANDS, StatedCommand, prepare, remove

LAST = ("boxes.json", "boxes.txt", "f.json")
"""Files that a command writes last into its folder."""


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    prepare(tmp_path, monkeypatch)


def stop(command: StatedCommand, monkeypatch: pytest.MonkeyPatch) -> None:
    """Call a command that cannot write its result, so that its state stays."""
    rename = os.replace

    def full(source: str, target: str, **more: int | None) -> None:
        if os.path.basename(target) in (command.output, *LAST):  # noqa: PTH119
            raise OSError(28, "No space left on device")
        rename(source, target, **more)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", full)
        said = command.call()
    assert said.status == 1, said
    assert "No space left on device" in said.err


Damage = Callable[[random.Random, list[Path]], None]


def flip(choose: random.Random, files: list[Path]) -> None:
    """Turn one bit over; in a file that is chosen first, so that short ones get their share."""
    file = choose.choice(files)
    data = bytearray(file.read_bytes())
    place = choose.randrange(8 * len(data))
    data[place // 8] ^= 1 << place % 8
    file.write_bytes(data)


def cut(choose: random.Random, files: list[Path]) -> None:
    file = choose.choice(files)
    os.truncate(file, choose.randrange(file.stat().st_size))


def swap(choose: random.Random, files: list[Path]) -> None:
    entry, other = choose.choice(files), choose.choice(files)
    data = entry.read_bytes(), other.read_bytes()
    entry.write_bytes(data[1])
    other.write_bytes(data[0])


def miss(choose: random.Random, files: list[Path]) -> None:
    choose.choice(files).unlink()


def double(choose: random.Random, files: list[Path]) -> None:
    """Repeat a stretch of a file, as a faulty copy does."""
    file = choose.choice(files)
    data = file.read_bytes()
    start, end = sorted(choose.randrange(len(data) + 1) for _ in "12")
    file.write_bytes(data[:end] + data[start:])


def judged(said: Said, command: StatedCommand, expected: dict[str, bytes]) -> str:
    """What became of a damaged state."""
    assert "an error of vstatics" not in said.err
    assert "Traceback" not in said.err
    if said.status == 0:
        assert command.written() == expected
        return "the same bytes"
    assert said.err
    assert said.status in (1, 2), said
    return "told"


def damaged(
    command: StatedCommand, damage: Damage, times: int, monkeypatch: pytest.MonkeyPatch
) -> Counter[str]:
    """What became of a state that was damaged so many times."""
    assert command.call("-q").status == 0
    expected = command.written()
    remove(command)
    remove(command._replace(folder=command.folder.removesuffix(".parts")))
    stop(command, monkeypatch)
    shutil.copytree(".", "../whole", dirs_exist_ok=True)
    choose, outcomes = seeded(23), Counter[str]()
    for _ in range(times):
        damage(choose, [entry for name in command.state if (entry := Path(name)).stat().st_size])
        outcomes[judged(command.call("--resume"), command, expected)] += 1
        for name in os.listdir():  # noqa: PTH208
            shutil.rmtree(name) if Path(name).is_dir() else Path(name).unlink()
        shutil.copytree("../whole", ".", dirs_exist_ok=True)
    return outcomes


DAMAGES = [flip, cut, swap, miss, double]


@pytest.mark.parametrize(
    ("name", "damage"),
    [*zip(COMMANDS, cycle(DAMAGES), strict=False)],
    ids=lambda part: getattr(part, "__name__", part),
)
def test_damaged_work_is_not_believed(
    name: str, damage: Damage, monkeypatch: pytest.MonkeyPatch
) -> None:
    damaged(COMMANDS[name], damage, 3, monkeypatch)


@pytest.mark.slow
@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize("name", COMMANDS)
def test_work_that_is_damaged_in_200_places_is_not_believed(
    name: str, damage: Damage, monkeypatch: pytest.MonkeyPatch
) -> None:
    outcomes = damaged(COMMANDS[name], damage, 200, monkeypatch)
    assert outcomes["the same bytes"] > 0, outcomes
