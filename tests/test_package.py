"""What one works with in Python and in a notebook: names at the top, how things show themselves."""

from __future__ import annotations

import ast
import io
import json
import math
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
import pytest

import vstatics
from tests.commands import CASES, MZKT
from tests.installed import ANNEXES, HERE, needs, skip_without
from tests.rejects import rejects
from vstatics import Gear, Load, Mechanism, ReadError, ShiftElement, Transmission

if TYPE_CHECKING:
    from vstatics import Motion

BOX = CASES / "simpson-th400.yaml"
anything: Any = vstatics
"""The package as it is to one who gives it what he likes."""

PAIR: dict[str, Any] = {
    "name": "pair",
    "links": ["in", "out"],
    "mechanisms": {"pair": {"first": "in", "second": "out", "ratio": -2.5}},
    "gears": {"drive": {}},
}


@needs(*ANNEXES)
def test_checkers_of_types_know_all_public_names() -> None:
    """They read a list that is written; the program asks the records of annexes."""
    tree = ast.parse(Path(vstatics.__file__).read_text("utf-8"))
    [written] = [
        ast.literal_eval(node.value)
        for node in ast.walk(tree)
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__"
    ]
    assert written == vstatics.__all__ == dir(vstatics)


@needs("sweep")
@pytest.mark.parametrize(
    "imports",
    [
        "import vstatics",
        "import vstatics.sweep.chunk",
        "from vstatics import sweep; import vstatics.sweep.chunk",
        "import vstatics.sweep.chunk; from vstatics import sweep",
        "from vstatics import *; import vstatics.sweep.chunk",
    ],
)
def test_sweep_is_the_function_whatever_is_imported_first(imports: str) -> None:
    code = f"{imports}; import sys, vstatics; from vstatics.sweep.chunk import Chunk as one; "
    code += "assert vstatics.sweep is sys.modules['vstatics.sweep'].sweep is not one; "
    code += "assert globals().get('sweep', vstatics.sweep) is vstatics.sweep is vstatics.sweep; "
    code += "assert vstatics.Chunk is one"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_the_package_starts_without_annexes_and_leaves_ctrl_c_alone() -> None:
    """Start-up time: see docs/architecture.md."""
    code = "import signal, sys, vstatics; print(signal.getsignal(2).__name__, *sys.modules)"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    handler, *names = said.stdout.split()
    assert handler == "default_int_handler"
    assert {"rich", "yaml"}.isdisjoint(names)
    rooms = {name.split(".")[1] for name in names if name.startswith("vstatics.")}
    assert rooms == {"core", "elements"}


# Reading


def test_a_case_comes_from_a_path_a_stream_a_text_or_plain_data() -> None:
    case = vstatics.load(MZKT)
    assert vstatics.load(str(MZKT)) == case
    with MZKT.open("rb") as stream:
        assert vstatics.load(stream) == case
    text = MZKT.read_text("utf-8")
    assert vstatics.load(io.StringIO(text)) == vstatics.loads(text) == case
    assert vstatics.loads(text.encode()) == case
    own = Transmission.from_dict(PAIR)
    assert own == vstatics.loads(str(PAIR).replace("'", '"'))
    assert own.gears[0].name == "drive"
    pair = {**PAIR["mechanisms"]["pair"], "ratio": np.float64(-2.5)}
    by_numpy = {**PAIR, "links": np.array(PAIR["links"]), "mechanisms": {"pair": pair}}
    assert Transmission.from_dict(by_numpy) == own


def test_faults_of_plain_data_are_reported_by_their_keys_without_a_place() -> None:
    mechanisms = {"pair": {"first": "in", "second": "out", "ratio": np.float64(math.inf)}}
    for changes, said in (
        ({"gears": {"drive": {"engaged": ["C"]}}}, "gears.drive.engaged[1]: read 'C', but"),
        ({"mechanisms": mechanisms}, "mechanisms.pair.ratio: read 'Infinity', expected a"),
    ):
        with pytest.raises(ReadError, match=f"^{re.escape(said)}"):
            Transmission.from_dict({**PAIR, **changes})


def test_a_text_reads_no_files_but_beside_a_name_with_a_folder(tmp_path: Path) -> None:
    drag = tmp_path / "drag.csv"
    drag.write_text("speed [rpm],torque [N*m]\n0,1\n", "utf-8")
    load = {"speed": "900 rpm", "torque": "40 N*m"}
    data = {**PAIR, "load": load, "drag": {"out": {"file": str(drag)}}}
    text = json.dumps(data)
    reads: list[Callable[[], Transmission]] = [
        lambda: vstatics.loads(text),
        lambda: vstatics.loads(text, name="upload.yaml"),
        lambda: vstatics.load(io.StringIO(text)),
        lambda: Transmission.from_dict(data),
    ]
    for read in reads:
        with pytest.raises(ReadError, match=r"drag.out: read `.*`, expected the points themselves"):
            read()
    beside = text.replace(str(drag), "drag.csv")
    case = tmp_path / "case.yaml"
    case.write_text(beside, "utf-8")
    with case.open(encoding="utf-8") as stream:
        assert (
            vstatics.loads(beside, name=str(case)) == vstatics.load(stream) == vstatics.load(case)
        )


