"""Elements that are elastic, and the masses of their planets."""

from typing import Any

import pytest

import vstatics as library
from tests.core.elements.element_texts import changed, loaded, problems
from vstatics.core.elements import CentralWheel, Drawing, Element, PlanetMass, transmission
from vstatics.core.elements.drawing import drawing_of
from vstatics.core.elements.element import DrawingFields
from vstatics.core.elements.kinds import KINDS
from vstatics.core.elements.planet_bodies import planet_bodies
from vstatics.core.elements.planet_inertia import planet_inertias
from vstatics.core.errors import CaseError
from vstatics.core.model.parts import Damping
from vstatics.core.model.transmission import Gear
from vstatics.core.readers import read
from vstatics.core.writers.named import write_json, write_yaml

BODY = "teeth: {sun: 30, ring: 75}"
ONE_PLANET = "planets: 3, planet: {inertia: 84e-6, mass: 500 g, radius: 52 mm}"
WITH_PLANET = changed(BODY, f"{BODY}, {ONE_PLANET}")
ELASTIC = changed(BODY, f"{BODY}, stiffness: 9e4, damping: 12")
RAVIGNEAUX = """
input: a
output: d
elements:
  R: {kind: ravigneaux, small_sun: a, large_sun: b, ring: c, carrier: d, planets: 3,
      teeth: {small_sun: 30, large_sun: 36, ring: 90, short: 20}%s}
shift_elements: {B: [c, housing], C: [b, housing]}
gears: {low: [B], high: [C]}
"""


def errors(text: str) -> list[str]:
    return [told for told in problems(text) if ": error: " in told]


def test_a_stiffness_is_that_of_the_one_mechanism() -> None:
    [mechanism] = loaded(ELASTIC).mechanisms
    assert (mechanism.stiffness, mechanism.damping) == (9e4, Damping(12.0))
    assert library.solve(loaded(ELASTIC)).ratio == pytest.approx([1 + 75 / 30, 1])
    pair = "kind: gear_pair, first: sun, second: ring, teeth: {first: 2, second: 3}"
    text = changed("kind: planetary, sun: sun, ring: ring, carrier: carrier, " + BODY, pair)
    [mechanism] = loaded(changed(pair, f"{pair}, stiffness: 1 kN*m/rad", text)).mechanisms
    assert mechanism.stiffness == 1000


SIZES = {"sun": 30, "ring": 90, "small_sun": 24, "planet": 30, "worm": 2, "wheel": 40, "second": 31}
"""Teeth that suit all kinds."""
TWO_WHEELS = {"ravigneaux": ("small_sun", "ring"), "stepped": ("sun", "ring")}


def test_every_kind_of_one_row_may_be_elastic() -> None:
    """A Ravigneaux set of two wheels has one row, too."""
    for kind in KINDS.keys() - {"planet_group"}:
        members = TWO_WHEELS.get(kind, ())
        left_out = set(getattr(KINDS[kind], "optional", ())).difference(members)
        links = [member for member in KINDS[kind].members if member not in left_out]
        teeth = {w: SIZES.get(w, 20) for w in KINDS[kind].toothed if w not in left_out}
        numbers = {member: number for number, member in enumerate(links, 1)}
        one = Element("E", kind, numbers, teeth, efficiency=1.0, stiffness=1e5, damping=3)
        [made] = transmission(Drawing(max(len(links), 2), [one]), gears=[Gear()]).mechanisms
        assert (made.stiffness, made.damping) == (1e5, Damping(3.0)), kind


def test_what_is_written_reads_back_equal() -> None:
    planets = ", planet: {short: {inertia: 1e-5}, long: {inertia: 2e-5, mass: .3, radius: .05}}"
    by_ratio = changed("damping: 12", "damping: {ratio: .02}", ELASTIC)
    for text in (WITH_PLANET, ELASTIC, by_ratio, RAVIGNEAUX % planets):
        case = loaded(text)
        for written, file in ((write_yaml(case), "case.yaml"), (write_json(case), "case.json")):
            back = read(written.encode(), file).case
            assert back == case
            assert drawing_of(back) == drawing_of(case)


def test_masses_are_those_of_each_planet_by_its_name() -> None:
    for text, masses in (
        (WITH_PLANET, {"planet": PlanetMass(84e-6, 0.5, 0.052)}),
        (RAVIGNEAUX % ", planet: {long: {inertia: 2e-5}}", {"long": PlanetMass(2e-5)}),
    ):
        drawing = drawing_of(loaded(text))
        assert drawing is not None
        assert drawing.elements[0].planet_masses == masses


