"""Systems with little or no inertia: closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import linalg

from tests.chance import count, seeded
from tests.torsion.systems import matrices
from vstatics import CaseError, Spring, Transmission, loads
from vstatics.torsion.vibration.gear_modes import modes

TWO_SPRINGS = """\
springs:
  a: {links: [x, y], compliance: 2e-3}
  b: {links: [y, z], compliance: 3e-3, damping: 1}
"""


def test_no_inertia_or_one_mass_between_massless_links_has_no_mode() -> None:
    with pytest.raises(CaseError, match="nothing has an inertia"):
        modes(loads(TWO_SPRINGS))
    [gear] = modes(loads("inertias: {y: 1}\n" + TWO_SPRINGS))
    assert (gear.rigid_modes, gear.modes) == (1, [])


def test_a_massless_link_between_undamped_springs_beside_a_damped_one() -> None:
    """Where no massless motion is damped; springs in series: omega^2 = 1/(J (E1 + E2))."""
    case = loads("""\
inertias: {mass: 0.5}
springs:
  a: {links: [mass, middle], compliance: 2e-3}
  b: {links: [middle], compliance: 3e-3}
  c: {links: [mass], compliance: 1, damping: 1e-3}
""")
    [mode] = modes(case)[0].modes
    assert mode.omega**2 == pytest.approx((1 / 5e-3 + 1) / 0.5)
    assert mode.damping_ratio == pytest.approx(1e-3 / (2 * 0.5 * mode.omega))


@pytest.mark.parametrize("seed", range(count(12, 300)))
def test_massless_links_of_which_a_damper_resists_some(seed: int) -> None:
    """The finite eigenvalues of (s^2 M + s D + K) x = 0 with a singular M, by SciPy's QZ."""
    rng = seeded(seed)
    size = rng.randint(4, 6)
    damped = rng.randint(1, size)
    shafts = [(n, n + 1) for n in range(1, size)] + [(size, 0)]
    springs = [
        Spring({n: 1.0, **({other: -1.0} if other else {})}, stiffness=rng.uniform(50, 500),
               damping=rng.uniform(0.1, 2) if n == damped or rng.random() < 0.3 else 0.0,
               name=f"shaft {n}")
        for n, other in shafts
    ]  # fmt: skip
    case = Transmission(
        size, [], [], [], output=size, springs=springs,
        inertias={1: rng.uniform(0.5, 3), size: rng.uniform(0.5, 3)},
    )  # fmt: skip
    mass, stiffness, resistance = matrices(case)
    zero, unit = np.zeros((size, size)), np.eye(size)
    companion = np.block([[zero, unit], [-stiffness, -resistance]])
    values = linalg.eigvals(companion, linalg.block_diag(unit, mass))
    expected = [one for one in values if abs(one) < 1e6 and one.imag >= -1e-9 * abs(one)]
    [gear] = modes(case)
    assert len(gear.damped) == len(expected)
    for one in expected:
        assert np.abs(np.array(gear.damped) - one).min() < 1e-6 * abs(one)
