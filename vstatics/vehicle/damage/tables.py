"""Tables of damage and life."""

from __future__ import annotations

from collections.abc import Mapping

from vstatics.core.tables.grid import Grid, grid_of
from vstatics.vehicle.damage.devices import DeviceDamage
from vstatics.vehicle.damage.rayleigh import RayleighLife
from vstatics.vehicle.damage.resize import ResizedShaft


def damage_grid(damages: Mapping[str, DeviceDamage], title: str = "Damage") -> Grid:
    """Return a table of damage with a row for each component.

    Examples
    --------
    >>> damage_grid({"shaft": DeviceDamage(2.5e-6, 4e5, 90e6, [])}).texts
    [['shaft', '0.000002500', '400000.000', '90.000', '0']]
    """
    rows = []
    for name, damage in damages.items():
        cycles = sum(cycle.counted for cycle in damage.cycles)
        rows.append((name, damage.damage, damage.repeats, damage.largest_stress / 1e6, cycles))
    headings = "component", "damage", "repeats", "largest stress [MPa]", "cycles"
    return grid_of(title, headings, rows, key="damage")


def rayleigh_grid(life: RayleighLife, unit: str) -> Grid:
    """Return a table of a life in `unit`, km or cycles."""
    headings, row = ["integral", f"life [{unit}]"], [life.integral, life.life]
    if life.samples is not None:
        headings += [f"{name} [{unit}]" for name in ("B10", "B50", "mean life")]
        row += [life.samples.B10, life.samples.B50, life.samples.mean]
    return grid_of("Life under random stresses", headings, [row], key="rayleigh")


def resized_grid(shaft: ResizedShaft, unit: str) -> Grid:
    """Return a table of a resized shaft; the unit is the unit of the diameter."""
    headings = f"diameter [{unit}]" if unit else "diameter", "compliance", "reduced compliance"
    title = "Shaft of equal fatigue strength"
    return grid_of(title, headings, [shaft], key="resize", optional=headings[2:])
