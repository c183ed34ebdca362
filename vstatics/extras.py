"""The version of this package, and packages that only some outputs need: they are extras."""

from __future__ import annotations

from vstatics.errors import CaseError, Problem

__version__ = "0.1.0"

EXTRAS = {
    "pyarrow": "parquet",
    "distributed": "dask",
    "scipy": "sample",
    "pandas": "pandas",
    "sympy": "formula",
    "matplotlib": "plot",
}


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
