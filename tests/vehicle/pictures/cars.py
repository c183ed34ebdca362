"""Boxes in vehicles, and what SVG of their pictures tells."""

from collections.abc import Sequence
from xml.etree import ElementTree as ET

from vstatics import Gear, Mechanism, Results, ShiftElement, Transmission, solve
from vstatics.pictures import render
from vstatics.pictures.drawing.style import Style
from vstatics.vehicle.case.vehicle import Vehicle

ENGINE = [(100.0, 100.0), (300.0, 160.0), (600.0, 120.0)]
"""Full load [rad/s], [N*m]."""
CAR = Vehicle(1200, 0.3, 0.012, 0.65, 4.1, engine=ENGINE)

VAN = Vehicle(1750, 0.32, 0.012, 0.9, 3.7, engine=[(100.0, 150.0), (400.0, 225.0), (600.0, 180.0)])


def box(
    ratios: Sequence[float], efficiency: float = 0.97, vehicle: Vehicle | None = CAR
) -> Results:
    """Pairs of gears, one for each gear: gear n has the ratio n."""
    output = len(ratios) + 2
    names = "RCDEFGHIJK" if ratios[0] < 0 else "1234567890"
    case = Transmission(
        output,
        [ShiftElement(1, number + 2) for number in range(len(ratios))],
        [Mechanism(n + 2, output, 0, ratio, efficiency) for n, ratio in enumerate(ratios)],
        [Gear([n + 1], name=names[n]) for n in range(len(ratios))],
        output=output,
        vehicle=vehicle,
    )
    return solve(case)


def marks(results: Results, kind: str, name: str, **style: bool) -> list[dict[str, str]]:
    """The data of the groups of a class in SVG, in their order."""
    svg = render(results, kind, "svg", Style(**style))  # type: ignore[arg-type]
    root = ET.fromstring(svg)  # noqa: S314 - our own
    return [
        {key.removeprefix("data-"): one for key, one in group.attrib.items() if key != "class"}
        for group in root.iter()
        if group.get("class") == name
    ]
