"""Pages and texts in another language have no English words but those of the case."""

import html
import re
from collections.abc import Iterator
from typing import Any

import pytest

from tests.commands import CASES, json_answer, vstatics

SYMBOLS = {
    *("eta", "first", "second", "third", "published", "null", "input", "output", "omega", "phi"),
    *("KLG", "AMLG", "AMLGP", "WFRI", "WSAT", "AMWZ", "AMWZP", "ETA", "CSV", "JSON", "YAML"),
    *("dETA", "all", "YAML", "rad", "MESH", "MESHP", "SVG", "lbf", "vstatics", "simulate", "serve"),
}
"""Letters of equations and keys, which no language changes."""
LATEX = {
    *("NAME", "ABCDE", "begin", "end", "tabular", "hline", "noindent", "textbf", "par", "medskip"),
    *("textasciicircum", "bullet", "cdot", "footnotesize", "setlength", "tabcolsep", "linewidth"),
    *("raggedright", "tabularnewline", "nobreak", "smallskip", "shortstack", "frac", "mathrm"),
    *("mbox", "textasciitilde", "scriptsize", "left", "right"),
}
SHOWN = str(CASES / "simpson.yaml")


def names(data: Any) -> Iterator[str]:
    """All words of plain data."""
    if isinstance(data, str):
        yield from re.findall("[A-Za-z]+", data)
    elif isinstance(data, dict):
        for key, one in data.items():
            yield from names(key)
            yield from names(one)
    elif isinstance(data, list):
        for one in data:
            yield from names(one)


def of_case(document: dict[str, Any]) -> set[str]:
    """Words that a result may have in any language: those of its case, its keys, its messages."""
    kept = {key: document.get(key) for key in ("case", "rows", "messages")}
    return {*names(kept), *names([*document]), *SYMBOLS}


def left(text: str, known: set[str]) -> set[str]:
    """Latin words of three letters that a name does not explain."""
    return {word for word in re.findall("[A-Za-z]{3,}", text) if word not in known}


def words_of(page: str) -> str:
    """What a page shows or tells those who do not see it; formulas stand in `pre`."""
    body = page[page.index("<body") :]
    body = re.sub(r"<script.*?</script>", "", body, flags=re.DOTALL)
    body = re.sub(r'<li class="(error|warning|note)">.*?</li>', "", body)  # messages
    found = re.findall(r'(?<=>)[^<>]+(?=<)|(?<=aria-label=")[^"]+|(?<= title=")[^"]+', body)
    told = (one for one in found if "не нарисовано" not in one)  # what follows is a message
    return html.unescape("\n".join(told))


@pytest.mark.parametrize("command", ["run", "summary", "explain", "flow"])
@pytest.mark.parametrize("form", [(), ("-f", "markdown"), ("-f", "latex")])
def test_a_command_has_no_english_words(command: str, form: tuple[str, ...]) -> None:
    known = of_case(json_answer("run", SHOWN))
    known |= LATEX
    text = vstatics(command, SHOWN, "--lang", "ru", *form).out
    text = re.sub(r"(?m)^.*(\(I|\([A-Z]+\(|[A-Z]+= |[A-Z]+\(J\)).*$|\\begin\{tabular\}.*", "", text)
    assert left(text, known) == set()


@pytest.mark.parametrize("command", ["run", "summary", "explain", "flow"])
@pytest.mark.parametrize("form", ["json", "csv"])
def test_what_programs_read_is_the_same_in_every_language(command: str, form: str) -> None:
    plain = vstatics(command, SHOWN, "-f", form).out
    assert vstatics(command, SHOWN, "-f", form, "--lang", "ru").out == plain
