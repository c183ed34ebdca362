"""The version and build of this package, and packages that only some outputs need: extras."""

from __future__ import annotations

import os
from functools import cache

from vstatics.errors import CaseError, Problem

__version__ = "0.1.0"

EXTRAS = {
    "pyarrow": "parquet",
    "distributed": "dask",
    "scipy": "sample",
    "pandas": "pandas",
    "sympy": "formula",
    "matplotlib": "plot",
    "openpyxl": "xlsx",
}


@cache
def build() -> str:
    """A hash of all files of this package: two that calculate differently have two of them.

    It reads every file, so it is asked for only where builds meet: what `--resume` takes
    up, workers of a cluster.

    >>> len(build())
    12
    """
    from hashlib import sha256

    digest = sha256()
    top = os.path.dirname(os.path.abspath(__file__))  # noqa: PTH100, PTH120
    for folder, inner, names in os.walk(top):
        inner[:] = sorted(name for name in inner if name != "__pycache__")
        for name in sorted(name for name in names if not name.startswith(".")):
            path = os.path.join(folder, name)  # noqa: PTH118
            with open(path, "rb") as file:  # noqa: PTH123
                content = file.read()
            label = os.path.relpath(path, top).replace(os.sep, "/")
            digest.update(f"{label} {len(content)}\n".encode() + content)
    return digest.hexdigest()[:12]


def missing(package: str, purpose: str) -> str:
    """What to install for a purpose, or nothing where it is installed.

    >>> missing("sympy", "the formula") in (
    ...     "", 'the formula needs the package sympy: pip install "vstatics[formula]"')
    True
    """
    from importlib.util import find_spec

    if find_spec(package) is not None:
        return ""
    return f'{purpose} needs the package {package}: pip install "vstatics[{EXTRAS[package]}]"'


def require(package: str, purpose: str) -> None:
    """Make sure that a package is there before anything is calculated.

    Raises
    ------
    CaseError
        With the way to install it.
    """
    message = missing(package, purpose)
    if message:
        raise CaseError([Problem(message)])
