"""The version and build of this package, packages that only some outputs need: extras.

What is imported later: names of a package, functions of higher rooms.
"""

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
    "formula": "sympy",
    "plot": "matplotlib",
    "xlsx": "openpyxl",
    "boxes": "numba",
}
"""By extra: the package that it brings."""
_IN_ROOMS = {"damage": "torsion"}
"""By rooms without an extra of their own: the one that their commands name."""
BESIDES = {"boxes": ("networkx",), "plot": ("networkx",)}
"""Further packages of an extra."""


def later(
    package: str, modules: Mapping[str, str], find: Callable[[str], str] = lambda _: ""
) -> Callable[[str], Any]:
    """A `__getattr__` of a package, by which names are imported when somebody asks for them.

    Parameters
    ----------
    modules : mapping
        Of each name the module that has it.
    find : callable
        Returns the module of another name, or an empty text.

    Examples
    --------
    >>> later("shapes", {"sqrt": "math"})("sqrt")(9)
    3.0
    """

    def attribute(name: str) -> Any:
        if found := modules.get(name) or find(name):
            try:
                return getattr(module(found), name)
            except ImportError as error:
                raise needed(error, name, package) from None
        raise AttributeError(f"module {package!r} has no attribute {name!r}")

    return attribute


class AnyPicture(Protocol):
    """A `Picture`, of whose room those below know nothing."""

    @property
    def figure(self) -> Figure:
        """The figure of matplotlib."""

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it to a file: SVG, PNG or PDF by the suffix."""

    def _repr_svg_(self) -> str: ...


def higher(function: str, purpose: str = "") -> Any:
    """A function of a room above, by which a class has a method although its room knows none.

    Parameters
    ----------
    function : str
        Its name in the record of the core or of an annex.
    purpose : str
        Thing that needs the function, one of `PURPOSES`, for the message that its annex is not
        installed. Without it: the function.

    Raises
    ------
    CaseError
        If no installed annex has the function.

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
    return getattr(module(name), function)


@cache
def build(*holding: bytes) -> str:
    """A hash of all files of this package: two that calculate differently have two of them.

    It reads every file, so it is asked for only where builds meet: what `--resume` takes
    up, workers of a cluster, machine code that is kept.

    Parameters
    ----------
    *holding : bytes
        Only of the files in which one of these stands.

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
            with open(path, "rb") as file:  # noqa: PTH123
                content = file.read()
            if not holding or any(words in content for words in holding):
                label = os.path.relpath(path, top).replace(os.sep, "/")
                digest.update(f"{label} {len(content)}\n".encode() + content)
    return digest.hexdigest()[:12]


def missing(extra: str, purpose: str) -> str:
    """What to install for a purpose, or nothing where it is installed.

    >>> missing("formula", "the formula") in (
    ...     "", 'the formula needs the package sympy: '
    ...         'pip install "vstatics[formula]", or "vstatics[all]"')
    True
    """
    from importlib.util import find_spec

    for package in (EXTRAS[extra], *BESIDES.get(extra, ())):
        if find_spec(package) is None:
            return _needs(purpose, package, extra)
    return ""


def _needs(purpose: str, package: str, extra: str) -> str:
    needs = f'{purpose} needs the package {package}: pip install "vstatics[{extra}]"'
    return f'{needs}, or "vstatics[all]"'


def needed(error: ImportError, purpose: str, module: str) -> Exception:
    """What to raise for a package that is missing or can't be imported: E014 if it is an extra.

    Parameters
    ----------
    error : ImportError
    purpose : str
        What needs it.
    module : str
        Of that, whose room has the name of the extra where several bring the package.

    Examples
    --------
    >>> missed = ModuleNotFoundError("No module named 'scipy'", name="scipy")
    >>> print(needed(missed, "modes", "vstatics.torsion"))
    modes needs the package scipy: pip install "vstatics[torsion]", or "vstatics[all]" [E014]
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
    """Of which package an import fails although it is there; nothing where it is none."""
    if not isinstance(error, ImportError):
        return ""
    trace, packages = error.__traceback__, {*EXTRAS.values(), "networkx", "numpy", "yaml"}
    while trace is not None:
        package = str(trace.tb_frame.f_globals.get("__name__")).partition(".")[0]
        if package in packages:
            why = " ".join(f"{type(error).__name__}: {error}".split())
            return f"the package {package} is there, but can't be imported: {why}"
        trace = trace.tb_next
    return ""


def require(extra: str, purpose: str) -> None:
    """Make sure that the package of an extra is there before anything is calculated.

    Raises
    ------
    CaseError
        With the way to install it.
    """
    message = missing(extra, purpose)
    if message:
        raise CaseError("E014", message)
