"""Linked numbers: each variant is that of a table whose numbers were calculated by hand."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.chance import examples, generator
from tests.commands import CASES, vstatics
from tests.installed import needs
from vstatics import ReadError, load, loads, sweep
from vstatics.sweep.build import plan
from vstatics.sweep.chunk import STATUS
from vstatics.sweep.options import SweepOptions
from vstatics.sweep.tasks import Portion, SweepTask, items

CASE = """\
links: [sun, ring, carrier]
output: carrier
elements:
  P1: {kind: planetary, sun: sun, ring: ring, carrier: carrier, teeth: {sun: 33, planet: 17, ring: 67}}
shift_elements: {B1: [ring, housing]}
gears: {low: [B1]}
load: {speed: 2000 rpm, torque: 300 N*m}
"""
OUT = "ratio[low],efficiency[low],output_power_kW[low]"
RINGS = ("--vary", "P1.teeth.ring=65:83:10")


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    (folder / "box.yaml").write_text(CASE)


@examples(4, 15, 200)
def test_linked_numbers_are_those_of_a_table(examples: int) -> None:
    """The table has the numbers of Python's own arithmetic, to the last bit."""
    case, chance = load("box.yaml"), generator(17)
    for _ in range(examples):
        rings = chance.integers(60, 90, 6).astype(float)
        a, b = chance.uniform(0.5, 2, 2).round(3).tolist()
        links = {
            "P1.teeth.planet": "(P1.teeth.ring - P1.teeth.sun)/2",
            "load.torque [N*m]": f"{a}*P1.teeth.planet + {b}*load.speed/1000",
            "mesh_efficiency.external": "1 - sqrt(load.torque)/1e3",
        }
        planets = (rings - 33) / 2
        torques = a * planets + b * 2000.0 / 1000
        table = {
            "P1.teeth.ring": rings,
            "P1.teeth.planet": planets,
            "load.torque [N*m]": torques,
            "mesh_efficiency.external": 1 - np.sqrt(torques) / 1e3,
        }
        [linked] = sweep(case, {"P1.teeth.ring": rings}, linked=links, out=OUT)
        [given] = sweep(case, variants=table, out=OUT)
        assert linked.names == tuple(table)
        np.testing.assert_allclose(linked.values, given.values, rtol=1e-15)
        np.testing.assert_array_equal(linked.status, given.status)
        np.testing.assert_allclose(linked.columns, given.columns, rtol=1e-12)


def test_files_tables_samples_and_workers_link_alike(folder: Path) -> None:
    text = "case: box.yaml\nvary: {P1.teeth.ring: 65:83:10}\nout: ratio\n"
    (folder / "sweep.yaml").write_text(text + "with: {P1.teeth.planet: (P1.teeth.ring - 33)/2}\n")
    (folder / "table.csv").write_text("\n".join(["P1.teeth.ring", *map(str, range(65, 85, 2)), ""]))
    link = ("--with", "P1.teeth.planet=(P1.teeth.ring - P1.teeth.sun)/2", "--out", "ratio", "-q")
    ways = [
        ("--file", "sweep.yaml", "-q"),
        ("box.yaml", *RINGS, *link),
        ("box.yaml", "--variants", "table.csv", *link),
        ("box.yaml", "--variants", "table.csv", *link, "-o", "out.csv", "-j", "2"),
    ]
    written = [vstatics("sweep", *way).out for way in ways[:3]]
    assert vstatics("sweep", *ways[3]).status == 0
    head = "variant,P1.teeth.ring,P1.teeth.planet,status,ratio[low]"
    assert written[0].startswith(f"{head}\n0,65,16,")
    assert {*written, Path("out.csv").read_text()} == {written[0]}
    linked = ["load.torque [N*m]=100*P1.efficiency"]
    asked = {"sample": 8, "method": "random", "linked": linked, "out": "ratio"}
    [drawn] = sweep(load("box.yaml"), "P1.efficiency=0.9:0.99", **asked)  # type: ignore[arg-type]
    np.testing.assert_allclose(drawn.values[:, 1], 100 * drawn.values[:, 0], rtol=1e-15)


