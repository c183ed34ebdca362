"""Reader of cases in workbooks: bytes -> cells -> tree of nodes, which is read like YAML."""

from __future__ import annotations

from vstatics.core.readers.named.nodes import DocumentText
from vstatics.core.readers.named.nodes import Mapping as MappingNode
from vstatics.core.readers.named.reader import read_case_tree
from vstatics.core.readers.reading import Reading
from vstatics.core.readers.workbook.cells import read_sheets
from vstatics.core.readers.workbook.sheets import SHEETS
from vstatics.core.readers.workbook.tree import TreeOfSheets, WorkbookSource


def read(data: bytes, file: str) -> Reading:
    """Read a case from a workbook (XLSX).

    Parameters
    ----------
    data : bytes
        The content of a file.
    file : str
        Name of the file, for messages.

    Returns
    -------
    Reading
        The transmission, its warnings, and the places of its parts.

    Raises
    ------
    ReadError
        The error contains every problem, its sheet and its cell.

    Examples
    --------
    >>> from vstatics.core.errors import ReadError
    >>> try:
    ...     read(b"PK", "case.xlsx")
    ... except ReadError as error:
    ...     error.problems[0].id
    'E117'
    """
    root, document = workbook_tree(data, file)
    return read_case_tree(root, document)


def workbook_tree(data: bytes, file: str) -> tuple[MappingNode, DocumentText]:
    """Read a workbook as a tree of nodes, and return the tree with its text and places.

    Raises
    ------
    ReadError
        If the file is not a workbook, or has no sheets of a case.
    """
    sheets = read_sheets(data, file, SHEETS)
    document = DocumentText(WorkbookSource(file, [sheet.name for sheet in sheets]))
    return TreeOfSheets(sheets, document).root(), document
