"""Systems with little or no inertia: closed forms."""

from __future__ import annotations

import pytest

from vstatics import CaseError, loads
from vstatics.torsion.vibration.gear_modes import modes

TWO_SPRINGS = """\
springs:
  a: {links: [x, y], compliance: 2e-3}
  b: {links: [y, z], compliance: 3e-3, damping: 1}
"""


def test_a_case_without_inertias_is_told() -> None:
    with pytest.raises(CaseError, match="nothing has an inertia"):
        modes(loads(TWO_SPRINGS))


def test_one_mass_between_massless_links_has_no_mode() -> None:
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
    [gear] = modes(case)
    assert gear.modes[0].omega ** 2 == pytest.approx((1 / 5e-3 + 1) / 0.5)
    assert gear.modes[0].damping_ratio == pytest.approx(1e-3 / (2 * 0.5 * gear.modes[0].omega))
