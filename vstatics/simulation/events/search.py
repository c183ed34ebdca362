"""Order in which combinations of sticking and slipping states are tried."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from heapq import heappop, heappush
from itertools import combinations, product
from typing import Any, Literal

from vstatics.simulation.events.margins import Watch
from vstatics.simulation.system.ports import States

_FIRST_TRIED = 12
"""Number of combinations tried in order of rank before `guess` is called."""
_MOST_PIVOTS = 300
"""Largest number of steps of block pivoting."""
_IN_VAIN = 3
"""Number of block pivots allowed without a decrease of the number of failing states."""
_WORTH_WHILE = 24_000
"""Limit for the number of further combinations times the squared number of choices.

Fewer combinations are tried in a large system, where a trial takes longer.
"""


Kind = Literal["contacts", "meshes", "springs", "pieces"]
"""Kinds of choices: fields of `States`."""
Choice = tuple[Kind, int, tuple[Any, ...]]
"""Choice between states: field of `States`, index in this field, and options, sticking first."""
Changed = tuple[tuple[int, Any], ...]
"""Changed states of a combination: number of the choice, and state other than its first option."""


class ModeSearch:
    """Search through combinations of states: most sticking states first.

    Among equally many, the combination nearest to the preceding states comes first. The failing
    margins of a combination show which combinations to try next. If no combination is admissible,
    the result of `guess` is tried, and finally all others.
    """

    def __init__(
        self,
        base: States,
        choices: Sequence[Choice],
        before: States | None,
        guess: Callable[[], States | None] = lambda: None,
    ) -> None:
        self.base, self.choices, self.before, self.guess = base, choices, before, guess
        self.place: dict[tuple[Kind | None, int], int] = {
            choice[:2]: number for number, choice in enumerate(choices)
        }
        self.seen: set[Changed] = {()}
        self.waiting: list[tuple[tuple[int, ...], Changed]] = [((0,), ())]
        self.changed: Changed = ()
        self.turned: list[tuple[int, Any]] = []

    def __iter__(self) -> Iterator[States]:
        """Yield the best-ranked combinations, then the guess."""
        yield from self._best(_FIRST_TRIED)
        if (guess := self.guess()) is not None:  # only the guessed states of open choices are used
            guessed = {n: getattr(guess, kind)[at] for n, (kind, at, _) in enumerate(self.choices)}
            self.changed = tuple(sorted(self._changes(guessed).items()))
            yield self._with(self.changed)

    def others(self) -> Iterator[States]:
        """Yield further combinations, fewer in a large system."""
        yield from self._best(_WORTH_WHILE // max(1, len(self.choices)) ** 2)

    def _best(self, count: int) -> Iterator[States]:
        """Yield up to `count` new combinations: the queue by rank, then all others."""
        others = (changed for changed in self._all() if changed not in self.seen)
        for _ in range(count):
            changed = heappop(self.waiting)[-1] if self.waiting else next(others, None)
            if changed is None:
                return
            self.seen.add(changed)
            self.changed = changed
            yield self._with(changed)

    def pivoting(self) -> Iterator[States]:
        """Yield combinations by block pivoting, beginning with all candidates sticking.

        Without progress, single states change by Murty's rule, which solves a linear
        complementarity problem in finitely many steps (J. Judice, F. Pires, Computers and
        Operations Research 1994).
        """
        changes: dict[int, Any] = {}
        least, spare = len(self.choices) + 1, _IN_VAIN
        singly = set()
        for _ in range(_MOST_PIVOTS):
            self.changed = tuple(sorted(changes.items()))
            if self.changed in singly:  # the pivoting repeats itself
                return
            yield self._with(self.changed)
            turned = dict(reversed(self.turned))
            if not turned:  # no failing state has another option
                return
            if len(turned) < least:
                least, spare = len(turned), _IN_VAIN
            elif spare:
                spare -= 1
            else:
                turned = dict([max(turned.items())])
                singly.add(self.changed)
            changes = self._changes({**changes, **turned})

    def _changes(self, states: Mapping[int, Any]) -> dict[int, Any]:
        first = [options[0] for _, _, options in self.choices]
        return {number: state for number, state in states.items() if state != first[number]}

    def fails(self, states: States, failing: Sequence[Watch], released: States | None) -> None:
        """Record the failing margins of the last combination, and queue similar combinations."""
        if released is not None:
            changes = dict(self.changed)
            for number, (kind, index, _) in enumerate(self.choices):
                if kind == "meshes" and released.meshes[index] != states.meshes[index]:
                    changes[number] = released.meshes[index]
            self._push(changes, single=False)
        self.turned = []
        for watch in failing:
            others = list(self._others(watch))
            self.turned += others[:1]
            for number, state in others:
                changes = {**dict(self.changed), number: state}
                if state == self.choices[number][2][0]:
                    del changes[number]
                self._push(changes, single=True)

    def _push(self, changes: dict[int, str], *, single: bool) -> None:
        """Queue a combination; all moving mechanisms together count as a single slipping state."""
        changed = tuple(sorted(changes.items()))
        if changed in self.seen:
            return
        self.seen.add(changed)
        meshes = sum(self.choices[number][0] == "meshes" for number in changes)
        slipping = len(changes) - meshes + min(meshes, 1)
        distance = sum(  # number of states that differ from the preceding states
            state != other
            for states, others in zip(
                self._with(changed)[:3], (self.before or ())[:3], strict=False
            )
            for state, other in zip(states, others, strict=True)
        )
        rank = slipping, int(single), distance, len(self.seen)
        heappush(self.waiting, (rank, changed))

    def _with(self, changed: Changed) -> States:
        fields = self.base._asdict()
        for number, state in changed:
            kind, index, _ = self.choices[number]
            fields[kind] = (*fields[kind][:index], state, *fields[kind][index + 1 :])
        return States(**fields)

    def _others(self, watch: Watch) -> Iterator[tuple[int, str]]:
        """Yield the index of the choice to which a margin belongs, with each alternative option."""
        number = self.place.get((KIND_OF.get(watch.kind), watch.of))
        if number is None:
            return
        options = self.choices[number][2]
        if watch.kind in ("hold", "cone"):
            wanted = "+" if watch.side > 0 else "-"
            options = tuple(option for option in options if option[0] in (wanted, "s"))
        now = dict(self.changed).get(number, options[0])
        yield from ((number, option) for option in options if option != now)

    def _all(self) -> Iterator[Changed]:
        for count in range(len(self.choices) + 1):
            for slipping in combinations(range(len(self.choices)), count):
                for signs in product(*(self.choices[index][2][1:] for index in slipping)):
                    yield tuple(zip(slipping, signs, strict=True))


KIND_OF: Mapping[str, Kind | None] = {
    "slip": "contacts",
    "hold": "contacts",
    "mesh": "meshes",
    "cone": "meshes",
    "limit": "springs",
    "grip": "springs",
}
"""Kind of a margin -> kind of the choice to which it belongs."""
