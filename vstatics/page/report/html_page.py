"""Layout of the HTML page: head, sections, style sheet, scripts and embedded data."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib.resources import files
from typing import Any, NamedTuple

from vstatics.core.tables.html import Markup, filled, joined, printed, tag
from vstatics.core.texts import spoken, tr
from vstatics.page.report.asked import SECTIONS
from vstatics.page.report.material import Material
from vstatics.page.report.parts import chooser
from vstatics.page.report.sections import sections
from vstatics.pictures.drawing.style import FAMILIES, SIZE
from vstatics.pictures.paged.inline import palette, shared
from vstatics.pictures.paged.parts import SCREEN, Part

POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'"
"""Content security policy, which keeps browsers from loading anything for the page."""
NOTHING = Markup()


class PageFrame(NamedTuple):
    """Contents of a page around its sections."""

    choice: Markup = NOTHING
    """Links that choose a gear, visible while the page scrolls."""
    panel: Markup = NOTHING
    """Panel below the title of the page, with buttons and errors."""
    scripts: Sequence[Markup] = ()
    """Additional scripts, after the script of every page."""
    end: Markup = NOTHING
    """Contents after the sections, such as scripts that contain names of the case."""
    style: Markup = NOTHING
    policy: str = POLICY
    """Content security policy in the page; empty if a server sends the policy as a header."""
    state: Mapping[str, object] = {}
    """Attributes of the HTML element `body`."""
    revision: int | None = None
    """Number of the first state on a served page."""
    named: object = None
    """Plain data whose names are not translated; by default the case in the document."""


BARE = PageFrame()


def _resource(name: str) -> Markup:
    return Markup((files(__package__) / name).read_text(encoding="utf-8"))


SCRIPT = _resource("script.js")
"""Script of every page, for gears and tables."""


_LITERAL = re.compile(r'"((?:[^"\\\n]|\\u\w{4})*)"|`([^`\\\n]*)`')
"""String literal in a script, with quotes or backquotes."""


def in_language(script: Markup) -> Markup:
    """Translate the visible texts of a script into the language of the page.

    A text is visible if it begins with a capital letter or contains a blank; no key in the scripts
    does.

    >>> from vstatics.core.texts import speaking
    >>> with speaking("ru"):
    ...     print(in_language(Markup('say("Sort", `Gear ${name}`, "none")')))
    say("Сортировать", `Передача ${name}`, "none")
    """

    def translated(match: re.Match[str]) -> str:
        text = json.loads(match[0]) if match[1] else (match[2] or "").replace("${", "{")
        translation = tr(text) if text[:1].isupper() or " " in text else text
        if translation == text:
            return match[0]
        return (
            json.dumps(translation, ensure_ascii=False)
            if match[1]
            else f"`{translation.replace('{', '${')}`"
        )

    return script if spoken() == "en" else Markup(_LITERAL.sub(translated, script))


def page(material: Material) -> str:
    """Return the page of a case as HTML.

    Parameters
    ----------
    material : Material
        Contents of the page, from `gather`.
    """
    case = material.results.case
    title = material.naming.title(case.name, runs=material.has_run)
    parts = list(sections(material))
    return framed(title, about(material), parts, material.document, PageFrame(choice(material)))


def choice(material: Material) -> Markup:
    """Return the links that choose a gear, empty if no gear is shown."""
    gears = material.results.case.gears
    names = [gear.name for gear in gears if material.asked.shows(gear.name)]
    return chooser(names) if names else NOTHING


def framed(
    title: str,
    notes: Iterable[Markup],
    parts: Sequence[Part],
    document: dict[str, Any],
    frame: PageFrame = BARE,
) -> str:
    """Return a page of sections, with table of contents, style sheet and embedded data.

    Parameters
    ----------
    notes : iterable of Markup
        Texts below the title.
    document : dict
        Data that the page contains as JSON.
    frame : PageFrame, optional
        Contents around the sections.
    """
    links = (tag("a", tr(part.name), href=f"#{id_of(part.name)}") for part in parts)
    contents = tag("nav", *links, class_="contents", aria_label=tr("Contents"))
    shown = tag("main", *map(_section, parts))
    main, looks = shared(printed(shown, _names(frame.named or document.get("case"))))
    data = json.dumps(document, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    data = data.replace("<", "\\u003c")  # text in the data cannot end the script element
    body = tag(
        "body",
        tag("header", tag("h1", title), *notes, contents),
        frame.panel,
        frame.choice,
        main,
        tag("script", Markup(data), type="application/json", id="result"),
        *(tag("script", in_language(script)) for script in (SCRIPT, *frame.scripts)),
        frame.end,
        **frame.state,
    )
    policy = tag("meta", http_equiv="Content-Security-Policy", content=frame.policy)
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        policy if frame.policy else NOTHING,
        tag("title", title),
        tag("style", _styles(title), looks, frame.style),
    )
    root: dict[str, object] = {"lang": spoken()}
    if frame.revision is not None:
        root["data_revision"] = frame.revision
    return f"<!DOCTYPE html>\n{tag('html', head, body, **root)}\n"


def stamped_page(
    title: str,
    stamp: Mapping[str, str],
    notes: Iterable[Markup],
    parts: Sequence[Part],
    document: dict[str, Any],
) -> str:
    """Return the page of a document that is not a case; parameters as in `framed`."""
    return framed(title, [*stamped(stamp), *notes], parts, document)


def shown_alone(part: Part, document: Mapping[str, Any]) -> Markup:
    """Return the contents of a section; names from the document are not translated."""
    return printed(joined(*part.shown), _names(document.get("case")))


def section_alone(part: Part, document: Mapping[str, Any]) -> Markup:
    """Return a section with its heading; names from the document are not translated."""
    return printed(_section(part), _names(document.get("case")))


def _section(part: Part) -> Markup:
    look = False if part.is_printed else SCREEN
    return tag("section", tag("h2", tr(part.name)), *part.shown, id=id_of(part.name), class_=look)


def stamped(stamp: Mapping[str, str]) -> Iterator[Markup]:
    """Yield the stamp of a page, with entries such as author and project, if it has any.

    >>> print(*stamped({"author": "A < B"}))
    <dl class="stamp"><div><dt>author</dt><dd>A &lt; B</dd></div></dl>
    """
    if stamp:
        shown = (tag("div", tag("dt", name), tag("dd", text)) for name, text in stamp.items())
        yield tag("dl", *shown, class_="stamp")


def about(material: Material) -> Iterator[Markup]:
    """Yield the texts below the title on the page of a case."""
    case = material.results.case
    yield from stamped(material.asked.stamp)
    if material.has_run:
        link = tag("a", tr(SECTIONS["run"]), href=f"#{id_of(SECTIONS['run'])}")
        description = f": {material.naming.description}" if material.naming.description else ""
        yield tag("p", filled(tr("Scenario, see {link}"), link=link), description, class_="told")
    if material.asked.gears:
        names = ", ".join(material.asked.gears)
        note = tr(
            "Shown of {number} gears: {names}. Figures of the whole are of all gears.",
            number=len(case.gears),
            names=names,
        )
        yield tag("p", note, class_="told")
    if case.description:
        yield tag("p", case.description, class_="told")
    if case.source:
        yield tag("p", filled(tr("Source: {source}"), source=case.source), class_="told source")


def _names(data: Any) -> Iterator[str]:
    """Yield all texts in plain data, including all names.

    >>> [*_names({"links": ["in", "-3"], "gears": {"R": {"speeds": {"in": 1}}}})]
    ['links', 'in', '-3', 'gears', 'R', 'speeds', 'in']
    """
    if isinstance(data, str):
        yield data
    elif isinstance(data, dict | list):
        for item in data:
            yield from _names(item)
            if isinstance(data, dict):
                yield from _names(data[item])


def id_of(name: str) -> str:
    """Return the id of a section, which does not depend on the language.

    >>> id_of("Power flow")
    'power-flow'
    """
    return name.lower().replace(" ", "-")


def _styles(title: str) -> Markup:
    dark = f"@media screen and (prefers-color-scheme: dark) {{ :root {{ {palette(dark=True)} }} }}"
    light = f":root {{ {palette(dark=False)} }}"
    letters = (
        f"figure svg {{ font: {SIZE}px {FAMILIES}; fill: var(--ink); stroke-linejoin: round; }}"
    )
    running = f"@page {{ @top-left {{ content: {_quoted(title)}; }} }}"
    return joined(
        *map(Markup, (f"{rule}\n" for rule in (light, dark, letters, running))),
        _resource("style.css"),
        _resource("print.css"),
    )


def _quoted(text: str) -> str:
    """Return a text quoted for a style sheet, escaped so that it cannot end the style element.

    >>> print(_quoted('a "b" </style>'))
    "a \\22 b\\22  \\3c \\2f style\\3e "
    """
    inner = "".join(
        letter if letter.isalnum() or letter == " " else f"\\{ord(letter):x} " for letter in text
    )
    return f'"{inner}"'
