"""Typical mistakes in a case get advice, and cause no further messages."""

import pytest

from vstatics.core.errors import ReadError
from vstatics.core.readers import read

CASE = """\
input: s
output: c
elements:
  P: {kind: planetary, sun: s, ring: r, carrier: c, teeth: {sun: 30, ring: 70}}
shift_elements:
  B: [r, housing]
  C: [r, c]
load: {speed: 2000 rpm, torque: 160 N*m}
gears: {low: [B], high: [C]}
"""


def errors(old: str, new: str) -> list[str]:
    assert old in CASE
    with pytest.raises(ReadError) as raised:
        read(CASE.replace(old, new).encode(), "case.yaml")
    return [problem.message for problem in raised.value.problems]


@pytest.mark.parametrize("key", ["shift_elements", "elements"])
def test_a_mistyped_key_of_links_causes_one_message(key: str) -> None:
    others = {"elements": ("element", "gear_sets", "planetary")}
    for mistyped in others.get(key, ("shift_element", "clutches", "brakes")):
        [message] = errors(f"\n{key}", f"\n{mistyped}")
        assert message == f"unknown key `{mistyped}`; did you mean `{key}`?"


def test_a_decimal_comma_and_a_missing_blank_get_advice() -> None:
    assert "write a decimal point, not a decimal comma" in errors("2000 rpm", "2000,5 rpm")[-1]
    [gear] = errors("\nelements", "\n1: 10\nelements")  # the share of a gear, without `time`
    assert gear.startswith("unknown key `1`, expected `name`, ")
    assert errors("kind: planetary", "kind:planetary") == [
        "elements.P: `kind` is missing; write a blank after the colon"
    ]
    assert "write a blank after the colon: `speed: 9`" in errors("speed: 2000 rpm", "speed:9")[0]


def test_a_missing_comma_between_shift_elements_is_named() -> None:
    """YAML reads the words of a list without commas as a single text."""
    [message] = errors("low: [B]", "low: [B C]")
    assert message.endswith("; write a comma between the names: `B, C`")


def test_a_dash_without_a_blank_is_named() -> None:
    """Source: github.com/adrienverge/yamllint/issues/197 (YAML reads the list as a text)."""
    [message] = errors("gears: {low: [B], high: [C]}", "gears:\n  low:\n    -B\n  high: [C]")
    assert message.endswith("; write a blank after the dash of each item, such as `- A`")
    [message] = errors("gears: {low: [B], high: [C]}", "gears: {low: -1, high: [C]}")
    assert "dash" not in message
    [message] = errors("gears: {low: [B], high: [C]}", "gears:\n  low:\n  - B\n  -C\n  high: [C]")
    assert message.endswith("; write a blank after the dash of each item, such as `- A`")


def test_the_unknown_keys_of_a_mapping_without_kind_are_named() -> None:
    """Source: an efficiency per direction in modelica/ModelicaStandardLibrary/issues/2934."""
    both = "carrier: c, efficiency: {forward: 0.98, backward: 0.97}"
    assert errors("carrier: c", both)[0].endswith("; unknown: `forward` and `backward`")


def test_a_pulley_in_millimetres_and_planets_of_a_pair_get_advice() -> None:
    belt = "{kind: belt, first: s, second: r, planets: 3, diameters: {first: 9 mm, second: 8}}"
    planets, size = errors("\nelements:", f"\nelements:\n  V: {belt}")
    assert size.endswith("expected a number or a calculation such as -96/39 (without a unit)")
    assert "are keys of gear sets" not in planets  # the belt is one


def test_a_ratio_instead_of_teeth_gets_advice() -> None:
    assert "is written under `mechanisms`" in errors("teeth: {sun: 30, ring: 70}", "ratio: -2")[1]
    ravigneaux = errors("kind: planetary", "kind: ravigneaux, ratio: -2")
    assert "elements.P: unknown key `ratio`; did you mean `ratios`?" in ravigneaux


def warnings(text: str) -> list[str]:
    found = read(text.encode(), "case.yaml").warnings
    return [problem.message for problem in found if problem.id == "W102"]


def test_a_link_named_ground_gets_a_hint_to_the_housing() -> None:
    once = CASE.replace("housing", "ground")
    twice = once.replace("  C: [r, c]", "  C: [r, c]\n  D: [c, ground]")
    held = twice.replace("\nshift_el", "\n  S: {kind: held, link: ground}\nshift_el")
    for text, words in (
        (once, ["appears only once, so it is connected to nothing"]),
        (twice, ["appears only in shift elements, so nothing holds it"]),
        (held, []),
    ):
        hint = "; write `housing` for a part that never turns"
        assert warnings(text) == [f"link `ground` {told}{hint}" for told in words]


@pytest.mark.parametrize(
    ("old", "new", "meant"),
    [
        # modelica/ModelicaStandardLibrary/issues/3977: Modelica calls a freewheel OneWayClutch
        ("B: [r, housing]", "B: {kind: one_way_clutch, links: [r, housing]}", "freewheel"),
        ("B: [r, housing]", "B: {kind: one-way, links: [r, housing]}", "freewheel"),
        ("kind: planetary", "kind: epicyclic", "planetary"),
        ("kind: planetary", "kind: differential", "bevel"),
        ("ring: r", "annulus: r", "ring"),
        ("input: s", "title: A box\ninput: s", "name"),
        # BelfrySCAD/BOSL2/issues/1188: spur_gear; modelica/ModelicaStandardLibrary/issues/1873: eta
        ("kind: planetary", "kind: spur_gear", "gear_pair"),
        ("kind: planetary", "eta: 0.98, kind: planetary", "efficiency"),
        ("low: [B]", "low: {closed: [B]}", "engaged"),  # as similar to `loss`
    ],
)
def test_words_of_other_programs_suggest_words_of_a_case(old: str, new: str, meant: str) -> None:
    assert any(message.endswith(f"; did you mean `{meant}`?") for message in errors(old, new))


@pytest.mark.parametrize(
    "components",
    ["springs: {K: {damping: 3}}", "converters: {K: {points: [[0, 2, 0.1], [0.9, 1, 0.05]]}}"],
)
def test_a_component_without_links_causes_one_message(components: str) -> None:
    [message] = errors("gears:", f"{components}\ngears:")
    assert "`links`" in message


def test_an_unreadable_link_causes_one_message() -> None:
    """Source: lists with `name: text` in github.com/avaje/avaje-config/issues/227."""
    [message] = errors("input: s", "links: [{s: in}, r, c]\ninput: s")
    assert message == "links[1]: read a mapping, expected text"


def test_an_efficiency_above_1_is_not_taken_for_a_percentage() -> None:
    """Source: extrapolated maps in github.com/OpenMDAO/Aviary/issues/972."""
    last = "teeth: {sun: 30, ring: 70}"
    for efficiency, hint in ((1.02, ""), (98, ", such as 0.98 for 98 %")):
        [message] = errors(last, f"{last}, efficiency: {efficiency}")
        assert message.endswith(f"expected an efficiency above 0 and up to 1{hint}")


def test_an_unknown_key_explains_why_its_value_is_missing() -> None:
    """Without `rate`, the spring would lack its stiffness."""
    [message] = errors("gears:", "springs: {K: {links: [r, c], rate: 3}}\ngears:")
    assert message.startswith("springs.K: unknown key `rate`, expected ")
