"""Common parts of all pictures: paper, letters, panels with scales, headings, line ends, symbols.

`style` contains colours, sizes and lengths, `words` the texts in two languages, `line_styles` the
styles of links and shift elements, `tolerances` the limits of visible differences. A `canvas`
contains the lines, areas and texts of a page. `metrics` measures letters, `lettering` places the
lines of a text, and `labels` places texts. `pen` draws on a canvas, also the scales of panels;
`ends` names lines at the edges of panels, and `head` is the heading above them. `gear_state`
contains the state of a gear as pictures show it; `free` finds places for texts within a panel;
`pages` divides parts into rows and pages; `join` puts pictures of two cases on one sheet. `svg`
writes a canvas as SVG, `figures` as a figure of matplotlib, and `files` in any format.
"""
