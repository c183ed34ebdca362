"""Countershaft boxes made by chance, and the parts of their pictures as SVG."""

import random
import re
from typing import Any, NamedTuple
from xml.etree import ElementTree as ET

from vstatics import Gear, ShiftElement, Transmission, loads, solve
from vstatics.core.elements import Drawing, Element, transmission
from vstatics.pictures import render
from vstatics.pictures.drawing.style import Style

SVG = "{http://www.w3.org/2000/svg}"


def countershaft_box(chance: random.Random) -> Transmission:
    """An input shaft, one to three countershafts with idle wheels and dogs, an output shaft."""
    names = ["input", "output"]
    elements: list[Element] = []
    dogs: list[ShiftElement] = []

    def link(name: str) -> int:
        names.append(name)
        return len(names)

    def pair(name: str, first: int, second: int) -> None:
        teeth = {"first": chance.randint(15, 45), "second": chance.randint(15, 60)}
        elements.append(Element(name, "gear_pair", {"first": first, "second": second}, teeth))

    shafts = [link(f"counter {number}") for number in range(1, chance.randint(1, 3) + 1)]
    for number in range(1, chance.randint(2, 8) + 1):
        shaft = shafts[(number - 1) % len(shafts)]
        wheel = link(f"wheel {number}")
        if chance.random() < 0.7:  # it idles on the countershaft, or on the input
            pair(f"p{number}", 1, wheel)
            dogs.append(ShiftElement(wheel, shaft, f"d{number}", "dog_clutch"))
        else:
            pair(f"p{number}", wheel, shaft)
            dogs.append(ShiftElement(1, wheel, f"d{number}", "dog_clutch"))
    for number, shaft in enumerate(shafts, 1):
        pair(f"f{number}", shaft, 2)
    gears = [Gear([number]) for number in range(1, len(dogs) + 1)]
    drawing = Drawing(len(names), elements)
    joined: dict[str, Any] = {"shift_elements": dogs, "link_names": names, "gears": gears}
    return transmission(drawing, **joined, input=1, output=2)


PAIRS = {
    "gear_pair": {"first": 20, "second": 60},
    "internal_pair": {"first": 20, "second": 60},
    "idler": {"first": 20, "idler": 25, "second": 36},
    "bevel_pair": {"first": 11, "second": 41},
    "worm": {"worm": 2, "wheel": 40},
    "chain": {"first": 21, "second": 35},
    "belt": {"first": 60, "second": 120},
}
"""Teeth of one pair of every kind; of a belt diameters."""


def one_pair(kind: str) -> Transmission:
    """A motor behind a clutch, a pair, a shaft behind a dog clutch."""
    first, *_, second = PAIRS[kind]
    links = {first: 2, second: 3}
    drive = Element("drive", kind, links, PAIRS[kind])
    shifts = [ShiftElement(1, 2, "K"), ShiftElement(3, 4, "d", "dog_clutch")]
    names, gears = ["motor", "shaft", "wheel", "out"], [Gear([1, 2])]
    joined: dict[str, Any] = {"shift_elements": shifts, "link_names": names, "gears": gears}
    return transmission(Drawing(4, [drive]), **joined, input=1, output=4)


SIX_SPEED = """
links: [engine, input, counter, output, w1, w2, w3, w4, w6, idler, wr, diff]
output: diff
shift_elements: {K: [engine, input]%s}
elements: {%s}
gears: {%s}
"""
SIX_PAIRS = """\
constant: input counter 20 43, p1: counter w1 15 38, p2: counter w2 22 34, p3: counter w3 29 31, \
p4: counter w4 35 27, p6: counter w6 45 20, r1: counter idler 14 20, r2: idler wr 20 36, \
final: output diff 17 67"""
"""Links and teeth."""


def six_speed() -> Transmission:
    """A manual box: a constant pair, five for gears, two for reverse, a final drive."""
    pair = r"{kind: gear_pair, first: \1, second: \2, teeth: {first: \3, second: \4}}"
    pairs = re.sub(r"(\w+) (\w+) (\d+) (\d+)", pair, SIX_PAIRS)
    dogged = enumerate(("w1", "w2", "w3", "w4", "input", "w6", "wr"), 1)
    dogs = [f", s{n}: {{kind: dog_clutch, links: [{link}, output]}}" for n, link in dogged]
    gears = ", ".join(f'"{n}": [K, s{n}]' for n in range(1, 8))
    return loads(SIX_SPEED % ("".join(dogs), pairs, gears))


class PlacedWheel(NamedTuple):
    """A wheel as its picture has it [pt]."""

    mechanism: str
    link: str
    x: float
    low: float
    high: float


def parsed(svg: bytes | str) -> ET.Element:
    return ET.fromstring(svg)  # noqa: S314 - our own


def svg_of(case: Transmission, gears: tuple[int, ...] = ()) -> ET.Element:
    return parsed(render(solve(case), "stick", "svg", Style(), gears))


def points(path: ET.Element) -> list[tuple[float, float]]:
    """All points of a path of M and L."""
    found = re.findall(r"[ML](\S+) ([^MLz\s]+)", path.attrib["d"])
    return [(float(x), float(y)) for x, y in found]


def of_class(root: ET.Element, kind: str) -> list[ET.Element]:
    return [one for one in root.iter() if one.get("class") == kind]


def wheels(root: ET.Element) -> list[PlacedWheel]:
    found = []
    for group in of_class(root, "wheel"):
        places = [at for path in group.iter(f"{SVG}path") for at in points(path)]
        xs, ys = zip(*places, strict=True)
        names = group.attrib["data-mechanism"], group.attrib["data-link"]
        found.append(PlacedWheel(*names, (min(xs) + max(xs)) / 2, min(ys), max(ys)))
    return found


def axes_by_link(root: ET.Element) -> dict[str, float]:
    """The height of the axis of each link [pt]."""
    heights = {one.attrib["data-axis"]: points(one)[0][1] for one in of_class(root, "axis")}
    links = of_class(root, "link")
    return {one.attrib["data-name"]: heights[one.attrib["data-axis"]] for one in links}
