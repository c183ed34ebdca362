"""The page: its head, its sections, its look, the data that it carries."""

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
from vstatics.pictures.drawing.style import FAMILIES
from vstatics.pictures.paged.inline import palette, shared
from vstatics.pictures.paged.parts import SCREEN, Part

POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'"
"""A browser loads nothing from anywhere."""
NOTHING = Markup()


class PageFrame(NamedTuple):
    """What stands around the sections of a page."""

    choice: Markup = NOTHING
    """Stays in sight: what is chosen for several sections."""
    panel: Markup = NOTHING
    """Below the head of the page."""
    scripts: Sequence[Markup] = ()
    """After the page's own."""
    end: Markup = NOTHING
    """What stands at the end of the page, such as scripts with names."""
    style: Markup = NOTHING
    policy: str = POLICY
    """Nothing where whoever sends the page says it."""
    state: Mapping[str, object] = {}
    """Attributes of the body."""
    revision: int | None = None
    """The first one that is shown, for the attribute of the page."""
    named: object = None
    """Plain data with names, which stay as they are; else the case of the document."""


BARE = PageFrame()


def _resource(name: str) -> Markup:
    return Markup((files(__package__) / name).read_text(encoding="utf-8"))


SCRIPT = _resource("script.js")
"""Of every page: its gears and tables."""


_LITERAL = re.compile(r'"((?:[^"\\\n]|\\u\w{4})*)"|`([^`\\\n]*)`')
"""A text in a script."""


def in_language(script: Markup) -> Markup:
    """A script with what it says in the language that is spoken.

    That begins with a capital letter or has a blank, as nothing does that it compares.

    >>> from vstatics.core.texts import speaking
    >>> with speaking("ru"):
    ...     print(in_language(Markup('say("Sort", `Gear ${name}`, "none")')))
    say("Сортировать", `Передача ${name}`, "none")
    """

    def said(found: re.Match[str]) -> str:
        text = json.loads(found[0]) if found[1] else (found[2] or "").replace("${", "{")
        own = tr(text) if text[:1].isupper() or " " in text else text
        if own == text:
            return found[0]
        return json.dumps(own, ensure_ascii=False) if found[1] else f"`{own.replace('{', '${')}`"

    return script if spoken() == "en" else Markup(_LITERAL.sub(said, script))


def page(material: Material) -> str:
    """The whole page, as HTML.

    Parameters
    ----------
    material : Material
        See `gather`.
    """
    case = material.results.case
    title = material.naming.title(case.name, runs=material.has_run)
    parts = list(sections(material))
    return framed(title, about(material), parts, material.document, PageFrame(choice(material)))


def choice(material: Material) -> Markup:
    """What chooses a gear, if there is one."""
    gears = material.results.case.gears
    names = [gear.name for gear in gears if material.asked.shows(gear.name)]
    return chooser(names) if names else NOTHING


def framed(
    title: str,
    told: Iterable[Markup],
    parts: Sequence[Part],
    document: dict[str, Any],
    frame: PageFrame = BARE,
) -> str:
    """A page of sections with its contents, its look and the data that it carries.

    Parameters
    ----------
    told : iterable of Markup
        What stands below the title.
    document : dict
        What the page shows, as JSON.
    frame : PageFrame, optional
        What stands around them.
    """
    links = (tag("a", tr(part.name), href=f"#{id_of(part.name)}") for part in parts)
    contents = tag("nav", *links, class_="contents", aria_label=tr("Contents"))
    shown = tag("main", *map(_section, parts))
    main, looks = shared(printed(shown, _names(frame.named or document.get("case"))))
    data = json.dumps(document, ensure_ascii=False, allow_nan=False)
    data = data.replace("<", "\\u003c")  # no text of the case ends the script that it stands in
    body = tag(
        "body",
        tag("header", tag("h1", title), *told, contents),
        frame.panel,
        frame.choice,
        main,
        tag("script", Markup(data), type="application/json", id="result"),
        *(tag("script", in_language(one)) for one in (SCRIPT, *frame.scripts)),
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
    told: Iterable[Markup],
    parts: Sequence[Part],
    document: dict[str, Any],
) -> str:
    """Return a page of another document than a case; parameters as of `framed` and `stamped`."""
    return framed(title, [*stamped(stamp), *told], parts, document)


