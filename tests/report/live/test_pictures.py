"""Pictures follow the sliders: what they show then is what the program draws at these numbers.

Layout stays, so heights are compared as parts of a lever, widths and places of speeds in points.
"""

from __future__ import annotations

import re
from collections import Counter
from random import Random
from typing import Any

import pytest

from tests.commands import CASES
from tests.report.live.places import place, with_numbers
from tests.report.live.test_core import SHIPPED
from vstatics import CaseError, Transmission, load, solve
from vstatics.report import gather
from vstatics.report.asked import AskedPage
from vstatics.report.live.lowered import lowered
from vstatics.report.live.page import live_fields, live_page
from vstatics.report.page_pictures import pictures
from vstatics.statics.results import Results

ASKED = AskedPage(("flow", "lever"))
MOVE = """(numbers) => {
  const there = {};
  for (const one of document.querySelectorAll(".slider")) {
    one.value = numbers[one.dataset.path];
    there[one.dataset.path] = Number(one.value);
    one.dispatchEvent(new Event("input", { bubbles: true }));
  }
  dispatchEvent(new Event("beforeprint")); // pictures of all gears
  return there;
}"""
LEVERS = """(selector) => [...document.querySelectorAll(`${selector} svg[data-lever]`)].map((svg) => {
  const found = {}, numbers = (path) => path.getAttribute("d").match(/-?[\\d.]+(e-?\\d+)?/g).map(Number);
  const root = JSON.parse(svg.dataset.lever);
  for (const element of svg.querySelectorAll("[data-follows]")) {
    const { of, lever, node, speed, names } = JSON.parse(element.dataset.follows), own = root.levers[lever];
    const key = [of, lever, own?.nodes[node] && of !== "scale" && of !== "line" ? own.nodes[node].link : "", speed ?? "", names ?? ""].join();
    const paths = [...element.querySelectorAll("path")], text = element.querySelector("text")?.textContent;
    const title = element.querySelector("title")?.textContent;
    if (["ratio", "torque number", "speed number", "pair"].includes(of)) found[key] = text;
    else if (["said", "carried", "name"].includes(of)) found[key] = title;
    else if (of === "speed") { const [a, , b] = numbers(paths[0]); found[key] = [a - own.speeds[0], b - own.speeds[0]]; }
    else if (of === "scale") found[key] = [numbers(paths[0])[0] - own.speeds[0]];
    else if (of === "unit") {
      const [start, end] = numbers(paths[1]).filter((_, n) => n % 2 === 0);
      found[key] = [start - numbers(paths[0])[0], text];
    }
    else if (of === "torque") found[key] = paths.flatMap((path) => numbers(path).filter((_, n) => n % 2 === 0)).map((x) => x - own.at);
    else if (of === "link") {
      const all = numbers(paths[0]);
      found[key] = [all.length > 9 ? all[5] : all[1]]; // where its point is
    }
  }
  return { gear: root.gear, pale: svg.closest("figure")?.querySelector(".why")?.textContent ?? "", found };
})"""

FLOWS = """(selector) => [...document.querySelectorAll(`${selector} svg[data-flow]`)].map((svg) => {
  const root = JSON.parse(svg.dataset.flow), found = {}, texts = {};
  const parts = [...svg.querySelectorAll("[data-follows]")].map((element) => ({ element, ...JSON.parse(element.dataset.follows) }));
  for (const { element, of, nodes, loop, node, run, port, link, power, powers } of parts) {
    const path = element.querySelector("path"), title = element.querySelector("title")?.textContent.split("\\n")[0];
    const text = [...element.querySelectorAll("text")].map((one) => one.textContent).join(" ");
    const depths = () => path.getAttribute("d").match(/-?[\\d.]+(e-?\\d+)?/g).map(Number).filter((_, n) => n % 2);
    const high = () => Math.max(...depths()) - Math.min(...depths());
    if (of === "band" && !loop) found[`band ${[...nodes].sort().join()}`] = [parseFloat(getComputedStyle(path).strokeWidth), title, power];
    else if (of === "band") found[`loop ${[...loop].sort().join()}`] = [parseFloat(getComputedStyle(path).strokeWidth), "", power];
    else if (of === "port" && nodes && !loop) found[`band ${[...nodes].sort().join()}`] = [high(), title, power]; // cut
    else if (of === "port" && port) found[`${port} ${link}`] = [high(), title, power];
    else if (of === "node") found[node] = [0, title, powers[0]];
    else if (of === "lost") texts[run] = text;
    else if (of === "head") texts.head = text;
  }
  const nodes = parts.filter(({ of }) => of === "node");
  const scales = nodes.map(({ powers, thick: [top, bottom], run }) => {
    const own = nodes.filter((one) => one.run === run).map((one) => one.powers[0]);
    return (bottom - top) / Math.max(...own);
  });
  const hatched = parts.filter(({ hatched }) => hatched).map(({ nodes }) => `band ${[...nodes].sort().join()}`);
  return {
    gear: root.gear, pale: svg.closest("figure")?.querySelector(".why")?.textContent ?? "", found, texts,
    scale: Math.max(...scales), through: Math.max(...nodes.map(({ powers }) => powers[0])), hatched,
  };
})"""


