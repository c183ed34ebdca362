"""The site: built once, read as from a disk."""

import html
import inspect
import re
import subprocess
import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import unquote

import pytest

import vstatics
from tests.commands import json_file
from tests.installed import ANNEXES, needs
from vstatics.core.cli import main
from vstatics.core.cli.schemas import schemas
from vstatics.core.messages.catalogue import known_ids
from website import commands, documents, keys, public
from website.page import KINDS

MOST_WORDS = 1500
"""Of a page of start or how-to, outside `pre`."""
pytestmark = [pytest.mark.slow, needs(*ANNEXES)]


class Read(NamedTuple):
    """What a page has."""

    anchors: set[str]
    links: list[str]
    words: int


class Reader(HTMLParser):
    """Reads a page of the site."""

    def __init__(self) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[str] = []
        self.words = 0
        self.within: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """An anchor, a link, or where words begin that are counted."""
        given = dict(attrs)
        self.anchors |= {value for key in ("id", "name") if (value := given.get(key))}
        self.links += [value for key in ("href", "src") if (value := given.get(key))]
        if tag in {"pre", "article"}:
            self.within.append(tag)

    def handle_endtag(self, tag: str) -> None:
        """Where they end."""
        if tag in {"pre", "article"}:
            self.within.remove(tag)

    def handle_data(self, data: str) -> None:
        """Words."""
        if self.within == ["article"]:
            self.words += len(data.split())


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site") / "site"
    command = [sys.executable, "-m", "website", str(folder)]
    done = subprocess.run(command, cwd=documents.ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


@pytest.fixture(scope="module")
def pages(site: Path) -> dict[str, Read]:
    found = {}
    for path in site.glob("**/*.html"):
        reader = Reader()
        reader.feed(path.read_text("utf-8"))
        name = path.relative_to(site).as_posix()
        found[name] = Read(reader.anchors, reader.links, reader.words)
    return found


@pytest.fixture(scope="module")
def told(site: Path) -> list[dict[str, str]]:
    read: list[dict[str, str]] = json_file(site / "pages.json")
    return read


def test_each_page_is_named_with_its_kind(site: Path, told: list[dict[str, str]]) -> None:
    assert {one["kind"] for one in told} == {*KINDS}
    for one in told:
        text = (site / one["page"]).read_text("utf-8")
        assert re.search(r"<h1>(.*?)<a class", text, re.DOTALL), one
        assert one["title"], one


def test_entries_of_the_sidebar_differ(site: Path) -> None:
    tree = (site / "index.html").read_text("utf-8").partition('class="sidebar-tree"')[2]
    names = re.findall(r"toctree-l1[^>]*><a[^>]*>([^<]+)<", tree)
    assert "Menu" in names
    assert len({*names}) == len(names)


def test_nothing_is_stated_of_the_machine_that_builds(site: Path) -> None:
    places = {str(documents.ROOT), str(Path.home()), str(site.parent)}
    for path in [*site.glob("**/*.html"), *site.glob("**/*.js*")]:
        text = path.read_text("utf-8")
        assert [one for one in places if f"{one}/" in text] == [], path


def plain(text: str) -> str:
    """Letters and digits: print has other signs."""
    return re.sub(r"\W+", "", text)


def test_sentences_of_attributes_are_whole(site: Path) -> None:
    """What stands before a colon is no type."""
    for module in public.MODULES:
        text = (site / f"api/{module}.html").read_text("utf-8")
        assert ">Type<" not in text
        shown = plain(html.unescape(re.sub(r"<[^>]*>", "", text)))
        for name in public.names(module):
            value = getattr(import_module(module), name)
            for key, own in vars(value).items() if inspect.isclass(value) else ():
                if key[0] == "_":
                    continue
                if isinstance(own, property) and own.fget is not None and own.fget.__doc__:
                    first = own.fget.__doc__.split("\n")[0]
                    assert plain(first) in shown, (name, first)


def test_links_and_anchors_resolve(site: Path, pages: dict[str, Read]) -> None:
    assert list(broken(site, pages)) == []


def broken(site: Path, pages: dict[str, Read]) -> Iterator[tuple[str, str]]:
    for name, page in pages.items():
        for link in page.links:
            if link.startswith(("http:", "https:", "data:", "mailto:")):
                continue
            path, _, anchor = unquote(link).partition("#")
            target = (site / name).parent / path.partition("?")[0] if path else site / name
            if target.is_dir() or not target.exists():
                yield name, link
            elif anchor and target.suffix == ".html":
                other = target.resolve().relative_to(site.resolve()).as_posix()
                if anchor not in pages[other].anchors:
                    yield name, link


def test_nothing_is_loaded_from_elsewhere(site: Path) -> None:
    loaded = re.compile(r"""<(?:script|img|iframe|link)\b[^>]*?(?:src|href)="https?:[^"]*\"""")
    for path in site.glob("**/*.html"):
        assert not loaded.search(path.read_text("utf-8")), path
    for path in site.glob("**/*.css"):
        assert not re.search(r"url\([\"']?https?:|@import", path.read_text("utf-8")), path


def test_pages_to_start_with_are_short(pages: dict[str, Read], told: list[dict[str, str]]) -> None:
    words = {
        one["page"]: pages[one["page"]].words for one in told if one["kind"] in {"start", "how-to"}
    }
    assert {page: count for page, count in words.items() if not 20 < count <= MOST_WORDS} == {}


def test_every_declaration_has_its_place(pages: dict[str, Read]) -> None:
    for words, command, _ in commands.commands(main, ()):
        known = pages[f"reference/commands/{'-'.join(words)}.html"].anchors
        named = [name for one in command.params for name in one.opts if name.startswith("--")]
        hidden = {
            name for one in command.params if getattr(one, "hidden", False) for name in one.opts
        }
        for name in set(named) - hidden:
            assert f"{'-'.join(words)}{name}" in known
    for file in keys.FILES:
        known = pages[f"reference/keys/{file}.html"].anchors
        assert {path for path, _ in keys.keys(schemas()[file], file)} <= known
    for module in public.MODULES:
        known = pages[f"api/{module}.html"].anchors
        assert {f"{module}.{name}" for name in public.names(module)} <= known
    assert {*known_ids()} <= pages["messages/messages.html"].anchors


def test_every_shipped_case_is_in_the_gallery_with_a_picture(
    site: Path, pages: dict[str, Read]
) -> None:
    listed = pages["gallery/index.html"].links
    for name in vstatics.example():
        page = f"gallery/{name.replace('/', '-')}.html"
        assert page.removeprefix("gallery/") in listed
        pictures = [one for one in pages[page].links if one.endswith(".svg")]
        assert pictures, page
        for picture in pictures:
            assert (site / "gallery" / picture).stat().st_size > 1000


def test_what_is_searched_for_is_found_on_a_disk(site: Path, browser: Any) -> None:
    """In Chromium, from file://, without any request to elsewhere."""
    asked = []
    page = browser.new_page()
    page.on("request", lambda request: asked.append(request.url))
    page.goto(f"{(site / 'search.html').as_uri()}?q=Lepelletier")
    page.wait_for_selector("ul.search li a")
    assert page.locator("ul.search li a").count() > 0
    page.goto(f"{(site / 'search.html').as_uri()}?q=W414")
    page.wait_for_selector("ul.search li a")
    assert "Messages" in page.locator("ul.search").inner_text()
    titles = {"Willis": "The method", "misprint": "The tables of the UMDM"}
    titles |= dict.fromkeys(("Kutzbach", "водило"), "Glossary")
    for word, title in titles.items():
        page.goto(f"{(site / 'search.html').as_uri()}?q={word}")
        page.wait_for_selector(f"ul.search li a:text('{title}')")
    assert {url.partition(":")[0] for url in asked} <= {"file", "data"}
