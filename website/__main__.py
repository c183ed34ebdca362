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
"""First page of each kind, in the order of the sidebar."""
SIDEBAR = {"start/readme": "Start here", "start/menu": "Menu"}
"""Names in the sidebar for pages whose titles are also titles of other pages."""


def written(folder: Path) -> list[Page]:
    """Write all pages and the files that they show to a folder for Sphinx; return the pages."""
    exhibited = folder / "gallery"
    exhibited.mkdir(parents=True)
    all_pages = [
        *documents.pages(),
        *commands.pages(),
        *keys.pages(),
        *public.pages(),
        *gallery.pages(exhibited),
    ]
    first = (HERE / "index.md").read_text(encoding="utf-8")
    all_pages += [Page("start", "index", first), _reference(all_pages)]
    for page in _with_contents(all_pages):
        _text(folder / f"{page.name}{page.suffix}", page.text)
    for path, target in documents.files(documents.places()):
        (folder / target).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(documents.ROOT / path, folder / target)
    return all_pages


def _reference(pages: Iterable[Page]) -> Page:
    """Return the first page of the reference, which lists all pages of the reference."""
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
    """Yield the pages; the first page of each kind lists the others of its kind for the sidebar."""
    below = {
        kind: [page.name for page in pages if page.kind == kind and page.name != first]
        for kind, first in FIRST.items()
    }
    below["start"] += [first for kind, first in FIRST.items() if kind != "start"]
    for page in pages:
        if page.name == FIRST[page.kind] and below[page.kind]:
            names = "\n".join(
                f"{SIDEBAR[name]} </{name}>" if name in SIDEBAR else f"/{name}"
                for name in below[page.kind]
            )
            more = f"\n\n```{{toctree}}\n:hidden:\n:maxdepth: 1\n\n{names}\n```\n"
            yield page._replace(text=page.text + more)
        else:
            yield page


def build(site: Path) -> list[dict[str, str]]:
    """Build the site; return file, title and kind of each page."""
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
        listed = [
            {"page": f"{name}.html", "title": app.env.titles[name].astext(), "kind": kinds[name]}
            for name in sorted(
                app.env.found_docs, key=lambda name: (order.index(kinds[name]), name)
            )
        ]
    text = json.dumps(listed, indent=1, ensure_ascii=False)
    (site / "pages.json").write_text(f"{text}\n", encoding="utf-8")
    return listed


if __name__ == "__main__":
    count = len(build(Path(sys.argv[1])))
    sys.stdout.write(f"{count} pages in {sys.argv[1]}\n")
