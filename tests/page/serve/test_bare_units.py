"""A field tells the unit of a bare number: with this unit written behind it nothing is other."""

from pathlib import Path

import pytest

from tests.commands import CASES
from vstatics.core import readers
from vstatics.core.readers.named.nodes import encoding_of
from vstatics.page.serve.document_fields import documents_of, spots_of
from vstatics.simulation.scenario.file import case_bytes, read_scenario


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
