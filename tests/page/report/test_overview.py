"""The overview line and what `explain` tells, as parts of the page."""

import re
from html import unescape
from pathlib import Path

import pytest

from tests.commands import vstatics
from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
from vstatics.core.explain import formula
from vstatics.core.flow.power import flows
from vstatics.core.summary import summarize
from vstatics.core.tables.html import Markup, joined, printed
from vstatics.page.report import explained as report_explained
from vstatics.page.report.explained import explained
from vstatics.page.report.material import Material
from vstatics.page.report.overview import alerts, overview
from vstatics.page.report.page_pictures import Pictures


def words(*parts: str) -> str:
    """What a reader sees."""
    return unescape(re.sub("<[^>]+>", " ", printed(joined(*map(Markup, parts)))))


def set_of(**others: object) -> Material:
    """One set: ring held, then one piece. i = 1 - u, eta = (1 - u eta_0)/(1 - u), Willis."""
    elements = [ShiftElement(2, name="B"), ShiftElement(1, 2, "C")]
    gears = [Gear([1], name="low"), Gear([2], name="high")]
    case = Transmission(3, elements, [Mechanism(1, 2, 3, -2.5, 0.93)], gears)
    return material_of(case.replace(**others))


def material_of(case: Transmission) -> Material:
    """What the line and the explanations are made of; nothing is drawn."""
    results = solve(case)
    messages = list(map(str, results.messages))
    return Material(results, {}, summarize(results), flows(results), Pictures(), messages, "")


def test_each_figure_has_its_gear() -> None:
    """Willis: i = 3.5, eta = 3.325/3.5 = .95, and the ring is held by 2.5 x .93 = 2.325."""
    said = " ".join(words(*overview(set_of())).split()).replace(" ,", ",")
    assert "gears 2 spread 3.500, gear low to high" in said
    assert "lowest efficiency 0.950, gear low" in said
    assert "largest torque of a shift element 2.325 × input, B, gear low" in said
    assert "alerts none" in said


def test_alerts_are_counted_by_weight_and_linked() -> None:
    """Gear N lacks a condition for its speeds, gear 12 has one too many; see docs/method.md."""
    gears = [Gear([1, 2], name="12"), Gear([], name="N"), Gear([1], name="1")]
    material = set_of(gears=gears)
    [line] = overview(material)
    lists = "".join(alerts(material.messages))
    assert material.messages
    for name in re.findall(r'href="#(errors|warnings|notes)"', line):
        assert f'id="{name}"' in lists
    counted = sum(map(int, re.findall(r">(\d+) (?:error|warning|note)", line)))
    assert counted == len(material.messages) == lists.count("<li")


def test_what_is_explained_has_the_minus_of_print_and_names_as_they_are() -> None:
    """Willis: w_1 - u w_2 + (u - 1) w_3 = 0, so i = 1 - u with the ring held."""
    material = set_of(link_names=["sun 1-2", "ring", "carrier"])
    low, _ = explained(material)
    said = words(*low)
    assert "i = w[sun 1-2]/w_carrier = 1 − u_D1" in said
    assert "w[sun 1-2] − u_D1 w_ring + (u_D1 − 1) w_carrier = 0" in said
    assert not re.search(r"(?<!\d)\.\d|-\d\.", said)
    [neutral] = explained(set_of(gears=[Gear([], name="N")]))  # nothing holds the set
    assert "solution" in words(*neutral)


def test_without_flint_the_gears_say_nothing_of_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(formula, "missing", lambda *_: "the formula needs the package python-flint")
    monkeypatch.setattr(report_explained, "missing", lambda *_: "needs the package python-flint")
    low, _ = explained(set_of())
    assert "flint" not in words(*low)
    assert "i = w_1/w_3 = 3.5" in words(*low)


def test_a_page_tells_as_many_notes_as_check_does_and_prints_none(tmp_path: Path) -> None:
    file = tmp_path / "set.yaml"
    file.write_text(
        "elements:\n  P: {kind: planetary, sun: a, ring: b, carrier: c, "
        "teeth: {sun: 30, ring: 66, planet: 18}, planets: 3}\n"
        "links: [a, b, c]\nshift_elements: {B: [b, housing]}\ngears: {low: [B]}\n",
        "utf-8",
    )
    counts = []
    for allow in ((), ("--allow", "N318")):
        counts.append(vstatics("check", file, *allow).err.count(" note: "))
        made = vstatics("report", file, "--sections", "overview", *allow, "-o", "-")
        assert made.err == ""
        assert made.out.count('<li class="note">') == counts[-1]
        assert (f">{counts[-1]} note" in made.out) == (counts[-1] > 0)
    assert counts[0] > counts[1]
