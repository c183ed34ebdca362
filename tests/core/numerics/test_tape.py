"""The tape: operations noted once, in slots, up to an end."""

import pytest

from tests.core.numerics.tapes import noted, on_tape, traced
from vstatics.core.numerics.tape import MOST_OPERATIONS, Plain, Tape, Untraceable


def test_the_same_operation_is_noted_once() -> None:
    a, b = traced(2.0, 3.0)
    products = [on_tape(one) for one in (a * b, b * a, -a * b, b * -a)]
    sums = [on_tape(one) for one in (a + b, b + a, -(-a - b))]
    assert [one.sign for one in products] == [1, 1, -1, -1]
    assert noted(a) == [("multiply", 0, 1), ("add", 0, 1)]
    assert len({one.magnitude for one in products}) == len({one.magnitude for one in sums}) == 1
    assert a * 2.0 == 2.0 * a
    assert a + 2.0 == 2.0 + a
    assert noted(a)[2:] == [("multiply", 0, Plain(2.0)), ("add", 0, Plain(2.0))]
    assert a / b != b / a


def test_a_plain_number_is_no_slot() -> None:
    a, b, c = traced(5.0, 7.0, 2.0)
    by_slot = [a * c, a + c, a - c, a / c, c / a]
    by_number = [a * 2.0, a + 2.0, a - 2.0, a / 2.0, 2.0 / a]
    slots = {on_tape(one).magnitude.operand for one in (*by_slot, *by_number)}
    assert len(slots) == len(by_slot) + len(by_number)
    assert ("multiply", 0, Plain(2.0)) in noted(b)
    assert ("multiply", 0, 2) in noted(b)


def test_a_tape_has_an_end() -> None:
    tape = Tape(1)
    for place in range(MOST_OPERATIONS):
        tape.note("add", 0, Plain(float(place)))
    tape.note("add", 0, Plain(1.0))
    with pytest.raises(Untraceable):
        tape.note("add", 0, Plain(-1.0))
