"""Springs, inertias and elastic devices in YAML and JSON."""

import json
import math

import pytest

import vstatics as library
from tests.core.writers.again import is_read_again
from vstatics import loads
from vstatics.core import readers
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.model.parts import Damping, Friction
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.writers.deck_limits import check_deck
from vstatics.core.writers.named import mapping

ISSUE = """
inertias: {engine: 0.15, disc: 0.0032, casing: 0.4}
springs:
  damper:  {links: [engine, disc], compliance: 84e-5, damping: 3.2}
  tyre:    {links: [wheel, vehicle], stiffness: 474}
  wind-up: {links: [casing, housing], compliance: 1.525e-2}
  axle:    {twist: {pinion: 1, wheel: -1, casing: -1}, compliance: 1.476e-2}
mechanisms:
  box: {first: disc, second: pinion, ratio: 3.81}
  final drive: {first: pinion, second: wheel, third: casing, ratio: 4.2, stiffness: 9e4,
                damping: 12}
"""
"""The keys as the brief of these cases has them."""
PAIR = "links: 2\nmechanisms: {D: {first: 1, second: 2, ratio: 2}}\ngears: {a: {}}\n"


def messages(text: str) -> list[str]:
    """Errors of a case that cannot be, warnings of one that can."""
    try:
        return [str(problem) for problem in readers.read(text.encode(), "case.yaml").warnings]
    except ReadError as refused:
        return [str(problem) for problem in refused.problems]


def test_every_key() -> None:
    case = loads(ISSUE)
    assert case == Transmission(
        links=6,
        link_names=["engine", "disc", "wheel", "vehicle", "casing", "pinion"],
        shift_elements=[],
        mechanisms=[
            Mechanism(2, 6, 0, 3.81, name="box"),
            Mechanism(6, 3, 5, 4.2, name="final drive", stiffness=9e4, damping=Damping(12.0)),
        ],
        inertias={1: 0.15, 2: 0.0032, 5: 0.4},
        springs=[
            Spring({1: 1, 2: -1}, compliance=84e-5, damping=3.2, name="damper"),
            Spring({3: 1, 4: -1}, stiffness=474, name="tyre"),
            Spring({5: 1}, compliance=1.525e-2, name="wind-up"),
            Spring({6: 1, 3: -1, 5: -1}, compliance=1.476e-2, name="axle"),
        ],
        gears=[Gear(name="1")],
    )
    assert mapping(case)["springs"] == {
        "damper": {"links": ["engine", "disc"], "compliance": 84e-5, "damping": 3.2},
        "tyre": {"links": ["wheel", "vehicle"], "stiffness": 474.0},
        "wind-up": {"links": ["casing", "housing"], "compliance": 1.525e-2},
        "axle": {"twist": {"pinion": 1.0, "wheel": -1.0, "casing": -1.0}, "compliance": 1.476e-2},
    }
    assert Transmission.from_dict(json.loads(json.dumps(mapping(case)))) == case


def test_links_are_gathered_in_the_order_in_which_devices_name_them() -> None:
    """Or they are listed, or counted."""
    case = loads("""
inertias: {vehicle: 3, wheel: 1.5, engine: 0.15}
springs:
  damper: {links: [engine, wheel], compliance: 84e-5}
  tyre: {twist: {vehicle: -1, wheel: 1}, stiffness: 474}
""")
    assert list(case.link_names) == ["engine", "wheel", "vehicle"]
    assert (case.input, case.output) == (1, 3)
    assert case.inertias == {3: 3.0, 2: 1.5, 1: 0.15}
    springs = "springs: {s: {links: [2, 1], stiffness: 3}}\n"
    assert list(loads("links: [2, 1]\n" + springs).link_names) == ["2", "1"]
    assert loads("links: 2\n" + springs).springs[0].form == {2: 1.0, 1: -1.0}


