"""Pages of the site from the documents of the project, with their links adapted."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import yaml

from vstatics.core.examples import example_file
from website.messages import explanations
from website.page import KINDS, Page

ROOT = Path(__file__).parents[1]
PLACES = {
    "README.md": "start/readme",
    "docs/README.md": "start/menu",
    "docs/tutorial.md": "start/tutorial",
    "docs/coming-from.md": "start/coming-from",
    "docs/python.md": "api/index",
    "docs/sources.md": "sources/index",
    "CHANGELOG.md": "reference/changelog",
    "tests/README.md": "reference/testing",
}
HOW_TO = ("docs/ci.md", "docs/page/serve.md", "docs/vehicle/damage.md")
"""How-to pages outside docs/how-to."""
SOURCES = ("docs/sources.md",)
"""Pages on sources outside docs/sources."""
_LINK = re.compile(r"\[([^\]]*)\]\((?!https?:|#)([^)\s#]+)(#[^)\s]*)?\)")
_FILE = re.compile(r"^<!-- file: (\S+) -->$", re.MULTILINE)
"""Comment with the name of the file whose text follows."""
_FILES_OF = re.compile(r"^<!-- files of: (\S+) -->$", re.MULTILINE)
"""Comment with the path of the document that shows the files of the examples."""
_SHIPPED = re.compile(r"\bcases/((?:scenarios/)?[\w-]+)\.(yaml|dat)\b")
_FENCED = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)


def places() -> dict[str, str]:
    """Return the page of each document, by the path of the document in the project.

    >>> known = places()
    >>> known["docs/cookbook/README.md"], known["docs/how-to/shift.md"], known["docs/method.md"]
    ('cookbook/index', 'how-to/shift', 'reference/method')
    """
    by_path = dict(PLACES)
    for path in sorted((ROOT / "docs").glob("**/*.md")):
        document = path.relative_to(ROOT).as_posix()
        if document not in by_path:
            kind = _kind(document)
            by_path[document] = f"{kind}/{_name(document, kind)}"
    return by_path


def _name(document: str, kind: str) -> str:
    """Return the name of a page; pages of the reference also have the names of their folders.

    >>> _name("docs/sweep/README.md", "reference"), _name("docs/synthesis/method.md", "reference")
    ('sweep', 'synthesis-method')
    """
    *folders, name = document.removeprefix("docs/").removesuffix(".md").split("/")
    if kind != "reference":
        return "index" if name == "README" else name
    return "-".join([*folders, name]).removesuffix("-README")


def _kind(document: str) -> str:
    folder = document.split("/")[1]
    if document == "docs/messages.md":
        return "messages"
    if document in SOURCES:
        return "sources"
    return "how-to" if document in HOW_TO else folder if folder in KINDS else "reference"


def pages() -> Iterator[Page]:
    """Yield the pages of all documents."""
    known = places()
    for document, name in known.items():
        text = (ROOT / document).read_text(encoding="utf-8")
        text = _FILE.sub(r"`\1`:\n", _FILES_OF.sub(_files_of(document), text))
        text = "".join(
            part if part.startswith("```") else _with_links(part, document, name, known)
            for part in _FENCED.split(text)
        )
        if shipped := obtained(text):
            title, line, rest = text.partition("\n")
            text = f"{title}{line}\n{shipped}{rest}"
        if name == "messages/messages":
            text = f"{text}\n{explanations()}"
        yield Page(name.partition("/")[0], name, text)


def _files_of(document: str) -> Callable[[re.Match[str]], str]:
    """Return the replacement of a comment by a reference to the document with the files."""

    def reference(comment: re.Match[str]) -> str:
        other = (ROOT / document).parent / comment[1]
        title = other.read_text(encoding="utf-8").partition("\n")[0].removeprefix("# ")
        return f"Files that are not shown here are in [{title}]({comment[1]})."

    return reference


def obtained(text: str) -> str:
    """Return commands that copy the shipped files which a document uses; empty without such files.

    >>> print(obtained("```console\\n$ vstatics run cases/simpson.yaml\\n```"))
    The files of `cases/` come with the program:
    <BLANKLINE>
    ```sh
    vstatics new cases/simpson.yaml -t simpson
    ```
    <BLANKLINE>
    """
    used = {found.groups() for part in _FENCED.findall(text) for found in _SHIPPED.finditer(part)}
    for name, _ in sorted(used):
        if name.startswith("scenarios/"):
            used.add((case_of(name), "yaml"))
    if not used:
        return ""
    lines = [f"vstatics new cases/{name}.{kind} -t {name}" for name, kind in sorted(used)]
    sentence = "The files of `cases/` come with the program:"
    return "\n".join([sentence, "", "```sh", *lines, "```", ""])


def case_of(scenario: str) -> str:
    """Return the name of the case of a shipped scenario.

    >>> case_of("scenarios/8hp70-upshift")
    'driveline-8hp70'
    """
    document = yaml.safe_load(example_file(scenario).data())
    return Path(document["case"]).stem


def _with_links(text: str, document: str, name: str, known: dict[str, str]) -> str:
    """Return the text with its links to documents and shipped cases replaced by links to pages.

    A link to a folder outside the site is replaced by its text.
    """

    def moved(found: re.Match[str]) -> str:
        words, link, place = found.groups(default="")
        path = os.path.normpath(Path(document).parent / link)
        target = target_of(path, known)
        if target == f"files/{path}" and (ROOT / path).is_dir():
            return words
        return f"[{words}]({os.path.relpath(target, Path(name).parent)}{place})"

    return _LINK.sub(moved, text)


def target_of(path: str, known: dict[str, str]) -> str:
    """Return the path in the site that corresponds to a file of the project.

    >>> target_of("cases/zf-8hp70.yaml", {}), target_of("cases/scenarios/8hp70-upshift.yaml", {})
    ('gallery/zf-8hp70.md', 'gallery/scenarios-8hp70-upshift.md')
    >>> target_of("LICENSE", {})
    'files/LICENSE'
    """
    if path in known:
        return f"{known[path]}.md"
    if path in {"cases", "cases/scenarios"}:
        return "gallery/index.md"
    if path.startswith("cases/"):
        return f"gallery/{gallery_name(path)}.md"
    return path.removeprefix("docs/") if path.startswith("docs/pictures/") else f"files/{path}"


def gallery_name(path: str) -> str:
    """Return the name of the page of a shipped case; a deck and its YAML case share a page.

    >>> gallery_name("cases/mzkt7922.dat")
    'mzkt7922'
    """
    return os.path.splitext(path)[0].removeprefix("cases/").replace("/", "-")  # noqa: PTH122


def files(known: dict[str, str]) -> Iterator[tuple[str, str]]:
    """Yield the files that documents link to: path in the project and path in the site."""
    found = set()
    for document in known:
        for link in _LINK.finditer(_FENCED.sub("", (ROOT / document).read_text(encoding="utf-8"))):
            path = os.path.normpath(Path(document).parent / link[2])
            target = target_of(path, known)
            if not target.startswith("gallery/") and (ROOT / path).is_file() and path not in known:
                found.add((path, target))
    yield from sorted(found)
