"""Documents of found boxes, read again."""

import copy
import json
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


def test_the_case_of_a_box_comes_back_with_all_its_numbers() -> None:
    search, box = hand_boxes.SIMPSON_SEARCH, hand_boxes.SIMPSON
    [listed] = listing_of(simpson()).boxes
    own = box_case(box, search.targets, 0.98)
    assert sorted(one.ratio for one in listed.transmission().mechanisms) == sorted(
        one.ratio for one in own.mechanisms
    )


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda one: one.pop("loss"), "box 2: expected the key `loss`"),
        (lambda one: one.update(loss="low"), "box 2.loss: read str 'low', expected a number"),
        (lambda one: one.update(family=1.5), "box 2.family: read float 1.5, expected a count"),
        (lambda one: one.update(single=1), "box 2.single: read int 1, expected true or false"),
        (lambda one: one["gears"]["1"].update(engaged="A"), "box 2.gears.1.engaged: read str 'A'"),
        (lambda one: one.update(beyond=["a"]), "box 2.beyond: read list ['a'], expected a list of"),
        (lambda one: one.update(gears=[]), "box 2.gears: read list [], expected an object"),
        (lambda one: one["elements"].update(A=3), "box 2.elements.A: read int 3, expected a list"),
    ],
)
def test_what_is_wrong_is_told_at_its_box(change: Any, said: str) -> None:
    document = many(3)
    change(document["boxes"][1])
    with pytest.raises(ReadError) as caught:
        read(document)
    assert str(caught.value).startswith(f"boxes.json: error: {said}")


@pytest.mark.parametrize(
    ("wanted", "said"),
    [
        (3, "wanted: read int 3, expected an object"),
        ({"ratios": [[2.0, -1.0]]}, "wanted.ratios: read list [[2.0, -1.0]], expected a list of r"),
        ({"gears": [6]}, "wanted.gears: read list [6], expected two numbers or none"),
        ({"tolerance": "low"}, "wanted.tolerance: read str 'low', expected a number"),
    ],
)
def test_what_is_wrong_with_the_wish_is_told(wanted: Any, said: str) -> None:
    document = simpson()
    document["wanted"] = document["wanted"] | wanted if isinstance(wanted, dict) else wanted
    with pytest.raises(ReadError) as caught:
        read(document)
    assert str(caught.value).startswith(f"boxes.json: error: {said}")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            b"",
            "boxes.json:1:1: error: not valid JSON: Expecting value; expected a document of found",
        ),
        (b"[]", "expected a document of found boxes"),
        (b'{"searched": 1, "boxes": [3]}', "box 1: read int 3, expected an object"),
        (b'{"searched": NaN, "boxes": []}', "read NaN, expected a number or null"),
        (b"\xff\xfe", "the JSON cannot be read"),
        (b"[" * 100_000, "nested too deeply"),
    ],
)
def test_what_is_no_document_of_boxes_is_told(text: bytes, said: str) -> None:
    with pytest.raises(ReadError) as caught:
        read_document(text, "boxes.json")
    assert said in str(caught.value)
    assert not is_document(text) or b"boxes" in text


def test_many_mistakes_are_told_up_to_some() -> None:
    document = many(60)
    for box in document["boxes"]:
        box["loss"] = "x"
    with pytest.raises(ReadError) as caught:
        read(document)
    assert len(caught.value.problems) == 20


def test_a_case_that_is_none_is_told_with_its_box() -> None:
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
    rng = seeded(25)
    for _ in range(count(15, 200)):
        edited = copy.deepcopy(original)
        box = edited["boxes"][0]
        case, name = box["case"], rng.choice([*box["gears"]])
        parts = [
            *((one, "ratio", key) for key, one in case["mechanisms"].items()),
            *((one["ratios"], own, "P") for one in case.get("elements", {}).values() for own in one["ratios"]),
            *((box["ratios"], key, key) for key in box["ratios"]),
        ]  # fmt: skip
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


def test_a_ratio_of_a_gear_that_its_case_does_not_have_is_named() -> None:
    edited = simpson()
    edited["boxes"][0]["gears"]["2"]["ratio"] = 1.5
    assert [*read(edited).boxes[0].contradictions()] == [
        "the ratio of gear 2 is 1.5, but 1.47945205 in its `case`"
    ]
