"""Builder of a tree of nodes from the cells of sheets; a YAML text gives the same tree."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from vstatics.core.errors import CellPlace, Path, Place, ReadError, quoted
from vstatics.core.model.paths import NoValueError
from vstatics.core.readers.named.nodes import DocumentText, Listing, Node, Scalar
from vstatics.core.readers.named.nodes import Mapping as MappingNode
from vstatics.core.readers.reading import Source
from vstatics.core.readers.signs import with_plain_blanks
from vstatics.core.readers.workbook.cells import MOST_ROWS, ReadCell, ReadSheet
from vstatics.core.readers.workbook.grown import GrownNode, moved
from vstatics.core.readers.workbook.sheets import (
    CASE_SHEET,
    ENGAGED,
    GEARS,
    LINKS,
    LONGEST_NUMBER,
    MARKS,
    PART_SHEETS,
    SHEETS,
    Part,
    PartSheet,
    is_flow,
    path_parts,
    text_cell,
)
from vstatics.core.suggestions import nearest

_ROWS = MOST_ROWS + 2
"""Offset of line numbers between sheets. The line of a node encodes sheet and row."""


class WorkbookSource(Source):
    """Source of a workbook, in which places are cells."""

    def __init__(self, file: str, sheets: Sequence[str]) -> None:
        super().__init__(file, "")
        self.sheets = sheets

    def place(self, line: int, column: int = 1) -> Place:
        """Return the cell at a line, which encodes sheet and row. Line 0 is the whole file."""
        number, row = divmod(line, _ROWS)
        place = Place(self.file, row, column if row else 0)
        return CellPlace.of(place, self.sheets[number]) if row else place


class TreeOfSheets:
    """Builder of the tree of a case."""

    def __init__(self, sheets: Sequence[ReadSheet], document: DocumentText) -> None:
        self.document = document
        self.sheets = {sheet.name: sheet.rows for sheet in sheets}
        self.first = {sheet.name: number * _ROWS for number, sheet in enumerate(sheets)}
        self.sheet = CASE_SHEET

    def root(self) -> MappingNode:
        """Return the whole tree.

        Raises
        ------
        ReadError
            If sheets or headings are unknown, or a value occurs twice.
        """
        self._check_names()
        root = GrownNode(0, 0)
        for name in SHEETS[1:]:
            if name in self.sheets:
                self.sheet = name
                grown = GrownNode(*self._at(ReadCell("", 1, 1)))
                rows = self._below_heading(name)
                if name == LINKS:
                    self._links(grown, rows)
                else:
                    self._parts(grown, name, rows)
                root.add(name, grown)
        if CASE_SHEET in self.sheets:
            self.sheet = CASE_SHEET
            self._paths(root)
        node = root.node(self.document)
        assert isinstance(node, MappingNode)  # noqa: S101 (all parts of the root are keys)
        return node

    def _check_names(self) -> None:
        """Check the names of sheets.

        An unknown name is an error only if it resembles a known name.
        """
        if self.sheets.keys().isdisjoint(SHEETS):
            names = ", ".join(map(quoted, SHEETS))
            self.document.stop(f"no sheet of a case, expected some of {names}", 0, 1)
        for name in self.sheets.keys() - {*SHEETS}:
            hint = nearest(name, SHEETS)
            if hint:
                self._refuse_at(self.first[name] + 1, 1, f"unknown sheet {quoted(name)}{hint}")

    def _at(self, cell: ReadCell) -> tuple[int, int]:
        return self.first[self.sheet] + cell.row, cell.column

    def _refuse(self, cell: ReadCell, message: str) -> None:
        self._refuse_at(*self._at(cell), message)

    def _refuse_at(self, line: int, column: int, message: str) -> None:
        self.document.add(message, line, column, identity="E118")

    def _below_heading(self, name: str) -> list[list[ReadCell]]:
        """Return the rows of a sheet below the headings, the first of which must be `name`."""
        rows = self.sheets[name]
        if not rows:
            return []
        head = rows[0][0]
        if (head.row, head.column, head.text) != (1, 1, "name"):
            self._refuse(ReadCell("", 1, 1), "expected the heading `name`")
            return []
        return rows[1:]

    def _links(self, grown: GrownNode, rows: Sequence[list[ReadCell]]) -> None:
        for number, row in enumerate(rows, 1):
            for cell in row:
                if cell.column > 1:
                    self._refuse(cell, f"read {quoted(cell.text)}, expected names of links alone")
            if row[0].column == 1:
                grown.add(number, self._value(row[0]))

    def _parts(self, grown: GrownNode, name: str, rows: Sequence[list[ReadCell]]) -> None:
        """Add the parts of a sheet; each row is a part."""
        elements = self._shift_elements() if name == GEARS else {}
        paths, engaged = self._headings(name, elements)
        for row in rows:
            if row[0].column > 1:
                self._refuse(row[0]._replace(column=1), "the name is missing")
                continue
            part = GrownNode(*self._at(row[0]))
            for cell in row[1:]:
                if cell.column in paths:
                    self._put(part, paths[cell.column], cell, self._value(cell))
                elif cell.column not in engaged:
                    self._refuse(cell, f"read {quoted(cell.text)}, but its column has no heading")
            self._engage(part, [cell for cell in row if cell.column in engaged], engaged)
            key = self._value(row[0])
            text = key.text if isinstance(key, Scalar) else row[0].text
            if grown.below(text) is None:
                grown.add(text, part)
            else:
                self._refuse(row[0], f"the name {quoted(text)} is given twice")

    def _shift_elements(self) -> dict[str, str]:
        """Return the names of shift elements that can be headings of the sheet of gears."""
        rows = self.sheets.get("shift_elements", [])[1:]
        headings = [row[0].text for row in rows if row[0].column == 1]
        for row in self.sheets.get(CASE_SHEET, [])[1:]:
            try:
                parts = path_parts(row[0].text)
            except NoValueError:  # reported by `_paths`
                continue
            if parts[0] == "shift_elements" and len(parts) > 1:
                headings.append(text_cell(str(parts[1])))
        return {heading: self._plain(heading) for heading in headings}

    def _plain(self, heading: str) -> str:
        """Return the name in a heading, without the quotes of YAML."""
        node = self._value(ReadCell(heading, 1, 1))
        return node.text if isinstance(node, Scalar) else heading

    def _headings(
        self, name: str, elements: Mapping[str, str]
    ) -> tuple[dict[int, Path], dict[int, str]]:
        """Return the paths and the shift elements in the headings, by column."""
        paths, engaged = dict[int, Path](), dict[int, str]()
        sheet, rows = PART_SHEETS[name], self.sheets[name]
        given = set()
        for cell in rows[0][1:] if rows else ():
            if cell.text in given:
                self._refuse(cell, f"the heading {quoted(cell.text)} is there twice")
            elif cell.text in elements:
                engaged[cell.column] = elements[cell.text]
            else:
                paths[cell.column] = self._path(cell, sheet, elements)
            given.add(cell.text)
        return paths, engaged

    def _path(self, cell: ReadCell, sheet: PartSheet, elements: Mapping[str, str]) -> Path:
        """Return the path in a heading; after an error, an empty path."""
        if cell.text in sheet.first:
            return sheet.first[cell.text]
        try:
            parts = path_parts(cell.text)
        except NoValueError as error:
            self._refuse(cell, f"{quoted(cell.text)}: {error}")
            return ()
        if parts[0] not in sheet.known:
            others = [*sheet.first, *elements, *sorted(sheet.known)]
            of = "a key or the name of a shift element" if self.sheet == GEARS else "a key"
            hint = nearest(str(parts[0]), others)
            self._refuse(cell, f"unknown heading {quoted(cell.text)}, expected {of}{hint}")
            return ()
        return parts

    def _engage(
        self, part: GrownNode, cells: Sequence[ReadCell], engaged: Mapping[int, str]
    ) -> None:
        """Add the engaged shift elements of a gear, in the order of columns or numbers.

        A number is the position in the order, from 1, or 0 if disengaged. A table of 1 and 0 is
        valid.
        """
        engagements = []
        for cell in cells:
            # programs write `.0` in columns that contain empty cells
            number = cell.text.removesuffix(".0")
            is_number = number.isdecimal() and len(number) <= LONGEST_NUMBER
            order = int(number) if is_number else 0
            is_engaged = bool(order) if is_number else MARKS.get(cell.text.casefold())
            if is_engaged is None:
                self._refuse(
                    cell, f"read {quoted(cell.text)}, expected `{ENGAGED}` or 1, nothing or 0"
                )
            elif is_engaged:
                name = Scalar(engaged[cell.column], *self._at(cell), plain=False)
                engagements.append((order, name))
        if engagements:
            engagements.sort(key=lambda engagement: engagement[0])
            items: list[Node] = [node for _, node in engagements]
            part.add("engaged", Listing(items, items[0].line, items[0].column))

    def _paths(self, root: GrownNode) -> None:
        """Add the values of the sheet of paths and values."""
        rows = self.sheets[CASE_SHEET]
        if rows and [cell.text for cell in rows[0]] != ["path", "value"]:
            self._refuse(ReadCell("", 1, 1), "expected the headings `path` and `value`")
            return
        for path, *values in rows[1:]:
            notes = [cell for cell in (path, *values) if cell.column > 2]
            if notes:
                message = f"read {quoted(notes[0].text)}, "
                message += "but the columns after path and value must be empty"
                self._refuse(notes[0], f"{message}; write notes on another sheet")
                continue
            if path.column > 1 or [cell.column for cell in values] != [2]:
                self._refuse(path, "expected a path and a value")
                continue
            try:
                parts = path_parts(path.text)
            except NoValueError as error:
                self._refuse(path, f"{quoted(path.text)}: {error}")
                continue
            self._put(root, parts, path, self._value(values[0]))

    def _put(self, grown: GrownNode, parts: Sequence[Part], cell: ReadCell, value: Node) -> None:
        """Add a value at a path; ignore an empty path, which is the result of a wrong heading."""
        if not parts:
            return
        for part in parts[:-1]:
            below = grown.below(part)
            if below is None:
                below = GrownNode(*self._at(cell))
                grown.add(part, below)
            if not isinstance(below, GrownNode):
                self._refuse(cell, f"{quoted(str(part))} is given as a whole, too")
                return
            grown = below
        if grown.below(parts[-1]) is not None:
            self._refuse(cell, f"{quoted(str(parts[-1]))} is given twice")
            return
        grown.add(parts[-1], value)

    def _value(self, cell: ReadCell) -> Node:
        """Return the node of a cell."""
        at = self._at(cell)
        text = with_plain_blanks(cell.text)
        if not is_flow(text):
            return Scalar(text, *at)
        from vstatics.core.readers.named.yaml_nodes import yaml_tree  # yaml costs start-up time

        try:
            return moved(yaml_tree(DocumentText(Source("", text))), *at)
        except ReadError as error:
            hint = 'a text that begins with a bracket or a quote goes in double quotes, as "[1]"'
            self.document.stop(f"{error.problems[-1].message}; {hint}", *at)
