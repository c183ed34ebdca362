"""Cases in workbooks: sheets with a row for each part, and a sheet of paths and values.

`parts` opens a workbook within bounds, and `cells` reads the cells of its sheets. `tree` builds the
tree of nodes that YAML has, too, so that both share the checks of keys. `sheets` lists the sheets
and headings, and converts texts to cells and back, also for the writer.
"""

from vstatics.core.readers.workbook.reader import read

__all__ = ["read"]
