"""Natural frequencies: of one case, of a long chain, and of 100,000 variants to NPZ.

The sweeps vary one stiffness of a chain of three masses, and of ten. Beside them, in the same
process on one core, stands a loop that assembles the stiffness matrix of each variant from its
springs and calls `scipy.linalg.eigh`, which keeps the same frequency in an array. A sweep reads
its options and the case and leaves the file, as `vstatics sweep` does; imports are done before.
Both have the same numbers to 1e-9.
"""

import os
import statistics
import sys
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from common import medians, options, print_table, timed
from scipy import linalg

from vstatics import Transmission, loads
from vstatics.core.cli import main as command
from vstatics.torsion.vibration.gear_modes import modes

VARIANTS = 100_000
CHAIN, LOWEST = 2_000, 20
CALLS = 50
"""Of all modes of one gear in a turn."""
ROUNDS = 5
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}


def chain(masses: int) -> str:
    """A case in YAML: masses in a row, all different, a shaft between each two."""
    names = [f"m{number}" for number in range(masses)]
    inertias = [f"  {name}: {0.1 + 0.3 * (number % 7)}" for number, name in enumerate(names)]
    springs = [
        f"  s{number}: {{links: [m{number}, m{number + 1}], stiffness: {1000 * (1 + number % 5)}}}"
        for number in range(masses - 1)
    ]
    rows = [f"links: [{', '.join(names)}]", "inertias:", *inertias, "springs:", *springs]
    return "\n".join(rows) + "\n"


def loop(case: Transmission, values: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """The lowest frequency but the rigid one for each stiffness of the shaft `s1`."""
    rows = np.zeros((len(case.springs), case.links))
    for row, spring in zip(rows, case.springs, strict=True):
        for link, part in spring.form.items():
            row[link - 1] = part
    stiffnesses = np.array([spring.rate for spring in case.springs])
    mass = np.diag([case.inertias[link] for link in range(1, case.links + 1)])
    found = np.empty(len(values))
    for variant, value in enumerate(values):
        stiffnesses[1] = value
        stiffness = (rows.T * stiffnesses) @ rows
        found[variant] = linalg.eigh(stiffness, mass, eigvals_only=True)[1]
    return np.sqrt(found)


def sweep(folder: Path, masses: int, variants: int) -> np.ndarray[Any, Any]:
    """The same by the program, as it is called on a command line."""
    output = folder / "out.npz"
    output.unlink(missing_ok=True)
    vary = f"--vary=s1.stiffness=500:50000:{variants}"
    case = str(folder / f"{masses}.yaml")
    command(["sweep", case, vary, "--out=omega[1,1]", f"-o{output}", "-q"], standalone_mode=False)
    with np.load(output) as made:
        found: np.ndarray[Any, Any] = made["omega[1,1]"]
    return found


def sweeps(folder: Path, variants: int, rounds: int) -> list[tuple[object, ...]]:
    """Rows of the table: loop and sweep for three masses and for ten."""
    rows: list[tuple[object, ...]] = []
    values = np.linspace(500, 50000, variants)
    for masses, words in ((3, "three masses"), (10, "ten masses")):
        text = chain(masses)
        (folder / f"{masses}.yaml").write_text(text, encoding="utf-8")
        case = loads(text)
        if not np.allclose(loop(case, values), sweep(folder, masses, variants), rtol=1e-9, atol=0):
            sys.exit(f"{words}: the loop has other frequencies")
        actions: dict[str, Callable[[], float]] = {
            "loop": partial(timed, partial(loop, case, values)),
            "sweep": partial(timed, partial(sweep, folder, masses, variants)),
        }
        found = medians(actions, rounds)
        times = f"{found['loop'] / found['sweep']:.0f}"
        name = f"{variants:,} stiffnesses, {words}"
        rows += [
            (f"{name}: loop over `scipy.linalg.eigh`", f"{found['loop']:.2f} s", 1),
            (f"{name}: `vstatics sweep` to NPZ", f"{found['sweep']:.3f} s", times),
        ]
    return rows


def one_case(masses: int, calls: int, rounds: int, **asked: Any) -> float:
    """Median time of the modes of a chain that was read before [s]."""
    case = loads(chain(masses))
    modes(case, [1], **asked)

    def several() -> None:
        for _ in range(calls):
            modes(case, [1], **asked)

    return statistics.median(timed(several) / calls for _ in range(rounds))


def main() -> None:
    """Measure and print."""
    given = options(__doc__, peer=False)
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    rounds = 1 if given.quick else ROUNDS
    of_ten = one_case(10, CALLS, rounds)
    of_chain = one_case(CHAIN // (10 if given.quick else 1), 1, rounds, count=LOWEST)
    with tempfile.TemporaryDirectory() as folder:
        rows = sweeps(Path(folder), VARIANTS // (100 if given.quick else 1), rounds)
    alone: list[tuple[object, ...]] = [
        ("all modes of one gear, ten masses", f"{1e3 * of_ten:.2f} ms", ""),
        (f"{LOWEST} modes of a chain of {CHAIN:,} masses", f"{of_chain:.2f} s", ""),
    ]
    print_table("Natural frequencies, one core", ("", "time", "times the loop"), [*alone, *rows])


if __name__ == "__main__":
    if any(os.environ.get(name) != value for name, value in ONE_THREAD.items()):
        os.execve(sys.executable, [sys.executable, *sys.argv], {**os.environ, **ONE_THREAD})  # noqa: S606
    main()
