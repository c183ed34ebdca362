"""Every document has its page."""

from __future__ import annotations

import re
from pathlib import Path

from tests.commands import vstatics
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


def test_a_page_tells_how_its_files_are_got(tmp_path: Path) -> None:
    """What it says, typed in an empty folder, makes the files that it calculates."""
    texts = {page.name: page.text for page in pages()}
    for name in ("how-to/teach", "how-to/shift", "how-to/old-decks"):
        [told] = re.findall(r"come with the program:\n\n```sh\n(.*?)```", texts[name], re.DOTALL)
        for line in told.splitlines():
            words = line.split()
            target = tmp_path / name / words[2]
            assert vstatics("new", target, *words[3:]).status == 0
            assert target.read_bytes() == (ROOT / words[2]).read_bytes()
    assert {path.name for path in (tmp_path / "how-to/shift/cases/scenarios").iterdir()}
    assert "come with the program" not in texts["how-to/drive"]
    assert "`car.yaml`:\n" in texts["reference/cases"]
    assert "Files that are not shown here stand in [" in texts["how-to/drive"]
