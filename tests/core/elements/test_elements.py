"""Cases made of elements: what they become, what is shown of them, what is refused."""

import pickle
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

import vstatics as library
from tests.commands import CASES
from tests.core.elements.element_texts import AOD, SET, changed, loaded, problems
from vstatics.core.cli.new import TEMPLATES, template
from vstatics.core.elements import Drawing, Element, transmission
from vstatics.core.elements.drawing import drawing_of
from vstatics.core.elements.kinds import KINDS
from vstatics.core.errors import CaseError
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement
from vstatics.core.readers import read


def test_efficiency_of_a_set_is_the_product_of_its_meshes_and_its_ratio_a_fraction() -> None:
    """A bevel set without teeth has two meshes."""
    common, own = "mesh_efficiency: {external: .97}", "ring: 75}, mesh_efficiency: {internal: 1}}"
    for text, efficiency in (
        (SET, 0.98 * 0.99),
        (common + SET, 0.97 * 0.99),
        (common + changed("ring: 75}}", own), 0.97),
        (changed("ring: 75}}", "ring: 75}, efficiency: .96}"), 0.96),
    ):
        assert [one.efficiency for one in loaded(text).mechanisms] == [efficiency], text
    bevel = Element("B", "bevel", {"left": 1, "right": 2, "carrier": 3})
    case = transmission(Drawing(3, [bevel]), gears=[Gear([1])], shift_elements=[ShiftElement(3)])
    assert case.mechanisms[0][3:5] == pytest.approx((-1, 0.97**2))
    text = changed("teeth: {sun: 30, ring: 75}", "teeth: {sun: 31, ring: 83}")
    assert loaded(text).mechanisms[0].ratio == float(Fraction(-83, 31))  # rounded once


def test_sets_that_seem_to_share_planets_get_a_hint() -> None:
    second = "  P2: {kind: double_planet, sun: sun2, ring: ring, carrier: carrier, teeth: "
    two = changed("shift_elements:", second + "{sun: 27, ring: 75}}\nshift_elements:")
    told = [str(p) for p in read(two.encode(), "case.yaml").warnings if p.severity == "note"]
    assert sum("P2: shares a central gear and the carrier with P1" in one for one in told) == 1


def test_mechanisms_may_stand_beside_elements() -> None:
    axle = "mechanisms:\n  axle: {first: carrier, second: out, ratio: -4, efficiency: .97}\n"
    case = loaded(changed("output: carrier", "output: out", SET) + axle)
    assert [mechanism.name for mechanism in case.mechanisms] == ["P1", "axle"]
    assert library.solve(case).ratio == pytest.approx([-14, -4])


def test_every_kind_has_a_template_or_a_case() -> None:
    texts = [path.read_text("utf-8") for path in CASES.glob("*.yaml")]
    texts += map(template, TEMPLATES)
    unused = {kind for kind in KINDS if not any(f"kind: {kind}" in text for text in texts)}
    assert unused == {"internal_pair", "belt"}


