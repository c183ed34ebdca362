"""The report: one page that shows the numbers of the results and nothing else."""

import importlib.util
import math
import re
import shutil
from collections import Counter
from pathlib import Path

import pytest

from tests.commands import CASES, LOCKED, MZKT, NEUTRAL, TIED_UP, json_answer, json_file, vstatics
from tests.installed import needs
from tests.page.report.pages import NASTY, NASTY_CASE, Page, number, report, value, write
from tests.shipped import shipped_results
from vstatics.core.errors import CaseError
from vstatics.core.tables.quantities import BY_NAME
from vstatics.page.report.html_page import page
from vstatics.page.report.material import gather
from vstatics.page.report.sections import sections

NUMBERED = """\
links: ["-3", "8-1", out]
shift_elements: {C: ["-3", "8-1"], B: ["8-1", housing]}
mechanisms: {P: {first: "-3", second: "8-1", third: out, ratio: -2.5, efficiency: 0.98}}
gears: {"1": {engaged: [B]}, "2": {engaged: [C]}}
"""

DUTY = """\
links: [a, b, c]
shift_elements: {B: {links: [b, c], capacity: 700 N*m}}
load: {speed: 2000 rpm, torque: 200 N*m}
mechanisms: {P: {first: a, second: b, ratio: 3}}
gears: {"1": [B]}
"""


@pytest.fixture(scope="module")
def zf() -> Page:
    return Page(report(CASES / "zf-8hp70.yaml"))


@pytest.fixture(scope="module")
def nasty(tmp_path_factory: pytest.TempPathFactory) -> Page:
    return Page(report(write(tmp_path_factory.mktemp("nasty"), NASTY_CASE)))


@pytest.mark.slow
def test_numbers_by_gear_are_those_of_the_result(zf: Page) -> None:
    [well] = [one.text for one in zf.all("p") if one.text.startswith("In all gears")]
    assert well.count(",") == 2
    assert "By gear" not in [one.text for one in zf.all("h3")]
    assert all(zf.data["consistent"])
    assert not any(zf.data["locked"])
    assert max(map(abs, zf.data["power_balance"])) < 1e-12
    gears = zf.table("Ratios, steps")
    assert [value(row["ratio"]) for row in gears.values()] == zf.data["ratio"]
    assert [value(row["efficiency"]) for row in gears.values()] == zf.data["efficiency"]
    # ZF 8HP70 as printed to three digits behind the point; see tests/published
    published = json_file(Path("tests/published/zf-8hp70.json"))
    for gear, ratio in published["ratio"].items():
        assert number(gears[gear]["ratio"]) == pytest.approx(ratio, abs=1e-3)
    # first gear 1 + 85/23 (see the case), eighth the printed .667, which is 2/3
    assert "7.043, gear 1 to 8" in [one.text for one in zf.all("dd")]
    # as the source's table of shift elements has them; cases/zf-8hp70.yaml
    assert [name for name in "ABCDE" if gears["1"][name].text == "●"] == ["A", "B", "C"]


@pytest.mark.usefixtures("without_pictures")
def test_every_number_is_printed_alike_and_names_stay(tmp_path: Path) -> None:
    """Issue 16, item 7; links have names that look like numbers."""
    made = Page(report(write(tmp_path, NUMBERED)))
    assert list(made.table(BY_NAME["speeds"].title)) == ["-3", "8-1", "out"]
    tags = {"th", "td", "li", "p", "dd", "pre", "h3", "h4"}
    shown = [one.text for one in made.elements if one.tag in tags and "main" in one.inside]
    texts = {text.replace("-3", "").replace("8-1", "") for text in shown}
    assert not [one for one in texts if re.search(r"(?<![\w])-[\d.]|\s-\s|(?<![\w.])\.\d|^-$", one)]
    assert [one for one in texts if "\u22122.5" in one]


