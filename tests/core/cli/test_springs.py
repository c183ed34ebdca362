"""Cases with springs and inertias, from one command to the next."""

from __future__ import annotations

from itertools import product
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
  P1: {kind: planetary, sun: sun, ring: ring, carrier: shaft, teeth: {sun: 32, ring: 68, planet: 18},
       planets: 4, planet: {inertia: 1e-4, mass: .3, radius: 50 mm}}
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
ALONE = """
inertias: {engine: 0.15, disc: 0.0032, vehicle: 9}
springs:
  damper: {links: [engine, disc], compliance: 84e-5, damping: 3.2}
  tyre: {links: [disc, vehicle], stiffness: 474}
"""
MASS = "inertias: {mass: 2}\nsprings: {s: {links: [mass], stiffness: 8}}"
CASES = {"box": BOX, "drawn": DRAWN, "four": FOUR, "alone": ALONE, "mass": MASS, "issue": ISSUE}
TIED_UP = {"mass", "issue"}
"""A mass on a spring to the housing, which stands at mean speeds; springs beside mechanisms."""


@pytest.fixture
def cases(tmp_path: Path) -> Path:
    for name, text in CASES.items():
        (tmp_path / f"{name}.yaml").write_text(text, encoding="utf-8")
    return tmp_path


COMMANDS = {
    "check": ("", "json"),
    "run": ("listing", "json", "jsonl", "csv", "markdown", "latex", "xlsx"),
    "flow": ("text", "json", "csv"),
    "explain": ("text", "json", "csv"),
    "summary": ("text", "json", "csv"),
}
FORMATS = [(command, form) for command, forms in COMMANDS.items() for form in forms]


@pytest.mark.parametrize(("command", "form"), FORMATS)
def test_every_command_takes_every_case(command: str, form: str, cases: Path) -> None:
    for name in CASES:
        chosen = ["-f", form] if form else []
        to = ["-o", cases / "out.xlsx"] if form == "xlsx" else []
        said = vstatics(command, cases / f"{name}.yaml", *chosen, *to)
        assert "an error of vstatics" not in said.err
        assert said.status == int(name in TIED_UP), said.err


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["plan", "lever", "flow", "structure", "stick", "efficiency"])
def test_every_picture_is_drawn_or_told_to_be_none(kind: str, cases: Path) -> None:
    nothing = {
        "plan": {"four", "alone", "mass", "issue"},  # nothing is free
        "lever": {"alone", "mass"},  # no mechanism
        "stick": {"alone", "four", "mass"},  # neither elements nor sets
        "efficiency": {"mass", "issue"},
    }
    for name in CASES:
        target = cases / f"{name}.svg"
        said = vstatics("plot", "-q", cases / f"{name}.yaml", "--kind", kind, "-o", target)
        assert "an error of vstatics" not in said.err
        assert target.exists() == (name not in nothing.get(kind, ())), (name, said.err)


def test_check_counts_springs(cases: Path) -> None:
    said = vstatics("check", cases / "box.yaml")
    assert "7 links, 2 shift elements, 2 mechanisms, 3 springs, 2 gears" in said.out
    assert "1 spring, 1 gear; degrees of freedom: 0" in vstatics("check", cases / "mass.yaml").out


@pytest.mark.parametrize(("name", "lang"), list(product(["box", "drawn", "four"], ["en", "ru"])))
def test_a_listing_names_springs_and_is_not_read_as_a_deck(
    name: str, lang: str, cases: Path
) -> None:
    listing = cases / "case.lst"
    said = vstatics("run", cases / f"{name}.yaml", "--lang", lang)
    listing.write_text(said.out, encoding="utf-8")
    count = len(library.load(cases / f"{name}.yaml").springs)
    assert f"\nKSPR= {count}\n" in said.out
    assert "KLG = KL + KG + KSPR" in said.out
    read = vstatics("check", listing)
    assert read.status == 1
    [told] = [line for line in read.err.splitlines() if "error" in line]
    assert told.endswith(
        f"error: KSPR: read {count}, expected 0: a deck has no springs; take the YAML or JSON of "
        "this case"
    )
    assert "KLG1" in said.out
    [tables] = read_results(listing.read_bytes(), "case.lst")  # but it can be compared
    document = vstatics("run", cases / f"{name}.yaml", "-f", "json").out
    (cases / "case.json").write_text(document, encoding="utf-8")
    assert tables is not None
    assert vstatics("compare", listing, cases / "case.json").status == 0


