"""Numbers of random documents: each has the same path everywhere and can be saved alone."""

import dataclasses
import json
import re
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from hypothesis import Phase, assume, event, given, settings
from hypothesis import strategies as st

from tests.chance import count, examples
from tests.page.serve.served import BOX, ServedCase, serving
from tests.strategies import transmissions
from vstatics.core import readers
from vstatics.core.comparison.case_changes import case_changes
from vstatics.core.elements.part_numbers import own_part_number, part_numbers, with_part_numbers
from vstatics.core.errors import ReadError
from vstatics.core.model.parts import Damping
from vstatics.core.model.paths import by_name, dotted, in_document, split, written
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.points.paths import columns_of, numbers_of
from vstatics.core.writers.named import write_json, write_yaml
from vstatics.page.serve.document_fields import documents_of, spots_of
from vstatics.simulation.variants.subject import VariedScenario
from vstatics.sweep.variants.path_numbers import CasePath, case_path, own_number_at
from vstatics.sweep.variants.subject import Document, number_of_case
from vstatics.sweep.variants.targets import OF_MECHANISM, Target, own_number, target

NUMBERS = st.floats(0.01, 1000)


def scenario_of(case: Transmission, data: st.DataObject) -> bytes:
    """Return a scenario with numbers in mappings, lists and points, below names of the case."""
    ends = [[0, data.draw(NUMBERS)], [data.draw(NUMBERS), 0]]
    controls = {one.name: data.draw(st.sampled_from([ends, 7.5])) for one in case.shift_elements}
    torques = {link: {"points": ends} for link in case.link_names[: case.own_links]}
    shifts = [{"at": data.draw(NUMBERS), "to": "1", "overlap": 0.25}]
    told = {"case": "box.yaml", "duration": 2, "controls": controls, "torques": torques}
    return json.dumps(told | {"shifts": shifts}, ensure_ascii=False).encode()


def own(found: Target | CasePath, case: Transmission) -> float | None:
    if isinstance(found, Target):
        return own_number(case, found.owner, found.quantity)
    return own_part_number(case, found.part) if found.part else own_number_at(found, case)


def try_out(check: Callable[[st.DataObject, Transmission], None], examples: int) -> None:
    random = given(st.data(), transmissions(torsional=True))(check)
    settings(phases=[Phase.generate], max_examples=examples)(random)()


def check_where_numbers_are_read(data: st.DataObject, case: Transmission) -> None:
    scenario, box = scenario_of(case, data), write_yaml(case).encode()
    varied = VariedScenario(Document(scenario, "run.yaml"), Document(box, "box.yaml"))
    for keys, spot in spots_of("box.yaml", box).items():
        assert tuple(part.name for part in split(written(keys))) == keys
        assert keys in (by_name(keys), *in_document(by_name(keys)))
        path = varied.target(written(keys))
        assert (path.keys, path.of_case) == (keys, True)
        assert varied.written_number(path, None) == spot.value
    for number in documents_of({"run.yaml": scenario, "box.yaml": box}, case).numbers.values():
        if number.file == "run.yaml":
            path = varied.target(number.field.path)
            assert (path.keys, path.of_case) == (number.keys, False)
            assert varied.written_number(path, None) == number.field.value


@examples(3, 14, 120)
def test_sweeps_of_cases_and_scenarios_read_each_number_where_the_document_has_it(
    examples: int,
) -> None:
    try_out(check_where_numbers_are_read, examples)


def check_paths_of_numbers(data: st.DataObject, case: Transmission) -> None:
    # paths of a sweep do not tell these apart: one name of two parts, a name in brackets from a unit;
    # and a name with both kinds of quotes cannot be written as part of a path
    names = [one.name for one in case.shift_elements] + [one.name for one in case.mechanisms]
    assume(len({*names}) == len(names))
    names += [*case.link_names, *(spring.name for spring in case.springs)]
    assume(not any("[" in name or {"'", '"'} <= {*name} for name in names))
    text = write_yaml(case).encode()
    case = readers.read(text, "box.yaml").case
    documents = documents_of({"box.yaml": text}, case)
    run = Document(scenario_of(case, data), "run.yaml")
    varied = VariedScenario(run, Document(text, "box.yaml"))
    known = {**numbers_of(case), **part_numbers(case)}
    for path, (field, _, keys, _) in documents.numbers.items():
        found = number_of_case(path, case)
        assert number_of_case(dotted(keys), case).numbers == found.numbers
        assert varied.target(written(by_name(keys))).keys == keys
        if not field.unit and keys[0] not in ("load", "gears"):  # whose units are their own
            assert own(found, case) == pytest.approx(field.value)
        if isinstance(found, CasePath):
            assert path in known
        if path in numbers_of(case):
            [numbers] = {len(columns_of(case, {path: np.array([0.5])}))}
            assert numbers == len(numbers_of(case)[path])
    if not documents.numbers:
        return
    path = data.draw(st.sampled_from(sorted(documents.numbers)))
    value = documents.numbers[path].field.value
    changed = documents.with_changes({path: 0.75 * value}).get("box.yaml", text)
    try:
        other = readers.read(changed, "box.yaml").case
    except ReadError:
        return
    changes = {change.path for change in case_changes(other, case)}
    event(path.rpartition(".")[2])
    if abs(value) > 1e-3:
        assert path in changes


@examples(4, 14, 120)
def test_a_path_of_the_page_is_that_of_sweep_solve_and_compare(examples: int) -> None:
    try_out(check_paths_of_numbers, examples)


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


@settings(phases=[Phase.generate], max_examples=count(3, 120))
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
