"""YAML file of a clutch dump: `J1` to `J5`, `E`, `M_C0`, `M_phi` and `omega1`."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.core.errors import CaseError, ReadError
from vstatics.core.model.shape import ByKey, KeyShape, Leaf, LeafKind
from vstatics.core.readers.kinds import kind_of
from vstatics.core.readers.named.nodes import Mapping, Spots, decode
from vstatics.core.readers.named.reader import read_document
from vstatics.torsion.clutch.dumped import DumpTorque, dump
from vstatics.torsion.clutch.given import UNBOUNDED, Dump, dump_problems


def _key(name: str, kind: LeafKind, description: str) -> KeyShape:
    return KeyShape(name, Leaf(kind, infinite=name in UNBOUNDED), description, required=True)


DUMP = ByKey(
    "Clutch dump",
    "A clutch that is dumped, on one shaft; in SI or in any one system of relative units.",
    (
        _key("J1", "inertia", "Inertia of the engine and of the driving parts of the clutch."),
        _key("J2", "inertia", "Inertia of the driven disc."),
        _key("J3", "inertia", "Inertia of the transmission."),
        _key("J4", "inertia", "Inertia of the wheels; `.inf` where they are clamped."),
        _key("J5", "inertia", "Inertia of the vehicle; `.inf` where it is held."),
        _key("E", "compliance", "Compliance between J3 and J4."),
        _key("M_C0", "si_torque", "Torque at which the clutch breaks away."),
        _key("M_phi", "si_torque", "Torque at which the tyres lose their grip; `.inf`: never."),
        _key("omega1", "si_speed", "Speed of the engine before the dump."),
    ),
    make=Dump,
)
EXPECTED = (
    "a clutch that is dumped: a mapping with `J1` to `J5`, `E`, `M_C0`, `M_phi`, `omega1`, or a "
    "case with `dump`"
)


class DumpFile(NamedTuple):
    """Clutch dump read from a file."""

    given: Dump
    spots: Spots
    """Positions of the numbers in the file."""

    def torque(self, rate: float | None = None) -> DumpTorque:
        """Calculate the largest torques; `rate` as in `dump`.

        Raises
        ------
        ReadError
            If the torques cannot be calculated, with the positions of the numbers.
        """
        try:
            return dump(self.given, rate)
        except CaseError as error:
            raise ReadError(map(self.spots.locate, error.problems)) from None


def is_of_case(data: bytes, file: str) -> bool:
    """Return whether a document is a case, not a file of numbers.

    Examples
    --------
    >>> is_of_case(b"{dump: {J1: [a]}, springs: {}}", "a.yaml"), is_of_case(b"J1: 1.9", "b.yaml")
    (True, False)
    """
    from vstatics.core.readers import format_of
    from vstatics.core.readers.named.yaml_nodes import yaml_tree  # import is slow

    file_format = format_of(file, data)
    if file_format in ("deck", "xlsx"):
        return True
    try:
        root = yaml_tree(decode(data, file, EXPECTED))
    except ReadError:
        return file_format == "json"
    keys = {key.text for key, _ in root.entries} if isinstance(root, Mapping) else set()
    numbers = {key.name for key in DUMP.keys}
    return keys.isdisjoint(numbers) and ("format" in keys or kind_of(root) == "case")


def read_dump(data: bytes, file: str) -> DumpFile:
    """Read the numbers of a clutch dump.

    Parameters
    ----------
    data : bytes
    file : str
        Name of the file, for messages.

    Raises
    ------
    ReadError
        If the file is not valid, with all problems and their positions.

    Examples
    --------
    >>> read = read_dump(b"{J1: 1.913, J2: 0.0619, J3: 0.0239, J4: 0.091, J5: 5.68, "
    ...                  b"E: 429e-5, M_C0: 532, M_phi: 335, omega1: 156}", "dump.yaml")
    >>> read.given.E, read.torque().case
    (0.00429, 'A3')
    """
    given, spots = read_document(data, file, DUMP, EXPECTED)
    if problems := list(dump_problems(given)):
        raise ReadError(map(spots.locate, problems))
    return DumpFile(given, spots)