LOADED = vstatics.load(BOX).replace(load=Load(2000, 300))
TORQUES = pd.DataFrame({"load.torque": [100.0, 300.0]})
IN_FEET = {"load.torque": ["100 lbf*ft"]}
NO_NUMBERS = "load.torque: read `['100 lbf*ft']`, expected numbers"
WRONG: dict[type[Exception], dict[str, Callable[[], object]]] = {
    TypeError: {
        "vstatics.load reads a file": lambda: anything.solve("box.yaml"),
        "load of int 3: expected a path or a stream": lambda: anything.load(3),
        "expected a text or bytes; vstatics.load reads a file": lambda: anything.loads(BOX),
        "expected a mapping, or `load` for a file": lambda: anything.Transmission.from_dict("x"),
        "is no plain data": lambda: Transmission.from_dict({"links": object()}),
        "expected Results; solve(case) gives them": lambda: anything.flows(LOADED),
        "no 'lod'; did you mean `load`?": lambda: LOADED.replace(lod=1),
    },
    vstatics.CaseError: {
        f"{NO_NUMBERS} [E701]": lambda: vstatics.solve(LOADED, vary=IN_FEET),
        "load: read str '2000 rpm', expected a Load, in rpm and N*m": (
            lambda: anything.load(BOX).replace(load="2000 rpm")
        ),
        "mechanisms: read 0, but the gear sets have 2": lambda: LOADED.replace(mechanisms=[]),
    },
    ValueError: {
        "equal lengths, read load.torque (3,), load.speed (2,)": (
            lambda: vstatics.solve(LOADED, vary={"load.torque": [1, 2, 3], "load.speed": [4, 5]})
        )
    },
    FileNotFoundError: {"tory: 'nowhere'": lambda: vstatics.save(LOADED, "nowhere/x.yaml")},
}


@pytest.mark.parametrize(
    ("kind", "said"), [(kind, said) for kind, calls in WRONG.items() for said in calls]
)
def test_wrong_arguments_are_rejected(kind: type[Exception], said: str) -> None:
    with rejects(kind, said):
        WRONG[kind][said]()


@needs("sweep")
def test_a_table_of_pandas_is_one_of_variants() -> None:
    [chunk] = anything.sweep(LOADED, variants=TORQUES, out="lossy_output_torque_Nm[1]")
    varied = anything.solve(LOADED, vary=TORQUES)
    assert (chunk.columns[:, 0] == varied["lossy_output_torque_Nm", "1"]).all()
    with rejects(TypeError, "expected a mapping or texts; a table of variants is `variants`"):
        anything.sweep(LOADED, TORQUES)
    with rejects(vstatics.CaseError, f"{NO_NUMBERS}; with a unit"):
        vstatics.sweep(LOADED, IN_FEET)


# A case with other parameters


def test_a_case_is_replaced_in_part() -> None:
    case = Transmission.from_dict(PAIR)
    assert case.replace(load=Load(2000, 300)).load == Load(2000, 300)
    assert case.replace(coast=True).replace(coast=None) == case
    with pytest.raises(vstatics.CaseError):
        case.replace(output=7)


def test_what_speaks_of_one_case_refuses_variants() -> None:
    case = vstatics.load(BOX)
    many: Any = vstatics.solve(case, efficiencies=np.full((2, len(case.mechanisms)), 0.98))
    drawing: list[Any] = [vstatics.plot] if "pictures" in HERE else []
    for function in (vstatics.summarize, vstatics.flows, *drawing):
        with pytest.raises(ValueError, match="expected one case"):
            function(many)


# How things show themselves


def test_a_case_and_its_results_are_shown_in_a_line() -> None:
    case = vstatics.load(BOX)
    results = vstatics.solve(case)
    counts = f"{case.own_links} links, 5 shift elements, 2 mechanisms, 4 gears"
    assert repr(case) == f"<Transmission 'GM Turbo-Hydramatic 400': {counts}>"
    assert repr(results) == "<Results of 'GM Turbo-Hydramatic 400': gears 1, 2, 3, R>"
    many = vstatics.solve(case, efficiencies=np.full((7, len(case.mechanisms)), 0.98))
    assert repr(many).endswith("gears 1, 2, 3, R, variants of shape (7,)>")