@pytest.mark.slow
def test_the_summary_is_rounded_to_what_the_page_shows(zf: Page) -> None:
    given = json_answer("summary", CASES / "zf-8hp70.yaml")
    table = zf.table("Ratios, steps")
    for line in given["gears"]:
        for name in ("ratio", "step", "efficiency"):
            exact = math.nan if line[name] is None else line[name]
            shown = number(table[line["gear"]][name])
            assert shown == pytest.approx(exact, abs=5.1e-4, nan_ok=True)
    sensitivity = zf.table("Sensitivity")
    for mechanism, values in given["sensitivity"].items():
        cells = [sensitivity[mechanism][gear] for gear in zf.data["gears"]]
        assert [one.text == "" for one in cells] == [one == 0 for one in values]
        numbers = [number(one) if one.text else 0.0 for one in cells]
        assert numbers == pytest.approx(values, abs=5.1e-4)


@pytest.mark.slow
def test_powers_are_those_of_the_flow(zf: Page) -> None:
    for gear in json_answer("flow", CASES / "zf-8hp70.yaml")["gears"]:
        table = zf.table(f"Power in gear {gear['gear']}")
        for heading, side in (("ideal", gear["ideal"]), ("with losses", gear["lossy"])):
            for node in side["throughput"]:
                if node["power"] and node["kind"] != "port":
                    assert value(table[node["name"]][heading]) == node["power"]
        assert "0.000" not in [cell.text for row in table.values() for cell in row.values()]
        for loss in gear["lossy"]["losses"]:
            if loss["name"] in table:
                assert value(table[loss["name"]]["loss"]) == loss["power"]
    # in gear 6 the clutch E holds P3 as one piece; C and D stand in series with it
    table = zf.table("Power in gear 6")
    marks = {name: row["by convention"].text for name, row in table.items() if row}
    assert {name for name, mark in marks.items() if mark} == {"ring 2", "E", "P3"}
    told = [one.text for one in zf.all("li")]
    assert not [one for one in told if one.startswith("in ")]  # the table has it
    assert "~ by convention, as it is locked up: ring 2, E, P3" in told


@pytest.mark.slow
def test_the_page_of_ten_gears_defines_repeated_shapes_once() -> None:
    assert len(report(CASES / "ford-10r80.yaml").encode()) <= 500_000  # [bytes]


@pytest.mark.slow
def test_each_gear_has_pictures_of_its_own(zf: Page) -> None:
    labels = [one.attributes.get("aria-label") or "" for one in zf.all("svg")]
    for kind in ("Stick diagram", "Power flow", "Lever diagram"):
        own = [one for one in labels if one.startswith(f"{kind}, gear") and "small" not in one]
        assert own == [f"{kind}, gear {gear}" for gear in zf.data["gears"]]


@pytest.mark.slow
def test_sections_have_the_documented_order(zf: Page) -> None:
    """Issue 16: overview, gears, flow, lever, efficiency, plan, shifts, input, tables.

    What is printed has the largest values before the rest, which stays on the screen (issue 30).
    """
    assert [one.text for one in zf.all("h2")] == [
        *("Overview", "Gears", "Power flow", "Lever diagram", "Equations", "Efficiency"),
        *("Kinematic plan", "Largest values", "Shifts", "Input", "Tables", "Conventions"),
    ]
    assert not [one for one in zf.elements if "hidden" in one.attributes]  # without a script
    heads = [one.text for one in zf.all("h3") if not one.text.startswith("Gear ")]
    assert len(heads) == len(set(heads))


@pytest.mark.slow
def test_many_plans_stand_on_several_sheets(zf: Page) -> None:
    """Each of them fits a printed page, which no long picture does."""
    sheets = [one for one in zf.all("svg") if one.attributes.get("aria-label") == "Kinematic plan"]
    labels = [one.attributes.get("aria-label") or "" for one in zf.all("div")]
    named = [one for one in labels if one.startswith("Kinematic")]
    assert named == [f"Kinematic plan, {n} of {len(sheets)}" for n in range(1, len(sheets) + 1)]
    for sheet in sheets:
        _, _, wide, high = map(float, (sheet.attributes["viewbox"] or "").split())
        assert high / wide < 29.7 / 21.0


