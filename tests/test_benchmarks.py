"""The benchmarks run, and the compiled peer calculates what the program does.

The peer stands in benchmarks/peer.c: dense elimination and perturbed solutions, which
share nothing with the program. No times are tested.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import vstatics
from tests.chance import some
from tests.commands import CASES
from tests.installed import skip_without, used_in
from tests.shipped import shipped_results
from vstatics import load, solve

BENCHMARKS = Path(__file__).parent.parent / "benchmarks"
COMPILER = shutil.which(os.environ.get("CC", "cc"))
NAMES = sorted(path.stem for path in BENCHMARKS.glob("*.py"))
SCRIPTS = [name for name in NAMES if name not in ("__main__", "common", "numeric", "smoothed")]
SIMPLE = ["differential.yaml", "mzkt7922.dat", "simpson.yaml", "two-stage.yaml", "zf-8hp70.yaml"]
"""Cases that the peer can read: one input and one output, no speeds given."""

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(COMPILER is None, reason="there is no C compiler"),
]


def run(*command: str, folder: Path) -> str:
    """What a command prints, in a folder without the package but with it on the path."""
    path = os.pathsep.join([str(Path(vstatics.__file__).parent.parent), *sys.path[1:]])
    said = subprocess.run(
        command,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        check=False,
    )
    assert said.returncode == 0, said.stderr
    return said.stdout


@pytest.fixture(scope="module")
def peer(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The compiled peer."""
    folder = tmp_path_factory.mktemp("peer")
    program = folder / "peer"
    source = str(BENCHMARKS / "peer.c")
    run(str(COMPILER), "-O2", "-Wall", "-o", str(program), source, "-lm", folder=folder)
    return program


def tables(peer: Path, path: Path, folder: Path) -> dict[str, np.ndarray[Any, Any]]:
    """The peer's tables of a case, (rows, gears)."""
    numeric = str(BENCHMARKS / "numeric.py")
    text = folder / "case.num"
    text.write_text(run(sys.executable, numeric, str(path), folder=folder), encoding="ascii")
    rows: dict[str, list[list[float]]] = {}
    for line in run(str(peer), str(text), "0", folder=folder).splitlines():
        if line[0].isalpha():
            rows[line] = []
        else:
            rows[list(rows)[-1]].append([float(word) for word in line.split()])
    return {name: np.array(table) for name, table in rows.items()}


@pytest.mark.parametrize("name", some(SCRIPTS))
def test_each_prints_a_table(name: str, tmp_path: Path) -> None:
    skip_without(*used_in((BENCHMARKS / f"{name}.py").read_text(encoding="utf-8")))
    said = run(sys.executable, str(BENCHMARKS / f"{name}.py"), "--quick", folder=tmp_path)
    assert said.count("\n| ---") == 1
    assert said.count("\n| ") > 3


def test_several_run_together_and_take_their_places(tmp_path: Path) -> None:
    document = tmp_path / "performance.md"
    places = [
        f"<!-- bench: {name} -->\nold\n<!-- end of bench -->" for name in ("startup", "sizes")
    ]
    document.write_text("before\n" + "\nbetween\n".join(places) + "\nafter\n", encoding="utf-8")
    names = ["variants", "startup"]
    command = [sys.executable, str(BENCHMARKS), "--quick", "--into", str(document), *names]
    said = run(*command, folder=tmp_path)
    assert said.count("\n| ---") == 2
    written = document.read_text(encoding="utf-8")
    table = written[len("before\n<!-- bench: startup -->\n\n") : written.index("\n\n<!-- end")]
    assert table in said
    assert written.endswith(f"between\n{places[1]}\nafter\n")


@pytest.mark.parametrize("name", SIMPLE)
def test_peer_and_program_agree(peer: Path, tmp_path: Path, name: str) -> None:
    """Signs only where power flows; elsewhere those of the peer are rounding noise."""
    own, found = shipped_results(name), tables(peer, CASES / name, tmp_path)
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


def test_planet_speeds_agree_on_the_mzkt_deck(peer: Path, tmp_path: Path) -> None:
    path = CASES / "mzkt7922.dat"
    found = tables(peer, path, tmp_path)["WSAT"]
    np.testing.assert_allclose(solve(load(path)).planet_speeds.T, found, rtol=1e-9, atol=1e-9)
