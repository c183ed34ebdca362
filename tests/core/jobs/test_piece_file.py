"""A finished piece as a file: whole or absent, and copied to its place."""

import errno
import os
from pathlib import Path

import pytest

from vstatics.core.jobs import piece_file
from vstatics.core.jobs.piece_file import Account, Copy, Noticed, piece_bytes, read_account


def test_a_piece_is_read_back_as_it_was_written(tmp_path: Path) -> None:
    noticed = (Noticed("N605", "the control is cut", 7, 2),)
    parts = [b"columns", b"and more"]
    account, buffers = piece_bytes(3, 2, {"ok": 2}, parts, (1, 0), ("drag of C",), noticed)
    piece_file.write_piece(str(tmp_path), 3, buffers)
    assert read_account(str(tmp_path), 3) == account
    assert isinstance(account, Account)
    assert (account.variants, account.length) == (2, 15)
    assert read_account(str(tmp_path), 4) is None


@pytest.mark.parametrize("damage", ["cut", "changed", "another", "empty"])
def test_a_damaged_piece_is_none(damage: str, tmp_path: Path) -> None:
    _, buffers = piece_bytes(3, 2, {"ok": 2}, [b"columns"])
    piece_file.write_piece(str(tmp_path), 3, buffers)
    data = (tmp_path / piece_file.piece_name(3)).read_bytes()
    damaged = {"cut": data[:-1], "changed": b"C" + data[1:], "another": data, "empty": b""}
    number = 5 if damage == "another" else 3
    (tmp_path / piece_file.piece_name(number)).write_bytes(damaged[damage])
    assert read_account(str(tmp_path), number) is None


@pytest.mark.parametrize("in_kernel", [True, False])
def test_stretches_are_copied_to_their_places(
    in_kernel: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By the kernel, or through this process where the file system can't do it."""
    for number in range(2):
        _, buffers = piece_bytes(number, 1, {}, [b"0123456789"])
        piece_file.write_piece(str(tmp_path), number, buffers)
    (tmp_path / piece_file.ASSEMBLED).write_bytes(b".........")

    def refused(*_: object) -> int:
        raise OSError(errno.EXDEV, "no")

    if not in_kernel:
        monkeypatch.setattr(os, "copy_file_range", refused, raising=False)
    assert piece_file.copy(str(tmp_path), [Copy(0, 2, 1, 3), Copy(1, 8, 6, 2)]) == 5
    assert (tmp_path / piece_file.ASSEMBLED).read_bytes() == b".234..89."