MASSES = (
    ("planets: 3, planet", "planet", ":5:101: error: elements.P1.planet: `planets` is missing"),
    (", radius: 52 mm", "", "elements.P1.planet: `radius` is missing"),
    ("radius: 52 mm", "radius: 0", "elements.P1.planet: `radius` is missing"),
    ("inertia: 84e-6", "inertia: -84e-6", "inertia: read -8.4e-05, expected an inertia of 0"),
    ("mass: 500 g", "mass: -1", "elements.P1.planet.mass: read -1, expected a mass of 0 or more"),
    ("radius: 52 mm", "radius: -1", "planet.radius: read -1, expected a radius of 0 or more"),
    ("mass: 500 g", "mass: nan", "elements.P1.planet.mass: read 'nan'"),
    ("inertia: 84e-6", "inertia: 84 N*m", "expected an inertia in kg*m^2"),
    ("inertia: 84e-6", "inetria: 84e-6", "did you mean `inertia`?"),
    ("planets: 3", "planets: 3, stiffness: 9e4", "list the planet as a link"),
    ("mass: 500 g", "planet: {inertia: 1}", "unknown key `planet`"),
)  # fmt: skip
STIFFNESSES = (
    ("stiffness: 9e4", "stiffness: 0", "P1.stiffness: read 0, expected a stiffness above 0"),
    ("stiffness: 9e4", "stiffness: -9e4", "read -90000, expected a stiffness above 0"),
    ("stiffness: 9e4, ", "", "read a damping without `stiffness`"),
    ("damping: 12", "damping: -1", "P1.damping: read -1, expected a damping of 0 or more"),
)  # fmt: skip


def test_masses_and_stiffnesses_that_cannot_be_are_reported() -> None:
    for text, faults in ((WITH_PLANET, MASSES), (ELASTIC, STIFFNESSES)):
        for before, after, said in faults:
            [told] = errors(changed(before, after, text))
            assert said in told


def test_an_element_of_several_rows_has_no_stiffness() -> None:
    text = RAVIGNEAUX % ", stiffness: 9e4"
    [told] = problems(text)
    assert told.startswith("case.yaml:6:78: error: elements.R.stiffness: the gear set has 4 mech")
    assert told.endswith("add springs to the links of the gear set [E317]")
    for two in (f"losses: reduced{text}", f"losses: meshes{ELASTIC}"):
        assert "the gear set has 2 mechanisms" in problems(two)[0]


def test_planets_without_teeth_have_no_speed_and_so_no_inertia() -> None:
    text = (RAVIGNEAUX % ", planet: {short: {inertia: 1e-5}}").replace(", short: 20", "")
    [told] = problems(text)
    said = "the speed of planet short is unknown, expected the tooth numbers of the gear set"
    assert f"elements.R.planet: {said}" in told
    loaded(text.replace("inertia: 1e-5", "mass: 1, radius: .1"))  # its pin is with the carrier


def test_planets_that_are_not_there_are_reported_to_the_library() -> None:
    members, teeth = {"first": 1, "second": 2}, {"first": 20, "second": 30}
    pair = Element("G", "gear_pair", members, teeth, planet_masses={"planet": PlanetMass(1.0)})
    with pytest.raises(CaseError, match="no planet `planet`, a gear_pair has none"):
        transmission(Drawing(2, [pair]), gears=[Gear()])


Speeds = dict[int, float]


def energy(element: Element, speeds: Speeds) -> float:
    """The kinetic energy of the planets of an element [J], at speeds of its links [rad/s]."""
    parts = [*planet_inertias(DrawingFields(9, [element]))]
    turning = (sum(part * speeds[link] for link, part in one.speed.items()) for one in parts)
    return sum(one.inertia * speed**2 / 2 for one, speed in zip(parts, turning, strict=True))


def simple(speeds: Speeds) -> float:
    members, teeth = {"sun": 1, "ring": 2, "carrier": 3}, {"sun": 30, "ring": 75, "planet": 22}
    masses = {"planet": PlanetMass(0.002, 0.7, 0.05)}
    one = Element("P", "planetary", members, teeth, planets=4, planet_masses=masses)
    return energy(one, speeds)


