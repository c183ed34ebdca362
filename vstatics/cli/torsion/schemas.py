"""The JSON Schemas of what `torsion.documents` makes; that room does not know `writers`."""

from __future__ import annotations

from collections.abc import Mapping

from vstatics.torsion import documents as made
from vstatics.torsion.forced.harmonic_torques import Resonance
from vstatics.torsion.reduction.reduced_values import GearReduction
from vstatics.torsion.reduction.simplification import SimplificationRule, SimplificationStep
from vstatics.torsion.vibration.gear_modes import GearModes, Mode
from vstatics.torsion.vibration.measured import Damped, Identified
from vstatics.writers.documents import documents, head
from vstatics.writers.record_schema import NUMBER, TEXT, Schema, list_of, record, schema_of

COUNT = schema_of(int)
NAMED = schema_of(Mapping[str, float])
"""By the name of a link or a device."""


def json_schemas() -> dict[str, Schema]:
    """By the name of each: the schemas of ``vstatics torsion ... -f json``."""
    return {
        "modes": modes_schema(),
        "reduction": reduction_schema(),
        "simplification": simplification_schema(),
        "response": response_schema(),
        "identification": identification_schema(),
        "damping": damping_schema(),
    }


def modes_schema() -> Schema:
    """The schema of ``vstatics torsion modes -f json``."""
    sensitivity = record({"stiffness": NAMED, "inertia": NAMED})
    mode = schema_of(Mode, frequency=NUMBER, sensitivity=sensitivity)
    damped = list_of(record({"real": NUMBER, "imag": NUMBER}))
    gear = schema_of(GearModes, modes=list_of(mode), damped=damped)
    return _document(
        "modes", "Natural modes, of vstatics torsion modes", made.MODES, gears=_of_gears(gear)
    )


def reduction_schema() -> Schema:
    """The schema of ``vstatics torsion reduce -f json``."""
    return _document(
        "reduction",
        "Reduced inertias and compliances, of vstatics torsion reduce",
        made.REDUCTION,
        to=TEXT,
        gears=_of_gears(schema_of(GearReduction)),
    )


def simplification_schema() -> Schema:
    """The schema of ``vstatics torsion simplify -f json``."""
    return _document(
        "simplification",
        "A simpler scheme, of vstatics torsion simplify",
        made.SIMPLIFICATION,
        gear=TEXT,
        rule=schema_of(SimplificationRule),
        steps=list_of(schema_of(SimplificationStep)),
        warnings=list_of(TEXT),
    )


def response_schema() -> Schema:
    """The schema of ``vstatics torsion response -f json``."""
    over_speeds = schema_of(Mapping[str, tuple[float, ...]])
    total = {
        **over_speeds,
        "additionalProperties": record(dict.fromkeys(("largest", "rms"), list_of(NUMBER))),
    }
    gear = record(
        {
            "name": TEXT,
            "speeds": list_of(NUMBER),
            "orders": list_of(
                record({"order": NUMBER, "amplitudes": over_speeds, "torques": over_speeds})
            ),
            "sum": record({"amplitudes": total, "torques": total}),
            "resonances": list_of(schema_of(Resonance)),
        },
        optional=["sum"],
    )
    return _document(
        "response",
        "Forced vibration, of vstatics torsion response",
        made.RESPONSE,
        at=TEXT,
        gears=_of_gears(gear),
    )


def identification_schema() -> Schema:
    """The schema of ``vstatics torsion identify -f json``."""
    return _document(
        "identification",
        "Compliances by a measured frequency, of vstatics torsion identify",
        made.IDENTIFICATION,
        gear=TEXT,
        mode=COUNT,
        measured=NUMBER,
        **schema_of(Identified)["properties"],
    )


def damping_schema() -> Schema:
    """The schema of ``vstatics torsion damping -f json``."""
    values = schema_of(Damped)["properties"]
    del values["notes"]
    return _document(
        "damping",
        "Dampings by decrements, of vstatics torsion damping",
        made.DAMPING,
        gear=TEXT,
        mode=COUNT,
        **values,
        messages=list_of(TEXT),
    )


def _document(name: str, title: str, form: str, **parts: Schema) -> Schema:
    """A document about a case."""
    return documents(name, title, record({**head(form, made.VERSION), "case": TEXT, **parts}))


def _of_gears(gear: Schema) -> Schema:
    """Entries of gears; one that can't be calculated has an error in place of all else."""
    values = {name: one for name, one in gear["properties"].items() if name != "error"}
    optional = [name for name in values if name not in gear["required"]]
    return list_of(
        {
            "if": {"required": ["error"]},
            "then": record({"name": TEXT, "error": TEXT}),
            "else": record(values, optional),
        }
    )
