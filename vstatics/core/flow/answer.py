"""Answer of `vstatics flow`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, NamedTuple

from vstatics.core.flow.power_flow import GearFlow
from vstatics.core.tables.answer import TEXT, Words, document, object_of

CONVENTIONS = {
    "powers": "relative to the power at the input link, in their real direction; times "
    "input_link_kW they are in kW",
    "members": "above 0: from the link to the member",
    "ports": "links with power from outside; the torque of an output is that which it gives to "
    "its load, of another link that which acts on it",
    "throughput": "what enters a node; of a port what passes it",
    "teeth": "power that enters the teeth, against the carrier; of a mechanism as a whole "
    "where there is no mesh",
    "forward": "the edges less all loops",
    "doubtful": "the part of the circulating power that may not be in the metal",
    "loops": "circulating power; a note where it may not be in the metal",
    "locked_in": "loops within what turns as one piece, which do not count",
    "by_convention": "what turns as one piece, and whose part of the power no statics decides",
    "null": "does not exist, or is not determined",
}
"""Meaning of the numbers of an answer, by key."""


@document("vstatics-flow")
class FlowAnswer(NamedTuple):
    """Power flow of the gears of a case, with the name of the case."""

    conventions: Annotated[Mapping[str, str], Words(object_of(dict.fromkeys(CONVENTIONS, TEXT)))]
    case: str
    gears: Sequence[GearFlow]
