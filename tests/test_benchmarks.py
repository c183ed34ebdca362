"""The benchmarks run, and the compiled peer calculates what the program does.

The peer is benchmarks/peer.c: dense elimination and perturbed solutions, which share nothing with
the program. No times are tested.
"""

import os
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.chance import some
from tests.commands import CASES, ROOT
from tests.installed import ANNEXES, missing
from tests.shipped import shipped_results
from vstatics import load, solve

if missing(ANNEXES):
    pytest.skip("benchmarks need all annexes", allow_module_level=True)

from benchmarks.__main__ import PLACE, table, with_table
from benchmarks.measuring import Race, Row, Setting, heading
from benchmarks.peer import Peer, compiled
from benchmarks.rows import ROWS

COMPILER = shutil.which(os.environ.get("CC", "cc"))
SIMPLE = ["differential.yaml", "mzkt7922.dat", "simpson.yaml", "two-stage.yaml", "zf-8hp70.yaml"]
"""Cases that the peer can read: one input and one output, no speeds given."""
SHORT = [row for row in ROWS if not row.is_long]
compiling = pytest.mark.skipif(COMPILER is None, reason="there is no C compiler")


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip("|").split("|")]


def test_the_page_has_the_rows_of_the_benchmarks() -> None:
    found = PLACE.search((ROOT / "docs" / "performance.md").read_text("utf-8"))
    assert found
    lines = [line for line in found[0].splitlines() if line.startswith("|")]
    assert "\n".join(lines[:2]) == heading()
    shown = [(cells(line)[0], cells(line)[2]) for line in lines[2:]]
    assert shown == [(row.calculation, row.peer) for row in ROWS]


def test_a_table_has_medians_of_alternating_runs_and_takes_its_place(tmp_path: Path) -> None:
    calls: list[str] = []

    def timed(name: str, times: list[float]) -> float:
        calls.append(name)
        return times[calls.count(name) % len(times)]

    def race(_setting: Setting) -> Race:
        return Race(lambda: timed("own", [2.0, 4.0, 9.0]), lambda: timed("peer", [12.0, 0.1, 70.0]))

    rows = [Row("own", "other", race), Row("own", "slow", race, is_long=True)]
    text = table(rows, Setting(tmp_path, tmp_path), with_long=False)
    lines = ["| own | 4 s | other | 12 s | 3 |", "| own |  | slow |  |  |"]
    assert text.splitlines()[2:] == lines
    assert calls == ["own", "peer"] * (len(calls) // 2)
    page = "before\n<!-- bench -->\nold\n<!-- end of bench -->\nafter\n"
    assert with_table(page, r"\1 new") == page.replace("old", "\n\\1 new\n")


@pytest.fixture(scope="module")
def peer(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The compiled peer."""
    return compiled(tmp_path_factory.mktemp("peer"))


@compiling
@pytest.mark.slow
@pytest.mark.parametrize("row", some(SHORT), ids=lambda row: row.calculation)
def test_each_row_has_a_ratio(peer: Path, row: Row, tmp_path: Path) -> None:
    line = row.measured(Setting(tmp_path, peer, is_trial=True))
    assert all(cells(line))
    assert float(cells(line)[-1].replace(",", "")) > 0


def tables(peer: Path, name: str, folder: Path) -> dict[str, np.ndarray[Any, Any]]:
    """The peer's tables of a case, (rows, gears)."""
    rows: dict[str, list[list[float]]] = {}
    for line in Peer(Setting(folder, peer), load(CASES / name)).printed(0).splitlines():
        if line[0].isalpha():
            rows[line] = []
        else:
            rows[list(rows)[-1]].append([float(word) for word in line.split()])
    return {name: np.array(table) for name, table in rows.items()}


@compiling
@pytest.mark.slow
@pytest.mark.parametrize("name", SIMPLE)
def test_peer_and_program_agree(peer: Path, tmp_path: Path, name: str) -> None:
    """Signs only where power flows; elsewhere those of the peer are rounding noise."""
    own, found = shipped_results(name), tables(peer, name, tmp_path)
    states = [own.gear(number) for number in range(1, len(own.case.gears) + 1)]
    torques = np.array([state.torques.on_first_link for state in states])
    busy = ~own.idle
    assert busy.any()
    assert (own.power_sign == found["IX"].T)[busy].all()
    assert own.efficiency == pytest.approx(found["ETA"][0], rel=1e-9)
    for ours, theirs in (
        (own.speeds, found["W"]),
        (own.slip_speeds, found["WFRI"]),
        (torques, found["AMLG"]),
        (own.lossy_torques[..., -1], found["AMLGP"][-1]),
    ):
        np.testing.assert_allclose(ours.T, theirs, rtol=1e-9, atol=1e-9)


@compiling
@pytest.mark.slow
def test_planet_speeds_agree_on_the_mzkt_deck(peer: Path, tmp_path: Path) -> None:
    found = tables(peer, "mzkt7922.dat", tmp_path)["WSAT"]
    own = solve(load(CASES / "mzkt7922.dat")).planet_speeds
    np.testing.assert_allclose(own.T, found, rtol=1e-9, atol=1e-9)
