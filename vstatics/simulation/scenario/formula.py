"""Formulas of the time, of the speed and angle of a link, and of other quantities of the motion.

Sweep expressions (`readers.expressions`) have the same language, except ``^`` as another sign for
``**``, and functions of numbers such as ``sin``. A text becomes a tree of operations, and the tree
becomes a function (`formula_code`); `corners` finds its bends and jumps.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import lru_cache
from typing import Any, NamedTuple

from vstatics.core.errors import count_of, listed, quoted, spoken
from vstatics.core.model.empty import EMPTY
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.readers.expressions.evaluation import FUNCTIONS, expect_operands
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Applied, Language, Tree, parse
from vstatics.core.readers.expressions.operands import Constant, DottedName, TableName
from vstatics.core.suggestions import nearest
from vstatics.simulation.scenario.algebra import parts, slope, variables, with_names
from vstatics.simulation.scenario.corners import JUMPS, between, corners
from vstatics.simulation.scenario.crossings import crossings
from vstatics.simulation.scenario.formula_code import (
    PI,
    VARIABLES,
    Function,
    Seen,
    compiled,
    compiled_along,
    seen_in,
)
from vstatics.simulation.scenario.surfaces import JumpSurface, on_side, surfaces
from vstatics.simulation.scenario.table_call import UNREADABLE, TableCall

Quantity = Callable[[str, int], Constant | None]
"""Reader of numbers with units: function of text and position; None for other texts."""
SHORT_SPEED = "w"
"""Short name, in formulas, of the signed speed of the link on which the formula acts."""
OF_MOTION = ("speed", "angle", "slip", "twist", "temperature")
"""Functions of the motion that any formula can use, such as `slip('C')`."""
OF_TORQUES = ("acceleration", "torque", "power")
"""Functions of the motion that follow from torques, and so cannot determine a torque."""
OF_EVENTS = ("locks", "slips")
"""Events, which only conditions of sequence steps can use, such as `locks('C')`."""
MOST_NAMED = 6
"""Largest number of states and numbers of the scenario that a message names."""
_OF_NAMES = (*OF_MOTION, *OF_TORQUES, *OF_EVENTS)


class Vocabulary(NamedTuple):
    """Names that formulas of a scenario can use in addition to t, speed and angle."""

    rows: Mapping[str, Collection[str]] = EMPTY
    """Possible arguments of each function of the motion: names of shift elements for `slip`."""
    numbers: Mapping[str, float] = EMPTY
    values: Collection[str] = ()
    """Names of control states, and of numbers that sequences set."""
    tables: Mapping[str, LookupTable] = EMPTY

    def only(self, *words: str) -> Vocabulary:
        """Return the vocabulary restricted to some functions of the motion."""
        return self._replace(rows={word: self.rows[word] for word in words if word in self.rows})


NO_WORDS = Vocabulary()


class Formula(NamedTuple):
    """Formula of time t [s], and of speed (or w) [rad/s] and angle [rad] of a link.

    A formula can also read other quantities of the transmission, such as slips; see `seen`.

    Examples
    --------
    >>> formula = Formula("-1200*tanh(speed/0.05)")
    >>> formula.variables, formula.function(0.0, 10.0, 0.0)
    (frozenset({'speed'}), -1200.0)
    >>> Formula("2 + 84e-5*t^2").function(100.0, 0.0, 0.0)
    10.4
    """

    text: str
    tree: Tree | None = None
    """Tree that replaces the text of a derived formula, such as a derivative."""

    @property
    def seen(self) -> tuple[Seen, ...]:
        """Other quantities that the formula reads, in the order of arguments of `function`.

        >>> Formula("100*(slip('C') > 2) + p").seen
        (Seen(word='slip', of='C'), Seen(word='value', of='p'))
        """
        return _read(*self).seen

    @property
    def whole(self) -> Tree:
        """Tree of operations: the given `tree`, or the result of parsing the text."""
        return _read(*self).tree

    def knowing(self, numbers: Mapping[str, float]) -> Formula:
        """Return the formula with named numbers replaced by their values.

        >>> Formula("p*t").knowing({"p": 3.0}).function(2.0, 0.0, 0.0)
        6.0
        """
        if {quantity.of for quantity in self.seen if quantity.word == "value"}.isdisjoint(numbers):
            return self
        return self._replace(tree=_with_numbers(self.whole, numbers))

    def on_link(self, name: str) -> Formula:
        """Return the formula of a torque on a link, such as `out`, with `speed` for `speed('out')`.

        Only a formula that jumps at values of the speed or angle of the link changes. The motion
        can then stay at a jump.

        >>> Formula("9*(speed('out') < 3)").on_link("out").variables
        frozenset({'speed'})
        """
        own = Seen("speed", name), Seen("angle", name)
        in_jumps = {
            seen_in(part)
            for jump in parts(self.whole)
            if _jumps(jump)
            for part in parts(jump)
            if isinstance(part, TableName)
        }
        if in_jumps.isdisjoint(own):
            return self
        tree = with_names(
            self.whole, lambda part: part._replace(subscripts=()) if seen_in(part) in own else part
        )
        return self._replace(tree=tree)

    @property
    def elsewhere(self) -> Formula:
        """Formula with other names for the speed and angle of the link on which it acts.

        >>> Formula("speed + speed('out')").elsewhere.variables
        frozenset()
        """

        def renamed(part: TableName) -> TableName:
            is_of_link = part.name in ("speed", "angle") and not part.subscripts
            return part._replace(name=f"{part.name} elsewhere") if is_of_link else part

        return self._replace(tree=with_names(self.whole, renamed))

    @property
    def variables(self) -> frozenset[str]:
        """Variables in the formula: a subset of t, speed and angle.

        Raises
        ------
        ReadError
            If the text is not a formula.
        """
        return _read(*self).variables

    @property
    def constants(self) -> list[float]:
        """Numbers that the formula contains.

        Raises
        ------
        ReadError
            If the text is not a formula.
        """
        return [part.value for part in parts(self.whole) if isinstance(part, Constant)]

    @property
    def function(self) -> Function:
        """Function of t, speed, angle and `seen`; NaN or infinite where undefined.

        Raises
        ------
        ReadError
            If the text is not a formula.
        """
        return _read(*self).function

    def at(self, time: float) -> float:
        """Return the value at a time [s] for speed 0 and angle 0."""
        return self.function(time, 0.0, 0.0)

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times at which polynomials of time make the formula bend or jump [s].

        Raises
        ------
        ReadError
            If the text is not a formula.
        """
        return _read(*self).breaks

    def crossings(self, until: float) -> tuple[float, ...]:
        """Return times up to `until` [s], except `breaks`, at which the formula bends or jumps."""
        return crossings(self.whole, until)

    def jumps(self, name: str) -> tuple[float, ...]:
        """Return the values of `speed` or `angle` at which a comparison of polynomials jumps.

        >>> Formula("100*(abs(speed) < 300)").jumps("speed")
        (-300.0, 300.0)
        """
        return tuple(place for place, jumps in corners(self.whole, name).items() if jumps)

    def between(self, name: str, low: float, high: float) -> Formula:
        """Restrict the formula to the range between two neighbouring jumps along a variable."""
        return self._replace(tree=between(self.whole, name, low, high))

    @property
    def surfaces(self) -> dict[JumpSurface, str]:
        """Moving jumps, each with the side (`+` or `-`) to which the value at the jump belongs."""
        return surfaces(self.whole)

    def on_side(self, surface: JumpSurface, side: float) -> Formula:
        """Restrict the formula to the region above (`side` = 1) or below (-1) a moving jump."""
        return self._replace(tree=on_side(self.whole, surface, side))

    @property
    def slope(self) -> Formula:
        """Derivative with respect to t, if known; see `has_slope`."""
        return self._replace(tree=slope(self.whole))

    @property
    def has_slope(self) -> bool:
        """True if the derivative with respect to t is known."""
        return slope(self.whole) is not None

    @property
    def switches(self) -> bool:
        """True if the formula compares, or takes the sign of, something other than time."""
        return _read(*self).switches

    @property
    def along(self) -> Callable[..., Floats]:
        """Function for an array of times; all arguments of `function` can be arrays."""
        return _read(*self).along