P1 = SET[SET.index("  P1:") : SET.index("shift_el")]
FAULTS = (
    ("carrier: carrier", "carier: carrier", "did you mean `carrier`?"),
    (", carrier: carrier", "", "`carrier` is missing"),
    (", teeth: {sun: 30, ring: 75}", "", "`teeth` is missing"),
    (", ring: 75}", "}", "teeth of `ring` missing"),
    ("ring: 75}", "ring: 75.5}", "read '75.5', expected a whole number"),
    ("ring: 75}", "ring: 0}", "read '0', expected a whole number from 1"),
    ("ring: 75}", "ring: 25}", "read 25, expected more teeth than the 30 of sun"),
    ("ring: 75}}", "ring: 75}, efficiency: 1.2}", "P1.efficiency: read 1.2, expected an eff"),
    ("ring: ring", "ring: sun", "sun and ring are the same link"),
    ("input: sun\n", "", "`input` is missing, expected it or `links`, whose first link"),
    ("input: sun", "losses: mesh\ninput: sun", "did you mean `meshes`?"),
    ("input: sun", "drag: {ring: 3 N*m}\ninput: sun", "no input torque to relate it to"),
    ("input: sun", "load: {torque: 9 N*m}\ndrag: {ring: -3 N*m}\ninput: sun", ":3:8: error: drag"),
    ("output: carrier\n", "", "`output` is missing, expected it or `links`, whose last link"),
    (P1, "", "elements: read nothing, expected a mapping: a name for each element"),
    ("75}}", "75}, efficiency: .97, mesh_efficiency: {internal: 1}}", "of the whole gear set"),
    ("ring: 75}}", "ring: 9000000}}", "read 9e+06, expected a number above 0 and below 1e+06"),
    ("kind: planetary", "kind: planet_group", "unknown key `sun`"),
)
GROUP_FAULTS = (
    ("30, rim: A1}", "30, rim: A3}", "suns[1].rim: read `A3`, expected the name of"),
    (
        "[[A2, B1]]",
        "[[A2, B2]]",
        "[1][2]: read `B2`, expected the name of a planet gear: A1, A2, B1",
    ),
    ("[[A2, B1]]", "[[A2, A1]]", "are on the same planet"),
    ("[[A2, B1]]", "[[A2, B1], [A1, B1]]", "block each other"),
    ("    meshes: [[A2, B1]]\n", "", "is a mesh between planets missing?"),
    ("B: {B1: 20}", "B: {A1: 20}", "the name `A1` appears twice"),
    ("[[A2, B1]]", "[A2, B1]", "expected two: [rim, rim]"),
    ("carrier: h", "carrier: h\n    efficiency: .9", "one efficiency for several power paths"),
    ("link: b, teeth: 70", "link: h, teeth: 70", "is on the link of the carrier"),
    ("link: b, teeth: 70", "link: b, teeth: 30", "expected more teeth than the 30 of a"),
    ("link: b, teeth: 70", "link: a, teeth: 70", "would block them"),
    ("link: b,", "link: 9,", "case.yaml:10:20: error: elements.G.rings[1].link: read '9'"),
    ("teeth: 80", "teeth: 80000000", "expected fewer than 1000000 teeth"),
)


def test_a_fault_is_reported_with_its_place() -> None:
    for text, faults in ((SET, FAULTS), (GROUP, GROUP_FAULTS)):
        for before, after, words in faults:
            found = problems(changed(before, after, text))
            assert any(words in problem for problem in found), found
            assert all(problem.startswith("case.yaml:") for problem in found)
    text = AOD.replace("reverse sun", "set.long")
    assert "planet long has the name `set.long`, like a link" in " ".join(problems(text))


GROUP = """
links: [a, b, c, h]
output: c
elements:
  G:
    kind: planet_group
    carrier: h
    rims: {A: {A1: 20, A2: 18}, B: {B1: 20}}
    suns: [{link: a, teeth: 30, rim: A1}]
    rings: [{link: b, teeth: 70, rim: A1}, {link: c, teeth: 80, rim: B1}]
    meshes: [[A2, B1]]
gears: {all: {}}
"""


NUMBERED = """
links: 4
output: 3
elements:
  R:
    {kind: ravigneaux, small_sun: 1, large_sun: 2, ring: 3, carrier: 4,
     teeth: {small_sun: 30, large_sun: 36, ring: 84, short: 22, long: 24}}
shift_elements: {B: [4, 0]}
gears:
  1: {engaged: [B], speeds: {2: 0}, drag: {2: 0.01}}
"""
"""The planets are links 5 and 6 of the mechanisms, but no links of the case."""


def test_a_planet_has_no_link_number() -> None:
    for before, after, place in (
        ("output: 3", "output: 6", "3:9: error: output"),
        ("carrier: 4", "carrier: 5", "6:70: error: elements.R.carrier"),
        ("B: [4, 0]", "B: [5, 0]", "8:22: error: shift_elements.B[1]"),
        ("speeds: {2: 0}", "speeds: {5: 0}", "10:30: error: gears.1.speeds"),
        ("drag: {2: 0.01}", "drag: {5: 0.01}", "10:44: error: gears.1.drag"),
        ("speeds: {2: 0}", "torques: {6: 1}", "10:31: error: gears.1.torques"),
        ("speeds: {2: 0}", "output: 6", "10:29: error: gears.1.output"),
    ):
        [told] = problems(changed(before, after, NUMBERED))
        assert told.startswith(f"case.yaml:{place}")
        assert "expected a link number from 1 to 4" in told


def test_the_housing_is_no_output() -> None:
    said = "error: output: read the housing, expected the link that drives the load"
    for given in ("output: housing", "output: 0"):
        for text in (changed("output: carrier", given), changed("output: 3", given, NUMBERED)):
            assert said in problems(text)[0]


def test_a_wheel_with_teeth_but_no_link_is_reported() -> None:
    """It is left out; the one who forgot its link wants to know."""
    text = """
links: [in, out]
elements:
  W: {kind: stepped, sun: in, ring: housing, carrier: out,
      teeth: {sun: 20, planet: 20, ring: 60, planet2: 18, ring2: 58}}
gears: {1: {}}
"""
    told, *_ = map(str, read(text.encode(), "case.yaml").warnings)
    assert told.startswith("case.yaml:5:66: warning: elements.W.teeth.ring2: the gear is ignored")


