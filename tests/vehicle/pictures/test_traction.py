"""The traction chart: forces and speeds in closed form, and those of `vstatics summary`."""

from pathlib import Path

import numpy as np
import pytest

from tests.chance import each_seed, generator
from tests.commands import CASES, json_answer
from tests.pictures.drawn import titled
from tests.vehicle.pictures.cars import CAR, ENGINE, box, marks
from vstatics import CaseError, Results, load, solve
from vstatics.pictures import picture
from vstatics.pictures.drawing.style import Style

SLOPES = [0, 5, 10, 15, 20, 30]


@each_seed(5)
def test_random_vehicles_have_the_forces_of_their_closed_form(seed: int) -> None:
    """T i eta i0/r at the largest torque; n r/(i i0) at the last speed of the engine."""
    chance = generator(31, seed)
    ratios = [*sorted(chance.uniform(0.6, 5.0, 4).tolist(), reverse=True), -3.0]
    efficiency, torque, last = chance.uniform([0.8, 50, 300], [1.0, 900, 900])
    car = CAR._replace(engine=[(50.0, torque), (last, torque)], mass=chance.uniform(800, 9000))
    lines = marks(box(ratios, efficiency, car), "traction", "line")
    for ratio, line in zip(ratios, (one for one in lines if "gear" in one), strict=True):
        force = torque * abs(ratio) * efficiency * 4.1 / 0.3
        assert float(line["largest-force"]) == pytest.approx(force, rel=1e-8)
        speed = 3.6 * last * 0.3 / abs(ratio) / 4.1
        assert float(line["largest-speed"]) == pytest.approx(speed, rel=1e-8)
    [power] = [one for one in lines if one.get("name") == "hyperbola"]
    assert float(power["power"]) == pytest.approx(torque * last, rel=1e-8)


def test_the_hyperbola_of_the_largest_power_touches_the_curve_of_a_gear() -> None:
    [gear] = lines_drawn(box([2.0], efficiency=1.0), "gear 1")
    [hyperbola] = lines_drawn(box([2.0], efficiency=1.0), "largest power")
    x, y = gear[-1]
    assert np.interp(x, hyperbola[:, 0], hyperbola[:, 1]) == pytest.approx(y, abs=0.05)


def test_resistance_at_100_is_rolling_and_air() -> None:
    lines = [one for one in marks(box([3.5, 1.5]), "traction", "line") if "slope" in one]
    assert [int(one["slope"]) for one in lines] == SLOPES
    told = 1200 * 9.81 * 0.012 + 0.5 * 1.2 * 0.65 * (100 / 3.6) ** 2
    assert float(lines[0]["force-at-100"]) == pytest.approx(told, rel=1e-8)
    assert not any("force-at-100" in one for one in lines[1:])


def test_top_speeds_and_slopes_are_those_of_the_summary(tmp_path: Path) -> None:
    vehicle = "vehicle: {mass: 1900, radius: .33, rolling: .011, drag_area: .65, final_drive: 3.15,"
    engine = "  engine: [[105, 180], [185, 400], [470, 400], [680, 270]]}"
    case = tmp_path / "box.yaml"
    text = (CASES / "simpson-th400.yaml").read_text("utf-8")
    case.write_text(f"{text}\n{vehicle}\n{engine}\n", "utf-8")
    answer = json_answer("summary", case)["vehicle"]["gears"]
    told = {
        one["gear"]: one for one in marks(solve(load(case)), "traction", "line") if "gear" in one
    }
    assert told.keys() == answer.keys()
    for name, gear in answer.items():
        assert float(told[name]["top-speed"]) == pytest.approx(gear["top_speed"], rel=1e-8)
        slope = float(told[name]["largest-force"]) / (1900 * 9.81) - 0.011
        assert slope == pytest.approx(gear["slope"], rel=1e-7)
        assert float(told[name]["largest-speed"]) >= gear["top_speed"] * (1 - 1e-8)


def lines_drawn(results: Results, said: str) -> list[np.ndarray]:
    """Lines by places in the figure [pt], whose titles begin so."""
    figure = picture(results, "traction", Style())
    return [one.get_xydata() for title, one in titled(figure) if title.startswith(said)]


def test_lines_stand_where_their_numbers_are() -> None:
    """Along a gear force is by torque, speed by engine speed; both as of the hyperbola."""
    results = box([3.0, 1.5])
    [first], [second] = (lines_drawn(results, f"gear {name}:") for name in "12")
    [level, *_] = lines_drawn(results, "resistance at 0")
    left = level[0, 0]
    torques = np.array(ENGINE)[:, 1]
    assert first[:, 0].max() - left == pytest.approx((second[:, 0].max() - left) / 2)
    low = first[:, 1].max() * 2 - second[:, 1].max() * 2 - first[:, 1].max() + second[:, 1].max()
    heights = first[:, 1] - (first[:, 1].max() - 2 * low)
    assert heights.max() / heights.min() == pytest.approx(torques.max() / torques.min())
    [hyperbola] = lines_drawn(results, "largest power")
    foot = first[:, 1].max() - 2 * low
    area = (hyperbola[:, 0] - left) * (hyperbola[:, 1] - foot)
    np.testing.assert_allclose(area, area[0])


def test_a_slope_is_named_where_its_line_leaves_the_panel() -> None:
    """At large speeds air alone may take more than the panel has: steep lines leave at the top."""
    fast = CAR._replace(engine=[(50.0, 200.0), (1600.0, 40.0)])
    figure = picture(box([1.5], vehicle=fast), "traction", Style())
    names = {one.get_text(): one.get_position() for one in figure.texts}
    said = "resistance at "
    roads = {one.removeprefix(said): line for one, line in titled(figure) if one.startswith(said)}
    panels = [line.get_clip_box() for line in roads.values()]
    [top] = {72 / figure.dpi * panel.y1 for panel in panels if panel}
    over = {name: bool(line.get_ydata().max() > top) for name, line in roads.items()}
    assert {*over.values()} == {True, False}
    ends = {n: float(np.interp(top, one.get_ydata(), one.get_xdata())) for n, one in roads.items()}
    for name, line in roads.items():
        x, y = names[name]
        assert (y > top) == over[name]
        if over[name]:  # beside the end of its own line, not of another one
            assert min(ends, key=lambda n: abs(ends[n] - x)) == name
        assert line.get_xdata().max() < max(x for x, _ in names.values())


@pytest.mark.parametrize(
    ("car", "id_", "said"),
    [(None, "E427", "no `vehicle`"), (CAR._replace(engine=()), "E442", "no `engine`")],
)
@pytest.mark.parametrize("kind", ["traction", "sawtooth"])
def test_what_is_missing_is_reported(car: object, id_: str, said: str, kind: str) -> None:
    with pytest.raises(CaseError, match=said) as caught:
        picture(box([2.0], vehicle=car), kind, Style())  # type: ignore[arg-type]
    assert caught.value.problems[0].id == id_
