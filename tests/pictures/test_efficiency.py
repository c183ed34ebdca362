"""The picture of efficiency: its shares make up what the efficiency lacks."""

from __future__ import annotations

import numpy as np

from tests.commands import CASES
from vstatics import load, solve
from vstatics.pictures.efficiency import loss_shares
from vstatics.pictures.style import Style


def test_shares_of_losses_make_up_what_the_efficiency_lacks() -> None:
    for name in ("umdm.yaml", "zf-8hp70.yaml", "two-stage.yaml", "mzkt7922.dat"):
        for coast in (False, True):
            results = solve(load(CASES / name), coast=coast)
            _, shares = loss_shares(results, Style())
            kept = ~np.isnan(results.efficiency)
            np.testing.assert_allclose(1 - shares.sum(axis=0)[kept], results.efficiency[kept])
            assert (shares[:, kept] >= -1e-12).all()
