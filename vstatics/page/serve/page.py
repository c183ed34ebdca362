"""HTML of the served page of a case: the whole page with its panel, or single sections."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import Any

from vstatics.core.annexes import module, report_parts
from vstatics.core.errors import Problem, excerpt
from vstatics.core.statics.results import Results
from vstatics.core.tables.html import Markup, joined, tag
from vstatics.core.texts import Language, speaking, tr
from vstatics.page.report.asked import AskedPage
from vstatics.page.report.html_page import (
    SCRIPT,
    PageFrame,
    about,
    choice,
    framed,
    id_of,
    in_language,
    section_alone,
)
from vstatics.page.report.material import Material, Naming, gather
from vstatics.page.report.tools import toolbar
from vstatics.page.serve import number_fields
from vstatics.page.serve.awaited import QUICK, awaited_pictures, awaited_sections
from vstatics.page.serve.number_fields import PageField, case_fields, shown_fields
from vstatics.pictures.paged.parts import SCREEN, Part

CHANGE = "Change"
"""Heading of the section with fields and sliders."""


def _resource(name: str) -> Markup:
    return Markup((files(__package__) / name).read_text(encoding="utf-8"))


_OWN_SCRIPTS = (number_fields.SCRIPT, _resource("patches.js"), _resource("serve.js"))
_STYLE = joined(toolbar.STYLE, number_fields.STYLE, _resource("serve.css"))


_OF_RUNS = [module(part.scripts) for part in report_parts().values() if part.scripts]
_RUN_SCRIPTS = [script for run_module in _OF_RUNS for script in run_module.SCRIPTS]
"""Scripts of a page that shows a simulated run."""


def _hashed(script: Markup) -> str:
    digest = hashlib.sha256(in_language(script).encode()).digest()
    return f"'sha256-{base64.b64encode(digest).decode()}'"


SCRIPTS = (SCRIPT, toolbar.SCRIPT, *_RUN_SCRIPTS, *_OWN_SCRIPTS)
"""All scripts that a served page can have."""


@cache
def policy_in(language: Language) -> str:
    """Return the content security policy, which allows only `SCRIPTS` and the local server."""
    with speaking(language):
        scripts = " ".join(map(_hashed, SCRIPTS))
    return (
        f"default-src 'none'; script-src {scripts}; "
        "style-src 'unsafe-inline'; connect-src 'self'; base-uri 'none'; form-action 'none'; "
        "frame-ancestors 'none'"
    )


def material_of(
    results: Results, problems: Iterable[Problem], digits: int | None, naming: Naming
) -> Material:
    """Calculate the contents of the page, without pictures and slow sections."""
    return gather(
        results,
        problems,
        digits,
        None,
        naming,
        asked=AskedPage(QUICK),
        has_marks=True,
        drawn=awaited_pictures(results),
    )


def parts_of(material: Material, fields: Sequence[PageField], *, runs: bool) -> list[Part]:
    """Return the sections of the page.

    Without `fields`, the page shows the numbers of the case in disabled fields.
    """
    fixed = not fields
    shown = fields or [*case_fields(material.results.case)]
    changed = Part(CHANGE, [tag("div", *shown_fields(shown, fixed=fixed), class_="fields")])
    first, *others = awaited_sections(material, runs=runs)
    tools = toolbar.tools_of(material.results.case, digits=material.digits)
    # The first section exists on every page, so an update always replaces the data of the tools.
    first = first._replace(shown=[*first.shown, tools])
    return [*([changed] if shown else []), first, *others]


def sections_of(material: Material, parts: Iterable[Part]) -> dict[str, str]:
    """Return the sections as HTML, by id."""
    return {id_of(part.name): section_alone(part, material.document) for part in parts}


def told(problems: Iterable[Problem]) -> str:
    """Return errors as text in the format of compilers, with source line and caret.

    >>> from vstatics.core.errors import Place
    >>> print(told([Problem("E107", "no", (), Place("a.yaml", 2, 3, "a b"))]))
    a.yaml:2:3: error: no [E107]
      a b
        ^
    """
    lines = []
    for problem in problems:
        lines.append(str(problem))
        if problem.place is not None and problem.place.text.strip():
            lines += [f"  {line}" for line in excerpt(problem.place)]
    return "\n".join(lines)


def page_of(
    material: Material, parts: Sequence[Part], *, runs: bool, state: Mapping[str, Any]
) -> str:
    """Return the whole page.

    Parameters
    ----------
    state : mapping
        Initial state for the script of the page; see `ShownStates.told_of`.
    """
    title = _title(material, runs=runs)
    state = {**state, "head": head_of(material, runs=runs)}
    head = [*about(material)]
    return _framed(title, head, parts, material.document, choice(material), state, has_run=runs)


def _title(material: Material, *, runs: bool) -> str:
    return material.naming.title(material.results.case.name, runs=runs)


def head_of(material: Material, *, runs: bool) -> str:
    """Return a hash that changes if the whole page must be reloaded, not only its sections."""
    parts = [_title(material, runs=runs), *about(material), choice(material)]
    return hashlib.sha256("\n".join(parts).encode(errors="backslashreplace")).hexdigest()[:16]


def page_of_errors(file: str, state: Mapping[str, Any]) -> str:
    """Return the page of a case without any valid state, with its errors."""
    return _framed(file, [], [], {}, Markup(), state)


def _framed(  # noqa: PLR0913, PLR0917 - as `framed`
    title: str,
    head: Sequence[Markup],
    parts: Sequence[Part],
    document: dict[str, Any],
    chosen: Markup,
    state: Mapping[str, Any],
    *,
    has_run: bool = False,
) -> str:
    frame = PageFrame(
        choice=chosen,
        panel=joined(toolbar.toolbar(), _panel(state)),
        scripts=[toolbar.SCRIPT, *(_RUN_SCRIPTS if has_run else ()), *_OWN_SCRIPTS],
        style=joined(_STYLE, *(run_module.STYLE for run_module in _OF_RUNS if has_run)),
        policy="",
        state={"data_state": state["state"], "data_digest": state["digest"]},
        revision=state["revision"],
    )
    return framed(title, head, parts, document, frame)


def _panel(state: Mapping[str, Any]) -> Markup:
    """Return the panel of buttons, errors and conflicts, whose empty elements are hidden."""
    errors = state["errors"]
    buttons = {"save": tr("Save"), "revert": tr("Revert"), "undo": tr("Undo")}
    choices = {"keep-mine": tr("Keep my numbers"), "take-file": tr("Take the file")}
    asked = tr(
        "The file was changed by somebody else. "
        "Your numbers can go into the newer file, or be dropped."
    )
    return tag(
        "div",
        tag(
            "div",
            *(
                tag("button", text, id=button_id, hidden=True)
                for button_id, text in buttons.items()
            ),
        ),
        tag("pre", errors, id="errors", role="alert", hidden=not errors),
        tag(
            "div",
            tag("p", asked),
            *(
                tag("button", text, id=button_id, hidden=True)
                for button_id, text in choices.items()
            ),
            id="conflict",
            role="alert",
            hidden=True,
        ),
        tag("p", tr("vstatics serve has ended: nothing is saved any more."), class_="when-gone"),
        id="panel",
        class_=SCREEN,
        data_shown=state["number"],
        data_head=state.get("head", ""),
    )
