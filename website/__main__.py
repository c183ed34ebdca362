"""Build the site: ``python -m website FOLDER``."""

from __future__ import annotations

import json
import shutil
import sys
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from sphinx.application import Sphinx
from sphinx.util.display import progress_message

from website import commands, documents, gallery, keys, public
from website.page import Page

HERE = Path(__file__).parent
FIRST = {
    "start": "index",
    "how-to": "how-to/index",
    "cookbook": "cookbook/index",
    "gallery": "gallery/index",
    "reference": "reference/index",
    "api": "api/index",
    "messages": "messages/messages",
    "sources": "sources/index",
}
"""The first page of each kind, in the order in which they stand at the side."""


def written(folder: Path) -> list[Page]:
    """All pages, written to a folder for Sphinx, with the files that they show."""
    exhibited = folder / "gallery"
    exhibited.mkdir(parents=True)
    made = [
        *documents.pages(),
        *commands.pages(),
        *keys.pages(),
        *public.pages(),
        *gallery.pages(exhibited),
    ]
    first = (HERE / "index.md").read_text(encoding="utf-8")
    made += [Page("start", "index", first), _reference(made)]
    for page in _with_contents(made):
        _text(folder / f"{page.name}{page.suffix}", page.text)
    for path, target in documents.files(documents.places()):
        (folder / target).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(documents.ROOT / path, folder / target)
    return made


def _reference(pages: Iterable[Page]) -> Page:
    """The list of what is known in full."""
    lines = ["# Reference", ""]
    for page in pages:
        if page.kind == "reference" and page.name.count("/") == 1:
            title = page.text.partition("\n")[0].removeprefix("# ")
            lines.append(f"- [{title}]({page.name.removeprefix('reference/')}.md)")
    lines += [
        "- [Commands](commands/index.md), each with all its options",
        "- Keys: [of a case](keys/case.md), [of a scenario](keys/scenario.md)",
        "",
    ]
    return Page("reference", "reference/index", "\n".join(lines))


def _text(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def _with_contents(pages: Sequence[Page]) -> Iterator[Page]:
    """What stands at the side: the first page of each kind, those of its kind below it."""
    below = {
        kind: [page.name for page in pages if page.kind == kind and page.name != first]
        for kind, first in FIRST.items()
    }
    below["start"] += [first for kind, first in FIRST.items() if kind != "start"]
    for page in pages:
        if page.name == FIRST[page.kind] and below[page.kind]:
            names = "\n".join(f"/{name}" for name in below[page.kind])
            more = f"\n\n```{{toctree}}\n:hidden:\n:maxdepth: 1\n\n{names}\n```\n"
            yield page._replace(text=page.text + more)
        else:
            yield page


def build(site: Path) -> list[dict[str, str]]:
    """Build the site; what each of its pages is."""
    with tempfile.TemporaryDirectory() as temporary:
        sources, trees = Path(temporary, "sources"), Path(temporary, "trees")
        with progress_message("pages of declarations, pictures of cases"):
            pages = written(sources)
        shutil.rmtree(site, ignore_errors=True)
        app = Sphinx(sources, HERE, site, trees, "html", warningiserror=True, status=None)
        app.build()
        if app.statuscode:
            raise SystemExit(app.statuscode)
        order = [*FIRST]
        kinds = {page.name: page.kind for page in pages}
        told = [
            {"page": f"{name}.html", "title": app.env.titles[name].astext(), "kind": kinds[name]}
            for name in sorted(
                app.env.found_docs, key=lambda name: (order.index(kinds[name]), name)
            )
        ]
    text = json.dumps(told, indent=1, ensure_ascii=False)
    (site / "pages.json").write_text(f"{text}\n", encoding="utf-8")
    return told


if __name__ == "__main__":
    made = build(Path(sys.argv[1]))
    sys.stdout.write(f"{len(made)} pages in {sys.argv[1]}\n")
