"""`vstatics torsion modes` and `reduce`: what they show, what they are asked for."""

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
    same = ("omega", "frequency", "damping_ratio", "damped_frequency")
    for told, gear in zip(made["gears"], modes(loads(BOX)), strict=True):
        assert told["name"] == gear.name
        if gear.error:
            continue
        assert told["rigid_modes"] == gear.rigid_modes
        assert [complex(s["real"], s["imag"]) for s in told["damped"]] == gear.damped
        for one, mode in zip(told["modes"], gear.modes, strict=True):
            for key in (*same, "shape", "torques", "kinetic", "elastic"):
                assert one[key] == getattr(mode, key), key
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
    rigid = {"low": "1", "direct": "1", "tied": "1", "N": "3"}
    assert dict(row[:2] for row in found["rigid"][1:]) == rigid
    [_, *shape] = found["Gear low: amplitudes of links"]
    assert [float(cell) for cell in shape[1][1:]] == [mode.shape["disc"] for mode in gears[0].modes]
    assert "damped" in found
    assert "damped" not in tables(said("modes", "-f", "csv", text=CHAIN).out)


def test_the_first_modes_or_all() -> None:
    def omegas(*options: str) -> list[float]:
        [gear] = document("modes", *options, text=CHAIN)["gears"]
        return [mode["omega"] for mode in gear["modes"]]

    both = omegas()
    assert (len(both), omegas("--modes", "999999999999")) == (2, both)
    assert omegas("--modes", "1") == pytest.approx(both[:1])
    for count in ("0", "-1", "1.5", "nan", "", "many"):
        assert said("modes", "--modes", count).is_wrong_use(), count


def test_a_freewheel_holds_as_in_run_by_drive_and_coast() -> None:
    def omegas(*options: str, text: str = COASTER) -> list[float]:
        [gear] = document("modes", *options, text=text)["gears"]
        return [mode["omega"] for mode in gear["modes"]]

    driven, coasting = [(700 * (1 / 0.25 + 1 / 3)) ** 0.5], [(700 * (1 / 0.05 + 1 / 3)) ** 0.5]
    assert omegas() == pytest.approx(driven)
    assert omegas("--coast") == pytest.approx(coasting)
    assert omegas(text=COASTER + "coast: true\n") == pytest.approx(coasting)
    assert omegas("--drive", text=COASTER + "coast: true\n") == pytest.approx(driven)


def test_a_reduction_in_json_is_that_of_the_library() -> None:
    made = document("reduce", "--to", "engine", text=GOOD)
    [gear], [expected] = made["gears"], reduce(loads(GOOD), "engine")
    assert made["to"] == "engine"
    for part in ("inertias", "compliances", "ratios", "merged", "notes"):
        assert gear[part] == getattr(expected, part), part
    by_name = document("reduce", "--to", "wheel", text=GOOD)
    assert document("reduce", "--to", "6", text=GOOD) == by_name


def test_what_has_no_value_has_an_empty_cell_and_the_reason() -> None:
    """Two shafts in line: their casing takes no reaction."""
    text = """\
inertias: {in: 1, out: 2, casing: 3}
mechanisms: {direct: {first: in, second: out, third: casing, ratio: 1, stiffness: 800}}
springs: {mount: {links: [casing, housing], stiffness: 50}}
output: out
"""
    rows = tables(said("reduce", "--to", "in", "-f", "csv", text=text).out)
    assert ["casing", ""] in rows["inertias"]
    assert ["1", "casing", "no reaction"] in rows["notes"]


def test_a_link_that_is_not_there_or_stands_is_refused() -> None:
    for link, hint in (
        ("egnine", "did you mean `engine`?"),
        ("9", "no link '9'; links are engine, disc"),
        *((one, f"no link '{one}'") for one in ("0", "housing", "", "nan")),
    ):
        assert said("reduce", "--to", link).is_wrong_use(hint), link
    answer = said("reduce", "--to", "casing", "-f", "json", text=GOOD)
    assert answer.fails("gear direct: link casing does not turn: nothing can be reduced to it")