def test_a_notebook_shows_messages_on_gears_escaped() -> None:
    """Tables in place of all that the values hold; their names stay names."""
    case = vstatics.load(BOX)
    evil = case.replace(gears=[case.gears[0]._replace(name="<b>"), *case.gears[1:]])
    results = vstatics.solve(evil)
    summary, flow = vstatics.summarize(results), vstatics.flows(results)[0]
    explained = vstatics.explain_gear(results, 1)
    assert flow.shown is not None
    for one, number in (
        (summary, summary.design.spread),
        (flow, flow.shown.leaving),
        (explained, explained.ratio),
    ):
        shown = one._repr_html_()
        assert shown.count("<tr>") > 4
        assert f"{number:.3f}" in shown
        assert "<b>" not in shown
        assert len(repr(one)) < 200
        assert f"{number:.4g}" in repr(one)
    shown = results._repr_html_()
    assert shown.count("<tr>") == 1 + len(evil.gears)
    assert "2.481" in shown
    many = vstatics.solve(evil, efficiencies=np.full((2, len(evil.mechanisms)), 0.98))
    assert "<b>" not in f"{shown}{many._repr_html_()}"


@pytest.fixture(scope="module")
def stopped() -> Motion:
    """A wheel of 2 kg*m^2 at 10 rad/s, which a brake of 40 N*m stops in 0.5 s: 100 J."""
    skip_without("simulation")
    from vstatics.simulation import Capacity, Scenario, Start, constant

    case = Transmission(
        1, [ShiftElement(1, name="<b>")], [], [], inertias={1: 2.0}, link_names=["<i>"]
    )
    brake = {1: Capacity(constant(40.0))}
    return vstatics.simulate(Scenario(case, 1.0, Start(speeds={1: 10.0}), brake))


def test_a_notebook_shows_what_happened_in_a_run_escaped(stopped: Motion) -> None:
    shown = stopped._repr_html_()
    cells = re.findall(r"<t[dh][^>]*>([^<]*)</t[dh]>", shown)
    event = cells.index("0.500000000")
    assert cells[event : event + 3] == ["0.500000000", "&lt;b&gt;", "locks"]
    assert cells[cells.index("heat") + 1] == "100.000"
    assert not re.search("<[bi]>", shown)


@needs("torsion")
def test_a_notebook_shows_frequencies_of_gears_and_shapes_of_one() -> None:
    """Two inertias of 2 kg*m^2 on 100 N*m/rad: omega^2 = 100/2 + 100/2."""
    shaft = vstatics.Spring({1: 1, 2: -1}, stiffness=100.0, name="<b>")
    gears = [Gear(name="low"), Gear(name="<i>")]
    case = Transmission(2, [], [], gears, springs=[shaft], inertias={1: 2.0, 2: 2.0})
    found = vstatics.torsion.modes(case)
    both, one = found._repr_html_(), found[0]._repr_html_()
    assert both.count(">10.000<") == 2
    assert "amplitudes of links" in one
    assert "amplitudes of links" not in both
    assert not re.search("<[bi]>", both + one)


def test_results_and_runs_have_their_pictures(stopped: Motion) -> None:
    """Those of `plot`, to the byte."""
    pytest.importorskip("matplotlib")
    results = vstatics.solve(vstatics.load(BOX))
    lever = vstatics.plot(results, "lever", gear="R")._repr_svg_()
    assert results.plot("lever", gear="R")._repr_svg_() == lever
    own = vstatics.solve(stopped.case)  # type: ignore[arg-type]
    run = vstatics.plot(own, "shift", motion=stopped, dark=True)._repr_svg_()
    assert stopped.plot(dark=True)._repr_svg_() == run
    with pytest.raises(ValueError, match="'lever' is not a picture of a run"):
        stopped.plot("lever")


@needs("pictures", "torsion", "simulation")
def test_a_picture_is_shown_as_svg_and_saved_by_its_suffix(tmp_path: Path) -> None:
    """What it does not show is refused at once."""
    pytest.importorskip("matplotlib")
    results = vstatics.solve(vstatics.load(BOX))
    picture = vstatics.plot(results, "lever", gear="R")
    assert picture._repr_svg_().lstrip().startswith("<?xml")
    assert repr(picture).startswith("<Picture lever of <Results of")
    picture.save(tmp_path / "lever.PNG")
    assert (tmp_path / "lever.PNG").read_bytes().startswith(b"\x89PNG")
    with rejects(ValueError, "expected a suffix of .svg, .png, .pdf"):
        picture.save(tmp_path / "lever.gif")
    wrong: tuple[tuple[str, dict[str, Any], str], ...] = (
        ("levre", {}, "did you mean `lever`"),
        ("lever", {"gear": "X"}, "no gear 'X'"),
        ("lever", {"wheels": True}, "only stick diagrams show teeth"),
        ("plan", {"merge": True}, "`merge` is not for it, only levers can be merged"),
        ("shift", {}, "expected motion=vstatics.simulate(scenario)"),
        ("campbell", {"at": "in"}, "only a response is that of a link"),
        ("campbell", {"orders": [0]}, "read orders [0], expected numbers above 0"),
        ("campbell", {"speed": (5, 5)}, "expected a speed from 0 on, and a higher speed"),
    )
    for kind, options, said in wrong:
        with rejects(ValueError, said):
            results.plot(kind, **options)


