"""Natural modes as tables."""

from math import nextafter

import pytest

from tests.commands import CASES
from vstatics import load
from vstatics.torsion import modes
from vstatics.torsion.vibration.gear_modes import GearModes
from vstatics.torsion.vibration.tables import modes_grids


def told(gear: GearModes) -> list[list[str]]:
    """Where most of the energy is, without the shares."""
    energy = next(one for one in modes_grids([gear]) if one.key == "energy")
    return [[cell if isinstance(cell, str) else cell.text for cell in row] for row in energy.rows]


@pytest.mark.parametrize("side", ["left", "right"])
def test_of_two_equal_shares_the_first_is_named_on_any_processor(side: str) -> None:
    """Both tyres of the driveline swing with the same energy; rounding makes one larger."""
    [gear, *_] = modes(load(CASES / "driveline-8hp70.yaml"))
    even = [number for number, row in enumerate(told(gear)) if row[2] == "left tyre"]
    assert even

    def moved(shares: dict[str, float]) -> dict[str, float]:
        return {n: nextafter(part, part + n.startswith(side)) for n, part in shares.items()}

    other = gear._replace(
        modes=[
            one._replace(elastic=moved(dict(one.elastic)), kinetic=moved(dict(one.kinetic)))
            for one in gear.modes
        ]
    )
    assert told(other) == told(gear)
