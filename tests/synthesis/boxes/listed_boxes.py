"""Documents of found boxes for tests of pictures and pages: gearboxes that are built."""

import copy
import json
from functools import cache
from typing import Any

from tests.synthesis.boxes import hand_boxes
from vstatics.core.tables.answer import plain_data
from vstatics.synthesis.boxes.box import BoxSearch, FoundBox
from vstatics.synthesis.boxes.choice import BoxFilter, ranked
from vstatics.synthesis.boxes.figures.measured import measured
from vstatics.synthesis.boxes.listing import BoxListing, listed_box, wanted_of


@cache
def _text(search: BoxSearch, box: FoundBox) -> str:
    [found] = ranked(search, [measured(search, box, 0.98)], BoxFilter())
    listing = BoxListing(27_885, (listed_box(1, found),), wanted=wanted_of(search))
    return json.dumps(plain_data(listing))


def _document(search: BoxSearch, box: FoundBox) -> dict[str, Any]:
    document: dict[str, Any] = json.loads(_text(search, box))
    return document


def simpson() -> dict[str, Any]:
    """One box, of two sets."""
    return _document(hand_boxes.SIMPSON_SEARCH, hand_boxes.SIMPSON)


def zf_6hp() -> dict[str, Any]:
    """One box, with meshed planets and a sun that is held for good."""
    return _document(hand_boxes.ZF_6HP_SEARCH, hand_boxes.ZF_6HP)


def many(count: int) -> dict[str, Any]:
    """So many boxes in families of three, of which two coincide; every fifth family is best."""
    document = simpson()
    first = document["boxes"][0]
    document["boxes"] = [copy.deepcopy(first) for _ in range(count)]
    for number, box in enumerate(document["boxes"]):
        family, member = divmod(number, 3)
        box["family"] = family + 1
        box["core"] = number + 1
        box["pareto"] = family % 5 == 0 and member == 0
        box["loss"] = 0.01 + 0.002 * (family % 7) + 0.0001 * family
        box["torque"] = 2.0 + 0.3 * (family % 11) + 0.01 * (member == 2)
    document |= {"found": count, "families": -(-count // 3)}
    return document
