"""Numbers of random cases are saved: the file then says the case with these numbers, no more."""

import dataclasses
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from hypothesis import Phase, assume, event, given, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.page.serve.served import BOX, ServedCase, serving
from tests.strategies import transmissions
from vstatics.core import readers
from vstatics.core.elements.part_numbers import with_part_numbers
from vstatics.core.model.parts import Damping
from vstatics.core.model.transmission import Transmission
from vstatics.core.writers.named import write_json, write_yaml
from vstatics.sweep.variants.path_numbers import case_path
from vstatics.sweep.variants.targets import OF_MECHANISM, target

NUMBER = re.compile(r"[-+.0-9eE]*")
Form = tuple[Callable[[Transmission], str], str, str]
FORMS = st.tuples(
    st.sampled_from([write_yaml, write_json]),
    st.sampled_from(["\n", "\r\n", "\r"]),
    st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "utf-32"]),
)
"""How a case is written: its format, the ends of its lines, the encoding."""
FACTORS = st.one_of(st.floats(0.5, 2), st.just(1.0), st.just(-1.0))


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedCase]:
    file = tmp_path_factory.mktemp("case") / "box.yaml"
    file.write_text(BOX, "utf-8")
    with serving(file) as running:
        yield running


def with_number(case: Transmission, path: str, value: float) -> Transmission:
    """A case with another number, as a sweep sets it: without any text."""
    known = case_path(path, case)
    if known and known.part:
        return with_part_numbers(case, [known.part], [value])
    if known and known.quantity in ("speeds", "torques"):
        [(index, quantity, owner)] = known.of
        gears = list(case.gears)
        changed = {**getattr(gears[index or 0], quantity), owner: value}
        gears[index or 0] = replaced(gears[index or 0], quantity, changed)
        return case.replace(gears=gears)
    varied = target(path, case)
    if varied.quantity == "inertia":
        return case.replace(inertias={**case.inertias, varied.owner + 1: value})
    parts = [*case.shift_elements, *case.mechanisms, *case.springs]
    owner = varied.owner + len(case.shift_elements) * (varied.quantity in OF_MECHANISM)
    number = Damping(value) if varied.quantity == "damping" else value
    parts[owner] = replaced(parts[owner], varied.quantity, number)
    ends = [len(case.shift_elements), len(case.shift_elements) + len(case.mechanisms)]
    elements, mechanisms, springs = parts[: ends[0]], parts[ends[0] : ends[1]], parts[ends[1] :]
    return case.replace(shift_elements=elements, mechanisms=mechanisms, springs=springs)


def replaced(part: Any, quantity: str, number: object) -> Any:
    change = dataclasses.replace if dataclasses.is_dataclass(part) else type(part)._replace
    return change(part, **{quantity: number})


def differing(one: str, other: str) -> tuple[str, str]:
    """What is between the same begin and the same end of two texts."""
    shorter = min(len(one), len(other))
    begin = next((n for n in range(shorter) if one[n] != other[n]), shorter)
    rest = shorter - begin
    end = next((n for n in range(rest) if one[-1 - n] != other[-1 - n]), rest)
    return one[begin : len(one) - end], other[begin : len(other) - end]


@settings(phases=[Phase.generate], max_examples=count(8, 120))
@given(st.data(), transmissions(torsional=True), FORMS)
def test_a_saved_number_is_that_of_a_sweep_and_all_else_of_the_file_stays(
    served: ServedCase, data: st.DataObject, case: Transmission, form: Form
) -> None:
    write, line_end, encoding = form
    before = write(case).replace("\n", line_end).encode(encoding)
    served.file.write_bytes(before)
    made = served.save({})
    assume(made.status == 200 and made.told["fields"])  # not every case can be calculated
    fields = made.told["fields"]
    path = data.draw(st.sampled_from(sorted(fields)))
    value = fields[path] * data.draw(FACTORS)
    answer = served.save({path: value})
    after = served.file.read_bytes()
    event(f"status {answer.status}")
    if answer.status != 200:
        assert answer.status == 422
        assert after == before
        return
    old, new = differing(before.decode(encoding), after.decode(encoding))
    assert NUMBER.fullmatch(old)
    assert NUMBER.fullmatch(new)
    read, now = (readers.read(text, "box.yaml").case for text in (before, after))
    assert now == with_number(read, path, value)
