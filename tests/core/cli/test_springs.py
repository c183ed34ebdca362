"""Cases with springs and inertias, from one command to the next."""

from pathlib import Path

import pytest

import vstatics as library
from tests.commands import json_answer, vstatics
from tests.core.readers.named.test_springs import ISSUE
from vstatics.core.readers.results import read_results

BOX = """
name: box on springs
load: {speed: 2000 rpm, torque: 300 N*m}
links: [engine, sun, ring, carrier, prop, wheel, casing]
output: wheel
inertias: {engine: 0.15, wheel: 1.5}
springs:
  damper: {links: [engine, sun], compliance: 84e-5, damping: 3.2}
  shaft: {links: [carrier, prop], stiffness: 9e4}
  mount: {links: [casing], compliance: 1.5e-2}
shift_elements:
  C: {links: [sun, ring], stiffness: 1e5, damping: 4}
  B: [ring, housing]
mechanisms:
  set: {first: sun, second: ring, third: carrier, ratio: -78/30, efficiency: .97}
  axle: {first: prop, second: wheel, third: casing, ratio: 41/11, efficiency: .98, planet_ratio: 1}
gears: {low: [B], direct: [C]}
"""
DRAWN = """
input: engine
output: axle
inertias: {engine: 0.15}
elements:
  P1: {kind: planetary, sun: sun, ring: ring, carrier: shaft,
       teeth: {sun: 32, ring: 68, planet: 18}, planets: 4, planet: {inertia: 1e-4, mass: .3, radius: 50 mm}}
  G: {kind: gear_pair, first: pinion, second: axle, teeth: {first: 20, second: 41}, stiffness: 1e6}
springs:
  damper: {links: [engine, sun], compliance: 84e-5}
  prop: {links: [shaft, pinion], compliance: 84e-5}
shift_elements: {B: [ring, housing], F: {kind: freewheel, links: [ring, housing]}}
gears: {low: [B], free: []}
"""
FOUR = """
inertias: {a: 1, b: 2, c: 1.5, d: 1}
springs:
  s: {links: [a, b], stiffness: 8}
  t: {twist: {b: 2, c: -1, d: -.5, e: 1}, stiffness: 8}
  u: {twist: {c: 1, d: -1, e: .5}, stiffness: 5}
mechanisms: {m: {first: c, second: e, ratio: 3}}
output: d
"""
MASS = "inertias: {mass: 2}\nsprings: {s: {links: [mass], stiffness: 8}}"
CASES = {"box": BOX, "drawn": DRAWN, "four": FOUR, "mass": MASS, "issue": ISSUE}
TIED_UP = {"mass", "issue"}
"""A mass on a spring to the housing, which stands at mean speeds; springs beside mechanisms."""
FORMATS = {
    "check": ("json",),
    "run": ("listing", "json", "jsonl", "csv", "markdown", "latex"),
    **dict.fromkeys(("flow", "explain", "summary"), ("text", "json", "csv")),
}


@pytest.fixture(autouse=True)
def _cases(folder: Path) -> None:
    for name, text in CASES.items():
        (folder / f"{name}.yaml").write_text(text, "utf-8")


@pytest.mark.parametrize(
    ("command", "form"), [(command, form) for command, forms in FORMATS.items() for form in forms]
)
def test_every_command_takes_every_case(command: str, form: str) -> None:
    for name in CASES:
        said = vstatics(command, f"{name}.yaml", "-f", form)
        assert "an error of vstatics" not in said.err
        assert said.status == int(name in TIED_UP), said.err
        if command == "run":
            call = ("convert", "-q", f"{name}.yaml", f"again.{form}", "--to", "json")
            assert vstatics(*call).status == 0
            assert library.load(f"again.{form}", format="json") == library.load(f"{name}.yaml")


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["plan", "lever", "flow", "structure", "stick", "efficiency"])
def test_every_picture_is_drawn_or_reported(kind: str) -> None:
    nothing = {
        "plan": {"four", "mass", "issue"},  # nothing is free
        "lever": {"mass"},  # no mechanism
        "stick": {"four", "mass"},  # neither elements nor sets
        "efficiency": {"mass", "issue"},
    }
    for name in CASES:
        said = vstatics("plot", "-q", f"{name}.yaml", "--kind", kind, "-o", f"{name}.svg")
        assert "an error of vstatics" not in said.err
        is_drawn = name not in nothing.get(kind, ())
        assert Path(f"{name}.svg").exists() == is_drawn, (name, said.err)


