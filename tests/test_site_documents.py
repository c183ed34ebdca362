"""Every document has its page."""

from __future__ import annotations

from website.documents import ROOT, pages, places
from website.page import KINDS


def test_every_document_is_a_page_of_a_kind() -> None:
    known = places()
    assert {path.relative_to(ROOT).as_posix() for path in ROOT.glob("docs/**/*.md")} <= {*known}
    assert {name.split("/")[0] for name in known.values()} <= {*KINDS}
    assert len({*known.values()}) == len(known)


def test_links_to_documents_follow_them_to_their_pages() -> None:
    texts = {page.name: page.text for page in pages()}
    assert "](../reference/sweep.md)" in texts["how-to/vary-a-number"]
    assert "](../gallery/index.md)" in texts["start/readme"]
    assert '<a id="W414"></a>' in texts["messages/messages"]
