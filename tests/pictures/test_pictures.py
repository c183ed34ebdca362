"""Pictures of transmissions: no label covers another, the same case gives the same bytes."""

from __future__ import annotations

import contextlib
import importlib.util
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from matplotlib.text import Text

from tests.chance import some
from tests.commands import CASES, LOCKED, NEUTRAL, SHIPPED, TIED_UP, vstatics
from tests.installed import HERE, needs
from tests.pictures.drawn import texts, titled
from tests.pictures.schemes.test_schemes import overlaps as overlaps_of
from tests.pictures.schemes.test_schemes import ring
from tests.shipped import shipped_results
from vstatics import CaseError, Results, Transmission, load, loads, solve
from vstatics.pictures import drawn_pages, picture, render
from vstatics.pictures.drawing.files import Format, figures_of, settings_of
from vstatics.pictures.drawing.style import PAGE_HEIGHT, PAGE_WIDTH, POINTS_PER_MILLIMETRE, Style

if TYPE_CHECKING:
    from vstatics.simulation.record.motion import Motion

OF_VAN = ("zf-8hp70.yaml", "ravigneaux-gf4a.yaml")
"""Cases that are put into a van each time."""


def in_van(case: Transmission) -> Transmission:
    """Return a case in a van. Without its annex, the case alone."""
    if "vehicle" not in HERE:
        return case
    from tests.vehicle.pictures.cars import VAN

    return case.replace(vehicle=VAN)


@pytest.fixture(scope="module")
def umdm() -> Results:
    return shipped_results("umdm.yaml")


def overlaps(
    results: Results, kind: str, style: Style, motion: Motion | None = None
) -> list[tuple[str, str]]:
    """Pairs of texts of a picture whose boxes meet, and texts that leave the picture."""
    with settings_of(style):  # letters are as wide as in files
        return overlaps_of(picture(results, kind, style, motion=motion))


OURS = ("plan", "lever", "efficiency")
STYLES = (Style(), Style("ru", dark=True))


@needs("vehicle")
@pytest.mark.parametrize(
    "path",
    [
        pytest.param(path, id=path.name, marks=() if path.name in OF_VAN else pytest.mark.slow)
        for path in SHIPPED
    ],
)
def test_charts_of_a_van_can_be_read_and_fit_the_paper(path: Path) -> None:
    """Shipped cases have no vehicle."""
    results, style = solve(in_van(load(path))), Style(height=PAGE_HEIGHT)
    for kind in ("traction", "sawtooth", "steps"):
        with contextlib.suppress(CaseError):  # some have no steps
            [pages] = drawn_pages(results, kind, style, [()])
            for figure in figures_of(pages):
                wide, high = figure.get_size_inches() * 72
                assert (wide <= PAGE_WIDTH + 1e-6, high <= PAGE_HEIGHT + 1e-6) == (True, True)
                figure.set_dpi(150)
                assert overlaps_of(figure) == []
                texts: list[Any] = figure.findobj(Text)
                assert min(one.get_fontsize() for one in texts if one.get_text().strip()) >= 7


@pytest.mark.parametrize(
    ("kind", "name"),
    [
        ("plan", "wilson-preselector.yaml"),
        ("lever", "ford-model-t.yaml"),
        pytest.param("dump", "moskvich412.yaml", marks=needs("torsion")),
        pytest.param("lever", "mercedes-5g.yaml", marks=pytest.mark.slow),
        pytest.param("campbell", "moskvich412.yaml", marks=(pytest.mark.slow, needs("torsion"))),
        pytest.param("response", "moskvich412.yaml", marks=(pytest.mark.slow, needs("torsion"))),
    ],
)
def test_letters_of_a_narrow_page_stay_on_it(kind: str, name: str) -> None:
    column = Style("ru", width=85 * POINTS_PER_MILLIMETRE)
    assert overlaps(shipped_results(name), kind, column) == []


@pytest.mark.parametrize(
    ("form", "date"), [("svg", b"<dc:date>"), ("pdf", b"CreationDate"), ("png", b"tIME")]
)
def test_the_same_case_gives_the_same_bytes_without_a_date(
    umdm: Results, form: Format, date: bytes
) -> None:
    made = render(umdm, "efficiency", form, Style())
    assert made == render(umdm, "efficiency", form, Style())
    assert date not in made


