"""A row for each gear of a variant, and columns with names of their own."""

import math
from pathlib import Path

import numpy as np
import pytest

import vstatics
from tests.chance import seeded
from tests.commands import vstatics as run
from tests.sweep.sweeps import small_pieces
from vstatics import Gear, Mechanism, ReadError, ShiftElement, Transmission, solve
from vstatics.core.readers import sweep_tables
from vstatics.core.summary.design_table import design
from vstatics.sweep.chunk import STATUS, Chunk
from vstatics.sweep.gear_steps import spread, steps

BOX = Transmission(
    3,
    [ShiftElement(2, 0, "B"), ShiftElement(1, 2, "C")],
    [Mechanism(1, 2, 3, -2.5, 0.96, name="set")],
    [Gear([1], name="low, 1"), Gear([2], name="high"), Gear([], name="idle")],
)
RATIOS = [-2.0, -3.0]


def swept(**asked: object) -> Chunk:
    [chunk] = vstatics.sweep(BOX, {"set.ratio": RATIOS}, **asked)  # type: ignore[arg-type]
    return chunk


@pytest.fixture
def file(tmp_path: Path) -> Path:
    vstatics.save(BOX, str(tmp_path / "box.yaml"))
    return tmp_path / "box.yaml"


def test_a_row_is_of_a_gear() -> None:
    """Ratio 1 - u with the ring held, 1 in the direct gear, none where nothing is engaged."""
    chunk = swept(out="ratio, eta=efficiency, step, spread", by="gear")
    assert chunk.headings == ("ratio", "eta", "step", "spread")
    assert chunk.variants.tolist() == [0, 0, 0, 1, 1, 1]
    assert [chunk.gears[n] for n in chunk.of_gear] == ["low, 1", "high", "idle"] * 2
    nan = math.nan
    low = [(1 - u, (1 - 0.96 * u) / (1 - u)) for u in RATIOS]
    rows = [[[r, e, r, r], [1, 1, nan, r], [nan, nan, nan, r]] for r, e in low]
    np.testing.assert_allclose(chunk.columns, np.concatenate(rows), rtol=1e-14)
    assert [STATUS[code] for code in chunk.status[:3]] == ["ok"] * 3


def test_conditions_and_the_best_are_of_gears() -> None:
    chunk = swept(out="r=ratio", where="r > 1 and r < 3.5", by="gear")
    assert chunk.columns.tolist() == [[3.0]]
    assert chunk.removed == (4, 1)
    chunk = swept(out="r=ratio[#1], k=sqrt(r)*pi, ratio", where="k > 6")  # of a ratio 4: 2 pi
    assert chunk.headings[:2] == ("r", "k")
    np.testing.assert_allclose(chunk.columns[:, 1], [2 * math.pi])


@pytest.mark.parametrize("suffix", ["csv", "jsonl", "npz", "parquet"])
def test_every_format_has_the_gear(file: Path, suffix: str) -> None:
    out = file.with_suffix(f".{suffix}")
    asked = "--vary", "set.ratio=-2,-3", "--by", "gear", "--out", "ratio,k=2*ratio", "-o", out
    assert run("sweep", file, *asked).status == 0
    read = sweep_tables.read(out.read_bytes(), out.name)
    assert read.gears == ["low, 1", "high", "idle"] * 2
    np.testing.assert_allclose(read.columns["k"], [6, 2, math.nan, 8, 2, math.nan])
    assert run("sweep", file, *asked, "--max", "ratio", "--best", "2").status == 0
    read = sweep_tables.read(out.read_bytes(), out.name)
    assert (read.variants, read.gears) == ([1, 0], ["low, 1"] * 2)


def test_the_last_line_counts_the_gears_of_each_variant(file: Path) -> None:
    asked = "--vary", "set.ratio=-2,-3", "--by", "gear", "--out", "ratio"
    said = run("sweep", file, *asked).err
    assert "<stdout>: 6 rows of 6 gears, 3 in each variant" in said
    assert said.endswith(" gears a second\n")
    table = file.with_suffix(".md")
    assert run("sweep", file, *asked, "-o", table).status == 0
    first = table.read_text("utf-8").split("\n|")[3]
    assert [cell.strip() for cell in first.split("|")] == ["0", "-2", "ok", "low, 1", "3", ""]


def test_many_jobs_and_several_pieces_give_the_same_rows(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    small_pieces(monkeypatch)
    vary = "--vary", "set.ratio=-4:-2:20", "--by", "gear", "--out", "ratio"
    for more, rows in ((), 61), (("--max", "ratio", "--min", "set.ratio**2", "--best", "7"), 8):
        texts = [run("sweep", file, *vary, *more, "-j", jobs).out for jobs in (1, 2)]
        assert texts[0] == texts[1]
        assert texts[0].count("\n") == rows


def test_what_is_wrong_is_reported() -> None:
    for out, said in {
        "ratio[1]": "each row has a single gear, expected ratio",
        "k=1, k=2": "two columns are called `k`",
        "ratio=1": "`ratio` already has a meaning",
        "pi[1]": "`pi` is a number",
        "sqrt(1, 2)": "sqrt of 2 values, expected one",
    }.items():
        with pytest.raises(ReadError, match=said):
            swept(out=out, by="gear")


def test_steps_and_spread_stand_in_columns() -> None:
    chunk = swept(out="step, spread")
    assert chunk.headings == ('step["low, 1"]', "step[high]", "step[idle]", "spread")
    np.testing.assert_allclose(chunk.columns[:, [0, 3]], [[3, 3], [4, 4]])


def test_random_ratios_have_the_steps_of_their_design_table() -> None:
    """The summary sorts the gears of one case; here they are compared in pairs."""
    random = seeded(27)
    pairs = [Mechanism(1, 2, 0, -2.0), Mechanism(1, 3, 0, 2.0)]
    for _ in range(60):
        kinds = [random.choice(["gear", "gear", "gear", "point"]) for _ in range(6)]
        ends = [random.choice([None, None, None, 3]) for _ in range(6)]
        gears = [
            Gear(kind=kind, output=end, name=f"g{n}")  # type: ignore[arg-type]
            for n, (kind, end) in enumerate(zip(kinds, ends, strict=True))
        ]
        results = solve(Transmission(3, [], pairs, gears))
        ratios = np.array([random.choice([4.0, -3.0, 2.5, 1.0, -1.0, np.nan]) for _ in gears])
        made = design(results._replace(ratio=ratios))
        expected = [[abs(gear.step) for gear in made.gears]]
        np.testing.assert_allclose(steps(results.case, ratios[None]), expected)
        np.testing.assert_allclose(spread(results.case, ratios[None]), [made.spread])
