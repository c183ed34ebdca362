"""Benchmarks of gears: variants, operating points, decks, starts, pictures and long sweeps."""

from __future__ import annotations

import random
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.measuring import CASES, VSTATICS, Race, Setting, command, timer
from benchmarks.peer import Peer, numeric
from vstatics import Gear, Load, Mechanism, ShiftElement, Transmission, load, loads, solve
from vstatics.core.statics.results import Results
from vstatics.core.writers import deck

MZKT = CASES / "mzkt7922.dat"
SEED = 7
CALLS = 10
E_AXLE = """\
links: [engine, mid, out]
load: {speed: 2000 rpm, torque: 80 N*m}
drag: {engine: "1.2 + 0.004*w", out: [[0, 2.0], [300, 3.5]]}
shift_elements:
  C1: {links: [mid, out], drag: [[0, 0], [200, 6]]}
mechanisms:
  a: {first: engine, second: mid, ratio: -3, efficiency: 0.985}
  b: {first: mid, second: out, ratio: -2.8, efficiency: 0.985}
gears: {drive: []}
"""
LOOP = """
import numpy
numbers = numpy.ones(4096)
for _ in range({}):
    numpy.multiply(numbers, 1.0, numbers)
"""


def similar_variants(setting: Setting, units: int) -> Race:
    """Solve variants with the ratios of the peer, with one plan for all.

    A plan is the recorded calculation of a gear: each operation is one NumPy call for thousands of
    variants, and zeros of the matrices cost nothing, unlike in the elimination of the peer.
    """
    case, count = in_series(load(MZKT), units), setting.some(20_000 // units)
    factors = 1 + 1e-6 * (np.arange(1, count + 1) % 1000)
    ratios = factors[:, None] * [mechanism.ratio for mechanism in case.mechanisms]
    call, peer = partial(solve, case, ratios=ratios), Peer(setting, case)
    results = call()
    own_sum = results.lossy_torques[:, 0, -1].sum() + results.efficiency[:, -1].sum()
    np.testing.assert_allclose(own_sum, peer.check_sum(count), rtol=1e-9)
    return _against_peer(setting, call, count, peer, units)


def random_variants(
    setting: Setting, file: str, most: float, signs: tuple[int, ...] = (1,)
) -> Race:
    """Solve variants with random ratios and efficiencies.

    If power flows differ, a plan chooses for each variant, which takes up to twice the steps. The
    time of the peer does not depend on the numbers.
    """
    case, count = load(CASES / file), setting.some(5_000)
    rng, shape = np.random.default_rng(SEED), (count, len(case.mechanisms))
    factors = most ** rng.uniform(-1, 1, shape) * rng.choice(signs, shape)
    ratios = factors * [mechanism.ratio for mechanism in case.mechanisms]
    efficiencies = rng.uniform(0.9, 0.99, shape)
    call = partial(solve, case, ratios=ratios, efficiencies=efficiencies)
    return _against_peer(setting, call, count, Peer(setting, case))


def _against_peer(
    setting: Setting, call: Callable[[], Results], count: int, peer: Peer, units: int = 1
) -> Race:
    def calls() -> None:
        for _ in range(CALLS):
            read(call())

    calls()
    peer_count = setting.some(40_000 // units**3)
    return Race(timer(calls, CALLS * count), peer.timer(peer_count, peer_count))


def read(results: Results) -> None:
    """Read every number of the results; a number repeated for all variants is read once."""
    for array in results:
        if isinstance(array, np.ndarray):
            array[tuple(slice(None) if step else slice(1) for step in array.strides)].max(initial=0)


def in_series(unit: Transmission, units: int) -> Transmission:
    """Return gearboxes in series, joined by clutches; gearbox k of gear g is in its gear g + k."""
    elements: list[ShiftElement] = []
    mechanisms: list[Mechanism] = []
    engaged: list[list[int]] = [[] for _ in unit.gears]
    for number in range(units):
        before = number * unit.links
        moved = [0, *range(before + 1, before + unit.links + 1)]
        joint = [ShiftElement(before, before + 1)] * bool(number)
        for position, numbers in enumerate(engaged):
            gear = unit.gears[(position + number) % len(unit.gears)]
            own = [len(joint) + element for element in gear.engaged]
            numbers.extend(len(elements) + element for element in [1] * len(joint) + own)
        pairs = [(moved[one.first], moved[one.second]) for one in unit.shift_elements]
        elements += joint + [ShiftElement(*pair) for pair in pairs]
        for mechanism in unit.mechanisms:
            first, second, third = (moved[link] for link in mechanism.links)
            mechanisms.append(mechanism._replace(first=first, second=second, third=third, name=""))
    gears = [Gear(numbers) for numbers in engaged]
    return Transmission(units * unit.links, elements, mechanisms, gears)


def operating_points(setting: Setting, count: int) -> Race:
    """Solve operating points of an e-axle with speed-dependent drag in one call.

    A loop has to create and check a case for each point.
    """
    case, few = loads(E_AXLE), setting.some(500)
    rng = np.random.default_rng(SEED)
    speeds, torques = rng.uniform(50, 1500, count), rng.uniform(15, 300, count)
    call = partial(solve, case, vary={"load.speed": speeds, "load.torque": torques})

    def loop() -> list[float]:
        pairs = zip(speeds[:few] * 30 / np.pi, torques[:few], strict=True)
        return [solve(case.replace(load=Load(*pair))).efficiency[0] for pair in pairs]

    np.testing.assert_allclose(call().efficiency[:few, 0], loop(), rtol=1e-12)
    return Race(timer(call, count), timer(loop, few))


def many_decks(setting: Setting, output: tuple[str, ...]) -> Race:
    """Read, calculate and write a thousand decks by one process.

    The peer starts anew for each deck, but it checks and names nothing.
    """
    folder, count = Path(tempfile.mkdtemp(dir=setting.folder)), setting.some(1000)
    case, rng = load(MZKT), random.Random(SEED)  # noqa: S311
    for number in range(count):
        ratios = [round(one.ratio * rng.uniform(0.9, 1.1), 4) for one in case.mechanisms]
        pairs = zip(case.mechanisms, ratios, strict=True)
        variant = case.replace(mechanisms=[one._replace(ratio=ratio) for one, ratio in pairs])
        (folder / f"{number:04}.dat").write_text(deck.write(variant), "utf-8")
        (folder / f"{number:04}.num").write_text(numeric(variant), encoding="ascii")
    (folder / "list").write_text("".join(f"{number:04}.dat\n" for number in range(count)))

    def into_new_folder(*words: str) -> None:
        """Run a command; files that replace or follow others would take longer."""
        results = tempfile.mkdtemp(dir=folder)
        command(*(word.format(results) for word in words), folder=folder)()

    run = partial(into_new_folder, VSTATICS, "run", "--files-from", "list", *output)
    shell = 'for f in *.num; do "$0" "$f" > "$1/$f.lst"; done'
    peer = partial(into_new_folder, "/bin/sh", "-c", shell, str(setting.peer), "{}")
    return Race(timer(run, count), timer(peer, count))


def one_run(setting: Setting) -> Race:
    """Run the program once, whose imports take longer than its calculation."""
    run = command(VSTATICS, "run", str(MZKT), folder=setting.folder)
    return Race(timer(run), timer(_importing(setting, "numpy, click")))


def one_document(setting: Setting, words: tuple[str, ...]) -> Race:
    """Draw a picture of a ten-speed gearbox, or write its report."""
    case = str(CASES / "ford-10r80.yaml")
    run = command(VSTATICS, *words, case, "-q", folder=setting.folder)
    return Race(timer(run), timer(_importing(setting, "matplotlib.pyplot")))


def _importing(setting: Setting, packages: str) -> Callable[[], object]:
    return command(sys.executable, "-c", f"import {packages}", folder=setting.folder)


def long_sweep(setting: Setting, count: int) -> Race:
    """Sweep three ratios, and write ratio and efficiency of six gears."""
    peer, few = Peer(setting, load(MZKT)), setting.some(40_000)
    run = _sweep(setting, count, "out.npz", jobs=1)
    return Race(timer(run, max(20_000, setting.some(count))), peer.timer(few, few))


def two_jobs(setting: Setting, count: int, file: str) -> Race:
    """Sweep with two processes; the time on the clock counts."""
    both, one = (_sweep(setting, count, file, jobs=jobs) for jobs in (2, 1))
    return Race(timer(both, clock=time.perf_counter), timer(one, clock=time.perf_counter))


def _sweep(setting: Setting, count: int, file: str, jobs: int) -> Callable[[], object]:
    ranges = ("D1.ratio=-0.9:-0.7:100", "D2.ratio=2.4:2.8:100")
    last = f"D3.ratio=-2.6:-2.3:{max(2, setting.some(count) // 10_000)}"
    words = [f"--vary={text}" for text in (*ranges, last)]
    output = f"--jobs={jobs}", "-o", file
    return command(VSTATICS, "sweep", str(MZKT), *words, *output, folder=setting.folder)


def two_loops(setting: Setting) -> Race:
    """Run two processes that share nothing: the largest gain that a second core allows."""
    words = [sys.executable, "-c", LOOP.format(setting.some(500_000))]

    def at_once(number: int) -> None:
        processes = [subprocess.Popen(words) for _ in range(number)]
        for process in processes:
            process.wait()

    both, one = (
        timer(partial(at_once, number), number, clock=time.perf_counter) for number in (2, 1)
    )
    return Race(both, one)