@pytest.mark.parametrize("name", ["box", "drawn", "four"])
def test_a_listing_names_springs_and_is_compared_but_not_read_as_a_deck(name: str) -> None:
    count = len(library.load(f"{name}.yaml").springs)
    vstatics("run", f"{name}.yaml", "-o", "case.json")
    for lang in ("en", "ru"):
        said = vstatics("run", f"{name}.yaml", "--lang", lang).out
        Path("case.lst").write_text(said, "utf-8")
        for words in (f"\nKSPR= {count}\n", "KLG = KL + KG + KSPR", "KLG1"):
            assert words in said
        assert vstatics("check", "case.lst").fails(
            f"error: KSPR: read {count}, expected 0: a deck has no springs; "
            "take the YAML or JSON of this case\n"
        )
        [tables] = read_results(said.encode(), "case.lst")
        assert tables is not None
        assert vstatics("compare", "case.lst", "case.json").status == 0


def test_the_listing_has_twists_and_names_of_springs() -> None:
    lines = vstatics("run", "four.yaml").out.splitlines()
    at = lines.index("KSPR= 3")
    assert lines[at + 1] == "SPRING .1000E+01*1 -.1000E+01*2: s"
    assert lines[at + 2] == "SPRING .2000E+01*2 -.1000E+01*3 -.5000E+00*4 .1000E+01*5: t"
    rows = json_answer("run", "box.yaml")["rows"]["torques"]
    assert rows == ["C", "B", "set", "axle", "damper", "shaft", "mount", "Mx"]
    assert "  3.600   1.000  | shaft\n" in vstatics("run", "box.yaml").out
    said = " ".join(vstatics("check", "mass.yaml").out.split())
    assert "1 spring, 1 gear; degrees of freedom: 0" in said


def test_a_deck_is_refused_what_it_cannot_hold() -> None:
    """But inertias of 0 and texts are left out with a word."""
    held = {
        "box": "box.yaml: error: a deck cannot hold the springs damper, shaft, mount, the inertia "
        "of engine, wheel, the stiffness of C, the damping of C; expected YAML or JSON, which "
        "hold them",
        "drawn": "the stiffness of G, the planet masses of P1; expected",
        "mass": "the spring s, the inertia of mass;",
    }
    for name, words in held.items():
        assert vstatics("convert", f"{name}.yaml", "case.dat").gives_nothing(words)
        assert not Path("case.dat").exists()
    text = "links: 2\nsource: x\nmechanisms: {D: {first: 1, second: 2, ratio: 2}}\ngears: {1: []}\n"
    said = vstatics("convert", "-", "-", "--to", "deck", stdin=(text + "inertias: {1: 0}").encode())
    assert (said.status, "KG= 1" in said.out) == (1, True)
    assert said.err.splitlines() == ["-: not kept: source", "-: not kept: inertias"]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["box", "four", "mass"])
def test_a_report_has_tables_of_springs_and_inertias(name: str) -> None:
    done = vstatics("report", "-q", f"{name}.yaml", "-o", "page.html")
    assert (done.status, done.out) == (int(name in TIED_UP), "")
    page = Path("page.html").read_text("utf-8")
    assert ">Springs<" in page
    words = (">Inertias<", "carrier − prop", "stiffness, N*m/rad")
    assert name != "box" or all(said in page for said in words)
