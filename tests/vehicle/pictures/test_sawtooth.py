"""Engine speed over road speed: revolutions by ratio and radius."""

import math

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from tests.pictures.drawn import texts
from tests.vehicle.pictures.cars import box, marks
from vstatics.pictures import picture
from vstatics.pictures.drawing.style import Style


def lines(figure: Figure) -> list[tuple[str, np.ndarray]]:
    """What lines say, and their places [pt]."""
    drawn = (one for one in figure.artists if isinstance(one, Line2D))
    return [(str(one.get_gid()), np.asarray(one.get_xydata())) for one in drawn]


def test_revolutions_by_speed_are_those_of_the_wheel_by_the_ratio() -> None:
    """A wheel turns 1/i/i0 as fast: i i0/(2 pi r) revolutions for a metre, 1000/60 metres a minute for 1 km/h."""
    ratios = [3.5, 2.1, 1.0, -3.0]
    lines = marks(box(ratios), "sawtooth", "line")
    assert [one["gear"] for one in lines] == ["1", "2", "3", "4"]
    for ratio, line in zip(ratios, lines, strict=True):
        told = abs(ratio) * 4.1 / (2 * math.pi * 0.3) * 1000 / 60
        assert float(line["rpm-per-kmh"]) == pytest.approx(told, rel=1e-8)


def test_a_shift_at_the_last_speed_leads_to_the_speed_of_the_next_gear() -> None:
    """600 rad/s times 1.5/3 and times 1/1.5, in rpm; the reverse gear is no shift."""
    figure = picture(box([3.0, 1.5, 1.0, -3.2]), "sawtooth", Style())
    drops = [f"{600 * 30 / math.pi * part:.0f}" for part in (1 / 2, 2 / 3)]
    assert {one for one in texts(figure) if one in drops} == {*drops}
    [saw] = [line for said, line in lines(figure) if '"saw"' in said]
    assert len(saw) == 2 * 3


def test_rays_start_at_rest_and_end_with_the_engine() -> None:
    figure = picture(box([3.0, 1.5]), "sawtooth", Style())
    rays = [line for said, line in lines(figure) if "rpm per km/h" in said]
    (start, end), (other, beyond) = rays
    np.testing.assert_allclose(start, other)
    np.testing.assert_allclose((beyond - start)[0], 2 * (end - start)[0])
    np.testing.assert_allclose((beyond - start)[1], (end - start)[1])
