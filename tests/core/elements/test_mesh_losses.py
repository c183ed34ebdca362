"""Efficiency from teeth: the closed form, and friction added up along the path of contact."""

import math

import numpy as np
import pytest

from vstatics import CaseError, ReadError
from vstatics.core import readers
from vstatics.core.elements.mesh_losses import mesh_efficiency, tip_contact
from vstatics.core.statics.solve import solve


def integrated(one: int, other: int, friction: float) -> float:
    """Loss of two external wheels: equal shares of the load over all pairs in contact.

    Along the path of contact, in base pitches from the pitch point, a pair slides by
    ``|x| (1/z1 + 1/z2) 2 pi`` of the speed of the path. [-]
    """
    below, above = tip_contact(other), tip_contact(one)
    first = np.linspace(0, 1, 20_001)[:-1] + 0.5 / 20_000  # of one pair over a base pitch
    x = first + np.arange(-2, 3)[:, None]
    inside = (x >= -below) & (x <= above)
    loss = (abs(x) * inside).sum(axis=0) / inside.sum(axis=0)
    return 1 - friction * 2 * math.pi * (1 / one + 1 / other) * float(loss.mean())


def test_external_wheels_lose_what_friction_adds_up_to() -> None:
    """Friction of all pairs in contact, each with an equal share of the load."""
    for one, other in ((20, 40), (17, 17), (25, 90), (60, 31)):
        found = mesh_efficiency(one, other, 0.06, False)
        assert found == pytest.approx(integrated(one, other, 0.06), abs=2e-6)


def test_tips_by_geometry() -> None:
    """Of 20 teeth: (sqrt(11^2 - (10 cos 20)^2) - 10 sin 20)/(pi cos 20), by hand .778419.

    Of a ring of 72: (36 sin 20 - sqrt(35^2 - (36 cos 20)^2))/(pi cos 20), by hand 1.129623.
    """
    assert tip_contact(20) == pytest.approx(0.778419, abs=1e-6)
    assert tip_contact(72, is_ring=True) == pytest.approx(1.129623, abs=1e-6)
    assert mesh_efficiency(20, 40, 0.06, False) == pytest.approx(0.990036, abs=1e-6)


def test_a_ring_slides_by_the_difference_of_curvatures() -> None:
    """1 - pi mu (1/20 - 1/72)(1 - e1 - e2 + e1^2 + e2^2) with the tips above."""
    e1, e2 = 0.778419, 1.129623
    expected = 1 - math.pi * 0.06 * (1 / 20 - 1 / 72) * (1 - e1 - e2 + e1**2 + e2**2)
    assert mesh_efficiency(20, 72, 0.06, True) == pytest.approx(expected, abs=1e-7)


SET = """
links: [sun, ring, carrier]
input: sun
output: carrier
elements:
  P: {{kind: planetary, sun: sun, ring: ring, carrier: carrier,
      teeth: {{sun: 24, ring: {ring}}}{more}}}
shift_elements: {{B: [ring, housing]}}
gears: {{"1": [B]}}
mesh_efficiency: {{friction: 0.06{own}}}
"""


def of_set(ring: int = 72, more: str = "", own: str = "") -> float:
    case = readers.read(SET.format(ring=ring, more=more, own=own).encode(), "set.yaml").case
    assert solve(case).consistent.all()
    return float(case.mechanisms[0].efficiency)


def test_a_set_is_the_product_of_its_meshes() -> None:
    """The planet fills the gap: 24 teeth."""
    outer = mesh_efficiency(24, 72, 0.06, True)
    assert of_set() == pytest.approx(mesh_efficiency(24, 24, 0.06, False) * outer)


def test_numbers_that_are_given_hold() -> None:
    outer = mesh_efficiency(24, 72, 0.06, True)
    assert of_set(own=", external: 0.97") == pytest.approx(0.97 * outer)
    assert of_set(more=", efficiency: 0.95") == 0.95
    assert of_set(more=", mesh_efficiency: {friction: 0.03}") > of_set()


def test_a_ring_that_is_too_small_is_reported() -> None:
    with pytest.raises(ReadError, match="read 32 teeth, expected 34 at least"):
        of_set(ring=32)
    with pytest.raises((ReadError, CaseError), match="between 0 and 1"):
        readers.read(SET.format(ring=72, more="", own="").replace("0.06", "2").encode(), "set.yaml")
