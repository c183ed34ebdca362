"""A duty cycle as a YAML file: `energy` or `time`, and a share for each gear."""

from __future__ import annotations

from typing import NamedTuple, get_args

from vstatics.errors import CaseError, ReadError
from vstatics.model.shape import ByKey, KeyShape, Shares
from vstatics.readers.named.nodes import Spots
from vstatics.readers.named.reader import read_document
from vstatics.statics.results import Results
from vstatics.summary.duty import Cycle, Duty, Kind, cycle

DUTY = ByKey(
    "Duty cycle",
    "Gears with their shares of energy or of time.",
    tuple(
        KeyShape(kind, Shares(), f"Share of the {kind} for each gear; of any sum.")
        for kind in get_args(Kind)
    ),
)
EXPECTED = "`energy` or `time` with a share for each gear"


class DutyFile(NamedTuple):
    """A duty cycle, and where its gears stand."""

    duty: Duty
    spots: Spots

    def of(self, results: Results) -> Cycle:
        """The cycle of a case.

        Raises
        ------
        ReadError
            As `cycle` does, with places.
        """
        try:
            return cycle(results, self.duty)
        except CaseError as error:
            problems = [one._replace(path=(self.duty.kind, *one.path)) for one in error.problems]
            raise ReadError([self.spots.locate(problem) for problem in problems]) from None


def read_duty(data: bytes, file: str) -> DutyFile:
    """Read a duty cycle.

    Parameters
    ----------
    data : bytes
    file : str
        Its name, for messages.

    Raises
    ------
    ReadError
        With every problem and its place.

    Examples
    --------
    >>> read_duty(b'energy: {"1": 1, "2": 3/2}', "duty.yaml").duty
    Duty(kind='energy', shares={'1': 1.0, '2': 1.5})
    """
    values, spots = read_document(data, file, DUTY, EXPECTED)
    if len(values) != 1:
        root = spots.place(())
        spots.found.stop(f"expected {EXPECTED}, and nothing else", root.line, root.column)
    [(kind, shares)] = values.items()
    return DutyFile(Duty(kind, shares), spots)
