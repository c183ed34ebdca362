"""`vstatics torsion modes` and `reduce`: what they show, what they are asked for."""

from __future__ import annotations

import pytest

from tests.torsion.cli.torsional import BOX, CHAIN, GOOD, document, said, tables
from vstatics import loads
from vstatics.torsion.reduction.reduced_values import reduce
from vstatics.torsion.vibration.gear_modes import modes

COASTER = """\
links: [engine, shaft, wheel]
inertias: {engine: 0.2, shaft: 0.05, wheel: 3}
shift_elements:
  F: {kind: freewheel, links: [shaft, engine]}
springs: {axle: {links: [shaft, wheel], stiffness: 700}}
gears: {"1": []}
"""
"""An engine that drives by a freewheel, which lets the wheel run ahead."""


def test_modes_in_json_are_those_of_the_library() -> None:
    made = document("modes")
    assert (made["format"], made["case"]) == ("vstatics-modes", "two gears")
    for told, gear in zip(made["gears"], modes(loads(BOX)), strict=True):
        assert told["name"] == gear.name
        if gear.error:
            continue
        assert told["rigid_modes"] == gear.rigid_modes
        assert [complex(s["real"], s["imag"]) for s in told["damped"]] == gear.damped
        for one, mode in zip(told["modes"], gear.modes, strict=True):
            assert (one["omega"], one["frequency"]) == (mode.omega, mode.frequency)
            assert one["damping_ratio"] == mode.damping_ratio
            assert one["damped_frequency"] == mode.damped_frequency
            assert (one["shape"], one["torques"]) == (mode.shape, mode.torques)
            assert (one["kinetic"], one["elastic"]) == (mode.kinetic, mode.elastic)
            assert one["sensitivity"]["stiffness"] == mode.by_stiffness
            assert one["sensitivity"]["inertia"] == mode.by_inertia


def test_tables_of_modes_have_all_digits_in_csv() -> None:
    found = tables(said("modes", "-f", "csv").out)
    gears = [gear for gear in modes(loads(BOX)) if not gear.error]
    heading, *rows = found["frequencies"]
    assert heading == [
        *("gear", "mode", "omega [rad/s]", "frequency [Hz]", "damping [-]", "damped [Hz]", "nodes")
    ]
    expected = [[gear.name, mode.omega] for gear in gears for mode in gear.modes]
    assert [[row[0], float(row[2])] for row in rows] == expected
    assert [row[:2] for row in found["rigid"][1:]] == [
        *(["low", "1"], ["direct", "1"], ["tied", "1"], ["N", "3"])
    ]
    [_, *shape] = found["Gear low: amplitudes of links"]
    assert [float(cell) for cell in shape[1][1:]] == [mode.shape["disc"] for mode in gears[0].modes]


def test_where_nothing_is_damped_there_are_no_eigenvalues_of_damped_vibration() -> None:
    assert "damped" not in tables(said("modes", "-f", "csv", text=CHAIN).out)
    assert document("modes", text=CHAIN)["gears"][0]["damped"] == []
    assert "damped" in tables(said("modes", "-f", "csv").out)


def test_the_first_modes_or_all() -> None:
    def count(*options: str, text: str = CHAIN) -> int:
        [gear] = document("modes", *options, text=text)["gears"]
        return len(gear["modes"])

    assert (count(), count("--modes", "1"), count("--modes", "999999999999")) == (2, 1, 2)
    omegas = [one["omega"] for one in document("modes", text=CHAIN)["gears"][0]["modes"]]
    first = document("modes", "--modes", "1", text=CHAIN)["gears"][0]["modes"]
    assert [one["omega"] for one in first] == pytest.approx(omegas[:1])
    names = [f"m{number}" for number in range(60)]
    shafts = ", ".join(
        f"s{number}: {{links: [m{number}, m{number + 1}], stiffness: 50}}" for number in range(59)
    )
    inertias = ", ".join(f"{name}: 1" for name in names)
    many = f"inertias: {{{inertias}}}\nsprings: {{{shafts}}}\n"
    assert (count(text=many), count("--modes", "59", text=many)) == (20, 59)


