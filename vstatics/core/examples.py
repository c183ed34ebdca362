"""Example cases and scenarios that come with the program, by name.

They are part of the installed package. In a working copy they are in the folder `cases`.

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
    """Example file that comes with the program."""

    name: str
    """Path below the folder `cases`, without suffix and with the separator `/`."""
    path: str

    def data(self) -> bytes:
        """Return the content of the file."""
        with open(self.path, "rb") as file:  # noqa: PTH123 (pathlib costs start-up time)
            return file.read()


@overload
def example() -> list[str]: ...


@overload
def example(name: str) -> Transmission | Any: ...


@refusing()
def example(name: str | None = None) -> list[str] | Transmission | Any:
    """Return an example case or scenario, or the names of all examples.

    Parameters
    ----------
    name : str, optional
        Name of an example, such as ``zf-8hp70`` or ``scenarios/tarasik-box``.

    Returns
    -------
    Transmission or Scenario or list of str
        The example; without `name` the names of all examples.

    Raises
    ------
    CaseError
        If the example does not exist. The message suggests the most similar name.
    ReadError
        If the example is a scenario and simulation is not installed.

    Examples
    --------
    >>> example("differential").name
    'differential with clutch and brake'
    """
    if name is None:
        return [*example_files()]
    file = example_file(name)
    from vstatics.core.readers.kinds import document_function

    data = file.data()
    if load := document_function("load_document", data, file.path):
        return load(file.path)
    return readers.read(data, file.path).case


def example_file(name: str) -> ExampleFile:
    """Return the file of an example.

    Raises
    ------
    CaseError
        If the example does not exist. The message suggests the most similar name.

    Examples
    --------
    >>> example_file("simpson").data()[:5]
    b'name:'
    """
    files = example_files()
    if name not in files:
        message = f"there is no example {quoted(name)}: expected one of vstatics.example()"
        raise CaseError("E800", f"{message}{nearest(name, files)}")
    return files[name]


@cache
def example_files() -> dict[str, ExampleFile]:
    """Return all examples by name, cases first. Of a YAML file and a deck, the YAML file is taken.

    >>> example_files()["mzkt7922"].path.endswith("mzkt7922.yaml")
    True
    """
    package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))  # noqa: PTH100, PTH120
    inside = os.path.join(package, "cases")  # noqa: PTH118
    top = inside if os.path.isdir(inside) else os.path.join(package, os.pardir, "cases")  # noqa: PTH112, PTH118
    files = {}
    for folder, _, names in os.walk(top):
        for file_name in names:
            path = os.path.join(folder, file_name)  # noqa: PTH118
            name, suffix = os.path.splitext(os.path.relpath(path, top).replace(os.sep, "/"))  # noqa: PTH122
            if suffix == ".yaml" or (suffix == ".dat" and name not in files):
                files[name] = ExampleFile(name, path)
    return {name: files[name] for name in sorted(files, key=lambda name: (name.count("/"), name))}
