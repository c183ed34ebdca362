"""JavaScript and style sheet of a page with an interactive run."""

from __future__ import annotations

from importlib.resources import files

from vstatics.core.tables.html import Markup


def _resource(name: str) -> Markup:
    return Markup((files(__package__) / name).read_text(encoding="utf-8"))


LICENCE = _resource("uPlot-LICENSE.txt")
SCRIPTS = (
    Markup(f"/*!\n{LICENCE.strip()}\n*/\n{_resource('uPlot.iife.min.js').strip()}"),
    _resource("panels.js"),
    _resource("run.js"),
)
"""Plotting library uPlot with its licence, then the scripts of a run."""
STYLE = Markup(f"{_resource('uPlot.min.css').strip()}\n{_resource('run.css')}")