def test_bodies_alone_are_a_case() -> None:
    """The links are gathered from springs and shift elements first; the case has one gear."""
    clutch = "inertias: {engine: 0.3, disc: 0.1}\nshift_elements: {C: [disc, engine]}"
    for text, links in (
        ("inertias: {mass: 2}\nsprings: {s: {links: [mass], stiffness: 8}}", ["mass"]),
        ("inertias: {mass: 2}", ["mass"]),
        ("inertias: {b: 1, a: 2}", ["b", "a"]),
        ("links: [c, b, a]\ninertias: {a: 1, b: 1, c: 9}", ["c", "b", "a"]),
        (clutch, ["disc", "engine"]),
    ):
        case = loads(text)
        assert (list(case.link_names), case.gears) == (links, (Gear(name="1"),))
        assert (case.input, case.output) == (1, len(links))
        assert is_read_again(case)
    clutched = loads(clutch)
    assert (clutched.mechanisms, clutched.springs) == ((), ())
    [told] = library.solve(clutched).messages
    assert told.id == "N420"
    assert "link engine turns freely, because the case has no gears" in told.text


def test_mechanisms_with_inertias_or_springs_go_without_gears() -> None:
    case = loads("""
inertias: {a: 1, b: 2}
mechanisms: {M: {first: a, second: b, ratio: 2, stiffness: 9e4}}
""")
    assert library.solve(case).ratio.tolist() == [2.0]
    case = loads("""
input: engine
output: axle
drag: {axle: 0.1}
inertias: {engine: 0.15}
elements: {G: {kind: gear_pair, first: shaft, second: axle, teeth: {first: 20, second: 41}}}
springs: {damper: {links: [engine, shaft], compliance: 84e-5}}
""")
    assert list(case.link_names) == ["shaft", "axle", "engine"]
    assert library.solve(case).ratio == pytest.approx([-41 / 20])
    assert [case.gear_drag(gear) for gear in case.gears] == [{2: 0.1}]


def test_springs_and_inertias_that_are_none_change_nothing() -> None:
    for nothing in ("springs:", "springs: {}", "springs: {}\ninertias: {}", "inertias: ~"):
        assert loads(PAIR + nothing) == loads(PAIR)
        assert "springs" not in mapping(loads(PAIR + nothing))
    for nothing in ("springs: {}", "inertias: {}", "inertias:", "inertias: ~"):
        assert messages(nothing) == [
            f"case.yaml:1:1: error: `{key}` is missing [E191]" for key in ("links", "mechanisms")
        ]


def test_damping_is_viscous_or_of_the_material() -> None:
    for written, damping in (
        ("3.2 N*m*s/rad", Damping(3.2)),
        ("{viscous: 3200 N*mm*s/rad}", Damping(3.2)),
        ("{ratio: .02, viscous: 0}", Damping(loss_factor=0.04)),
        ("{loss_factor: 1/25}", Damping(loss_factor=0.04)),
        ("0", Damping()),
        ("{}", Damping()),
    ):
        case = loads(f"springs: {{s: {{links: [a, b], stiffness: 8, damping: {written}}}}}")
        assert case.springs[0].damping == damping
        assert is_read_again(case)
        element = f"{{links: [1, 2], stiffness: 1e5, damping: {written}}}"
        assert loads(f"shift_elements: {{C: {element}}}\n{PAIR}").shift_elements == (
            ShiftElement(1, 2, "C", stiffness=1e5, damping=damping),
        )


FAULTS = {
    "springs: 3": "1:10: error: springs: read '3', expected a mapping: a name for each",
    "springs: {s: }": "1:14: error: springs.s: expected `links`, the two links of a shaft",
    "springs: {s: {links: a, stiffness: 3}}": "read 'a', expected two links",
    "springs: {s: {links: [housing], stiffness: 3}}": "connects link 0 (the housing) to itself",
    "springs: {s: {links: [a], stifness: 3}}": "key `stifness`; did you mean `stiffness`?",
    "springs: {s: {twist: {0: 1}, stiffness: 3}}": "read an empty twist",
    "springs: {s: {twist: [a], stiffness: 3}}": "read a list, expected a mapping: a number",
    "links: 3\nsprings: {s: {links: [1], stiffness: 3}}": "read 3 links, but 0 shift elements, "
    "0 mechanisms and 1 springs can connect at most 2",
    "links: 10000000\nsprings: {s: {twist: {1: 1, 2: 3}, stiffness: 3}}": "connect at most 2",
    "links: 4\ninertias: {1: 3}": "1 inertias can connect at most 1",
}


def test_one_fault_is_reported_once() -> None:
    for text, said in FAULTS.items():
        [told] = [one for one in messages(text) if ": error: " in one]
        assert said in told