def read_formula(
    source: Excerpt,
    names: Collection[str] = VARIABLES,
    words: Vocabulary = NO_WORDS,
    *,
    quantity: Quantity | None = None,
) -> Formula:
    """Read a formula.

    Parameters
    ----------
    source : Excerpt
    names : collection of str
        Allowed variables: some of t, speed and angle.
    words : Vocabulary
        Other allowed names.
    quantity : callable, optional
        Function that reads numbers with units.

    Raises
    ------
    ReadError
        If the text is not a formula, with the position of the fault.

    Examples
    --------
    >>> read_formula(Excerpt("3000*min(t/0.3, 1)", "FH"), ["t"])
    Formula(text='3000*min(t/0.3, 1)', tree=None)
    >>> read_formula(Excerpt("3000*speed", "FH"), ["t"])
    Traceback (most recent call last):
    ...
    vstatics.core.errors.ReadError: FH:1:6: error: read `speed`, expected a formula of t [E105]
    """
    tree = formula_tree(source, names, words, quantity=quantity)
    text = source.part.strip()
    known = _with_numbers(tree, words.numbers)
    calls = any(isinstance(part, Applied) and part.name in words.tables for part in parts(tree))
    return Formula(text, known if calls or quantity or known != _with_speed(tree) else None)


def formula_tree(
    source: Excerpt, names: Collection[str], words: Vocabulary, *, quantity: Quantity | None = None
) -> Tree:
    """Read the tree of a formula, which may contain allowed names only."""
    operands = f"a number, {spoken(names, 'or')}, or a function such as {', '.join(FUNCTIONS)}"
    language = Language((*FUNCTIONS, *words.tables), operands, "t", caret=True, of_names=_OF_NAMES)
    read = _parsed(source, language._replace(quantity=quantity) if quantity else language)
    tree: Tree = _with_tables(read, words.tables)
    for part in parts(tree):
        if isinstance(part, Applied):
            _check_operands(part, words, source)
        elif isinstance(part, DottedName):
            raise source.error(f"read {quoted(part.written)}, expected {operands}", part.at)
        elif isinstance(part, TableName):
            _check_name(part, names, words, source)
    is_speed = SHORT_SPEED not in (*words.numbers, *words.values)
    return _with_speed(tree) if is_speed else tree


