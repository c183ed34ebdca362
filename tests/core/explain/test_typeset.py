"""LaTeX of equations is math that can be set, and says what the numbers beside it say."""

import re

import pytest

from tests.chance import seeded
from tests.commands import CASES, vstatics
from tests.shipped import shipped_results
from vstatics.core.explain import Explanation, explain_gear, typeset

MATH = re.compile(r"(?<!\\)\$(.+?)(?<!\\)\$")
SHOWN = ("zf-8hp70", "simpson", "ravigneaux-gf4a", "toyota-p410", "umdm", "two-stage")


def value(formula: str, numbers: dict[str, float]) -> float:
    """Of LaTeX with numbers for its symbols, by the rules of Python."""
    for name in sorted(numbers, key=len, reverse=True):
        formula = formula.replace(name, f"({numbers[name]!r})")
    formula = formula.replace(r"\left", "").replace(r"\right", "")
    while r"\frac" in formula:  # the innermost first
        formula = re.sub(r"\\frac\{([^{}]*)\}\{([^{}]*)\}", r"((\1)/(\2))", formula)
        formula = re.sub(r"\^\{(\d+)\}", r"**\1", formula)
    formula = re.sub(r"\^\{?(\d+)\}?", r"**\1", formula)
    return float(eval(re.sub(r"(?<=[\d)]) ?(?=\()", "*", formula)))  # noqa: S307 - of our own


def explanation(name: str, *options: str, form: str = "latex") -> str:
    return vstatics("explain", CASES / f"{name}.yaml", *options, "-f", form).out


def gears(name: str) -> list[Explanation]:
    results = shipped_results(f"{name}.yaml")
    return [explain_gear(results, gear.name) for gear in results.case.gears]