def test_planets_turn_by_their_teeth_and_are_masses_on_a_circle() -> None:
    """As one piece, Steiner: 4 (J + m r^2) w^2/2. Carrier held: 30 teeth turn 22 by -30/22."""
    as_one = 4 * (0.002 + 0.7 * 0.05**2) * 10**2 / 2
    assert simple({1: 10.0, 2: 10.0, 3: 10.0}) == pytest.approx(as_one)
    held = simple({1: 22.0, 2: -22 * 30 / 75, 3: 0.0})
    assert held == pytest.approx(4 * 0.002 * 30**2 / 2)


def test_meshed_and_stepped_planets_turn_by_their_own_teeth() -> None:
    """With the carrier held: sun 20 -> inner 10 -> outer 12, and a pair of rims 14 and 28."""
    members = {"sun": 1, "ring": 2, "carrier": 3}
    teeth = {"sun": 20, "ring": 60, "inner": 10, "outer": 12}
    masses = {"inner": PlanetMass(1.0), "outer": PlanetMass(10.0)}
    double = Element("D", "double_planet", members, teeth, planets=1, planet_masses=masses)
    expected = (20 / 10) ** 2 / 2 + 10 * (20 / 12) ** 2 / 2
    assert energy(double, {1: 1.0, 2: 20 / 60, 3: 0.0}) == pytest.approx(expected)
    wheels = [CentralWheel("s", 1, 28, False, "A"), CentralWheel("r", 2, 70, True, "B")]
    own: dict[str, Any] = {"rims": {"x": {"A": 14, "B": 28}}, "wheels": wheels, "planets": 2}
    masses = {"x": PlanetMass(1.0)}
    stepped = Element("G", "planet_group", {"carrier": 3}, planet_masses=masses, **own)
    assert energy(stepped, {1: 1.0, 2: -28 / 14 * 28 / 70, 3: 0.0}) == pytest.approx(2 * 2**2 / 2)


def test_planets_of_a_bevel_set_turn_about_axes_across() -> None:
    """So what turns with the carrier adds nothing to their spin; the housing has no share."""
    members, teeth = {"left": 1, "right": 2, "carrier": 3}, {"left": 16, "right": 16, "planet": 10}
    masses = {"planet": PlanetMass(0.001, 0.2, 0.03)}
    bevel = Element("B", "bevel", members, teeth, planets=2, planet_masses=masses)
    assert energy(bevel, {1: 11.0, 2: 9.0, 3: 10.0}) == pytest.approx(
        2 * (0.001 * 1.6**2 + 0.2 * 0.03**2 * 10**2) / 2
    )
    held = Element("B", "bevel", {**members, "carrier": 0}, teeth, planets=2, planet_masses=masses)
    case = transmission(Drawing(2, [held]), gears=[Gear()], input=1, output=2)
    [(spin, shares)] = planet_bodies(case)
    assert (spin.form, spin.inertia) == ({0: 1.6}, 0.002)
    assert sum(shares.values()) == pytest.approx(0.002 * 1.6**2)


@pytest.mark.parametrize("held", ["", "sun", "ring", "carrier"])
def test_inertias_on_links_have_the_energy_of_planets_in_every_motion(held: str) -> None:
    """By Willis w_s - w_c = -75/30 (w_r - w_c) and w_p - w_c = -30/22 (w_s - w_c)."""
    moves = {"": (15.5, -2.0), "sun": (0.0, 4.2), "ring": (10.5, 0.0), "carrier": (-5.0, 2.0)}
    sun, ring = moves[held]
    carrier = (30 * sun + 75 * ring) / (30 + 75)
    speeds = {"sun": sun, "ring": ring, "carrier": carrier}
    links = {name: place * (name != held) for place, name in enumerate(speeds, 1)}
    masses, teeth = {"planet": PlanetMass(0.002)}, {"sun": 30, "ring": 75, "planet": 22}
    element = Element("P", "planetary", links, teeth, planets=4, planet_masses=masses)
    ends = [link for link in links.values() if link]
    case = transmission(Drawing(3, [element]), gears=[Gear()], input=ends[0], output=ends[-1])
    [(body, shares)] = planet_bodies(case)
    by_link = {links[name] - 1: speed for name, speed in speeds.items()}
    turning = carrier - 30 / 22 * (sun - carrier)
    found = sum(part * by_link[link] for link, part in body.form.items())
    assert found == pytest.approx(turning)
    replaced = sum(share * by_link[link] ** 2 for link, share in shares.items())
    assert replaced == pytest.approx(4 * 0.002 * turning**2)
