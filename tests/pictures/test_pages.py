"""Every kind of picture of every shipped case, on paper of 170 mm: what a browser measures of it.

Letters are 8 pt, those of numbers 7. No page is larger than the paper, no text stands over another.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.commands import CASES, SCENARIOS, SHIPPED, vstatics
from tests.pictures.measured import MeasuredPage, measured
from vstatics import load
from vstatics.core.jobs.page_files import further_pages
from vstatics.pictures import drawn_kinds

OF_FULL_LOAD = ("traction", "sawtooth")
"""No shipped case has the full load of its engine."""
OF_SCENARIOS = ("shift", "plan")
VIBRATION = ("modes", "campbell", "response", "dump")
QUICK = ("umdm.yaml", "power-split.yaml", "tarasik-set-upshift.yaml")
"""Files that are looked at each time; of the vibration the next one."""
QUICK_DRIVELINE = "moskvich412.yaml"
WIDE, HIGH, ROUNDED = 170.0, 240.0, 0.1 / 72 * 25.4
"""Size of the paper, and the 0.1 pt by which rounded lengths can exceed it. [mm]"""
LEAST, LEAST_OF_WORDS, ROUNDED_LETTERS = 7.0, 8.0, 0.01
"""Letters. [pt]"""
WORD = re.compile(r"[^\W\d_]{3}")
"""What is in no number with its unit."""
SWEPT = ("simpson.yaml", "--vary", "P1.ratio=-3:-1.5:31", "--vary", "P2.ratio=-3:-1.5:31")
OPTIONS = {"map": ("--z", "efficiency[1]"), "curves": ("--x", "P1.ratio", "--y", "ratio[1]")}
FOUND = "--sets 2 --shift-elements 4 --engaged 2 --own-input --ratios 2.45,1.45,1,-2.2"

Measured = dict[str, list[MeasuredPage]]
"""The pages of each file that has a picture of a kind."""


def files_of(kind: str, folder: Path) -> list[Path]:
    """What a kind is drawn of."""
    if kind == "boxes":
        vstatics("synth", "box", *FOUND.split(), "-f", "json", "-o", folder / "found.json")
        return [folder / "found.json"]
    if kind in ("map", "curves"):
        case, *varied = SWEPT
        out = "ratio[1],efficiency[1],ratio[2],efficiency[2]"
        vstatics("sweep", CASES / case, *varied, "--out", out, "-o", folder / "swept.csv")
        return [folder / "swept.csv"]
    return [*SHIPPED * (kind != "shift"), *SCENARIOS * (kind in OF_SCENARIOS)]


def duty_of(file: Path, folder: Path) -> Path:
    """CSV file of a duty cycle: a minute in each gear, with more torque in each further gear."""
    rows = [f'60,"{gear.name}",1000,{10 * n}' for n, gear in enumerate(load(file).gears, 1)]
    duty = folder / "duty.csv"
    duty.write_text("\n".join(["time [s],gear,speed [rpm],torque [N*m]", *rows]), "utf-8")
    return duty


def drawn(file: Path, kind: str, folder: Path) -> Iterator[bytes]:
    target, options = folder / "drawn.svg", OPTIONS.get(kind, ())
    if kind == "spectrum":
        options = ("--duty", str(duty_of(file, folder)))
    said = vstatics("plot", file, "--kind", kind, "-o", target, *options)
    assert said.status in (0, 1), said.err
    for path in [target, *map(Path, further_pages(str(target)))] if said.status == 0 else ():
        yield path.read_bytes()


def parameter(kind: str, *, is_quick: bool) -> Any:
    marks = [] if is_quick else [pytest.mark.slow]
    return pytest.param((kind, is_quick), id=f"{kind}-some" if is_quick else kind, marks=marks)


@pytest.fixture(
    scope="module",
    params=[
        *(parameter(kind, is_quick=True) for kind in drawn_kinds()),
        *(parameter(kind, is_quick=False) for kind in (*drawn_kinds(), "map", "curves", "boxes")),
    ],
)
def pages(
    request: pytest.FixtureRequest, browser: Any, tmp_path_factory: pytest.TempPathFactory
) -> Measured:
    kind, is_quick = request.param
    folder = tmp_path_factory.mktemp("pages")
    files = files_of(kind, folder)
    if is_quick:
        names = [QUICK_DRIVELINE] if kind in VIBRATION else QUICK
        files = [file for file in files if file.name in names]
    svgs = [(file.name, page) for file in files for page in drawn(file, kind, folder)]
    found: Measured = {}
    for (name, _), page in zip(svgs, measured(browser, [svg for _, svg in svgs]), strict=True):
        found.setdefault(name, []).append(page)
    if not found and (is_quick or kind in OF_FULL_LOAD):
        pytest.skip("none of these cases has it")
    assert found
    return found


def numbered(pages: Measured) -> Iterator[tuple[str, MeasuredPage]]:
    """Each page with the name of its file and its number."""
    for name, own in pages.items():
        for number, page in enumerate(own, 1):
            yield f"{name} {number}", page


WIDE_STRUCTURES = {"driveline-8hp70.yaml 1", "moskvich412.yaml 1"}
"""Cases with more boxes than a page has room for."""


def test_no_page_is_larger_than_the_paper(pages: Measured, request: pytest.FixtureRequest) -> None:
    kind, _ = request.node.callspec.params["pages"]
    wider = WIDE_STRUCTURES if kind == "structure" else set()
    assert [
        (name, page.width, page.height)
        for name, page in numbered(pages)
        if name not in wider
        if page.width > WIDE + ROUNDED or page.height > HIGH + ROUNDED
    ] == []


def test_letters_can_be_read(pages: Measured) -> None:
    assert [
        (name, text, size)
        for name, page in numbered(pages)
        for text, size in page.letters
        if size < (LEAST_OF_WORDS if WORD.search(text) else LEAST) - ROUNDED_LETTERS
    ] == []


def test_no_text_stands_over_another_or_leaves_the_page(pages: Measured) -> None:
    assert [(name, *texts) for name, page in numbered(pages) for texts in page.overlaps] == []
    assert [(name, text) for name, page in numbered(pages) for text in page.outside] == []
    assert [(name, text) for name, page in numbered(pages) for text in page.covered] == []
