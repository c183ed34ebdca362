"""Pictures of README.md and docs/: each is drawn by the arguments of `plot` above it.

``<!-- picture: cases/simpson.yaml --kind stick -->`` stands on the line before
``![...](pictures/simpson-stick.svg)``. A case may be one that a document tells, too. `make
pictures` draws them anew; `tests/test_documented_pictures.py` compares what is there with what is
drawn.
"""

import contextlib
import re
import shlex
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from click.testing import CliRunner

from tests.commands import ROOT
from tests.test_readme import DOCUMENTS, blocks, write_file
from vstatics.core.cli import main

IMAGE = re.compile(
    r"(?:^<!-- picture: (?P<asked>.+) -->\n)?^!\[[^\]]*\]\((?P<file>[^)]+)\)", re.MULTILINE
)


class DocumentedPicture(NamedTuple):
    """A picture in a document."""

    document: Path
    file: Path
    asked: str
    """Arguments of `plot`."""

    @property
    def words(self) -> list[str]:
        """The arguments."""
        return shlex.split(self.asked)

    @property
    def kind(self) -> str:
        """Of the picture."""
        return self.words[self.words.index("--kind") + 1]

    def drawn(self) -> bytes:
        """As the program draws it now, in a folder with the shipped cases and the documents'."""
        with tempfile.TemporaryDirectory() as name, contextlib.chdir(name):
            Path("cases").symlink_to(ROOT / "cases")
            for document in DOCUMENTS:
                for block in blocks(document):
                    if block.file and block.file in self.words:
                        write_file(block, Path(name))
            done = CliRunner().invoke(main, ["plot", *self.words, "-o", "-"])
        assert done.exit_code == 0, done.stderr
        return done.stdout_bytes


def documented() -> Iterator[DocumentedPicture]:
    """The pictures of all documents."""
    for document in DOCUMENTS:
        for found in IMAGE.finditer(document.read_text("utf-8")):
            assert found["asked"], f"{document.name}: {found[0]} has no line `<!-- picture: -->`"
            file = (document.parent / found["file"]).resolve()
            yield DocumentedPicture(document, file, found["asked"])


def make() -> None:
    """Draw all of them, and remove pictures that no document shows."""
    kept = {one.file: one.drawn() for one in documented()}
    for file, svg in kept.items():
        file.parent.mkdir(exist_ok=True)
        file.write_bytes(svg)
    for file in (ROOT / "docs" / "pictures").glob("*.svg"):
        if file not in kept:
            file.unlink()


if __name__ == "__main__":
    make()
