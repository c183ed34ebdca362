"""Memory of results: used again only when nobody looks at it any more."""

import copy
import gc
import pickle
import weakref
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest

from vstatics import Gear, Mechanism, Results, ShiftElement, Transmission, solve
from vstatics.core.numerics import memory
from vstatics.core.numerics.memory import Block, Form, Layout, shown
from vstatics.core.statics.result_arrays import ARRAYS

Array = np.ndarray[Any, Any]
FORMS = {"ratio": Form((2, 1, 50), np.float64), "locked": Form((2, 1, 50), np.bool_)}
ELEMENTS = [ShiftElement(1, 2), ShiftElement(2, 0)]
CASE = Transmission(3, ELEMENTS, [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear([1]), Gear([2])])


@pytest.fixture(autouse=True)
def free(monkeypatch: pytest.MonkeyPatch) -> Iterator[deque[Block]]:
    """Nothing is kept from other tests."""
    gc.collect()
    kept: deque[Block] = deque()
    monkeypatch.setattr(memory, "_free", kept)
    yield kept
    gc.collect()


def sweep(low: float, variants: int = 50) -> Results:
    """Variants of the case, whose second gear has the ring held: its ratio is 1 - u."""
    return solve(CASE, ratios=np.linspace(low, -2, variants)[:, None])


def is_right(ratio: Array, low: float) -> bool:
    return np.allclose(ratio, 1 - np.linspace(low, -2, 50), rtol=1e-14, atol=0)


def pickled(something: Any) -> Any:
    return pickle.loads(pickle.dumps(something))  # noqa: S301


def constant(value: float) -> Layout:
    """The first row holds one value."""
    return Layout([], [(0, value)])


def test_memory_that_nobody_looks_at_is_used_again_for_the_same_form() -> None:
    block = memory.block(FORMS)
    arrays = shown(block)
    assert memory.block(FORMS) is not block
    del arrays
    longer, other = Form((2, 1, 51), np.float64), Form((2, 1, 50), np.int16)
    for forms in ({"ratio": FORMS["ratio"]}, FORMS | {"ratio": longer}, FORMS | {"locked": other}):
        assert memory.block(forms) is not block
    assert memory.block(dict(FORMS)) is block
    assert memory.block(FORMS) is not block


LOOKS: dict[str, Callable[[Array], object]] = {
    "the array": lambda array: array,
    "a slice of a slice": lambda array: array[1:][0][0][3:],
    "a row, turned": lambda array: array.T[0],
    "another type": lambda array: array.view(np.uint8),
    "a broadcast": lambda array: np.broadcast_to(array, (3, *array.shape)),
    "a subclass": lambda array: array.view(np.recarray),
    "an iterator": lambda array: array.flat,
    "a slice of a memoryview": lambda array: array.data[1:],
    "through a buffer": lambda array: np.frombuffer(array.data.cast("B")),
    "one of a list": lambda array: [*array],
}


def test_who_looks_at_a_part_keeps_the_whole() -> None:
    for name, look in LOOKS.items():
        block = memory.block(FORMS)
        arrays = shown(block)
        seen = look(arrays["ratio"])
        del arrays
        gc.collect()
        assert memory.block(FORMS) is not block, name
        del seen
        gc.collect()
        assert memory.block(FORMS) is block, name


def test_copies_need_the_memory_no_longer() -> None:
    copies: tuple[Callable[[Array], Any], ...] = copy.copy, copy.deepcopy, pickled, np.copy, np.sum
    for copied in copies:
        block = memory.block(FORMS)
        for rows in block.gears:
            rows.lay_out(constant(2.5))
        found = copied(shown(block)["ratio"])
        again = memory.block(FORMS)
        assert again is block
        for rows in again.gears:
            rows.lay_out(constant(-1.0))
        assert np.sum(found) == 250


@pytest.mark.parametrize("same", [True, False], ids=["the same layout", "one that is alike"])
def test_what_memory_holds_is_not_written_again(same: bool) -> None:
    """A mark put there by the test shows what is written."""
    block = memory.block(FORMS)
    layout = constant(2.5)
    block.gears[1].lay_out(layout)
    shown(block)
    rows = memory.block(FORMS).gears[1]
    assert (rows.arrays[0] == 2.5).all()
    rows.arrays[0][7] = -1
    rows.lay_out(layout if same else constant(2.5))
    assert rows.arrays[0][7] == -1
    rows.vary(0)
    rows.lay_out(layout if same else constant(2.5))
    assert (rows.arrays[0] == 2.5).all()
    (varied,) = rows.lay_out(Layout([0], []))
    varied[:] = 7
    rows.lay_out(layout)
    assert (rows.arrays[0] == 2.5).all()


