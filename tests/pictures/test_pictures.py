"""Pictures of transmissions: no label covers another, the same case gives the same bytes."""

from __future__ import annotations

import contextlib
import importlib.util
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from tests.chance import some
from tests.commands import CASES, LOCKED, NEUTRAL, SHIPPED, TIED_UP, vstatics
from tests.pictures.drawn import WITHOUT_PLAN
from tests.pictures.schemes.test_schemes import ring
from tests.shipped import shipped_results
from vstatics import CaseError, Results, solve
from vstatics.pictures import drawn_kinds, module_of, picture, render
from vstatics.pictures.drawing.files import FORMATS, Format, settings_of
from vstatics.pictures.drawing.style import POINTS_PER_MILLIMETRE, Style

if TYPE_CHECKING:
    from vstatics.simulation.record.motion import Motion

NAMES = [path.name for path in SHIPPED]
QUICK = ("mzkt7922.dat", "power-split.yaml")


@pytest.fixture(scope="module")
def umdm() -> Results:
    return shipped_results("umdm.yaml")


def overlaps(results: Results, kind: str, style: Style, motion: Motion | None = None) -> list[str]:
    """Pairs of texts of a picture whose boxes meet, and texts that leave the picture."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.text import Text

    with settings_of(style):  # letters are as wide as in files
        figure = picture(results, kind, style, motion=motion)
        canvas: Any = FigureCanvasAgg(figure)
        figure.draw_without_rendering()
        texts: list[Any] = figure.findobj(Text)
        shown = [one for one in texts if one.get_visible() and one.get_text().strip()]
        ink = canvas.get_renderer()
        boxes = [(text.get_text(), text.get_window_extent(ink)) for text in shown]
    whole = figure.bbox
    wrong = [
        f"{name} leaves the picture"
        for name, box in boxes
        if box.x0 < 0 or box.y0 < 0 or box.x1 > whole.x1 or box.y1 > whole.y1
    ]
    for (name, one), (other, two) in combinations(boxes, 2):
        across = min(one.x1, two.x1) - max(one.x0, two.x0)
        if across > 0.5 and min(one.y1, two.y1) - max(one.y0, two.y0) > 0.5:
            wrong.append(f"{name} / {other}")
    assert boxes
    return wrong


def has_picture(kind: str, name: str) -> bool:
    if kind == "lever" and name == "moskvich-start.yaml":  # springs only
        return False
    return kind != "plan" or name not in WITHOUT_PLAN


OURS = ("plan", "lever", "efficiency")
STYLES = (Style(), Style("ru", dark=True))


@pytest.mark.slow
@pytest.mark.parametrize("kind", OURS)
@pytest.mark.parametrize(("name", "style"), list(zip(QUICK, STYLES, strict=True)))
def test_no_label_covers_another(name: str, style: Style, kind: str) -> None:
    assert overlaps(shipped_results(name), kind, style) == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", OURS)
@pytest.mark.parametrize("name", NAMES[::5])
def test_no_label_covers_another_in_any_shipped_case(name: str, kind: str) -> None:
    if has_picture(kind, name):
        style = STYLES[NAMES.index(name) % len(STYLES)]
        assert overlaps(shipped_results(name), kind, style) == []


@pytest.mark.parametrize(
    ("kind", "name"),
    [
        ("plan", "wilson-preselector.yaml"),
        ("lever", "ford-model-t.yaml"),
        ("dump", "moskvich412.yaml"),
        pytest.param("lever", "mercedes-5g.yaml", marks=pytest.mark.slow),
        pytest.param("campbell", "moskvich412.yaml", marks=pytest.mark.slow),
        pytest.param("response", "moskvich412.yaml", marks=pytest.mark.slow),
    ],
)
def test_letters_of_a_narrow_page_stay_on_it(kind: str, name: str) -> None:
    column = Style("ru", width=85 * POINTS_PER_MILLIMETRE)
    assert overlaps(shipped_results(name), kind, column) == []


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "form"), list(zip(OURS, FORMATS, strict=True)))
def test_the_same_case_gives_the_same_bytes(umdm: Results, kind: str, form: Format) -> None:
    assert render(umdm, kind, form, Style()) == render(umdm, kind, form, Style())


def test_a_picture_holds_no_date(umdm: Results) -> None:
    assert b"<dc:date>" not in render(umdm, "efficiency", "svg", Style())
    assert b"CreationDate" not in render(umdm, "efficiency", "pdf", Style())


def test_pictures_drawn_in_threads_are_those_drawn_alone(umdm: Results) -> None:
    import matplotlib as mpl

    asked = [("stick", Style()), ("efficiency", Style(dark=True)), ("lever", Style("ru"))]
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


STARTS = {"svg": b"<?xml", "png": b"\x89PNG", "pdf": b"%PDF"}


@pytest.mark.parametrize("form", FORMATS)
def test_the_suffix_tells_the_format(form: str, tmp_path: Path) -> None:
    target = tmp_path / f"losses.{form}"
    said = vstatics("plot", CASES / "umdm.yaml", "--kind", "efficiency", "-o", target)
    assert (said.status, said.all) == (0, "")
    assert target.read_bytes().startswith(STARTS[form])


def test_a_picture_goes_through_a_pipe() -> None:
    case = (CASES / "mzkt7922.dat").read_bytes()
    said = vstatics("plot", "-", "--kind", "lever", "--gear", "2", "-o", "-", stdin=case)
    assert said.status == 0
    assert said.out.startswith("<?xml")
    assert said.out.rstrip().endswith("</svg>")


def test_another_suffix_is_wrong_use(tmp_path: Path) -> None:
    said = vstatics("plot", CASES / "umdm.yaml", "-k", "plan", "-o", tmp_path / "plan.bmp")
    assert said.is_wrong_use("expected .svg .png .pdf")


@pytest.mark.parametrize("gear", ["9", "0", "9" * 5000])
def test_an_unknown_gear_is_told_with_those_that_there_are(gear: str, tmp_path: Path) -> None:
    said = vstatics(
        "plot", CASES / "umdm.yaml", "-k", "plan", "--gear", gear, "-o", tmp_path / "a.svg"
    )
    assert said.is_wrong_use(f"no gear '{gear}'; gears are 1, 2, 3, 4, R")
    assert list(tmp_path.iterdir()) == []


def test_a_case_without_a_plan_says_so(tmp_path: Path) -> None:
    said = vstatics("plot", CASES / "wheel-hub.yaml", "-k", "plan", "-o", tmp_path / "a.svg")
    assert said.fails("wheel-hub.yaml: error: a kinematic plan shows")


def test_without_matplotlib_the_command_names_the_extra(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)  # noqa: ARG005
    said = vstatics("plot", CASES / "umdm.yaml", "-k", "plan", "-o", tmp_path / "a.svg")
    assert said.fails('a picture needs the package matplotlib: pip install ".[plot]"')
    assert "umdm.yaml" not in said.err  # it is not a fault of the case


@pytest.mark.parametrize("kind", OURS)
@pytest.mark.parametrize("text", [NEUTRAL, TIED_UP, LOCKED])
def test_gears_without_a_solution_do_not_stop_a_picture(kind: str, text: str) -> None:
    said = vstatics("plot", "-", "--kind", kind, "-o", "-", stdin=text.encode())
    if (kind, text) == ("efficiency", LOCKED):
        assert "the case has no efficiency to draw" in said.err
        return
    assert said.status == int(text == TIED_UP)
    assert said.out.startswith("<?xml")


def test_every_kind_of_picture_has_its_module() -> None:
    for name in drawn_kinds():
        kind = vars(module_of(name))
        assert callable(kind.get("draw", kind.get("each")))


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
