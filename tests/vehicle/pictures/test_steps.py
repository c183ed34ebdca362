"""Steps between gears: quotients of ratios, and laws that they are compared with."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from matplotlib.patches import Polygon

from tests.commands import CASES, SHIPPED, json_answer
from tests.pictures.test_pictures import overlaps
from tests.shipped import shipped_results
from tests.vehicle.pictures.cars import box, marks
from vstatics import CaseError, load, solve
from vstatics.pictures import picture
from vstatics.pictures.drawing.style import Style
from vstatics.vehicle.pictures.laws import geometric, progressive


def test_a_step_is_a_ratio_over_the_next_one() -> None:
    ratios = [3.5, 2.1, 1.4, 1.0, -3.0]
    cells = marks(box(ratios, vehicle=None), "steps", "step")
    assert [float(one["ratio"]) for one in cells] == ratios[:4]
    told = [float(one["step"]) for one in cells if "step" in one]
    assert told == pytest.approx([one / other for one, other in pairwise(ratios[:4])])
    assert "step" not in cells[-1]


def test_a_final_drive_that_turns_the_sign_keeps_it_in_ratios_and_not_in_steps() -> None:
    cells = marks(box([-3.0, -2.0, -1.0, 2.5], vehicle=None), "steps", "step")
    assert [float(one["ratio"]) for one in cells] == [-3, -2, -1]
    assert [float(one["step"]) for one in cells[:2]] == [1.5, 2]


def test_steps_are_those_of_a_sweep_and_of_the_summary() -> None:
    case = CASES / "ford-10r80.yaml"
    cells = marks(solve(load(case)), "steps", "step")
    answer = json_answer("summary", case)
    steps = {one["gear"]: one["step"] for one in answer["gears"] if one["step"] is not None}
    assert {one["gear"]: float(one["step"]) for one in cells if "step" in one} == pytest.approx(
        steps
    )


def test_cells_are_as_long_as_logarithms_of_steps() -> None:
    figure = picture(box([4.0, 2.0, 1.0, 0.25]), "steps", Style())
    boxes = [
        one.get_path().get_extents()
        for one in figure.artists
        if isinstance(one, Polygon) and "step" in str(one.get_gid())
    ]
    lengths = [one.width for one in boxes]
    assert np.array(lengths) / lengths[0] == pytest.approx([1, 1, 2])


def test_laws_keep_the_ends_and_fit_between() -> None:
    """Steps that grow by a factor are found again; any other factor fits worse."""
    steps = 1.2 * 1.07 ** np.arange(6)[::-1]
    ratios = [*(np.cumprod(steps[::-1])[::-1] * 0.7), 0.7]
    made = progressive(ratios)
    assert made.growth == pytest.approx(1.07)
    assert made.ratios == pytest.approx(ratios)
    assert geometric(ratios).steps == pytest.approx([float(np.prod(steps) ** (1 / 6))] * 6)
    assert (geometric(ratios).ratios[0], geometric(ratios).ratios[-1]) == (ratios[0], 0.7)


def test_one_forward_gear_has_no_steps() -> None:
    with pytest.raises(CaseError, match="two forward gears with") as caught:
        picture(box([2.0, -3.0]), "steps", Style())
    assert caught.value.problems[0].id == "E444"


@pytest.mark.parametrize(
    "path", [pytest.param(one, marks=pytest.mark.slow) for one in SHIPPED], ids=lambda one: one.name
)
def test_no_text_of_any_shipped_case_covers_another(path: Path) -> None:
    results = solve(load(path))
    try:
        assert overlaps(results, "steps", Style("ru")) == []
    except CaseError as error:
        assert error.problems[0].id == "E444"  # noqa: PT017 - few have one gear


def test_numbers_of_steps_stand_in_their_cells_in_a_column() -> None:
    """Of 85 mm: names of rows give way; upright no number is wider than its cell."""
    results = shipped_results("zf-9hp48.yaml")
    assert overlaps(results, "steps", Style("ru", width=85 / 25.4 * 72)) == []
