"""`vstatics torsion simplify`: its steps, and the case that it writes."""

from pathlib import Path

import pytest

from tests.commands import CASES, json_answer, vstatics
from tests.processes import names
from tests.torsion.cli.torsional import CHAIN, GOOD, document, said, tables
from vstatics import load

pytestmark = pytest.mark.usefixtures("folder")

OF_GOOD = ("--gear", "direct", "--links", "2")
OF_CHAIN = ("--gear", "1", "--links", "1")


def test_steps_of_a_chain_in_json() -> None:
    """A mass of 1 between springs of 1 and 4: partial ``sqrt(5)``; by hand what is left."""
    made = document("simplify", *OF_CHAIN, text=CHAIN)
    [step] = made["steps"]
    heads = made["format"], made["gear"], made["rule"]
    assert heads == ("vstatics-simplification", "1", "partial")
    assert (step["names"], step["stiffness"]) == (["a", "c"], None)
    assert step["partial_frequency"] == pytest.approx(5**0.5)
    assert step["inertias"] == pytest.approx([4.2, 4.8])
    assert step["compliances"] == pytest.approx([1.25])
    assert step["omegas"] == pytest.approx([((1 / 4.2 + 1 / 4.8) / 1.25) ** 0.5])


def test_of_a_branched_scheme_there_are_matrices() -> None:
    made = document("simplify", *OF_GOOD, text=GOOD)
    assert made["rule"] == "r"
    answer = said("simplify", *OF_GOOD, "-f", "json", "-o", "new.json", text=GOOD)
    assert answer.json == made
    assert [one.name for one in load("new.json").springs] == ["tyre", "damper+axle+wind-up"]
    for step, count in zip(made["steps"], (4, 3), strict=True):
        assert step["compliances"] is None
        assert [len(row) for row in step["stiffness"]] == [count] * count
        assert len(step["inertias"]) == count
    begins = {"jsonl": '{"format": ', "markdown": "# two gears\n", "latex": "\\noindent"}
    for form, begin in begins.items():
        assert said("simplify", *OF_GOOD, "-f", form, text=GOOD).out.startswith(begin)


def test_steps_as_tables() -> None:
    made = document("simplify", *OF_GOOD, text=GOOD)["steps"]
    found = tables(said("simplify", *OF_GOOD, "-f", "csv", text=GOOD).out)
    assert [row[0] for row in found["steps"][1:]] == [step["operation"] for step in made]
    assert [row[0] for row in found["masses"][1:]] == made[-1]["names"]
    assert [float(row[1]) for row in found["masses"][1:]] == made[-1]["inertias"]
    assert found["springs"][2][:2] == ["damper+axle+wind-up", "1*engine -1*wheel"]
    shown = said("simplify", *OF_GOOD, text=GOOD).out
    titles = ["Masses", "Springs"]
    assert [line for line in shown.splitlines() if line in titles] == titles


OF_TEETH = (CASES / "moskvich412.yaml").read_text("utf-8")
WRITTEN = [
    (CHAIN, OF_CHAIN), (CHAIN, (*OF_CHAIN, "--remove", "c")), (GOOD, OF_GOOD),
    (GOOD, ("--gear", "direct", "--links", "4")),
    *((GOOD, (*OF_GOOD, "--rule", rule)) for rule in "rbu"),
    (GOOD, (*OF_GOOD, "--remove", "casing, disc")),
    (OF_TEETH, ("--gear", "1", "--links", "3")),
]  # fmt: skip


@pytest.mark.parametrize(("text", "options"), WRITTEN)
def test_the_written_case_runs_and_vibrates_as_stated(text: str, options: tuple[str, ...]) -> None:
    for output in ("simple.yaml", "simple.json"):
        answer = said("simplify", *options, "-o", output, "-f", "json", text=text)
        assert (answer.status, names()) == (0, [output])
        steps = answer.json["steps"]
        given = said("modes", "-f", "json", text=text).json["gears"][0]["modes"]
        expected = steps[-1]["omegas"] if steps else [mode["omega"] for mode in given]
        [gear] = json_answer("torsion", "modes", output)["gears"]
        assert gear["name"] == options[1]
        assert [mode["omega"] for mode in gear["modes"]] == pytest.approx(expected)
        ran = vstatics("run", output, "--strict")
        assert ran.is_without_messages()
        assert vstatics("check", output, "--strict").status == 0
        Path(output).unlink()