@pytest.mark.parametrize("name", SHOWN)
def test_a_formula_in_latex_has_the_value_of_the_gear(name: str) -> None:
    for one in gears(name):
        if one.formula is None:
            continue
        numbers = {typeset.symbol(each.name): each.value for each in one.formula.symbols}
        numbers |= {typeset.symbol(key): speed for key, speed in one.formula.speeds.items()}
        found = value(typeset.formula(one.formula), numbers)
        assert found == pytest.approx(one.formula.value, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("name", SHOWN)
def test_coefficients_with_losses_have_the_efficiency_in_their_symbols(name: str) -> None:
    """``u eta^x`` in place of u, as docs/method.md has it."""
    for one in gears(name):
        if one.lossy is None:
            continue
        numbers: dict[str, float] = {}
        for number, sign in enumerate(one.signs, 1):
            for key in (f"_{sign.mechanism}", str(number)):
                numbers |= {f"u{key}": sign.ratio, f"eta{key}": sign.efficiency}
        for term in (term for row in one.lossy.equations for term in row.terms):
            text = term.symbol
            for key in sorted(numbers, key=len, reverse=True):
                text = re.sub(rf"\b{re.escape(key)}\b", f"({numbers[key]!r})", text)
            found = eval(text.replace(") (", ")*("))  # noqa: S307 - of our own
            assert found == pytest.approx(term.coefficient, rel=1e-9)


def test_math_can_be_set_and_tables_have_all_their_cells() -> None:
    mathtext = pytest.importorskip("matplotlib.mathtext").MathTextParser("path")
    name = seeded(3).choice(SHOWN)
    made = explanation(name)
    assert made.count("{") - made.count(r"\{") == made.count("}") - made.count(r"\}")
    assert made.count(r"\begin{tabular}") == made.count(r"\end{tabular}")
    formulas = MATH.findall(made)
    assert any("eta" in one for one in formulas)
    for one in dict.fromkeys(formulas):
        mathtext.parse(f"${one}$")
    for table in re.findall(r"\\begin\{tabular\}(.*?)\\end\{tabular\}", made, re.DOTALL):
        layout, *rows = [line for line in table.splitlines() if line != r"\hline"]
        columns = len(re.findall(r"[lr]|p\{", re.sub(r"\\linewidth", "", layout)))
        assert {len(re.findall(r"(?<!\\)&", row)) + 1 for row in rows} == {columns}
        widths = map(float, re.findall(r"p\{([.\d]+)", layout))
        assert sum(widths) < 1


def test_a_table_stays_below_its_title_and_begins_at_the_margin() -> None:
    """Seen in print: titles alone at the foot of a page, empty lines below cells of two lines."""
    for lang in ("en", "ru"):
        options = ("--solution", "--seed", "3", "--lang", lang)
        made = explanation("simpson-th400", "--gear", "2", *options)
        assert made.count(r"\begin{tabular}") == made.count("\\nobreak\\smallskip\n")
        assert made.count(r"\begin{tabular}") == made.count(r"\noindent\begin{tabular}")
        assert r"\raggedright" in made
        for line in made.splitlines():
            if r"\raggedright" in line:  # it has another use for two backslashes
                assert line.endswith(r"\tabularnewline")
                assert r"\par" not in line
        assert "(-{}-seed 3)" in made  # two hyphens are a dash


def test_names_of_any_letters_are_set() -> None:
    """A name that is no plain word stands as text in its index."""
    assert typeset.symbol("w[Welle & 1]") == r"w_{\mbox{\scriptsize Welle \& 1}}"
    assert typeset.symbol("w_Sonne") == r"w_{\mathrm{Sonne}}"
    assert typeset.symbol("M_вал") == r"M_{\mbox{\scriptsize вал}}"


@pytest.mark.parametrize("lang", ["en", "ru"])
def test_how_torques_count_is_a_list_of_sentences_with_formulas(lang: str) -> None:
    """No heading in bold, and no word of a formula outside math mode."""
    asked = "--gear", "1", "--worksheet", "--lang", lang
    made = explanation("zf-8hp70", *asked)
    [listed] = re.findall(r"\\begin\{itemize\}\n(.*?)\n\\end\{itemize\}", made, re.DOTALL)
    items = listed.split("\n")
    assert all(one.startswith(r"\item ") for one in items)
    assert not re.search(r"eta|_|\\text|\bMx\b", MATH.sub("", listed))
    assert len([one for one in MATH.findall(listed) if "eta" in one]) == 1
    text = explanation("zf-8hp70", *asked, form="text")
    paragraphs = [" ".join(paragraph.split()) for paragraph in text.split("\n\n")]
    for item in items:  # the same sentences as in text
        first = MATH.split(item.removeprefix(r"\item "))[0]
        assert any(paragraph.startswith(first.rstrip()) for paragraph in paragraphs)


@pytest.mark.parametrize("form", ["text", "markdown"])
def test_what_a_symbol_stands_for_is_explained_in_the_language(form: str) -> None:
    """Of planets that are links a symbol tells which gears, in every format."""
    lines = explanation("ford-6r80", "--gear", "1", "--lang", "ru", form=form).splitlines()
    [told] = [line for line in lines if "k1" in line and "rear:" in line]
    assert ("солнечная шестерня" in told, "sun" in told) == (True, False)


def test_tables_wider_or_longer_than_a_page_go_on_in_others_that_name_their_rows() -> None:
    """Seen in print: a matrix 320 pt too wide, and rows below the foot of the page."""
    made = explanation("driveline-8hp70", "--gear", "1")
    found: dict[str, list[list[str]]] = {}
    for title, body in re.findall(r"\\textbf\{([^}]*)\}.*?\\hline\n(.*?)\\end", made, re.DOTALL):
        rows = [line for line in body.splitlines() if line != r"\hline"]
        assert len(rows) <= 1 + 28
        found.setdefault(title, []).append(rows)
    wide = next(parts for title, parts in found.items() if "matrix" in title.lower())
    assert len(wide) > 1
    names = [[row.split(" & ")[0] for row in part[1:]] for part in wide]
    assert names == [names[0]] * len(names)
