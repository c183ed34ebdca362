"""The explanation as text."""

from __future__ import annotations

from tests.shipped import shipped_results
from vstatics.core.explain import explain_gear
from vstatics.core.explain.text import write


def test_every_gear_of_a_shipped_case_fits_80_columns() -> None:
    for name in ("zf-9hp48.yaml", "toyota-p410.yaml", "ford-model-t.yaml", "ravigneaux-aod.yaml"):
        results = shipped_results(name)
        text = write(explain_gear(results, number + 1) for number in range(len(results.case.gears)))
        assert max(map(len, text.splitlines())) <= 80