def test_ratios_of_the_case_can_be_linked_while_teeth_vary() -> None:
    text = CASE.replace("carrier]\noutput: carrier", "carrier, out]\noutput: out")
    case = loads(text + "mechanisms: {pair: {first: carrier, second: out, ratio: -3}}\n")
    rings, linked = {"P1.teeth.ring": [67.0, 69.0]}, ["load.torque [N*m]=-10*pair.ratio"]
    [chunk] = sweep(case, rings, linked=linked, out="pair.ratio")
    assert chunk.values[:, 1].tolist() == [30, 30]
    assert chunk.columns[:, 0].tolist() == [-3, -3]


def test_workers_without_access_to_a_table_receive_its_linked_numbers() -> None:
    options = SweepOptions.of(linked=("load.torque [N*m]=10*P1.teeth.ring",), out="ratio")
    rings = {"P1.teeth.ring": [67.0, 69.0]}
    task = SweepTask(plan(load("box.yaml"), options, table=rings), "csv")
    [portion] = items(task, [0], remote=True)
    assert isinstance(portion, Portion)
    assert portion.variants.block(0, 2).tolist() == [[67, 670], [69, 690]]


def test_a_link_without_a_value_makes_an_invalid_variant() -> None:
    linked = {"load.torque [N*m]": "100/(P1.teeth.ring - 66)"}
    [chunk] = sweep(load("box.yaml"), {"P1.teeth.ring": [66.0, 67.0]}, linked=linked, out="ratio")
    assert [STATUS[code] for code in chunk.status] == ["invalid", "ok"]
    np.testing.assert_array_equal(chunk.values[:, 1], [math.nan, 100])


@needs("simulation")
def test_a_scenario_links_its_numbers() -> None:
    scenario = str(CASES / "scenarios/moskvich-start.yaml")
    said = vstatics(
        *("sweep", scenario, "--vary", "start.speeds.engine=200,260", "-q", "--out", "duration"),
        *("--with", "duration=start.speeds.engine/1000"),
    )
    rows = [line.split(",") for line in said.out.splitlines()]
    assert rows[0][:3] == ["variant", "start.speeds.engine", "duration"]
    assert [float(row[2]) for row in rows[1:]] == [0.2, 0.26]


SUN, PLANET = "P1.teeth.sun", "P1.teeth.planet"


def test_wrong_links_are_located() -> None:
    for links, column, message in (
        ([f"{SUN}={SUN} + 1"], 1, f"linked in a circle: {SUN} -> P1"),
        ([f"{SUN}={PLANET}", f"{PLANET}={SUN}"], 1, f"{SUN} -> {PLANET} -> {SUN}"),
        ([f"{SUN}={PLANET}", f"{PLANET}=5"], 1, "linked later"),
        (["P1.teeth.ring=5"], 1, "P1.teeth.ring is varied twice"),
        ([f"{SUN}=3", f"{SUN}=4"], 1, f"{SUN} is varied twice"),
        ([f"{SUN}=P1.teeth.rng"], 14, "did you mean `P1.teeth.ring`"),
        ([f"{SUN} [N]=5"], 1, "read values in N, expected bare numbers"),
        (["load.speed=5"], 1, "such as `load.speed [rpm]=...`"),
        (["load.torque [N]=5"], 1, "such as `load.torque [N*m]=...`"),
        ([SUN], 13, f"expected {SUN}= and then a formula"),
        ([f"{SUN}="], 14, "read no formula"),
        ([f"{SUN}=ratio[low]"], 14, "linked to results, ratio"),
        ([f"{SUN}=(3"], 16, "is not closed"),
        (["P1.ratio=-2"], 1, "teeth that determine it"),
        (["nope.x=3"], 1, "there is no"),
    ):
        options = [word for link in links for word in ("--with", link)]
        said = vstatics("sweep", "box.yaml", *RINGS, *options, "-o", "o.csv")
        assert said.fails(f"--with:1:{column}: error", message)
        assert not Path("o.csv").exists()
        with pytest.raises(ReadError):
            sweep(load("box.yaml"), RINGS[1], linked=links)


def test_a_circle_in_a_file_has_its_line(folder: Path) -> None:
    text = (
        "case: box.yaml\nvary: {P1.teeth.ring: 65:83:10}\nwith:\n  P1.teeth.sun: P1.teeth.sun/2\n"
    )
    (folder / "sweep.yaml").write_text(text)
    said = vstatics("sweep", "--file", "sweep.yaml")
    assert said.fails("sweep.yaml:4:3: error: numbers are linked in a circle")
    alone = vstatics("sweep", "box.yaml", "--with", "P1.teeth.sun=3")
    assert alone.is_wrong_use("Nothing is varied")
