"""What a browser has under the letters of a picture: other letters, and lines."""

from collections.abc import Sequence
from typing import Any

CAPITAL = 0.73
"""Height of capitals of DejaVu Sans over the size of its letters."""
TOUCHING = 0.5
"""Boxes of letters may meet by so much. [pt]"""

_MEASURE = """([capital, touching]) => {
  const svg = document.querySelector("svg"), back = svg.getScreenCTM().inverse();
  const boxes = [...svg.querySelectorAll("text")].filter((one) => one.textContent.trim()).map((one) => {
    const box = one.getBBox(), size = parseFloat(getComputedStyle(one).fontSize);
    const to = back.multiply(one.getScreenCTM()), base = one.getStartPositionOfChar(0).y;
    const at = (x, y) => ({ x: to.a * x + to.c * y + to.e, y: to.b * x + to.d * y + to.f });
    const [a, b] = [at(box.x, base - capital * size), at(box.x + box.width, base)];
    const scale = Math.hypot(to.a, to.b);
    return { text: one.textContent.trim(), size: size * scale, left: a.x, low: a.y, right: b.x, high: b.y };
  });
  const letters = boxes.flatMap((one, place) => boxes.slice(place + 1).filter((other) =>
    Math.min(one.right, other.right) - Math.max(one.left, other.left) > touching
    && Math.min(one.high, other.high) - Math.max(one.low, other.low) > touching)
    .map((other) => [one.text, other.text]));
  const under = [];
  for (const path of svg.querySelectorAll("path")) {
    const style = getComputedStyle(path), group = path.closest(".link, .element, .mechanism, .port, .wheel");
    if (!group || style.stroke === "none") continue;
    const to = back.multiply(path.getScreenCTM()), thick = parseFloat(style.strokeWidth) / 2;
    const known = `${group.getAttribute("class")} ${group.dataset.name ?? group.dataset.port ?? group.dataset.link}`;
    const seen = new Set();
    for (let along = 0, long = path.getTotalLength(); along <= long; along += 0.5) {
      const at = path.getPointAtLength(along);
      const [x, y] = [to.a * at.x + to.c * at.y + to.e, to.b * at.x + to.d * at.y + to.f];
      for (const box of boxes) {
        if (x > box.left - thick && x < box.right + thick && y > box.low - thick && y < box.high + thick) {
          seen.add(box.text);
        }
      }
    }
    for (const text of seen) under.push([text, known]);
  }
  return [letters, under, Math.min(...boxes.map((one) => one.size))];
}"""


def under_letters(
    browser: Any, svg: str
) -> tuple[Sequence[tuple[str, str]], Sequence[tuple[str, str]], float]:
    """Texts over texts, texts over lines of links and devices, the size of the least letters [pt].

    Boxes have the height of capitals; half the width of a line belongs to it.
    """
    context = browser.new_context()
    window = context.new_page()
    shown = svg.partition("?>")[2] or svg
    window.set_content(f"<!DOCTYPE html><meta charset=utf-8><body>{shown}</body>")
    letters, under, least = window.evaluate(_MEASURE, [CAPITAL, TOUCHING])
    context.close()
    return [(one, other) for one, other in letters], [(one, line) for one, line in under], least
