"""What stands in the groups of a picture, by their class, as written to SVG."""

import re
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree as ET

from tests.commands import vstatics
from vstatics import Results
from vstatics.pictures import render
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.drawing.svg import SVG

PAPER = Style()
Data = dict[str, str]
"""Of a group: ``data-mode`` is ``mode``."""


class Mark(NamedTuple):
    """A group with its data and its parts."""

    data: Data
    element: ET.Element

    @property
    def _sign(self) -> dict[str, str]:
        """Attributes of its only sign."""
        [sign] = self.element.iter(f"{{{SVG}}}circle")
        return sign.attrib

    @property
    def at(self) -> tuple[float, float]:
        """The place of its only sign [pt]."""
        return float(self._sign["cx"]), float(self._sign["cy"])

    @property
    def fill(self) -> str:
        """Of its only sign."""
        return self._sign["fill"]

    @property
    def points(self) -> list[tuple[float, float]]:
        """Those of its first path, which has straight pieces [pt]."""
        text = next(self.element.iter(f"{{{SVG}}}path")).attrib["d"]
        numbers = [float(one) for one in re.sub("[MLz]", " ", text).split()]
        return list(zip(numbers[::2], numbers[1::2], strict=True))


def tree(svg: bytes) -> ET.Element:
    return ET.fromstring(svg)  # noqa: S314 - our own, not from anywhere else


def marks(svg: bytes, kind: str) -> list[Mark]:
    return [
        Mark({key[5:]: value for key, value in one.attrib.items() if key.startswith("data-")}, one)
        for one in tree(svg).iter(f"{{{SVG}}}g")
        if one.get("class") == kind
    ]


def drawn(results: Results, kind: str, style: Style = PAPER, *gears: int) -> bytes:
    return render(results, kind, "svg", style, gears)


def plotted(tmp_path: Path, *arguments: object) -> bytes:
    """What ``vstatics plot`` writes."""
    said = vstatics("plot", *arguments, "-o", tmp_path / "picture.svg")
    assert said.status == 0, said.err
    return (tmp_path / "picture.svg").read_bytes()
