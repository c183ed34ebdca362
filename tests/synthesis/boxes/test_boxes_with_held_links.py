"""Cases of boxes with a member that is held for good keep it, in files and for their teeth."""

import pytest

from vstatics.core.explain.bodies import on_own_links
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers import read
from vstatics.core.writers import deck
from vstatics.core.writers.named import mapping, write_json, write_yaml
from vstatics.synthesis.boxes.box import FoundBox
from vstatics.synthesis.boxes.figures.case import box_case
from vstatics.synthesis.structures.scheme import SetScheme
from vstatics.synthesis.teeth.layout import teeth_layouts

MEMBERS = ("sun", "carrier", "ring")
SETS = [(-2.5, "planetary"), (2.5, "double_planet")]


def _case(held: int, ratio: float) -> Transmission:
    """One set with a member that is held, from one of the others to the third, locked too."""
    first, last = (link for link in range(3) if link != held)
    scheme = SetScheme(((0, 1, 2),))
    box = FoundBox(scheme, held, first, last, ((first, last),), (ratio,), ((0,),), 0.0)
    return box_case(box, [1.0], 0.98)


@pytest.mark.parametrize("held", range(3))
@pytest.mark.parametrize(("ratio", "kind"), SETS)
def test_a_held_member_is_kept(held: int, ratio: float, kind: str) -> None:
    case = _case(held, ratio)
    key = {"sun": "first", "ring": "second", "carrier": "third"}[MEMBERS[held]]
    assert mapping(case)["mechanisms"]["P1"][key] == "housing"
    assert read(write_yaml(case).encode(), "a.yaml").case.mechanisms == case.mechanisms
    assert read(write_json(case).encode(), "a.json").case == case
    (layout,) = teeth_layouts(on_own_links(case))
    assert layout.element.kind == kind
    assert layout.element.link(MEMBERS[held]) == 0


@pytest.mark.parametrize(("third", "is_set"), [("", False), (", third: housing", True)])
def test_a_pair_has_no_third_link(third: str, is_set: bool) -> None:
    text = (
        f"links: 2\nmechanisms: {{g: {{first: 1, second: 2{third}, ratio: 2}}}}\ngears: {{1: {{}}}}"
    )
    case = read(text.encode(), "a.yaml").case
    assert case.mechanisms[0].is_set is is_set
    assert ("third" in mapping(case)["mechanisms"]["g"]) is is_set
    assert ("third: housing of mechanism g" in deck.lost(case)) is is_set
