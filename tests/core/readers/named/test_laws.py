"""Laws in a case: formulas, points, files; what is said of those that can't be read."""

import math
from pathlib import Path

import numpy as np
import pytest

from tests.chance import each_seed, seeded
from tests.rejects import rejects
from vstatics import ReadError, VstaticsError, load, loads
from vstatics.core.model.laws import PointLaw
from vstatics.core.writers.named import write_yaml

CASE = """\
links: [a, b]
load: {{speed: 1000 rpm, torque: 100 N*m}}
drag: {{b: {drag}}}
mechanisms: {{D: {{first: a, second: b, ratio: -2, efficiency: {efficiency}}}}}
gears: {{low: []}}
"""


def case_of(folder: Path, drag: str = "0", efficiency: str = "1") -> Path:
    file = folder / "case.yaml"
    file.write_text(CASE.format(drag=drag, efficiency=efficiency), "utf-8")
    return file


@pytest.mark.parametrize(
    "text",
    [
        "speed [rpm],torque [N*m]\n0,1\n300,4\n",
        "# speed [rpm],torque [N*m]\n0,1\n300,4\n",  # as numpy.savetxt writes it
        "Rig 5\nSpeed,Oil,Torque\n# warm\nrpm,C,N*m\n0,90,1\n300,90,4\n",
        "torque [N*m],speed [rpm],note\n1,0,\n# by hand\n4,300,warm\n",
        "speed [rpm];torque [N*m]\n0;1,0\n300;4,0\n",
        "speed [rpm],drag torque [N*m],T [°C]\n0,1,90\n300 rpm,4 N*m,90\n",
        "n [rpm],T [Nm]\n0,1\n300,4\n",
        "RPM,Nm\n0,1\n300,4\n",
        "Slip (rpm),Drag torque (Nm)\n0,1\n300,4\n",
    ],
)
def test_a_file_of_points_is_that_of_a_test_bench(tmp_path: Path, text: str) -> None:
    """The line from 1 N*m at rest to 4 N*m at 300 rpm has 2.5 N*m at 5 pi rad/s.

    Sources: github.com/astropy/astropy/issues/8674 (savetxt), readers of cycles and records.
    Headings that are units alone: github.com/GoldenCheetah/GoldenCheetah/issues/1288.
    """
    (tmp_path / "drag.csv").write_text(text, "utf-8")
    law = load(case_of(tmp_path, "{file: drag.csv}")).drag[2]
    assert isinstance(law, PointLaw)
    assert np.array(law.points) == pytest.approx(np.array([[0.0, 1.0], [10 * math.pi, 4.0]]))
    assert law.at(5 * math.pi) == pytest.approx(2.5)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("speed [rpm],moment [N*m]\n0,1\n", "; the line of the headings is `speed [rpm],moment"),
        ("speed,torque\n0,1\n", "line 1: speed: its unit is missing, such as `speed [rpm]`"),
        ("speed [rpm],torque [kW]\n0,1\n", "line 1: torque: read the unit 'kW', expected a"),
        ("speed [rpm],torque [N*m]\n", "expected a point at least"),
        ("speed [rpm],torque [N*m]\n0\n", "line 2: expected 2 numbers"),
        ("speed [rpm],torque [N*m]\n0,nan\n", "line 2: torque: read 'nan', expected a torque"),
        ("speed torque\nrpm N*m\n0 1\n", "`torque [N*m]`; separate the cells by commas, semico"),
        ("kNm,rpm\n0,1\n", "read the heading 'kNm', expected `speed [rpm]` or `torque [N*m]`"),
        ("speed,torque,eta\nrpm,N*m,%\n0,5,90\n", "line 1: read the heading 'eta' of a map"),
        ("speed,torque\nrpm,N*m\n# a\n\n5,1\n9,-1\n", "csv`, line 6: read -1 N*m, expected a t"),
        ("rpm,Nm\n900,1\n800,2\n", "line 3: read 800 rpm, expected a speed above 900 rpm: points"),
        ("rpm,Nm,fuel [g/h]\n9,1,2\n9,2,3\n", "line 1: read the heading 'fuel' of a map"),
        ("x" * 1_000_001, "cannot be read: larger than 1 MB"),
    ],
)
def test_a_wrong_file_is_reported_at_its_place(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "drag.csv").write_text(text, "utf-8")
    with rejects(ReadError, "case.yaml:3:", " error: drag.b: ", said):
        load(case_of(tmp_path, "{file: drag.csv}"))
    for row, told in (
        ("0,5,9650", "line 3: read 9650 %, expected an efficiency"),
        ("-9,5,96", "line 3: read -9 rpm"),
        ("0,5,0.96", "read no value above 1 %, expected percentages such as 95"),
    ):
        text = f"speed,torque,efficiency\nrpm,N*m,%\n{row}\n"
        (tmp_path / "map.csv").write_text(text, "utf-8")
        with rejects(ReadError, f"`map.csv`, {told}"):
            load(case_of(tmp_path, efficiency="{over: [speed, torque], file: map.csv}"))
    with pytest.raises(ReadError, match=r"read `none.csv`, which cannot be read: No such file"):
        load(case_of(tmp_path, "{file: none.csv}"))


