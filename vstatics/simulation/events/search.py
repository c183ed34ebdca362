"""The order in which choices of what sticks are tried."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from heapq import heappop, heappush
from itertools import combinations, product
from typing import Any, Literal

from vstatics.simulation.events.margins import Watch
from vstatics.simulation.system.ports import States

_FIRST_TRIED = 12
"""Choices by their order, before a guess."""
_MOST_PIVOTS = 300
_IN_VAIN = 3
"""Times at which all that fails is changed though it is not less than before."""
_WORTH_WHILE = 24_000
"""So many choices are tried by the square of what has one, before it is told that there is none:
a try of many takes longer."""


Kind = Literal["contacts", "meshes", "springs", "pieces"]
"""What may stick or slip, as systems and their states call it."""
Choice = tuple[Kind, int, tuple[Any, ...]]
"""Its kind, its index, its states: the one that sticks first; of pieces their numbers."""
Changed = tuple[tuple[int, Any], ...]
"""Numbers of choices, and what is chosen in place of their first states."""


class ModeSearch:
    """Goes through choices: most sticking first, then nearest to before.

    What fails in a choice tells which to try next; a guess is made where these do not do, and when
    all are gone, all others are tried.
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
        """Choices, as they are to be tried at first."""
        yield from self._best(_FIRST_TRIED)
        yield from self._near(self.guess())

    def others(self) -> Iterator[States]:
        """As many more as are worth while."""
        yield from self._best(_WORTH_WHILE // max(1, len(self.choices)) ** 2)

    def _best(self, count: int) -> Iterator[States]:
        """Those that are waiting, the best first; then all others."""
        others = (changed for changed in self._all() if changed not in self.seen)
        for _ in range(count):
            changed = heappop(self.waiting)[-1] if self.waiting else next(others, None)
            if changed is None:
                return
            self.seen.add(changed)
            self.changed = changed
            yield self._with(changed)

    def pivoting(self) -> Iterator[States]:
        """From all sticking on, all that fails is changed; where that gains nothing, one thing.

        J. Judice, F. Pires, Computers and Operations Research 1994: block pivoting, with the rule
        of Murty, by which a linear complementarity problem comes to its end.
        """
        changes: dict[int, Any] = {}
        least, spare = len(self.choices) + 1, _IN_VAIN
        singly: set[Changed] = set()
        for _ in range(_MOST_PIVOTS):
            self.changed = tuple(sorted(changes.items()))
            if self.changed in singly:  # from here on it would go round
                return
            yield self._with(self.changed)
            turned = dict(reversed(self.turned))
            if not turned:  # nothing of it can be changed
                return
            if len(turned) < least:
                least, spare = len(turned), _IN_VAIN
            elif spare:
                spare -= 1
            else:
                turned = dict([max(turned.items())])
                singly.add(self.changed)
            changes = self._changes({**changes, **turned})

    def _near(self, guess: States | None) -> Iterator[States]:
        """A guess as far as there is a choice, and what is next to it."""
        if guess is None:
            return
        found = {n: getattr(guess, kind)[at] for n, (kind, at, _) in enumerate(self.choices)}
        self.changed = tuple(sorted(self._changes(found).items()))
        yield self._with(self.changed)

    def _changes(self, found: Mapping[int, Any]) -> dict[int, Any]:
        """What differs from the first states."""
        first = [options[0] for _, _, options in self.choices]
        return {number: state for number, state in found.items() if state != first[number]}

    def fails(self, states: States, failing: Sequence[Watch], released: States | None) -> None:
        """Note what fails in the choice that was tried last."""
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
        """Have a choice tried: meshes that move together count as one."""
        changed = tuple(sorted(changes.items()))
        if changed in self.seen:
            return
        self.seen.add(changed)
        meshes = sum(self.choices[number][0] == "meshes" for number in changes)
        slipping = len(changes) - meshes + min(meshes, 1)
        rank = slipping, int(single), _distance(self._with(changed), self.before), len(self.seen)
        heappush(self.waiting, (rank, changed))

    def _with(self, changed: Changed) -> States:
        made = self.base._asdict()
        for number, state in changed:
            kind, index, _ = self.choices[number]
            made[kind] = (*made[kind][:index], state, *made[kind][index + 1 :])
        return States(**made)

    def _others(self, watch: Watch) -> Iterator[tuple[int, str]]:
        """Other states of what fails."""
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
        """All choices, most sticking first."""
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
"""What has a choice where a margin ends."""


def _distance(states: States, before: States | None) -> int:
    """In how many things states differ from before."""
    if before is None:
        return 0
    return sum(
        one != other
        for mine, others in zip(states[:3], before[:3], strict=True)
        for one, other in zip(mine, others, strict=True)
    )
