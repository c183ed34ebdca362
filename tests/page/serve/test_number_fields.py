"""Fields of a page: numbers of a case at the paths of a sweep, and units of bare numbers."""

from pathlib import Path

import pytest

import vstatics
from tests.commands import CASES
from vstatics.core import readers
from vstatics.core.readers.named.nodes import encoding_of
from vstatics.page.serve.document_fields import documents_of, spots_of
from vstatics.page.serve.number_fields import case_fields, shown_fields
from vstatics.simulation.scenario.file import case_bytes, read_scenario


def test_teeth_of_a_drawn_case_are_fields_and_its_mechanisms_are_not() -> None:
    fields = {one.path: one for one in case_fields(vstatics.load(CASES / "ford-10r80.yaml"))}
    teeth = [45, 95, 51, 89, 73, 119, 23, 85]  # as the file lists them
    assert [one.value for one in fields.values() if one.whole] == teeth
    assert not any(path.endswith(".ratio") for path in fields)


def test_a_field_has_a_slider_that_can_stand_where_the_number_is() -> None:
    fields = [*case_fields(vstatics.load(CASES / "power-split.yaml"))]
    shown = "".join(shown_fields(fields))
    for one in fields:
        low, high = one.limits
        assert low <= one.value <= high
        assert shown.count(f'data-path="{one.path}"') == 2


def test_the_first_point_of_a_law_is_no_field() -> None:
    for efficiency in ("{over: torque, points: [[0, .9], [100, .97]]}", ".9"):
        text = "links: [a, b]\nload: {speed: 2000 rpm, torque: 100 N*m}\ngears: {1: []}\n"
        text += f"mechanisms: {{D: {{first: a, second: b, ratio: 2, efficiency: {efficiency}}}}}\n"
        paths = {field.path for field in case_fields(vstatics.loads(text))}
        assert ("D.efficiency" in paths) == (efficiency == ".9")


def with_units(data: bytes, file: str, units: dict[tuple[str, ...], str]) -> tuple[bytes, int]:
    """A document in which each bare number has its unit."""
    text, written = data.decode(encoding_of(data)), 0
    spots = sorted(spots_of(file, data).items(), key=lambda one: one[1].start, reverse=True)
    for keys, spot in spots:
        if units.get(keys) and not spot.unit:
            text = f"{text[: spot.start]}({text[spot.start : spot.end]}) {units[keys]}{text[spot.end :]}"
            written += 1
    return text.encode(), written


@pytest.mark.parametrize(
    "path", sorted((CASES / "scenarios").glob("*.yaml")), ids=lambda path: path.stem
)
def test_with_its_unit_a_number_is_the_same(path: Path) -> None:
    data = path.read_bytes()
    document = read_scenario(data, str(path))
    of_case, case_file, *_ = case_bytes(document)
    reading = readers.read(of_case, case_file)
    made = documents_of({str(path): data, case_file: of_case}, reading.case)
    units = [
        {one.keys: one.field.unit for one in made.numbers.values() if one.file == file}
        for file in (str(path), case_file)
    ]
    told, written = with_units(data, str(path), units[0])
    assert written >= 3
    again = read_scenario(told, str(path)).with_case(reading)
    assert again.scenario == document.with_case(reading).scenario
    case_told, _ = with_units(of_case, case_file, units[1])
    assert readers.read(case_told, case_file).case == reading.case
