"""Steps between gears, laws that they are compared with, and engine speed over road speed."""

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon

from tests.commands import SHIPPED
from tests.pictures.drawn import texts
from tests.pictures.test_pictures import overlaps
from tests.shipped import shipped_results
from tests.vehicle.pictures.cars import CAR, box, marks
from vstatics import CaseError, Gear, Mechanism, ShiftElement, Transmission, load, solve
from vstatics.pictures import picture
from vstatics.pictures.drawing.style import Style
from vstatics.vehicle.operation.converter import bare
from vstatics.vehicle.pictures.laws import geometric, progressive


def test_a_step_is_a_ratio_over_the_next_one() -> None:
    for sign in (1, -1):
        ratios = [sign * ratio for ratio in (3.5, 2.1, 1.4, 1.0, -3.0)]
        cells = marks(box(ratios, vehicle=None), "steps", "step")
        assert [float(cell["ratio"]) for cell in cells] == ratios[:4]
        steps = [float(cell["step"]) for cell in cells[:-1]]
        assert steps == pytest.approx([ratio / after for ratio, after in pairwise(ratios[:4])])
        assert "step" not in cells[-1]


def test_cells_are_as_long_as_logarithms_of_steps() -> None:
    figure = picture(box([4.0, 2.0, 1.0, 0.25]), "steps", Style())
    drawn = [one for one in figure.artists if isinstance(one, Polygon)]
    lengths = np.array(
        [one.get_path().get_extents().width for one in drawn if "step" in str(one.get_gid())]
    )
    assert lengths / lengths[0] == pytest.approx([1, 1, 2])


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


def lines(figure: Figure) -> list[tuple[str, np.ndarray]]:
    drawn = (one for one in figure.artists if isinstance(one, Line2D))
    return [(str(one.get_gid()), np.asarray(one.get_xydata())) for one in drawn]


def test_revolutions_by_speed_are_those_of_the_wheel_by_the_ratio() -> None:
    """A wheel turns 1/i/i0 as fast: i i0/(2 pi r) per metre, 1000/60 metres a minute at 1 km/h."""
    ratios = [3.5, 2.1, 1.0, -3.0]
    drawn = marks(box(ratios), "sawtooth", "line")
    assert [one["gear"] for one in drawn] == ["1", "2", "3", "4"]
    for ratio, line in zip(ratios, drawn, strict=True):
        told = abs(ratio) * 4.1 / (2 * math.pi * 0.3) * 1000 / 60
        assert float(line["rpm-per-kmh"]) == pytest.approx(told, rel=1e-8)


def test_a_shift_at_the_last_speed_leads_to_the_speed_of_the_next_gear() -> None:
    """600 rad/s times 1.5/3 and times 1/1.5, in rpm; the reverse gear is no shift."""
    figure = picture(box([3.0, 1.5, 1.0, -3.2]), "sawtooth", Style())
    drops = {f"{600 * 30 / math.pi * part:.0f}" for part in (1 / 2, 2 / 3)}
    assert drops <= {*texts(figure)}
    [saw] = [line for said, line in lines(figure) if '"saw"' in said]
    assert len(saw) == 2 * 3


def test_an_engine_with_a_converter_starts_at_its_stall_speed() -> None:
    """It takes 200 N*m at sqrt(200/0.002) rad/s, of 500; locked up, the ray starts at rest."""
    car = CAR._replace(engine=[(0.0, 200.0), (500.0, 200.0)])
    points = ((0.0, 2.0, 0.002), (1.0, 1.0, 0.0))
    parts = [Mechanism(1, 2, 0, math.nan, kind="converter", points=points, name="TC")]
    parts.append(Mechanism(2, 3, 0, 3.0))
    gears = [Gear(name="1"), Gear([1], name="1L")]
    case = Transmission(3, [ShiftElement(1, 2)], parts, gears, vehicle=car)
    figure = picture(solve(bare(case))._replace(case=case), "sawtooth", Style())
    curve, ray = [line for said, line in lines(figure) if "rpm per km/h" in said]
    height = (curve[0, 1] - ray[0, 1]) / (ray[1, 1] - ray[0, 1])
    assert height == pytest.approx(math.sqrt(200 / 0.002) / 500, rel=1e-6)


def test_rays_start_at_rest_and_end_with_the_engine() -> None:
    figure = picture(box([3.0, 1.5]), "sawtooth", Style())
    rays = [line for said, line in lines(figure) if "rpm per km/h" in said]
    (start, end), (other, beyond) = rays
    np.testing.assert_allclose(start, other)
    np.testing.assert_allclose((beyond - start) / (end - start), [2, 1])