def test_of_an_element_without_a_known_kind_the_kind_alone_is_reported() -> None:
    """Its links are known all the same, those of gears and ports too."""
    members = "kind: planetary, sun: sun, ring: ring, carrier: carrier"
    for before, after, words in (
        ("kind: planetary", "kind: planetery", "did you mean `planetary`?"),
        ("kind: planetary, ", "", "`kind` is missing; expected one of"),
        ("kind: planetary", "kind: [planetary]", "read a list, expected text"),
        (members, "kind: planet", "expected"),
    ):
        (told,) = problems(changed(before, after))
        assert "elements.P" in told
        assert words in told
    [told] = problems("input: 1\noutput: b\nelements: {H: {kind: held}}\ngears: {1: {}}\n")
    assert told.endswith("elements.H: `link` is missing [E191]")  # no port without a named link


def test_links_that_are_empty_and_given_again_are_given_twice() -> None:
    for links in ("[sun, ring, carrier]", "3", ""):
        [told] = [one for one in problems(f"links:{SET}links: {links}\n") if ": error: " in one]
        assert told.endswith("`links` is given twice, the first is on line 1, column 1 [E192]")


def test_a_library_user_gets_all_faults_at_once() -> None:
    bad = Element("P", "planetery", {})
    worse = Element("Q", "planetary", {"sun": 1, "ring": 2}, {"sun": 30})
    with pytest.raises(CaseError) as refused:
        transmission(Drawing(3, [bad, worse]), gears=[Gear()])
    assert [problem.path[1] for problem in refused.value.problems] == [1, 2, 2]


def drawn_with(case: library.Transmission, **teeth: float) -> Drawing:
    """The drawing of a case with other teeth of its first element."""
    drawing = drawing_of(case)
    assert drawing is not None
    first, *others = drawing.elements
    changed = replace(first, teeth={**first.teeth, **teeth})
    return replace(drawing, elements=(changed, *others))


def test_another_drawing_makes_another_case() -> None:
    """Teeth that are changed in it count; ratios that are changed beside it do as well."""
    case = loaded(SET)
    other = replace(case, drawing=drawn_with(case, sun=25))
    assert library.solve(other).ratio == pytest.approx([1 + 75 / 25, 1])
    assert other == loaded(changed("sun: 30", "sun: 25"))
    assert library.solve(replace(other, coast=True)).ratio[0] == pytest.approx(4)
    varied = replace(case, mechanisms=[case.mechanisms[0]._replace(ratio=-2.0)])
    assert library.solve(varied).ratio == pytest.approx([3, 1])
    assert library.solve(case, ratios=[-2.0]).ratio == pytest.approx([3, 1])
    back = replace(varied, drawing=drawn_with(case, sun=25))
    assert back == other


def test_another_drawing_may_have_more_links() -> None:
    """Links of the case keep their names and numbers, planets come after the new ones."""
    case = loaded(AOD)
    drawing = drawing_of(case)
    assert drawing is not None
    ring = case.link_names.index("ring") + 1
    for more in (1, 2, 4):
        pairs = [Mechanism(ring + n, ring + n + 1, 0, -2.0, name=f"pair {n}") for n in range(more)]
        longer = replace(drawing, links=ring + more, mechanisms=pairs)
        names = [*case.link_names[:ring], *map(str, range(ring + 1, ring + more + 1))]
        for other in (case.replace(drawing=longer), replace(case, drawing=longer)):
            assert list(other.link_names) == [*names, "set.short", "set.long"]
            results = library.solve(other)
            assert results.ratio == pytest.approx(library.solve(case).ratio)
            by_ring = results.speeds[:, ring : ring + more] / results.speeds[:, [ring - 1]]
            assert by_ring == pytest.approx(np.tile((-0.5) ** np.arange(1, more + 1), (5, 1)))
            assert replace(other, drawing=drawing) == case


def test_a_case_may_be_made_with_its_drawing_alone() -> None:
    drawing = drawing_of(loaded(SET))
    case = library.Transmission(
        3, [ShiftElement(2)], [], [Gear([1])], link_names=["s", "r", "c"], drawing=drawing
    )
    assert library.solve(case).ratio == pytest.approx([3.5])
    copied = pickle.loads(pickle.dumps(case))  # noqa: S301
    assert library.solve(copied).ratio == pytest.approx([3.5])
