"""Record that `vstatics flow` writes as JSON."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, NamedTuple

from vstatics.core.flow.power_flow import GearFlow
from vstatics.core.tables.answer import TEXT, Words, document, object_of

CONVENTIONS = {
    "powers": "relative to the power at the input link, in the real direction; multiplied by "
    "input_link_kW they are in kW",
    "members": "above 0: from the link to the member",
    "ports": "links with external power; the torque of an output is its torque on the load, the "
    "torque of another port acts on its link",
    "throughput": "power that enters a node, or passes a port",
    "teeth": "power that enters the teeth relative to the carrier; for a mechanism without meshes "
    "the power of the whole mechanism",
    "forward": "the edges without all loops",
    "doubtful": "part of the recirculating power that may be an artefact of the model",
    "loops": "recirculating power; with a note if it may be an artefact of the model",
    "locked_in": "loops within locked-up groups, not counted",
    "by_convention": "locked-up nodes, whose share of the power statics does not determine",
    "null": "undefined or indeterminate",
}
"""Explanations of the numbers in the record, by key."""


@document("vstatics-flow")
class FlowAnswer(NamedTuple):
    """Power flow of the gears of a case."""

    conventions: Annotated[Mapping[str, str], Words(object_of(dict.fromkeys(CONVENTIONS, TEXT)))]
    case: str
    gears: Sequence[GearFlow]
