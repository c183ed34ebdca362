"""Sweeps over teeth, capacities and friction: numbers that make another case."""

import csv
import json
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

import vstatics
from tests.chance import seeded
from tests.commands import vstatics as run
from vstatics import solve
from vstatics.core.readers import from_dict
from vstatics.core.statics.result_arrays import ARRAYS
from vstatics.sweep.chunk import STATUS

PLANETARY = {"kind": "planetary", "sun": "s", "ring": "r", "carrier": "c"}
PAIR = {"first": 20, "second": 40}
CASE: dict[str, Any] = {
    "links": ["s", "r", "c", "out"],
    "output": "out",
    "shift_elements": {"B": {"links": ["r"], "capacity": "900 N*m"}, "K": {"links": ["s", "c"]}},
    "elements": {
        "P1": {**PLANETARY, "teeth": {"sun": 30, "ring": 75}, "planets": 3},
        "pair": {"kind": "gear_pair", "first": "c", "second": "out", "teeth": PAIR},
    },
    "gears": {"one": {"engaged": ["B"], "torques": {"c": "4 N*m"}}, "two": ["K"]},
    "load": {"speed": "2000 rpm", "torque": "100 N*m"},
}


@pytest.fixture
def case() -> vstatics.Transmission:
    return from_dict(CASE)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    (tmp_path / "case.json").write_text(json.dumps(CASE), "utf-8")
    return tmp_path / "case.json"


def changed(*ways: tuple[tuple[str, ...], float | str]) -> vstatics.Transmission:
    document = json.loads(json.dumps(CASE))
    for keys, number in ways:
        inner = document
        for key in keys[:-1]:
            inner = inner.setdefault(key, {})
        inner[keys[-1]] = number
    return from_dict(document)


def test_what_cannot_be_put_together_is_said_and_its_numbers_stand(
    case: vstatics.Transmission,
) -> None:
    """Planets want (ring - sun)/2 and (sun + ring)/planets to be whole."""
    [chunk] = vstatics.sweep(case, {"P1.teeth.sun": "25:40:16", "P1.planets": [3, 4]}, out="ratio")
    said = [STATUS[code] for code in chunk.status]
    for (sun, planets), status in zip(chunk.values.astype(int).tolist(), said, strict=True):
        fits = (75 - sun) % 2 == 0 and (75 + sun) % planets == 0
        assert status == ("ok" if fits else "not assembled")
    assert np.isfinite(chunk.columns).all()
    assert chunk.counts == {"ok": said.count("ok"), "not assembled": said.count("not assembled")}


@pytest.mark.parametrize("by", [(), ("--by", "gear")])
def test_what_cannot_be_put_together_is_best_only_if_it_is_asked_for(
    by: tuple[str, ...], file: Path
) -> None:
    def suns(*options: str) -> list[int]:
        asked = ("--vary", "P1.teeth.sun=25:40:16", "--out", "ok", "-f", "csv", *by, *options)
        said = run("sweep", file, *asked)
        assert said.status == 0, said.err
        rows = list(csv.DictReader(said.out.splitlines()))
        assert [row["ok"] == "1" for row in rows] == [row["status"] == "ok" for row in rows]
        return list(dict.fromkeys(int(row["P1.teeth.sun"]) for row in rows))

    every = [*range(25, 41)]
    fitting = [sun for sun in every if (75 - sun) % 2 == 0 and (75 + sun) % 3 == 0]
    others = [sun for sun in every if sun not in fitting]
    assert (suns(), suns("--where", "ok"), suns("--where", "not ok")) == (every, fitting, others)
    best = "--min", "P1.teeth.sun", "--best", "100"
    assert (suns(*best), suns(*best, "--where", "ok or not ok")) == (fitting, every)
    assert suns(*best, "--max", "P1.teeth.sun") == fitting  # none dominates another


def other_documents() -> tuple[dict[str, Any], list[vstatics.Transmission]]:
    """Teeth, friction and load in a random order: what varies, and the case of each point."""
    rng = seeded(2781)
    ways: dict[str, tuple[str, ...]] = {
        "P1.teeth.sun": ("elements", "P1", "teeth", "sun"),
        "pair.teeth.second": ("elements", "pair", "teeth", "second"),
        "mesh_efficiency.friction": ("mesh_efficiency", "friction"),
    }
    rows = [
        (rng.choice([27, 33, 36]), rng.choice([41, 53]), rng.uniform(0.03, 0.1)) for _ in range(9)
    ]
    torques = [rng.uniform(-200, 200) for _ in rows]
    vary = {**dict(zip(ways, zip(*rows, strict=True), strict=True)), "load.torque": torques}
    return vary, [
        changed(*zip(ways.values(), row, strict=True), (("load", "torque"), f"{torque!r} N*m"))
        for row, torque in zip(rows, torques, strict=True)
    ]


