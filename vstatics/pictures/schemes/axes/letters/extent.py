"""All letters of several axes at their places, and how much paper is needed with them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf
from typing import NamedTuple

from vstatics.pictures.drawing.labels import Point
from vstatics.pictures.drawing.style import WIDE_MARGIN
from vstatics.pictures.schemes.axes.letters.labels import DeviceLabel, device_labels
from vstatics.pictures.schemes.axes.letters.link_names import fixed_names
from vstatics.pictures.schemes.axes.letters.obstacles import Obstacle, Rectangle, obstacles
from vstatics.pictures.schemes.axes.places import AxesPlaces
from vstatics.pictures.schemes.scheme import Scheme


class AxesLetters(NamedTuple):
    """Names of links and of devices at their places, and what else there is."""

    names: Sequence[Rectangle]
    solid: Sequence[Obstacle]
    labels: Mapping[int, Sequence[DeviceLabel]]

    @classmethod
    def of(cls, found: AxesPlaces, scheme: Scheme, wide: float = inf) -> AxesLetters:
        """All letters; those of devices only if there is room for all else in a width [pt]."""
        solid = list(obstacles(found))
        names = fixed_names(found, scheme, solid)
        bare = cls(names, solid, {})
        low, high = bare.extent(found)
        if high[0] - low[0] > wide:
            return bare
        return bare._replace(labels=device_labels(found, names, solid))

    def extent(self, found: AxesPlaces) -> tuple[Point, Point]:
        """The lower left and the upper right corner with room for all but the head [pt]."""
        boxes = [*self.names, *(one.box for one in self.solid)]
        boxes += [one.box for own in self.labels.values() for one in own]
        for link, span in found.spans.items():
            for height in (span.height, -span.height):
                y = found.y(found.axis_of(link), height)
                boxes.append(Rectangle(span.left - 8, y, span.right + 8, y))
        lefts, lows, rights, highs = zip(*boxes, strict=True)
        margin = WIDE_MARGIN
        return (min(lefts) - margin, min(lows) - margin), (
            max(rights) + margin,
            max(highs) + margin,
        )
