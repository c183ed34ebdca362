"""Steps and spread of arrays are those of the design table of each variant."""

import numpy as np

from tests.chance import seeded
from vstatics.core.model.transmission import Gear, Mechanism, Transmission
from vstatics.core.statics.solve import solve
from vstatics.core.summary.design_table import design
from vstatics.sweep.gear_steps import spread, steps


def test_random_ratios_have_the_steps_of_their_design_table() -> None:
    """The summary sorts the gears of one case; here they are compared in pairs."""
    random = seeded(27)
    pairs = [Mechanism(1, 2, 0, -2.0), Mechanism(1, 3, 0, 2.0)]
    for _ in range(60):
        kinds = [random.choice(["gear", "gear", "gear", "point"]) for _ in range(6)]
        ends = [random.choice([None, None, None, 3]) for _ in range(6)]
        gears = [
            Gear(kind=kind, output=end, name=f"g{n}")  # type: ignore[arg-type]
            for n, (kind, end) in enumerate(zip(kinds, ends, strict=True))
        ]
        results = solve(Transmission(3, [], pairs, gears))
        ratios = np.array([random.choice([4.0, -3.0, 2.5, 1.0, -1.0, np.nan]) for _ in gears])
        made = design(results._replace(ratio=ratios))
        expected = [[abs(gear.step) for gear in made.gears]]
        np.testing.assert_allclose(steps(results.case, ratios[None]), expected)
        np.testing.assert_allclose(spread(results.case, ratios[None]), [made.spread])
