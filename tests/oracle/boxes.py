"""All gearboxes of a small space for wanted ratios, by brute force.

Nothing is shared with the program. Each ratio of a set stands in one row of the equations, so
by Cramer's rule the speed of a link is, up to a common factor, a polynomial that is linear in
each ratio. Its factors are whole numbers, read off determinants at ratios 0 and 1. A function
that is linear in each variable has its extremes in a cell at the cell's corners; so it is
*proved*, not sampled, in which cells of the bounds a gear can be within the tolerance of a
target. Gears are chosen one after another as long as some cell is left for all of them. What
is left at the end is fitted by scipy's least squares from many starts in these cells; where that
leaves a gear beyond its range, SLSQP makes the largest error least.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from itertools import combinations, permutations, product
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.optimize import least_squares, minimize

Array = npt.NDArray[np.float64]
Code = tuple[int, ...]
Pair = tuple[Array, Array]
"""Of input and output."""
HELD = -1
"""The second link of a brake."""
EPS = 1e-13
STARTS = 16
"""Fits of one choice of gears."""


class Space(NamedTuple):
    """What is asked: as the options of the command say it."""

    sets: int
    elements: int
    engaged: int
    targets: tuple[float, ...]
    bounds: tuple[float, float] = (1.4, 5.0)
    meshed: int = 0
    own_input: bool = False
    fixed: int = 0
    tolerance: float = 0.01
    tolerances: tuple[float, ...] = ()
    """Of each gear, where they are not the same."""
    cells: int = 16
    """Along the ratio of each set."""
    own_output: bool = False
    shafts: int = 0

    @property
    def widths(self) -> tuple[float, ...]:
        """Of each gear."""
        return self.tolerances or (self.tolerance,) * len(self.targets)

    @property
    def links(self) -> int:
        """Of the scheme."""
        others = self.own_input + self.own_output + self.shafts
        return self.sets + self.engaged + 1 - others + bool(self.fixed)


class Frame(NamedTuple):
    """A scheme with all that is chosen but the shift elements."""

    code: Code
    """Links of sun, carrier, ring of each set."""
    meshed: tuple[bool, ...]
    held: int
    """`HELD` if none is."""
    input: int
    output: int
    shafts: int = 0

    @property
    def further(self) -> list[int]:
        """Shafts of no set that are no ports."""
        first = max(*self.code, self.input, self.output) + 1
        return list(range(first, first + self.shafts))

    @property
    def moving(self) -> list[int]:
        """Links that can turn, those of no set among them."""
        links = {*self.code, self.input, self.output, *self.further}
        return sorted(links - {self.held})

    @property
    def possible(self) -> list[tuple[int, int]]:
        """Brakes and clutches that it may have."""
        brakes = [(one, HELD) for one in self.moving if one not in (self.input, self.output)]
        return brakes + list(combinations(self.moving, 2))


class Box(NamedTuple):
    """A frame with shift elements, in the least of all names, and how near it comes."""

    frame: Frame
    elements: tuple[tuple[int, int], ...]
    error: float
    """The least of the largest |ln(i/target)| of all its minima."""
    best: float
    """That of the minimum with the least sum of squares."""
    farthest: float
    """The least that the largest |ln(i/target)|/width can be, of all choices of gears."""
    ratios: tuple[float, ...]
    gears: tuple[tuple[tuple[int, int], ...], ...]
    """Links of the engaged elements for each target, in the names of `found_as`."""
    found_as: tuple[Frame, tuple[tuple[int, int], ...]]


def codes(sets: int) -> Iterator[Code]:
    """All schemes, each set with three links of its own, as restricted growth strings."""

    def grown(code: Code) -> Iterator[Code]:
        if len(code) == 3 * sets:
            yield code
            return
        own = code[len(code) // 3 * 3 :]
        for link in range(max(code, default=-1) + 2):
            if link not in own:
                yield from grown((*code, link))

    return grown(())


def triples(code: Code) -> list[Code]:
    """The links of each set."""
    return [code[at : at + 3] for at in range(0, len(code), 3)]


def hangs_together(code: Code) -> bool:
    """Whether all sets are joined by links."""
    reached, *left = map(set, triples(code))
    while near := [one for one in left if one & reached]:
        reached = reached.union(*near)
        left = [one for one in left if not one & reached]
    return not left


def is_sound(code: Code) -> bool:
    """Whether no group of sets turns as one piece."""
    own = list(map(set, triples(code)))
    groups = (group for size in range(1, len(own) + 1) for group in combinations(own, size))
    return all(len(set().union(*group)) >= len(group) + 2 for group in groups)


def names(
    frame: Frame, elements: Sequence[tuple[int, int]]
) -> Iterator[tuple[Frame, tuple[tuple[int, int], ...]]]:
    """The same box under all names that its sets can have."""
    own = triples(frame.code)
    for order, further in product(permutations(range(len(own))), permutations(frame.further)):
        new: dict[int, int] = {HELD: HELD}
        for at in order:
            for link in own[at]:
                new.setdefault(link, len(new) - 1)
        for link in (frame.input, frame.output, *further):
            new.setdefault(link, len(new) - 1)
        renamed = Frame(
            tuple(new[link] for at in order for link in own[at]),
            tuple(frame.meshed[at] for at in order),
            new[frame.held],
            new[frame.input],
            new[frame.output],
            frame.shafts,
        )
        pairs = sorted(
            (new[a], HELD) if b == HELD else (min(new[a], new[b]), max(new[a], new[b]))
            for a, b in elements
        )
        yield renamed, tuple(pairs)


def frames(space: Space) -> Iterator[Frame]:
    """All schemes with meshed sets, held link and ports, each once."""
    flags = [
        tuple(at in some for at in range(space.sets))
        for some in combinations(range(space.sets), space.meshed)
    ]
    for code in codes(space.sets):
        in_parts = space.fixed and not space.shafts
        if max(code) + 1 != space.links or not is_sound(code):
            continue
        if not (in_parts or hangs_together(code)):
            continue
        links = range(space.links)
        held = [one for one in links if code.count(one) == space.fixed] if space.fixed else [HELD]
        inputs = [space.links] if space.own_input else links
        outputs = [space.links + space.own_input] if space.own_output else links
        for meshed, still, input_, output in product(flags, held, inputs, outputs):
            frame = Frame(code, meshed, still, input_, output, space.shafts)
            if len({still, input_, output}) == 3 and frame == min(names(frame, ()))[0]:
                yield frame


def polynomials(frame: Frame, choices: npt.NDArray[np.intp]) -> Array:
    """Factors of the speeds of input and output for each choice of engaged elements.

    Behind the axis of choices one for each set (0: without its ratio, 1: with it), then input
    and output.
    """
    size, own = len(frame.moving), triples(frame.code)
    turning = np.zeros((max(frame.moving) + 2, size))  # a row for each link, the last for `HELD`
    for at, link in enumerate(frame.moving):
        turning[link, at] = 1
    speed = {link: turning[link] for link in {HELD, *frame.code, *frame.moving}}
    corners = list(product((0, 1), repeat=len(own)))
    matrix = np.zeros((len(choices), len(corners), 2, size, size))
    for number, corner in enumerate(corners):
        for at, ((a, h, b), k) in enumerate(zip(own, corner, strict=True)):
            matrix[:, number, :, at] = speed[a] - k * speed[b] - (1 - k) * speed[h]
    equal = np.array([speed[a] - speed[b] for a, b in frame.possible])
    rows = equal[choices]
    assert len(own) + rows.shape[1] == size - 1
    matrix[:, :, :, len(own) : -1] = rows[:, np.newaxis, np.newaxis]
    matrix[:, :, 0, -1] = speed[frame.input]
    matrix[:, :, 1, -1] = speed[frame.output]
    values = np.linalg.det(matrix)
    exact = np.rint(values)
    assert np.allclose(values, exact, atol=1e-6)
    factors: Array = exact.reshape(len(choices), *(2,) * len(own), 2)
    for axis in range(1, len(own) + 1):  # a + b K from its values at 0 and 1
        low, high = np.moveaxis(factors, axis, 0)
        factors = np.stack([low, high - low], axis)
    return factors


@cache
def reduced(pair: bytes) -> bytes:
    """Two polynomials, as `polynomials` has them, without a factor that both have.

    Linear in each variable, a polynomial has factors in variables of their own: it is the product
    of one in some variables and one in the rest if, as a matrix of these by those, it has rank 1.
    Where a common factor is 0 all ratios seem possible; no gear is meant by that.
    """
    factors = np.frombuffer(pair)
    sets = len(factors).bit_length() - 2
    factors = factors.reshape((2,) * sets + (2,))
    for size in range(sets, 0, -1):
        for some in combinations(range(sets), size):
            matrix = np.moveaxis(factors, some, range(size)).reshape(2**size, -1)
            row = matrix[np.argmax(matrix.any(axis=1))]
            at = np.argmax(row != 0)
            if (matrix * row[at] == np.outer(matrix[:, at], row)).all():
                rest = np.zeros_like(factors)
                common = max(int(np.gcd.reduce(row.astype(np.int64))), 1)
                rest[(0,) * size] = row.reshape((2,) * (sets + 1 - size)) / common
                return np.moveaxis(rest, range(size), some).tobytes()
    return pair


def valued(factors: Array, axes: Sequence[Array]) -> Array:
    """A polynomial on the grid of the values of each ratio."""
    for axis, ratios in enumerate(axes):
        powers = np.stack([ratios**0, ratios], 1)
        factors = np.moveaxis(np.tensordot(powers, factors, (1, axis)), 0, axis)
    return factors


def _cells(above: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """Whether it is so at all corners of each cell of a grid."""
    for axis in range(above.ndim):
        rolled = np.moveaxis(above, axis, 0)
        above = np.moveaxis(rolled[1:] & rolled[:-1], 0, axis)
    return above


def reached(speeds: Pair, target: float, tolerance: float) -> int:
    """The cells in which input/output can be within the tolerance of the target, as bits."""
    low, high = (speeds[0] - target * math.exp(s * tolerance) * speeds[1] for s in (-1, 1))
    never = _cells((low > 0) & (high > 0)) | _cells((low < 0) & (high < 0))
    return int.from_bytes(np.packbits(~never.ravel()).tobytes(), "big")


def _can(speeds: Array, target: float, tolerance: float) -> npt.NDArray[np.bool_]:
    """Whether choices, the last axis, can be near the target somewhere between all corners."""
    low, high = (speeds[:, 0] - target * math.exp(s * tolerance) * speeds[:, 1] for s in (-1, 1))
    above, below = ((low > 0) & (high > 0)), ((low < 0) & (high < 0))
    able: npt.NDArray[np.bool_] = ~np.logical_or(above.all(axis=0), below.all(axis=0))
    return able


class Gear(NamedTuple):
    """A choice of engaged elements that is a gear."""

    engaged: frozenset[int]
    input_speed: Array
    output_speed: Array
    cells: tuple[int, ...]
    """For each target those in which it can have it."""
    needed: frozenset[int]
    """Those of the elements that count as used."""
    formula: tuple[float, ...]
    """Its ratio at some ratios of the sets: the same for all that have one ratio anywhere."""


Choice = tuple[tuple[Gear, ...], int]
"""Gears, one for each target, and the cells that are left."""
Way = tuple[frozenset[int], frozenset[int], dict[int, Gear], int]
"""Elements that are engaged, those that are in use, gears of targets, cells."""


class Minimum(NamedTuple):
    """Of the sum of squares of ln(i/target)/width."""

    squares: float
    error: float
    """The largest |ln(i/target)| there."""
    farthest: float
    """The largest |ln(i/target)|/width, as small as can be near it."""
    ratios: Array


class Search:
    """All boxes of one frame."""

    def __init__(self, space: Space, frame: Frame) -> None:
        self.space, self.frame = space, frame
        least, most = map(math.log, space.bounds)
        self.logarithms = np.linspace(least, most, space.cells + 1)
        self.signs = [1.0 if one else -1.0 for one in frame.meshed]
        self.gears = list(self._gears())

    def _gears(self) -> Iterator[Gear]:
        axes = [sign * np.exp(self.logarithms) for sign in self.signs]
        space, frame = self.space, self.frame
        choices = np.array(list(combinations(range(len(frame.possible)), space.engaged)), np.intp)
        whole = polynomials(frame, choices)
        factors = np.stack([np.frombuffer(reduced(one.tobytes())) for one in whole], -1)
        factors = factors.reshape(*whole.shape[1:], -1)
        speeds = valued(factors, [axis[[0, -1]] for axis in axes])
        corners = speeds.reshape(-1, *speeds.shape[-2:])
        wanted = list(zip(space.targets, space.widths, strict=True))
        hope = np.array([_can(corners, *one) for one in wanted])
        hope &= factors.any(axis=tuple(range(space.sets))).all(axis=0)
        if not hope.any(axis=1).all():
            return
        somewhere = [np.array([-1.5 - 0.1 * math.sqrt(at + 2), -3.3]) for at in range(space.sets)]
        speeds = valued(factors, somewhere).reshape(-1, *speeds.shape[-2:])
        ratios = np.round(speeds[:, 0] / np.where(speeds[:, 1], speeds[:, 1], np.nan), 9)
        for number in np.flatnonzero(hope.any(axis=0)):
            own = factors[..., number]
            fine = valued(own[..., 0], axes), valued(own[..., 1], axes)
            cells = tuple(
                reached(fine, *one) if can else 0
                for one, can in zip(wanted, hope[:, number], strict=True)
            )
            if any(cells):
                formula = tuple(ratios[:, number].tolist())
                engaged = choices[number].tolist()
                needed = self._carrying(engaged) if space.shafts else frozenset(engaged)
                yield Gear(frozenset(engaged), own[..., 0], own[..., 1], cells, needed, formula)

    def _carrying(self, engaged: Sequence[int]) -> frozenset[int]:
        """The elements that carry torque: the balance of each link, with 1 at the input."""
        frame, own = self.frame, triples(self.frame.code)
        row = {link: at for at, link in enumerate(frame.moving)}
        pairs = [(self.frame.possible[one], (1.0, -1.0)) for one in engaged]
        columns: list[tuple[Sequence[int], Sequence[float]]] = [*pairs, ([frame.output], [1.0])]
        for at, (links, sign) in enumerate(zip(own, self.signs, strict=True)):
            k = sign * (2.1 + 0.3 * math.sqrt(at + 2))
            columns.append((links, (1.0, k - 1, -k)))
        balance = np.zeros((len(row), len(columns)))
        for at, (on_links, torques) in enumerate(columns):
            for link, torque in zip(on_links, torques, strict=True):
                if link in row:
                    balance[row[link], at] += torque
        given = np.zeros(len(row))
        given[row[frame.input]] = 1
        found = np.linalg.solve(balance, given)
        return frozenset(
            one for one, torque in zip(engaged, found, strict=False) if abs(torque) > 1e-9
        )

    def choices(self) -> Iterator[Choice]:
        """Gears for the targets that some cell allows, with these cells.

        Of choices with the same elements and the same formulas one is as good as another.
        """
        targets = range(len(self.space.targets))
        able = [[gear for gear in self.gears if gear.cells[n]] for n in targets]
        order = sorted(targets, key=lambda n: len(able[n]))
        ways: dict[object, Way] = {}
        everywhere = (1 << 8 * math.ceil(self.space.cells**self.space.sets / 8)) - 1
        ways[()] = frozenset(), frozenset(), {}, everywhere
        for n in order:
            after: dict[object, Way] = {}
            for used, carrying, chosen, cells in ways.values():
                for gear in able[n]:
                    left, both = cells & gear.cells[n], used | gear.engaged
                    if not left or len(both) > self.space.elements:
                        continue
                    alike = [one.engaged for one in chosen.values() if one.formula == gear.formula]
                    if gear.engaged not in alike:
                        more = chosen | {n: gear}
                        name = tuple(one.formula for one in more.values())
                        # two targets with one formula need two choices of elements
                        needed = carrying | gear.needed
                        after[both, needed, name, frozenset(alike)] = both, needed, more, left
            ways = after
        for used, carrying, chosen, cells in ways.values():
            if len(carrying) == self.space.elements and self._are_full(used):
                yield tuple(chosen[n] for n in targets), cells

    def _are_full(self, elements: frozenset[int]) -> bool:
        """Whether three elements or more are at each shaft."""
        ends = [link for one in elements for link in self.frame.possible[one]]
        return all(ends.count(shaft) >= 3 for shaft in self.frame.further)

    def fitted(self, gears: Sequence[Gear], cells: int) -> list[Minimum]:
        """Minima from the nearest centres of cells."""
        count, sets = self.space.cells, self.space.sets
        bits = np.frombuffer(cells.to_bytes(math.ceil(count**sets / 8), "big"), np.uint8)
        places = np.argwhere(np.unpackbits(bits)[: count**sets].reshape((count,) * sets))
        middle = (self.logarithms[1:] + self.logarithms[:-1]) / 2
        centres = middle[places]
        targets, widths = np.array(self.space.targets), np.array(self.space.widths)
        factors = np.array([[one.input_speed.ravel(), one.output_speed.ravel()] for one in gears])

        def off(x: Array) -> Array:
            terms = np.ones(1)
            for sign, one in zip(self.signs, np.exp(x), strict=True):
                terms = np.multiply.outer(terms, np.array([1.0, sign * one])).ravel()
            speeds = factors @ terms
            with np.errstate(divide="ignore", invalid="ignore"):
                gaps: Array = np.log(speeds[:, 0] / speeds[:, 1] / targets) / widths
            return np.where(np.isfinite(gaps), gaps, 1e5)

        squares = [float((off(x) ** 2).sum()) for x in centres]
        nearest = np.argsort(squares)[:STARTS]
        limits = (self.logarithms[0], self.logarithms[-1])
        minima = []
        for at in nearest:
            if squares[at] >= 1e10:
                continue
            found = least_squares(off, centres[at], bounds=limits, xtol=EPS, ftol=EPS, gtol=EPS)
            gaps = off(found.x)
            ratios = np.exp(found.x) * self.signs
            farthest = float(abs(gaps).max())
            if farthest > 1 and gaps @ gaps <= 1.1 * len(gaps):
                farthest = min(farthest, _least_farthest(off, found.x, limits))
            size = float((abs(gaps) * widths).max())
            minima.append(Minimum(float(gaps @ gaps), size, farthest, ratios))
        return minima


def _least_farthest(
    off: Callable[[Array], Array], start: Array, limits: tuple[float, float]
) -> float:
    """The least that the largest error near a point can be: it is one more variable."""

    def farthest(x: Array) -> float:
        return float(x[-1])

    def room(x: Array) -> Array:
        gaps = off(x[:-1])
        return np.concatenate([x[-1] - gaps, x[-1] + gaps])

    found = minimize(  # type: ignore[call-overload] # a tuple of bounds is one, too
        farthest,
        np.array([*start, abs(off(start)).max()]),
        bounds=[*[limits] * len(start), (0.0, 1e6)],
        constraints={"type": "ineq", "fun": room},
        method="SLSQP",
        options={"ftol": 1e-12, "maxiter": 500},
    )
    return float(abs(off(found.x[:-1])).max())


def found_in(space: Space, frame: Frame) -> list[Box]:
    """The boxes of a frame whose gears are no farther than 1.05 times their tolerances."""
    search = Search(space, frame)
    boxes: dict[object, Box] = {}
    known: dict[object, list[Minimum]] = {}
    for gears, cells in search.choices():
        formulas = tuple(one.formula for one in gears)
        if formulas not in known:
            known[formulas] = search.fitted(gears, cells)
        minima = known[formulas]
        if not minima:
            continue
        best = min(minima, key=lambda one: one.squares).error
        _, error, _, ratios = min(minima, key=lambda one: one.error)
        farthest = min(one.farthest for one in minima)
        if farthest > 1.05:
            continue
        used = frozenset().union(*(one.engaged for one in gears))
        elements = tuple(frame.possible[at] for at in sorted(used))
        name = min(names(frame, elements))
        if name in boxes:
            farthest = min(farthest, boxes[name].farthest)
            boxes[name] = boxes[name]._replace(farthest=farthest)
            if boxes[name].error <= error:
                continue
        chosen = tuple(tuple(frame.possible[at] for at in sorted(one.engaged)) for one in gears)
        boxes[name] = Box(
            *name, error, best, farthest, tuple(ratios.tolist()), chosen, (frame, elements)
        )
    return [boxes[name] for name in sorted(boxes)]  # type: ignore[type-var]


@cache
def all_frames(space: Space) -> tuple[Frame, ...]:
    """Those of `frames`."""
    return tuple(frames(space))


def searched(space: Space) -> int:
    """Frames times choices of elements."""
    return sum(math.comb(len(one.possible), space.elements) for one in all_frames(space))


def found(space: Space) -> list[Box]:
    """All boxes, those near the tolerance too."""
    return [box for frame in all_frames(space) for box in found_in(space, frame)]
