"""Cases in workbooks: sheets of parts with a row for each, and one of paths and values.

`parts` opens a workbook, bounded, `cells` gives the cells of its sheets; `tree` makes of them the
tree of nodes that YAML has, too, so that keys are read and checked there; `sheets` says which
sheets and headings there are, and how a text stands in a cell, for the writer as well.
"""

from vstatics.core.readers.workbook.reader import read

__all__ = ["read"]
