"""Damaged and foreign results: an answer or a message that names the file, never a fault."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa  # type: ignore[import-untyped]
import pyarrow.parquet as pq  # type: ignore[import-untyped]
import pytest

from tests.chance import FRESH, count, seeded
from tests.commands import CASES, vstatics
from tests.mutated_results import tried

CASE = CASES / "simpson.yaml"


@pytest.mark.parametrize("part", [0, pytest.param(1, marks=pytest.mark.slow)])
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
        Path("own.csv").write_text("\n".join(csv), encoding="utf-8")
        jsonl = [json.dumps(dict(zip(table, row, strict=True))) for row in lines]
        Path("own.jsonl").write_text("\n".join(jsonl), encoding="utf-8")
        pq.write_table(pa.table(table), folder / "own.parquet")
        np.savez(folder / "own.npz", **{name: np.array(column) for name, column in table.items()})
        first, *others = (
            vstatics("sweep", CASE, "--variants", f"own.{suffix}", "--out", "ratio", "-q")
            for suffix in ("csv", "npz", "jsonl", "parquet")
        )
        assert first.status == 0, first.err
        assert [one.out for one in others] == [first.out] * 3, number


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('{"P1.ratio": -2}\n{"P1.ratio": -2, "P1.ratio": -3}', ":2:1: error: not a table of variants: `P1.ratio` is given twice"),
        ('{"P1.ratio": -2}\n\n{"variant": 3}', ":3:1: error: not a table of variants: the key `P1.ratio` is missing"),
        ('{"P1.ratio": -2}\n{"P1.ratio": -2, "x": 1}', ":2:1: error: not a table of variants: the key `x` is not in the first line"),
        ('{"P1.ratio": -2}\n' + '{"P1.ratio": ' + "[" * 100_000, ":2:1: error: not a table of variants: nested too deeply"),
        ("[" * 100_000, ":1:1: error: "),
        ('{"P1.ratio": -2}\n[1]', ":2:1: error: not a table of variants: read no JSON object"),
        ('{"P1.ratio": [1]}', "P1.ratio: read"),
        ('{"P1.ratio": 1e999}', "P1.ratio: read"),
    ],
)  # fmt: skip
def test_json_lines_are_told_by_line_and_key(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "v.jsonl").write_text(text, encoding="utf-8")
    begin = time.process_time()
    told = vstatics("sweep", CASE, "--variants", tmp_path / "v.jsonl", "--out", "ratio")
    assert time.process_time() - begin < 5
    assert told.status == 1
    assert f"v.jsonl{said}" in told.err or (said.startswith("P1") and said in told.err)


def test_results_and_boxes_nested_too_deeply_are_reported_so(tmp_path: Path) -> None:
    file = tmp_path / "deep.json"
    file.write_text('{"searched": 1, "boxes": ' + "[" * 100_000, encoding="utf-8")
    compared = vstatics("compare", file, file)
    assert compared.fails(
        "deep.json: error: the file is not JSON that can be read: nested too deeply"
    )
    drawn = vstatics("plot", "-k", "boxes", file, "-o", tmp_path / "a.svg")
    assert drawn.fails("deep.json: error: the JSON cannot be read: nested too deeply")


@pytest.mark.parametrize(
    ("arrays", "said"),
    [
        ({"P1.ratio": [-2.0, -3.0], "P2.ratio": [-2.0]}, "`P2.ratio` has 1 numbers, expected 2"),
        ({"P1.ratio": [[-2.0, -3.0]]}, "`P1.ratio` is not a row of numbers"),
        ({"P1.ratio": np.array(-2.0)}, "`P1.ratio` is not a row of numbers"),
        ({"P1.ratio": np.array([1j])}, "`P1.ratio` is not a row of numbers"),
        ({"status": [3], "statuses": ["ok"], "P1.ratio": [-2.0]}, "`status` has other numbers"),
    ],
)  # fmt: skip
def test_arrays_that_are_no_table_are_told(
    tmp_path: Path, arrays: dict[str, Any], said: str
) -> None:
    file = tmp_path / "own.npz"
    np.savez(file, **arrays)
    for words in (
        ("sweep", CASE, "--variants", file, "--out", "ratio"),
        ("compare", file, file),
        ("plot", "-k", "map", file, "-o", tmp_path / "a.svg"),
    ):
        told = vstatics(*words)
        assert told.fails(said, "own.npz")


def test_tables_are_refused_by_the_size_that_they_declare(tmp_path: Path) -> None:
    large = tmp_path / "large.npz"
    arrays: Any = {"P1.ratio": np.zeros(30_000_000)}
    np.savez_compressed(large, **arrays)
    lying = tmp_path / "lying.npz"
    np.savez(lying, **{"P1.ratio": np.zeros(10)})
    lying.write_bytes(lying.read_bytes().replace(b"(10,)", b"(99,)"))
    packed = tmp_path / "packed.parquet"
    pq.write_table(pa.table({"P1.ratio": pa.array(np.zeros(30_000_000))}), packed)
    for file, said in ((large, "30,000,000 cells"), (lying, "lying.npz"), (packed, "30,000,000")):
        begin = time.process_time()
        told = vstatics("sweep", CASE, "--variants", file, "--out", "ratio", "--dry-run")
        assert time.process_time() - begin < 5
        assert told.fails(said)


def test_a_sweep_without_status_is_told(tmp_path: Path) -> None:
    pq.write_table(pa.table({"variant": [0, 1], "P1.ratio": [-2.0, -3.0]}), tmp_path / "a.parquet")
    told = vstatics("compare", tmp_path / "a.parquet", tmp_path / "a.parquet")
    assert told.fails("the column `status` is missing")


@pytest.mark.parametrize("size", [1e200, 1e299, 1e308])
def test_a_histogram_of_large_numbers_has_no_warning(tmp_path: Path, size: float) -> None:
    numbers = {"variant": [0, 1], "P1.ratio": [1.0, 2.0], "status": ["ok"] * 2, "x": [size, -size]}
    pq.write_table(pa.table(numbers), tmp_path / "a.parquet")
    for kind in ("histogram", "curves"):
        told = vstatics("plot", "-k", kind, tmp_path / "a.parquet", "-o", tmp_path / "a.svg")
        assert "Warning" not in told.err
        assert (told.status == 0) == (size < 1e300), told.err