@needs("sweep")
def test_a_picture_of_a_sweep_refuses_columns_at_once() -> None:
    pytest.importorskip("matplotlib")
    case = Transmission(2, [], [Mechanism(1, 2, 0, -2.5, name="P1")], [Gear()])
    made = vstatics.sweep(case, {"P1.ratio": [-2, -3]}, out="ratio[1]")
    for kind, options, said in (
        ("curves", {"z": "ratio[1]"}, "`z` is not for it; it takes `x`, `y` and `by`"),
        ("map", {"z": "ratio[2]"}, "no column `ratio[2]`; did you mean `ratio[1]`?"),
        ("curves", {"by": "gear"}, "no column `gear`"),
    ):
        with rejects((ValueError, vstatics.CaseError), said):
            made.plot(kind, **options)


@needs("page")
@pytest.mark.usefixtures("without_pictures")
def test_a_report_is_written_whole(tmp_path: Path) -> None:
    path = tmp_path / "box.html"
    vstatics.write_report(vstatics.solve(vstatics.load(MZKT)), path)
    assert path.read_text("utf-8").startswith("<!DOCTYPE html>")
    assert list(tmp_path.iterdir()) == [path]
    with pytest.raises(ValueError, match="the page is HTML"):
        vstatics.write_report(vstatics.solve(vstatics.load(MZKT)), tmp_path / "box.pdf")


# Results by names


@pytest.fixture(scope="module")
def differential() -> vstatics.Results:
    """Ring held: the carrier turns at 1/3.5."""
    return vstatics.solve(
        Transmission(
            3,
            [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
            [Mechanism(1, 2, 3, -2.5, 0.96, name="set")],
            [Gear([1], name="direct"), Gear([2], name="low")],
            link_names=["sun", "ring", "carrier"],
        )
    )


def test_an_array_its_row_and_its_number_have_names(differential: Any) -> None:
    results = differential
    assert results["ratio"].tolist() == results.to_dataframe()["ratio"].tolist() == [1, 3.5]
    assert results["ratio", "low"] == results["ratio", 2] == 3.5
    assert results["AMLG", "Mx", "low"] == results["Mx", "low"] == results.gear("low").ratio == 3.5
    assert results["AJK"].shape == (3, 3)
    carrier = results["speeds", "carrier"].tolist()
    assert carrier == pytest.approx([1, 1 / 3.5])
    for number in (3, "#3"):
        assert results["speeds", number].tolist() == carrier
    assert results["speeds", "ring", :].tolist() == results["speeds", "ring"].tolist()
    assert results["W", "carrier", "low"] == carrier[1]
    assert results.to_dataframe().loc["low", ("speeds", "carrier")] == carrier[1]
    low = results["speeds", :, "low"].tolist()
    assert low == results["speeds", ":", 2].tolist() == results.speeds[1].tolist()
    with rejects(ValueError, "no gear 'lo'; did you mean `low`?"):
        results.gear("lo")


def test_another_name_is_reported_with_the_nearest(differential: Any) -> None:
    for key, said in {
        "spees": "there is no table `spees`; did you mean `speeds`?",
        ("speeds", "crrier"): "did you mean `carrier`?",
        ("ratio", "lwo"): "no gear 'lwo'; did you mean `low`?",
        ("ratio", "low", "sun"): "expected no more than (table, gear)",
        ("AJK", "sun"): "expected no more than its name",
    }.items():
        with rejects(ValueError, said):
            differential[key]


def test_what_does_not_exist_is_nan_as_in_a_file() -> None:
    """A neutral gear is not asked whether it is locked."""
    case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1]), Gear()])
    results: Any = vstatics.solve(case)
    assert results["locked"][0] == 0
    assert np.isnan(results["locked"][1])


def test_names_of_variants_leave_their_axes(differential: Any) -> None:
    many: Any = vstatics.solve(differential.case, ratios=[[-2.0], [-3.0]])
    assert many["ratio", "low"].tolist() == [3, 4]
    assert many["speeds", "carrier"].shape == (2, 2)
