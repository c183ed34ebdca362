"""Rows of the table below a Campbell diagram: each is a mode of a gear, of random drivelines.

Expected: frequencies, participations and damping ratios by numpy's eigenvalues of matrices that are
written out here, printed with the digits of the table.
"""

from collections import defaultdict
from random import Random

import numpy as np

from tests.chance import examples, seeded
from tests.torsion.systems import Array
from vstatics import Damping, Gear, Mechanism, ShiftElement, Spring, Transmission, solve
from vstatics.core.tables.numbers import typeset
from vstatics.pictures.drawing.style import Excitation, Style, number
from vstatics.torsion.pictures.orders.campbell_sheet import campbell_sheet
from vstatics.torsion.pictures.orders.resonance_table import resonance_tables

ORDERS = (0.5, 2.0, 4.0)
Row = tuple[str, ...]
"""Mode, frequency, participation, damping ratio, speeds."""


def ratios_of(random: Random) -> list[float]:
    """Ratios of two to four gears, some of which differ in no digit that is printed."""
    found = [round(random.uniform(0.7, 6), 3) for _ in range(random.randint(2, 3))]
    return found + [found[0] * (1 + 1e-8)] * random.randint(0, 1)


def driveline(random: Random, ratios: list[float]) -> tuple[Transmission, list[tuple[Array, ...]]]:
    """Engine 1, input 2, cage 3, wheels 4 and 5, car 6; M, K, D of each gear by 1, 2, 4, 5, 6."""
    masses = [10 ** random.uniform(-1.5, 1) for _ in range(5)] + [200.0]
    right = random.choice([1.0, 1.0, 1.25])  # equal shafts have a mode in which the engine stands
    rates = [10 ** random.uniform(2, 3.5), 8e3, 8e3 * right, 1.2e4, 1.2e4 * right]
    masses[4] = masses[3] * right
    viscous = [random.uniform(0, 0.3), *[random.choice([0.0, 1.0])] * 4]
    ends = ((1, 2), (3, 4), (3, 5), (4, 6), (5, 6))
    springs = [
        Spring({a: 1, b: -1}, stiffness=rate, damping=Damping(viscous=damping))
        for (a, b), rate, damping in zip(ends, rates, viscous, strict=True)
    ]
    firsts = range(7, 7 + len(ratios))
    case = Transmission(
        6 + len(ratios), [ShiftElement(link, 3) for link in firsts],
        [Mechanism(2, link, 0, ratio) for link, ratio in zip(firsts, ratios, strict=True)],
        [Gear([n]) for n in range(1, len(ratios) + 1)], inertias=dict(enumerate(masses, 1)),
        springs=springs, output=6,
    )  # fmt: skip
    matrices = []
    for ratio in ratios:
        links = np.zeros((6 + len(ratios), 5))
        links[[0, 1, 3, 4, 5], range(5)], links[2, 1] = 1, 1 / ratio
        links[6:, 1] = 1 / np.array(ratios)  # behind pairs, whose clutches may be open
        twists = np.array([links[a - 1] - links[b - 1] for a, b in ends])
        by_device = (twists.T @ np.diag(sizes) @ twists for sizes in (rates, viscous))
        matrices.append((links[:6].T @ np.diag(masses) @ links[:6], *by_device, links))
    return case, matrices


def own_rows(matrices: tuple[Array, ...], fastest: float) -> list[Row]:
    mass, stiffness, damping, links = matrices
    squares, shapes = np.linalg.eig(np.linalg.solve(mass, stiffness))
    order = np.argsort(squares.real)[1:]  # the first turns as one
    first = np.zeros((10, 10))
    first[:5, 5:] = np.eye(5)
    first[5:, :5] = -np.linalg.solve(mass, stiffness)
    first[5:, 5:] = -np.linalg.solve(mass, damping)
    values = np.linalg.eigvals(first)
    swings = sorted((one for one in values if one.imag > 1e-6), key=abs)
    rows = []
    for place, (index, swing) in enumerate(zip(order, swings, strict=True), 1):
        shape = np.abs(links @ shapes[:, index].real)
        part, hertz = shape[0] / shape.max(), float(np.sqrt(squares[index].real) / (2 * np.pi))
        speeds = [60 * hertz / order for order in ORDERS]
        met = [f"{one:.0f}" if one <= fastest else "" for one in speeds]
        if part > 1e-9 and any(met):
            ratio = -swing.real / abs(swing)
            rows.append((str(place), number(hertz), typeset(f"{part:.2g}"), f"{ratio:.3f}", *met))
    return rows


@examples(5, 15, 600)
def test_rows_of_random_drivelines(examples: int) -> None:
    random, shared, alone = seeded(146), 0, 0
    style = Style(excited=Excitation(orders=ORDERS))
    for _ in range(examples):
        ratios = ratios_of(random)
        case, matrices = driveline(random, ratios)
        sheet = campbell_sheet(solve(case), style, ())
        if not any(one.damping_ratio for one in sheet.modes):
            continue
        [table] = resonance_tables(sheet, 1e6)
        expected = defaultdict(list)
        for gear, one in enumerate(matrices):
            for row in own_rows(one, sheet.fastest):
                expected[row].append(str(gear + 1))
        found = {}
        for line in table.rows:
            mode, gears, *others = [cell.text for cell in line.all_cells]
            found[mode, *others] = gears
        assert set(found) == set(expected)
        for key, names in expected.items():
            is_all = len(names) == len(ratios)
            assert found[key] == ("all" if is_all else ", ".join(names))
            shared, alone = shared + (len(names) > 1), alone + (len(names) == 1)
    assert shared > 5
    assert alone > 5
