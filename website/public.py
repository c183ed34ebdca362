"""Reference of the public names in Python, from their docstrings."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from importlib import import_module
from importlib.util import find_spec

from website.page import Page

_TITLES = {
    "vstatics": "The calculation",
    "vstatics.core.elements": "Teeth and drawn elements",
    "vstatics.torsion": "Torsion",
    "vstatics.simulation": "Motion",
    "vstatics.synthesis": "Synthesis",
}
MODULES = {name: title for name, title in _TITLES.items() if find_spec(name)}
"""Titles of the installed public modules."""


def pages() -> Iterator[Page]:
    """Yield a page for each public module, in reStructuredText."""
    for module, title in MODULES.items():
        heading = f"{title}: {module}"
        lines = [heading, "=" * len(heading), ""]
        lines += [f".. automodule:: {module}", "   :no-members:", ""]
        for name in names(module):
            value = getattr(import_module(module), name)
            lines += [f".. {_directive(value)}:: {module}.{name}", ""]
        yield Page("api", f"api/{module}", "\n".join(lines), ".rst")


def names(module: str) -> list[str]:
    """Return the public names of a module, without those that `vstatics` also exports.

    >>> "solve" in names("vstatics"), "transmission" in names("vstatics.core.elements")
    (True, False)
    """
    own = list(import_module(module).__all__)
    if module == "vstatics":
        return [name for name in own if name != "__version__"]
    first = import_module("vstatics").__all__
    return [name for name in own if name not in first]


def _directive(value: object) -> str:
    if inspect.isclass(value):
        return "autoexception" if issubclass(value, Exception) else "autoclass"
    return "autofunction" if callable(value) else "autodata"
