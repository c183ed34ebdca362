"""A table of variants from a CSV: what is taken, what is refused and where, what is left."""

import contextlib
import errno
import io
import os
import pickle
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import vstatics
from tests.chance import count
from tests.commands import CASES
from tests.commands import vstatics as command
from tests.sweep.sweeps import CASE, in_parts
from vstatics.core.errors import Place, ReadError
from vstatics.core.jobs.spool import PREFIX, Spool
from vstatics.core.numerics.arrays import Floats
from vstatics.sweep.variants import table as tables
from vstatics.sweep.variants.numbered import VariantPart, VariantTable
from vstatics.sweep.variants.table import read_table
from vstatics.sweep.variants.table_file import load_table
from vstatics.sweep.variants.targets import Target


def read(data: bytes | str, folder: Path | None = None) -> VariantTable:
    encoded = data.encode() if isinstance(data, str) else data
    with pytest.MonkeyPatch.context() as patch:
        if folder is not None:
            patch.setattr(tempfile, "tempdir", str(folder))
        return read_table(io.BytesIO(encoded), "own.csv", CASE)


def refusal(data: bytes | str) -> list[tuple[int, int, str]]:
    with pytest.raises(ReadError) as caught:
        read(data)
    told = []
    for problem in caught.value.problems:
        assert problem.place is not None
        assert problem.place.file == "own.csv"
        told.append((problem.place.line, problem.place.column, problem.message))
    return told


