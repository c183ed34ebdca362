"""Structures: what the case joins is joined in the drawing, and nothing else; all can be read.

Lines and boxes are read back from the SVG; what they must join is read from the case.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from math import inf
from pathlib import Path
from random import Random

import pytest

import vstatics
from tests.chance import seeded, some, with_slow
from tests.commands import SHIPPED
from tests.pictures.schemes.axes.boxes import SVG, of_class, parsed
from tests.pictures.schemes.lines import Line, assert_connected, bridges, crossings, lines_of, touch
from tests.pictures.schemes.test_schemes import PAIRS, overlaps, ring
from tests.shipped import shipped_results
from vstatics import CaseError, Gear, Mechanism, Results, ShiftElement, Spring, Transmission
from vstatics.core.model.springs import between
from vstatics.core.numerics.traced import plain
from vstatics.pictures import picture, render
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.schemes.scheme import scheme_of

FEW = ["mzkt7922.dat", "umdm.yaml", "wheel-hub.yaml", "power-split.yaml", "moskvich-start.yaml"]
"""Cases of each kind for the fast tests: a deck, shared planets, held links, axes, springs."""
ONE_ROW = Style(width=inf)


def coloured_wires(root: ET.Element) -> Iterator[tuple[str, Line, str]]:
    for group in of_class(root, "link"):
        if group.attrib["data-name"] != "housing":
            for path in of_class(group, "wire"):
                for line in lines_of(path):
                    yield group.attrib["data-name"], line, path.attrib["stroke"]


def outline(group: ET.Element) -> Line:
    """Return the rectangle about the lines and areas of a component, without its letters."""
    points: list[tuple[float, float]] = []
    for path in group.iter(f"{SVG}path"):
        numbers = [float(number) for number in re.findall(r"-?\d[\d.]*", path.attrib["d"])]
        points += zip(numbers[::2], numbers[1::2], strict=True)
    xs, ys = zip(*points, strict=True)
    return Line(min(xs), min(ys), max(xs), max(ys))


def outlines(root: ET.Element) -> dict[str, Line]:
    """Return the rectangles of all components by their names; each is drawn once."""
    found: dict[str, Line] = {}
    for group in root.iter(f"{SVG}g"):
        if group.get("class") in {"mechanism", "element"}:
            assert group.attrib["data-name"] not in found
            found[group.attrib["data-name"]] = outline(group)
    return found


def check(case: Transmission, *, is_one_row: bool = True) -> None:
    """Check that components and links are joined as in the case, and that letters can be read."""
    results = vstatics.solve(case)
    scheme = scheme_of(case)
    root = parsed(render(results, "structure", "svg", ONE_ROW))
    wires = list(coloured_wires(root))
    boxes = outlines(root)
    for device in scheme.devices:
        met = {name for name, line, _ in wires if touch(line, boxes[device.name], 0.3)}
        assert met == {scheme.name(link) for link in device.links}, device.name
    if is_one_row:
        assert_connected(root)
    figure = picture(results, "structure", ONE_ROW)
    count = crossings(root) if is_one_row else 0
    told = re.search(r"(\d+) crossing", figure.texts[0].get_text())
    assert count == bridges(root) == (int(told[1]) if told else 0)
    assert overlaps(figure) == []
    shown = {" ".join(text.get_text().split()) for text in figure.texts}
    words = " ".join(text.get_text() for text in figure.texts).split()
    joined = {link for device in scheme.devices for link in device.links}
    for link in joined | {port.link for port in scheme.ports}:
        assert " ".join(scheme.name(link).split()) in shown
    for device in scheme.devices:
        assert device.kind == "held" or {*device.name.split()} <= {*words}
        if not device.is_coupling:
            members = [device.labels.get(one, one).replace("_", " ") for one in device.members]
            said = " ".join(words).replace("−", "-")
            assert all(member.replace("−", "-") in said for member in members)


def random_case(chance: Random) -> Transmission:
    """Mechanisms of two and three links, some with a fixed link, shift elements, springs."""
    links = chance.randint(3, 9)

    def pair() -> tuple[int, int]:
        one, other = chance.sample(range(1, links + 1), 2)
        return one, other

    mechanisms = []
    for _ in range(chance.randint(1, 5)):
        first, second, third = chance.sample(range(1, links + 1), 3)
        third = 0 if chance.random() < 0.3 else third
        mechanisms.append(Mechanism(first, second, third, chance.choice([-2.5, 0.4, 3.1])))
    shift = [ShiftElement(*pair()) for _ in range(chance.randint(0, 3))]
    shift += [ShiftElement(chance.randint(1, links)) for _ in range(chance.randint(0, 3))]
    springs = [Spring(between(*pair()), 1000.0, name=f"S{n}") for n in range(chance.randint(0, 2))]
    try:
        return Transmission(links, shift, mechanisms, [Gear()], springs=springs)
    except CaseError:  # a link that nothing joins
        return random_case(chance)


@pytest.mark.parametrize("name", with_slow(FEW, [p.name for p in SHIPPED if p.name not in FEW]))
def test_a_structure_joins_what_its_case_joins(name: str) -> None:
    check(shipped_results(name).case)


@pytest.mark.parametrize(
    "seeds",
    with_slow([(0, 3, 4, 5, 42)], (range(n, n + 20) for n in range(6, 206, 20))),
)
def test_structures_of_random_cases_join_what_these_join(seeds: Sequence[int]) -> None:
    for seed in seeds:
        check(random_case(seeded(seed)))


def test_components_of_every_kind_are_boxes() -> None:
    check(vstatics.loads(PAIRS))
    # two mechanisms that nothing joins to the input: their links have names
    pairs = [Mechanism(1, 2, 0, -1.5), Mechanism(3, 4, 0, -2), Mechanism(5, 6, 7, -2)]
    check(Transmission(7, [ShiftElement(6)], pairs, [Gear([1])]))
    springs = [Spring(between(1), 100.0, name="k")]  # nothing joins the output
    case = Transmission(2, [], [], [Gear()], springs=springs)
    shown = {text.get_text() for text in picture(vstatics.solve(case), "structure", Style()).texts}
    assert {"1", "2", "k"} <= shown


def test_a_chain_has_rows_of_boxes() -> None:
    pairs = [Mechanism(link, link + 1, 0, -1.5) for link in range(1, 13)]
    case = Transmission(13, [], pairs, [Gear()])
    check(case, is_one_row=False)
    svg = render(vstatics.solve(case), "structure", "svg", Style())
    heights = {line[1] for line in outlines(parsed(svg)).values()}
    assert len(heights) == 3
    ports = [group.get("data-port") for group in parsed(svg).iter(f"{SVG}g")]
    assert {"input", "output"} <= {*ports}


@pytest.mark.parametrize("count", with_slow([6, 12, 30], [100]))
def test_many_mechanisms_are_drawn(count: int) -> None:
    check(ring(count))


def test_pictures_use_no_random_numbers() -> None:
    for path in (Path(vstatics.__file__).parent / "pictures").rglob("*.py"):
        text = path.read_text("utf-8")
        assert not re.search(r"^\s*(from|import) .*\brandom\b", text, re.MULTILINE), path


def torques_of(results: Results, gear: int) -> list[dict[int, list[float]]]:
    """Torques of the components of a scheme, by the links from which they have them."""
    case, values = results.case, results.torques[gear - 1].tolist()
    members = results.gear(gear).member_torques(lossy=False)
    found: list[dict[int, list[float]]] = []
    for device, torques in zip(case.own_devices, members, strict=True):
        found.append({})
        for member in device.members:
            found[-1].setdefault(member.link, []).append(plain(torques[member.name]))
    for shift, torque in zip(case.shift_elements, values, strict=False):
        found.append({shift.first: [torque], shift.second: [torque]})
    of_springs = values[: -len(case.springs) - 2 : -1][::-1]
    for spring, torque in zip(case.springs, of_springs, strict=False):
        found.append({link: [torque] for link in (0, *spring.form)})
    return found


def pale_arms(results: Results, gear: int) -> set[str]:
    """Return lines without torque, by component and link; check that all others are dark."""
    scheme, style = scheme_of(results.case), Style()
    root = parsed(render(results, "structure", "svg", ONE_ROW, [gear]))
    wires, boxes, pale = list(coloured_wires(root)), outlines(root), set[str]()
    for device, by_link in zip(scheme.devices, torques_of(results, gear), strict=True):
        for link in device.links:
            name, where = scheme.name(link), (gear, device.name, link)
            met = [(line, color) for own, line, color in wires if own == name]
            met = [one for one in met if touch(one[0], boxes[device.name], 0.3)]
            colors = {color for _, color in met}
            if any(not abs(torque) < 1e-9 for torque in by_link[link]):
                assert style.ink in colors, where
            elif len(colors) == 1:  # torque can pass through a component at both of its sides
                box, (line, _) = boxes[device.name], met[0]
                passes = line[0] < box[0] - 1 and line[2] > box[2] + 1
                if len(met) == 1 and not passes:
                    assert colors == {style.faint}, where
                pale |= {f"{device.name} {name}"} if colors == {style.faint} else set()
    return pale


def test_arms_without_torque_are_pale() -> None:
    # Ford 10R80, gear 1; D is engaged, and nothing comes to it
    results = shipped_results("ford-10r80.yaml")
    pale = pale_arms(results, 1)
    assert {"P2 sun 1-2", "P2 input", "P3 carrier 1", "D sun 4", "D intermediate"} <= pale
    assert not [name for name in pale if name.startswith(("P1", "P4", "A", "B", "E"))]


@pytest.mark.slow
@pytest.mark.parametrize("path", some(SHIPPED), ids=lambda path: path.name)
def test_arms_are_pale_where_no_torque_is_in_all_gears(path: Path) -> None:
    results = vstatics.solve(vstatics.load(path))
    for gear in range(1, len(results.case.gears) + 1):
        pale_arms(results, gear)
