"""The cases and scenarios that come with the program, by their names.

An installed package carries them; in a working copy they stand beside it.

>>> example("zf-8hp70")
<Transmission 'ZF 8HP70': 8 links, 5 shift elements, 4 mechanisms, 9 gears>
>>> example("scenarios/tarasik-box").duration
6.0
>>> "simpson" in example()
True
"""

from __future__ import annotations

import os
from functools import cache
from typing import Any, NamedTuple, overload

from vstatics.core import readers
from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError, quoted
from vstatics.core.model.transmission import Transmission
from vstatics.core.suggestions import nearest


class ExampleFile(NamedTuple):
    """A file that comes with the program."""

    name: str
    """Of its path without suffix, by `/`."""
    path: str

    def data(self) -> bytes:
        """What it holds."""
        with open(self.path, "rb") as file:  # noqa: PTH123 (pathlib costs start-up time)
            return file.read()


@overload
def example() -> list[str]: ...


@overload
def example(name: str) -> Transmission | Any: ...


@refusing()
def example(name: str | None = None) -> list[str] | Transmission | Any:
    """A case or a scenario that comes with the program, or the names of all of them.

    Parameters
    ----------
    name : str, optional
        Such as ``zf-8hp70``, or ``scenarios/tarasik-box``.

    Returns
    -------
    Transmission or Scenario or list of str
        The names where none is given.

    Raises
    ------
    CaseError
        If there is none of this name; it tells the nearest.
    ReadError
        If it is a scenario, and simulation is not installed.

    Examples
    --------
    >>> example("differential").name
    'differential with clutch and brake'
    """
    if name is None:
        return [*example_files()]
    found = example_file(name)
    from vstatics.core.readers.kinds import document_function

    data = found.data()
    if load := document_function("load_document", data, found.path):
        return load(found.path)
    return readers.read(data, found.path).case


def example_file(name: str) -> ExampleFile:
    """The file of a name.

    Raises
    ------
    CaseError
        If there is none; it tells the nearest.

    Examples
    --------
    >>> example_file("simpson").data()[:5]
    b'name:'
    """
    found = example_files()
    if name not in found:
        message = f"there is no example {quoted(name)}: expected one of vstatics.example()"
        raise CaseError("E800", f"{message}{nearest(name, found)}")
    return found[name]


@cache
def example_files() -> dict[str, ExampleFile]:
    """All of them by name, cases before scenarios; of a deck and YAML of one name the latter.

    >>> example_files()["mzkt7922"].path.endswith("mzkt7922.yaml")
    True
    """
    package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))  # noqa: PTH100, PTH120
    inside = os.path.join(package, "cases")  # noqa: PTH118
    top = inside if os.path.isdir(inside) else os.path.join(package, os.pardir, "cases")  # noqa: PTH112, PTH118
    found = {}
    for folder, _, names in os.walk(top):
        for one in names:
            path = os.path.join(folder, one)  # noqa: PTH118
            name, suffix = os.path.splitext(os.path.relpath(path, top).replace(os.sep, "/"))  # noqa: PTH122
            if suffix == ".yaml" or (suffix == ".dat" and name not in found):
                found[name] = ExampleFile(name, path)
    return {name: found[name] for name in sorted(found, key=lambda one: (one.count("/"), one))}