def test_variants_are_the_cases_of_other_documents(case: vstatics.Transmission) -> None:
    """Teeth, friction, load and a given torque together, in a random order."""
    table, documents = other_documents()
    out = "lossy_torques_Nm[B], efficiency, planet_speeds[P1], speeds_rpm[out]"
    [chunk] = vstatics.sweep(case, variants=table, out=out)
    for row, document in zip(chunk.columns, documents, strict=True):
        own = solve(document)
        tables = (own.lossy_torques_Nm[:, 0], own.efficiency)
        more = (own.existing("planet_speeds")[:, 0], own.speeds_rpm[:, 3])
        np.testing.assert_allclose(row, np.concatenate([*tables, *more]), rtol=1e-11)


def test_points_of_solve_are_the_cases_of_other_documents(case: vstatics.Transmission) -> None:
    """Every array, and what follows from it in units; points with the same teeth are one case."""
    vary, documents = other_documents()
    together = solve(case, vary=vary)
    for point, document in enumerate(documents):
        own = solve(document)
        for name in (*ARRAYS, "port_powers_kW", "losses_kW", "lossy_torques_Nm"):
            found, expected = getattr(together, name)[point], getattr(own, name)
            np.testing.assert_allclose(found, expected, rtol=1e-11, err_msg=name)


def test_numbers_of_no_case_are_reported_or_invalid(
    case: vstatics.Transmission, file: Path
) -> None:
    for path, values, said in (
        ("P1.teeth.sun", [30, 29.5], "read 29.5 in variant 1, expected a whole number"),
        ("P1.teeth.sun", [30, 90], "in variant 1: read 75, expected more teeth than the 90 of sun"),
        ("P1.teeth.son", [30], "did you mean `P1.teeth.sun`"),
    ):
        with pytest.raises(vstatics.CaseError, match=said):
            solve(case, vary={path: values})
    [chunk] = vstatics.sweep(case, {"P1.teeth.sun": [30.0, 29.5, 0.0, -3.0, 75.0]}, out="ratio")
    assert [STATUS[code] for code in chunk.status] == ["not assembled", *["invalid"] * 4]
    assert np.isnan(chunk.columns[1:]).all()
    for sun, said in (("75", "expected more teeth than the 75 of sun"), ("30.5", "a whole number")):
        assert run("sweep", file, "--vary", f"P1.teeth.sun={sun}").fails(said)


def test_a_capacity_is_a_number_of_conditions(file: Path) -> None:
    """The brake holds i - 1 = 2.5 times the input torque."""
    file.write_text(json.dumps({**CASE, "gears": {"one": ["B"]}}))
    vary = "--vary", "B.capacity=.2 kN*m,.3 kN*m"
    where = "--where", "abs(torques_Nm[B, one]) < 1000*B.capacity"
    ran = run("sweep", file, *vary, "--out", "ratio", *where)
    lines = [line.split(",") for line in ran.out.splitlines()]
    assert lines[0][1] == "B.capacity [kN*m]"
    assert [line[1] for line in lines[1:]] == ["0.3"]


def test_what_is_wrong_is_reported_at_its_place(file: Path) -> None:
    for vary, said in {
        "P1.teeth.moon=30": "expected `P1.teeth.` and one of sun, ring, planet",
        "P1.teeth=30": "expected `P1.teeth.` and one of sun, ring, planet",
        "P2.teeth.sun=30": "did you mean `P1.teeth.sun`",
        "mesh_efficiency.frict=.1": "did you mean `mesh_efficiency.friction`",
        "B.capacity=30": "its values need their unit",
        "B.capacity=30 kg": "this is a mass",
        "P1.teeth.sun=30 rpm": "expected bare numbers",
        "P1.teeth.sun [rpm]=30": "expected bare numbers",
    }.items():
        assert run("sweep", file, "--vary", vary).gives_nothing("--vary:1:", said), vary


def test_who_asks_for_planets_gets_the_same_in_all_else(case: vstatics.Transmission) -> None:
    """Then each case is calculated alone, else all at once."""
    plain = case.replace(gears=[gear._replace(torques={}) for gear in case.gears])
    vary = ["P1.teeth.sun=20:40:21", "pair.teeth.first=19,20"]
    out = "ratio, efficiency, lossy_torques[B]"
    [at_once] = vstatics.sweep(plain, vary, out=out)
    [alone] = vstatics.sweep(plain, vary, out=f"{out}, planet_speeds[P1]")
    np.testing.assert_allclose(at_once.columns, alone.columns[:, : at_once.columns.shape[1]], 1e-11)
    assert at_once.status.tolist() == alone.status.tolist()


