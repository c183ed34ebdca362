"""Vehicle transmissions calculated from their kinematic scheme.

Speeds, planet and slip speeds, torques with and without losses, efficiency and
power flow in every gear, by the matrix method of Algin.

>>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
>>> case = Transmission(
...     links=3,
...     shift_elements=[ShiftElement(1, 2), ShiftElement(2, 0)],
...     mechanisms=[Mechanism(1, 2, 3, ratio=-2.5, efficiency=0.96)],
...     gears=[Gear([1], name="direct"), Gear([2], name="low")],
... )
>>> results = solve(case)
>>> results.ratio
array([1. , 3.5])
>>> results.efficiency.round(4)
array([1.    , 0.9714])
"""

from __future__ import annotations

import vstatics.interrupt  # noqa: F401 - first: it makes Ctrl-C safe in the others

# isort: split
from importlib import import_module
from typing import TYPE_CHECKING, Any

from vstatics.errors import CaseError, Place, Problem, ReadError, VstaticsError
from vstatics.extras import __version__
from vstatics.model.parts import Load
from vstatics.model.transmission import Gear, Mechanism, ShiftElement, Transmission
from vstatics.readers import from_dict, load, loads
from vstatics.statics.matrix import distribution_matrix
from vstatics.statics.result_fields import Message
from vstatics.statics.results import Results
from vstatics.statics.solve import solve
from vstatics.statics.state import GearState
from vstatics.sweep import sweep

if TYPE_CHECKING:
    import pandas as pd

    from vstatics.elements.drawing import Drawing
    from vstatics.elements.element import Element
    from vstatics.explain.explanation import explain_gear
    from vstatics.flow.power import flows
    from vstatics.pictures.drawn import plot
    from vstatics.report import write_report
    from vstatics.summary import summarize

__all__ = [
    "CaseError",
    "Drawing",
    "Element",
    "Gear",
    "GearState",
    "Load",
    "Mechanism",
    "Message",
    "Place",
    "Problem",
    "ReadError",
    "Results",
    "ShiftElement",
    "Transmission",
    "VstaticsError",
    "__version__",
    "distribution_matrix",
    "explain_gear",
    "flows",
    "load",
    "loads",
    "plot",
    "solve",
    "summarize",
    "sweep",
    "write_report",
]

_LATER = {
    "Drawing": "vstatics.elements.drawing",
    "Element": "vstatics.elements.element",
    "explain_gear": "vstatics.explain.explanation",
    "flows": "vstatics.flow.power",
    "plot": "vstatics.pictures.drawn",
    "summarize": "vstatics.summary",
    "write_report": "vstatics.report",
}
"""Names that are imported when somebody asks for them, as they cost start-up time."""


def _to_dataframe(results: Results) -> pd.DataFrame:
    """One row per variant and gear: see `vstatics.tables.dataframe.to_dataframe`."""
    from vstatics.tables.dataframe import to_dataframe

    return to_dataframe(results)


def _part(results: Results, key: Any) -> Any:
    """An array, or a part of it, by names: see `vstatics.tables.access.part`."""
    from vstatics.tables.access import part

    return part(results, key)


def _repr_html_(results: Results) -> str:
    """The table of the gears, for a notebook; of arrays of variants a line."""
    from html import escape

    if results.ratio.ndim != 1:
        return f"<code>{escape(repr(results))}</code>"
    from vstatics.summary.pretty import gears_grid
    from vstatics.tables.html import table

    return table(gears_grid(results))


# the rooms of results and of the model know nothing of how they are shown and read
Results.to_dataframe = _to_dataframe  # type: ignore[method-assign, assignment]
Results.__getitem__ = _part  # type: ignore[method-assign]
Results._repr_html_ = _repr_html_  # type: ignore[method-assign, assignment]
Transmission.from_dict = staticmethod(from_dict)  # type: ignore[method-assign]


def __getattr__(name: str) -> Any:
    if name in _LATER:
        return getattr(import_module(_LATER[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
