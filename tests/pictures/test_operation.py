"""Pictures of what operation adds: variators, converters, gears that are dragged."""

from tests.pictures.drawn import texts, titled
from vstatics import Transmission, solve
from vstatics.core.readers import loads
from vstatics.pictures import picture
from vstatics.pictures.drawing.style import Style

SPLIT = """\
links: [engine, turbine, motor, output]
output: output
load: {speed: 2000 rpm, torque: 400 N*m}
mechanisms:
  TC: {kind: converter, first: engine, second: turbine, points: [[0, 2.2], [0.85, 1]]}
  hydro: {kind: variator, first: turbine, second: motor, efficiency: 0.86}
  set: {first: motor, second: turbine, third: output, ratio: -2.2, efficiency: 0.97}
gears: {one: {speed_ratios: {hydro: 0.6, TC: 0.7}}, two: {speed_ratios: {hydro: 0, TC: 0.9}}}
"""


def drawn(kind: str, case: Transmission) -> str:
    figure = picture(solve(case), kind, Style())
    return "\n".join([*texts(figure), *(title for title, _ in titled(figure))])


def test_pictures_of_a_variator_and_a_converter_name_them_and_have_no_nan() -> None:
    for kind in ("plan", "lever", "flow", "structure", "stick"):
        said = drawn(kind, loads(SPLIT))
        assert "hydro" in said or kind == "plan"
        assert "nan" not in said
        if kind in ("structure", "stick"):
            assert "variator" in said
            assert "converter" in said


def test_a_gear_that_is_dragged_says_so_in_place_of_an_efficiency() -> None:
    case = loads("""\
links: [a, b]
load: {speed: 1000 rpm, torque: 1 N*m}
mechanisms: {pair: {first: a, second: b, ratio: -2, efficiency: 0.98}}
drag: {a: [[0, 3]]}
gears: {idles: [], drives: {load: {torque: 30 N*m}}}
""")
    assert "back-driven" in drawn("efficiency", case)
