"""Positions of all texts of a diagram with several axes, and the size of paper needed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.style import WIDE_MARGIN
from vstatics.pictures.schemes.axes.letters.labels import DeviceLabel, device_labels
from vstatics.pictures.schemes.axes.letters.link_names import fixed_names, free_names
from vstatics.pictures.schemes.axes.letters.obstacles import Obstacle, Rectangle, obstacles
from vstatics.pictures.schemes.axes.places import AxesPlaces
from vstatics.pictures.schemes.scheme import Scheme


class AxesLetters(NamedTuple):
    """Names of links and components with positions, and the obstacles to avoid."""

    names: Sequence[Rectangle]
    free: Sequence[tuple[int, Point, str]]
    """Links without input or output, each with the point and the alignment of the name."""
    solid: Sequence[Obstacle]
    labels: Mapping[int, Sequence[DeviceLabel]]

    @classmethod
    def of(cls, placing: AxesPlaces, scheme: Scheme, wide: float = inf) -> AxesLetters:
        """Return all texts; components have names only if the bare diagram fits a width [pt]."""
        solid = list(obstacles(placing))
        free = list(free_names(placing, scheme, solid))
        names = fixed_names(placing, scheme, free)
        bare = cls(names, free, solid, {})
        low, high = bare.extent(placing)
        if high[0] - low[0] > wide:
            return bare
        return bare._replace(labels=device_labels(placing, names, solid))

    def extent(self, placing: AxesPlaces) -> tuple[Point, Point]:
        """Return the lower left and the upper right corner of the diagram without heading [pt]."""
        boxes = [*self.names, *(item.box for item in self.solid)]
        boxes += [item.box for labels in self.labels.values() for item in labels]
        for link, span in placing.spans.items():
            for height in (span.height, -span.height):
                y = placing.y(placing.axis_of(link), height)
                boxes.append(Rectangle(span.left - 8, y, span.right + 8, y))
        lefts, lows, rights, highs = zip(*boxes, strict=True)
        margin = WIDE_MARGIN
        return (min(lefts) - margin, min(lows) - margin), (
            max(rights) + margin,
            max(highs) + margin,
        )
