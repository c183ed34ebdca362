"""Pages of pictures as a browser shows them: how large they are, their letters, what overlaps."""

from collections.abc import Sequence
from typing import Any, NamedTuple

CAPITAL = 0.73
"""Height of capitals of DejaVu Sans over the size of its letters."""
TOUCHING = 0.5
"""Boxes of letters may meet by so much. [pt]"""


class MeasuredPage(NamedTuple):
    """A page of a picture."""

    width: float
    """[mm]"""
    height: float
    letters: Sequence[tuple[str, float]]
    """Each text with the size of its letters [pt]."""
    overlaps: Sequence[tuple[str, str]]
    """Texts whose boxes, of capital height, overlap."""
    outside: Sequence[str]
    """Texts that leave the page."""
    covered: Sequence[str]
    """Texts over which something else is painted."""


_MEASURE = """([capital, touching]) => [...document.querySelectorAll("body > svg")].map((svg) => {
  const [wide, high] = [svg.getAttribute("width"), svg.getAttribute("height")].map(parseFloat);
  const texts = [...svg.querySelectorAll("text")].filter((one) => one.textContent.trim());
  const placed = texts.map((one) => {
    const box = one.getBBox(), size = parseFloat(getComputedStyle(one).fontSize);
    const to = svg.getScreenCTM().inverse().multiply(one.getScreenCTM());
    const base = one.getStartPositionOfChar(0).y, part = Math.hypot(to.a, to.b);
    const at = (x, y) => [to.a * x + to.c * y + to.e, to.b * x + to.d * y + to.f];
    const [left, right, top] = [box.x, box.x + box.width, base - capital * size];
    const ends = [at(left, top), at(right, top), at(right, base), at(left, base)];
    return { text: one.textContent.trim(), size: size * part, ends };
  });
  const ways = (ends) => [[0, 1], [1, 2]].map(([i, j]) => {
    const [x, y] = [ends[j][0] - ends[i][0], ends[j][1] - ends[i][1]], long = Math.hypot(x, y) || 1;
    return [x / long, y / long];
  });
  const over = (one, other) => [...ways(one), ...ways(other)].every(([x, y]) => {
    const [a, b] = [one, other].map((ends) => ends.map((end) => x * end[0] + y * end[1]));
    return Math.min(Math.max(...a), Math.max(...b)) - Math.max(Math.min(...a), Math.min(...b)) > touching;
  });
  const overlaps = [];
  placed.forEach((one, place) => placed.slice(place + 1).forEach((other) => {
    if (over(one.ends, other.ends)) overlaps.push([one.text, other.text]);
  }));
  const outside = placed.filter(({ ends }) => ends.some(([x, y]) =>
    x < -touching || y < -touching || x > wide + touching || y > high + touching));
  const covered = texts.filter((one) => {
    one.scrollIntoView({ block: "center" });
    const letter = one.textContent.search(/\\S/), box = one.getExtentOfChar(letter);
    const at = new DOMPoint(box.x + box.width / 2, box.y + box.height / 2).matrixTransform(one.getScreenCTM());
    const top = document.elementFromPoint(at.x, at.y);
    return top && !one.contains(top) && top.tagName === "path" && getComputedStyle(top).fill !== "none";
  });
  const said = (some) => some.map((one) => one.text ?? one.textContent.trim());
  return [wide, high, placed.map((one) => [one.text, one.size]), overlaps, said(outside), said(covered)];
})"""


def measured(browser: Any, svgs: Sequence[bytes]) -> list[MeasuredPage]:
    """Many pages at once, as a browser has them on paper: 1 pt is a unit of the picture."""
    shown = "\n".join(svg.decode().partition("?>")[2] for svg in svgs)
    context = browser.new_context()
    window = context.new_page()
    window.set_content(f"<!DOCTYPE html><meta charset=utf-8><body>{shown}</body>")
    found = window.evaluate(_MEASURE, [CAPITAL, TOUCHING])
    context.close()
    assert len(found) == len(svgs)
    return [
        MeasuredPage(
            wide / 72 * 25.4,
            high / 72 * 25.4,
            [(text, size) for text, size in letters],
            [(one, other) for one, other in overlaps],
            outside,
            covered,
        )
        for wide, high, letters, overlaps, outside, covered in found
    ]
