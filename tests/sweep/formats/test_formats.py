"""The output of a sweep in each format, against the readers of other programs."""

import csv
import io
import json
import math
import zipfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.sweep.sweeps import plan
from vstatics.core.jobs.alone import Alone
from vstatics.core.jobs.finished_pieces import FinishedPieces
from vstatics.core.jobs.piece_file import Account, Segment
from vstatics.core.tables.file_suffixes import format_of
from vstatics.sweep.chunk import STATUS, Chunk
from vstatics.sweep.formats import FORMATS, npz, text
from vstatics.sweep.formats.npz import combined_crc
from vstatics.sweep.output import Output, description

NUMBERS = st.floats(allow_nan=True, allow_infinity=True)
HEADINGS = ('speeds["a, b",1]', "100% {x} ⚙", "it's nan: 1")
"""What CSV has to quote, what `%` could take for its own, what looks like a number."""


Row = tuple[float, float, float, float]


def chunk(rows: list[Row]) -> Chunk:
    """A chunk of one varied number and three columns."""
    numbers = np.array(rows).reshape(len(rows), 4)
    status = np.arange(len(rows), dtype=np.uint8) % len(STATUS)
    nothing = np.zeros((len(rows), 0))
    numbered = np.arange(7, 7 + len(rows))
    values, columns = numbers[:, :1], numbers[:, 1:]
    return Chunk(7, numbered, values, status, columns, nothing, {}, ("D.ratio",), HEADINGS)


def shown(number: float) -> str:
    """What Python makes of a number in twelve digits; nothing of what there is not."""
    return f"{number:.12g}" if math.isfinite(number) else ""


@given(st.lists(st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS), max_size=9))
def test_csv_is_read_back_by_the_standard_library(rows: list[Row]) -> None:
    head = text.head("csv", ("variant", "D.ratio", "status", *HEADINGS))
    data = head + text.rows("csv", chunk(rows))
    read = list(csv.reader(io.StringIO(data.decode())))
    assert read[0] == ["variant", "D.ratio", "status", *HEADINGS]
    assert read[1:] == [
        [str(7 + n), shown(row[0]), STATUS[n % len(STATUS)], *map(shown, row[1:])]
        for n, row in enumerate(rows)
    ]


@given(st.lists(st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS), max_size=9))
def test_json_lines_are_read_back_by_the_standard_library(rows: list[Row]) -> None:
    assert text.head("jsonl", ("D.ratio", *HEADINGS)) == b""
    lines = text.rows("jsonl", chunk(rows)).decode().split("\n")
    assert lines.pop() == ""
    for n, (line, row) in enumerate(zip(lines, rows, strict=True)):
        read = json.loads(line)
        assert list(read) == ["variant", "D.ratio", "status", *HEADINGS]
        assert read.pop("variant") == 7 + n
        assert read.pop("status") == STATUS[n % len(STATUS)]
        for number, expected in zip(read.values(), row, strict=True):
            assert number == (float(shown(expected)) if shown(expected) else None)


@given(st.binary(max_size=300), st.binary(max_size=70000))
def test_check_sums_are_combined_as_zlib_does_it(first: bytes, second: bytes) -> None:
    whole = zlib.crc32(first + second)
    assert combined_crc(zlib.crc32(first), zlib.crc32(second), len(second)) == whole


def output(path: Path, *vary: str, **more: Any) -> Path:
    form = format_of(path.name, FORMATS)
    assert form is not None
    made = plan(*vary, piece=8, **more)
    with FinishedPieces(str(path)) as store:
        store.open(description(made, form), made.pieces, resume=False)
        written = Output(made, form, store)
        workers = Alone(written.task, written.task.describe)
        written.calculate(workers, lambda _: None)
        written.assemble(workers)
    return path


VARY = ("D.ratio=-3:3:31", "D.efficiency=.9,1")
"""62 variants in 8 pieces; two are invalid: D.ratio is 0, and two more where it is 1."""


