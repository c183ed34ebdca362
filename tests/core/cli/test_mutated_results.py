"""Damaged and foreign results: an answer or a message that names the file, never a fault."""

import json
import time
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa  # type: ignore[import-untyped]
import pyarrow.parquet as pq  # type: ignore[import-untyped]
import pytest

from tests.chance import FRESH, count, seeded, with_slow
from tests.commands import CASES, vstatics
from tests.mutated_results import tried

CASE = CASES / "simpson.yaml"


@pytest.mark.parametrize("part", with_slow([0], [1]))
def test_mutated_results_end_in_an_answer_or_in_words(part: int) -> None:
    first = int(FRESH or 0) + 100_000 * part
    for number in range(first, first + (count(2000, 20_000) if part else 60)):
        _, fault = tried(number)
        assert not fault


def test_an_npz_of_ones_own_is_a_table_of_variants_as_the_same_csv(folder: Path) -> None:
    rng = seeded(10)
    for number in range(count(4, 40)):
        names = rng.sample(["P1.ratio", "P2.ratio", "P1.efficiency", "variant"], rng.randint(1, 4))
        names = names if {*names} - {"variant"} else ["P1.ratio"]
        rows = range(rng.randint(1, 7))
        table: dict[str, list[float]] = {
            name: [rng.uniform(0.9, 0.99) if "eff" in name else -rng.uniform(2, 4) for _ in rows]
            for name in names
        }
        table |= {"variant": [*map(float, rows)]} if "variant" in names else {}
        lines = [*zip(*table.values(), strict=True)]
        csv = [",".join(table), *(",".join(map(repr, row)) for row in lines)]
        Path("own.csv").write_text("\n".join(csv), "utf-8")
        jsonl = [json.dumps(dict(zip(table, row, strict=True))) for row in lines]
        Path("own.jsonl").write_text("\n".join(jsonl), "utf-8")
        pq.write_table(pa.table(table), folder / "own.parquet")
        arrays: Any = {name: np.array(column) for name, column in table.items()}
        np.savez(folder / "own.npz", **arrays)
        first, *others = (
            vstatics("sweep", CASE, "--variants", f"own.{suffix}", "--out", "ratio", "-q")
            for suffix in ("csv", "npz", "jsonl", "parquet")
        )
        assert first.status == 0, first.err
        assert [one.out for one in others] == [first.out] * 3, number


NO_TABLE = ":{}:1: error: not a table of variants: {}".format
FIRST = '{"P1.ratio": -2}\n'
JSON_LINES = {
    f'{FIRST}{{"P1.ratio": -2, "P1.ratio": -3}}': NO_TABLE(2, "`P1.ratio` is given twice"),
    f'{FIRST}\n{{"variant": 3}}': NO_TABLE(3, "the key `P1.ratio` is missing"),
    f'{FIRST}{{"P1.ratio": -2, "x": 1}}': NO_TABLE(2, "the key `x` is not in the first line"),
    f'{FIRST}{{"P1.ratio": {"[" * 100_000}': NO_TABLE(2, "nested too deeply"),
    "[" * 100_000: ":1:1: error: ",
    f"{FIRST}[1]": NO_TABLE(2, "read no JSON object"),
    '{"P1.ratio": 1e999}': "P1.ratio: read",
}
ARRAYS: tuple[tuple[str, dict[str, Any]], ...] = (
    ("`P2.ratio` has 1 numbers, expected 2", {"P1.ratio": [-2.0, -3.0], "P2.ratio": [-2.0]}),
    ("`P1.ratio` is not a row of numbers", {"P1.ratio": [[-2.0, -3.0]]}),
    ("`P1.ratio` is not a row of numbers", {"P1.ratio": np.array(-2.0)}),
    ("`P1.ratio` is not a row of numbers", {"P1.ratio": np.array([1j])}),
    ("`status` has other numbers", {"status": [3], "statuses": ["ok"], "P1.ratio": [-2.0]}),
)


def test_json_lines_are_named_by_line_and_key(folder: Path) -> None:
    for text, words in JSON_LINES.items():
        (folder / "v.jsonl").write_text(text, "utf-8")
        begin = time.process_time()
        told = vstatics("sweep", CASE, "--variants", "v.jsonl", "--out", "ratio")
        assert time.process_time() - begin < 5
        assert told.fails(words if words[0] == "P" else f"v.jsonl{words}"), text[:80]


def test_arrays_and_columns_that_are_no_table_are_reported(folder: Path) -> None:
    for words, arrays in ARRAYS:
        np.savez(folder / "own.npz", **arrays)
        for line in (
            f"sweep {CASE} --variants own.npz --out ratio",
            "compare own.npz own.npz",
            "plot -k map own.npz -o a.svg",
        ):
            assert vstatics(*line.split()).fails(words, "own.npz"), line
    pq.write_table(pa.table({"variant": [0, 1], "P1.ratio": [-2.0, -3.0]}), "a.parquet")
    assert vstatics("compare", "a.parquet", "a.parquet").fails("the column `status` is missing")


def test_tables_are_refused_by_the_size_that_they_declare(tmp_path: Path) -> None:
    large = tmp_path / "large.npz"
    arrays: Any = {"P1.ratio": np.zeros(30_000_000, np.int8)}
    np.savez_compressed(large, **arrays)
    lying = tmp_path / "lying.npz"
    short: Any = {"P1.ratio": np.zeros(10)}
    np.savez(lying, **short)
    lying.write_bytes(lying.read_bytes().replace(b"(10,)", b"(99,)"))
    packed = tmp_path / "packed.parquet"
    pq.write_table(pa.table({"P1.ratio": pa.array(np.zeros(30_000_000, np.int8))}), packed)
    for file, said in ((large, "30,000,000 cells"), (lying, "lying.npz"), (packed, "30,000,000")):
        begin = time.process_time()
        told = vstatics("sweep", CASE, "--variants", file, "--out", "ratio", "--dry-run")
        assert time.process_time() - begin < 5
        assert told.fails(said)


@pytest.mark.parametrize("size", [1e200, 1e299, 1e308])
def test_a_histogram_of_large_numbers_has_no_warning(tmp_path: Path, size: float) -> None:
    numbers = {"variant": [0, 1], "P1.ratio": [1.0, 2.0], "status": ["ok"] * 2, "x": [size, -size]}
    pq.write_table(pa.table(numbers), tmp_path / "a.parquet")
    for kind in ("histogram", "curves"):
        told = vstatics("plot", "-k", kind, tmp_path / "a.parquet", "-o", tmp_path / "a.svg")
        assert "Warning" not in told.err
        assert (told.status == 0) == (size < 1e300), told.err
