"""Common parts of all pictures: paper, letters, panels with scales, headings, line ends, symbols.

`style` contains colours, sizes and lengths, `words` the texts in two languages, `line_styles` the
styles of links and shift elements, `tolerances` the limits of visible differences. `labels`
measures and places texts. `pen` draws texts, lines, areas and the scales of panels; `ends` names
lines at the edges of panels, and `head` is the heading above them. `gear_state` is the state of a
gear for pictures; `groups` collects values by key; `free` finds places for texts within a panel;
`svg` reduces files and makes them readable; `join` puts pictures of two cases on one sheet.
"""
