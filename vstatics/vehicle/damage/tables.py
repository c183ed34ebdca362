"""Tables of what torques do to devices."""

from __future__ import annotations

from collections.abc import Mapping

from vstatics.core.tables.grid import Grid, grid_of
from vstatics.vehicle.damage.devices import DeviceDamage
from vstatics.vehicle.damage.rayleigh import RayleighLife
from vstatics.vehicle.damage.resize import ResizedShaft


def damage_grid(found: Mapping[str, DeviceDamage], title: str = "Damage") -> Grid:
    """A row for each device.

    Examples
    --------
    >>> damage_grid({"shaft": DeviceDamage(2.5e-6, 4e5, 90e6, [])}).texts
    [['shaft', '.000002500', '400000.000', '90.000', '0']]
    """
    rows = []
    for name, one in found.items():
        cycles = sum(cycle.counted for cycle in one.cycles)
        rows.append((name, one.damage, one.repeats, one.largest_stress / 1e6, cycles))
    headings = "device", "damage", "repeats", "largest stress [MPa]", "cycles"
    return grid_of(title, headings, rows, key="damage")


def rayleigh_grid(made: RayleighLife, unit: str) -> Grid:
    """The life in a unit, km or cycles."""
    headings = "integral", f"life [{unit}]"
    return grid_of("Life under random stresses", headings, [made], key="rayleigh")


def resized_grid(made: ResizedShaft, unit: str) -> Grid:
    """The diameter in a unit; nothing where it has none."""
    headings = f"diameter [{unit}]" if unit else "diameter", "compliance", "reduced compliance"
    title = "Shaft of equal fatigue strength"
    return grid_of(title, headings, [made], key="resize", optional=headings[2:])
