"""Files that commands write: whole or not at all, where and as the caller wants them."""

import os
import stat
from pathlib import Path

import pytest

from tests.commands import BAD, CASES, MZKT, vstatics
from tests.processes import names

LISTING = vstatics("run", MZKT).out


def test_a_file_holds_what_stdout_would(folder: Path) -> None:
    assert vstatics("run", MZKT, "-o", "new") == (0, "", "")
    expected = vstatics("run", MZKT, "-o", "-").out
    assert (folder / "new").read_text("utf-8") == expected != ""
    assert names(folder) == ["new"]


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


def test_a_failing_run_leaves_the_old_file(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a wrong case, and of a full disk."""

    def full(source: str, target: str, **_: object) -> None:
        raise OSError(28, "No space left on device", source, None, target)

    old = folder / "old.lst"
    old.write_text("old", "utf-8")
    assert vstatics("run", "-", "-o", "old.lst", stdin=BAD.encode()).status == 1
    assert vstatics("convert", "-", "old.dat", stdin=BAD.encode()).status == 1
    monkeypatch.setattr(os, "replace", full)
    said = vstatics("run", MZKT, "-o", "old.lst")
    assert said.gives_nothing()
    assert said.err == "old.lst: error: cannot be written: No space left on device\n"
    assert (names(folder), old.read_text("utf-8")) == (["old.lst"], "old")


@pytest.mark.usefixtures("folder")
def test_what_cannot_be_written_is_reported() -> None:
    for target, reason in (
        ("nowhere/deep/new", "there is no directory nowhere/deep; create it"),
        ("", "Is a directory"),
        ("file/new", "Not a directory"),
    ):
        Path("file").touch()
        for command in (["run", MZKT, "-o", target], ["convert", MZKT, target, "--to", "deck"]):
            said = vstatics(*command)
            assert said == (1, "", f"{target}: error: cannot be written: {reason}\n")
        assert names(Path()) == ["file"]


def test_a_link_stays_and_its_file_is_written(folder: Path) -> None:
    (folder / "far").mkdir()
    (folder / "far" / "real.lst").write_text("old", "utf-8")
    for name, target in (("link.lst", "real.lst"), ("dangling.lst", "new.lst")):
        (folder / name).symlink_to(f"far/{target}")
        assert vstatics("run", MZKT, "-o", name).status == 0
        assert (folder / name).is_symlink()
        assert (folder / "far" / target).read_text("utf-8") == LISTING


def test_outputs_of_any_name(folder: Path) -> None:
    """A device stays; a name is as long as names can be; a handle that there cannot be is told."""
    assert vstatics("run", MZKT, "-o", os.devnull).status == 0
    assert stat.S_ISCHR(Path(os.devnull).stat().st_mode)
    name = "x" * 251 + ".lst"
    assert vstatics("run", MZKT, "-o", name).all == ""
    assert names(folder) == [name]
    said = vstatics("run", MZKT, "-o", "/dev/fd/99999999999999999999")
    assert said.fails("cannot be written")
    assert "an error in vstatics" not in said.err


@pytest.mark.parametrize(
    "line",
    [
        "run case.yaml -f json -o ./case.yaml",
        "run case.yaml other.yaml -f jsonl -o case.yaml",
        "run --files-from list -f jsonl -o list",
        "flow case.yaml -o case.yaml",
        "explain case.yaml -o link.yaml",
        "summary case.yaml --duty duty.yaml -o duty.yaml",
        "report case.yaml -o case.yaml",
        "plot plan.svg --from yaml --kind plan -o plan.svg",
        "convert case.yaml link.yaml",
        "sweep case.yaml --variants v.csv -o v.csv",
    ],
)
def test_nothing_is_written_over_what_is_read(folder: Path, line: str) -> None:
    for name in ("case.yaml", "other.yaml", "plan.svg", "list", "duty.yaml", "v.csv"):
        Path(name).write_bytes((CASES / "differential.yaml").read_bytes())
    Path("link.yaml").symlink_to("case.yaml")
    Path("list").write_text("case.yaml\n", "utf-8")
    Path("duty.yaml").write_text("energy: {1: 1}\n", "utf-8")
    Path("v.csv").write_text("D.ratio\n-2\n-3\n", "utf-8")
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    assert vstatics(*line.split()).is_wrong_use("is what is read, and would be overwritten")
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before
