"""Cases as trees of nodes, from YAML, JSON or workbooks. Numbers in the tree can be replaced."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.readers.named.nodes import DocumentText, Node
from vstatics.core.readers.named.reader import read_case_tree, within_result
from vstatics.core.readers.reading import Reading, Source

if TYPE_CHECKING:
    from vstatics.core.readers import Format


class CaseDocument(NamedTuple):
    """Case as a tree of nodes, with the text from which the nodes were read."""

    root: Node
    source: Source

    def reading(self, root: Node) -> Reading:
        """Read the case from a modified copy of the tree.

        Raises
        ------
        ReadError
            The error contains every problem that does not follow from another.
        """
        return read_case_tree(root, DocumentText(self.source))


def case_document(data: bytes, file: str, form: Format | None) -> CaseDocument | None:
    """Read a case as a tree of nodes; return `None` for a deck, which has no tree.

    Raises
    ------
    ReadError
        If the text is not valid YAML, JSON or workbook.

    Examples
    --------
    >>> document = case_document(b"links: 2\\ngears: {1: []}", "a.yaml", None)
    >>> [key.text for key, _ in document.root.entries], case_document(b"", "a.dat", None)
    (['links', 'gears'], None)
    """
    from vstatics.core.readers import case_tree, format_of

    form = form or format_of(file, data)
    if form == "deck":
        return None
    root, document = case_tree(data, file, form)
    return CaseDocument(within_result(root), document.source)