def test_a_link_that_one_spring_alone_names_is_reported() -> None:
    [told] = messages("""
inertias: {engine: 1, disc: 2, wheel: 3}
springs:
  a: {links: [engine, disc], stiffness: 8}
  b: {links: [dics, wheel], stiffness: 8}
""")
    assert told == (
        "case.yaml:5:15: warning: link `dics` appears only once, so it is connected to nothing; "
        "did you mean `disc`? [W102]"
    )


def test_rows_have_different_names() -> None:
    for other in ("R.small_sun", "R.short", "R.carrier", "R"):
        [told] = [one for one in messages(f"""
input: a
output: d
elements:
  R: {{kind: ravigneaux, small_sun: a, large_sun: b, ring: c, carrier: d,
      teeth: {{small_sun: 30, large_sun: 37, ring: 89, short: 19}}}}
springs: {{"{other}": {{links: [a], stiffness: 8}}}}
""") if ": error: " in one]  # fmt: skip
        place = f"case.yaml:7:11: error: springs.{other}"
        assert told.startswith(f"{place}: `{other}` is also the name of a"), told
    # rows have only names, so a gear set cannot have the name of a shift element either
    text = """
input: a
output: b
elements: {G: {kind: gear_pair, first: a, second: b, teeth: {first: 20, second: 41}}}
shift_elements: {G: [a, housing]}
gears: {x: []}
"""
    assert loads(text).devices == ["G", "G"]
    assert messages(text + "inertias: {a: 1}") == [
        "case.yaml:4:12: error: elements.G: `G` is also the name of a shift element, "
        "expected another name [E257]"
    ]


FRICTION = """
links: [in, a0, wheel, vehicle]
inertias: {in: 3.6, a0: 0.2, vehicle: 41.2}
shift_elements:
  FH: {links: [in, a0], static: 6/5, friction: {radius: 100 mm, area: 60 cm^2, surfaces: 8,
       coefficient: [[0, .12], [60 rpm, .1]]}}
  FB: {links: [a0], friction: {radius: .1, area: 60e-4, surfaces: "8", coefficient: .12}}
  FC: [in, a0]
springs: {tyre: {links: [wheel, vehicle], stiffness: 4e4, limit: 3 kN*m}}
mechanisms: {M: {first: a0, second: wheel, ratio: 4.1}}
gears: {low: [FH]}
"""


def test_friction_and_limits() -> None:
    case = loads(FRICTION)
    assert [element.static for element in case.shift_elements] == [1.2, 1, 1]
    points = ((0.0, 0.12), (2 * math.pi, 0.1))
    assert [element.friction for element in case.shift_elements] == [
        Friction(0.1, 60 / 100**2, 8, points),
        Friction(0.1, 0.006, 8, ((0.0, 0.12),)),
        None,
    ]
    assert case.springs[0].limit == 3000
    written = mapping(case)
    assert written["shift_elements"]["FB"]["friction"]["coefficient"] == 0.12
    assert written["springs"]["tyre"]["limit"] == 3000
    assert is_read_again(case)
    with pytest.raises(CaseError, match=r"the static friction of FH, the friction of FH, FB"):
        check_deck(case)


WRONG_FRICTION = {
    "static: read nan, expected 1 or more": {"static": math.nan},
    "coefficient: read no points": {"friction": Friction(0.1, 0.1, 1, ())},
    "surfaces: read 0, expected a whole": {"friction": Friction(0.1, 0.1, 0, ((0, 0.1),))},
    "read nan, expected a slip": {"friction": Friction(0.1, 0.1, 1, ((math.nan, 0.1),))},
    "area: read inf, expected an area": {"friction": Friction(0.1, math.inf, 1, ((0, 0.1),))},
    "heat_capacity: read 0, expected a heat": {"friction": Friction(heat_capacity=0)},
    "read -1, expected a cooling of 0 or": {"friction": Friction(heat_capacity=9, cooling=-1)},
    "nan, expected a temperature": {"friction": Friction(heat_capacity=9, ambient=math.nan)},
}


def test_friction_that_can_not_be_is_refused() -> None:
    case = loads(FRICTION)
    first, *others = case.shift_elements
    for said, changes in WRONG_FRICTION.items():
        elements = [first._replace(**changes), *others]  # type: ignore[arg-type]
        with pytest.raises(CaseError, match=said):
            case.replace(shift_elements=elements)
