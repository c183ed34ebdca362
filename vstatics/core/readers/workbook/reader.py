"""Workbooks as trees of nodes: bytes -> cells -> tree, which is read like YAML."""

from __future__ import annotations

from vstatics.core.readers.named.nodes import DocumentText
from vstatics.core.readers.named.nodes import Mapping as MappingNode
from vstatics.core.readers.workbook.cells import read_sheets
from vstatics.core.readers.workbook.sheets import SHEETS
from vstatics.core.readers.workbook.tree import TreeOfSheets, WorkbookSource


def workbook_tree(data: bytes, file: str) -> tuple[MappingNode, DocumentText]:
    """Read a workbook as a tree of nodes, and return the tree with its text and places.

    Raises
    ------
    ReadError
        If the file is not a workbook, or has no sheets of a case.

    Examples
    --------
    >>> from vstatics.core.errors import ReadError
    >>> try:
    ...     workbook_tree(b"PK", "case.xlsx")
    ... except ReadError as error:
    ...     error.problems[0].id
    'E117'
    """
    sheets = read_sheets(data, file, SHEETS)
    document = DocumentText(WorkbookSource(file, [sheet.name for sheet in sheets]))
    return TreeOfSheets(sheets, document).root(), document
