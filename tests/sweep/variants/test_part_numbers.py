"""A changed number of a part is reported under the path that a sweep varies."""

import random
from pathlib import Path

import pytest

from tests.core.comparison.test_case_changes import CASES
from vstatics import CaseError
from vstatics.core import readers
from vstatics.core.comparison.case_changes import case_changes
from vstatics.core.elements.part_numbers import own_part_number, part_numbers, with_part_numbers


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_a_number_that_a_sweep_varies_is_named_by_its_path(path: Path) -> None:
    """The variant is made by the sweep; what else it changes follows from the number."""
    case = readers.load(path)
    numbers = part_numbers(case)
    own = {name: own_part_number(case, number) for name, number in numbers.items()}
    known = [
        name
        for name, value in own.items()
        if isinstance(value, int | float) and value and numbers[name].kind != "relative_torque"
    ]
    for name in random.Random(path.stem).sample(known, min(4, len(known))):  # noqa: S311
        value = own[name]
        assert isinstance(value, int | float)
        other = value + 1 if isinstance(value, int) else value * 0.9
        try:
            variant = with_part_numbers(case, [numbers[name]], [other])
        except CaseError:
            continue  # such a case can't be
        told = {one.path: (one.expected, one.actual) for one in case_changes(variant, case)}
        assert told == {name: (pytest.approx(value), pytest.approx(other))}
