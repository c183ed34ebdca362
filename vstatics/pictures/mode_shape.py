"""The shape of a mode over the links in their row."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any, NamedTuple

from vstatics.pictures.chart import Chart
from vstatics.pictures.labels import Point
from vstatics.pictures.mode_links import ModeLinks
from vstatics.pictures.mode_row import SPRING_NUMBER_SIZE, Axis
from vstatics.pictures.style import Style, number
from vstatics.pictures.svg import told

Segment = tuple[Point, Point]


class AmplitudeBand(NamedTuple):
    """Where amplitudes are drawn."""

    rest: float
    """The ordinate of what stands. [pt]"""
    unit: float
    """The length of an amplitude of 1. [pt]"""

    def at(self, amplitude: float) -> float:
        """The ordinate of an amplitude [pt]."""
        return self.rest + self.unit * amplitude


def draw(
    axis: Axis, band: AmplitudeBand, links: ModeLinks, shape: Mapping[str, float], style: Style
) -> None:
    """Amplitudes as bars from the line of rest, joined as the links are.

    Parameters
    ----------
    shape : mapping of str to float
        Amplitudes of links by their names, of 1 at most.
    """
    tips = [(axis.at(place), band.at(shape[name])) for place, name in enumerate(links.names)]
    _draw_scale(axis, band, len(tips), style)
    _draw_devices(axis.panel, tips, links, style)
    for name, link, heavy, (x, y) in zip(
        links.names, links.numbers, links.heavy, tips, strict=True
    ):
        colour = style.colour(link - 1)
        look: dict[str, Any] = {"color": colour, "linewidth": 1.0, "marker": "o", "zorder": 4}
        fill = {"markerfacecolor": colour if heavy else style.paper, "markersize": 3.6}
        said = told(f"{name}: {number(shape[name])}")
        axis.panel.line((x, band.rest), (x, y), markevery=[1], gid=said, **look, **fill)


def _draw_scale(axis: Axis, band: AmplitudeBand, count: int, style: Style) -> None:
    """Lines at rest and at the largest amplitudes, and one for each link."""
    start, end = axis.left, axis.at(count - 1) + 0.5 * axis.pitch
    for amplitude, text in ((-1, "−1"), (0, "0"), (1, "+1")):
        y = band.at(amplitude)
        wide = 0.4 if amplitude else 0.8
        axis.panel.line((start, y), (end, y), color=style.faint, linewidth=wide)
        how: dict[str, Any] = {"ha": "right", "va": "center", "fontsize": SPRING_NUMBER_SIZE}
        axis.panel.write(start - 3, y, text, color=style.soft, **how)
    low, high = band.at(-1), band.at(1)
    upright = [((x, low), (x, high)) for x in map(axis.at, range(count))]
    axis.panel.lines(upright, color=style.faint, linewidth=0.3)


def _draw_devices(panel: Chart, tips: list[Point], links: ModeLinks, style: Style) -> None:
    """Lines between the links that devices join; dashed where a twist has more than two."""
    rigid: list[Segment] = []
    shafts: list[Segment] = []
    others: list[Segment] = []
    for device in links.devices:
        pairs = [(tips[one], tips[other]) for one, other in pairwise(device.members)]
        (rigid if not device.elastic else shafts if len(pairs) == 1 else others).extend(pairs)
    panel.lines(rigid, color=style.faint, linewidth=1.2)
    panel.lines(others, color=style.ink, linewidth=1.2, linestyle=(0, (3, 1.5)))
    panel.lines(shafts, color=style.ink, linewidth=1.2)
