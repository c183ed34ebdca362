"""Mechanisms of ratio 1 with three links: the first turns as the second, the third takes losses.

`test_against_oracle` has random trains with such mechanisms.
"""

import pytest

from vstatics import solve
from vstatics.core.elements.checks import hints
from vstatics.core.elements.drawing import drawing_of
from vstatics.core.readers import loads

FERGUSON = """\
links: [arm, first, w99, w100, w101]
elements:
  set:
    kind: planet_group
    carrier: arm
    rims: {planet: {thick: 20}}
    suns:
      - {link: first, teeth: 100, rim: thick}
      - {link: w99, teeth: 99, rim: thick}
      - {link: w100, teeth: 100, rim: thick}
      - {link: w101, teeth: 101, rim: thick}
shift_elements: {B: [first, housing]}
gears:
  low: {engaged: [B]}
"""


def test_fergusons_paradox_from_its_teeth() -> None:
    """With the arm at 1 a wheel of z teeth beside a fixed one of 100 turns by 1 - 100/z."""
    for losses in ("meshes", "reduced"):
        results = solve(loads(f"losses: {losses}\n{FERGUSON}"))
        expected = [1, 0, 1 - 100 / 99, 0, 1 - 100 / 101]
        assert results.speeds[0] == pytest.approx(expected, abs=1e-15)
        assert results.speeds[0, 3] == 0
        assert results.ratio == pytest.approx([101])


def test_wheels_that_turn_alike_get_a_note() -> None:
    drawing = drawing_of(loads(FERGUSON))
    assert drawing is not None
    [alike] = [one for one in hints(drawing) if "always turn at the same speed" in one.message]
    assert (alike.severity, alike.message[:15]) == ("note", "first and w100 ")
