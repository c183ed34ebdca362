"""A served file that becomes something else: the page says so, and shows the case again later."""

import os
import shutil
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.chance import count, seeded
from tests.commands import vstatics
from tests.page.serve.served import BOX, serving
from tests.page.serve.test_saving import write
from tests.processes import wait_for
from vstatics.core.cli.shared.cases import CaseOptions
from vstatics.core.jobs import files
from vstatics.page.cli import serve

SECONDS = 5


def _sparse(file: Path) -> None:
    with file.open("wb") as opened:
        opened.truncate(3 * 10**9)


KINDS: dict[str, tuple[Callable[[Path], object], str]] = {
    "large": (_sparse, "larger than 10 MB"),
    "endless": (lambda file: file.symlink_to("/dev/zero"), "a device, expected a regular file"),
    "pipe": (os.mkfifo, "a named pipe (FIFO), expected a regular file"),
    "folder": (Path.mkdir, "Is a directory"),
    "gone": (lambda _: None, "No such file"),
}


def remove(file: Path) -> None:
    shutil.rmtree(file) if file.is_dir() and not file.is_symlink() else file.unlink(missing_ok=True)


def test_the_page_follows_its_file_whatever_it_becomes(tmp_path: Path) -> None:
    rng = seeded(46)
    with serving(write(tmp_path)) as served:
        for kind in rng.sample([*KINDS], len(KINDS)) + rng.choices([*KINDS], k=count(0, 20)):
            become, said = KINDS[kind]
            remove(served.file)
            become(served.file)
            begin = time.monotonic()
            wait_for(lambda: served.ask("shown").told["state"] == "error")
            page = served.ask("").body.decode()
            assert said in page, kind
            assert "box.yaml" in page
            assert served.save({"P1.ratio": -3}).status == 422, kind
            assert time.monotonic() - begin < SECONDS, kind
            remove(served.file)
            served.file.write_text(BOX, "utf-8")
            wait_for(lambda: served.ask("shown").told["state"] == "good")
            assert said not in served.ask("").body.decode()
            assert time.monotonic() - begin < SECONDS, kind
    assert served.file.read_text("utf-8") == BOX


def test_a_file_that_never_ends_is_not_served(tmp_path: Path) -> None:
    for kind in ("pipe", "endless"):
        KINDS[kind][0](tmp_path / kind)
        assert vstatics("serve", tmp_path / kind).fails(KINDS[kind][1])


@pytest.mark.parametrize("by_rename", [True, False])
def test_an_editor_that_writes_when_the_new_file_appears_loses_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, by_rename: bool
) -> None:
    file, rng = write(tmp_path), seeded(26)
    texts: list[str] = []

    def appears(*given: Any) -> tuple[str, int]:
        """Create the new file, and let the editor write in some moment of its being written."""
        made = new_file(*given)
        texts.append(BOX + f"# by the editor: {rng.random()}\n")
        other = file.with_name("box.yaml~") if by_rename else file
        other.write_text(texts[-1], "utf-8")
        if by_rename:
            other.replace(file)
        return made

    new_file = files._new_file
    monkeypatch.setattr(files, "_new_file", appears)
    with serving(file) as served:
        for number in range(1, count(8, 100)):
            status = served.save({"P1.ratio": -3 - number / 100}).status
            assert (status, len(texts)) == (412, number)
            assert file.read_text("utf-8") == texts[-1]
    assert [one.name for one in tmp_path.iterdir()] == ["box.yaml"]


def test_a_file_that_is_back_while_it_is_calculated_is_shown(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = write(tmp_path)
    read = serve._read
    answers: Iterator[Any] = iter([({}, [str(file)])])
    monkeypatch.setattr(serve, "_read", lambda *given: next(answers, None) or read(*given))
    made = serve.calculated(str(file), CaseOptions(), {})
    assert made.results is not None
    assert made.texts == {str(file): BOX.encode()}
