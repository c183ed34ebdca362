"""Names that a person types: a number has a name and a deck name, a row has one name."""

import re
from typing import Any

import numpy as np
import pytest

from tests.commands import ROOT
from tests.core.elements.element_texts import AOD, loaded
from tests.core.writers.result_cases import csv_of
from tests.core.writers.result_cases import table as table_lines
from tests.shipped import shipped_results
from vstatics import ReadError, Transmission, solve
from vstatics.core.statics.result_arrays import ARRAYS, Rows
from vstatics.core.tables.dataframe import to_dataframe
from vstatics.core.tables.names import row_named, table_rows
from vstatics.core.tables.quantities import ASKED, QUANTITIES
from vstatics.core.tables.values import tables
from vstatics.core.writers import listing
from vstatics.core.writers.result_json import document

EVERYTHING = """
links: [in, large, carrier, ring, out]
output: out
load: {speed: 2000 rpm, torque: 300 N*m}
mesh_efficiency: {external: 0.985, internal: 0.995}
elements:
  set:
    kind: ravigneaux
    small_sun: in
    large_sun: large
    ring: ring
    carrier: carrier
    teeth: {small_sun: 30, large_sun: 36, ring: 72, short: 18, long: 18}
  P1: {kind: planetary, sun: ring, ring: housing, carrier: out, teeth: {sun: 30, ring: 75}}
mechanisms:
  TC: {kind: converter, first: in, second: large, points: [[0, 2, 0.004], [1, 1, 0]]}
shift_elements:
  C1: [in, carrier]
  B1: [large, housing]
  L1: {kind: freewheel, links: [carrier, housing]}
drag: {ring: 1 N*m}
gears:
  low: {open: [TC]}
  second: {engaged: [B1], open: [TC], loss: {over: [speed, torque], columns: [0, 9], rows: [[0, 9, 9], [9, 9, 9]]}}
  held: {open: [TC], speeds: {large: -200 rpm}}
  creep: {open: [TC], slip: {B1: -100 rpm}}
"""
"""A shared planet, a plain set, clutch, brake, freewheel, drag, a given speed, a slip, an open converter, a load."""
DECLARED = [one for one in QUANTITIES + ASKED if one.columns == "gears"]


@pytest.fixture(scope="module")
def everything() -> Transmission:
    return loaded(EVERYTHING)


def test_every_array_of_the_results_is_declared() -> None:
    assert ARRAYS.keys() <= {one.name for one in DECLARED}


def test_the_case_has_everything(everything: Transmission) -> None:
    """So that no name below is tried in vain."""
    made = {table.quantity.name for table in tables(solve(everything))}
    assert made == {one.name for one in QUANTITIES}


WORDS: dict[Rows, str] = {
    "links": "links",
    "planets": "planets",
    "elements": "shift elements",
    "devices": "gear sets",
    "mechanisms": "mechanisms",
    "torques": "components, `Mx`",
    "meshes": "meshes",
    "converters": "converters",
    "one": "",
}
"""Rows of a table in the documentation."""


def test_the_documentation_lists_every_name_with_deck_name_rows_and_unit() -> None:
    text = (ROOT / "docs" / "results.md").read_text("utf-8")
    found = re.findall(r"^\| `(\w+)` \| `(\w+)` \|(.*?)\|.*\|(.*?)\|$", text, re.MULTILINE)
    listed = [one for one in QUANTITIES + ASKED if not one.of]
    assert [(name, deck_name, rows.strip()) for name, deck_name, rows, _ in found] == [
        (one.name, one.deck_name, WORDS[one.rows]) for one in listed
    ]
    units = {name: unit.strip() for name, _, _, unit in found}
    for one in listed:
        number = "-" if one.is_sign else {float: "-", int: "count", bool: "0, 1"}[one.kind]
        ending = f"`_{one.with_load}`" if one.with_load else ""
        assert units[one.name] == (one.unit or ending or number)


def test_a_device_is_no_row_of_links_or_shift_elements() -> None:
    """A brake `P1.b` is none of the rows of the set P1."""
    case = loaded(EVERYTHING.replace("B1", "P1.b"))
    with pytest.raises(ReadError, match=r"`P1` has the rows P1\.sun, P1\.ring, P1\.carrier;"):
        row_named("P1", "torques", case)
    with pytest.raises(ReadError, match="there is no shift element `P1`"):
        row_named("P1", "elements", case)
    assert [row_named(name, "elements", case) for name in ("C1", "2", "#3")] == [0, 1, 2]


def test_a_data_frame_has_the_units_of_the_load(everything: Transmission) -> None:
    table = to_dataframe(solve(everything, ratios=[[m.ratio for m in everything.mechanisms]] * 2))
    assert table["lossy_torques_Nm", "P1.sun"].tolist() == pytest.approx(
        (table["lossy_torques", "P1.sun"] * 300).tolist(), nan_ok=True
    )
    assert table["speeds_rpm", "in"].tolist() == [2000] * 8
    losses: Any = table["losses_kW"]
    slips: Any = table["slip_losses_kW"]
    lost = losses.sum(axis=1) + slips.sum(axis=1)
    lost += table["drag_losses_kW"] + table["gear_losses_kW"]
    found = table["input_power_kW"] - table["output_power_kW"]
    assert found.tolist() == pytest.approx(lost.tolist())
    without = to_dataframe(shipped_results("simpson.yaml"))
    assert not [name for name in without if re.search("_rpm|_Nm|_kW", str(name))]


OWN = ["small_sun", "large_sun", "ring", "carrier"]
ELEMENTS = ["forward", "reverse", "direct", "overdrive", "low"]
ROWS = {"losses": ["set"], "torques": [*ELEMENTS, *(f"set.{member}" for member in OWN), "Mx"]}
"""What the text of the case names: one set of four members, five shift elements."""


def test_rows_have_the_names_of_the_case_in_arrays_json_csv_and_the_listing() -> None:
    """Of the listing torques stand in two tables; the name follows a stroke."""
    aod = solve(loaded(AOD))
    in_json, text = document(aod), listing.write(aod)
    torques = table_lines(text, "(AMLG(I,J),J=1,NP),I=1,KL:")
    torques += table_lines(text, "(AMLG(I,J),J=1,NP),I=(KL+1),KLG1:")
    losses = table_lines(text, "(LOSS(I,J),J=1,NP),I=1,KG:")
    for name, lines in {"torques": torques, "losses": losses}.items():
        assert list(table_rows(name, aod.case)) == in_json["rows"][name] == ROWS[name]
        assert [line.partition("| ")[2] for line in lines] == ROWS[name]
        assert getattr(aod, name) == pytest.approx(np.array(in_json[name]).T)
        in_csv = [line for line in csv_of(aod) if line[0] == name]
        assert len(in_csv) == 5 * len(ROWS[name])
        assert {row for line in in_csv for row in line} >= set(ROWS[name])
