"""Numbers of a scenario and of its case by their paths: found, replaced, refused."""

import pytest

from tests.commands import MZKT
from tests.simulation.variants.scenarios import CASE, subject
from vstatics import ReadError, VariedScenario, loads
from vstatics.core.writers.workbook import write
from vstatics.simulation import Capacity, Points
from vstatics.sweep import build
from vstatics.sweep.options import SweepOptions
from vstatics.sweep.variants.subject import Document
from vstatics.sweep.variants.variation import read_variation


def test_a_path_names_a_number_of_the_scenario_or_its_case() -> None:
    for text, name, value in (
        ("duration", "duration", 0.6),
        ("controls.brake.1.2", "controls.brake.1.2", 120.0),
        ("controls.brake.points.1.2", "controls.brake.points.1.2", 120.0),
        ("torques.sun", "torques.sun", 40.0),
        ("targets.carrier.2", "targets.carrier.2", 20.0),
        ("start.speeds.sun [rpm]", "start.speeds.sun [rpm]", 500.0),
        ("inertias.ring", "inertias.ring", 0.7),
        ("ring.inertia", "inertias.ring", 0.7),
        ("mechanisms.set.ratio", "mechanisms.set.ratio", -1.5),
        ("set.ratio", "mechanisms.set.ratio", -1.5),
        ('controls."lock-up".scale', "controls.lock-up.scale", None),
        ("shift_elements.brake.static", "shift_elements.brake.static", None),
    ):
        varied = subject()
        path = varied.target(text)
        assert path.name == name
        if value is not None:
            assert varied.written_number(path, None) == value


def test_a_variant_is_the_documents_with_other_numbers() -> None:
    varied = subject()
    changed = {"duration": 2.0, "controls.brake.1.2": 99.5, "controls.lock-up.scale": 0.5}
    changed |= {"shift_elements.brake.static": 1.25, "ring.inertia": 0.1}
    changed["start.speeds.sun [rpm]"] = 30.0
    made = varied.variant([*map(varied.target, changed)], [*changed.values()]).scenario
    assert made.duration == 2.0
    assert made.controls is not None
    assert made.controls[1] == Capacity(Points((0.0,), (99.5,)))
    assert made.controls[2].scale == 0.5  # type: ignore[union-attr]
    assert made.case.shift_elements[0].static == 1.25
    assert made.case.inertias == {1: 0.5, 2: 0.1, 3: 0.8}
    assert made.start.speeds[1] == pytest.approx(3.14159265358979)
    own = varied.own.scenario
    assert (own.duration, own.case.inertias[2]) == (0.6, 0.7)


def test_counts_of_teeth_vary_as_whole_numbers() -> None:
    case = b"""
links: [s, r, c]
input: s
output: c
inertias: {s: 1, r: 1, c: 1}
elements: {P1: {kind: planetary, sun: s, ring: r, carrier: c, teeth: {sun: 30, ring: 60}}}
shift_elements: {B: [r, housing]}
gears: {"1": [B]}
"""
    teeth = subject(b"{case: x, duration: 1, start: {gear: '1'}}", case)
    path = teeth.target("elements.P1.teeth.ring")
    assert teeth.variant([path], [90.0]).scenario.case.mechanisms[0].ratio == -3.0


def test_what_there_is_not_is_reported_with_its_place() -> None:
    for text, said in (
        ("control.brake.1.2=1,2", "a key `control`; did you mean `controls`?"),
        ("controls.brake.2.1=1,2", "1:16: error: read `2`, expected the number of an item, 1 to 1"),
        ("controls.lock-up=1,2", "`controls.lock-up` is a formula, '0*t', expected a number"),
        ("start=1,2", "`start` is a mapping: name a number in it"),
        ("start.speeds.sun=1,2", "is in rpm in the document, so its values need their unit"),
        ("duration=1 s:2 min:3", "read values in s and min, expected one unit for all"),
        ("duration [s]=1 min,2", "read values in min, expected them in s"),
        ("duration", "read `duration` without values, expected duration="),
        ("D9.ratio=1,2", "neither the scenario nor its case has a key `D9`"),
    ):
        with pytest.raises(ReadError) as caught:
            read_variation(text, subject())
        assert said in str(caught.value)
        assert caught.value.problems[0].place is not None


def test_a_unit_may_stand_behind_some_values_and_holds_for_all() -> None:
    read = read_variation("start.speeds.sun=500 rpm:700 rpm:3", subject())
    assert read.target.name == "start.speeds.sun [rpm]"
    assert read_variation("start.speeds.sun=500:700:3 rpm", subject()).target == read.target
    assert read_variation("start.speeds.sun [rpm]=500,700", subject()).target == read.target


def test_a_key_that_a_document_cannot_have_is_reported_before_anything_is_calculated() -> None:
    for name, known in (("controls.brake.scal", "scale"), ("start.speeds.sum", "sun")):
        with pytest.raises(ReadError, match=f"did you mean `{known}`"):
            build.plan(subject(), SweepOptions.of(vary=[f"{name}=1,2"]))
    made = build.plan(subject(), SweepOptions.of(vary=["controls.brake.scale=1,2"]))
    assert made.names == ("controls.brake.scale",)


def test_a_number_of_formulas_that_is_not_there_is_refused_and_not_made() -> None:
    given = subject(
        b"{case: x, duration: 1, start: {gear: '1'}, numbers: {lag: 1}, set: {aim: 2}}", CASE
    )
    assert given.target("numbers.lag").name == "numbers.lag"
    for text, said in (("numbers.lagg", "did you mean `lag`"), ("set.x", "has no `set.x`")):
        with pytest.raises(ReadError, match=said):
            given.target(text)


def test_no_number_varies_twice_whatever_it_is_called() -> None:
    vary = ["set.ratio=-2,-3", "mechanisms.set.ratio=-2,-3"]
    with pytest.raises(ReadError, match="is varied twice"):
        build.plan(subject(), SweepOptions.of(vary=vary))


def test_of_a_deck_no_numbers_vary() -> None:
    scenario = subject(b"{case: x, duration: 1, start: {gear: '1'}}").scenario
    varied = VariedScenario(scenario, Document(MZKT.read_bytes(), "mzkt.dat"))
    assert varied.trees.case is None
    with pytest.raises(ReadError, match="has no key `D1`; to vary numbers of a deck, convert it"):
        varied.target("D1.ratio")


def test_numbers_of_a_workbook_vary_as_those_of_yaml() -> None:
    text = CASE.split(b"mechanisms")[0] + (
        b"elements: {set: {kind: planetary, sun: sun, ring: ring, carrier: carrier, "
        b"teeth: {sun: 30, ring: 78}}}\nshift_elements: {brake: {links: [ring, housing], "
        b"capacity: 90}, lock-up: [sun, ring]}\n" + CASE.splitlines()[-1]
    )
    of_yaml = subject(case=text)
    of_book = VariedScenario(of_yaml.scenario, Document(write(loads(text.decode())), "set.xlsx"))
    for name, value in (
        *(("elements.set.teeth.ring", 84.0), ("set.teeth.sun", 26.0), ("ring.inertia", 0.9)),
        *(("shift_elements.brake.capacity", 75.0), ("torques.sun", 30.0)),
    ):
        one, other = (
            varied.variant([varied.target(name)], [value]).scenario for varied in (of_yaml, of_book)
        )
        assert one == other
        assert one != of_yaml.own.scenario