@pytest.mark.slow
def test_nothing_comes_from_elsewhere_and_references_have_targets(zf: Page, nasty: Page) -> None:
    options = (("--gears", "2"), ("--gears", "R,1"), ("--all",))
    others = [Page(report(CASES / "zf-8hp70.yaml", *some)) for some in options]
    for shown in (zf, nasty, *others):
        ids = Counter(one.attributes["id"] for one in shown.elements if "id" in one.attributes)
        assert set(ids.values()) == {1}
        for element in shown.elements:
            assert element.tag not in ("link", "iframe", "object", "embed", "img", "base")
            for name in ("src", "srcset", "data", "href", "xlink:href", "action"):
                assert (element.attributes.get(name) or "#").startswith("#")
            for name, text in element.attributes.items():
                assert name != "href" or (text or "").removeprefix("#") in ids
                assert {*re.findall(r"url\(#(.*?)\)", text or "")} <= {*ids}
        styles = "".join(one.text for one in shown.all("style"))
        assert "@import" not in styles
        assert styles.count("url(") == styles.count("url(#")


def test_texts_of_the_case_are_shown_as_they_are(nasty: Page) -> None:
    [title] = nasty.all("h1")
    assert title.text == NASTY
    assert "</script><b>bold</b> & more" in [one.text for one in nasty.all("p")]
    assert len(nasty.all("script")) == 2  # the data, and the page's own
    assert not nasty.all("b")
    assert not nasty.all("i")
    assert list(nasty.table("Speeds of the links")) == ["<b>in</b>", 'r"ing', "out'"]
    assert list(nasty.table("Ratios, steps")) == ["low <1>", "dir%/'ect"]
    assert nasty.data["case"]["name"] == NASTY


def test_a_load_gives_tables_with_units(nasty: Page) -> None:
    """2100 rpm at the input; a sun, a held ring and 1 + 2.5 between sun and carrier."""
    speeds = nasty.table(BY_NAME["speeds_rpm"].title)
    assert value(speeds["<b>in</b>"]["low <1>"]) == 2100
    assert value(speeds["out'"]["low <1>"]) == pytest.approx(2100 / 3.5)
    power = nasty.table("Power in gear low <1>")["D&"]["kW"]
    assert value(power) == pytest.approx(2100 * math.pi / 30 * 1.2)


def test_the_same_case_gives_the_same_page(tmp_path: Path) -> None:
    original = CASES / "differential.yaml"
    copy = tmp_path / "elsewhere.yaml"
    shutil.copy(original, copy)
    made = report(copy)
    assert "<svg" in made
    assert "elsewhere" not in made
    assert made == report(original)


@pytest.mark.usefixtures("without_pictures")
def test_gears_without_numbers_say_why(tmp_path: Path) -> None:
    for text, status, words in (
        (NEUTRAL, 0, "there is no power to show"),
        (TIED_UP, 1, "Tied up, so there is no power to show"),
        (LOCKED, 0, "with losses: self-locking"),
    ):
        said = vstatics("report", write(tmp_path, text), "-o", tmp_path / "out.html")
        assert said.status == status
        shown = Page((tmp_path / "out.html").read_text("utf-8"))
        assert any(words in one.text for one in shown.elements if one.tag in ("p", "li"))
        messages = [one.text for one in shown.all("li") if one.attributes.get("class")]
        assert messages == shown.data["messages"]
        ids = {one.attributes.get("id") for one in shown.elements}
        assert {(one.attributes["href"] or "")[1:] for one in shown.all("a")} <= ids
    wrong = tmp_path / "wrong.html"
    assert vstatics("report", write(tmp_path, "links: 3\n"), "-o", wrong).status == 1
    assert not wrong.exists()


@pytest.mark.usefixtures("without_pictures")
def test_a_duty_cycle_is_on_the_page_with_what_is_doubtful_about_it(tmp_path: Path) -> None:
    case, points = write(tmp_path, DUTY), tmp_path / "points.csv"
    points.write_text("time [s],gear,speed [rpm],torque [N*m]\n9,1,2000,300\n1,1,2500,200\n")
    shown = Page(report(case, "--duty", points, "--exponent", 6))
    said = "warning: in 1 of 2 rows B carries up to 900 N*m, more than its torque capacity of 700"
    assert any(one.text.startswith(said) for one in shown.all("li"))
    table = shown.table("Largest over the duty cycle")
    members = json_answer("summary", case, "--duty", points, "--exponent", 6)["duty"]["members"]
    for name, cells in table.items():
        own = members[name]["equivalent_torque"]
        assert value(cells["equivalent, p = 6, N*m"]) == pytest.approx(own, abs=5e-4)
    assert set(table) == {name for name, one in members.items() if one["torque"]["largest"]}


