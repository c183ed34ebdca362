"""The table of texts is whole: what is said has a row, and every row is said somewhere."""

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from string import Formatter

import pytest

from tests.installed import ANNEXES, needs
from tests.rooms import PACKAGE, nodes
from vstatics.core.tables.html import Markup
from vstatics.core.texts import FORMS, heading, rows, speaking, table, tr

SAYING = {"tr", "word", "translated", "text", "filled"}
"""Functions whose first argument is a text; `text` of pictures, and of columns of tables."""
ROOMS_WITH_TABLES = ("tables", "summary", "explain", "report", "flow", "operation")
"""Their tables are shown in every language; those of other commands are English."""
MADE = (
    *("lost", "kJ", "{count} error", "{count} warning", "{count} note", "neutral: the output"),
    *("Other combinations", "power enters by", "power leaves by", "the gear is", "x by the "),
    *("Torques of mechanisms, springs", "Torques of the members of the elements, of springs"),
    *("{number} of {count} ", "turns a second"),
)
"""Beginnings of texts that are made of words, each of them said."""


SCRIPTS = {
    path.name: path.read_text("utf-8")
    for room in ("page", "simulation/report")
    for path in sorted((PACKAGE / room).rglob("*.js"))
    if ".min." not in path.name
}
"""Of pages; the plotter says nothing."""


@cache
def literals() -> set[str]:
    """All texts in the sources."""
    quoted = r'"([^"\n]*)"|`([^`\n]*)`'
    found = {pair for script in SCRIPTS.values() for pair in re.findall(quoted, script)}
    said = {one.replace("${", "{") for pair in found for one in pair}
    said |= {one.encode().decode("unicode_escape") for one in said if r"\u" in one}
    for path in PACKAGE.rglob("*.py"):
        for node in nodes(path):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                said |= {node.value, node.value.replace("_", " ")}
    return said


def asked() -> Iterator[str]:
    """Texts that functions are given to say."""
    for path in PACKAGE.rglob("*.py"):
        has_tables = not {*path.relative_to(PACKAGE).parts}.isdisjoint(ROOMS_WITH_TABLES)
        for node in nodes(path):
            if not isinstance(node, ast.Call) or not node.args:
                continue
            name = node.func.id if isinstance(node.func, ast.Name) else ""
            if isinstance(node.func, ast.Attribute) and node.func.attr == "text":
                name = "text" if "style" in ast.unparse(node.func.value) else ""
            if name == "text" and not has_tables and "pictures" not in path.parts:
                continue
            parts = node.args[:1] if name in SAYING else []
            if name == "grid_of" and has_tables:
                parts = node.args[:2]
            for part in parts:
                inner = part.elts if isinstance(part, ast.Tuple | ast.List) else [part]
                for one in inner:
                    if isinstance(one, ast.Constant) and isinstance(one.value, str) and one.value:
                        yield one.value


@pytest.mark.slow
def test_a_text_that_is_said_has_its_row() -> None:
    said = {*asked()}
    assert len(said) > 300
    with speaking("ru"):
        without = {text for text in said if not re.search("[A-Za-z]", text)}
        without |= {text for text in said if heading(text) != text}
    same = {row["en"] for row in rows() if row["ru"] == row["en"]}
    assert said - without - same == set()


@pytest.mark.slow
@needs(*ANNEXES)
def test_a_row_is_said_somewhere() -> None:
    known = literals()
    for row in rows():
        text = row["en"]
        begun = any(one.startswith((f"{text}, ", f"{text} [")) for one in known)
        with_unit = {*text.rpartition(", ")[::2]} <= known
        is_unit = any(f"[{text}]" in one or one.endswith(f", {text}") for one in known)
        is_made = is_unit or any(text.startswith(one) for one in MADE)
        is_literal = not known.isdisjoint({text, f"{text[0].lower()}{text[1:]}"})
        assert is_literal or begun or with_unit or is_made, text


def places(text: str) -> set[str]:
    return {name for _, name, _, _ in Formatter().parse(text) if name is not None}


def test_a_row_has_its_places_its_forms_and_letters_of_its_language() -> None:
    for row in rows():
        english, text = row["en"], row["ru"]
        assert text == text.rstrip() != ""
        assert text[0].isspace() == english[0].isspace(), row
        assert not re.search("[а-яА-Я]", english), row
        if "scroller" not in text:  # a place of a script
            assert places(text) == places(english), row
        count = english.count(FORMS) + 1
        assert text.count(FORMS) + 1 == (3 if count > 1 else 1), row


def test_no_text_has_two_rows_and_all_are_in_the_order_of_the_english_texts() -> None:
    assert len({row["en"] for row in rows()}) == len(rows())
    assert [*table("ru")] == [row["en"] for row in rows()]
    order = [row["en"].replace("\n", r"\n").strip(" ,;(").lower() for row in rows()]
    assert order == sorted(order)