@pytest.mark.parametrize("count", ["0", "-1", "1.5", "nan", "", "many"])
def test_a_count_of_modes_that_is_none_is_wrong_use(count: str) -> None:
    answer = said("modes", "--modes", count)
    assert answer.is_wrong_use()


def test_a_freewheel_holds_as_in_run_by_drive_and_coast() -> None:
    def omegas(*options: str, text: str = COASTER) -> list[float]:
        [gear] = document("modes", *options, text=text)["gears"]
        return [mode["omega"] for mode in gear["modes"]]

    driven, coasting = [(700 * (1 / 0.25 + 1 / 3)) ** 0.5], [(700 * (1 / 0.05 + 1 / 3)) ** 0.5]
    assert omegas() == pytest.approx(driven)
    assert omegas("--coast") == pytest.approx(coasting)
    assert omegas(text=COASTER + "coast: true\n") == pytest.approx(coasting)
    assert omegas("--drive", text=COASTER + "coast: true\n") == pytest.approx(driven)


def test_redundant_devices_have_no_torque_of_their_own() -> None:
    text = CHAIN + "links: [a, b, c, d]\nshift_elements: {C: [c, d], E: [c, d]}\n"
    text += "gears: {both: {engaged: [C, E]}}\n"
    answer = said("modes", "-f", "csv", text=text)
    rows = tables(answer.out)["Gear both: torques of components at these amplitudes [N*m/rad]"]
    assert {row[0]: row[1] == "" for row in rows[1:]} == {
        "C": True,
        "E": True,
        "s": False,
        "t": False,
    }
    assert (answer.status, "gear both: " in answer.err) == (0, True)


# reduce


def test_a_reduction_in_json_is_that_of_the_library() -> None:
    made = document("reduce", "--to", "engine", text=GOOD)
    [gear], [expected] = made["gears"], reduce(loads(GOOD), "engine")
    assert made["to"] == "engine"
    for part in ("inertias", "compliances", "ratios", "merged", "notes"):
        assert gear[part] == getattr(expected, part), part


def test_a_link_is_told_by_its_name_or_number() -> None:
    by_name = document("reduce", "--to", "wheel", text=GOOD)
    assert document("reduce", "--to", "6", text=GOOD) == by_name
    assert by_name["gears"][0]["inertias"]["wheel"] == pytest.approx(1.2)


def test_what_has_no_value_is_null_with_the_reason() -> None:
    """Two shafts in line: their casing takes no reaction, and another train stands apart."""
    text = """\
links: [in, out, casing, apart]
inertias: {in: 1, out: 2, casing: 3, apart: 4}
mechanisms: {direct: {first: in, second: out, third: casing, ratio: 1, stiffness: 800}}
springs: {mount: {links: [casing, housing], stiffness: 50}}
gears: {"1": []}
output: out
"""
    [gear] = document("reduce", "--to", "in", text=text)["gears"]
    assert (gear["inertias"]["casing"], gear["compliances"]["mount"]) == (None, None)
    assert gear["notes"] == {"casing": "no reaction"}
    assert gear["inertias"]["apart"] is None
    rows = tables(said("reduce", "--to", "in", "-f", "csv", text=text).out)
    assert ["casing", ""] in rows["inertias"]
    assert ["1", "casing", "no reaction"] in rows["notes"]


@pytest.mark.parametrize(
    ("link", "hint"),
    [
        ("egnine", "did you mean `engine`?"),
        ("9", "no link '9'; links are engine, disc"),
        ("0", "no link '0'"),
        ("housing", "no link 'housing'"),
        ("", "no link ''"),
        ("nan", "no link 'nan'"),
    ],
)
def test_a_link_that_is_not_there_is_wrong_use(link: str, hint: str) -> None:
    answer = said("reduce", "--to", link)
    assert answer.is_wrong_use(hint)


def test_a_link_that_stands_can_be_no_link_to_reduce_to() -> None:
    answer = said("reduce", "--to", "casing", "-f", "json", text=GOOD)
    assert answer.fails("gear direct: link casing does not turn: nothing can be reduced to it")
