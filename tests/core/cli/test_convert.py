"""Cases from one format to another: nothing is lost without a word."""

from dataclasses import replace
from pathlib import Path

import pytest

import vstatics as library
from tests.chance import some
from tests.commands import MZKT, NEUTRAL, SHIPPED, json_file, vstatics
from vstatics.core.model.transmission import Transmission
from vstatics.core.writers import deck

SUFFIXES = {"deck": ".dat", "yaml": ".yaml", "json": ".json"}
KEEPS_ALL = ("yaml", "json")


def kept(case: Transmission, form: str) -> Transmission:
    """What a format keeps of a case.

    A deck has no place for description, source, load, further outputs and operating points;
    it has mechanisms in place of elements, and freewheels are engaged where they hold.
    """
    if form in KEEPS_ALL:
        return case
    settled = library.solve(case).with_numbers_only
    plain = [element._replace(kind="") for element in settled.shift_elements]
    gears = [gear._replace(kind="gear") for gear in settled.gears]
    bare = {"description": "", "source": "", "load": None, "drawing": None, "outputs": ()}
    return replace(settled, shift_elements=plain, gears=gears, **bare)  # type: ignore[arg-type]


def suffixes(case: Transmission) -> dict[str, str]:
    """The formats that can hold a case; a deck has no springs and no inertias."""
    no_deck = case.springs or case.inertias
    return {form: SUFFIXES[form] for form in KEEPS_ALL} if no_deck else SUFFIXES


@pytest.mark.slow
@pytest.mark.parametrize("path", some(SHIPPED), ids=lambda path: path.name)
def test_a_shipped_case_goes_round_all_formats(path: Path, tmp_path: Path) -> None:
    case = library.load(path)
    for form, suffix in suffixes(case).items():
        target = tmp_path / f"first{suffix}"
        said = vstatics("convert", path, target)
        lost = [] if form in KEEPS_ALL else deck.lost(case)
        expected = [f"{target}: not kept: {word}" for word in lost]
        assert (said.status, said.out) == (1 if expected else 0, "")
        assert [line for line in said.err.splitlines() if "not kept" in line] == expected
        assert library.load(target) == kept(case, form)
        for again, ending in suffixes(case).items():
            second = tmp_path / f"second{ending}"
            vstatics("convert", target, second)
            assert library.load(second) == kept(library.load(target), again)


def test_the_option_is_above_the_suffix(tmp_path: Path) -> None:
    target, back = tmp_path / "case.dat", tmp_path / "back.dat"
    assert vstatics("convert", MZKT, target, "--to", "json").status == 0
    assert json_file(target)["links"] == 6
    assert vstatics("convert", target, back).fails("case.dat:1:1: error")
    assert vstatics("convert", target, back, "--from", "json").status == 0
    assert library.load(back) == library.load(MZKT)


def test_warnings_of_the_input_are_reported_and_it_is_converted(folder: Path) -> None:
    """A planetary set with u > 0 and no planet ratio has no planet speed: a warning."""
    text = NEUTRAL.replace("-2.5", "2.5").encode()
    said = vstatics("convert", "-", "-", "--to", "deck", stdin=text)
    assert (said.status, said.err[:10], "KJG= 3" in said.out) == (0, "<stdin>:3:", True)
    assert ": warning: " in said.err
    words = "nowhere.dat: error: cannot be read"
    assert vstatics("convert", "nowhere.dat", "new.yaml").fails(words)
    assert [*folder.iterdir()] == []


def test_a_conflict_of_freewheels_is_reported_as_a_deck_knows_none() -> None:
    """The output turns backward, which the freewheel there does not let it."""
    text = """
links: 2
shift_elements: {L: {kind: freewheel, links: [2, 0]}}
mechanisms: {pair: {first: 1, second: 2, ratio: -1}}
gears: {R: {}}
"""
    said = vstatics("convert", "-", "-", "--to", "deck", stdin=text.encode())
    assert said.fails("not kept: that gear R is in conflict")