@pytest.fixture
def spooled(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """A folder for temporary files, where even small tables are kept, read in small pieces."""
    monkeypatch.setattr(tables, "_IN_MEMORY", 4)
    monkeypatch.setattr(tables, "_PIECE", 64)
    return tmp_path


def test_a_table_as_people_write_it() -> None:
    for text in (
        "D1.ratio,D1.efficiency\n-2.5,.96\n-3,0.97\n",
        "D1.ratio,D1.efficiency\n-2.5,.96\n-3,0.97",
        "D1.ratio,D1.efficiency\r\n-2.5,.96\r\n-3,0.97\r\n",
        "\ufeffD1.ratio,D1.efficiency\n-2.5,.96\n-3,0.97\n",
        "D1.ratio;D1.efficiency\n-2.5;.96\n-3;0.97\n",
        "D1.ratio;D1.efficiency\n-2,5;,96\n-3;0,97\n",
        " D1.ratio , #1.efficiency\n -2.5 , .96 \n -3 , 0.97\n",
        '"D1.ratio","D1.efficiency"\n"-2.5",".96"\n-3,"0.97"\n',
        "variant,D1.ratio,D1.efficiency\n0,-2.5,.96\n1,-3,0.97\n",
        "\tD1.ratio\tD1.efficiency\n0\t-2.5\t.96\n1\t-3\t0.97\n",  # pandas numbers the rows
        "D1.ratio,variant,D1.efficiency\n-2.5,first one,.96\n-3,,0.97\n",
        "D1.ratio,D1.efficiency\n\n-5/2,.96\n  \n-3,97/100\n\n",
        "D1.ratio,D1.efficiency\n-25E-1,96e-2\n-3,0.97\n",
        # github.com/astropy/astropy/issues/8674: numpy.savetxt puts `# ` before headings
        "# D1.ratio,D1.efficiency\n-2.5,.96\n-3,0.97\n",
        "Test 7\n% by hand\nD1.ratio,D1.efficiency\n# first\n-2.5,.96\n-3,0.97\n# last, not least\n",
    ):
        table = read(text)
        assert [target.name for target in table.targets] == ["D1.ratio", "D1.efficiency"]
        assert table.block(0, table.count).tolist() == [[-2.5, 0.96], [-3, 0.97]], text
    table = read('1.ratio,"D.2=x.ratio",D1.efficiency\n3,0,1\n')  # 0 is left to the result
    assert [one.owner for one in table.targets if isinstance(one, Target)] == [2, 1, 0]
    assert table.block(0, 1).tolist() == [[3, 0, 1]]


def test_what_is_wrong_is_reported_with_its_place() -> None:
    unknown = "D1.ratio: read `x`, expected a number or a calculation such as -96/39"
    for text, line, column, words in (
        ("", 1, 1, "read an empty line, expected names such as D1.ratio"),
        ("\n1\n", 2, 1, "expected a mechanism"),
        ("D1.ratio\n", 0, 0, "the table has no variant, expected a line of numbers"),
        ("D1.ratio\n\n \n", 0, 0, "the table has no variant"),
        ("D1.ratio\n-2\nnan\n", 3, 1, "D1.ratio: read `nan`, expected a finite number"),
        ("variant,D1.ratio\n0,-inf\n", 2, 3, "read `-inf`, expected a finite number"),
        ("variant\n1\n", 1, 1, "no column is a number of the case"),
        ("D1.ratio, D1.ratoi\n1,2\n", 1, 14, "read `ratoi`, expected `ratio` or `efficiency`; did"),
        ("D1.ratio,D4.ratio\n1,2\n", 1, 10, "there is no mechanism `D4`"),
        ("varaint,D1.ratio\n1,2\n", 1, 1, "did you mean `variant`?"),
        ("D1.ratio,\n1,2\n", 2, 3, "read 2 cells, expected 1, as the headings"),
        ("D1.ratio,,1.ratio\n1,,2\n", 1, 10, "read nothing, expected a mechanism"),
        ("D1.ratio,#1.ratio\n1,2\n", 1, 10, "D1.ratio already has a column"),
        ("D1.ratio,1.ratio\n1,2\n3, x\n", 3, 4, "1.ratio: read `x`, expected a number"),
        ("D1.ratio,1.ratio\n1,\n", 2, 3, "1.ratio: read nothing, expected a number"),
        ("D1.ratio,1.ratio\n1,2\n3\n", 3, 2, "read 1 cell, expected 2, as the headings"),
        ("D1.ratio,1.ratio\n1,2,3\n", 2, 5, "read 3 cells, expected 2, as the headings"),
        ("D1.ratio,1.ratio\n1,5,2,5\n", 2, 5, "semicolons have to separate the cells"),
        ("D1.ratio;1.ratio\n1;2;3\n", 2, 5, "read 3 cells"),
        ("D1.ratio\n1\n1_0\n", 3, 1, "read `1_0`"),
        ("D1.ratio\n1\n1d0\n", 3, 1, "read `1d0`"),
        ("D1.ratio\n1\n1e999\n", 3, 1, "expected a smaller number"),
        ("D1.ratio\n1\r2\n", 2, 1, "expected a number"),
        ("Test 7\nD1.ratoi,1.ratio\n1,2\n", 2, 4, "read `ratoi`"),
        ("D1.ratoi\n1/2\n", 1, 4, "read `ratoi`"),
        ("D1.ratio\n" + "".join(f"{n}\n\n" for n in range(500)) + "x\n", 1002, 1, unknown),
        ("D1.ratio\n-2\n".encode("utf-16"), 1, 1, "not UTF-8; save the table as CSV in UTF-8"),
        ("D1.ratio\n-2\n-3 é\n".encode("latin-1"), 3, 4, "the file is not UTF-8; save the table"),
        (b"PK\3\4\x14\0\6\0" + b"\xff" * 100, 1, 1, "read a zero byte, so this is not a text"),
    ):
        ((found_line, found_column, message),) = refusal(text)
        assert words in message, text
        assert (found_line, found_column) == (line, column), text


def test_all_that_is_wrong_is_reported_up_to_a_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    told = refusal("D1.ratio,1.ratio\nx,y\n1,2\n3\n")
    assert [place[:2] for place in told] == [(2, 1), (2, 3), (4, 2)]
    told = refusal("D9.ratio,D1.ratio,D8.ratio\n")
    assert [place[:2] for place in told] == [(1, 1), (1, 19)]
    assert len(refusal("D1.ratio\n" + "x\n" * 10_000)) == 100
    assert len(refusal("x," * 10_000 + "D1.ratio\n1\n")) == 100
    monkeypatch.setattr(tables, "_LONGEST", 1000)
    monkeypatch.setattr(tables, "_PIECE", 64)
    ((line, column, message),) = refusal("D1.ratio\n" + "1" * 5000)
    assert (line, column) == (2, 1)
    assert "longer than 1000 bytes" in message


@pytest.mark.parametrize("suffix", ["csv", "parquet", "xlsx", "npz", "jsonl"])
def test_what_a_sweep_wrote_are_the_variants_of_the_next(tmp_path: Path, suffix: str) -> None:
    file = str(tmp_path / f"own.{suffix}")
    case = CASES / "zf-8hp70.yaml"
    asked = ("--vary", "P1.teeth.sun=47,48", "--vary", "P1.efficiency=.9,1.5", "--out", "ratio[5]")
    command("sweep", case, *asked, "-o", file)
    table = load_table(file, vstatics.example("zf-8hp70"))
    assert [one.name for one in table.targets] == ["P1.teeth.sun", "P1.efficiency"]
    assert table.block(0, 4).tolist() == [[47, 0.9], [47, 1.5], [48, 0.9], [48, 1.5]]
    assert command("sweep", case, "--variants", file).status == 0
    command("sweep", case, *asked[:2], "--by", "gear", "-o", file)
    with pytest.raises(ReadError, match="repeats each variant"):
        load_table(file, vstatics.example("zf-8hp70"))


def test_rows_that_pandas_numbers_and_a_note(tmp_path: Path) -> None:
    frame = pd.DataFrame({"D1.ratio": [-2.5, -3.0]}, index=["a", "b"])
    frame.to_parquet(tmp_path / "own.parquet")
    frame.to_csv(tmp_path / "own.csv")
    frame.to_excel(tmp_path / "own.xlsx", index=False)
    frame.to_json(tmp_path / "own.json", orient="records")
    for suffix in ("parquet", "csv", "xlsx", "json"):
        read_back = load_table(str(tmp_path / f"own.{suffix}"), CASE)
        assert read_back.block(0, 2).tolist() == [[-2.5], [-3.0]], suffix
    frame.to_json(tmp_path / "own.json")  # by columns: posit-dev/chatlas/issues/180
    with pytest.raises(ReadError, match=r"`D1.ratio` has several values, expected one object per"):
        load_table(str(tmp_path / "own.json"), CASE)
    frame["note"] = ["first", "second"]
    frame.to_parquet(tmp_path / "own.parquet")
    with pytest.raises(ReadError, match=r"read `note`.*leave out columns that are not numbers of"):
        load_table(str(tmp_path / "own.parquet"), CASE)


FINITE = st.floats(allow_nan=False, allow_infinity=False)
NUMBERS = st.lists(st.tuples(FINITE, FINITE), min_size=1, max_size=40)


@given(NUMBERS, st.lists(st.integers(0, 40)), st.sampled_from(["\n", "\r\n"]))
def test_numbers_come_back_to_the_bit(
    numbers: list[tuple[float, float]], cuts: list[int], end: str
) -> None:
    lines = ["D1.ratio,1.ratio", *(f"{one!r},{two!r}" for one, two in numbers)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tables, "_IN_MEMORY", 8)
        patch.setattr(tables, "_PIECE", 100)
        with contextlib.closing(read(end.join(lines))) as table:
            assert in_parts(table, cuts).tolist() == [list(row) for row in numbers]


@settings(max_examples=count(48, 360))
@given(st.binary(max_size=60), st.binary(max_size=60))
def test_any_bytes_give_a_table_or_problems(head: bytes, rest: bytes) -> None:
    for data in (head + rest, b"D1.ratio,1.ratio\n" + rest, b"D1.ratio;1.ratio\n1;2\n" + rest):
        with contextlib.suppress(ReadError):
            assert read(data).count > 0


BIG = "variant,D1.ratio,1.ratio\n" + "".join(f"{n},{n}.5,-{n}\n" for n in range(200))
EXPECTED: Floats = np.array([[n + 0.5, -float(n)] for n in range(200)])


def test_a_large_table_lies_in_a_temporary_file(spooled: Path) -> None:
    with contextlib.closing(read(BIG, spooled)) as table:
        (file,) = spooled.iterdir()
        assert file.name.startswith(PREFIX)
        assert file.stat().st_size == EXPECTED.nbytes
        assert table.count == 200
        assert np.array_equal(table.block(0, 200), EXPECTED)
        block = table.block(150, 200)
        assert np.array_equal(block, EXPECTED[150:])
        assert block.flags.f_contiguous
        assert block.flags.writeable
    assert not list(spooled.iterdir())
    with pytest.raises(ReadError, match="temporary copy of the table cannot be read: No such file"):
        table.block(0, 1)
    table = read(BIG, spooled)
    assert len(list(spooled.iterdir())) == 1
    del table
    assert not list(spooled.iterdir())


def test_the_digest_is_that_of_the_numbers(spooled: Path) -> None:
    with contextlib.closing(read(BIG, spooled)) as large:
        assert large.digest == VariantTable(large.targets, EXPECTED).digest
        assert large.digest == read(BIG.replace(".5,", ".50,")).digest
        assert large.digest != read(BIG.replace(".5,", ".6,")).digest


def test_copies_read_the_same_file_and_leave_it(spooled: Path) -> None:
    with contextlib.closing(read(BIG, spooled)) as table:
        pickled = pickle.dumps(table)
        assert len(pickled) < 1000
        copy = pickle.loads(pickled)  # noqa: S301
        assert np.array_equal(copy.block(7, 9), EXPECTED[7:9])
        copy.close()
        del copy
        assert len(list(spooled.iterdir())) == 1
        part = pickle.loads(pickle.dumps(VariantPart(table, 100, 110)))  # noqa: S301
    assert np.array_equal(part.block(102, 104), EXPECTED[102:104])


def test_the_file_goes_with_the_process(tmp_path: Path) -> None:
    program = (
        "import numpy; from vstatics.core.jobs.spool import Spool\n"
        "spool = Spool(1); spool.write(numpy.ones((5, 1)))\n"
        "print(spool.take(4, 5))"
    )
    own = {"PYTHONPATH": os.pathsep.join(sys.path), "TMPDIR": str(tmp_path)}
    said = subprocess.check_output([sys.executable, "-c", program], env={**os.environ, **own})
    assert said == b"[[1.]]\n"
    assert not list(tmp_path.iterdir())


def test_a_file_that_was_cut_off_is_noticed(spooled: Path) -> None:
    with contextlib.closing(read(BIG, spooled)) as table:
        (file,) = spooled.iterdir()
        os.truncate(file, EXPECTED.nbytes - 8)
        assert np.array_equal(table.block(0, 199), EXPECTED[:199])
        with pytest.raises(ReadError, match="it is cut off; start the sweep again"):
            table.block(0, 200)


def test_tables_that_are_refused_leave_no_file(spooled: Path) -> None:
    with pytest.raises(ReadError, match=r"own\.csv:202:3: error: D1\.ratio: read `x`"):
        read(BIG + "0,x,1\n", spooled)
    assert not list(spooled.iterdir())
    cannot = r"temporary files: error: the temporary copy of the table cannot be written: No such"
    with pytest.raises(ReadError, match=rf"{cannot}.*set TMPDIR to another folder"):
        read(BIG, spooled / "nowhere")
    with pytest.raises(ReadError) as caught:
        load_table(str(spooled / "other.csv"), CASE)
    (problem,) = caught.value.problems
    assert problem.message == "cannot be read: No such file or directory"
    assert problem.place == Place(str(spooled / "other.csv"), 0, 0)


def test_a_full_disk_leaves_no_file(spooled: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(tempfile, "tempdir", str(spooled))
    spool = Spool(2)
    monkeypatch.setattr(os, "write", full)
    with pytest.raises(ReadError, match="cannot be written: No space left on device; make room"):
        spool.write(EXPECTED)
    assert not list(spooled.iterdir())
