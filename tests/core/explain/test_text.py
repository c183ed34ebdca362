"""The explanation as text."""

from __future__ import annotations

from tests.shipped import shipped_results
from vstatics import solve
from vstatics.core.explain import explain_gear
from vstatics.core.explain.text import write
from vstatics.core.readers import loads


def test_every_gear_of_a_shipped_case_fits_80_columns() -> None:
    for name in ("zf-9hp48.yaml", "toyota-p410.yaml", "ford-model-t.yaml", "ravigneaux-aod.yaml"):
        results = shipped_results(name)
        text = write(explain_gear(results, number + 1) for number in range(len(results.case.gears)))
        assert max(map(len, text.splitlines())) <= 80


def test_the_planet_without_teeth_is_named() -> None:
    results = solve(
        loads(
            """
input: s1
output: r
elements:
  set: {kind: ravigneaux, small_sun: s1, large_sun: s2, ring: r, carrier: c,
        teeth: {small_sun: 28, large_sun: 32, ring: 76}}
shift_elements: {B: [c, housing]}
gears: {low: [B]}
"""
        )
    )
    text = " ".join(write([explain_gear(results, 1)]).split())
    assert "the teeth of planet set.short are not given" in text
    assert "set.long are not given" not in text