def test_teeth_and_a_number_of_a_mechanism_vary_together(case: vstatics.Transmission) -> None:
    """Eta = (1 + eta_0 R/S)/(1 + R/S) with a given eta_0, times .98 of the pair behind."""
    out, vary = "efficiency[one]/.98", ["P1.teeth.sun=33,27", "P1.efficiency=.9,.95"]
    without = case.replace(gears=[case.gears[0]._replace(torques={})])
    [chunk] = vstatics.sweep(without, vary, out=out)
    for (sun, own), found in zip(chunk.values, chunk.columns[:, 0], strict=True):
        assert found == pytest.approx((1 + own * 75 / sun) / (1 + 75 / sun))


@pytest.mark.parametrize("by", [None, "gear"])
def test_a_column_has_the_ratio_that_the_teeth_of_its_row_give(
    case: vstatics.Transmission, by: Literal["gear"] | None
) -> None:
    """-R/S of a set; a condition sees it, too. Friction gives the efficiency of a mesh."""
    vary = ["P1.teeth.sun=25:40:16", "P1.teeth.ring=74,75"]
    out = "P1.ratio, 2*P1.ratio, P1.efficiency"
    [chunk] = vstatics.sweep(case, vary, out=out, by=by, where="P1.ratio < -2.2")
    expected = [-ring / sun for sun, ring in chunk.values.tolist()]
    assert len(expected) > 10
    assert max(expected) < -2.2
    np.testing.assert_allclose(chunk.columns[:, 0], expected, 1e-15)
    np.testing.assert_allclose(chunk.columns[:, 1], chunk.columns[:, 0] * 2, 1e-15)
    [chunk] = vstatics.sweep(case, ["mesh_efficiency.friction=.03,.06,.12"], out="P1.efficiency")
    frictions = chunk.values[:, 0].tolist()
    alone = [changed((("mesh_efficiency", "friction"), one)) for one in frictions]
    found = [one.mechanisms[0].efficiency for one in alone]
    assert found[0] > found[1] > found[2]
    np.testing.assert_allclose(chunk.columns[:, 0], found, 1e-15)


def test_a_ratio_and_the_teeth_that_give_it_are_one_number(case: vstatics.Transmission) -> None:
    with pytest.raises(vstatics.ReadError, match=r"P1\.ratio is varied together with teeth"):
        vstatics.sweep(case, ["P1.ratio=-3,-2", "P1.teeth.sun=25,30"])
    [chunk] = vstatics.sweep(case, ["pair.ratio=-2,-3", "P1.teeth.sun=25,30"], out="P1.ratio")
    assert chunk.columns[:, 0].tolist() == [-3.0, -2.5, -3.0, -2.5]


def test_a_ratio_that_no_teeth_give_is_none(case: vstatics.Transmission, file: Path) -> None:
    """A ring is larger than its sun, and wheels beside one another turn in opposite ways.

    Teeth that would give it are an error of a case; a mechanism given as such may have any.
    """
    numbers = [-2.5, -1.0, -0.5, 0.5, 2.5]
    for path, possible in (("P1.ratio", 1), ("pair.ratio", 3)):
        [chunk] = vstatics.sweep(case, {path: numbers}, out="ratio")
        expected = [*["ok"] * possible, *["invalid"] * (5 - possible)]
        assert [STATUS[code] for code in chunk.status] == expected
    with pytest.raises(vstatics.CaseError, match=r"read -0\.5 in variant 1, expected .* below -1"):
        solve(case, vary={"P1.ratio": [-2.5, -0.5]})
    with pytest.raises(vstatics.ReadError, match="more teeth than the 75 of sun"):
        changed((("elements", "P1", "teeth", "sun"), 75))
    assert solve(case.replace(drawing=None), vary={"P1.ratio": numbers}).ratio.shape == (5, 2)
    said = run("sweep", file, "--vary", "P1.ratio=.5")
    assert said.fails("P1.ratio: read 0.5 in variant 0, expected a finite ratio below -1")


def test_an_efficiency_that_follows_a_law_is_no_column() -> None:
    law = {"over": "torque", "points": [[0, 0.95], [40, 0.985]]}
    document = json.loads(json.dumps(CASE))
    document["elements"]["P1"]["efficiency"] = law
    with pytest.raises(vstatics.ReadError, match=r"P1\.efficiency.*it is not a number"):
        vstatics.sweep(from_dict(document), ["load.torque=50 N*m,60 N*m"], out="P1.efficiency")
