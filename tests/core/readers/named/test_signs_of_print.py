"""Blanks, percentages, ratios and letters as word processors and keyboards have them."""

import json
import re
from fractions import Fraction
from itertools import product
from random import Random

import pytest

from tests.chance import count, seeded
from tests.commands import MZKT
from vstatics import CaseError, ReadError
from vstatics.core.readers import loads, read
from vstatics.core.readers.named.scalars import number
from vstatics.core.suggestions import lookalike

BLANKS = "\u00a0\u202f\u2009"
"""No-break, narrow no-break, thin."""
YAML = """name: A box
links: [shaft 1, shaft 2, out]
load: {speed: 3000 rpm, torque: 300 N*m}
shift_elements:
  B 1: {links: [shaft 2, housing], capacity: 600 N*m}
mechanisms:
  set 1: {first: shaft 1, second: shaft 2, third: out, ratio: -2.5, efficiency: 0.98}
gears:
  low: [B 1]
"""
DECK = MZKT.read_text("utf-8").replace("-.8000Е+00", "-2.5") + "NAME F1: a clutch\n"


def spoilt(text: str, rng: Random) -> str:
    """A text in which any blank may be another one."""
    return "".join(rng.choice(BLANKS + " ") if sign == " " else sign for sign in text)


@pytest.mark.parametrize(("text", "file"), [(YAML, "a.yaml"), (DECK, "a.dat")])
def test_blanks_of_print_are_blanks(text: str, file: str) -> None:
    for seed in range(count(30, 500)):
        case = read(text.encode(), file).case
        other = read(spoilt(text, seeded(5000 + seed)).encode(), file).case
        assert other == case
        assert other.link_names == case.link_names


def test_digits_are_not_grouped() -> None:
    """A blank between digits is refused, whichever it is, with what to write."""
    for blank in BLANKS + " ":
        text = YAML.replace("3000 rpm", f"3{blank}000 rpm")
        with pytest.raises(CaseError, match=r"digits without blanks: 3000"):
            loads(text)
    for grouped, plain in (
        *(("1_000", "1000"), ("1'000", "1000"), ("1.234,56", "1234.56")),
        *(("1_000.5", "1000.5"), ("1'000,25", "1000.25")),
    ):
        with pytest.raises(CaseError, match=f"digits without `.`: {plain}"):
            loads(YAML.replace("3000 rpm", f'"{grouped} rpm"'))


def test_percentages_and_ratios_by_exact_fractions() -> None:
    for seed in range(count(40, 1000)):
        rng = seeded(5200 + seed)
        for _ in range(25):
            above, below = (Fraction(rng.randint(1, 9999), 10 ** rng.randint(0, 3)) for _ in "ab")
            sign = rng.choice(["", "-"])
            left, right = f"{sign}{float(above)!r}", repr(float(below))
            blank = rng.choice(["", " ", "\u00a0"])
            exact = float(Fraction(left)) / float(Fraction(right))
            assert number(f"{left}{blank}:{blank}{right}") == exact
            assert number(f"{left}{blank}%") == float(Fraction(left)) / 100


def test_a_ratio_of_a_data_sheet() -> None:
    text = "links: [a, b]\nmechanisms:\n  g: {}\ngears:\n  '1': []\n"
    flow = "{{first: a, second: b, ratio: {}}}"
    block = "\n    first: a\n    second: b\n    ratio: {}"
    for form in ('"3.55:1"', "3.55:1", "'7.1:2'", "355%", "355 %"):
        for one in (flow, block):
            assert loads(text.format(one.format(form))).mechanisms[0].ratio == pytest.approx(3.55)
    for ratio in ("3.55:1", "3.55 : 1", "355 %"):
        case = {"links": ["a", "b"], "gears": {"1": []}}
        data = {**case, "mechanisms": {"g": {"first": "a", "second": "b", "ratio": ratio}}}
        in_json = loads(json.dumps(data), format="json")
        assert in_json.mechanisms[0].ratio == pytest.approx(3.55)
    for text in ("3:0", "1:2:3", "98%%", "%", "2:", ":2", "98% N*m", "3:1 rpm"):
        with pytest.raises(ValueError, match=r"expected a (number|denominator)"):
            number(text)


PAIRS = dict(zip("АВЕКМНОРСТХаеорсух", "ABEKMHOPCTXaeopcyx", strict=True))
"""Cyrillic letters and the Latin ones that look like them (Unicode confusables)."""


def test_lookalikes_are_named_letter_by_letter() -> None:
    for seed in range(count(100, 2000)):
        rng = seeded(5300 + seed)
        name = "".join(rng.choice([*PAIRS, *PAIRS.values(), "1", "x_"]) for _ in range(6))
        turned = {**PAIRS, **{latin: cyrillic for cyrillic, latin in PAIRS.items()}}
        places = [place for place, letter in enumerate(name) if letter in turned]
        chosen = sorted(rng.sample(places, rng.randint(1, len(places)))) if places else []
        typed = "".join(turned[one] if at in chosen else one for at, one in enumerate(name))
        said = lookalike(typed, ["ratio", name])
        assert said.startswith(f"; did you mean `{name}`? Letter") == bool(chosen)
        for script, others in (("Cyrillic", "Latin"), ("Latin", "Cyrillic")):
            here = [at for at in chosen if (typed[at] in PAIRS) == (script == "Cyrillic")]
            assert (f"{script} in what was read, but {others} in this name" in said) == bool(here)
            for at in here:
                assert str(at + 1) in said


def test_a_case_with_foreign_letters() -> None:
    for change, said in (
        (("[B 1]", "[В 1]"), "did you mean `B 1`. Letter 1, `В`, is Cyrillic in what was read"),
        (("ratio:", "rаtio:"), "did you mean `ratio`. Letter 2, `а`, is Cyrillic in what was"),
        (("third: out", "third: оut"), "did you mean `out`. Letter 1, `о`, is Cyrillic"),
        (("3000 rpm", "3000 rрm"), "did you mean `rpm`. Letter 2, `р`, is Cyrillic"),
        (("ratio: -2.5", "ratio: \u22122.5"), "with `-` instead of `\u2212`"),
    ):
        with pytest.raises(CaseError, match=said):
            loads(YAML.replace(*change))


def test_a_dash_in_a_deck_is_pointed_out() -> None:
    for dash, file in product("\u2212\u2013\u2014", ("a.dat", "a.txt")):
        with pytest.raises(CaseError, match=rf"IAB\(1\): .* \(with `-` instead of `{dash}`\)"):
            read(DECK.replace("-2.5", f"{dash}2.5").encode(), file)


def test_a_ratio_with_blanks_around_its_colon_is_to_be_quoted() -> None:
    """In YAML the colon ends a key there; what the message proposes is read as the ratio."""
    for seed in range(count(12, 300)):
        rng = seeded(seed)
        first, second = rng.randint(1, 99) / rng.choice((1, 10)), rng.randint(1, 9)
        spaced = f"{first:g} : {second}"
        flow, block = (
            "{first: 1, second: 2, ratio: %s}",
            "\n    first: 1\n    second: 2\n    ratio: %s",
        )
        text = f"links: 2\nmechanisms:\n  D: {rng.choice((flow, block))}\ngears: {{'1': []}}\n"
        with pytest.raises(ReadError) as caught:
            loads(text % spaced)
        [problem] = caught.value.problems
        assert problem.id == "E108"
        found = re.search(r"; write a ratio in quotes, ('.*'), or as (.*)", problem.message)
        assert found is not None
        for proposed in found.groups():
            [mechanism] = loads(text % proposed).mechanisms
            assert mechanism.ratio == pytest.approx(first / second)
