"""A clutch that is dumped as plain data, for JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from vstatics.torsion.clutch.dumped import DumpTorque

if TYPE_CHECKING:  # it needs scipy, which a file of numbers does not
    from vstatics.torsion.clutch.gear_dump import GearDump

FORMAT, VERSION = "vstatics-dump", 1
HEAD = {"format": FORMAT, "version": VERSION}


def dump_document(made: DumpTorque) -> dict[str, Any]:
    """The largest torques of a file of numbers."""
    return {**HEAD, **_torques(made)}


def gear_document(gear: GearDump) -> dict[str, Any]:
    """The largest torques in a gear of a case."""
    return {**HEAD, **_gear(gear)}


def gears_document(gears: Sequence[GearDump]) -> dict[str, Any]:
    """The largest torques in gears of a case."""
    return {**HEAD, "gears": [_gear(gear) for gear in gears]}


def _gear(gear: GearDump) -> dict[str, Any]:
    if gear.made is None:
        return {"name": gear.name, "error": gear.error}
    return {"name": gear.name, "to": gear.to, "reduced": gear.given, **_torques(gear.made)}


def _torques(made: DumpTorque) -> dict[str, Any]:
    values = {**made._asdict(), "messages": list(map(str, made.messages))}
    if made.engagement is None:
        del values["engagement"]
    return values