def test_all_formats_hold_the_same(tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    parquet = pytest.importorskip("pyarrow.parquet")
    paths = {form: output(tmp_path / f"out.{form}", *VARY) for form in ("csv", "jsonl", "npz")}
    rows = list(csv.DictReader(io.StringIO(paths["csv"].read_text("utf-8"))))
    objects = [json.loads(line) for line in paths["jsonl"].read_text("utf-8").splitlines()]
    archive = np.load(paths["npz"])
    table = parquet.read_table(output(tmp_path / "out.parquet", *VARY)).to_pandas()
    names = ["variant", "D.ratio", "D.efficiency", "status"]
    names += ["ratio[direct]", "ratio[low]", "efficiency[direct]", "efficiency[low]"]
    assert list(rows[0]) == list(objects[0]) == list(table.columns) == names
    assert archive.files == [*names, "statuses"]
    assert archive["variant"].tolist() == table["variant"].tolist() == list(range(62))
    status = archive["statuses"][archive["status"]].tolist()
    assert (status.count("invalid"), status.count("tied up")) == (2, 2)
    assert status == [row["status"] for row in rows] == [one["status"] for one in objects]
    assert status == table["status"].astype(str).tolist()
    for name in names[1:3] + names[4:]:
        np.testing.assert_array_equal(archive[name], table[name])
        expected = [shown(number) for number in archive[name]]
        assert [row[name] for row in rows] == expected
        assert [one[name] for one in objects] == [float(n) if n else None for n in expected]
    assert isinstance(table["status"].dtype, pandas.CategoricalDtype)
    assert parquet.read_table(tmp_path / "out.parquet")["ratio[low]"].null_count == 4


@pytest.mark.parametrize("suffix", ["csv", "jsonl", "npz", "parquet"])
def test_the_best_come_sorted_and_the_non_dominated_in_order(suffix: str, tmp_path: Path) -> None:
    """The low gear has the ratio 1 - u: 2 and 2.2 are nearest to 2.05; equal ones in order.

    Without losses a larger ratio costs nothing, so one dominates all others. None does where one
    objective is the other's negative.
    """
    pytest.importorskip("pyarrow")
    negative = {"where": "D.ratio < 0"}
    opposed = {"max": ["ratio[low]", "-ratio[low]"], **negative}
    for asked, column, expected in (
        ({"min": ["abs(ratio[low] - 2.05)"], "best": 3}, "D.ratio", [-1, -1, -1.2]),
        ({"min": ["abs(ratio[low] - 2.05)"], "best": 3}, "variant", [20, 21, 18]),
        ({"max": ["efficiency[low]", "ratio[low]"], **negative}, "variant", [1]),
        (opposed, "variant", list(range(30))),
        ({**opposed, "best": 2}, "D.ratio", [-3, -0.2]),
        ({"where": "ratio[low] > 99"}, "ratio[low]", []),
        ({"max": ["0/0"]}, "ratio[low]", []),
    ):
        path = output(tmp_path / f"out.{suffix}", *VARY, **asked)
        assert numbers(path, column) == pytest.approx(expected), asked


def numbers(path: Path, name: str) -> list[float]:
    if path.suffix == ".npz":
        return list(np.load(path)[name])
    if path.suffix == ".parquet":
        parquet = pytest.importorskip("pyarrow.parquet")
        return list(parquet.read_table(path)[name].to_pylist())
    data = path.read_text("utf-8")
    if path.suffix == ".jsonl":
        return [json.loads(line)[name] for line in data.splitlines()]
    return [float(row[name]) for row in csv.DictReader(io.StringIO(data))]


CHECKSUM_OF_ZEROS = {1200: 0x13FB496F, 2400: 0xB83EDE39}
"""By `zlib.crc32`, a million bytes after another, of so many millions."""


def test_an_archive_of_many_gigabytes_is_laid_out_in_64_bits(tmp_path: Path) -> None:
    """3e8 rows in two pieces: 2.4 GB for each column, of zeros that no disk has to hold."""
    rows, zero = 3 * 10**8, CHECKSUM_OF_ZEROS[2400]
    half = Segment(8 * rows // 2, CHECKSUM_OF_ZEROS[1200])
    accounts = [Account(piece, rows // 2, {}, (half, half)) for piece in range(2)]
    columns = [npz.ColumnType(name, np.dtype("<f8")) for name in ("a", "b")]
    made = npz.layout(columns, accounts, {"statuses": STATUS})
    path = tmp_path / "large.npz"
    with path.open("wb") as file:
        file.truncate(made.length)
        for place, known in made.texts:
            file.seek(place)
            file.write(known)
    assert sum(copy.length for copy in made.copies) == 2 * 8 * rows
    with zipfile.ZipFile(path) as archive:
        infos = {info.filename: info for info in archive.infolist()}
        assert [info.file_size for info in infos.values()][:2] == [8 * rows + 128] * 2
        assert infos["b.npy"].header_offset > 2**31
        with archive.open("b.npy") as member:
            np.lib.format.read_magic(member)
            assert np.lib.format.read_array_header_1_0(member)[0] == (rows,)
            assert member.read(80) == bytes(80)
        with archive.open("a.npy") as member:
            assert combined_crc(zlib.crc32(member.read(128)), zero, 8 * rows) == infos["a.npy"].CRC
