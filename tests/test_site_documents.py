"""Every document has its page."""

import re
from pathlib import Path

from tests.commands import vstatics
from tests.installed import needs
from vstatics.core.elements.kinds import KINDS
from website import keys
from website.documents import ROOT, pages, places
from website.page import KINDS as KINDS_OF_PAGES


def test_every_document_is_a_page_of_a_kind() -> None:
    known = places()
    assert {path.relative_to(ROOT).as_posix() for path in ROOT.glob("docs/**/*.md")} <= {*known}
    assert {name.split("/")[0] for name in known.values()} <= {*KINDS_OF_PAGES}
    assert len({*known.values()}) == len(known)


@needs("sweep", "vehicle")
def test_links_to_documents_follow_them_to_their_pages() -> None:
    texts = {page.name: page.text for page in pages()}
    assert "](../reference/sweep.md)" in texts["how-to/losses-by-map"]
    assert "](../gallery/index.md)" in texts["start/readme"]
    assert '<a id="W414"></a>' in texts["messages/messages"]


@needs("simulation")
def test_each_kind_of_element_has_its_keys() -> None:
    """Those that an element of the kind may have, wherever they are told."""
    [text] = [page.text for page in keys.pages() if page.name.endswith("/case")]
    anchors = set(re.findall(r'<a id="([^"]+)"></a>', text))
    sections = {
        kind: re.findall(r'<a href="#([\w.]+)"><code>(\w+)<', section)
        for kind, section in re.findall(r"## elements of kind: (\w+)\n(.*?)<a id", text, re.DOTALL)
    }
    assert {*sections} == {*KINDS}
    for links in sections.values():
        assert all(place.endswith(f".{name}") and place in anchors for place, name in links)
    members = {kind: {*one.members} for kind, one in KINDS.items() if kind != "planet_group"}
    assert all(members[kind] <= {name for _, name in sections[kind]} for kind in members)


@needs("simulation", "vehicle")
def test_a_page_tells_how_its_files_are_got(tmp_path: Path) -> None:
    """What it says, typed in an empty folder, makes the files that it calculates."""
    texts = {page.name: page.text for page in pages()}
    for name in ("how-to/fit-ratios", "how-to/shift", "how-to/old-decks"):
        [told] = re.findall(r"come with the program:\n\n```sh\n(.*?)```", texts[name], re.DOTALL)
        for line in told.splitlines():
            words = line.split()
            target = tmp_path / name / words[2]
            assert vstatics("new", target, *words[3:]).status == 0
            assert target.read_bytes() == (ROOT / words[2]).read_bytes()
    assert {path.name for path in (tmp_path / "how-to/shift/cases/scenarios").iterdir()}
    assert "come with the program" not in texts["how-to/drive"]
    assert "`car.yaml`:\n" in texts["reference/vehicle"]
    assert "Files that are not shown here are in [" in texts["how-to/drive"]
