"""All shipped cases with their pictures, and all shipped scenarios with their runs."""

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
"""Kinds of pictures; where the first can be drawn, the second is not."""


class Exhibit(NamedTuple):
    """A page of the gallery."""

    page: Page
    title: str
    picture: str
    """File of the first picture."""


def pages(folder: Path) -> Iterator[Page]:
    """A page for each file; their pictures are written to the folder.

    The cells of the first page are what each looks like.
    """
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as processes:
        work = [processes.submit(exhibit, one, folder) for one in sorted(example_files())]
        exhibits = told_apart([one.result() for one in work])
    lines = ["# Gallery", "", "The cases and scenarios that come with the program.", ""]
    for shown in exhibits:
        name, title = shown.page.name.removeprefix("gallery/"), escaped(shown.title)
        lines += [f"- [![]({shown.picture}) {title}]({name}.md)"]
        yield shown.page
    yield Page("gallery", "gallery/index", "\n".join([*lines, ""]))


def told_apart(exhibits: Sequence[Exhibit]) -> list[Exhibit]:
    r"""By title, as a reader looks for them, scenarios last; of one title by the name of the page.

    >>> made = [Exhibit(Page("gallery", f"gallery/{name}", "# Z"), "Z", "") for name in "ba"]
    >>> [(one.title, one.page.text) for one in told_apart(made)]
    [('Z (a)', '# Z (a)\n'), ('Z (b)', '# Z (b)\n')]
    """
    counts = Counter(one.title for one in exhibits)
    found = [_with_page_name(one) if counts[one.title] > 1 else one for one in exhibits]
    return sorted(
        found,
        key=lambda one: (one.page.name.startswith("gallery/scenarios-"), one.title.casefold()),
    )


def _with_page_name(one: Exhibit) -> Exhibit:
    title = f"{one.title} ({one.page.name.removeprefix('gallery/')})"
    _, _, rest = one.page.text.partition("\n")
    text = f"# {escaped(title)}\n{rest}"
    return one._replace(page=one.page._replace(text=text), title=title)


def exhibit(name: str, folder: Path) -> Exhibit:
    """The page of a case or a scenario."""
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
    told = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
    page, title = gallery_name(f"cases/{name}"), str(told.get("name", name))
    picture = f"{page}-shift.svg"
    motion = vstatics.simulate(scenario)
    results = vstatics.solve(scenario.case)
    vstatics.plot(results, "shift", motion=motion).save(folder / picture)
    lines = _head(title, *(str(told.get(key, "")) for key in ("description", "source")))
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
    return f"{value:.4g}" if value == value else "-"  # noqa: PLR0124 - NaN: there is none


def _file(path: str, *commands: str) -> list[str]:
    """The file itself, how one gets it and goes on with it."""
    text = Path(path).read_text(encoding="utf-8")
    lines = ["## The file", "", "```sh", *commands, "```", ""]
    return [*lines, "```yaml", text.rstrip(), "```", ""]


def _page(name: str, lines: list[str]) -> Page:
    return Page("gallery", f"gallery/{name}", "\n".join(lines))
