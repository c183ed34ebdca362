"""Names that formulas of a scenario can use: links, components, numbers, states and tables."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from vstatics.core.errors import Problem, quoted
from vstatics.core.model.empty import EMPTY
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.readers.expressions.evaluation import FUNCTIONS
from vstatics.core.readers.expressions.grammar import PYTHON
from vstatics.core.tables.names import NAME
from vstatics.simulation.scenario.formula import OF_EVENTS, OF_MOTION, OF_TORQUES, Vocabulary
from vstatics.simulation.scenario.formula_code import PI, VARIABLES

_TRUTH = ("on", "off", "yes", "no", "true", "false")
"""Names that YAML readers can interpret as true or false."""
_TAKEN = {*VARIABLES, *OF_MOTION, *OF_TORQUES, *OF_EVENTS, *FUNCTIONS, *PYTHON, PI}
_TAKEN |= {"and", "or", "not"}


def vocabulary(
    case: Transmission,
    *,
    numbers: Mapping[str, float] = EMPTY,
    values: Collection[str] = (),
    tables: Mapping[str, LookupTable] = EMPTY,
    converters: Collection[str] = (),
) -> Vocabulary:
    """Return the names that formulas of a scenario can use.

    Parameters
    ----------
    case : Transmission
    numbers : mapping of str to float
    values : collection of str
        Names of control states, and of numbers that sequences set.
    tables : mapping of str to LookupTable
    converters : collection of str
        Names of the converters of the scenario.

    Examples
    --------
    >>> from vstatics import ShiftElement
    >>> clutch = ShiftElement(1, 2, name="C")
    >>> words = vocabulary(Transmission(2, [clutch], [], [], inertias={1: 1.0}), values=["p"])
    >>> words.rows["slip"], words.rows["speed"]
    (('C',), ('1', '2'))
    """
    links = tuple(case.link_names)
    elements = tuple(element.name for element in case.shift_elements)
    springs = elastic_names(case)
    hot = tuple(element.name for element in case.shift_elements if element.heat_store is not None)
    rows = dict.fromkeys(("speed", "angle", "acceleration"), links)
    rows |= dict.fromkeys(("slip", *OF_EVENTS), elements)
    rows |= {"twist": springs, "temperature": hot, "torque": (*case.devices, *converters)}
    rows["power"] = (*links, *elements, *springs)
    return Vocabulary(rows, numbers, values, tables)


def elastic_names(case: Transmission) -> tuple[str, ...]:
    """Return the names of elastic components: shift elements, mechanisms and springs."""
    return (
        *(part.name for part in case.shift_elements if part.stiffness is not None),
        *(part.name for part in case.mechanisms if part.stiffness is not None),
        *(spring.name for spring in case.springs),
    )


def name_problems(key: str, names: Collection[str], before: Collection[str]) -> Iterator[Problem]:
    """Yield a problem for each name that formulas cannot use.

    Parameters
    ----------
    key : str
        Key of the scenario that declares the names.
    before : collection of str
        Names that are already in use.

    Examples
    --------
    >>> [str(problem) for problem in name_problems("numbers", ["t"], [])]
    ['numbers.t: `t` is a word of formulas, expected another name [E680]']
    """
    for name in names:
        path = (key, name)
        if name.lower() in _TRUTH:
            yield Problem(
                "E681", f"{quoted(name)} is true or false in YAML, expected another name", path
            )
        elif name in _TAKEN:
            yield Problem(
                "E680", f"{quoted(name)} is a word of formulas, expected another name", path
            )
        elif not NAME.fullmatch(name):
            yield Problem(
                "E682", f"read {quoted(name)}, expected a name of letters, digits and `_`", path
            )
        elif name in before:
            yield Problem(
                "E683",
                f"{quoted(name)} is already the name of something else, expected another name",
                path,
            )