def test_the_name_of_a_mass_may_have_commas() -> None:
    text = CHAIN.replace("b:", '"b, x":').replace("b]", '"b, x"]').replace("[b,", '["b, x",')
    made = document("simplify", *OF_CHAIN, "--remove", '"b, x"', text=text)
    assert made["steps"][0]["operation"] == "remove b, x"
    assert said("simplify", *OF_CHAIN, "--remove", "b, x", text=text).status == 1


def test_a_frequency_above_half_of_a_partial_one_is_doubtful() -> None:
    options = ("simplify", *OF_GOOD, "--remove", "disc,wheel")
    answer = said(*options, text=GOOD)
    assert answer.status == 0
    assert answer.err.startswith("<stdin>: warning: ")
    assert "is more than half of the removed partial frequency" in answer.err
    strict = said(*options, "--strict", "-q", "-o", "new.yaml", text=GOOD)
    assert (strict.status, strict.out, names()) == (1, answer.out, ["new.yaml"])
    assert "1 warning (W502), so --strict fails" in strict.err


def test_a_loss_factor_is_left_out_with_a_warning() -> None:
    text = GOOD.replace("stiffness: 474", "stiffness: 474, damping: {ratio: .02}")
    answer = said("simplify", *OF_GOOD, text=text)
    assert answer.status == 0
    assert "warning: the loss factor of tyre is omitted" in answer.err


def test_what_the_scheme_does_not_have() -> None:
    Path("kept.yaml").write_text("kept", "utf-8")
    for options, words in (
        (("--links", "5"), "read 5 natural frequencies to remain (--links), expected 1 to 4"),
        *((("--links", "2", "--remove", one), "read `` to remove") for one in ("", "disc,")),
        (("--links", "2", "--rule", "partial"), "the system is not a chain, `axle` is not a shaft"),
    ):
        answer = said("simplify", "--gear", "direct", *options, "-o", "kept.yaml", text=GOOD)
        assert answer.gives_nothing("<stdin>: error: ", words), options
    assert Path("kept.yaml").read_text("utf-8") == "kept"


def test_wrong_use() -> None:
    for options in (
        ("--gear", "direct"), (*OF_GOOD, "--rule", "x"),
        *((*OF_GOOD, "--links", one) for one in ("0", "-1", "1.5", "nan", "inf", "", "1e3")),
        *((*OF_GOOD, "-f", one) for one in ("xlsx", "yaml", "")),
        *((*OF_GOOD, "-o", one) for one in ("new.csv", "new.dat", "new", "new/")),
    ):  # fmt: skip
        answer = said("simplify", *options, text=GOOD)
        assert (answer.status, answer.out, names()) == (2, "", []), options


def test_masses_that_turn_as_one() -> None:
    """Two wheels of 1 kg*m^2 on 1 N*m/rad each: one of 2 on 2, against 4: sqrt(1.5)."""
    fork = (
        "inertias: {axle: 4, left: 1, right: 1}\nsprings: {l: {links: [axle, left], stiffness: 1}, "
    )
    fork += "r: {links: [axle, right], stiffness: 1}}\n"
    call = ("simplify", "--links", "1", "--merge")
    answer = said(*call, "left+right", "-f", "json", "-o", "one.yaml", text=fork)
    [step] = answer.json["steps"]
    assert step["operation"] == "merge left and right"
    assert step["omegas"] == pytest.approx([1.5**0.5])
    assert sorted(load("one.yaml").inertias.values()) == [2.0, 4.0]
    told = "<stdin>: error: read `left+rihgt` to merge, expected two links"
    assert said(*call, "left+rihgt", text=fork).fails(told, "did you mean `right`?")