def shown_alone(part: Part, document: Mapping[str, Any]) -> Markup:
    """What a section shows below its heading, as it stands on the page of a document."""
    return printed(joined(*part.shown), _names(document.get("case")))


def section_alone(part: Part, document: Mapping[str, Any]) -> Markup:
    """A section with its heading, as it stands on the page of a document."""
    return printed(_section(part), _names(document.get("case")))


def _section(part: Part) -> Markup:
    look = False if part.is_printed else SCREEN
    return tag("section", tag("h2", tr(part.name)), *part.shown, id=id_of(part.name), class_=look)


def stamped(stamp: Mapping[str, str]) -> Iterator[Markup]:
    """The head that says whose a page is, if anything does.

    >>> print(*stamped({"author": "A < B"}))
    <dl class="stamp"><div><dt>author</dt><dd>A &lt; B</dd></div></dl>
    """
    if stamp:
        shown = (tag("div", tag("dt", name), tag("dd", text)) for name, text in stamp.items())
        yield tag("dl", *shown, class_="stamp")


def about(material: Material) -> Iterator[Markup]:
    """What stands below the title of the page of a case."""
    case = material.results.case
    yield from stamped(material.asked.stamp)
    if material.has_run:
        link = tag("a", tr(SECTIONS["run"]), href=f"#{id_of(SECTIONS['run'])}")
        said = f": {material.naming.description}" if material.naming.description else ""
        yield tag("p", filled(tr("Scenario, see {link}"), link=link), said, class_="told")
    if material.asked.gears:
        names = ", ".join(material.asked.gears)
        told = tr(
            "Shown of {number} gears: {names}. Figures of the whole are of all gears.",
            number=len(case.gears),
            names=names,
        )
        yield tag("p", told, class_="told")
    if case.description:
        yield tag("p", case.description, class_="told")
    if case.source:
        yield tag("p", filled(tr("Source: {source}"), source=case.source), class_="told source")


def _names(data: Any) -> Iterator[str]:
    """All texts of plain data, among which are the names.

    >>> [*_names({"links": ["in", "-3"], "gears": {"R": {"speeds": {"in": 1}}}})]
    ['links', 'in', '-3', 'gears', 'R', 'speeds', 'in']
    """
    if isinstance(data, str):
        yield data
    elif isinstance(data, dict | list):
        for one in data:
            yield from _names(one)
            if isinstance(data, dict):
                yield from _names(data[one])


def id_of(name: str) -> str:
    """That of a section, in every language.

    >>> id_of("Power flow")
    'power-flow'
    """
    return name.lower().replace(" ", "-")


def _styles(title: str) -> Markup:
    """The style sheet, after what it takes from elsewhere: colours, letters, running title."""
    dark = f"@media screen and (prefers-color-scheme: dark) {{ :root {{ {palette(dark=True)} }} }}"
    light = f":root {{ {palette(dark=False)} }}"
    letters = f"figure svg {{ font-family: {FAMILIES}; stroke-linejoin: round; }}"
    running = f"@page {{ @top-left {{ content: {_quoted(title)}; }} }}"
    return joined(
        *map(Markup, (f"{one}\n" for one in (light, dark, letters, running))),
        _resource("style.css"),
        _resource("print.css"),
    )


def _quoted(text: str) -> str:
    """A text in a style sheet, which it cannot end.

    >>> print(_quoted('a "b" </style>'))
    "a \\22 b\\22  \\3c \\2f style\\3e "
    """
    inner = "".join(one if one.isalnum() or one == " " else f"\\{ord(one):x} " for one in text)
    return f'"{inner}"'
