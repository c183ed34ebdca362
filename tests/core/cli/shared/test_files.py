"""Files that commands write: whole or not at all, where and as the caller wants them."""

from __future__ import annotations

import json
import os
import stat
from pathlib import Path

import pytest

from tests.commands import BAD, CASES, MZKT, TIED_UP, vstatics
from tests.processes import names


@pytest.mark.parametrize("form", ["listing", "json", "csv"])
def test_a_file_holds_what_stdout_would(folder: Path, form: str) -> None:
    said = vstatics("run", MZKT, "-f", form, "-o", "new")
    assert (said.status, said.all) == (0, "")
    expected = vstatics("run", MZKT, "-f", form).out
    assert (folder / "new").read_text(encoding="utf-8") == expected
    assert names(folder) == ["new"]
    assert vstatics("run", MZKT, "-f", form, "-o", "-").out == expected


def test_a_new_file_has_the_permissions_of_the_umask_an_old_one_keeps_its_own(folder: Path) -> None:
    before = os.umask(0o027)
    try:
        vstatics("run", MZKT, "-o", "new.lst")
    finally:
        os.umask(before)
    old = folder / "new.lst"
    assert stat.S_IMODE(old.stat().st_mode) == 0o640
    old.chmod(0o604)
    vstatics("run", MZKT, "-o", "new.lst")
    assert stat.S_IMODE(old.stat().st_mode) == 0o604


def test_a_failing_run_leaves_the_old_file(folder: Path) -> None:
    old = folder / "old.lst"
    old.write_text("old", encoding="utf-8")
    said = vstatics("run", "-", "-o", "old.lst", stdin=BAD.encode())
    assert (said.status, old.read_text(encoding="utf-8")) == (1, "old")
    assert vstatics("convert", "-", "old.dat", stdin=BAD.encode()).status == 1
    assert names(folder) == ["old.lst"]


def test_a_write_that_breaks_off_leaves_the_old_file(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(source: str, target: str, **_: object) -> None:
        raise OSError(28, "No space left on device", source, None, target)

    old = folder / "old.lst"
    old.write_text("old", encoding="utf-8")
    monkeypatch.setattr(os, "replace", full)
    said = vstatics("run", MZKT, "-o", "old.lst")
    assert said.gives_nothing()
    assert said.err == "old.lst: error: cannot be written: No space left on device\n"
    assert (names(folder), old.read_text(encoding="utf-8")) == (["old.lst"], "old")


def test_a_gear_tied_up_fails_but_its_results_are_written(folder: Path) -> None:
    said = vstatics("run", "-", "-f", "json", "-o", "tied.json", stdin=TIED_UP.encode())
    assert said.status == 1
    document = json.loads((folder / "tied.json").read_text(encoding="utf-8"))
    assert document["ratio"] == [None, pytest.approx(3.5)]


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(
    ("target", "reason"),
    [
        ("nowhere/deep/new", "there is no directory nowhere/deep; create it"),
        ("", "Is a directory"),
        ("file/new", "Not a directory"),
    ],
)
def test_what_cannot_be_written_is_told(target: str, reason: str) -> None:
    Path("file").touch()
    for command in (["run", MZKT, "-o", target], ["convert", MZKT, target, "--to", "deck"]):
        said = vstatics(*command)
        assert said.gives_nothing()
        assert said.err == f"{target}: error: cannot be written: {reason}\n"
    assert names(Path()) == ["file"]


def test_a_link_stays_and_its_file_is_written(folder: Path) -> None:
    (folder / "far").mkdir()
    (folder / "far" / "real.lst").write_text("old", encoding="utf-8")
    (folder / "link.lst").symlink_to("far/real.lst")
    (folder / "dangling.lst").symlink_to("far/new.lst")
    for link in ("link.lst", "dangling.lst"):
        assert vstatics("run", MZKT, "-o", link).status == 0
        assert (folder / link).is_symlink()
    assert names(folder / "far") == ["new.lst", "real.lst"]
    for path in (folder / "far").iterdir():
        assert path.read_text(encoding="utf-8") == vstatics("run", MZKT).out


@pytest.mark.usefixtures("folder")
def test_a_device_is_written_to_and_stays() -> None:
    assert vstatics("run", MZKT, "-o", os.devnull).status == 0
    assert stat.S_ISCHR(Path(os.devnull).stat().st_mode)


def test_a_name_may_be_as_long_as_names_can_be(folder: Path) -> None:
    name = "x" * 251 + ".lst"
    assert vstatics("run", MZKT, "-o", name).all == ""
    assert names(folder) == [name]


@pytest.mark.parametrize(
    "given",
    [
        ("run", "case.yaml", "-o", "case.yaml"),
        ("run", "case.yaml", "-f", "json", "-o", "./case.yaml"),
        ("run", "case.yaml", MZKT, "-f", "jsonl", "-o", "case.yaml"),
        ("run", "--files-from", "list", "-f", "jsonl", "-o", "list"),
        ("flow", "case.yaml", "-o", "case.yaml"),
        ("explain", "case.yaml", "-o", "link.yaml"),
        ("summary", MZKT, "case.yaml", "-o", "case.yaml"),
        ("summary", "case.yaml", "--duty", "duty.yaml", "-o", "duty.yaml"),
        ("report", "case.yaml", "-o", "case.yaml"),
        ("plot", "plan.svg", "--from", "yaml", "--kind", "plan", "-o", "plan.svg"),
        ("convert", "case.yaml", "link.yaml"),
        ("sweep", "case.yaml", "--variants", "v.csv", "-o", "v.csv"),
    ],
    ids=lambda given: " ".join(map(str, given[::3])),
)
def test_nothing_is_written_over_what_is_read(folder: Path, given: tuple[str, ...]) -> None:
    case = (CASES / "differential.yaml").read_bytes()
    for name in ("case.yaml", "plan.svg"):
        Path(name).write_bytes(case)
    Path("link.yaml").symlink_to("case.yaml")
    Path("list").write_text("case.yaml\n", encoding="utf-8")
    Path("duty.yaml").write_text("energy: {1: 1}\n", encoding="utf-8")
    Path("v.csv").write_text("D.ratio\n-2\n-3\n", encoding="utf-8")
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    said = vstatics(*given)
    assert said.is_wrong_use("is what is read, and would be overwritten")
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_a_handle_that_there_cannot_be_is_told() -> None:
    said = vstatics("run", MZKT, "-o", "/dev/fd/99999999999999999999")
    assert said.fails("cannot be written")
    assert "an error in vstatics" not in said.err


@pytest.mark.usefixtures("folder")
def test_a_page_is_no_other_file() -> None:
    said = vstatics("report", MZKT, "-o", "page.pdf")
    assert said.is_wrong_use("page.pdf: no format has this suffix here: expected .html .htm")
