"""Gallery of all shipped cases with their pictures, and of all shipped scenarios."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import NamedTuple

import yaml

import vstatics
from vstatics.core.examples import example_files
from website.documents import case_of, gallery_name
from website.page import Page, escaped

OF_CASE = {"stick": "Stick diagram", "structure": "Structure", "lever": "Levers"}
"""Kinds of pictures with titles; `structure` is only drawn if `stick` is impossible."""


class Exhibit(NamedTuple):
    """Page of the gallery."""

    page: Page
    title: str
    picture: str
    """Name of the file with the first picture."""


def pages(folder: Path) -> Iterator[Page]:
    """Yield a page for each shipped file, and a first page with thumbnails.

    The pictures are written to `folder`.
    """
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as processes:
        work = [processes.submit(exhibit_of, name, folder) for name in sorted(example_files())]
        exhibits = sorted_by_title([future.result() for future in work])
    lines = ["# Gallery", "", "The cases and scenarios that come with the program.", ""]
    for shown in exhibits:
        name, title = shown.page.name.removeprefix("gallery/"), escaped(shown.title)
        lines += [f"- [![]({shown.picture}) {title}]({name}.md)"]
        yield shown.page
    yield Page("gallery", "gallery/index", "\n".join([*lines, ""]))


def sorted_by_title(exhibits: Sequence[Exhibit]) -> list[Exhibit]:
    r"""Return exhibits sorted by title, scenarios last; equal titles get the name of the page.

    >>> equal = [Exhibit(Page("gallery", f"gallery/{name}", "# Z"), "Z", "") for name in "ba"]
    >>> [(exhibit.title, exhibit.page.text) for exhibit in sorted_by_title(equal)]
    [('Z (a)', '# Z (a)\n'), ('Z (b)', '# Z (b)\n')]
    """
    counts = Counter(exhibit.title for exhibit in exhibits)
    distinct = [_with_page_name(e) if counts[e.title] > 1 else e for e in exhibits]
    return sorted(
        distinct,
        key=lambda e: (e.page.name.startswith("gallery/scenarios-"), e.title.casefold()),
    )


def _with_page_name(exhibit: Exhibit) -> Exhibit:
    title = f"{exhibit.title} ({exhibit.page.name.removeprefix('gallery/')})"
    _, _, rest = exhibit.page.text.partition("\n")
    text = f"# {escaped(title)}\n{rest}"
    return exhibit._replace(page=exhibit.page._replace(text=text), title=title)


def exhibit_of(name: str, folder: Path) -> Exhibit:
    """Return the exhibit of a case or a scenario, after writing its pictures."""
    file = example_files()[name]
    is_run = name.startswith("scenarios/")
    return _of_run(name, file.path, folder) if is_run else _of_case(name, file.path, folder)


def _of_case(name: str, path: str, folder: Path) -> Exhibit:
    results = vstatics.solve(vstatics.load(path))
    case, page = results.case, gallery_name(f"cases/{name}")
    pictures: dict[str, str] = {}
    for kind, what in OF_CASE.items():
        if kind == "structure" and pictures:
            continue
        try:
            vstatics.plot(results, kind).save(folder / f"{page}-{kind}.svg")
        except vstatics.CaseError:
            continue
        pictures[what] = f"{page}-{kind}.svg"
    title = case.name or name
    lines = _head(title, case.description, case.source)
    lines += ["| gear | ratio | efficiency |", "| --- | ---: | ---: |"]
    for gear, ratio, eta in zip(case.gears, results.ratio, results.efficiency, strict=True):
        lines.append(f"| {escaped(gear.name)} | {_number(ratio)} | {_number(eta)} |")
    lines.append("")
    for what, file in pictures.items():
        lines += [f"## {what}", "", f"![{what} of {escaped(title)}]({file})", ""]
    copied = f"vstatics new {name}.yaml -t {name}"
    lines += _file(path, copied, f"vstatics report {name}.yaml -o {name}.html")
    return Exhibit(_page(page, lines), title, next(iter(pictures.values())))


def _of_run(name: str, path: str, folder: Path) -> Exhibit:
    scenario = vstatics.load_scenario(path)
    document = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
    page, title = gallery_name(f"cases/{name}"), str(document.get("name", name))
    picture = f"{page}-shift.svg"
    motion = vstatics.simulate(scenario)
    results = vstatics.solve(scenario.case)
    vstatics.plot(results, "shift", motion=motion).save(folder / picture)
    lines = _head(title, *(str(document.get(key, "")) for key in ("description", "source")))
    lines += ["## The run", "", f"![The run of {escaped(title)}]({picture})", ""]
    case = case_of(name)
    lines += _file(
        path,
        f"vstatics new {case}.yaml -t {case}",
        f"vstatics new {name}.yaml -t {name}",
        f"vstatics simulate {name}.yaml",
    )
    return Exhibit(_page(page, lines), title, picture)


def _head(title: str, *texts: str) -> list[str]:
    lines = [f"# {escaped(title)}", ""]
    for text in filter(None, texts):
        lines += [escaped(text), ""]
    return lines


def _number(value: float) -> str:
    return f"{value:.4g}" if value == value else "-"  # noqa: PLR0124 - NaN: no value


def _file(path: str, *commands: str) -> list[str]:
    """Return the section with the file, and the commands that copy it and calculate it."""
    text = Path(path).read_text(encoding="utf-8")
    lines = ["## The file", "", "```sh", *commands, "```", ""]
    return [*lines, "```yaml", text.rstrip(), "```", ""]


def _page(name: str, lines: list[str]) -> Page:
    return Page("gallery", f"gallery/{name}", "\n".join(lines))