@pytest.mark.usefixtures("without_pictures")
def test_a_duty_cycle_gives_the_load_of_a_case_without_it(tmp_path: Path) -> None:
    points = tmp_path / "points.csv"
    points.write_text("time [s],gear,speed [rpm],torque [N*m]\n9,1,1500,300\n")
    text = "ratio: 3, efficiency: {over: torque, points: [[0, 0.9], [600, 0.98]]}"
    bare = re.sub("load: .*|, capacity: 700 N.m", "", DUTY)
    case = write(tmp_path, bare.replace("ratio: 3", text))
    shown = Page(report(case, "--duty", points))
    assert any(
        "gears are calculated at 1500 rpm and 300 N*m" in each.text for each in shown.all("li")
    )


@pytest.mark.slow
def test_a_page_carries_the_result(zf: Page) -> None:
    assert {**zf.data, "file": "zf-8hp70.yaml"} == json_answer("run", CASES / "zf-8hp70.yaml")
    for name in ("ravigneaux-aod.yaml", "self-locking.yaml"):
        shown = Page(report(CASES / name))
        assert {**shown.data, "file": name} == json_answer("run", CASES / name)
        assert shown.all("svg")


@pytest.mark.usefixtures("without_pictures")
def test_warnings_of_the_reader_come_with_their_line_and_without_the_file(tmp_path: Path) -> None:
    """A deck without its last field, KMZ, may have been cut."""
    lines = MZKT.read_text("utf-8").splitlines()
    file = tmp_path / "cut.dat"
    file.write_text("\n".join(lines[:-3]), "utf-8")
    said = vstatics("report", file, "-o", "-")
    [message] = [one.text for one in Page(said.out).all("li") if "KMZ" in one.text]
    assert message.startswith("warning: line ")
    assert str(tmp_path) not in said.out


def test_without_matplotlib_the_page_has_no_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    find = importlib.util.find_spec

    def without(name: str, package: str | None = None) -> object:
        return None if name == "matplotlib" else find(name, package)

    monkeypatch.setattr(importlib.util, "find_spec", without)
    said = vstatics("report", CASES / "differential.yaml", "-o", "-")
    assert said.status == 0
    assert 'pip install ".[plot]"' in said.err
    shown = Page(said.out)
    assert not shown.all("svg")
    assert any("There are no pictures" in one.text for one in shown.all("p"))


def test_an_unsuitable_picture_is_left_out_and_named(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **_of: object) -> bytes:
        raise CaseError("E234", "nothing <moves>")

    monkeypatch.setattr("vstatics.pictures.paged.drawn.pages", refuse)
    shown = Page(page(gather(shipped_results("differential.yaml"))))
    assert any("not drawn. nothing <moves> [E234]" in one.text for one in shown.all("p"))


@needs("vehicle")
def test_the_page_of_a_car_has_what_its_vehicle_does() -> None:
    """Top speeds of the summary, wheel force and the speeds of its engine; a box alone has none."""
    from tests.vehicle.pictures.cars import box
    from vstatics.vehicle.operation.traction import performance

    results = box([3.5, 1.9, 1.0])
    [part] = [one for one in sections(gather(results)) if one.name == "Vehicle"]
    shown = " ".join(part.shown)
    vehicle = performance(results.case)
    assert all(f"{one.top_speed:.3f}" in shown for one in vehicle.gears.values())
    assert (part.is_printed, shown.count("<svg")) == (True, 2)
    alone = gather(box([3.5, 1.9, 1.0], vehicle=None))
    assert "Vehicle" not in [one.name for one in sections(alone)]
