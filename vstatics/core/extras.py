"""Version and build of this package, optional dependencies (extras), and imports on demand."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any, Protocol

from vstatics.core.annexes import PURPOSES, module, module_of_method, not_installed
from vstatics.core.errors import CaseError
from vstatics.core.record import CORE

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__version__ = "0.1.0"

EXTRAS = {
    "parquet": "pyarrow",
    "dask": "distributed",
    "sample": "scipy",
    "torsion": "scipy",
    "simulation": "scipy",
    "pandas": "pandas",
    "xarray": "xarray",
    "formula": "python-flint",
    "plot": "matplotlib",
    "xlsx": "openpyxl",
    "boxes": "numba",
}
"""Main package that each extra (group of optional dependencies) installs."""
_IN_ROOMS = {"damage": "torsion"}
"""Extra for each subpackage that does not have the name of its extra."""
BESIDES = {"boxes": ("networkx",), "plot": ("networkx",)}
"""Further packages that some extras install."""
_IMPORTED_AS = {"python-flint": "flint"}
"""Module of packages whose names differ from it."""

SLOWER_WITHOUT = {"numba"}
"""Packages whose absence only makes an extra slower."""


def later(
    package: str, modules: Mapping[str, str], find: Callable[[str], str] = lambda _: ""
) -> Callable[[str], Any]:
    """Return a function `__getattr__` for a package, which imports names on first use.

    Parameters
    ----------
    package : str
        Name of the package, for messages.
    modules : mapping
        Modules that define the names.
    find : callable
        Function that returns the module of any other name; empty if unknown.

    Examples
    --------
    >>> later("shapes", {"sqrt": "math"})("sqrt")(9)
    3.0
    """

    def attribute(name: str) -> Any:
        if defining := modules.get(name) or find(name):
            try:
                return getattr(module(defining), name)
            except ImportError as error:
                raise needed(error, name, package) from None
        raise AttributeError(f"module {package!r} has no attribute {name!r}")

    return attribute


class AnyPicture(Protocol):
    """Interface of a picture for the core, which must not import the annex of pictures."""

    @property
    def figure(self) -> Figure:
        """Figure of matplotlib."""

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the picture to a file: SVG, PNG or PDF, depending on the suffix."""

    def _repr_svg_(self) -> str: ...


def higher(function: str, purpose: str = "") -> Any:
    """Return a function of a higher package for a method of a lower package.

    Parameters
    ----------
    function : str
        Name of the function in the record of the core or of an annex.
    purpose : str
        Feature that needs the function, a key of `PURPOSES`, for the message about a missing annex.
        Default: the name of the function.

    Raises
    ------
    CaseError
        If no installed annex has the function, or a package that it imports is missing.

    Examples
    --------
    >>> import vstatics
    >>> higher("to_dataframe").__module__
    'vstatics.core.tables.dataframe'
    """
    name = CORE.methods.get(function) or module_of_method(function)
    if not name:
        what = purpose or function
        raise CaseError("E014", not_installed(what, PURPOSES[what]))
    try:
        return getattr(module(name), function)
    except ImportError as error:
        raise needed(error, purpose or function, name) from None


@cache
def build(*holding: bytes) -> str:
    """Return a hash of all source files of the package, which identifies the build.

    Builds with equal hashes calculate equal results. The hash takes time, so it is used only if
    builds could be mixed: for `--resume`, workers of a cluster and cached machine code.

    Parameters
    ----------
    *holding : bytes
        Texts that select files. Only files that contain at least one of these texts are hashed.

    Examples
    --------
    >>> len(build())
    12
    """
    from hashlib import sha256

    digest = sha256()
    top = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))  # noqa: PTH100, PTH120
    for folder, inner, names in os.walk(top):
        inner[:] = sorted(name for name in inner if name != "__pycache__")
        for name in sorted(name for name in names if not name.startswith(".")):
            path = os.path.join(folder, name)  # noqa: PTH118
            with open(path, "rb", buffering=0) as file:  # noqa: PTH123
                content = file.read()
            if not holding or any(words in content for words in holding):
                label = path[len(top) + 1 :].replace(os.sep, "/")
                digest.update(f"{label} {len(content)}\n".encode() + content)
    return digest.hexdigest()[:12]


def missing(extra: str, purpose: str) -> str:
    """Return the message that the package for a purpose is missing; empty if it is installed.

    >>> missing("formula", "the formula") in (
    ...     "", 'the formula needs the package python-flint: '
    ...         'pip install ".[formula]" in the source folder, or pip install python-flint')
    True
    """
    from importlib.util import find_spec

    for package in (EXTRAS[extra], *BESIDES.get(extra, ())):
        if package not in SLOWER_WITHOUT and find_spec(_IMPORTED_AS.get(package, package)) is None:
            return _needs(purpose, package, extra)
    return ""


def _needs(purpose: str, package: str, extra: str) -> str:
    packages = " ".join((EXTRAS[extra], *BESIDES.get(extra, ())))
    in_source = f'pip install ".[{extra}]" in the source folder'
    return f"{purpose} needs the package {package}: {in_source}, or pip install {packages}"


def needed(error: ImportError, purpose: str, module: str) -> Exception:
    """Return the exception after a failed import: E014 for a package of an extra, else `error`.

    Parameters
    ----------
    error : ImportError
    purpose : str
        Feature that needs the package.
    module : str
        Module of the feature. Its path identifies the extra if several extras contain the package.

    Examples
    --------
    >>> missed = ModuleNotFoundError("No module named 'scipy'", name="scipy")
    >>> str(needed(missed, "modes", "vstatics.torsion")).partition(" in ")[0]
    'modes needs the package scipy: pip install ".[torsion]"'
    """
    if why := broken(error):
        return CaseError("E014", f"{purpose}: {why}")
    package = (error.name or "").partition(".")[0]
    extras = [extra for extra, brought in EXTRAS.items() if brought == package]
    rooms = [_IN_ROOMS.get(room, room) for room in module.split(".")]
    of_room = [extra for extra in extras if extra in rooms]
    if not extras or not isinstance(error, ModuleNotFoundError):
        return error
    return CaseError("E014", _needs(purpose, package, (of_room or extras)[0]))


def broken(error: BaseException) -> str:
    """Return the message that an installed package is broken; empty for other errors."""
    if not isinstance(error, ImportError):
        return ""
    trace, packages = error.__traceback__, {*EXTRAS.values(), "networkx", "numpy", "yaml"}
    while trace is not None:
        package = str(trace.tb_frame.f_globals.get("__name__")).partition(".")[0]
        if package in packages:
            why = " ".join(f"{type(error).__name__}: {error}".split())
            return f"the package {package} is installed, but cannot be imported: {why}"
        trace = trace.tb_next
    return ""


def require(extra: str, purpose: str) -> None:
    """Check that the packages of an extra are installed, before a calculation begins.

    Raises
    ------
    CaseError
        If a package is missing; the message contains the command to install it.
    """
    message = missing(extra, purpose)
    if message:
        raise CaseError("E014", message)
