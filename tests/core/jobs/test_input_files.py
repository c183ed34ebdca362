"""Inputs have bounds: what is read is what a file holds, and no more than it may."""

import contextlib
import io
import os
import threading
from pathlib import Path

import pytest

from tests.chance import count, seeded
from vstatics.core.jobs.input_files import NotRegularError, TooLargeError, read_file, read_stream


class Drip(io.RawIOBase):
    """A stream that gives its bytes in parts of other sizes than it is asked for."""

    def __init__(self, data: bytes, seed: int) -> None:
        self.data, self.rng = data, seeded(seed)

    def read(self, size: int = -1) -> bytes:
        """Return the next part."""
        part = self.data[: self.rng.randint(1, max(size, 1))]
        self.data = self.data[len(part) :]
        return part


def test_files_pipes_and_streams_are_read_up_to_their_bound(tmp_path: Path) -> None:
    rng = seeded(24)
    for number in range(count(120, 1000)):
        data = rng.randbytes(rng.choice((0, 1, 99, 100, 101, rng.randint(0, 200_000))))
        most = rng.choice((0, 1, 100, len(data), max(len(data) - 1, 0), 10**6))
        file = tmp_path / f"file{number}"
        kind = number % 3
        try:
            if kind == 0:
                file.write_bytes(data)
                read = read_file(file, most, regular=rng.random() < 0.5)
            elif kind == 1:
                os.mkfifo(file)
                writer = threading.Thread(target=_written, args=[file, data])
                writer.start()
                try:
                    read = read_file(file, most)
                finally:
                    writer.join()
            else:
                read = read_stream(Drip(data, number), most)
        except TooLargeError:
            assert len(data) > most
        else:
            assert len(data) <= most
            assert read == data


def _written(file: Path, data: bytes) -> None:
    with contextlib.suppress(BrokenPipeError):
        file.write_bytes(data)


def test_a_text_keeps_its_kind() -> None:
    assert read_stream(io.StringIO("шесть"), 5) == "шесть"


@pytest.mark.parametrize("name", ["/dev/zero", "/dev/null", "pipe", "/dev/stdin"])
def test_what_a_file_names_is_a_regular_file(tmp_path: Path, name: str) -> None:
    file = tmp_path / "pipe"
    os.mkfifo(file)
    with pytest.raises(NotRegularError, match="expected a regular file"):
        read_file(file if name == "pipe" else name, regular=True)


def test_a_large_file_is_not_read_at_all(tmp_path: Path) -> None:
    with (tmp_path / "sparse").open("wb") as opened:
        opened.truncate(10**13)
    with pytest.raises(TooLargeError, match="larger than 10 MB"):
        read_file(tmp_path / "sparse")