def test_pictures_drawn_in_threads_are_those_drawn_alone(umdm: Results) -> None:
    import matplotlib as mpl

    asked = [("stick", Style()), ("efficiency", Style(dark=True)), ("lever", Style("ru"))]
    asked += [("structure", Style()), ("plan", Style())]
    before = dict(mpl.rcParams)

    def drawn(of: tuple[str, Style]) -> bytes:
        return render(umdm, of[0], "svg", of[1], (1,))

    alone = [drawn(one) for one in asked]
    with ThreadPoolExecutor(4) as threads:
        assert list(threads.map(drawn, 3 * asked)) == 3 * alone
    assert dict(mpl.rcParams) == before


def test_a_picture_does_not_ask_for_a_screen() -> None:
    code = (
        "import sys; from vstatics import load, solve\n"
        "from vstatics.pictures import picture\n"
        "from vstatics.pictures.drawing.style import Style\n"
        "assert 'matplotlib' not in sys.modules\n"
        f"picture(solve(load({str(CASES / 'umdm.yaml')!r})), 'plan', Style())\n"
        "assert 'matplotlib.pyplot' not in sys.modules"
    )
    done = subprocess.run([sys.executable, "-c", code], check=False, capture_output=True)
    assert done.returncode == 0, done.stderr.decode()


def test_a_picture_goes_through_a_pipe() -> None:
    case = (CASES / "mzkt7922.dat").read_bytes()
    said = vstatics("plot", "-", "--kind", "lever", "--gear", "2", "-o", "-", stdin=case)
    assert said.status == 0
    assert said.out.startswith("<?xml")
    assert said.out.rstrip().endswith("</svg>")


def test_a_kind_of_picture_typed_as_a_command_gives_the_command_that_draws_it() -> None:
    said = vstatics("stick", "box.yaml")
    assert said.is_wrong_use("`stick` is a picture: `vstatics plot --kind stick`")


def test_wrong_use_is_reported(tmp_path: Path) -> None:
    umdm = ("plot", CASES / "umdm.yaml", "-k", "plan", "-o")
    assert vstatics(*umdm, tmp_path / "plan.bmp").is_wrong_use("expected .svg .png .pdf")
    for gear in ("9", "0", "9" * 5000):
        said = vstatics(*umdm, tmp_path / "a.svg", "--gear", gear)
        assert said.is_wrong_use(f"no gear '{gear}'; gears are 1, 2, 3, 4, R")
    said = vstatics("plot", CASES / "wheel-hub.yaml", "-k", "plan", "-o", tmp_path / "a.svg")
    assert said.fails("wheel-hub.yaml: error: a kinematic plan shows")
    assert list(tmp_path.iterdir()) == []


def test_without_matplotlib_the_command_names_the_extra(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)  # noqa: ARG005
    said = vstatics("plot", CASES / "umdm.yaml", "-k", "plan", "-o", tmp_path / "a.svg")
    assert said.fails('a picture needs the package matplotlib: pip install ".[plot]"')
    assert "umdm.yaml" not in said.err  # it is not a fault of the case


@pytest.mark.parametrize("kind", OURS)
def test_gears_without_a_solution_do_not_stop_a_picture(kind: str) -> None:
    for text in (NEUTRAL, TIED_UP, LOCKED):
        said = vstatics("plot", "-", "--kind", kind, "-o", "-", stdin=text.encode())
        if (kind, text) == ("efficiency", LOCKED):
            assert "the case has no efficiency to draw" in said.err
        else:
            assert said.status == int(text == TIED_UP)
            assert said.out.startswith("<?xml")


@pytest.mark.slow
@pytest.mark.parametrize(
    "kind", some(["stick", "structure", "flow", "lever", "plan", "efficiency"])
)
def test_a_ring_of_forty_sets_is_drawn_within_twenty_seconds(kind: str) -> None:
    """The issue's bound, of processor time."""
    results = solve(ring(40))
    start = time.process_time()
    with contextlib.suppress(CaseError):
        render(results, kind, "svg", Style())
    assert time.process_time() - start < 20


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