@pytest.mark.parametrize(
    ("drag", "efficiency", "said"),
    [
        ("1 + v*w", "1", "a formula of w: read `v` in it, expected a number, the speed w"),
        ("1 + 2*sinh(w)", "1", "sin"),
        ('"1,2 + 0,004*w"', "1", "expected an operator, or an end (with a decimal point)"),
        ("a.csv", "1", "expected a file as `{file: a.csv}`"),
        ("1", "a.csv", "expected a file as `{over: [speed, torque], file: a.csv}`"),
        ("[]", "1", "expected points"),
        ("[[0, 1, 2]]", "1", "expected 2 numbers: [speed, torque]"),
        ("[[5, 1], [5, 2]]", "1", "read 5 rad/s, expected a speed above 5 rad/s: "),
        ("[[0, -1]]", "1", "read -1, expected a torque of 0 or more"),
        ("0", "{over: sped, points: [[0, 1]]}", "did you mean `speed`"),
        ("0", "{over: speed}", "`points` is missing"),
        ("0", "{over: speed, points: 3}", "expected a list: [[speed, efficiency], ...]"),
        ("0", "{over: torque, points: [[0, .9], [1, 1.1]]}", "read 1.1, expected an efficiency"),
        ("0", "{over: torque, points: []}", "read no points"),
    ],
)
def test_a_wrong_law_is_rejected(tmp_path: Path, drag: str, efficiency: str, said: str) -> None:
    with rejects(VstaticsError, said, "case.yaml:"):
        load(case_of(tmp_path, drag, efficiency))


def test_what_depends_without_a_load_is_reported_at_its_place() -> None:
    text = CASE.format(drag="1 + w", efficiency="1")
    text = text.replace("load: {speed: 1000 rpm, torque: 100 N*m}\n", "")
    with pytest.raises(VstaticsError, match=r":2:8: error: drag.b: a drag that depends on"):
        loads(text)


SIZES = {
    "speed": {"rad/s": 1.0, "rpm": math.pi / 30, "rev/s": 2 * math.pi, "deg/s": math.pi / 180},
    "torque": {"N*m": 1.0, "kNm": 1000.0, "N*mm": 1e-3, "kgf*m": 9.80665},
}
"""Units of points by what they are over: exact conversions to rad/s and N*m."""


@each_seed(20, 500)
def test_points_have_units_of_any_variable(seed: int, tmp_path: Path) -> None:
    """Random units point by point, also bare; drag has the same; other units are named."""
    rng = seeded(seed)
    over, other = rng.sample(sorted(SIZES), 2)
    points, written = [], []
    for place in range(rng.randint(1, 5)):
        value, efficiency = 10.0 * place + rng.randint(0, 9), rng.randint(80, 100)
        unit = rng.choice(["", *SIZES[over]])
        number = value / SIZES[over].get(unit, 1.0)
        points.append((value, efficiency / 100))
        written.append(f"[{number!r} {unit}, {efficiency} %]")
    text = f"{{over: {over}, points: [{', '.join(written)}]}}"
    case = load(case_of(tmp_path, efficiency=text))
    for one in (case, loads(write_yaml(case))):
        law = one.mechanisms[0].efficiency
        assert isinstance(law, PointLaw)
        assert law.over == over
        np.testing.assert_allclose(law.points, points, rtol=1e-12)
    law = load(case_of(tmp_path, "[[0, 2], [300 rpm, 3.5 N*m]]")).drag[2]
    assert isinstance(law, PointLaw)
    assert law.points[1] == pytest.approx((31.41592653589793, 3.5))
    wrong = text.replace(written[-1], f"[1 {rng.choice(sorted(SIZES[other]))}, .9]")
    at = f"efficiency.points[{len(points)}][1]: "
    with rejects(ReadError, at, f"expected a {over} in ", ", bare or with its unit"):
        load(case_of(tmp_path, efficiency=wrong))
