"""Colours of pictures: contrast by WCAG 2.2, and whether the colour-blind tell them apart."""

from collections.abc import Iterable
from itertools import combinations, product

import numpy as np
import pytest

from vstatics.pictures.drawing.style import Style
from vstatics.pictures.flow.signs import BAND_COVER

MATRICES = """\
0.367322 0.860646 -0.227968 0.280085 0.672501 0.047413 -0.011820 0.042940 0.968881
0.152286 1.052583 -0.204868 0.114503 0.786281 0.099216 -0.003882 -0.048116 1.051998
0.4122214708 0.5363325363 0.0514459929 0.2119034982 0.6806995451 0.1073969566 \
0.0883024619 0.2817188376 0.6299787005
0.2104542553 0.7936177850 -0.0040720468 1.9779984951 -2.4285922050 0.4505937099 \
0.0259040371 0.7827717662 -0.8086757660"""
"""Sight without green cones, and without red ones: Machado, Oliveira and Fernandes, A
physiologically-based model for simulation of color vision deficiency, IEEE TVCG 15 (2009),
severity 1. Cones and OKLab: B. Ottosson, A perceptual color space for image processing (2020).
"""
DEUTAN, PROTAN, CONES, OKLAB = (
    np.array(line.split(), float).reshape(3, 3) for line in MATRICES.splitlines()
)
SIGHTS = {"usual": np.eye(3), "deutan": DEUTAN, "protan": PROTAN}
APART = 0.1
"""Least distance of two colours in OKLab; .02 is just seen side by side."""


def light(colour: str) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    parts = np.array(channels(colour)) / 255
    return np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)


def channels(colour: str) -> list[int]:
    return [int(colour[at : at + 2], 16) for at in (1, 3, 5)]


def contrast(one: str, other: str) -> float:
    """Of WCAG 2.2: (L1 + .05) / (L2 + .05)."""
    low, high = sorted(float(light(colour) @ [0.2126, 0.7152, 0.0722]) for colour in (one, other))
    return (high + 0.05) / (low + 0.05)


def distance(one: str, other: str, sight: str) -> float:
    """Of two colours as somebody sees them, in OKLab."""
    seen = [np.clip(SIGHTS[sight] @ light(colour), 0, 1) for colour in (one, other)]
    first, second = (OKLAB @ np.cbrt(CONES @ colour) for colour in seen)
    return float(np.linalg.norm(first - second))


def test_contrast_is_that_of_wcag() -> None:
    assert contrast("#000000", "#ffffff") == pytest.approx(21)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.005)  # known to just fail


def test_small_texts_have_a_contrast_of_4_5_and_lines_of_3() -> None:
    for style in (Style(), Style(dark=True)):
        for colour in (style.ink, style.soft, style.engaged, style.lost, style.circulating):
            assert contrast(colour, style.paper) >= 4.5
        assert all(contrast(colour, style.paper) >= 3 for colour in style.colours)


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("sight", SIGHTS)
def test_readers_without_red_or_green_tell_colours_apart(dark: bool, sight: str) -> None:
    """Seven lines; links from what is engaged or without torque; parts of power and its losses.

    Bands of recirculating power let through what they cross, so the paper has a part in them.
    """

    def least(pairs: Iterable[tuple[str, str]]) -> float:
        return min(distance(*pair, sight) for pair in pairs)

    style = Style(dark=dark)
    assert len(set(style.colours)) == 7
    assert least(combinations(style.colours, 2)) > APART
    assert least(product(style.colours, (style.engaged, style.faint, style.ink))) > 0.9 * APART
    roles = style.engaged, style.lost, style.circulating, style.power, style.ink
    assert least(combinations(roles, 2)) > APART
    pairs = zip(channels(style.circulating), channels(style.paper), strict=True)
    mixed = [round(BAND_COVER * own + (1 - BAND_COVER) * under) for own, under in pairs]
    assert distance("#" + "".join(f"{part:02x}" for part in mixed), style.power, sight) > APART


def test_the_eighth_line_has_the_first_colour_and_a_dash() -> None:
    style = Style()
    assert [style.colour(number) for number in (0, 7)] == [style.colours[0]] * 2
    assert style.dash(0) != style.dash(7)
