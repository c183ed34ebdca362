"""Whoever gives a public function something else is told what it takes, by that function."""

import inspect
from collections.abc import Callable
from importlib import import_module
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import vstatics
from tests.commands import CASES
from tests.installed import HERE, skip_without
from vstatics import CaseError
from vstatics.core import elements
from vstatics.core.arguments import naming

pytestmark = pytest.mark.usefixtures("folder")

ANNEXES: dict[str, Any] = {
    name: import_module(f"vstatics.{name}")
    for name in ("torsion", "simulation", "synthesis")
    if name in HERE
}
torsion: Any = ANNEXES.get("torsion")
simulation: Any = ANNEXES.get("simulation")
synthesis: Any = ANNEXES.get("synthesis")
ROOMS: tuple[Any, ...] = (vstatics, elements, *ANNEXES.values())
FUNCTIONS: dict[str, Any] = {
    name: function
    for room in ROOMS
    for name in room.__all__
    if inspect.isfunction(function := getattr(room, name))
}
CASE = vstatics.load(CASES / "simpson.yaml")
RESULTS = vstatics.solve(CASE)
WRONG = {
    "nothing": None,
    "text": "x",
    "path": Path("nowhere.yaml"),
    "number": 4,
    "half": 0.5,
    "mapping": {},
    "numbers": (2, 4, 2),
    "rows": [None],
    "bytes": b"x",
    "thing": object(),
    "results": RESULTS,
    "case": CASE,
    "class": vstatics.Transmission,
    "array": np.ones(3),
}


def test_no_fault_of_python_leaves_a_function() -> None:
    for (name, function), wrong in product(FUNCTIONS.items(), WRONG):
        try:
            function(WRONG[wrong])
        except (vstatics.VstaticsError, OSError, ValueError):
            continue
        except TypeError as error:  # for which it said what it takes, or lacks what else it needs
            said = str(error)
            assert "expected" in said or "missing" in said, (name, wrong)


def test_every_argument_of_every_function_is_of_a_type() -> None:
    """Before anything is done: what else the function needs is not there."""
    for name, function in FUNCTIONS.items():
        if name == "plot" and "simulation" not in HERE:
            continue
        parameters = inspect.signature(function).parameters.values()
        first, *others = (one.name for one in parameters if one.kind is not one.VAR_KEYWORD)
        with pytest.raises(TypeError, match=rf"^{name} of <object .*expected"):
            function(object())
        for argument in others:
            with pytest.raises(TypeError, match=rf"^{name}: `{argument}` is <object .*expected"):
                function(**{argument: object()})
        if first != "drawing":  # whose function hands others on
            with pytest.raises(TypeError, match=rf"^{name}: there is no argument `nix`; there"):
                function(nix=1)


CALLS: list[tuple[str, type[Exception], Callable[[], Any], str]] = [
    ("sweep", TypeError, lambda: vstatics.sweep("box"),  # type: ignore[arg-type]
     "sweep of str 'box': expected a Transmission or a Varied"),
    ("simulation", TypeError, lambda: vstatics.simulate(CASE),  # type: ignore[arg-type]
     "expected a Scenario; vstatics.load_scenario reads"),
    ("torsion", TypeError, lambda: torsion.modes("box.yaml"), "'box.yaml': expected a Trans"),
    ("torsion", TypeError, lambda: torsion.modes(CASE, "12"), "of a whole number or a text"),
    ("vehicle", TypeError, lambda: vstatics.cycle("x", "y"),  # type: ignore[arg-type]
     "a Transmission; vstatics.load reads a file"),
    ("synthesis", TypeError, lambda: synthesis.find_boxes((2, 4, 2)), "expected a BoxSearch"),
    ("", TypeError, lambda: vstatics.save(RESULTS, "x.yaml"),  # type: ignore[arg-type]
     "a Transmission; its `case` is one"),
    ("", TypeError, lambda: vstatics.check(CASE),  # type: ignore[arg-type]
     "check of <Transmission .*: expected a path"),
    ("", TypeError, lambda: vstatics.solve(CASE, ratios={}),  # type: ignore[arg-type]
     "`ratios` is dict {}, expected an array"),
    ("", TypeError, lambda: vstatics.solve(CASE, vary=pd.DataFrame({0: [1.0]})),  # type: ignore[arg-type]
     "`vary` is DataFrame .*expected a mapping of a text to an array"),
    ("", TypeError, lambda: vstatics.summarize(RESULTS, at_mots=1),  # type: ignore[call-arg]
     "`at_mots`; did you mean `at_most`"),
    ("pictures", ValueError, lambda: RESULTS.plot(lang="fr"), "is str 'fr', expected 'en' or 'ru'"),
    ("", ValueError, lambda: vstatics.solve(CASE, idle="exakt"),  # type: ignore[arg-type]
     "did you mean `exact`"),
    ("simulation", ValueError, lambda: simulation.simulate(method="x"), "'events' or 'tarasik'"),
    ("sweep", CaseError, lambda: vstatics.sweep(CASE, where="ratio >"), "where:1:8: error"),
    ("sweep", CaseError, lambda: vstatics.sweep(CASE, {"P1.ratio": [-2]}, out="ratio[9]"),
     "out:1:7: error"),
    ("vehicle", CaseError, lambda: _cycle("time [s],speed [km/h]\n0,0\n1,9\n"),
     "one of `shifts`, `least_speed` and `strategy`"),
]  # fmt: skip
"""Annex, kind of the error, call, and what is said of it."""


@pytest.mark.parametrize(("annex", "kind", "call", "said"), CALLS)
def test_a_wrong_argument_is_reported(
    annex: str, kind: type[Exception], call: Callable[[], Any], said: str
) -> None:
    """As an argument of Python, not as an option."""
    skip_without(*filter(None, [annex]))
    with pytest.raises(kind, match=said) as caught:
        call()
    assert "--" not in str(caught.value)


def test_what_behaves_like_a_number_a_row_or_a_path_is_one() -> None:
    numbers: Any = np.array([20, 2]), np.float32(0.5), np.bool_(True)
    whole, half, yes = numbers
    assert vstatics.solve(CASE, coast=yes).case.coast
    assert vstatics.summarize(RESULTS, at_most=whole[0], reserve=half)
    skip_without("torsion")
    sprung = vstatics.load(CASES / "moskvich412.yaml")
    gears: Any = iter(["1", whole[1]])
    assert [one.name for one in torsion.modes(sprung, gears)] == ["1", "2"]


def _cycle(trace: str) -> None:
    Path("trace.csv").write_text(trace, "utf-8")
    vstatics.cycle(CASE.replace(vehicle=vstatics.Vehicle(1000, 0.3)), "trace.csv")


def test_an_option_that_is_no_argument_stays_one() -> None:
    @naming
    def told(by: str) -> None:
        raise CaseError("E432", f"expected --by, or -- and --bye {by}")

    with pytest.raises(CaseError, match="expected `by`, or -- and --bye x"):
        told("x")