TERMS = {
    r"\bsun(s|2)?\b": r"солн(ечн|\.)",
    r"\brings?\b": "эпицикл",
    r"\bcarriers?\b": "водил",
    r"\bplanets?\b|^(short|long)$": r"сат(еллит|\.)",
    r"\bfreewheels?\b": "муфт.* своб",
    r"\bhousing\b": "корпус",
    r"\bshift elements?\b": "элемент.* управления",
    r"\bmechanisms?\b": "механизм",
    r"\b(not |nothing )?engaged\b": "включ",
    r"^open$|\bopen ones\b|\bwhen open\b": "выключен",
    r"^opens$": "выключается",
    r"^closes$": "включается",
    r"\bneutral$|\bneutral:": "нейтраль",
    r"\btied up\b": "заблокирована",
    r"\blocked by friction\b": "заклинена трением",
    r"\bself-locking\b": "самотормоз",
    r"\binternal ratio\b|\bbasic ratios\b|\bRatios, third link held": "внутренн(ее|ему|ие|им)",
    r"\befficienc(y|ies)\b": "КПД",
    r"\bfires\b": "порядок вспышек",
    r"\blever diagram$|^levers$": "рычажная схема",
    r"\bslips?$|^slip,": "скольжение|скольз|буксу",
    r"\bdamping ratio\b": "относительное затухание",
}
"""Words of the field: what an English one is in Russian."""
MEANINGS_OF_CAPITALS = {"change", "input"}
"""A button and what is changed; what is given and the link."""


def test_a_term_is_always_the_same_word() -> None:
    without_places = [(re.sub(r"\{.*?\}", "", row["en"]), row) for row in rows()]
    for term, said in TERMS.items():
        found = [row for text, row in without_places if re.search(term, text, re.IGNORECASE)]
        assert found, term
        for row in found:
            assert re.search(said, row["ru"], re.IGNORECASE), row


def test_a_text_with_a_capital_is_said_as_the_one_without() -> None:
    known: dict[str, dict[str, str]] = {}
    for row in rows():
        first = known.setdefault(row["en"].lower(), row)
        if row["en"].lower() in MEANINGS_OF_CAPITALS:
            continue
        assert row["ru"].lower() == first["ru"].lower(), (row, first)


def test_russian_writes_a_word_with_one_letter() -> None:
    """Either with ё or with е, but where these are two words."""
    words = set(re.findall("[а-яё]+", " ".join(row["ru"] for row in rows()).lower()))
    both = {one for one in words if "ё" in one and one.replace("ё", "е") in words}
    assert both <= {"всё"}
    assert words.isdisjoint({"учетом", "расчет", "еще", "вперед", "ее", "дает", "счет"})


@needs("page")
def test_a_script_says_what_it_says_in_the_language() -> None:
    """Of its literals those with a capital letter and others behind it, but keys and code."""
    code = {"Enter", "ArrowLeft", "NaN", "Escape", "DOMContentLoaded", "If-Match", "AbortError"}
    said = {
        one
        for script in SCRIPTS.values()
        for one in re.findall(r'"([A-Z][a-z]+[^"\\\n]*)"', script)
        if one not in code
    }
    assert len(said) > 5
    assert said <= table("ru").keys()


@needs("page")
def test_a_script_compares_nothing_that_it_says_in_a_language() -> None:
    """What a language changes is shown: no name of an event, no key, no kind of picture."""
    from vstatics.page.report.html_page import in_language

    for name, script in SCRIPTS.items():
        with speaking("ru"):
            made = in_language(Markup(script))
        changed = {
            one
            for one in re.findall(r'"[^"\n]*"|`[^`\n]*`', script)
            if made.count(one) < script.count(one)
        }
        for one in changed:
            text = re.escape(one)
            assert not re.search(f"[!=]== *{text}|{text} *[!=]==|case *{text}", script), (name, one)


def test_what_is_said_within_is_in_the_language_and_then_english_again() -> None:
    with speaking("ru"):
        assert tr("ratio") == "передаточное отношение"
        with speaking("en"):
            assert tr("ratio") == "ratio"
        assert tr("ratio") == "передаточное отношение"
    assert tr("ratio") == "ratio"


def test_russian_forms_follow_the_last_digits() -> None:
    """As grammars have it: 1, 21, 101; 2 to 4, 22; all others, 11 to 14 among them."""
    for count in (0, 1, 2, 4, 5, 11, 12, 14, 21, 22, 25, 101, 111):
        last, teen = count % 10, 10 < count % 100 < 20
        ending = "й" if teen or last in (0, *range(5, 10)) else "е" if last == 1 else "я"
        with speaking("ru"):
            said = tr("{count} warning|{count} warnings", count=count)
        assert said == f"{count} предупреждени{ending}"
    assert tr("{count} warning|{count} warnings", count=1) == "1 warning"


GLOSSARY = Path(__file__).parents[3] / "docs" / "glossary.md"


def test_the_first_word_of_a_cell_of_the_glossary_is_the_one_that_the_program_says() -> None:
    """Four terms are of documents alone; each term has one row and two languages."""
    said: dict[str, set[str]] = {}
    for row in rows():
        said.setdefault(row["en"].lower(), set()).add(row["ru"].lower())
    lines = [line.split("|")[1:-1] for line in GLOSSARY.read_text("utf-8").splitlines()]
    cells = [[cell.partition(",")[0].strip().lower() for cell in line[:2]] for line in lines]
    terms = [pair for pair in cells if pair and pair[0] not in ("english", "---")]
    assert len({english for english, _ in terms}) == len(terms)
    foreign = {"willis equation", "sensitivity", "rolling power", "coupling power"}
    assert {english for english, _ in terms} - said.keys() == foreign
    for english, russian in terms:
        assert english in foreign or russian in said[english], english
        assert re.search("[а-яё]|кпд", russian), english
