"""Modes as plain data, for JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from vstatics.torsion.gear_modes import GearModes, Mode

FORMAT, VERSION = "vstatics-modes", 1


def modes_document(name: str, gears: Sequence[GearModes]) -> dict[str, Any]:
    """The modes of gears of a case, by its name; a gear that has none says why."""
    return {
        "format": FORMAT,
        "version": VERSION,
        "case": name,
        "gears": [
            {"name": gear.name, "error": gear.error}
            if gear.error
            else {
                "name": gear.name,
                "rigid_modes": gear.rigid_modes,
                "modes": [_mode(mode) for mode in gear.modes],
                "damped": [{"real": s.real, "imag": s.imag} for s in gear.damped],
                "warnings": gear.warnings,
            }
            for gear in gears
        ],
    }


def _mode(mode: Mode) -> dict[str, Any]:
    return {
        "omega": mode.omega,
        "frequency": mode.frequency,
        "damping_ratio": mode.damping_ratio,
        "damped_frequency": mode.damped_frequency,
        "nodes": mode.nodes,
        "shape": mode.shape,
        "torques": mode.torques,
        "kinetic": mode.kinetic,
        "elastic": mode.elastic,
        "sensitivity": {"stiffness": mode.by_stiffness, "inertia": mode.by_inertia},
    }
