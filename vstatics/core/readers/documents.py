"""Cases as documents whose numbers can be replaced: trees of nodes, of YAML, JSON and workbooks."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.readers.named.nodes import Found, Node, decode
from vstatics.core.readers.named.reader import case_tree, read_case_tree
from vstatics.core.readers.reading import Reading, Source

if TYPE_CHECKING:
    from vstatics.core.readers import Format


class CaseDocument(NamedTuple):
    """A case that was read as a tree, and where its nodes stand."""

    root: Node
    source: Source

    def reading(self, root: Node) -> Reading:
        """The case of a tree that was made of this one.

        Raises
        ------
        ReadError
            With every problem that can be told from the others.
        """
        return read_case_tree(root, Found(self.source))


def case_document(data: bytes, file: str, form: Format | None) -> CaseDocument | None:
    """The document that a case is; none of a deck.

    Raises
    ------
    ReadError
        If it can't be read as a tree.

    Examples
    --------
    >>> made = case_document(b"links: 2\\ngears: {1: []}", "a.yaml", None)
    >>> [key.text for key, _ in made.root.entries], case_document(b"", "a.dat", None)
    (['links', 'gears'], None)
    """
    from vstatics.core.readers import format_of

    form = form or format_of(file, data)
    if form == "xlsx":
        from vstatics.core.readers.workbook.reader import workbook_tree

        root, found = workbook_tree(data, file)
        return CaseDocument(root, found.source)
    if form == "deck":
        return None
    found = decode(data, file)
    return CaseDocument(case_tree(found, form), found.source)
