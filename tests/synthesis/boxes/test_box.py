"""What can't be searched for is told with the option that has the mistake.

Links: a connected scheme of N sets that leaves two degrees of freedom or more has N + 2 to
2 N + 1 (docs/synthesis/method.md); one with K held members, in parts or not, up to 3 N - K + 1,
as no other members need share a link. With shafts beside the sets these have fewer links, and so
more elements are engaged. Elements: brakes on all links but input and output, clutches between
any two.
"""

import math
from typing import Any

import pytest

from tests.rejects import rejects
from vstatics.core.errors import CaseError
from vstatics.synthesis.boxes.box import BoxSearch, check_box_search, elements_there, engaged_range

EIGHT = (4.70, 3.13, 2.10, 1.67, 1.28, 1.0, 0.84, 0.67, -3.30)
SIMPSON: dict[str, Any] = {"sets": 2, "elements": 4, "engaged": 2, "targets": (2.46, 1.46, 1, -2.2)}
LEPELLETIER: dict[str, Any] = {"sets": 3, "engaged": 2, "fixed": 1, "targets": EIGHT[:6]}
ONE: dict[str, Any] = {"sets": 1, "elements": 2, "engaged": 1, "targets": (3.0, 1.0)}


def search(**given: Any) -> BoxSearch:
    """A search of the eight-speed of four sets, but for what is given."""
    eight: dict[str, Any] = {"sets": 4, "elements": 5, "engaged": 3, "targets": EIGHT}
    return BoxSearch(**(eight | given))


def test_what_gearboxes_have_can_be_asked_for() -> None:
    """Four sets have eight links, Lepelletier seven (one is held), Simpson four and a shaft."""
    ten = search(elements=6, engaged=4, targets=(*EIGHT, 5.0), shafts=1)
    lepelletier, simpson = search(**LEPELLETIER), search(**SIMPSON, own_input=True)
    assert elements_there(search()) == (6, 28)
    assert (lepelletier.links, elements_there(lepelletier)) == (7, (4, 15))
    assert (ten.links, elements_there(ten)) == (8, (7, 36))
    assert (elements_there(simpson), engaged_range(simpson)) == ((3, 10), range(2, 4))
    held = search(**SIMPSON | {"elements": 3, "fixed": 1, "targets": (3.0, 1.0)})
    joined = search(**ONE | {"engaged": 2, "targets": (1.0,), "own_input": True})
    for one in (search(), simpson, search(**LEPELLETIER, meshed=1), held, search(**ONE), joined):
        check_box_search(one)


def test_a_mistake_is_reported_with_its_option() -> None:
    for given, told in (
        ({"sets": 0}, "sets: read 0, expected 1 to"),
        ({"meshed": 5}, "meshed: read 5, expected 0 to 4"),
        ({"fixed": -1}, "fixed: read -1, expected 0 to 4"),
        ({"bounds": (1.0, 5.0)}, "bounds: read 1:5, expected two numbers above 1"),
        ({"bounds": (2.0, math.inf)}, "bounds: read 2:inf"),
        ({"bounds": (math.nan, 5.0)}, "bounds: read nan:5"),
        ({"tolerance": 0.0}, "tolerance: read 0, expected a number above 0"),
        ({"targets": ()}, "ratios: read none"),
        ({"targets": (2.0, 0.0)}, "ratios: read 0, expected a ratio of"),
        ({"targets": (2.0, math.nan)}, "ratios: read nan"),
        ({"targets": (2.0, 2.0)}, "ratios: read 2 twice"),
        ({"targets": tuple(range(1, 64))}, "ratios: read 63, expected 62 at most"),
        ({"engaged": 5}, "engaged: read 5, but 4 sets leave 1 to 4"),
        ({"engaged": 7, "fixed": 2}, "engaged: read 7, but 4 sets with held members leave 1 to 5"),
        ({**SIMPSON, "engaged": 1, "own_input": True}, "of its own leave 2 or 3 to be engaged"),
        ({"sets": 1, "fixed": 1, "engaged": 1}, "leaves none to be engaged"),
        ({"shafts": -1}, "shafts: read -1, expected 0 to 10"),
        ({**SIMPSON, "shafts": 1, "own_output": True}, "its own and 1 further shaft leave 3 or 4"),
        ({**SIMPSON, "sets": 1, "engaged": 3, "shafts": 2}, "so that 3 join each of 2 shafts"),
        ({"elements": 2}, "elements: read 2, expected 3, which are engaged, to 12"),
        ({**ONE, "elements": 5}, "which are engaged, to 4, all that there are (1"),
        ({"elements": 4}, "ratios: read 9 ratios, but 4 elements with 3 engaged give 4 gears"),
        ({"targets": (2.0,)}, "elements: read 5, but 1 gear with 3 engaged cannot use more than 3"),
    ):
        with rejects(CaseError, told):
            check_box_search(search(**given))


def test_several_mistakes_are_reported_together() -> None:
    with pytest.raises(CaseError) as error:
        check_box_search(search(meshed=9, tolerance=2.0, targets=(0.0, math.inf)))
    paths = [one.path for one in error.value.problems]
    assert paths == [("meshed",), ("tolerance",), ("ratios",), ("ratios",)]