def test_results_can_only_be_read_and_copies_written() -> None:
    for results in (sweep(-3), solve(CASE)):
        for array in (getattr(results, name) for name in ARRAYS):
            with pytest.raises(ValueError, match="read-only"):
                array[...] = 0
            if array.size and any(array.strides):  # one number shown for all is nobody's
                with pytest.raises(ValueError, match="WRITEABLE"):
                    array.flags.writeable = True
                base = array
                while isinstance(base := base.base, np.ndarray):
                    assert not base.flags.writeable
    results = sweep(-3)
    for copied in (copy.deepcopy(results), pickled(results)):
        copied.ratio[:] = 0
        assert not copied.ratio.any()
    assert is_right(results.ratio[:, 1], -3)


def test_results_of_threads_do_not_meet() -> None:
    def work(number: int) -> None:
        before: list[tuple[Array, float]] = []
        for turn in range(30):
            low = -3 - number - turn / 100
            before.append((sweep(low).ratio[:, 1], low))
            assert all(is_right(*kept) for kept in before), (number, turn)
            del before[: turn % 3]

    with ThreadPoolExecutor(8) as pool:
        list(pool.map(work, range(8)))


def test_results_in_a_circle_of_references_are_given_back() -> None:
    """By the collector, which runs whenever it likes: also while memory is given back."""

    class Node:
        pass

    forms = {"ratio": Form((1, 1, 10), np.float64)}
    threshold = gc.get_threshold()
    try:
        for number in range(300):
            gc.disable()
            node = Node()
            node.itself = node  # type: ignore[attr-defined]
            node.arrays = shown(memory.block(forms))  # type: ignore[attr-defined]
            gone = weakref.ref(node)
            del node
            arrays = shown(memory.block(forms))
            gc.set_threshold(number % 7 + 1)
            gc.enable()
            del arrays
            gc.collect()
            assert gone() is None
    finally:
        gc.enable()
        gc.set_threshold(*threshold)


def test_a_limit_is_kept(free: deque[Block], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "KEPT_BYTES", 10_000)
    forms = ({"ratio": Form((1, 1, n), np.float64)} for n in (300, 400, 500, 600))
    lent = [shown(memory.block(form)) for form in forms]
    assert not free
    lent.clear()
    # 4800 came first and had to go first
    assert [block.bytes.nbytes for block in free] == [4000, 3200, 2400]
    shown(memory.block({"ratio": Form((1, 1, 5000), np.float64)}))  # too large by itself
    assert sum(block.bytes.nbytes for block in free) <= 10_000


def test_tables_of_all_types_stand_one_after_another() -> None:
    forms = {
        "ratio": Form((2, 3, 7), np.float64),
        "choices": Form((2, 1, 7), np.int16),
        "locked": Form((2, 2, 7), np.bool_),
    }
    block = memory.block(forms)
    for gear, rows in enumerate(block.gears):
        assert [row.dtype for row in rows.arrays] == [np.float64] * 3 + [np.int16] + [np.bool_] * 2
        numbers = [10 * gear + number for number in range(4)]
        rows.lay_out(Layout([], list(enumerate([*numbers, 0, 1]))))
    tables = shown(block)
    assert tables["ratio"][:, :, 0].tolist() == [[0, 1, 2], [10, 11, 12]]
    assert tables["choices"][:, 0].tolist() == [[3] * 7, [13] * 7]
    assert tables["locked"][1, :, 3].tolist() == [False, True]
    assert all((table == table[..., :1]).all() for table in tables.values())


def test_nothing_needs_no_memory() -> None:
    assert shown(memory.block({})) == {}
    empty = shown(memory.block({"ratio": Form((2, 1, 0), np.float64)}))
    assert empty["ratio"].shape == (2, 1, 0)
    assert sweep(-3, variants=0).ratio.shape == (0, 2)
