"""Documents of found boxes, read again."""

import copy
import json
from collections.abc import Callable
from typing import Any

import pytest

from tests.chance import count, seeded
from tests.synthesis.boxes import hand_boxes
from tests.synthesis.boxes.listed_boxes import many, simpson, zf_6hp
from vstatics import ReadError
from vstatics.synthesis.boxes.figures.case import box_case
from vstatics.synthesis.boxes.listing import drawn_boxes
from vstatics.synthesis.boxes.reading import is_document, listing_of, read_document


def read(document: Any) -> Any:
    return read_document(json.dumps(document).encode(), "boxes.json")[0]


def test_a_box_is_what_was_written() -> None:
    document = zf_6hp()
    [box] = read(document).boxes
    given = document["boxes"][0]
    assert (box.number, box.code, box.family, box.pareto) == (1, given["code"], 1, True)
    assert box.elements["T-L0"] == ("L0", "housing")
    assert dict(box.ratios) == given["ratios"]
    assert box.gears["R"].target == hand_boxes.ZF_6HP_SEARCH.targets[-1]
    assert (box.brakes, box.clutches, box.loss) == (2, 3, given["loss"])
    assert (box.known, dict(box.ravigneaux)) == ("zf-6hp26", {"P1-P2": ("P1", "P2")})
    assert (box.core, box.drag, list(box.beyond)) == (1, given["drag"], given["beyond"])
    assert dict(box.gears["1"].torques) == given["gears"]["1"]["torques"]
    assert [gear.name for gear in box.transmission().gears] == list(given["gears"])
    own = box_case(hand_boxes.ZF_6HP, hand_boxes.ZF_6HP_SEARCH.targets, 0.98)
    written = sorted(one.ratio for one in box.transmission().mechanisms)
    assert written == sorted(one.ratio for one in own.mechanisms)


WRONG: dict[str, Callable[[Any], Any]] = {
    "box 2: expected the key `loss`": lambda one: one.pop("loss"),
    "box 2.loss: read str 'low', expected a number": lambda one: one.update(loss="low"),
    "box 2.family: read float 1.5, expected a count": lambda one: one.update(family=1.5),
    "box 2.single: read int 1, expected true or false": lambda one: one.update(single=1),
    "box 2.gears.1.engaged: read str 'A'": lambda one: one["gears"]["1"].update(engaged="A"),
    "box 2.beyond: read list ['a'], expected a list of": lambda one: one.update(beyond=["a"]),
    "box 2.gears: read list [], expected an object": lambda one: one.update(gears=[]),
    "box 2.elements.A: read int 3, expected a list": lambda one: one["elements"].update(A=3),
}
WISHES = {
    "wanted.ratios: read list [[2.0, -1.0]], expected a list of r": {"ratios": [[2.0, -1.0]]},
    "wanted.ratios: read list [[0.0, 3.0]], expected a list of ra": {"ratios": [[0.0, 3.0]]},
    "wanted.gears: read list [6], expected two numbers or none": {"gears": [6]},
    "wanted.tolerance: read str 'low', expected a number": {"tolerance": "low"},
}
TEXTS = {
    ":1:1: error: not valid JSON: Expecting value; expected a document of found": b"",
    "expected a document of found boxes": b"[]",
    "box 1: read int 3, expected an object": b'{"searched": 1, "boxes": [3]}',
    "read NaN, expected a number or null": b'{"searched": NaN, "boxes": []}',
    "the JSON cannot be read": b"\xff\xfe",
    "nested too deeply": b"[" * 100_000,
}


def refused(text: bytes) -> ReadError:
    with pytest.raises(ReadError) as caught:
        read_document(text, "boxes.json")
    return caught.value


def test_what_is_wrong_is_reported_where_it_is() -> None:
    documents: dict[str, Any] = {}
    for said, change in WRONG.items():
        documents[said] = many(3)
        change(documents[said]["boxes"][1])
    for said, wish in WISHES.items():
        documents[said] = simpson()
        documents[said]["wanted"] |= wish
    documents["wanted: read int 3, expected an object"] = simpson() | {"wanted": 3}
    for said, document in documents.items():
        text = str(refused(json.dumps(document).encode()))
        assert text.startswith(f"boxes.json: error: {said}")
    for said, data in TEXTS.items():
        assert said in str(refused(data))
        assert not is_document(data) or b"boxes" in data
    document = many(60)
    for box in document["boxes"]:
        box["loss"] = "x"
    assert len(refused(json.dumps(document).encode()).problems) == 20


def test_a_case_that_is_none_is_reported_with_its_box() -> None:
    document = many(2)
    document["boxes"][1]["case"] = {"links": 3}
    with pytest.raises(ReadError, match=r"case of box 2: .*mechanisms"):
        read(document).boxes[1].transmission()


def test_what_gets_a_diagram() -> None:
    """The Pareto list has boxes 1, 16, 31, ...; the other families begin with 4, 7, 10, ..."""
    listing = listing_of(many(40))
    assert [box.number for box in drawn_boxes(listing, 3)] == [1, 16, 31]
    assert [box.number for box in drawn_boxes(listing, 5)] == [1, 4, 7, 16, 31]
    assert [box.number for box in drawn_boxes(listing, 15)] == sorted([2, *range(1, 41, 3)])
    assert len(drawn_boxes(listing, 100)) == 40


@pytest.mark.parametrize("document", [simpson, zf_6hp])
def test_what_was_edited_in_a_box_or_in_its_case_alone_is_named(document: Any) -> None:
    """A ratio of a set by a random part, engaged elements of a gear, the name of a gear."""
    original = document()
    assert not [*read(original).boxes[0].contradictions()]
    other = copy.deepcopy(original)
    other["boxes"][0]["gears"]["2"]["ratio"] = 1.5
    [told] = read(other).boxes[0].contradictions()
    assert told.startswith("the ratio of gear 2 is 1.5, but ")
    rng = seeded(25)
    for _ in range(count(15, 200)):
        edited = copy.deepcopy(original)
        box = edited["boxes"][0]
        case, name = box["case"], rng.choice([*box["gears"]])
        parts = [(one, "ratio", key) for key, one in case["mechanisms"].items()]
        for element in case.get("elements", {}).values():
            parts += [(element["ratios"], key, "P") for key in element["ratios"]]
        parts += [(box["ratios"], key, key) for key in box["ratios"]]
        match rng.randrange(4):
            case 0 | 1:
                numbers, key, said = rng.choice(parts)
                numbers[key] *= 1 + rng.choice((1, -1)) * 10 ** rng.uniform(-8, -3)
                said = f"the ratio of set {said}"
            case 2:
                there = rng.choice((box, case))["gears"][name]
                others = [one for one in box["elements"] if one not in there["engaged"]]
                there["engaged"][rng.randrange(2)] = rng.choice(others)
                said = f"gear {name} engages "
            case _:
                gears = rng.choice((box, case))["gears"]
                gears["other"] = gears.pop(name)
                said = "its gears are "
        told = [*read(edited).boxes[0].contradictions()]
        assert any(one.startswith(said) for one in told), (said, told)
