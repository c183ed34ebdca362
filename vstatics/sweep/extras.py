"""Packages that only some sweeps and pictures need, and that are not installed with this one."""

from __future__ import annotations

from vstatics.errors import CaseError, Problem

EXTRAS = {
    "pyarrow": "parquet",
    "distributed": "dask",
    "scipy": "sample",
    "pandas": "pandas",
    "matplotlib": "plot",
}


def require(package: str, purpose: str) -> None:
    """Make sure that a package is there before anything is calculated.

    Raises
    ------
    CaseError
        With the way to install it.
    """
    from importlib.util import find_spec

    if find_spec(package) is None:
        install = f'pip install "vstatics[{EXTRAS[package]}]"'
        raise CaseError([Problem(f"{purpose} needs the package {package}: {install}")])