_parsed = lru_cache(maxsize=256)(parse)
"""Trees are kept, because checks and variants parse the formulas of a scenario again."""


def _with_speed(tree: Tree) -> Tree:
    def whole_word(part: TableName) -> TableName:
        is_short = part.name == SHORT_SPEED and not part.subscripts
        return part._replace(name="speed") if is_short else part

    return with_names(tree, whole_word)


def _with_tables(tree: Any, tables: Mapping[str, LookupTable]) -> Any:
    if not isinstance(tree, Applied):
        return tree
    name = tree.name if tree.name not in tables else TableCall(tree.name, tables[tree.name])
    return tree._replace(
        name=name, operands=tuple(_with_tables(operand, tables) for operand in tree.operands)
    )


def _check_operands(part: Applied, words: Vocabulary, source: Excerpt) -> None:
    count, name = len(part.operands), part.name
    if name in words.tables:
        wanted = words.tables[name].variables
        if count != wanted and words.tables[name] is not UNREADABLE:
            many = ("none", "one", "two")
            read = f"{name} of {count_of('value', count)}"
            raise source.error(f"{read}, expected {many[wanted]}, as in `tables.{name}`", part.at)
    else:
        expect_operands(part, source, "t")


_SAME = {"time": "t", "omega": "speed", "e": "exp", "π": PI}
"""Names in formulas of other languages, with the names of formulas."""


