"""Patterns of files: what `glob` finds, but not through links to folders above themselves."""

import contextlib
import glob
import time
from pathlib import Path

import click
import pytest

from tests.chance import count, seeded
from vstatics.core.cli.shared.patterns import expanded


def test_patterns_find_what_glob_finds_where_no_link_leads_up(folder: Path) -> None:
    rng = seeded(13)
    for number in range(count(40, 400)):
        top = Path(f"top{number}")
        for _ in range(rng.randint(1, 8)):
            inner = top.joinpath(*rng.choices(["a", "b", "[c]", ".d"], k=rng.randint(0, 3)))
            inner.mkdir(parents=True, exist_ok=True)
            (inner / rng.choice(["x.yaml", "y.yaml", ".z.yaml"])).touch()
        parts = rng.choices(["*", "a", "?", "[ab]", "*b*", "..", "x*"], k=rng.randint(1, 4))
        pattern = "/".join([rng.choice([f"top{number}", str(folder / top)]), *parts, "*.yaml"])
        matching = glob.glob(pattern)  # noqa: PTH207
        expected = sorted(one for one in matching if not Path(one).is_dir())
        if expected:
            assert expanded([pattern]) == expected


def test_links_to_folders_above_are_not_followed(folder: Path) -> None:
    (folder / "a/b/c").mkdir(parents=True)
    for number in range(9):
        (folder / f"a/b/up{number}").symlink_to("../..")
    (folder / "elsewhere").mkdir()
    (folder / "elsewhere/x.yaml").touch()
    (folder / "a/side").symlink_to("../elsewhere")
    (folder / "a/b/c/x.yaml").touch()
    begin = time.process_time()
    assert expanded(["*/*/*/*.yaml"]) == ["a/b/c/x.yaml"]
    assert expanded(["a/*/*.yaml"]) == ["a/side/x.yaml"]
    assert expanded(["a/b/up0/a/b/c/*.yaml"]) == ["a/b/up0/a/b/c/x.yaml"]
    with pytest.raises(click.UsageError):
        expanded(["/".join("*" * 12) + "/x.yaml"])
    assert time.process_time() - begin < 1


def test_a_file_is_found_from_a_deleted_folder(folder: Path) -> None:
    """dschep/ntfy/issues/195 and pypa/pip/issues/4255: the current folder has no path then."""
    (folder / "gone").mkdir()
    with contextlib.chdir(folder / "gone"):
        (folder / "gone").rmdir()
        assert expanded(["../x.yaml", str(folder)]) == ["../x.yaml", str(folder)]
