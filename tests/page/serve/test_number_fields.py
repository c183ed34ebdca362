"""Fields of a page: the numbers that a case gives, by the paths of a sweep."""

import vstatics
from tests.commands import CASES
from vstatics.page.serve.number_fields import case_fields, shown_fields


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
