"""Reads cases in workbooks: bytes -> cells -> tree of nodes -> as YAML."""

from __future__ import annotations

from vstatics.core.readers.named.nodes import Found
from vstatics.core.readers.named.nodes import Mapping as MappingNode
from vstatics.core.readers.named.reader import read_case_tree
from vstatics.core.readers.reading import Reading
from vstatics.core.readers.workbook.cells import read_sheets
from vstatics.core.readers.workbook.sheets import SHEETS
from vstatics.core.readers.workbook.tree import TreeOfSheets, WorkbookSource


def read(data: bytes, file: str) -> Reading:
    """Read a case in a workbook (XLSX); what is wrong is told with its sheet and cell.

    Parameters
    ----------
    data : bytes
    file : str
        The name that problems give.

    Raises
    ------
    ReadError
        With every problem that can be told from the others.
    """
    root, found = workbook_tree(data, file)
    return read_case_tree(root, found)


def workbook_tree(data: bytes, file: str) -> tuple[MappingNode, Found]:
    """The tree of nodes of a workbook, and its places.

    Raises
    ------
    ReadError
        If it can't be read as a workbook, or has no sheets of a case.
    """
    sheets = read_sheets(data, file, SHEETS)
    found = Found(WorkbookSource(file, [sheet.name for sheet in sheets]))
    return TreeOfSheets(sheets, found).root(), found