def _check_name(
    part: TableName, names: Collection[str], words: Vocabulary, source: Excerpt
) -> None:
    name = part.name
    if name in words.rows and part.subscripts:
        _check_row(part, words.rows[name], source)
        return
    if name in (*OF_TORQUES, *OF_EVENTS) and part.subscripts:
        where = "`when`" if name in OF_EVENTS else "`rate` and `when`"
        message = f"read `{name}`, which only {where} can contain"
        raise source.error(message, part.at)
    short = [SHORT_SPEED] * ("speed" in names)
    known = (*names, *short, *words.numbers, *words.values)
    if name == PI or name in known:
        if part.subscripts:
            message = f"read `[` after `{name}`, expected {name} alone"
            message += ": that of the link itself" if name in ("speed", "angle") else ""
            raise source.error(message, part.at)
        return
    of_scenario = [*words.numbers, *words.values][:MOST_NAMED]
    expected = f"expected a formula of {spoken([*names, *of_scenario])}"
    word = "speed" if name == SHORT_SPEED else name
    rows = words.rows.get(word, ())
    if rows:
        expected += f"; name the link or component, as in {word}('{next(iter(rows))}')"
    others = (*known, *words.rows, *FUNCTIONS, PI)
    hint = "" if word in (*VARIABLES, *words.rows) else nearest(_SAME.get(name, name), others)
    raise source.error(f"read {quoted(name)}, {expected}{hint}", part.at)


def _check_row(part: TableName, rows: Collection[str], source: Excerpt) -> None:
    """Reject the name of an unknown link or component, as in `slip('X')`."""
    row, *others = part.subscripts
    if others or row.written[0] not in "'\"":
        expected = f"expected a name in quotes, such as {part.name}('{next(iter(rows), 'out')}')"
        raise source.error(f"read {quoted(row.written)}, {expected}", row.at)
    seen = seen_in(part)
    assert seen is not None  # noqa: S101 - it has a row
    if seen.of not in rows:
        hint = nearest(seen.of, rows) or f"; there are {listed(list(rows), 8)}" * bool(rows)
        what = {"temperature": "a shift element with a `heat_capacity`", "twist": "a spring"}
        what |= dict.fromkeys(("speed", "angle", "acceleration"), "a link")
        what |= {"power": "a link, a shift element or a spring", "torque": "a component"}
        expected = what.get(part.name, "a shift element")
        raise source.error(f"read {quoted(seen.of)}, expected {expected}{hint}", row.at)


class _Read(NamedTuple):
    """Properties of a formula, derived from its text or tree."""

    variables: frozenset[str]
    seen: tuple[Seen, ...]
    function: Function
    along: Callable[..., Floats]
    breaks: tuple[float, ...]
    switches: bool
    tree: Tree


@lru_cache(maxsize=1024)
def _read(text: str, tree: Tree | None) -> _Read:
    if tree is None:
        language = Language(FUNCTIONS, "t", "t", caret=True, of_names=_OF_NAMES)
        tree = _with_speed(parse(Excerpt(text, "formula"), language))
    inside = [part for part in parts(tree) if isinstance(part, TableName)]
    seen = tuple(dict.fromkeys(quantity for part in inside if (quantity := seen_in(part))))
    variables_of_link = frozenset(part.name for part in inside if seen_in(part) is None) - {PI}
    switches = any(_jumps(part) and variables(part) - {"t"} for part in parts(tree))
    return _Read(
        variables_of_link,
        seen,
        compiled(tree, seen),
        compiled_along(tree, seen),
        tuple(corners(tree, "t")),
        switches,
        tree,
    )


def _jumps(part: Tree) -> bool:
    return isinstance(part, Applied) and part.name in JUMPS


def _with_numbers(tree: Tree, numbers: Mapping[str, float]) -> Tree:
    def value(part: TableName) -> Tree:
        is_number = part.name in numbers and not part.subscripts
        return Constant(numbers[part.name]) if is_number else part

    return with_names(tree, value)
