"""Torsional systems to test with: cases of random trains, and matrices made by hand."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from hypothesis import strategies as st
from scipy import linalg

from vstatics import Damping, Gear, Mechanism, ShiftElement, Spring, Transmission

Array = np.ndarray[Any, np.dtype[Any]]


def sprung(links: int, springs: Sequence[Spring], inertias: Mapping[int, float]) -> Transmission:
    """Return links that springs alone connect."""
    return Transmission(links, [], [], [], springs=springs, inertias=inertias)


def chain(
    inertias: list[float], stiffnesses: list[float], dampings: list[float] | None = None
) -> Transmission:
    """Masses in a row, a shaft between each two."""
    given = dampings or [0.0] * len(stiffnesses)
    springs = [
        Spring({n: 1, n + 1: -1}, stiffness=c, damping=d, name=f"shaft {n}")
        for n, (c, d) in enumerate(zip(stiffnesses, given, strict=True), 1)
    ]
    links = len(inertias)
    return sprung(links, springs, dict(enumerate(inertias, 1)))


def wheels(propshaft: float = 70.0, damping: float = 0.0, **others: Any) -> Transmission:
    """Two equal wheels on equal half-shafts behind an engine; in antiphase at 5 rad/s."""
    shafts = {"propshaft": (1, 2, propshaft), "left": (2, 3, 50.0), "right": (2, 4, 50.0)}
    springs = [
        Spring({a: 1, b: -1}, stiffness=c, damping=damping, name=name)
        for name, (a, b, c) in shafts.items()
    ]
    inertias = {1: 9.0, 2: 1.0, 3: 2.0, 4: 2.0}
    return Transmission(4, [], [], [], springs=springs, inertias=inertias, output=4, **others)


def mounted(
    damping: Damping | float, stiffness: float = 100.0, inertia: float = 1.0
) -> Transmission:
    spring = Spring({1: 1}, stiffness=stiffness, damping=damping, name="mount")
    return sprung(1, [spring], {1: inertia})


def matrices(case: Transmission) -> tuple[Array, Array, Array]:
    """M, K and D of a case of springs alone, by the definition of the source (section 1)."""
    size = case.links
    mass = np.diag([case.inertias.get(n, 0.0) for n in range(1, size + 1)])
    stiffness, resistance = np.zeros((size, size)), np.zeros((size, size))
    for spring in case.springs:
        row = np.zeros(size)
        for link, part in spring.form.items():
            row[link - 1] = part
        assert isinstance(spring.damping, Damping)
        stiffness += spring.rate * np.outer(row, row)
        resistance += spring.damping.viscous * np.outer(row, row)
    return mass, stiffness, resistance


def eigenvalues(mass: Array, stiffness: Array, resistance: Array, rigid: int = 0) -> Array:
    """Those of ``(s^2 M + s D + K) x = 0`` in the upper half plane, by SciPy's QZ; M can be singular.

    Two zeros of each rigid mode are left out.
    """
    zero, unit = np.zeros_like(mass), np.eye(len(mass))
    companion = np.block([[zero, unit], [-stiffness, -resistance]])
    values = np.asarray(linalg.eigvals(companion, linalg.block_diag(unit, mass)), complex)
    values = values[np.argsort(np.abs(values))][2 * rigid :]
    upper: Array = values[(np.abs(values) < 1e6) & (values.imag >= -1e-7 * np.abs(values))]
    return upper


@st.composite
def branched(draw: st.DrawFn) -> Transmission:
    """Any springs between any links, some of four members, some to the housing."""
    links = draw(st.integers(2, 7))
    size = st.floats(0.1, 10.0)
    springs = [
        Spring({n: 1, draw(st.integers(1, n - 1)): -1}, stiffness=draw(size), name=f"tree {n}")
        for n in range(2, links + 1)
    ]
    parts = st.sampled_from((-1.5, -1, 0.5, 1))
    for number in range(draw(st.integers(0, 3))):
        members = draw(st.dictionaries(st.integers(1, links), parts, min_size=1))
        springs.append(Spring(members, stiffness=draw(size), name=f"form {number}"))
    inertias = {n: draw(size) for n in range(1, links + 1)}
    return sprung(links, springs, inertias)


def with_planetary_set(**others: Any) -> Transmission:
    """Engine, elastic shaft, sun; the ring on a spring to the housing; carrier, shaft, vehicle."""
    own = {"in": ({1: 1, 2: -1}, 900.0), "ring mount": ({3: 1}, 4e3), "out": ({4: 1, 5: -1}, 2.5e3)}
    given: Mapping[str, Any] = {
        "shift_elements": [ShiftElement(2, 3, name="C")],
        "mechanisms": [Mechanism(2, 3, 4, ratio=-2.5, name="P")],
        "gears": [Gear([], name="low"), Gear([1], name="direct")],
        "springs": [Spring(twist, rate, name=name) for name, (twist, rate) in own.items()],
        "inertias": {1: 0.2, 2: 0.01, 3: 0.05, 4: 0.03, 5: 4.0},
    }
    return Transmission(5, **{**given, "output": 5, **others})
