"""What a gear is as a torsional system, as plain data for JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from vstatics.torsion.forced.cycle import summed
from vstatics.torsion.forced.harmonic_torques import GearResponse, OrderResponse
from vstatics.torsion.reduction.reduced_values import GearReduction
from vstatics.torsion.reduction.simplification import Simplification
from vstatics.torsion.vibration.gear_modes import GearModes, Mode
from vstatics.torsion.vibration.measured import Damped, Identified

MODES = "vstatics-modes"
REDUCTION = "vstatics-reduction"
RESPONSE = "vstatics-response"
SIMPLIFICATION = "vstatics-simplification"
IDENTIFICATION = "vstatics-identification"
DAMPING = "vstatics-damping"
VERSION = 1


def modes_document(name: str, gears: Sequence[GearModes]) -> dict[str, Any]:
    """The modes of gears of a case, by its name; a gear that has none says why."""
    return {
        "format": MODES,
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


def reduction_document(name: str, to: str, gears: Sequence[GearReduction]) -> dict[str, Any]:
    """Inertias and compliances of gears on one link, by its name."""
    return {
        "format": REDUCTION,
        "version": VERSION,
        "case": name,
        "to": to,
        "gears": [
            {"name": one.name, "error": one.error}
            if one.error
            else {key: value for key, value in one._asdict().items() if key != "error"}
            for one in gears
        ],
    }


def response_document(
    name: str, at: str, gears: Sequence[GearResponse], *, with_sum: bool
) -> dict[str, Any]:
    """Forced vibration of gears: moduli over the speeds [rpm]."""
    return {
        "format": RESPONSE,
        "version": VERSION,
        "case": name,
        "at": at,
        "gears": [
            {"name": one.name, "error": one.error}
            if one.error
            else {
                "name": one.name,
                "speeds": one.speeds.tolist(),
                "orders": [_order(order) for order in one.orders],
                **({"sum": _sum(one)} if with_sum else {}),
                "resonances": [met._asdict() for met in one.resonances],
            }
            for one in gears
        ],
    }


def _order(one: OrderResponse) -> dict[str, Any]:
    return {
        "order": one.order,
        "amplitudes": {name: np.abs(values).tolist() for name, values in one.amplitudes.items()},
        "torques": {name: np.abs(values).tolist() for name, values in one.torques.items()},
    }


def _sum(gear: GearResponse) -> dict[str, Any]:
    """All orders together: the largest value over a cycle, and the root of the mean square."""
    orders = [one.order for one in gear.orders]
    parts = {
        "amplitudes": [one.amplitudes for one in gear.orders],
        "torques": [one.torques for one in gear.orders],
    }
    return {
        part: {
            name: {"largest": total.largest.tolist(), "rms": total.rms.tolist()}
            for name in by_order[0]
            for total in [summed(orders, [one[name] for one in by_order])]
        }
        for part, by_order in parts.items()
    }


def simplification_document(name: str, gear: str, found: Simplification) -> dict[str, Any]:
    """The steps to a simpler scheme."""
    return {
        "format": SIMPLIFICATION,
        "version": VERSION,
        "case": name,
        "gear": gear,
        "rule": found.rule,
        "steps": [one._asdict() for one in found.steps],
        "warnings": [one.message for one in found.warnings],
    }


def identified_document(
    name: str, gear: str, mode: int, measured: float, made: Identified
) -> dict[str, Any]:
    """What follows from the frequency of a mode that was measured [rad/s]."""
    return {
        "format": IDENTIFICATION,
        "version": VERSION,
        "case": name,
        "gear": gear,
        "mode": mode,
        "measured": measured,
        **made._asdict(),
    }


def damped_document(name: str, gear: str, mode: int, made: Damped) -> dict[str, Any]:
    """Dampings from decrements."""
    values = {key: value for key, value in made._asdict().items() if key != "notes"}
    return {
        "format": DAMPING,
        "version": VERSION,
        "case": name,
        "gear": gear,
        "mode": mode,
        **values,
        "messages": made.notes,
    }