def test_the_twists_of_springs_stand_in_the_listing(cases: Path) -> None:
    lines = vstatics("run", cases / "four.yaml").out.splitlines()
    at = lines.index("KSPR= 3")
    assert lines[at + 1 : at + 4] == [
        "SPRING .1000E+01*1 -.1000E+01*2: s",
        "SPRING .2000E+01*2 -.1000E+01*3 -.5000E+00*4 .1000E+01*5: t",
        "SPRING .1000E+01*3 -.1000E+01*4 .5000E+00*5: u",
    ]


def test_rows_of_a_case_with_springs_have_names(cases: Path) -> None:
    made = json_answer("run", cases / "box.yaml")
    assert made["rows"]["torques"] == ["C", "B", "set", "axle", "damper", "shaft", "mount", "Mx"]
    listing = vstatics("run", cases / "box.yaml").out
    assert "  3.600   1.000  | shaft\n" in listing


@pytest.mark.parametrize("target", ["case.dat", "-"])
def test_a_deck_is_refused_what_it_cannot_hold(target: str, cases: Path) -> None:
    path = target if target == "-" else cases / target
    said = vstatics("convert", cases / "box.yaml", path, "--to", "deck")
    assert (said.status, said.out, (cases / target).exists()) == (1, "", False)
    [told] = [line for line in said.err.splitlines() if "error" in line]
    assert told.endswith(
        "box.yaml: error: a deck cannot hold the springs damper, shaft, mount, the inertia of engine, "
        "wheel, the stiffness of C, the damping of C; expected YAML or JSON, which hold them"
    )
    said = vstatics("convert", cases / "drawn.yaml", path, "--to", "deck")
    assert "the stiffness of G, the planet masses of P1; expected" in said.err
    assert (
        "the spring s, the inertia of mass;"
        in vstatics("convert", cases / "mass.yaml", path, "--to", "deck").err
    )


def test_what_a_deck_holds_goes_on_as_before() -> None:
    text = "links: 2\nsource: x\nmechanisms: {D: {first: 1, second: 2, ratio: 2}}\ngears: {1: []}\n"
    said = vstatics("convert", "-", "-", "--to", "deck", stdin=(text + "inertias: {1: 0}").encode())
    assert said.status == 1
    assert "KG= 1" in said.out
    assert said.err.splitlines() == ["-: not kept: source", "-: not kept: inertias"]


@pytest.mark.parametrize("name", CASES)
def test_yaml_and_json_keep_everything(name: str, cases: Path) -> None:
    case = library.load(cases / f"{name}.yaml")
    for suffix in ("yaml", "json"):
        target = cases / f"again.{suffix}"
        assert vstatics("convert", "-q", cases / f"{name}.yaml", target).status == 0
        assert library.load(target) == case


def test_a_sweep_over_ratios_has_torques_of_springs(cases: Path) -> None:
    out = "ratio[low],torques[mount,low]"
    said = vstatics("sweep", cases / "box.yaml", "--vary", "set.ratio=-2:-3:3", "--out", out)
    rows = [line.split(",") for line in said.out.splitlines()[1:]]
    u = 41 / 11
    assert [[float(cell) for cell in row[-2:]] for row in rows] == [
        pytest.approx([u * (1 - ratio), (1 - u) * (1 - ratio)]) for ratio in (-2, -2.5, -3)
    ]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["four", "alone", "mass"])
def test_a_report_is_made_of_springs_alone(name: str, cases: Path) -> None:
    done = vstatics("report", "-q", cases / f"{name}.yaml", "-o", cases / "page.html")
    assert (done.status, done.out) == (int(name in TIED_UP), "")
    assert ">Springs<" in (cases / "page.html").read_text(encoding="utf-8")


@pytest.mark.slow
def test_the_report_has_tables_of_springs_and_inertias(cases: Path) -> None:
    vstatics("report", "-q", cases / "box.yaml", "-o", cases / "box.html")
    page = (cases / "box.html").read_text(encoding="utf-8")
    for said in (">Springs<", ">Inertias<", "carrier − prop", "stiffness, N*m/rad"):
        assert said in page