def drawn(case: Transmission) -> Results | None:
    """What the program has of a case; None if it refuses it."""
    try:
        return solve(case)
    except CaseError:
        return None


def opened(page: Any, case: Transmission) -> None:
    page.set_content(live_page(gather(solve(case), has_marks=True, asked=ASKED)))


def close(one: Any, other: Any) -> bool:
    """Numbers to a tenth of a point, texts as they are but for the last digit."""
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(close, one, other))
    return bool(abs(one - other) <= 0.1 if isinstance(one, float | int) else one == other)


def same_lever(one: dict[str, Any], other: dict[str, Any], where: Any) -> None:
    """All but heights is the same; of these the parts into which points divide a lever."""
    found, expected = one["found"], other["found"]
    assert found.keys() == expected.keys(), where
    heights: dict[str, list[tuple[float, float]]] = {}
    for key, value in found.items():
        of, lever, *_ = key.split(",")
        if of == "link":
            heights.setdefault(lever, []).append((value[0], expected[key][0]))
        elif of == "name":  # names the points from one end to the other
            assert sorted(value.split(", ")[1:]) == sorted(expected[key].split(", ")[1:]), where
        else:
            assert close(value, expected[key]), (key, value, expected[key], where)
    for pairs in heights.values():
        mine, others = map(parts, zip(*pairs, strict=True))
        turned = [100 - part for part in others]
        assert close(mine, others) or close(mine, turned), (mine, others, where)


def parts(heights: tuple[float, ...]) -> list[float]:
    """Of a length from end to end, 100 pt long."""
    low, high = min(heights), max(heights)
    return [100 * (one - low) / ((high - low) or 1.0) for one in heights]


def same_flow(one: dict[str, Any], expected: dict[str, Any], where: Any) -> None:
    """All powers are the same, as they are told and as wide as they are in the scale of the page."""
    scale = min(one["scale"], 90 / expected["through"])
    for key, (wide, title, _) in one["found"].items():
        if key not in expected["found"]:  # nothing flows there
            assert wide < 0.7 or "0.000" in title or "<0.001" in title, (key, wide, title, where)
            continue
        _, said, power = expected["found"][key]
        nothing = r", lost <0.001(, 0.00 kW)?$"  # an arrow without a width
        mine = title if " lost " in said else re.sub(nothing, "", title)
        assert words(mine) == words(said), (key, title, said, where)
        if key.startswith(("band", "port")) and key not in one["hatched"]:
            assert abs(wide - max(0.6, power * scale)) < 0.1, (key, wide, power * scale, where)
    for key, text in one["texts"].items():
        pair = text, expected["texts"].get(key, text)
        if key == "head":  # what else it says depends on what there is to say
            pair = text.partition(" lost ")[0], pair[1].partition(" lost ")[0]
        assert pair[0] == pair[1], (key, pair, where)


def words(title: str) -> list[str]:
    """In any order; what is divided by a convention stays marked as it was."""
    kept = re.sub(", (by convention|within friction)", "", title)
    return sorted(re.split(r"[ →:]+", kept))


@pytest.mark.slow
def test_levers_and_power_flows_follow(browser: Any) -> None:
    """Speeds, torques, ratios, powers and all texts; bands are as wide as their power."""
    compare(browser, "simpson.yaml", 3)


@pytest.mark.slow
@pytest.mark.parametrize("name", SHIPPED)
def test_pictures_of_each_shipped_case_follow(browser: Any, name: str) -> None:
    compare(browser, name, 5)


def compare(browser: Any, name: str, count: int) -> None:
    case = load(CASES / name)
    page, other = browser.new_page(), browser.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    opened(page, case)
    fields = [*live_fields(case, lowered(case)["numbers"])]
    chance, told = Random(name), Counter[str]()  # noqa: S311
    for _ in range(count):
        there = page.evaluate(MOVE, place(fields, chance))
        try:
            results = drawn(with_numbers(case, there))
        except CaseError:
            continue
        moved = [page.evaluate(script, "main") for script in (LEVERS, FLOWS)]
        assert not errors
        if results is None:
            continue
        made = pictures(results, ASKED, marked=True).of_gears
        for kind, script, shown, same in zip(
            ("lever", "flow"), (LEVERS, FLOWS), moved, (same_lever, same_flow), strict=True
        ):
            other.set_content(
                "".join(f"<figure>{svg}</figure>" for one in made[kind] for svg in one.sheets)
            )
            expected = {one["gear"]: one for one in other.evaluate(script, "body")}
            for one in shown:
                if not one["pale"]:
                    told[kind] += 1
                    same(one, expected[one["gear"]], (one["gear"], there))
    assert told["lever"]
    assert told["flow"]
    page.close()
    other.close()
