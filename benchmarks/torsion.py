"""Benchmarks of natural frequencies, against `scipy.linalg.eigh`."""

from __future__ import annotations

from functools import partial
from itertools import product

import numpy as np
from scipy import linalg

from benchmarks.measuring import Race, Setting, timer
from vstatics import Transmission, loads
from vstatics.core.cli import main
from vstatics.core.numerics.arrays import Floats
from vstatics.torsion.vibration.gear_modes import modes

CALLS = 20


def chain(masses: int) -> str:
    """Return a case in YAML: different masses in a row, a shaft between each two."""
    names = [f"m{number}" for number in range(masses)]
    inertias = [f"  {name}: {0.1 + 0.3 * (number % 7)}" for number, name in enumerate(names)]
    springs = [
        f"  s{number}: {{links: [m{number}, m{number + 1}], stiffness: {1000 * (1 + number % 5)}}}"
        for number in range(masses - 1)
    ]
    rows = [f"links: [{', '.join(names)}]", "inertias:", *inertias, "springs:", *springs]
    return "\n".join(rows) + "\n"


class Matrices:
    """Matrices of a chain, as they are written by hand."""

    def __init__(self, case: Transmission) -> None:
        self.rows = np.zeros((len(case.springs), case.links))
        for row, spring in zip(self.rows, case.springs, strict=True):
            for link, part in spring.form.items():
                row[link - 1] = part
        self.stiffnesses = np.array([spring.rate for spring in case.springs])
        self.mass = np.diag([case.inertias[link] for link in range(1, case.links + 1)])

    def stiffness(self) -> Floats:
        """Return the stiffness matrix."""
        stiffness: Floats = (self.rows.T * self.stiffnesses) @ self.rows
        return stiffness

    def lowest(self, *axes: Floats) -> Floats:
        """Return the lowest frequency but 0 for each combination of the first stiffnesses."""
        squares = []
        for values in product(*axes):
            self.stiffnesses[: len(values)] = values
            squares.append(linalg.eigh(self.stiffness(), self.mass, eigvals_only=True)[1])
        return np.sqrt(squares)


def modes_of_a_chain(setting: Setting, masses: int, count: int) -> Race:
    """Calculate the lowest modes of one gear of a chain.

    `modes` also creates the matrices, checks them and names the modes.
    """
    case = loads(chain(masses))
    matrices = Matrices(case)
    calls = CALLS if masses < 100 and not setting.is_trial else 1

    def own() -> None:
        for _ in range(calls):
            modes(case, [1], count=count)

    def peer() -> None:
        for _ in range(calls):
            linalg.eigh(matrices.stiffness(), matrices.mass, subset_by_index=[0, count - 1])

    return Race(timer(own, calls), timer(peer, calls))


def varied_stiffness(setting: Setting, masses: int, springs: int) -> Race:
    """Sweep stiffnesses of a chain, read from a file and written to NPZ.

    With one stiffness, each frequency is the root of a secular equation, with poles that all
    variants share; with several, each variant is an eigenvalue problem of its own.
    """
    text, each = chain(masses), round(setting.some(100_000) ** (1 / springs))
    count = each**springs
    case, output = setting.folder / f"{masses}.yaml", setting.folder / "frequencies.npz"
    case.write_text(text, "utf-8")
    varied = [f"--vary=s{number}.stiffness=500:50000:{each}" for number in range(springs)]
    words = ["sweep", str(case), *varied, "--out=omega[1,1]", f"-o{output}", "-q"]

    def own() -> None:
        output.unlink(missing_ok=True)
        main(words, standalone_mode=False)

    peer = partial(Matrices(loads(text)).lowest, *[np.linspace(500, 50000, each)] * springs)
    own()
    with np.load(output) as arrays:
        np.testing.assert_allclose(np.sort(arrays["omega[1,1]"]), np.sort(peer()), rtol=1e-9)
    return Race(timer(own, count), timer(peer, count))
